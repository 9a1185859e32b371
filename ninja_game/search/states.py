"""Values that a search computes from a state: key, switch state, gold, estimated ticks to go."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.search.heuristics import open_mask
from ninja_game.search.nodes import Counters, Resolution, TableEntry
from ninja_game.sim.kinds import GOLD, LAUNCHER
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import JUMPING, LAUNCHER_FLIGHT, SLIDING
from ninja_game.sim.traces import is_open

MIX = 0x2545F4914F6CDD1D  # odd multiplier that spreads the bits of a key (the one of xorshift64*)
MAX_SWITCH_STATES = 512  # number of switch states that are distinguished: nine bits of a key
JUMP_PART = 11  # ticks of a jump that count as the same state
NOT_MADE, WANTED = -1.0, -2.0  # value of a field at point 0, outside the world, until the field is made


class Goal(NamedTuple):
    """The goal in a level, by switch state (heuristics.py). Masks, places and fields have MAX_SWITCH_STATES rows.

    A search is for the exit, or of a *leg*: a leg ends where another piece of gold is collected or a switch touched.
    """

    gold: int  #: pieces that a run must have at the exit
    leg: int  #: pieces at which a leg ends; 0: only the exit counts
    mask: int  #: open switches; a leg also ends where they differ
    target: int  #: slot of the only object that ends a leg, by being taken or opened; 0: any
    wanted: int  #: switches of which one must be open at the end of a leg, except for a few ends; 0: any
    ends: int  #: number of ends that are enough for a leg
    rollouts: int  #: random runs that must survive the end of a leg, 0: no test
    gold_slots: NDArray[np.int64]
    enemies: NDArray[np.int64]  #: slots of the objects that move and kill
    switch_slots: NDArray[np.int64]  #: the slot of each bit of a mask
    masks: NDArray[np.int64]  #: open switches of each switch state, -1: not reached yet
    places: NDArray[np.float64]  #: place of the ninja when a field was wanted
    fields: NDArray[np.float32]  #: ticks to the goal from each point; NOT_MADE or WANTED at point 0


@fast
def state_class(w: World) -> int:
    """Classify what the ninja can do next, as a small number."""
    n = w.ninja
    if not n.in_air:
        return 0 if not n.jump_held else 1
    if n.state == JUMPING:
        return 2 + n.jump_timer // JUMP_PART
    if n.state == SLIDING:
        return 5
    return 6 if n.near_wall else 7


@fast
def state_key(w: World, goal: Goal, switch_state: int, gold: int, resolution: Resolution) -> int:
    """The key of a state, never 0. ``gold``: a 16-bit hash of the collected pieces, 0 if gold does not matter."""
    n = w.ninja
    x = int((n.x + resolution.shift_x) / resolution.cell) & 511
    y = int((n.y + resolution.shift_y) / resolution.cell) & 511
    vx = floor((n.x - n.prev_x + resolution.shift_vx) / resolution.speed) & 255
    vy = floor((n.y - n.prev_y + resolution.shift_vy) / resolution.speed) & 255
    near = near_enemies(w, goal, resolution) if resolution.enemy_cell > 0.0 else 0
    state = switch_state & (MAX_SWITCH_STATES - 1)
    key = x | y << 9 | vx << 18 | vy << 26 | state_class(w) << 34 | state << 37 | (gold & 0xFFFF) << 46
    return int((key ^ near) + 1)


@fast
def near_enemies(w: World, goal: Goal, resolution: Resolution) -> int:
    """Hash places, in coarse cells, and routines of the enemies near the ninja; 0 if there are none."""
    n = w.ninja
    mixed = 0
    for k in range(len(goal.enemies)):
        o = w.objects[goal.enemies[k]]
        # A rocket in flight matters even far away: the ninja must lead it somewhere.
        in_flight = o.kind == LAUNCHER and o.routine == LAUNCHER_FLIGHT
        if not in_flight and abs(o.x - n.x) + abs(o.y - n.y) > resolution.enemy_reach:
            continue
        place = int(o.x / resolution.enemy_cell) & 255 | (int(o.y / resolution.enemy_cell) & 255) << 8
        mixed += (place | o.routine << 16 | (k + 1) << 20) * MIX
    mixed ^= mixed >> 31
    return (mixed & 0x3FFFFFFF) << 33 if mixed else 0


@fast
def find_entry(table: Sequence[TableEntry], key: int) -> int:
    """The slot of a key, or of the empty entry for it. The table must have empty entries."""
    mask = len(table) - 1
    mixed = key * MIX
    slot = (mixed ^ (mixed >> 29)) & mask
    while table[slot].key != 0 and table[slot].key != key:
        slot = (slot + 1) & mask
    return slot


@fast
def is_new(entry: TableEntry, tick: int, resolution: Resolution) -> bool:
    """Whether to continue from here: yes for a new key, an earlier arrival, or (a few times) a much later one.

    Later arrivals matter if things move: a gap that is deadly now may be open in a second.
    """
    if entry.visits == 0 or tick < entry.first:
        return True
    return bool(entry.visits < resolution.visits and tick >= entry.last + resolution.patience)


@fast
def switch_state_of(w: World, goal: Goal, counters: Counters, guess: int) -> int:
    """The index of the present switch state, -1: too many. Requests the field of a new one."""
    mask = open_mask(w, goal.switch_slots)
    index = guess
    if goal.masks[guess] != mask:
        index = 0
        while index < MAX_SWITCH_STATES and goal.masks[index] != mask and goal.masks[index] >= 0:
            index += 1
        if index == MAX_SWITCH_STATES:
            return -1
    goal.masks[index] = mask
    if goal.fields[index, 0] == NOT_MADE:
        goal.places[index, 0] = w.ninja.x
        goal.places[index, 1] = w.ninja.y
        goal.fields[index, 0] = WANTED
        counters.fields_wanted += 1
    return index


@fast
def is_done(w: World, slot: int) -> bool:
    """Whether a piece of gold is taken, or an exit or door open."""
    o = w.objects[slot]
    return bool(o.taken) if o.kind == GOLD else bool(is_open(w, slot))


@fast
def gold_hash(w: World, goal: Goal) -> int:
    """Hash the set of collected pieces into sixteen bits."""
    mixed = 0
    for k in range(len(goal.gold_slots)):
        if w.objects[goal.gold_slots[k]].taken:
            mixed ^= (k + 1) * MIX
    return (mixed >> 40) & 0xFFFF


@fast
def estimate(goal: Goal, switch_state: int, point: int, before: float) -> float:
    """The ticks to the goal by the field of a switch state; those of the parent, ``before``, until that is made."""
    return float(goal.fields[switch_state, point]) if goal.fields[switch_state, 0] >= 0.0 else before
