"""What a search asks of a moment: its stage, its gold, and how far the exit is."""

from __future__ import annotations

from typing import Any

from ninja_game.sim.memory.declare import fast
from ninja_game.solver.search_memory import GOLD_NEEDED, MAX_STAGES, MOST_GOLD, NEW_STAGES, STAGES

GOLD_STEP = 60.0
"""Estimated ticks for each further piece of gold."""


@fast
def stage_of(w: Any, goals: Any, stages: Any, counters: Any, guess: int) -> int:
    """Index of the present stage; a stage that is seen for the first time is noted for the caller. -1: too many."""
    switch_slots, switches, _, _ = goals
    masks, places, _ = stages
    mask = 0
    for k in range(switches):
        if w.objects[switch_slots[k]].spent:
            mask |= 1 << k
    if masks[guess] == mask and guess < counters[STAGES]:
        return guess
    for k in range(counters[STAGES]):
        if masks[k] == mask:
            return k
    index = counters[STAGES]
    if index >= MAX_STAGES:
        return -1
    masks[index] = mask
    places[index, 0] = w.ninja.x
    places[index, 1] = w.ninja.y
    counters[STAGES] = index + 1
    counters[NEW_STAGES] += 1
    return int(index)


@fast
def gold_hash(w: Any, goals: Any, counters: Any) -> int:
    """Sixteen bits that tell which pieces have been collected; 0 for none, and where gold does not matter."""
    if counters[GOLD_NEEDED] == 0:
        return 0
    gold_slots = goals[2]
    mixed = 0
    for k in range(len(gold_slots)):
        if w.objects[gold_slots[k]].spent:
            mixed ^= (k + 1) * 40503
    return mixed & 0xFFFF


@fast
def estimate(w: Any, goals: Any, stages: Any, counters: Any, stage: int, point: int, before: float) -> float:
    """Ticks to the exit by the fields, while gold is needed to the nearest piece. ``before``: the parent's estimate."""
    _, _, gold_slots, gold_fields = goals
    fields = stages[2]
    needed = counters[GOLD_NEEDED] - w.gold
    if counters[GOLD_NEEDED] > 0 and w.gold > counters[MOST_GOLD]:
        counters[MOST_GOLD] = w.gold
    if needed > 0:
        nearest = 1.0e9
        for k in range(len(gold_slots)):
            if not w.objects[gold_slots[k]].spent and gold_fields[k, point] < nearest:
                nearest = 0.0 + gold_fields[k, point]
        return float(nearest + GOLD_STEP * needed)
    # The field of a stage that has just been discovered is not there yet.
    return float(fields[stage, point]) if fields[stage, 0] >= 0.0 else before
