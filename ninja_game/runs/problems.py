"""Problems of a level and of a run of it. Nothing here needs NumPy, so that the editor starts without it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from ninja_game.formats.ascii.object_lines import DOORS
from ninja_game.formats.replay.text import Replay
from ninja_game.levels.findings import Finding, level_finding
from ninja_game.levels.lint import level_findings, object_name
from ninja_game.runs.message_appearances import late_messages
from ninja_game.sim.events import LOCK_OPENED
from ninja_game.sim.kinds import DOOR
from ninja_game.sim.level import Body, Level, ObjectSpec, makes_object, well_formed
from ninja_game.simulation import Simulation


@lru_cache(maxsize=1024)
def level_problems(level: Level, says: str = "", inputs: bytes = b"") -> list[Finding]:
    """The findings about a level: the same in the editor and in its pack.

    ``inputs``: of a known run, in which messages may be lost. Raises LevelError for messages that cannot be read.
    """
    odd = [*level_findings(level, says), *late_messages(level, says, inputs)]
    # One finding is enough for an enclosed exit: its switch gets one once the exit can be reached.
    shut = {number for finding in odd if finding.code == "unreachable" for number in finding.records}
    return [finding for finding in odd if finding.code != "unreachable-switch" or not shut.issuperset(finding.records)]


@lru_cache(maxsize=300)
def _unlocked(level: Level, inputs: bytes, body: Body) -> set[tuple[float, float]]:
    """The places of the switches by which these inputs open doors, px. Cached, since the window's thread asks again."""
    run = Simulation(level, body=body)
    opened = set[tuple[float, float]]()
    for keys in inputs:
        run.step_keys(keys)
        events = run.world.events[: run.world.event_count]
        opened.update((event.x, event.y) for event in events if event.kind == LOCK_OPENED)
    return opened


def _is_locked(spec: ObjectSpec) -> bool:
    return spec.kind == DOOR and well_formed(spec) and (spec.values[3], spec.values[6]) == DOORS["locked door"]


def passed_by(level: Level, runs: Sequence[Replay]) -> tuple[Finding, ...]:
    """The locked doors whose switches none of these runs touches."""
    made = [number for number, spec in enumerate(level.objects) if makes_object(spec)]
    locked = [(id_, number) for id_, number in enumerate(made) if _is_locked(level.objects[number])]
    opened = {place for run in runs if locked for place in _unlocked(level, run.inputs, run.body)}
    return tuple(
        level_finding("unneeded-door", (number,))._replace(names=object_name(level.objects[number], id_))
        for id_, number in locked
        if level.objects[number].values[:2] not in opened
    )
