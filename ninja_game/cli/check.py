"""`ninja-game check`: certify levels - whether they can be passed, how fast, and what is odd."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli import options
from ninja_game.cli.commands import BAD_INPUT, FAILED
from ninja_game.cli.options import NEW_FOLDER, LevelPath
from ninja_game.cli.progress import progress_line
from ninja_game.cli.terminal import print_error
from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.shown_text import counted, name_key, shown_text
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.files.writing import check_output
from ninja_game.formats.run_time import seconds_text
from ninja_game.sim.rules import TICKS_PER_SECOND

if TYPE_CHECKING:
    from ninja_game.formats.named_level import NamedLevel
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.certify import Certified


class GoldGoals(options.GoldCount):
    """The runs to find. ``both``: one to the exit and one with all gold; otherwise one with that much gold."""

    name = "both|all|N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Goals by name with the gold they want; usage error for anything else."""
        if isinstance(value, dict):
            return value
        if str(value).lower() == "both":
            return {"exit": 0, "gold": -1}
        count = super().convert(value, param, ctx)
        return {"gold" if count else "exit": count}


@click.command()
@click.argument("levels", metavar="LEVEL...", nargs=-1, required=True, type=LevelPath())
@click.option(
    "--gold", "goals", type=GoldGoals(), default="0", show_default=True, help="Gold to collect. both: two runs a level."
)
@options.seconds_option(10.0)
@options.work_option
@options.seed_option
@click.option("--first", "first_only", is_flag=True, help="Stop each search at the first run that it finds.")
@options.levels_jobs_option
@options.body_option
@click.option(
    "--replays", metavar="FOLDER", type=NEW_FOLDER, help="Keep runs in this folder; valid ones are not searched again."
)
@click.option("--improve", is_flag=True, help="Shorten the runs that are kept, too.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object per level, for programs.")
def check(
    levels: Sequence[Path],
    goals: dict[str, int],
    replays: Path | None,
    as_json: bool,
    jobs: int,
    improve: bool,
    **task_options: Any,
) -> int:
    """Certify levels: whether they can be passed, how fast, and what is odd.

    LEVEL is a file of levels or a folder. A level is solvable if a run to the exit was found; not finding one in the
    time proves nothing. The time is that of the best run found; `levels pars` makes the longer par times from it. A
    locked door that this run does not open is reported: the level may not need it.

    --replays keeps the runs as NAME.exit.replay.txt and NAME.gold.replay.txt. Runs that are there are played again: if
    the level has not changed and they pass it, they are kept as they are (--improve shortens them); the others are
    searched, --seconds each. After a change of the level, a run that still passes it is replaced only by a shorter one.

    Exit code 0: all are solvable; 1: for some no run was found; 2: something cannot be read or played. Missing gold
    counts only where --gold asks for nothing else.

    \b
    Examples:
      ninja-game check 00-0-first-steps
      ninja-game check my-levels/ --first
      ninja-game check my-levels/ --gold both --replays my-levels/certificates --seconds 60
    """
    from ninja_game.formats.load import load_levels
    from ninja_game.search.certify import CertifyOptions, certify_all

    chosen = [level for path in levels for level in load_levels(path)]
    kept = list(_files(chosen, goals, replays))
    certify_options = CertifyOptions(goals, task_options, improve)
    broken = 0
    without: dict[str, list[str]] = {goal: [] for goal in goals}
    with progress_line() as report:
        results = certify_all(chosen, kept, certify_options, jobs=jobs, report=report.of_level)
        for level, files, by_goal in zip(chosen, kept, results, strict=True):
            if isinstance(by_goal, NinjaGameError):
                broken += 1
                placed = (
                    replace(by_goal, file=level.file, line=level.line) if isinstance(by_goal, LevelError) else by_goal
                )
                print_error(str(placed))
                continue
            for goal, certified in by_goal.items():
                without[goal] += [] if certified.run else [shown_text(Path(level.file).stem)]
            click.echo(json.dumps(_facts(level, by_goal, files)) if as_json else _rows(level, by_goal))
    if not as_json:
        click.echo(_summary(len(chosen), broken, without))
    return BAD_INPUT if broken else FAILED if without[next(iter(goals))] else 0


