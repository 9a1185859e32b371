"""Verification: a recording is run again, and what comes out is compared with what it claims.

A recording of N (``$name#author#comment#level#demo#``) claims to reach the exit. A replay of ours claims an outcome, a
final tick, gold and the digest of the world after that tick. Inputs alone are trusted, results are always recomputed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import RULES_VERSION, Replay
from ninja_game.runs.recording_reader import body_of, named_errors
from ninja_game.runs.run import RunResult, run_level
from ninja_game.sim.states import STATE_NAMES
from ninja_game.simulation import Simulation


@dataclass(frozen=True)
class Verdict:
    """What came of a recording.

    ``outcome``: "exit", "dead" or "running"; ``end_tick``: the tick of the first exit contact or death, -1 if neither;
    ``score_ticks``: of a passed level, else None; ``ticks``: how many were run up to and including ``end_tick``, or all
    of the recording's; ``xy_sha256``: of the ninja's positions. ``problems``: every claim that does not hold.
    """

    file: str
    record: int
    name: str
    outcome: str
    end_tick: int
    gold: int
    score_ticks: int | None
    ticks: int
    xy_sha256: str
    problems: tuple[str, ...] = ()

    @property
    def good(self) -> bool:
        """Whether the run did what its file says."""
        return not self.problems

    def as_json(self) -> dict[str, Any]:
        """The fields for programs, and ``problems`` where there are any."""
        fields = {name: value for name, value in vars(self).items() if name != "problems"}
        return fields | ({"problems": list(self.problems)} if self.problems else {})


def verify_recording(recording: Recording, memory: str = "auto") -> Verdict:
    """Run a recording and judge it. ``memory``: "plain", "compiled", "auto", or "both" to compare the two.

    Raises LevelError naming file and record for a level that cannot be played.
    """
    replay, body = recording.replay, body_of(recording)
    one_memory = "plain" if memory == "both" else memory
    with named_errors(recording):
        claims_digest = bool(replay and replay.digest)
        inputs = recording.playback(recording.ticks)
        run = run_level(recording.level, inputs, body=body, memory=one_memory, digest=claims_digest)
        problems = list(_broken_claims(replay, run)) if replay else []
        if memory == "both":
            problems += filter(None, [memory_difference(recording)])
    if not replay and run.outcome != "exit":
        problems.append(f"does not reach the exit: {_ending(run.outcome, run.end_tick)}")
    return Verdict(
        file=recording.file,
        record=recording.record,
        name=recording.name,
        outcome=run.outcome,
        end_tick=run.end_tick,
        gold=run.gold,
        score_ticks=run.score_ticks if run.outcome == "exit" else None,
        ticks=run.ticks,
        xy_sha256=run.xy_sha256,
        problems=tuple(problems),
    )


def _ending(outcome: str, tick: int) -> str:
    """An outcome in words."""
    return "still running in the last tick" if outcome == "running" else f"{outcome} in tick {tick}"


def _broken_claims(replay: Replay, run: RunResult) -> Iterator[str]:
    """What a replay of ours says and is not so: the first waypoint that is missed, then what its last tick claims."""
    if replay.rules != RULES_VERSION:
        yield f"recorded under rules {replay.rules}, these are rules {RULES_VERSION}"
    yield from _missed_waypoint(replay, run)
    if run.ticks != replay.ticks:
        yield f"tick {run.ticks - 1}: the run ends here ({run.outcome}), the replay in tick {replay.final_tick}"
        return
    claims: dict[str, tuple[object, object]] = {
        "outcome": (run.outcome, replay.outcome),
        "gold": (run.gold, replay.gold),
    }
    if replay.digest:
        claims["digest"] = (run.digest, replay.digest)
    for field, (found, claimed) in claims.items():
        if found != claimed:
            yield f"tick {replay.final_tick}: {field} is {found}, the replay says {claimed}"


def _missed_waypoint(replay: Replay, run: RunResult) -> Iterator[str]:
    """The first waypoint at which the run is somewhere else, by its first field that differs."""
    passed = "at the start only"
    for waypoint in replay.waypoints:
        if waypoint.tick >= run.ticks:
            return
        x, y = run.positions[waypoint.tick].tolist()
        here = waypoint._replace(x=x, y=y, state=STATE_NAMES[run.states[waypoint.tick]])
        for field, found, claimed in zip(waypoint._fields, here, waypoint, strict=True):
            if found != claimed:
                yield f"tick {waypoint.tick}: ninja: {field} is {found}, the replay says {claimed} (agrees {passed})"
                return
        passed = f"up to tick {waypoint.tick}"


def memory_difference(recording: Recording) -> str:
    """The first tick and field in which the two memories differ, '' if they never do.

    Raises MemoryUnavailableError without Numba.
    """
    plain, compiled = (
        Simulation(recording.level, body=body_of(recording), memory=memory) for memory in ("plain", "compiled")
    )
    for keys in recording.playback(recording.ticks):
        plain.step_keys(keys)
        compiled.step_keys(keys)
        difference = plain.first_difference(compiled)
        if difference:
            field, here, there = difference
            return f"tick {plain.tick - 1}: {field} is {here} on the plain memory, {there} on the compiled one"
    return ""
