"""Whole runs at once: what came of a recording, and everything it shows tick by tick. On both memories, bit for bit.

>>> from ninja_game import parse_level, run_level
>>> level = parse_level("0" * 713 + "|5^100,566!11^160,564,130,564")
>>> result = run_level(level, bytes([2] * 60))
>>> result.outcome, result.end_tick, result.score_ticks
('exit', 23, 3577)
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.compile_cache import choose_memory, kernels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.replay.text import WAYPOINT_TICKS, Replay, Waypoint
from ninja_game.sim.arithmetic import clean
from ninja_game.sim.digest import replay_digest
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.kinds import KIND_NAMES, KIND_OF
from ninja_game.sim.level import Level
from ninja_game.sim.memory.plain import load_plain
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import OUTCOME_NAMES, STATE_NAMES
from ninja_game.sim.traces import is_traced, place_of, status_of
from ninja_game.sim.world import step
from ninja_game.simulation import Body

NINJA_RECORD = np.dtype(
    [("x", "<f8"), ("y", "<f8"), ("prev_x", "<f8"), ("prev_y", "<f8"), ("s", "<i4"), ("gold", "<i4")]
)
"""The ninja after a tick: position and the one before (px), state number, gold collected."""

OBJECT_RECORD = np.dtype([("x", "<f8"), ("y", "<f8"), ("s", "<i4")])
"""An object after a tick: position (px) and status number, both by kind."""


@dataclass(frozen=True)
class RunResult:
    """What came of a run, up to and including the tick of the first exit contact or death.

    ``outcome``: "exit", "dead" or "running"; ``end_tick``: the tick of that contact or death, -1 while running;
    ``positions``: float64 (ticks, 2), px, the ninja after each tick; ``states``: uint8 (ticks,). ``digest``: of
    what the world shows after the last tick, as replays have it, where it was asked for.
    """

    outcome: str
    gold: int
    positions: NDArray[np.float64]
    states: NDArray[np.uint8]
    digest: str = ""

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

    ``inputs``: one byte a tick, the sum of its ``Input`` flags (``Recording.playback`` gives them).
    ``digest``: tell the digest at the end too, as replays have it. Raises LevelError for a level that cannot be played.
    """
    if choose_memory(memory) == "compiled":
        return _run_compiled(level, inputs, body, digest=digest)
    static, w = load_plain(level, body == "box")
    n = w.ninja
    places: list[float] = []
    states = bytearray()
    for keys in inputs:
        step(static, w, keys)
        places += (clean(n.x), clean(n.y))
        states.append(n.state)
        if w.outcome:
            break
    positions = np.array(places, np.float64).reshape(-1, 2)
    end = replay_digest(w) if digest else ""
    return RunResult(OUTCOME_NAMES[w.outcome], w.gold, positions, np.frombuffer(bytes(states), np.uint8), end)


def _run_compiled(level: Level, inputs: bytes, body: Body, *, digest: bool) -> RunResult:
    from ninja_game.sim.memory.compiled import load_compiled
    from ninja_game.sim.memory.layout import plain_copy

    levels, worlds = load_compiled(kernels(), level, body == "box")
    positions = np.empty((len(inputs), 2))
    states = np.empty(len(inputs), np.uint8)
    ticks = kernels()["run_world"](levels, worlds, 0, np.frombuffer(inputs, np.uint8), positions, states)
    outcome, gold = OUTCOME_NAMES[int(worlds["outcome"][0])], int(worlds["gold"][0])
    end = replay_digest(plain_copy(worlds, 0)) if digest else ""
    return RunResult(outcome, gold, positions[:ticks], states[:ticks], end)


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
    can check. Raises LevelError for a level that cannot be played, ValueError for a run without ticks.
    """
    played = inputs.ljust(ticks, b"\0")[:ticks] if ticks is not None else inputs
    if not played:
        raise ValueError("a replay has at least one tick")
    static, w = load_plain(level, body == "box")
    waypoints = []
    for tick, keys in enumerate(played):
        step(static, w, keys)
        if tick % WAYPOINT_TICKS == WAYPOINT_TICKS - 1:
            waypoints.append(Waypoint(tick, clean(w.ninja.x), clean(w.ninja.y), STATE_NAMES[w.ninja.state]))
        if w.outcome:
            break
    return Replay(
        inputs=inputs[: w.tick],
        final_tick=w.tick - 1,
        outcome=OUTCOME_NAMES[w.outcome],
        gold=w.gold,
        digest=replay_digest(w),
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
    ``events``: per tick, names with blanks between (plain memory only, where asked for).
    """

    ninja: NDArray[np.void]
    objects: NDArray[np.void]
    ids: tuple[int, ...]
    kinds: tuple[str, ...]
    events: tuple[str, ...] = ()


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

    ``with_objects``: record objects too. ``events``: record their names too; this runs on the plain memory.
    """
    if not events and choose_memory(memory) == "compiled":
        return _trace_compiled(level, inputs, body, with_objects)
    static, w = load_plain(level, body == "box")
    slots = traced_slots(w) if with_objects else []
    n = w.ninja
    ninja = bytearray()
    objects = bytearray()
    names: list[str] = []
    pack_ninja, pack_thing = struct.Struct("<4d2i").pack, struct.Struct("<2di").pack
    for keys in inputs:
        step(static, w, keys)
        ninja += pack_ninja(clean(n.x), clean(n.y), clean(n.prev_x), clean(n.prev_y), n.state, w.gold)
        for slot in slots:
            x, y = place_of(w, slot)
            objects += pack_thing(clean(x), clean(y), status_of(w, slot))
        if events:
            names.append(" ".join(EVENT_NAMES[event.kind] for event in w.events[: w.event_count]))
    rows = np.frombuffer(bytes(objects), OBJECT_RECORD).reshape(len(inputs), len(slots))
    return RunTrace(np.frombuffer(bytes(ninja), NINJA_RECORD), rows, *_columns(w, slots), tuple(names))


def _trace_compiled(level: Level, inputs: bytes, body: Body, with_objects: bool) -> RunTrace:
    from ninja_game.sim.memory.compiled import load_compiled

    trace: Callable[..., Any] = kernels()["trace_world"]
    levels, worlds = load_compiled(kernels(), level, body == "box")
    kinds = worlds[0]["objects"]["kind"][: worlds[0]["id_count"] + 1].tolist()
    slots = [slot for slot, kind in enumerate(kinds) if slot and KIND_OF[kind].traced] if with_objects else []
    ninja = np.empty(len(inputs), NINJA_RECORD)
    objects = np.empty((len(inputs), len(slots)), OBJECT_RECORD)
    trace(levels, worlds, 0, np.frombuffer(inputs, np.uint8), np.array(slots, np.int64), ninja, objects)
    names = tuple(KIND_NAMES[kinds[slot]] for slot in slots)
    return RunTrace(ninja, objects, tuple(slot - 1 for slot in slots), names)


def traced_slots(w: World) -> list[int]:
    """The slots of all objects that traces show, in id order."""
    return [slot for slot in range(1, w.id_count + 1) if is_traced(w, slot)]


def _columns(w: World, slots: list[int]) -> tuple[tuple[int, ...], tuple[str, ...]]:
    """Ids and kinds of the objects in these slots."""
    return tuple(w.objects[slot].id for slot in slots), tuple(KIND_NAMES[w.objects[slot].kind] for slot in slots)
