"""The evaluated task: what makes episodes differ though the world knows no chance, and how long they may take.

An episode begins with some steps with no key down, and a step now and then plays the keys of the step before once more.

Machado, Bellemare, Talvitie, Veness, Hausknecht, Bowling, "Revisiting the Arcade Learning Environment", 2018: so an
agent must look at where it is; a list of actions learnt by heart fails.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.memory.declare import fast

REPEAT = 0.25
"""Chance that a step plays the keys of the step before once more instead of those that were chosen."""
MAX_WAIT = 7
"""Steps at most that an episode begins with no key down; how many is drawn again for each episode, from 0 on."""
TIME_LIMIT = 2000  # ticks, 50 s: longer than any certificate to the exit of the set
EVALUATION_SEED = 1_000_000  # the first seed of evaluations; agents are trained with seeds below it

PROTOCOL: dict[str, Any] = {"repeat": REPEAT, "longest_wait": MAX_WAIT, "time_limit": TIME_LIMIT}
"""What ``evaluate`` and the environments of the benchmark set."""

CHANCES = 2**32  # kernels take a probability as a whole number of this many parts


def draw_starts(drawn: NDArray[np.uint64], longest_wait: int) -> NDArray[np.int64]:
    """For episodes that begin, by a random number of 64 bits each: steps of waiting, first state of ``next_random``."""
    high, low = np.divmod(drawn, np.uint64(CHANCES))
    return np.stack([high % np.uint64(longest_wait + 1), low % np.uint64(CHANCES - 1) + np.uint64(1)]).astype(np.int64)


@fast
def next_random(state: int) -> int:
    """The number after another, 1 to 2^32 - 1 (Marsaglia, "Xorshift RNGs", 2003)."""
    state ^= (state << 13) & 0xFFFFFFFF
    state ^= state >> 17
    return state ^ (state << 5) & 0xFFFFFFFF
