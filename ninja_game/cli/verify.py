"""`ninja-game verify`: run recordings again and judge them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import IO, TYPE_CHECKING

import click

from ninja_game.cli.commands import BAD_INPUT, FAILED
from ninja_game.cli.options import NEW_FILE, InputPath, budget_option, jobs_option, record_option
from ninja_game.cli.progress import with_progress
from ninja_game.cli.terminal import print_error
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.sim.rules import LIFETIME

if TYPE_CHECKING:
    from ninja_game.runs.archive import Totals
    from ninja_game.runs.chunks import Result
    from ninja_game.runs.verify import Verdict


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=InputPath())
@click.option(
    "--memory",
    type=click.Choice(["auto", "plain", "compiled", "both"]),
    default="auto",
    show_default=True,
    help="Plain Python, or compiled by Numba; both: compare them in every tick.",
)
@click.option(
    "--level",
    metavar="LEVELS",
    type=InputPath(),
    help="The level that counts, or a file of them: a run on any other fails. One level is also that of recordings "
    "without.",
)
@record_option
@budget_option
@click.option("--strict", is_flag=True, help="Accept only what a board can rely on: see docs/verification.md.")
@jobs_option
@click.option(
    "--workers", type=click.Choice(["threads", "processes"]), help="Workers. [default: threads for compiled runs]"
)
@click.option("--cluster", metavar="ADDRESS", default="", help="Run on the Dask cluster with this scheduler.")
@click.option(
    "--resume", metavar="LOG", type=NEW_FILE, help="Log finished work in this file; what it has is not run again."
)
@click.option(
    "--report", metavar="OUT", type=NEW_FILE, help="Write results and sums to this file: JSON for .json, else a table."
)
@click.option("--json", "as_json", is_flag=True, help="One JSON object per recording, for programs.")
@click.option("-q", "--quiet", is_flag=True, help="Only recordings that fail, and the summary.")
def verify(
    files: Sequence[Path], memory: str, level: Path | None, record: int | None, budget: int, strict: bool,
    jobs: int | None, workers: str | None, cluster: str, resume: Path | None, report: Path | None, as_json: bool,
    quiet: bool,
) -> int:  # fmt: skip
    """Run recordings again and judge them.

    FILE is a replay of ours, a file of $name#author#comment#level#demo# records, a folder of them, or a link. Every
    recording runs until the exit, death, or the end of its inputs. A replay of ours must do what it says; any other
    recording must reach the exit. With --strict it must reach the exit of a level that counts (one of the game's own
    or of --level), in time, by keys that a keyboard can make, under today's rules, outside practice.

    Exit code 0: all of them did; 1: some did not; 2: something cannot be read.

    \b
    Examples:
      ninja-game verify levels/certificates/
      ninja-game verify demos.txt --json
      ninja-game verify run.replay.txt --strict --level the-level.txt
      ninja-game verify demos.txt --memory both
      ninja-game verify archive/ -q --resume archive.log --report archive.json
      ninja-game verify archive/ -q --cluster tcp://10.0.0.5:8786
    """
    from ninja_game.formats.load import load_levels
    from ninja_game.formats.pack.pack import episodes_of
    from ninja_game.runs.archive import Totals, verify_all
    from ninja_game.runs.recording_reader import Unreadable

    totals = Totals()
    results = verify_all(
        files, memory=memory, jobs=jobs, cluster=cluster, resume=resume, record=record,
        levels=load_levels(level) if level else (), episodes=episodes_of(level) if level else None, strict=strict,
        budget=budget, processes=None if workers is None else workers == "processes",
    )  # fmt: skip
    with ExitStack() as stack:
        if report:
            results = _reported(results, totals, report, [*files, resume] if resume else files, stack)
        for result in with_progress(results, "run"):
            totals.add(result)
            if isinstance(result, Unreadable):
                print_error(str(result))
            elif as_json:
                click.echo(json.dumps(result.as_json()))
            elif not (quiet and result.good):
                click.echo(_row(result))
    if record is not None and not totals.recordings + totals.unreadable:
        raise click.UsageError(f"{', '.join(map(str, files))}: no record {record}")
    if not as_json:
        click.echo(_summary(totals))
    return BAD_INPUT if totals.unreadable else FAILED if totals.failed else 0


def _reported(
    results: Iterable[Result], totals: Totals, report: Path, files: Sequence[Path], stack: ExitStack
) -> Iterator[Result]:
    """Pass results on, and write them to a report. ``totals``: of the results so far."""
    from ninja_game.files.writing import open_atomically
    from ninja_game.formats.links import is_link
    from ninja_game.runs.archive import write_report

    out = stack.enter_context(open_atomically(report, keep=[file for file in files if not is_link(file)]))
    return write_report(results, out) if report.suffix.lower() == ".json" else _write_table(results, totals, out)


def _write_table(results: Iterable[Result], totals: Totals, out: IO[bytes]) -> Iterator[Result]:
    from ninja_game.runs.recording_reader import Unreadable

    for result in results:
        if isinstance(result, Unreadable):
            row = f"??   {shown_text(str(result), 1000)}"
        else:
            row = click.unstyle(_row(result))
        out.write(row.encode() + b"\n")
        yield result
    out.write(_summary(totals).encode() + b"\n")


def _row(verdict: Verdict) -> str:
    """A recording in a line, and a line for each claim that does not hold."""
    mark = click.style("ok  ", fg="green") if verdict.good else click.style("FAIL", fg="red")
    when = f"tick {verdict.end_tick}" if verdict.end_tick >= 0 else f"{verdict.ticks} ticks"
    score = seconds_text(verdict.score_ticks) if verdict.score_ticks is not None else ""
    where = f"{shown_text(verdict.file)}:{verdict.record}"
    name = shown_text(verdict.name)
    made = f"  ({shown_text(verdict.made)})" if verdict.made else ""
    if verdict.episode and verdict.score_ticks is not None:
        left = verdict.lifetime + verdict.score_ticks - LIFETIME
        made += f"  (episode: {seconds_text(verdict.lifetime)} s left at its start, {seconds_text(left)} s at the exit)"
    row = f"{mark} {verdict.outcome:<7} {when:>11}  {verdict.gold:>3} gold  {score:>8}  {name}  {where}{made}"
    problems = [f"{shown_text(problem.text)}. {problem.hint} [{problem.code}]" for problem in verdict.problems]
    return "\n     ".join([row, *problems])


def _summary(totals: Totals) -> str:
    counts = ", ".join(f"{count} {outcome}" for outcome, count in sorted(totals.outcomes.items()))
    runs = f"{counted(totals.recordings, 'run')} of {totals.ticks} ticks"
    text = f"{runs}: {counts}" if counts else runs
    text += f"; {totals.failed or 'none'} failed"
    return f"{text}; {totals.unreadable} unreadable" if totals.unreadable else text
