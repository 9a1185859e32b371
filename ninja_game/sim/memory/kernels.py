"""What the compiled memory is called for: whole runs and traces of worlds in an array, without coming back each tick.

These functions take arrays of worlds and an index, never a single record: that is what Numba passes quickly.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ninja_game.sim.arithmetic import clean
from ninja_game.sim.collision.tiles import set_edges
from ninja_game.sim.loader import populate
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.traces import place_of, status_of
from ninja_game.sim.world import step


@entry_point
def load_world(
    levels: Sequence[TileMap],
    worlds: Sequence[World],
    index: int,
    kinds: Sequence[int],
    counts: Sequence[int],
    values: Sequence[Sequence[float]],
    box: int,
) -> None:
    """Set the edges of level ``index`` and create its objects in a zeroed world ``index``."""
    set_edges(levels[index], worlds[index])
    populate(levels[index], worlds[index], kinds, counts, values)
    worlds[index].ninja.box = box


@entry_point
def step_world(levels: Sequence[TileMap], worlds: Sequence[World], index: int, keys: int) -> None:
    """One tick of one world."""
    step(levels[index], worlds[index], keys)


@entry_point
def run_world(
    levels: Sequence[TileMap], worlds: Sequence[World], index: int, inputs: Sequence[int], positions: Any, states: Any
) -> int:
    """Run until the tick of the first exit contact or death, or to the end of ``inputs``; the number of ticks run.

    ``positions`` (ticks x 2, px) and ``states`` (ticks) receive the ninja's place and state after each tick.
    """
    level = levels[index]
    w = worlds[index]
    n = w.ninja
    for tick in range(len(inputs)):
        step(level, w, int(inputs[tick]))
        positions[tick, 0] = clean(n.x)
        positions[tick, 1] = clean(n.y)
        states[tick] = n.state
        if w.outcome:
            return tick + 1
    return len(inputs)


@entry_point
def race_world(levels: Sequence[TileMap], worlds: Sequence[World], index: int, inputs: Sequence[int]) -> int:
    """Run like ``run_world``, without a record: only the number of ticks run."""
    level = levels[index]
    w = worlds[index]
    for tick in range(len(inputs)):
        step(level, w, int(inputs[tick]))
        if w.outcome:
            return tick + 1
    return len(inputs)


@entry_point
def trace_world(
    levels: Sequence[TileMap],
    worlds: Sequence[World],
    index: int,
    inputs: Sequence[int],
    slots: Sequence[int],
    ninja: Any,
    objects: Any,
) -> None:
    """Run all of ``inputs``, whatever happens, and record everything after each tick.

    ``ninja``: NINJA_RECORD (ticks); ``objects``: OBJECT_RECORD (ticks x slots) for the objects in ``slots``.
    """
    level = levels[index]
    w = worlds[index]
    n = w.ninja
    for tick in range(len(inputs)):
        step(level, w, int(inputs[tick]))
        row = ninja[tick]
        row.x = clean(n.x)
        row.y = clean(n.y)
        row.prev_x = clean(n.prev_x)
        row.prev_y = clean(n.prev_y)
        row.s = n.state
        row.gold = w.gold
        for k in range(len(slots)):
            slot = slots[k]
            x, y = place_of(w, slot)
            place = objects[tick, k]
            place.x = clean(x)
            place.y = clean(y)
            place.s = status_of(w, slot)
