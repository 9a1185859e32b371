"""Whole runs at once: the result of a recording. On both memories, bit for bit; NumPy comes in only with its arrays.

>>> from ninja_game import parse_level, run_level
>>> level = parse_level("0" * 713 + "|5^100,566!11^160,564,130,564")
>>> result = run_level(level, bytes([2] * 60))
>>> result.outcome, result.end_tick, result.score_ticks
('exit', 23, 3577)
"""

from __future__ import annotations

import hashlib
import sys
from array import array
from collections.abc import Generator, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, SupportsIndex, TypeVar, cast

from ninja_game.backend.memories import PLAIN, Plan, open_worlds, switch_to_compiled
from ninja_game.backend.worlds import RunPath
from ninja_game.budget import PLAIN_WORK, RUN_BUDGET, affordable_ticks, over_budget
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.replay.headers import Waypoint
from ninja_game.formats.replay.text import WAYPOINT_TICKS, Replay
from ninja_game.formats.run_time import level_score
from ninja_game.runs.deaths import death_text
from ninja_game.sim.digest import replay_digest
from ninja_game.sim.inputs import ALL_KEYS, check_inputs, fit_inputs
from ninja_game.sim.level import Body, Level, is_box
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_NAMES, STATE_NAMES

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

T = TypeVar("T")


@dataclass(frozen=True)
class RunResult:
    """The result of a run, up to and including the tick of the first exit contact or death.

    ``outcome``: "exit", "dead" or "running"; ``end_tick``: the tick of that contact or death, -1 while running;
    ``places``: the ninja after each tick, x and y in turn as little-endian float64, px; ``state_numbers``: a byte each.
    ``in_time``: the lifetime never ran out (game.md §1.1). ``digest``: of the world after the last tick, as in replays,
    if requested. ``death``: the ninja's killer, in words, "" without a death.
    """

    outcome: str
    gold: int
    places: bytes = field(repr=False)
    state_numbers: bytes = field(repr=False)
    in_time: bool = True
    digest: str = ""
    death: str = ""

    @property
    def ticks(self) -> int:
        """The number of simulated ticks."""
        return len(self.state_numbers)

    @property
    def positions(self) -> NDArray[np.float64]:
        """The ninja after each tick: float64 (ticks, 2), px."""
        import numpy as np

        return np.frombuffer(self.places, "<f8").reshape(-1, 2)

    @property
    def states(self) -> NDArray[np.uint8]:
        """The number of its state after each tick: uint8 (ticks,)."""
        import numpy as np

        return np.frombuffer(self.state_numbers, np.uint8)

    def waypoint(self, tick: int) -> Waypoint:
        """The ninja's place and state after a tick."""
        x, y = _little_endian(array("d", self.places[16 * tick : 16 * (tick + 1)]))
        return Waypoint(tick, x, y, STATE_NAMES[self.state_numbers[tick]])

    @property
    def end_tick(self) -> int:
        """The tick of the exit contact or death; -1 while running."""
        return -1 if self.outcome == "running" else self.ticks - 1

    @property
    def score_ticks(self) -> int:
        """Lifetime left, in ticks, if this run ended in its last tick (game.md §1.3)."""
        return level_score(self.gold, self.ticks - (self.outcome != "running"))

    @property
    def xy_sha256(self) -> str:
        """Sha256 of the positions as little-endian float64 pairs, -0.0 written as 0.0."""
        return hashlib.sha256(self.places).hexdigest()


def run_level(
    level: Level,
    inputs: Iterable[SupportsIndex],
    *,
    body: Body = "circle",
    memory: str = "auto",
    digest: bool = False,
    budget: int = RUN_BUDGET,
) -> RunResult:
    """Run a level with one input a tick until the first exit contact or death, or to the end of ``inputs``.

    ``inputs``: bytes, a list or an array, for each tick the sum of its ``Input`` flags (``Recording.playback`` gives
    them). ``memory``: as in ``Simulation``. ``digest``: also compute the digest at the end, as replays have it.
    ``budget``: of work (``ninja_game.budget``).

    Raises LevelError for a level that cannot be played, DemoError for more than a million inputs or an invalid one,
    ArgumentError for another body or memory and for invalid inputs, BudgetError for a run that is not over
    when its budget is.
    """
    return run_to_completion(
        run_in_slices(level, inputs_of(inputs), body=body, memory=memory, digest=digest, budget=budget)
    )


