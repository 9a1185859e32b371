"""`ninja-game improve`: shorten a run that exists."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli import solver_options as options
from ninja_game.cli.run_options import choose, level_given, level_option

if TYPE_CHECKING:
    from ninja_game.formats.replay.text import Replay


@click.command()
@click.argument("replay", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--record", type=click.IntRange(min=0), help="Which of a file's recordings, counted from 0.")
@level_option
@options.gold_option
@options.seconds_option(60.0)
@options.work_option
@options.seed_option
@options.search_jobs_option
@options.smooth_option
@click.option(
    "-o", "--output", metavar="REPLAY", required=True, type=click.Path(dir_okay=False, path_type=Path),
    help="Where to keep the best run so far.",
)  # fmt: skip
def command(
    replay: Path,
    record: int | None,
    level_path: Path | None,
    output: Path,
    jobs: int | None,
    smooth: int | None,
    **task_options: Any,
) -> None:
    """Shorten a run that exists.

    REPLAY is a replay of ours or a recording $name#author#comment#level#demo#. The run must reach the exit. The best
    run so far is always in the output file; every run is played again from the start by the plain memory before it is
    written. It needs Numba (the extra `fast`).

    \b
    Examples:
      ninja-game improve first.replay.txt -o shorter.replay.txt
      ninja-game improve demos.txt --record 3 --seconds 300 -o shorter.replay.txt
    """
    from ninja_game.formats.load import load_replays
    from ninja_game.search.solve import Task, solve

    recordings = load_replays(replay, level=level_given(level_path))
    recording = choose(recordings, "recordings", replay, record)
    first = recording.inputs
    task = Task(recording.level, body=recording.body, first=first, jobs=options.default_threads(jobs), **task_options)
    options.check_gold(task)
    before: list[int] = []
    save = options.saver(output, recording, recording.author)

    def keep(found: Replay) -> None:
        before.append(found.end_tick)
        save(found)

    with options.progress_line() as report:
        run = solve(task, report=report, on_better=keep)
    assert run is not None  # noqa: S101 - the first run is one
    if smooth is not None:
        run = options.smoothed_run(task.level, run, smooth)
        save(run)
    gain = before[0] - run.end_tick
    change = f"{abs(gain)} ticks {'shorter' if gain > 0 else 'longer'}" if gain else "no shorter run was found"
    click.echo(f"{output}: {options.time_text(run.end_tick)}, {change}, {run.gold} gold")
