"""`ninja-game verify`: run recordings again and judge them."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli.run_options import jobs_option, with_progress, workers

if TYPE_CHECKING:
    from ninja_game.session.verify import Verdict

TICKS_PER_SECOND = 40
FAILED = 1


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path))
@click.option(
    "--memory", type=click.Choice(["auto", "plain", "compiled", "both"]), default="auto", show_default=True,
    help="Plain Python, or compiled by Numba; both: compare them in every tick.",
)  # fmt: skip
@jobs_option
@click.option("--json", "as_json", is_flag=True, help="One JSON object a recording, for programs.")
@click.option("--quiet", "-q", is_flag=True, help="Only recordings that fail, and the summary.")
@click.pass_context
def command(
    ctx: click.Context, files: Sequence[Path], memory: str, jobs: int | None, as_json: bool, quiet: bool
) -> None:
    """Run recordings again and judge them.

    FILE is a replay of ours, a file of $name#author#comment#level#demo# records, or a folder of them. Every recording
    runs until the exit, death, or the end of its inputs. A replay of ours must do what it says; any other recording
    must reach the exit.

    Exit code 0: all of them did; 1: some did not; 2: something cannot be read.

    \b
    Examples:
      ninja-game verify tests/replays/
      ninja-game verify demos.txt --json
      ninja-game verify demos.txt --memory both
    """
    from ninja_game.session.sources import Unreadable, for_each_recording
    from ninja_game.session.verify import verify_recording

    outcomes: Counter[str] = Counter()
    ticks = bad = unreadable = 0
    verify = partial(verify_recording, memory=memory)
    for verdict in with_progress(for_each_recording(verify, files, **workers(memory, jobs)), "runs"):
        if isinstance(verdict, Unreadable):
            unreadable += 1
            click.echo(f"ninja-game: {verdict.message}", err=True)
            continue
        outcomes[verdict.outcome] += 1
        ticks += verdict.ticks
        bad += not verdict.good
        if as_json:
            click.echo(json.dumps(verdict.as_json()))
        elif not (quiet and verdict.good):
            click.echo(_row(verdict))
    if not as_json:
        click.echo(_summary(outcomes, ticks, bad, unreadable))
    ctx.exit(2 if unreadable else FAILED if bad else 0)


def _row(verdict: Verdict) -> str:
    """A recording in a line, and a line for each claim that does not hold."""
    mark = click.style("ok  ", fg="green") if verdict.good else click.style("FAIL", fg="red")
    tick = str(verdict.end_tick) if verdict.end_tick >= 0 else ""
    score = f"{verdict.score_ticks / TICKS_PER_SECOND:.3f}" if verdict.score_ticks is not None else ""
    where = f"{verdict.file}:{verdict.record}"
    row = f"{mark} {verdict.outcome:<7} {tick:>6} tick  {verdict.gold:>3} gold  {score:>8}  {verdict.name}  {where}"
    return "\n     ".join([row, *verdict.problems])


def _summary(outcomes: Counter[str], ticks: int, bad: int, unreadable: int) -> str:
    """All recordings in a line."""
    counts = ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items()))
    total = sum(outcomes.values())
    text = f"{total} run{'s' * (total != 1)} of {ticks} ticks: {counts or 'nothing'}; {bad or 'none'} failed"
    return text + (f"; {unreadable} unreadable" if unreadable else "")
