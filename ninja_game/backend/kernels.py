"""The kernels of memories: load, step, run and trace worlds without a return to Python in every tick.

They take arrays of worlds and an index, never a single record, since Numba passes arrays quickly. The plain memory
calls the same functions with lists. Results go into flat arrays of numbers, which both memories write quickly.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ninja_game.backend.worlds import TRACED_FLOATS, TRACED_INTS
from ninja_game.sim.arithmetic import canonical
from ninja_game.sim.collision.tiles import set_edges
from ninja_game.sim.death import kill
from ninja_game.sim.loader import populate
from ninja_game.sim.schema.declare import kernel
from ninja_game.sim.schema.world_fields import MAX_EVENTS, TileMap, World
from ninja_game.sim.traces import is_switched, place_of, status_of
from ninja_game.sim.world import step

_PLACES, _NUMBERS = len(TRACED_FLOATS), len(TRACED_INTS)  # numbers of floats and of ints that a trace records per tick


@kernel
def load_world(
    maps: Sequence[TileMap],
    worlds: Sequence[World],
    index: int,
    kinds: Sequence[int],
    counts: Sequence[int],
    values: Sequence[Sequence[float]],
    box: int,
) -> None:
    """Set the edges of level ``index`` and create its objects in a zeroed world ``index``."""
    set_edges(maps[index], worlds[index])
    populate(maps[index], worlds[index], kinds, counts, values)
    worlds[index].ninja.box = box


@kernel
def step_world(maps: Sequence[TileMap], number: int, worlds: Sequence[World], index: int, keys: int) -> None:
    """Run one tick of world ``index`` in level ``number``."""
    step(maps[number], worlds[index], keys)


@kernel
def kill_ninja(worlds: Sequence[World], index: int, cause: int, dx: float, dy: float) -> None:
    """Kill the ninja where it is, for a reason outside the rules: its time is over, or the player ended the try."""
    n = worlds[index].ninja
    kill(worlds[index], cause, 0, dx, dy, n.x, n.y)


@kernel
def observe_object(worlds: Sequence[World], index: int, slot: int) -> tuple[int, float, float, int]:
    """Kind, place (px) and status of an object, as traces show them."""
    x, y = place_of(worlds[index], slot)
    return worlds[index].objects[slot].kind, x, y, status_of(worlds[index], slot)


@kernel
def run_world(
    maps: Sequence[TileMap],
    number: int,
    worlds: Sequence[World],
    index: int,
    inputs: Sequence[int],
    places: Any,
    states: Any,
) -> int:
    """Run to the tick of the first exit contact or death, or to the end of ``inputs``; gives the number of ticks run.

    World ``index`` runs in level ``number``. ``places`` (x, y of each tick in turn, px) and ``states`` (one per tick)
    receive the ninja's values after each tick.
    """
    tiles = maps[number]
    w = worlds[index]
    n = w.ninja
    for tick in range(len(inputs)):
        step(tiles, w, int(inputs[tick]))
        places[2 * tick] = canonical(n.x)
        places[2 * tick + 1] = canonical(n.y)
        states[tick] = n.state
        if w.outcome:
            return tick + 1
    return len(inputs)


@kernel
def trace_world(
    maps: Sequence[TileMap],
    number: int,
    worlds: Sequence[World],
    index: int,
    inputs: Sequence[int],
    slots: Sequence[int],
    ninja: Any,
    numbers: Any,
    places: Any,
    statuses: Any,
    switched: Any,
    events: Any,
) -> None:
    """Run all of ``inputs``, also after an exit contact or death, and record everything after each tick.

    World ``index`` runs in level ``number``. ``ninja``: TRACED_FLOATS of each tick in turn; ``numbers``: TRACED_INTS.
    ``places``: x, y of each object in ``slots``; ``statuses``: one per object; ``switched``: 1 for a door that is not
    in its first state. ``events``: MAX_EVENTS per tick, their numbers plus 1, then 0. An empty array records nothing.
    """
    tiles = maps[number]
    w = worlds[index]
    n = w.ninja
    count = len(slots)
    for tick in range(len(inputs)):
        step(tiles, w, int(inputs[tick]))
        place, fact = _PLACES * tick, _NUMBERS * tick
        # The order of TRACED_FLOATS and of TRACED_INTS.
        ninja[place] = canonical(n.x)
        ninja[place + 1] = canonical(n.y)
        ninja[place + 2] = canonical(n.prev_x)
        ninja[place + 3] = canonical(n.prev_y)
        ninja[place + 4] = canonical(n.wall_x)
        ninja[place + 5] = canonical(n.floor_x)
        ninja[place + 6] = canonical(n.floor_y)
        numbers[fact] = n.state
        numbers[fact + 1] = w.gold
        numbers[fact + 2] = n.jump_timer
        numbers[fact + 3] = n.in_air
        numbers[fact + 4] = n.near_wall
        numbers[fact + 5] = n.floor_contacts
        numbers[fact + 6] = w.outcome
        for k in range(count):
            row = tick * count + k
            x, y = place_of(w, slots[k])
            places[2 * row] = canonical(x)
            places[2 * row + 1] = canonical(y)
            statuses[row] = status_of(w, slots[k])
            switched[row] = is_switched(w, slots[k])
        if len(events):
            for k in range(w.event_count):
                events[MAX_EVENTS * tick + k] = w.events[k].kind + 1


@kernel
def run_worlds(
    maps: Sequence[TileMap], level_of: Any, worlds: Sequence[World], inputs: Any, first: int, last: int, stop: int
) -> int:
    """Run worlds ``first`` … ``last`` - 1 for all rows of ``inputs`` (ticks x worlds); gives the number of ticks run.

    ``level_of``: the level of each world. ``stop``: skip worlds after their exit contact or death. The outer loop is
    over worlds, not over ticks, so that a world stays in the processor's cache while its ticks run.
    """
    ticks = 0
    for index in range(first, last):
        tiles = maps[level_of[index]]
        w = worlds[index]
        for tick in range(len(inputs)):
            if stop and w.outcome:
                break
            step(tiles, w, int(inputs[tick, index]))
            ticks += 1
    return ticks
