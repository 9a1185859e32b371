"""Verification: a recording is run again, and the result is compared with its claims.

A recording of N (``$name#author#comment#level#demo#``) claims to reach the exit. A replay of ours claims an outcome, a
final tick, gold and the digest of the world after that tick. Only inputs are trusted, results are always recomputed.
"""

from __future__ import annotations

from collections.abc import Container, Generator, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ninja_game.backend.memories import proven_memory
from ninja_game.budget import RUN_BUDGET, affordable_ticks, tick_cost
from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.levels.findings import RunProblem, run_problem
from ninja_game.runs.deaths import ending_text
from ninja_game.runs.recording_reader import named_errors
from ninja_game.runs.run import RunResult, run_in_slices, run_to_completion
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.rules import LIFETIME, RULES_VERSION
from ninja_game.simulation import Simulation

STRICT = {
    "outcome": "exit",
    "body": "circle",
    "rules": RULES_VERSION,
    "possible_by_keyboard": True,
    "in_time": True,
    "practice": False,
    "complete": True,
}
"""The fields of a strict verdict, besides a level that counts."""

NOT_RUN = "not run"  # the outcome of a run that was not simulated, since its level does not count


class OutOfRangeError(NinjaGameError):
    """A run read outside of the arrays of its world: it is not judged, and the program is at fault."""


@dataclass(frozen=True)
class Verdict:
    """The result of a recording, and what it was (docs/verification.md).

    A run whose level does not count is not simulated: outcome "not run", ``possible_by_keyboard``, ``in_time`` None.
    """

    file: str
    record: int
    name: str  #: as the recording says
    author: str  #: as the recording says
    level_digest: str  #: digest of the level that was played
    level_name: str  #: name of the level with that digest among those that count, else ''
    body: str  #: body of the run: circle or box
    rules: int  #: version of the rules that the recording names
    outcome: str  #: "exit", "dead" or "running"
    end_tick: int  #: the tick of the first exit contact or death; -1: neither
    gold: int
    score_ticks: int | None  #: score of a passed level, else None
    ticks: int  #: ticks that were run: up to and including ``end_tick``, or all of the recording's
    xy_sha256: str  #: Sha256 (hex) of the ninja's positions
    possible_by_keyboard: bool | None  #: jumps are triggered exactly in the first tick of being held
    in_time: bool | None  #: the lifetime never ran out
    practice: bool  #: as the recording says
    complete: bool  #: the demo's text holds all frames that it claims
    problems: tuple[RunProblem, ...] = ()  #: every claim that does not hold
    made: str = ""  #: the way that the run was made, by its own text; "": unknown
    assisted: bool | None = None  #: whether it is an assisted run, by ``made``; None: unknown
    co_authors: str = ""  #: as the recording says
    episode: str = ""  #: key of the episode of a run in one
    lifetime: int = LIFETIME  #: ticks at the start

    @property
    def good(self) -> bool:
        """Whether the run does what its file claims."""
        return not self.problems

    def as_json(self) -> dict[str, Any]:
        """The fields for programs; with problems, also these in words and their ``codes``."""
        fields = {name: value for name, value in vars(self).items() if name != "problems"}
        if not self.problems:
            return fields
        codes, texts = zip(*self.problems, strict=True)
        return fields | {"problems": list(texts), "codes": list(codes)}


def verify_recording(
    recording: Recording, memory: str = "auto", counting: Container[str] | None = None, budget: int = RUN_BUDGET
) -> Verdict:
    """Run a recording and judge it. ``memory``: "plain", "compiled", "auto", or "both" to compare the two.

    ``counting``: digests of the levels that count, None for all; a run on any other is not simulated. Compiled runs are
    judged with every index checked.

    Raises, naming file and record, LevelError for a level that cannot be played, BudgetError for a run that is not over
    when its ``budget`` of work is (``ninja_game.budget``), OutOfRangeError for a run that leads out of its world,
    SelfTestError where no run can be judged, ArgumentError for anything but a recording.
    """
    return run_to_completion(verify_in_slices(recording, memory, counting, budget))


