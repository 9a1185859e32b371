"""Commands that search: for a run to the exit, for a shorter one, for other keys in a span."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli import options
from ninja_game.cli.commands import FAILED
from ninja_game.cli.progress import progress_line
from ninja_game.files.reading import protect_inputs
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import REPLAY_SUFFIX, free_path
from ninja_game.files.writing import check_output
from ninja_game.formats.run_time import time_text

if TYPE_CHECKING:
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.formula.task import SpanResult, SpanTask
    from ninja_game.search.task import Progress, Task


SAME_ROUTE = "\nsame route as before: --against FILE tries those of other runs, `ninja-game solve` looks for new ones"


@click.command()
@click.argument("level", type=options.LevelPath(dir_okay=False))
@options.record_option
@options.shortening_options
@options.body_option
@options.output_option(
    "Where to keep the best run so far. [default: LEVEL's name and .replay.txt, in the current folder]",
    metavar="REPLAY",
)
def solve(level: Path, record: int | None, output: Path | None, smooth: int | None, **task_options: Any) -> int:
    """Find a run to the exit, then shorten it.

    The best run so far is always in REPLAY, so that the search can be stopped at any time (Ctrl-C). Every run is played
    again from the start by the plain memory before it is written. It needs Numba (the extra `fast`).

    Exit code 0: a run was found; 1: none in the time; 2: bad input.

    \b
    Examples:
      ninja-game solve 00-0-first-steps -o first.replay.txt
      ninja-game solve userlevels.txt --record 17 --gold all --seconds 300 -o gold.replay.txt
    """
    from ninja_game.search.certificate import named_replay
    from ninja_game.search.improve import simplified_run
    from ninja_game.search.solve import solve as search_run
    from ninja_game.search.task import Task

    chosen = options.choose_level(level, record)
    output = output or free_path(Path(), level.stem, REPLAY_SUFFIX)
    task = Task(chosen.level, **task_options)
    check_gold(task)
    save = saver(
        output,
        [Path(chosen.file)],
        partial(named_replay, command="solve", name=chosen.name, author="ninja-game solve", level_author=chosen.author),
    )
    with progress_line() as report:
        run = search_run(task, report=report, on_better=save)
    if run is None:
        click.echo(not_found_text(task, report.last))
        return FAILED
    run = simplified_run(task, run, smooth)
    save(run)
    click.echo(f"{shown_text(str(output))}: {time_text(run.end_tick)}, {run.gold} gold")
    return 0


@click.command()
@click.argument("replay", type=options.OLD_FILE)
@options.record_option
@options.level_option
@options.shortening_options
@click.option(
    "--against",
    multiple=True,
    type=options.OLD_FILE,
    help="Shorten this file's routes, too; may be given several times.",
)
@click.option(
    "--resume", metavar="LOG", type=options.NEW_FILE, help="Log better runs here; go on from those that it has."
)
@options.output_option("Where to keep the best run so far.", metavar="REPLAY", required=True)
def improve(
    replay: Path,
    record: int | None,
    level_path: Path | None,
    output: Path,
    smooth: int | None,
    against: tuple[Path, ...],
    resume: Path | None,
    **task_options: Any,
) -> int:
    """Shorten a run that exists.

    REPLAY is a replay of ours or a recording $name#author#comment#level#demo#. If it ends before the exit, half of the
    time goes to finding a way there, with the switch and doors that it needs. With --against the routes of other runs
    of the level are shortened beside its own, and their players become co-authors. The best run so far is always in
    the output file; every run is played again from the start by the plain memory before it is written. It needs Numba
    (the extra `fast`).

    Exit code 1: no way to the exit was found from a run that ends before it.

    \b
    Examples:
      ninja-game improve first.replay.txt -o shorter.replay.txt
      ninja-game improve demos.txt --record 3 --seconds 300 -o shorter.replay.txt
      ninja-game improve first.replay.txt --against theirs.replay.txt -o shorter.replay.txt
      ninja-game improve first.replay.txt --seconds 28800 --resume night.log -o shorter.replay.txt
    """
    from ninja_game.formats.load import load_replays
    from ninja_game.search.certificate import improved_replay
    from ninja_game.search.improve import NoWayError, SearchLog, improve as improve_run
    from ninja_game.search.task import Task
    from ninja_game.tas.contributions import Contributions
    from ninja_game.tas.files import runs_of_level

    earlier = load_replays(output) if resume and output.exists() else []
    protect_inputs(on=True)  # from here on files that were read are protected, but not the output
    recording = options.choose(
        load_replays(replay, level=options.load_level_option(level_path)), "recordings", replay, record
    )
    beside = [run for path in against for run in runs_of_level(path, recording)]
    theirs = tuple(run.inputs for run in beside)
    task = Task(recording.level, body=recording.body, first=recording.inputs, others=theirs, **task_options)
    check_gold(task)
    names = [name for run in beside for name in Contributions.of(run).names if name != recording.player]
    credited = replace(recording.replay, co_authors=tuple(dict.fromkeys((*recording.replay.co_authors, *names))))
    source = replace(recording, replay=credited) if beside else recording
    named = partial(improved_replay, recording=source, command="improve")
    save = saver(output, [Path(recording.file), *against], named)
    log = SearchLog(resume, [replay, output, *against]) if resume else None
    known = [run.inputs for run in earlier if run.level == task.level]
    try:
        with progress_line() as report:
            made = improve_run(task, save, report=report, earlier=known, log=log, price=smooth)
    except NoWayError as error:
        click.echo(str(error))
        return FAILED
    gain, run = made.gain, made.run
    change = f"{abs(gain)} ticks {'shorter' if gain > 0 else 'longer'}"
    if not gain:
        change = "no shorter run was found"
    route = SAME_ROUTE if made.same_route else ""
    click.echo(f"{output}: {time_text(run.end_tick)}, {change}, {run.gold} gold{route}")
    return 0


@click.command()
@click.argument("replay", metavar="RUN", type=options.InputPath(dir_okay=False))
@click.option("--from", "first", required=True, type=click.IntRange(min=0), help="First tick whose keys may change.")
@click.option("--to", "last", required=True, type=click.IntRange(min=1), help="First tick after the span.")
@click.option("--goal", default="", metavar="FORMULA", help="Formula that must be true after a tick of the span.")
@click.option("--maximise", default="", metavar="FORMULA", help="Formula to maximise at the goal.")
@click.option("--minimise", default="", metavar="FORMULA", help="Formula to minimise at the goal.")
@click.option("--rest", is_flag=True, help="Continue with the rest of RUN, which must reach the exit sooner.")
@click.option(
    "--method",
    type=click.Choice(["auto", "local", "beam", "exhaustive"]),
    default="auto",
    show_default=True,
    help="local: small changes; beam: promising states; exhaustive: all keys; auto: local and beam in turn.",
)
@click.option(
    "--every", type=click.IntRange(min=1), default=1, show_default=True, help="For exhaustive: ticks that keys last."
)
@options.seconds_option(60.0)
@options.seed_option
@options.search_jobs_option
@options.record_option
@options.level_option
@options.output_option("Where to keep the best run. [default: nowhere]", metavar="REPLAY")
def search(
    replay: Path, first: int, last: int, goal: str, maximise: str, minimise: str, rest: bool,
    method: str, every: int, seconds: float, seed: int, jobs: int, record: int | None, level_path: Path | None,
    output: Path | None,
) -> int:  # fmt: skip
    """Find other keys for a span of a run.

    RUN is a recording of any format; the keys of the ticks from --from on, up to but without --to, are searched.
    Without --maximise, --minimise and --rest the goal is to be reached as early as possible; without a goal the span's
    last tick counts. Formulas are made of numbers, + - * /, comparisons, and, or, not, and names such as x, y, vx,
    vy, speed, tick, gold, dead, won, distance(x, y), taken(id), opened(id): docs/speedruns.md has all of them.
    Ctrl-C ends the search; the best run so far is in the output file.

    Exit code 0: the goal was reached, with --rest also the exit sooner than in RUN; 1: it was not; 2: something cannot
    be read.

    \b
    Examples:
      ninja-game search run.replay.txt --from 120 --to 180 --goal 'x > 400' --maximise vx -o faster.replay.txt
      ninja-game search run.replay.txt --from 60 --to 100 --goal 'distance(300, 200) < 12' --rest
      ninja-game search run.replay.txt --from 90 --to 102 --maximise speed --method exhaustive --every 2
    """
    from ninja_game.formats.load import load_replays
    from ninja_game.search.certificate import improved_replay
    from ninja_game.search.formula.methods import search_span
    from ninja_game.search.formula.task import SpanTask, score_text, without_useless_keys

    if maximise and minimise:
        raise click.UsageError("--maximise and --minimise cannot be used together")
    if not (goal or maximise or minimise or rest):
        raise click.UsageError("nothing to search for; give --goal, --maximise, --minimise or --rest")
    if every > 1 and method != "exhaustive":
        raise click.UsageError("--every is for --method exhaustive")
    recording = options.choose(
        load_replays(replay, level=options.load_level_option(level_path)), "recordings", replay, record
    )
    named = partial(improved_replay, recording=recording, command="search")
    save = saver(output, [Path(recording.file)], named) if output else None
    measure = maximise or minimise
    level, inputs = recording.level, recording.inputs
    task = SpanTask(level, inputs, first, last, goal, measure, least=bool(minimise), rest=rest, body=recording.body)
    with progress_line() as shown:
        report = _SpanReport(task, seconds, save, shown.say)
        found = search_span(
            task, report, method=method, every=every, seed=seed, threads=jobs, report_miss=report.misses.append
        )
    results = [without_useless_keys(task, result) for result in report.sooner(found)]
    if results:
        report.save(results[0])
    for result in results or report.misses[-1:]:
        click.echo(f"{score_text(task, result)}: {_keys(result)}")
    if results and output:
        click.echo(f"{output}: the first of them")
    for line in _advice(task, found, results):
        click.echo(line)
    return 0 if results else FAILED


def _advice(task: SpanTask, found: Sequence[SpanResult], results: Sequence[SpanResult]) -> Iterator[str]:
    """Advice if a search found no result, or none sooner than the run itself. ``results``: the better ones."""
    from ninja_game.search.formula.task import own_tick

    if not results:
        what = "nothing sooner was found" if found else "the goal was not reached"
        yield f"{what}; more time, a longer span or another --method may help"
    own = own_tick(task) if task.goal and not (task.measure or task.rest) else None
    if own is not None and (not results or task.first + results[0].ticks > own):
        longer = f"; --to {own + 1} includes it" if own >= task.last else ""
        yield f"nothing sooner than RUN, which reaches the goal in tick {own}{longer}"


class _SpanReport:
    """The report of a span search: it shows the best result so far, and writes each better run.

    ``misses``: the nearest results as long as nothing reached the goal.
    """

    def __init__(
        self, task: SpanTask, seconds: float, save: Callable[[Replay], None] | None, say: Callable[[str], object]
    ) -> None:
        from ninja_game.runs.run import run_level

        self.task, self._seconds, self._save, self._say = task, seconds, save, say
        self.misses: list[SpanResult] = []
        self._saved: SpanResult | None = None
        self._began = 0.0
        begun = run_level(task.level, task.inputs, body=task.body) if task.rest else None
        # With --rest a score is the ticks to the exit.
        self._limit = begun.ticks if begun and begun.outcome == "exit" else math.inf

    def __call__(self, ticks: int, found: Sequence[SpanResult]) -> bool:
        """Whether the search goes on: its time begins with the first report, when everything is compiled."""
        from ninja_game.search.formula.task import score_text

        best = self.sooner(found)
        if best and (self._saved is None or best[0] < self._saved):
            self._saved = best[0]
            self.save(best[0])
        standing = next((score_text(self.task, result) for result in best or self.misses[-1:]), "nothing yet")
        self._say(f"{'best ' if best else ''}{standing}  {ticks / 1e6:.1f}M ticks")
        self._began = self._began or time.monotonic()
        return time.monotonic() - self._began < self._seconds

    def sooner(self, found: Sequence[SpanResult]) -> list[SpanResult]:
        """The results that are better than RUN where its rest follows; else all."""
        return [result for result in found if result.score < self._limit]

    def save(self, result: SpanResult) -> None:
        from ninja_game.runs.run import record_replay

        if self._save:
            self._save(record_replay(self.task.level, result.inputs, body=self.task.body))


def _keys(result: SpanResult) -> str:
    from ninja_game.formats.replay.notations import write_inputs
    from ninja_game.sim.inputs import with_press_bits

    return " ".join(write_inputs(with_press_bits(result.keys[: result.ticks].tolist())))


def check_gold(task: Task) -> None:
    there = replace(task, gold=-1).gold_wanted
    if task.gold > there:
        raise click.UsageError(f"--gold {task.gold}: the level holds {there} pieces of gold")


def not_found_text(task: Task, progress: Progress | None) -> str:
    """The line for a search without a run, with the things that it never reached."""
    from ninja_game.search.task import obstacle

    gold = f"with {task.gold_wanted} gold " if task.gold_wanted else ""
    why = f": {obstacle(task.level, task.gold_wanted, progress).sentence}" if progress else ""
    return f"no run {gold}to the exit found{why}; more time or another --seed may find one"


def saver(path: Path, keep: Sequence[Path], named: Callable[[Replay], Replay]) -> Callable[[Replay], None]:
    """A function that names each better run and writes it to a file, which must be none of ``keep``."""
    from ninja_game.search.certificate import save_replay

    check_output(path, keep=keep)
    return lambda run: save_replay(path, named(run))