def inputs_of(keys: Iterable[SupportsIndex]) -> bytes:
    """Inputs as bytes, one a tick. Raises ArgumentError for anything else."""
    try:
        return keys if isinstance(keys, bytes) else bytes(list(keys))
    except (TypeError, ValueError):
        expected = f"bytes, a list or an array of whole numbers, one a tick, 0 to {ALL_KEYS}"
        raise ArgumentError(f"inputs are {keys!r:.60}; expected {expected}") from None


def run_in_slices(
    level: Level,
    inputs: bytes,
    *,
    body: Body = "circle",
    memory: str | Plan = "auto",
    digest: bool = False,
    budget: int = RUN_BUDGET,
    slice_work: int = RUN_BUDGET,
    lifetime: int = LIFETIME,
) -> Generator[None, None, RunResult]:
    """As ``run_level``, but a generator: it pauses after each ``slice_work`` of work, and its value is the result.

    ``lifetime``: ticks at the start.
    """
    check_inputs(inputs)
    most = min(len(inputs), affordable_ticks(level, budget))
    world = open_worlds(memory, level, box=is_box(body), at_once=True, ticks=most)
    stays = world.name == "compiled" or memory in ("plain", PLAIN)
    slice_ticks = affordable_ticks(level, slice_work if stays else min(slice_work, PLAIN_WORK))
    records: list[RunPath] = []
    in_time = True
    while world.tick() < most and not world.outcome():
        world = switch_to_compiled(world, memory, most - world.tick())
        # Up to the tick at which the lifetime would run out without more gold; later ticks cannot be in time.
        deadline = lifetime + GOLD_BONUS * world.gold()
        in_time = in_time and world.tick() < deadline
        end = min(most, deadline) if in_time else most
        records.append(world.run(inputs[world.tick() : min(end, world.tick() + slice_ticks)]))
        yield
    if not world.outcome() and most < len(inputs):
        raise over_budget(level, len(inputs), budget)
    in_time = in_time and world.tick() - bool(world.outcome()) < lifetime + GOLD_BONUS * world.gold()
    places = _little_endian(array("d", b"".join(_bytes(record.places) for record in records))).tobytes()
    states = b"".join(_bytes(record.states) for record in records)
    final_digest = replay_digest(world.world()) if digest else ""
    death = ""
    if world.outcome() == OUTCOME_DEAD:
        death = death_text(world.events(), world.ninja(), world.objects())
    return RunResult(OUTCOME_NAMES[world.outcome()], world.gold(), places, states, in_time, final_digest, death)


def run_to_completion(slices: Generator[None, None, T]) -> T:
    """The value of a generator that pauses between slices of work, without a pause."""
    while True:
        try:
            next(slices)
        except StopIteration as end:
            return cast(T, end.value)


def _little_endian(numbers: array[float]) -> array[float]:
    """Numbers between this machine's order of bytes and the order of files; the same array."""
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers


def _bytes(buffer: Any) -> bytes:
    """A flat buffer's bytes."""
    return memoryview(buffer).cast("B").tobytes() if len(buffer) else b""


def record_replay(
    level: Level,
    inputs: Iterable[SupportsIndex],
    *,
    ticks: int | None = None,
    body: Body = "circle",
    name: str = "",
    author: str = "",
    budget: int = RUN_BUDGET,
) -> Replay:
    """A replay of ours, with its level in it: the result of these inputs in ``ticks`` ticks (None: as many as inputs).

    Ends with the first exit contact or death. Always runs on the plain memory, so that anybody can check its claims.
    Raises LevelError for a level that cannot be played, ArgumentError for a run without ticks, BudgetError.
    """
    keys = inputs_of(inputs)
    played = fit_inputs(keys, ticks) if ticks is not None else keys
    if not played:
        raise ArgumentError("a replay has at least one tick")
    run = run_level(level, played, body=body, memory="plain", digest=True, budget=budget)
    waypoints = [run.waypoint(tick) for tick in range(WAYPOINT_TICKS - 1, run.ticks, WAYPOINT_TICKS)]
    return Replay(
        inputs=keys[: run.ticks],
        final_tick=run.ticks - 1,
        outcome=run.outcome,
        gold=run.gold,
        digest=run.digest,
        name=name,
        author=author,
        body=body,
        level_digest=level_digest(level),
        level=level,
        waypoints=tuple(waypoints),
    )
