"""Whole runs at once: what came of a recording, and everything it shows tick by tick. On both memories, bit for bit.

>>> from ninja_game import parse_level, run_level
>>> level = parse_level("0" * 713 + "|5^100,566!11^160,564,130,564")
>>> result = run_level(level, bytes([2] * 60))
>>> result.outcome, result.end_tick, result.score_ticks
('exit', 23, 3577)
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ninja_game.compile_cache import open_memory
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.replay.text import WAYPOINT_TICKS, Replay, Waypoint
from ninja_game.sim.digest import replay_digest
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import check_inputs, first_ticks
from ninja_game.sim.kinds import KIND_NAMES, KIND_OF
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import TraceRecord
from ninja_game.sim.memory.schema import MAX_EVENTS
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import OUTCOME_NAMES, STATE_NAMES
from ninja_game.simulation import Body, is_box

NINJA_RECORD = np.dtype(
    [("x", "<f8"), ("y", "<f8"), ("prev_x", "<f8"), ("prev_y", "<f8"), ("s", "<i4"), ("gold", "<i4")]
)
"""The ninja after a tick: position and the one before (px), state number, gold collected."""

OBJECT_RECORD = np.dtype([("x", "<f8"), ("y", "<f8"), ("s", "<i4")])
"""An object after a tick: position (px) and status number, both by kind."""


MAX_CELLS = 50_000_000
"""Most objects times ticks in a trace: a gigabyte."""


@dataclass(frozen=True)
class RunResult:
    """What came of a run, up to and including the tick of the first exit contact or death.

    ``outcome``: "exit", "dead" or "running"; ``end_tick``: the tick of that contact or death, -1 while running;
    ``positions``: float64 (ticks, 2), px, the ninja after each tick; ``states``: uint8 (ticks,). ``digest``: of
    what the world shows after the last tick, as replays have it, where it was asked for.
    """

    outcome: str
    gold: int
    positions: NDArray[np.float64] = field(repr=False)
    states: NDArray[np.uint8] = field(repr=False)
    digest: str = ""

    def __eq__(self, other: object) -> bool:
        """Whether the runs are the same in every bit."""
        return isinstance(other, RunResult) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def _key(self) -> tuple[object, ...]:
        return self.outcome, self.gold, self.xy_sha256, self.states.tobytes(), self.digest

    @property
    def ticks(self) -> int:
        """Ticks run."""
        return len(self.states)

    @property
    def end_tick(self) -> int:
        """The tick of the exit contact or death; -1 while running."""
        return -1 if self.outcome == "running" else self.ticks - 1

    @property
    def score_ticks(self) -> int:
        """Lifetime left, in ticks, if this run ended in its last tick (game.md §1.3)."""
        return LIFETIME + GOLD_BONUS * self.gold - (self.ticks - (self.outcome != "running"))

    @property
    def xy_sha256(self) -> str:
        """Sha256 of the positions as little-endian float64 pairs, -0.0 written as 0.0."""
        return hashlib.sha256(self.positions.astype("<f8").tobytes()).hexdigest()


def run_level(
    level: Level, inputs: bytes, *, body: Body = "circle", memory: str = "auto", digest: bool = False
) -> RunResult:
    """Run a level with one input a tick until the first exit contact or death, or to the end of ``inputs``.

    ``inputs``: one byte a tick, the sum of its ``Input`` flags (``Recording.playback`` gives them). ``memory``: as of
    ``Simulation``. ``digest``: tell the digest at the end too, as replays have it.

    Raises LevelError for a level that cannot be played, DemoError for more than a million inputs or for one that there
    is not, ArgumentError for another body or memory.
    """
    check_inputs(inputs)
    world = open_memory(memory, level, box=is_box(body))
    run = world.run(inputs)
    positions = np.frombuffer(run.places, np.float64).reshape(-1, 2)
    end = replay_digest(world.world()) if digest else ""
    return RunResult(OUTCOME_NAMES[world.outcome], world.gold, positions, np.frombuffer(run.states, np.uint8), end)


def record_replay(
    level: Level,
    inputs: bytes,
    *,
    ticks: int | None = None,
    body: Body = "circle",
    name: str = "",
    author: str = "",
) -> Replay:
    """A replay of ours, with its level in it: what comes of these inputs in that many ticks (None: as many as inputs).

    Ends with the first exit contact or death. Always runs on the plain memory, so that what it claims is what anybody
    can check. Raises LevelError for a level that cannot be played, ArgumentError for a run without ticks.
    """
    played = first_ticks(inputs, ticks) if ticks is not None else inputs
    if not played:
        raise ArgumentError("a replay has at least one tick")
    run = run_level(level, played, body=body, memory="plain", digest=True)
    waypoints = [
        Waypoint(tick, float(run.positions[tick, 0]), float(run.positions[tick, 1]), STATE_NAMES[run.states[tick]])
        for tick in range(WAYPOINT_TICKS - 1, run.ticks, WAYPOINT_TICKS)
    ]
    return Replay(
        inputs=inputs[: run.ticks],
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


@dataclass(frozen=True)
class RunTrace:
    """Everything a run shows: ``ninja`` NINJA_RECORD (ticks,), ``objects`` OBJECT_RECORD (ticks, objects).

    ``ids`` and ``kinds`` name the columns of ``objects``, ids ascending; ninjas and inert objects are not among them.
    ``events``: per tick, names with blanks between, where asked for.
    """

    ninja: NDArray[np.void] = field(repr=False)
    objects: NDArray[np.void] = field(repr=False)
    ids: tuple[int, ...]
    kinds: tuple[str, ...]
    events: tuple[str, ...] = field(default=(), repr=False)

    def __eq__(self, other: object) -> bool:
        """Whether the traces are the same in every bit."""
        return isinstance(other, RunTrace) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def _key(self) -> tuple[object, ...]:
        return self.ninja.tobytes(), self.objects.tobytes(), self.ids, self.kinds, self.events


def trace_level(
    level: Level,
    inputs: bytes,
    *,
    body: Body = "circle",
    memory: str = "auto",
    with_objects: bool = True,
    events: bool = False,
) -> RunTrace:
    """Run all of ``inputs``, whatever happens, and record ninja and objects after each tick (canonical numbers).

    ``with_objects``: record objects too. ``events``: record the names of what happens. Raises what ``run_level`` does.
    """
    check_inputs(inputs)
    world = open_memory(memory, level, box=is_box(body))
    kinds = [world.observe(id_ + 1)[0] for id_ in range(world.id_count)] if with_objects else []
    ids = tuple(id_ for id_, kind in enumerate(kinds) if KIND_OF[kind].traced)
    if len(inputs) * len(ids) > MAX_CELLS:
        found = f"{len(inputs)} ticks of {len(ids)} objects"
        raise ArgumentError(f"the trace is too large: {found}; leave the objects out, or trace fewer ticks")
    record = world.trace(inputs, [id_ + 1 for id_ in ids], events=events)
    names = tuple(KIND_NAMES[kinds[id_]] for id_ in ids)
    return RunTrace(_ninja_rows(record), _object_rows(record, len(ids)), ids, names, _event_names(record))


def _ninja_rows(record: TraceRecord) -> NDArray[np.void]:
    """The ninja of each tick as NINJA_RECORD."""
    places = np.frombuffer(record.ninja, np.float64).reshape(-1, 4)
    numbers = np.frombuffer(record.numbers, np.int32).reshape(-1, 2)
    rows = np.empty(len(places), NINJA_RECORD)
    for column, name in enumerate(("x", "y", "prev_x", "prev_y")):
        rows[name] = places[:, column]
    rows["s"], rows["gold"] = numbers.T
    return rows


def _object_rows(record: TraceRecord, count: int) -> NDArray[np.void]:
    """The objects of each tick as OBJECT_RECORD."""
    shape = len(record.numbers) // 2, count
    places = np.frombuffer(record.places, np.float64).reshape(*shape, 2)
    rows = np.empty(shape, OBJECT_RECORD)
    rows["x"], rows["y"] = places[..., 0], places[..., 1]
    rows["s"] = np.frombuffer(record.statuses, np.int32).reshape(shape)
    return rows


def _event_names(record: TraceRecord) -> tuple[str, ...]:
    """The names of each tick's events, with blanks between."""
    ticks = np.frombuffer(record.events, np.uint8).reshape(-1, MAX_EVENTS)
    return tuple(" ".join(EVENT_NAMES[number - 1] for number in tick[tick > 0].tolist()) for tick in ticks)