def verify_in_slices(
    recording: Recording,
    memory: str = "auto",
    counting: Container[str] | None = None,
    budget: int = RUN_BUDGET,
    slice_work: int = RUN_BUDGET,
) -> Generator[None, None, Verdict]:
    """As ``verify_recording``, but a generator: it pauses after each ``slice_work``, its value is the verdict."""
    if not isinstance(recording, Recording):
        raise ArgumentError(f"recording is {recording!r:.60}; expected a Recording: load_replays(path) reads them")
    replay = recording.replay
    claimed = None if replay.unclaimed else replay
    verdict = Verdict(
        recording.file, recording.record, recording.name, recording.author, level_digest(recording.level),
        level_name="", body=recording.body, rules=replay.rules, outcome=NOT_RUN, end_tick=-1, gold=0, score_ticks=None,
        ticks=0, xy_sha256="", possible_by_keyboard=None, in_time=None, practice=replay.practice,
        complete=not recording.missing, made=str(replay.made), assisted=replay.made.assisted,
        co_authors=", ".join(replay.co_authors), episode=recording.episode, lifetime=recording.lifetime,
    )  # fmt: skip
    if counting is not None and verdict.level_digest not in counting:
        return verdict
    work = min(recording.ticks, affordable_ticks(recording.level, budget)) * tick_cost(recording.level)
    plan = proven_memory("plain" if memory == "both" else memory, work)
    with named_errors(recording):
        inputs = recording.inputs
        try:
            run = yield from run_in_slices(
                recording.level,
                inputs,
                body=recording.body,
                memory=plan,
                digest=bool(replay.digest),
                budget=budget,
                slice_work=slice_work,
                lifetime=recording.lifetime,
            )
        except IndexError as error:
            what = "the run leads out of its world's arrays and is not judged: a fault of this program, worth a report"
            raise OutOfRangeError(f"{recording.file}: record {recording.record}: {what}") from error
        problems = list(_broken_claims(claimed, run)) if claimed else []
        if memory == "both":
            difference = memory_difference(recording, run.ticks)
            problems += [run_problem("memories-differ", what=difference)] if difference else []
    if not claimed and run.outcome != "exit":
        problems.append(run_problem("not-passed", ending=_ending(recording, run)))
    if recording.episode and not run.in_time:
        problems.append(run_problem("out-of-time", lifetime=recording.lifetime, gold=run.gold))
    sampled = run.ticks - 1 if run.outcome != "running" else min(run.ticks, len(replay.inputs))
    return replace(
        verdict,
        outcome=run.outcome,
        end_tick=run.end_tick,
        gold=run.gold,
        score_ticks=run.score_ticks if run.outcome == "exit" else None,
        ticks=run.ticks,
        xy_sha256=run.xy_sha256,
        possible_by_keyboard=with_press_bits(inputs[:sampled]) == inputs[:sampled],
        in_time=run.in_time,
        problems=tuple(problems),
    )


def with_demands(
    verdict: Verdict, levels: Mapping[str, str], episodes: Container[str] = (), *, only_these: bool, strict: bool
) -> Verdict:
    """The verdict with the name of its level and with the demands on it beyond its own claims.

    ``levels``: names of the levels that count, by digest; ``episodes``: keys of the episodes that count;
    ``only_these``: a run on any other level is a problem; ``strict``: so is each field that differs from STRICT.
    """
    demanded = []
    if (only_these or strict) and verdict.level_digest not in levels:
        demanded.append(run_problem("other-level", digest=verdict.level_digest))
    elif (only_these or strict) and verdict.episode and verdict.episode not in episodes:
        demanded.append(run_problem("other-episode"))
    unknown = (None, NOT_RUN) if demanded else ()
    for field, expected in STRICT.items() if strict else ():
        if getattr(verdict, field) not in (expected, *unknown):
            demanded.append(not_strict(verdict, field))
    name = levels.get(verdict.level_digest, "")
    return replace(verdict, level_name=name, problems=verdict.problems + tuple(demanded))


def not_strict(verdict: Verdict, field: str) -> RunProblem:
    """The problem of a verdict whose value of this field is not the one of STRICT."""
    found, expected = _as_json(getattr(verdict, field)), _as_json(STRICT[field])
    return run_problem("not-strict", field=field, found=found, expected=expected)


def _as_json(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _ending(recording: Recording, run: RunResult) -> str:
    if run.outcome == "running" and recording.missing:
        held = len(recording.replay.inputs)
        return f"the demo is truncated, it holds {held} of its {held + recording.missing} ticks"
    return ending_text(run.outcome, run.ticks - 1, run.death)


def _broken_claims(replay: Replay, run: RunResult) -> Iterator[RunProblem]:
    """False claims of our replays: the first missed waypoint, then the claims about its last tick."""
    if replay.rules != RULES_VERSION:
        yield run_problem("other-rules", rules=replay.rules, now=RULES_VERSION)
    yield from _missed_waypoint(replay, run)
    if run.ticks != replay.ticks:
        yield run_problem("other-end", tick=run.ticks - 1, outcome=run.outcome, claimed=replay.final_tick)
        return
    claims: dict[str, tuple[object, object]] = {
        "outcome": (run.outcome, replay.outcome),
        "gold": (run.gold, replay.gold),
    }
    if replay.digest:
        claims["digest"] = (run.digest, replay.digest)
    for field, (now, claimed) in claims.items():
        if now != claimed:
            yield run_problem("wrong-claim", tick=replay.final_tick, field=field, found=now, claimed=claimed)


def _missed_waypoint(replay: Replay, run: RunResult) -> Iterator[RunProblem]:
    """The first waypoint at which the run is somewhere else, by its first field that differs."""
    passed = "at the start only"
    for waypoint in replay.waypoints:
        if waypoint.tick >= run.ticks:
            return
        here = run.waypoint(waypoint.tick)
        for field, now, claimed in zip(waypoint._fields, here, waypoint, strict=True):
            if now != claimed:
                values = {"field": field, "found": now, "claimed": claimed, "agrees": passed}
                yield run_problem("missed-waypoint", tick=waypoint.tick, **values)
                return
        passed = f"up to tick {waypoint.tick}"


def memory_difference(recording: Recording, ticks: int) -> str:
    """The first of this many ticks, and the field, in which the two memories differ, '' if they never do.

    Raises MemoryUnavailableError without Numba.
    """
    plain, compiled = (
        Simulation(recording.level, body=recording.body, memory=memory) for memory in ("plain", "compiled")
    )
    for keys in recording.inputs[:ticks]:
        plain.step_keys(keys)
        compiled.step_keys(keys)
        difference = plain.first_difference(compiled)
        if difference:
            field, here, there = difference
            return f"tick {plain.tick - 1}: {field} is {here} on the plain memory, {there} on the compiled one"
    return ""
