"""What a search asks of a moment: whether it was seen before, its switch state, its gold, how far the exit is."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.search.heuristics import open_mask
from ninja_game.search.nodes import Counters, Resolution, TableEntry
from ninja_game.sim.kinds import GOLD, LAUNCHER
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import JUMPING, LAUNCHER_FLIGHT, SLIDING
from ninja_game.sim.traces import is_open

MIX = 0x2545F4914F6CDD1D  # an odd number whose product spreads the bits of a key (that of xorshift64*)
MAX_SWITCH_STATES = 512
"""So many can be told apart: nine bits of a key."""
JUMP_PART = 11  # ticks of a jump that count as the same moment
NOT_MADE, WANTED = -1.0, -2.0
"""Value of a field at point 0, outside the world, until the field is made."""


class Goal(NamedTuple):
    """Where to go in a level, by switch state (heuristics.py). Masks, places and fields have MAX_SWITCH_STATES rows.

    A search is one for the exit, or one *leg*: it ends where another piece of gold is collected or a switch
    touched.
    """

    gold: int  #: pieces that a run must have at the exit
    leg: int  #: a leg ends where this many pieces are collected; 0: only the exit counts
    mask: int  #: and where what is open differs from this
    target: int  #: but with a slot of an object: only where that is taken or open
    wanted: int  #: of these switches one at least must be open at the end of a leg, but for a few ends; 0: any
    ends: int  #: how many ends of a leg are enough
    rollouts: int  #: tries to survive at the end of a leg, 0: it need not be survived
    gold_slots: NDArray[np.int64]
    enemies: NDArray[np.int64]  #: slots of what moves and kills
    switch_slots: NDArray[np.int64]  #: the slot of each bit of a mask
    masks: NDArray[np.int64]  #: what is open in each switch state, -1: not reached yet
    places: NDArray[np.float64]  #: where the ninja was when its field was wanted
    fields: NDArray[np.float32]  #: ticks to the goal from each point; NOT_MADE or WANTED at point 0


@fast
def state_class(w: World) -> int:
    """What the ninja could do next, as a small number."""
    n = w.ninja
    if not n.in_air:
        return 0 if not n.jump_held else 1
    if n.state == JUMPING:
        return 2 + n.jump_timer // JUMP_PART
    if n.state == SLIDING:
        return 5
    return 6 if n.near_wall else 7


@fast
def key_of(w: World, goal: Goal, switch_state: int, gold: int, resolution: Resolution) -> int:
    """The key of a moment, never 0. ``gold``: a hash (16 bits) of what was collected, 0 where gold does not matter."""
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
    """A hash of where the enemies near the ninja are, in coarse cells, and of what they do; 0 where there are none."""
    n = w.ninja
    mixed = 0
    for k in range(len(goal.enemies)):
        o = w.objects[goal.enemies[k]]
        # A rocket in flight matters from afar: it must be led somewhere.
        in_flight = o.kind == LAUNCHER and o.routine == LAUNCHER_FLIGHT
        if not in_flight and abs(o.x - n.x) + abs(o.y - n.y) > resolution.enemy_reach:
            continue
        place = int(o.x / resolution.enemy_cell) & 255 | (int(o.y / resolution.enemy_cell) & 255) << 8
        mixed += (place | o.routine << 16 | (k + 1) << 20) * MIX
    mixed ^= mixed >> 31
    return (mixed & 0x3FFFFFFF) << 33 if mixed else 0


@fast
def find_entry(table: Sequence[TableEntry], key: int) -> int:
    """The slot of a key, or of the empty entry where it belongs. The table must have empty entries."""
    mask = len(table) - 1
    mixed = key * MIX
    slot = (mixed ^ (mixed >> 29)) & mask
    while table[slot].key != 0 and table[slot].key != key:
        slot = (slot + 1) & mask
    return slot


@fast
def is_new(entry: TableEntry, tick: int, resolution: Resolution) -> bool:
    """Is it worth going on from here? Yes for a new key, an earlier arrival, or (a few times) a much later one.

    Later arrivals matter where things move: a gap that is deadly now may be open in a second.
    """
    if entry.visits == 0 or tick < entry.first:
        return True
    return bool(entry.visits < resolution.visits and tick >= entry.last + resolution.patience)


@fast
def switch_state_of(w: World, goal: Goal, counters: Counters, guess: int) -> int:
    """Index of the present switch state, -1: too many. One without a field wants it."""
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
    """Whether a piece of gold is taken, or an exit or a door open."""
    o = w.objects[slot]
    return bool(o.taken) if o.kind == GOLD else bool(is_open(w, slot))


@fast
def gold_hash(w: World, goal: Goal) -> int:
    """Sixteen bits that tell which pieces have been collected."""
    mixed = 0
    for k in range(len(goal.gold_slots)):
        if w.objects[goal.gold_slots[k]].taken:
            mixed ^= (k + 1) * MIX
    return (mixed >> 40) & 0xFFFF


@fast
def estimate(goal: Goal, switch_state: int, point: int, before: float) -> float:
    """Ticks to the goal by the field of a switch state; ``before`` (the parent's) where that is not made yet."""
    return float(goal.fields[switch_state, point]) if goal.fields[switch_state, 0] >= 0.0 else before