def _summary(levels: int, broken: int, without: Mapping[str, Sequence[str]]) -> str:
    """The count in a line, and a line for each goal that some levels lack. ``without``: the names of those."""
    failed = len(next(iter(without.values())))
    count = f"{counted(levels, 'level')}, {levels - failed - broken} solvable, {failed} not solved in the time"
    if broken:
        count += f", {broken} cannot be played"
    goals = (("exit", "to the exit"), ("gold", "with the gold")) if levels > 1 else ()
    lacking = [f"no run {words}: {', '.join(without[goal])}" for goal, words in goals if without.get(goal)]
    return "\n".join([count, *lacking])


def _files(levels: Sequence[NamedLevel], goals: Iterable[str], folder: Path | None) -> Iterator[dict[str, Path]]:
    """The files of each level's runs, by goal: ``file.goal.replay.txt``; numbered if that name is taken."""
    taken: set[str] = set()
    for level in levels:
        stem = name = Path(level.file).stem + (f"-{level.record}" if level.record else "")
        number = 1
        while name_key(name) in taken:
            number += 1
            name = f"{stem}-{number}"
        taken.add(name_key(name))
        files = {goal: folder / f"{name}.{goal}{REPLAY_SUFFIX}" for goal in goals} if folder else {}
        for file in files.values():
            if file.parent.is_dir():  # else it is made
                check_output(file, keep=[Path(level.file)])
            Tree(file.parent).check(file.name)
        yield files


def _rows(level: NamedLevel, by_goal: Mapping[str, Certified]) -> str:
    rows = [_row(goal, certified, level) for goal, certified in by_goal.items()]
    rows[0] += f"  {shown_text(level.name)}  {shown_text(level.file)}:{level.record}"
    best = next(iter(by_goal.values())).run
    return "\n         ".join([*rows, *(f"warning: {warning}" for warning in _warnings(level, best))])


def _row(goal: str, certified: Certified, level: NamedLevel) -> str:
    from ninja_game.search.task import obstacle

    first = goal == "exit" or not certified.gold
    run = certified.run
    if run:
        mark = click.style("solvable", fg="green") if first else "all gold"
        best = f"best {seconds_text(run.end_tick):>7} s  {run.end_tick:>5} ticks  {run.gold:>3} gold"
        return f"{mark} {best}  {certified.how}"
    mark = click.style("??      " if first else "all gold", fg="yellow")
    why = f": {obstacle(level.level, certified.gold, certified.progress).sentence}" if certified.progress else ""
    return f"{mark} no run found{why}"


def _facts(level: NamedLevel, by_goal: Mapping[str, Certified], files: Mapping[str, Path]) -> dict[str, Any]:
    from ninja_game.formats.n14.level_string import level_digest

    run = next(iter(by_goal.values())).run
    facts: dict[str, Any] = {
        "file": level.file, "record": level.record, "name": level.name, "level_digest": level_digest(level.level),
        "solvable": True if run else None, "warnings": _warnings(level, run), "runs": {},
    }  # fmt: skip
    for goal, certified in by_goal.items():
        best = certified.run
        facts["runs"][goal] = best and {
            "ticks": best.end_tick,
            "seconds": best.end_tick / TICKS_PER_SECOND,
            "gold": best.gold,
            "digest": best.digest,
            "how": certified.how,
            "replay": str(files[goal]) if files else None,
        }
    return facts


def _warnings(level: NamedLevel, run: Replay | None) -> list[str]:
    """The findings of a level, and the locked doors that its run does not open."""
    from ninja_game.levels.lint import level_warnings
    from ninja_game.runs.problems import passed_by

    unneeded = passed_by(level.level, [run]) if run else ()
    return [*level_warnings(level.level, level.says), *(finding.sentence for finding in unneeded)]
