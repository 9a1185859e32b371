"""What the compiled memory is called for: whole runs and traces of worlds in an array, without coming back each tick.

These functions take arrays of worlds and an index, never a single record: that is what Numba passes quickly. They work
on lists of plain worlds just as well, which the tests use.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from .loader import populate
from .memory import fast
from .schema import Level, World
from .tiles import set_edges
from .traces import is_traced, place_of, status_of
from .world import step


@fast
def load_world(
    levels: Sequence[Level],
    worlds: Sequence[World],
    index: int,
    kinds: Sequence[int],
    counts: Sequence[int],
    values: Sequence[Sequence[float]],
) -> None:
    """Set the edges of level ``index`` and create its objects in a zeroed world ``index``."""
    set_edges(levels[index], worlds[index])
    populate(levels[index], worlds[index], kinds, counts, values)


@fast
def step_world(levels: Sequence[Level], worlds: Sequence[World], index: int, frame: int) -> None:
    """One tick of one world."""
    step(levels[index], worlds[index], frame)


@fast
def run_world(
    levels: Sequence[Level], worlds: Sequence[World], index: int, frames: Sequence[int], positions: Any, states: Any
) -> int:
    """Run until the tick of the first exit contact or death, or to the end of ``frames``; the number of ticks run.

    ``positions`` (ticks x 2, px) and ``states`` (ticks) receive the ninja's place and state after each tick.
    """
    level = levels[index]
    w = worlds[index]
    n = w.ninja
    for tick in range(len(frames)):
        step(level, w, int(frames[tick]))
        positions[tick, 0] = n.x + 0.0
        positions[tick, 1] = n.y + 0.0
        states[tick] = n.state
        if w.outcome:
            return tick + 1
    return len(frames)


@fast
def race_world(levels: Sequence[Level], worlds: Sequence[World], index: int, frames: Sequence[int]) -> int:
    """Run like ``run_world``, without a record: only the number of ticks run."""
    level = levels[index]
    w = worlds[index]
    for tick in range(len(frames)):
        step(level, w, int(frames[tick]))
        if w.outcome:
            return tick + 1
    return len(frames)


@fast
def traced_slots(w: World, slots: Any) -> int:
    """Write the slots of all objects that traces show, in id order; their number."""
    count = 0
    for slot in range(1, w.ids + 1):
        if is_traced(w, slot):
            slots[count] = slot
            count += 1
    return count


@fast
def trace_world(
    levels: Sequence[Level],
    worlds: Sequence[World],
    index: int,
    frames: Sequence[int],
    ninja: Any,
    ninja_status: Any,
    slots: Any,
    places: Any,
    statuses: Any,
) -> int:
    """Run all of ``frames``, whatever happens, and record everything after each tick; the number of traced objects.

    ``ninja`` (ticks x 4): x, y, px, py; ``ninja_status`` (ticks x 2): state, gold; ``slots`` (objects): which slot each
    traced object has; ``places`` (ticks x objects x 2) px and ``statuses`` (ticks x objects).
    """
    level = levels[index]
    w = worlds[index]
    n = w.ninja
    count = traced_slots(w, slots)
    for tick in range(len(frames)):
        step(level, w, int(frames[tick]))
        ninja[tick, 0] = n.x
        ninja[tick, 1] = n.y
        ninja[tick, 2] = n.px
        ninja[tick, 3] = n.py
        ninja_status[tick, 0] = n.state
        ninja_status[tick, 1] = w.gold
        for k in range(count):
            places[tick, k, 0], places[tick, k, 1] = place_of(w, slots[k])
            statuses[tick, k] = status_of(w, slots[k])
    return count


@fast
def copy_bytes(source: Any, target: Any, count: int) -> None:
    """Copy the first ``count`` bytes: a save, a restore, or a copy between worlds."""
    target[:count] = source[:count]


ENTRY_POINTS: tuple[Callable[..., Any], ...] = (load_world, step_world, run_world, race_world, trace_world, copy_bytes)
