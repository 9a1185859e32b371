"""`ninja-game solve`: find a run to the exit, then shorten it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ninja_game.cli import solver_options as options
from ninja_game.cli.run_options import LevelPath, choose_level
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import free_path


@click.command()
@click.argument("level", type=LevelPath(dir_okay=False))
@click.option("--record", type=click.IntRange(min=0), help="Which of a file's levels, counted from 0.")
@options.gold_option
@options.seconds_option(60.0)
@options.work_option
@options.seed_option
@options.search_jobs_option
@options.smooth_option
@options.body_option
@click.option(
    "-o", "--output", metavar="REPLAY", type=click.Path(dir_okay=False, path_type=Path),
    help="Where to keep the best run so far. [default: LEVEL's name and .replay.txt, in the current folder]",
)  # fmt: skip
@click.pass_context
def command(
    ctx: click.Context,
    /,
    level: Path,
    record: int | None,
    output: Path | None,
    jobs: int | None,
    smooth: int | None,
    **task_options: Any,
) -> None:
    """Find a run to the exit, then shorten it.

    The best run so far is always in REPLAY, so that the search can be stopped at any time (Ctrl-C). Every run is played
    again from the start by the plain memory before it is written. It needs Numba (the extra `fast`).

    Exit code 0: a run was found; 1: none in the time; 2: bad input.

    \b
    Examples:
      ninja-game solve 00-0-first-steps -o first.replay.txt
      ninja-game solve userlevels.txt --record 17 --gold all --seconds 300 -o gold.replay.txt
    """
    from ninja_game.search.solve import Task, solve

    chosen = choose_level(level, record)
    output = output or free_path(Path(), level.stem, ".replay.txt")
    task = Task(chosen.level, jobs=options.default_threads(jobs), **task_options)
    options.check_gold(task)
    save = options.saver(output, chosen)
    with options.progress_line() as report:
        run = solve(task, report=report, on_better=save)
    if run is None:
        click.echo(options.not_found_text(task, report.last))
        ctx.exit(options.NOT_FOUND)
    if smooth is not None:
        run = options.smoothed_run(task.level, run, smooth)
        save(run)
    click.echo(f"{shown_text(str(output))}: {options.time_text(run.end_tick)}, {run.gold} gold")
