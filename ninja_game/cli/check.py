"""`ninja-game check`: certify levels - whether they can be passed, how fast, and what is odd."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli import solver_options as options
from ninja_game.cli.run_options import LevelPath
from ninja_game.errors import LevelError
from ninja_game.files.shown_text import shown_text
from ninja_game.sim.kinds import DOOR
from ninja_game.sim.rules import TICKS_PER_SECOND

if TYPE_CHECKING:
    from ninja_game.formats.named_level import NamedLevel
    from ninja_game.solver.certificate import VerifiedRun


@click.command()
@click.argument("levels", metavar="LEVEL...", nargs=-1, required=True, type=LevelPath())
@options.gold_option
@options.seconds_option(10.0)
@options.work_option
@options.seed_option
@options.search_jobs_option
@options.body_option
@click.option(
    "--replays", metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path),
    help="Keep the runs that were found in this folder.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="One JSON object a level, for programs.")
@click.pass_context
def command(
    ctx: click.Context,
    /,
    levels: Sequence[Path],
    replays: Path | None,
    as_json: bool,
    jobs: int | None,
    **task_options: Any,
) -> None:
    """Certify levels: whether they can be passed, how fast, and what is odd.

    LEVEL is a file of levels or a folder. A level is solvable if a run to the exit was found (it is kept with
    --replays); not finding one in the time proves nothing. The par time is that of the best run found. A locked door
    that this run does not open is told: the level may not need it.

    Exit code 0: all are solvable; 1: for some no run was found; 2: something cannot be read or played.

    \b
    Examples:
      ninja-game check 00-0-first-steps
      ninja-game check my-levels/
      ninja-game check my-level.txt --seconds 60 --replays certificates/
    """
    from ninja_game.cli.main import BAD_INPUT, complain
    from ninja_game.formats.load import load_levels
    from ninja_game.solver.solve import Task, solve

    chosen = [level for path in levels for level in load_levels(path)]
    if replays:
        replays.mkdir(parents=True, exist_ok=True)
    missing = broken = 0
    for level, where in zip(chosen, _certificates(chosen, replays), strict=True):
        task = Task(level.level, jobs=options.default_threads(jobs), **task_options)
        try:
            with options.progress_line() as report:
                run = solve(task, report=report, on_better=options.saver(where, level) if where else None)
        except LevelError as error:
            broken += 1
            complain(str(replace(error, file=level.file, line=level.line)))
            continue
        missing += run is None
        if as_json:
            click.echo(json.dumps(_facts(level, run, where)))
        else:
            click.echo(_row(level, run))
    if not as_json:
        solved = len(chosen) - missing - broken
        unplayable = f", {broken} cannot be played" if broken else ""
        counted = f"{len(chosen)} level{'s' * (len(chosen) != 1)}"
        click.echo(f"{counted}, {solved} solvable, {missing} not solved in the time{unplayable}")
    ctx.exit(BAD_INPUT if broken else options.NOT_FOUND if missing else 0)


def _certificates(levels: Sequence[NamedLevel], folder: Path | None) -> Iterator[Path | None]:
    """Where each level's run is kept: ``file-record.replay.txt``, numbered where that name is given already."""
    given: set[str] = set()
    for level in levels:
        stem = name = f"{Path(level.file).stem}-{level.record}"
        number = 1
        # File systems may take large and small letters for the same.
        while name.casefold() in given:
            number += 1
            name = f"{stem}-{number}"
        given.add(name.casefold())
        yield folder / f"{name}.replay.txt" if folder else None


def _row(level: NamedLevel, run: VerifiedRun | None) -> str:
    """A level in a line, and a line for each warning."""
    if run is None:
        mark, par = click.style("??      ", fg="yellow"), "no run found"
    else:
        mark = click.style("solvable", fg="green")
        par = f"par {run.end_tick / TICKS_PER_SECOND:7.3f} s  {run.end_tick:>5} ticks  {run.gold:>3} gold"
    row = f"{mark} {par}  {shown_text(level.name)}  {shown_text(level.file)}:{level.record}"
    return "\n         ".join([row, *(f"warning: {warning}" for warning in _warnings(level, run))])


def _facts(level: NamedLevel, run: VerifiedRun | None, where: Path | None) -> dict[str, Any]:
    """A level's certificate for programs."""
    from ninja_game.formats.n14.level_string import level_digest

    facts: dict[str, Any] = {
        "file": level.file, "record": level.record, "name": level.name, "level_digest": level_digest(level.level),
        "solvable": True if run else None, "warnings": _warnings(level, run),
    }  # fmt: skip
    if run:
        facts |= {"par_ticks": run.end_tick, "par_seconds": run.end_tick / TICKS_PER_SECOND, "gold": run.gold}
        facts |= {"run_digest": run.digest, "replay": str(where) if where else None}
    return facts


def _warnings(level: NamedLevel, run: VerifiedRun | None) -> list[str]:
    """What is odd about a level, and the locked doors that its run does not open."""
    from ninja_game.levels.warnings import level_warnings, object_name
    from ninja_game.sim.arithmetic import is_set
    from ninja_game.sim.level import makes_object, well_formed
    from ninja_game.simulation import Simulation

    warnings = level_warnings(level.level)
    specs = enumerate(filter(makes_object, level.level.objects))
    locked = {id_: spec for id_, spec in specs if spec.kind == DOOR and well_formed(spec) and is_set(spec.values[6])}
    if run and locked:
        simulation = Simulation(run.level, body=run.body, memory="plain")
        for keys in run.inputs:
            simulation.step_keys(keys)
            for event in simulation.events:
                if event.name == "lock-opened" and event.object_id is not None:
                    locked.pop(event.object_id, None)
        warnings += [f"{object_name(spec, id_)}: the run does not open it" for id_, spec in locked.items()]
    return warnings
