"""A known run as a search along it sees it: per tick its place, velocity, keys and open switches.

A state of the search is compared with the most similar row of the run. Its *ahead* value: the ticks that the known run
still has from that row, plus a price for the difference.
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
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import OUTCOME_RUNNING
from ninja_game.sim.world import step

_AHEAD = 128  # ticks by which a moment may be ahead of the known run
_BEHIND = 24  # ticks by which a moment may be behind the known run
SLOW = 0.5  # px/tick; the least speed that a known run is given, even where it is slower


class KnownRun(NamedTuple):
    """A run of n ticks to the exit. Row k is the state after k ticks; row 0 is the start."""

    moves: NDArray[np.float64]  #: x, y (px), velocity (px/tick); (n + 1, 4)
    keys: Keys  #: keys of each tick, without triggers
    masks: NDArray[np.int64]  #: open switches, as bits
    gold: NDArray[np.int64]  #: pieces that a state must have collected by this row
    span: tuple[int, int]  #: first tick, and the tick after the last one, in which a search may be late
    max_delay: float  #: most ticks that it may be late
    max_distance: float  #: px in x, and px in y, by which a state may differ from its row
    place_price: float  #: price of a difference of place, in ticks per tick of the run's way
    speed_price: float  #: price of a difference of speed, in ticks per px/tick
    most_moved: float  #: most px between two rows, in x or y


def known_run(ticks: int, keys: bytes = b"") -> KnownRun:
    """Make room for a run of this many ticks, which ``play_known`` fills."""
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
def play_known(start: Start, run: KnownRun, switch_slots: NDArray[np.int64], until: int, recorded: int) -> int:
    """Play the run's keys from the start to before tick ``until``, recorded if ``recorded``; gives the ticks played."""
    w = start.worlds[1]
    copy_words(start.scratch, start.initial)
    if recorded:
        note(run, w, switch_slots)
    for tick in range(until):
        step(start.maps[0], w, with_press_bit(run.keys[tick], w.ninja.jump_held))
        if recorded:
            note(run, w, switch_slots)
        if w.outcome != OUTCOME_RUNNING:
            return tick + 1
    return until


@fast
def nearest_row(run: KnownRun, w: World, mask: int) -> tuple[int, float]:
    """The row of the run most like this moment, and the ticks ahead from there, with the price."""
    n = w.ninja
    ticks = len(run.keys)
    vx = n.x - n.prev_x
    vy = n.y - n.prev_y
    best = -1
    least = UNREACHED
    k = min(ticks, w.tick + _AHEAD)
    last = max(0, w.tick - _BEHIND)
    while k > last and ticks - k < least:
        k -= 1
        dx = abs(n.x - run.moves[k, 0])  # Numba would count references to a row object in every step of the loop
        dy = abs(n.y - run.moves[k, 1])
        too_far = max(dx, dy) - run.max_distance
        if too_far > 0.0:
            k -= int(too_far / run.most_moved)
        elif run.masks[k] == mask and run.gold[k] <= w.gold:
            run_vx = run.moves[k, 2]
            run_vy = run.moves[k, 3]
            pace = sqrt(run_vx * run_vx + run_vy * run_vy)
            price = sqrt(dx * dx + dy * dy) * run.place_price / max(pace, SLOW)
            price += (abs(vx - run_vx) + abs(vy - run_vy)) * run.speed_price
            if ticks - k + price <= least:
                least = ticks - k + price
                best = k
    return best, least
