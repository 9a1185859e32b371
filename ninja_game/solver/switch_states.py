"""What a search asks of a moment: its switch state, its gold, and how far the exit is."""

from __future__ import annotations

from typing import Any

from ninja_game.sim.memory.declare import fast
from ninja_game.solver.search_memory import GOLD_NEEDED, MAX_SWITCH_STATES, NEW_SWITCH_STATES, SWITCH_STATES

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
