"""When two moments count as the same: place, velocity, state, switch state and gold - and what a table knows."""

from __future__ import annotations

from math import floor
from typing import Any

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import JUMPING, SLIDING
from ninja_game.solver.search_memory import (
    CELL_PX,
    PATIENCE,
    REVISITS,
    SHIFT_VX,
    SHIFT_VY,
    SHIFT_X,
    SHIFT_Y,
    SPEED_STEP,
)

MIX = 0x2545F4914F6CDD1D


@fast
def state_class(w: World) -> int:
    """What the ninja could do next, as a small number."""
    n = w.ninja
    if not n.in_air:
        return 0 if not n.jump_held else 1
    if n.state == JUMPING:
        return 2 + n.jump_timer // 11
    if n.state == SLIDING:
        return 5
    return 6 if n.near_wall else 7


@fast
def key_of(w: World, switch_state: int, gold: int, parameters: Any) -> int:
    """The key of a moment, never 0. ``gold``: a hash (16 bits) of what was collected, 0 where gold does not matter."""
    n = w.ninja
    cell = parameters[CELL_PX]
    speed = parameters[SPEED_STEP]
    x = int((n.x + parameters[SHIFT_X]) / cell) & 511
    y = int((n.y + parameters[SHIFT_Y]) / cell) & 511
    vx = floor((n.x - n.prev_x + parameters[SHIFT_VX]) / speed) & 255
    vy = floor((n.y - n.prev_y + parameters[SHIFT_VY]) / speed) & 255
    key = x | y << 9 | vx << 18 | vy << 26 | state_class(w) << 34 | (switch_state & 511) << 37 | (gold & 0xFFFF) << 46
    return int(key + 1)


@fast
def find(table: Any, key: int) -> int:
    """The slot of a key, or of the empty entry where it belongs. The table must have empty entries."""
    mask = len(table) - 1
    mixed = key * MIX
    slot = (mixed ^ (mixed >> 29)) & mask
    while table[slot].key != 0 and table[slot].key != key:
        slot = (slot + 1) & mask
    return slot


@fast
def is_news(entry: Any, tick: int, parameters: Any) -> bool:
    """Is it worth going on from here? Yes for a new key, an earlier arrival, or (a few times) a much later one.

    Later arrivals matter where things move: a gap that is deadly now may be open in a second.
    """
    if entry.visits == 0 or tick < entry.first:
        return True
    return bool(entry.visits < parameters[REVISITS] and tick >= entry.last + parameters[PATIENCE])
