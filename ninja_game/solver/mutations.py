"""Small random changes of a run's inputs: what a speedrunner tries by hand. Inputs here have no trigger bit.

Rows of keys are moved, stretched, cut out, doubled or overwritten. Each edit works on ``keys[:length]`` in place and
answers (first changed tick, by how many ticks what follows has moved forward).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN
from ninja_game.sim.memory.declare import fast
from ninja_game.solver.search_memory import RandomState, random_below

Keys = NDArray[np.uint8]

ALL_KEYS = 7


@fast
def cut(keys: Keys, length: int, tick: int, count: int) -> None:
    """Leave ticks out; what follows moves forward, the last input is repeated at the end."""
    for k in range(tick, length):
        keys[k] = keys[min(k + count, length - 1)]


@fast
def stretch(keys: Keys, length: int, tick: int, count: int) -> None:
    """Repeat the input of a tick; what follows moves back."""
    for k in range(length - 1, tick + count - 1, -1):
        keys[k] = keys[k - count]
    for k in range(tick + 1, min(tick + count, length)):
        keys[k] = keys[tick]


@fast
def overwrite(keys: Keys, length: int, start: int, end: int, mask: int, value: int) -> None:
    """Set some keys in the ticks from start to before end."""
    for k in range(max(start, 0), min(end, length)):
        keys[k] = (keys[k] & (ALL_KEYS - mask)) | value


@fast
def next_change(keys: Keys, length: int, tick: int, mask: int) -> int:
    """The first tick after ``tick`` whose keys under the mask differ from the tick before; ``length`` if none."""
    for k in range(tick + 1, length):
        if (keys[k] ^ keys[k - 1]) & mask:
            return k
    return length


@fast
def shift_boundary(keys: Keys, length: int, tick: int, mask: int, by: int) -> int:
    """Move the next change of some keys earlier or later; the first changed tick."""
    change = next_change(keys, length, tick, mask)
    if change >= length:
        return length
    before = keys[change - 1] & mask
    after = keys[change] & mask
    if by < 0:
        overwrite(keys, length, change + by, change, mask, after)
        return max(change + by, 0)
    overwrite(keys, length, change, change + by, mask, before)
    return change


@fast
def shift_pulse(keys: Keys, length: int, tick: int, by: int) -> int:
    """Move the next jump as a whole; the first changed tick."""
    start = next_change(keys, length, tick, JUMP_HELD)
    if start < length and not keys[start] & JUMP_HELD:
        start = next_change(keys, length, start, JUMP_HELD)
    if start >= length:
        return length
    end = next_change(keys, length, start, JUMP_HELD)
    overwrite(keys, length, start, end, JUMP_HELD, 0)
    overwrite(keys, length, start + by, end + by, JUMP_HELD, JUMP_HELD)
    return max(min(start, start + by), 0)


@fast
def mutate(keys: Keys, length: int, tick: int, source: RandomState) -> tuple[int, int]:
    """One random edit at or after a tick."""
    kind = random_below(source, 12)
    by = 1 + random_below(source, 2 if random_below(source, 2) else 8)
    sign = 1 if random_below(source, 2) else -1
    if kind == 0:
        cut(keys, length, tick, min(by, 3))
        return tick, min(by, 3)
    if kind == 1:
        stretch(keys, length, tick, min(by, 3))
        return tick, -min(by, 3)
    if kind == 2:
        # Some ticks less here, as many more a little later: what lies between comes earlier.
        other = min(tick + 1 + random_below(source, 60), length - 1)
        if sign > 0:
            cut(keys, length, tick, by)
            stretch(keys, length, other, by)
        else:
            stretch(keys, length, tick, by)
            cut(keys, length, min(other + by, length - 1), by)
        return tick, 0
    if kind <= 4:
        return shift_boundary(keys, length, tick, 3, sign * by), 0
    if kind <= 6:
        return shift_boundary(keys, length, tick, JUMP_HELD, sign * by), 0
    if kind <= 8:
        return shift_pulse(keys, length, tick, sign * by), 0
    span = 1 + random_below(source, 4 if random_below(source, 2) else 24)
    if kind == 9:
        overwrite(keys, length, tick, tick + span, 3, random_below(source, 3))
    elif kind == 10:
        overwrite(keys, length, tick, tick + span, JUMP_HELD, JUMP_HELD * random_below(source, 2))
    else:
        overwrite(
            keys,
            length,
            tick,
            tick + span,
            KEYS_DOWN,
            random_below(source, 3) + JUMP_HELD * random_below(source, 2),
        )
    return tick, 0
