"""What a search asks of a moment: whether it was seen before, its switch state, its gold, how far the exit is."""

from __future__ import annotations

from math import floor
from typing import Any

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import JUMPING, SLIDING
from ninja_game.solver.search_memory import (
    CELL_PX,
    GOLD_NEEDED,
    MAX_SWITCH_STATES,
    NEW_SWITCH_STATES,
    PATIENCE,
    REVISITS,
    SHIFT_VX,
    SHIFT_VY,
    SHIFT_X,
    SHIFT_Y,
    SPEED_STEP,
    SWITCH_STATES,
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


GOLD_STEP = 60.0
"""Estimated ticks for each further piece of gold."""


@fast
def switch_state_of(w: Any, heuristics: Any, switch_states: Any, counters: Any, guess: int) -> int:
    """Index of the present switch state, -1: too many. One that is new is noted for the caller."""
    switch_slots, switches, _, _ = heuristics
    masks, places, _ = switch_states
    mask = 0
    for k in range(switches):
        if w.objects[switch_slots[k]].is_open:
            mask |= 1 << k
    if masks[guess] == mask and guess < counters[SWITCH_STATES]:
        return guess
    for k in range(counters[SWITCH_STATES]):
        if masks[k] == mask:
            return k
    index = counters[SWITCH_STATES]
    if index >= MAX_SWITCH_STATES:
        return -1
    masks[index] = mask
    places[index, 0] = w.ninja.x
    places[index, 1] = w.ninja.y
    counters[SWITCH_STATES] = index + 1
    counters[NEW_SWITCH_STATES] += 1
    return int(index)


@fast
def gold_hash(w: Any, heuristics: Any, counters: Any) -> int:
    """Sixteen bits that tell which pieces have been collected; 0 for none, and where gold does not matter."""
    if counters[GOLD_NEEDED] == 0:
        return 0
    gold_slots = heuristics[2]
    mixed = 0
    for k in range(len(gold_slots)):
        if w.objects[gold_slots[k]].taken:
            mixed ^= (k + 1) * 40503
    return mixed & 0xFFFF


@fast
def estimate(
    w: Any, heuristics: Any, switch_states: Any, counters: Any, switch_state: int, point: int, before: float
) -> float:
    """Ticks to the exit by the fields, while gold is needed to the nearest piece. ``before``: the parent's estimate."""
    _, _, gold_slots, gold_fields = heuristics
    fields = switch_states[2]
    needed = counters[GOLD_NEEDED] - w.gold
    if needed > 0:
        nearest = 1.0e9
        for k in range(len(gold_slots)):
            if not w.objects[gold_slots[k]].taken and gold_fields[k, point] < nearest:
                nearest = 0.0 + gold_fields[k, point]
        return float(nearest + GOLD_STEP * needed)
    # The field of a switch state that has just been discovered is not there yet.
    return float(fields[switch_state, point]) if fields[switch_state, 0] >= 0.0 else before
