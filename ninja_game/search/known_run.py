"""A run that is known, as a search along it sees it: where it was, how fast, with what open, under which keys.

What a search reaches is compared with it: *ahead* are the ticks that the known run still has from its moment that is
most like this one, and a price for the difference.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Keys
from ninja_game.search.heuristics import UNREACHED, open_mask
from ninja_game.search.nodes import Start, copy_words
from ninja_game.sim.inputs import KEYS_DOWN, with_press_bit
from ninja_game.sim.memory.declare import fast, kernel
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import OUTCOME_RUNNING
from ninja_game.sim.world import step

AHEAD = 128  # ticks by which a moment may be ahead of the known run
BEHIND = 24  # or behind it
SLOW = 0.5
"""Px/tick; a known run that is slower counts as that fast."""


class KnownRun(NamedTuple):
    """A run of n ticks to the exit. Row k is what is so after k ticks; row 0 is the start."""

    moves: NDArray[np.float64]  #: x, y (px), velocity (px/tick); (n + 1, 4)
    keys: Keys  #: of each tick, without triggers
    masks: NDArray[np.int64]  #: what is open
    gold: NDArray[np.int64]  #: pieces that whoever is as far must have collected
    span: tuple[int, int]  #: its first tick, and the tick behind its last, in which a search may fall behind the run
    max_delay: float  #: by how many ticks
    max_distance: float  #: px across, and px down, by which a state may differ from its row
    place_price: float  #: of a difference of place, in ticks a tick of the run's way
    speed_price: float  #: ticks a px/tick
    most_moved: float  #: px from row to row, across or down, at most


def known_run(ticks: int, keys: bytes = b"") -> KnownRun:
    """Room for a run of this many ticks, to be filled by ``play_known``."""
    moves, (masks, gold) = np.zeros((ticks + 1, 4)), np.zeros((2, ticks + 1), np.int64)
    held = np.array(list(keys), np.uint8) & np.uint8(KEYS_DOWN)
    return KnownRun(moves, held, masks, gold, (0, ticks), 0.0, 64.0, 1.0, 1.0, 1.0)


@fast
def note(run: KnownRun, w: World, switch_slots: NDArray[np.int64]) -> None:
    n = w.ninja
    row = run.moves[w.tick]
    row[0] = n.x
    row[1] = n.y
    row[2] = n.x - n.prev_x
    row[3] = n.y - n.prev_y
    run.masks[w.tick] = open_mask(w, switch_slots)
    run.gold[w.tick] = w.gold


@kernel
def play_known(start: Start, run: KnownRun, switch_slots: NDArray[np.int64], until: int, noted: int) -> int:
    """Play the run's keys from the start to before tick ``until``, noted if that is 1; the ticks played."""
    w = start.worlds[1]
    copy_words(start.scratch, start.initial)
    if noted:
        note(run, w, switch_slots)
    for tick in range(until):
        step(start.levels[0], w, with_press_bit(run.keys[tick], w.ninja.jump_held))
        if noted:
            note(run, w, switch_slots)
        if w.outcome != OUTCOME_RUNNING:
            return tick + 1
    return until


@fast
def nearest(run: KnownRun, w: World, mask: int) -> tuple[int, float]:
    """The row of the run that is most like this moment, and the ticks ahead from there, price included."""
    n = w.ninja
    ticks = len(run.keys)
    vx = n.x - n.prev_x
    vy = n.y - n.prev_y
    best = -1
    least = UNREACHED
    k = min(ticks, w.tick + AHEAD)
    last = max(0, w.tick - BEHIND)
    while k > last and ticks - k < least:
        k -= 1
        dx = abs(n.x - run.moves[k, 0])  # a row by itself would be an object, counted for each k
        dy = abs(n.y - run.moves[k, 1])
        too_far = max(dx, dy) - run.max_distance
        if too_far > 0.0:
            k -= int(too_far / run.most_moved)
        elif run.masks[k] == mask and run.gold[k] <= w.gold:
            run_vx = run.moves[k, 2]
            run_vy = run.moves[k, 3]
            way = sqrt(run_vx * run_vx + run_vy * run_vy)
            price = sqrt(dx * dx + dy * dy) * run.place_price / max(way, SLOW)
            price += (abs(vx - run_vx) + abs(vy - run_vy)) * run.speed_price
            if ticks - k + price <= least:
                least = ticks - k + price
                best = k
    return best, least
