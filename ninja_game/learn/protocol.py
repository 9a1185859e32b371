"""The evaluated task: randomness of the episodes, since the world itself has none, and their time limit.

An episode begins with some steps without keys, and now and then a step repeats the keys of the previous step.

So an agent must react to its observations; a list of actions learnt by heart fails (Machado, Bellemare, Talvitie,
Veness, Hausknecht, Bowling, "Revisiting the Arcade Learning Environment", 2018).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.schema.declare import fast

REPEAT = 0.25  # chance that a step repeats the keys of the previous step instead of the chosen ones
MAX_WAIT = 7  # most steps without keys at the start of an episode; a new number is drawn for each episode, from 0 on
TIME_LIMIT = 2000  # ticks, 50 s: longer than any certificate to the exit of the set
EVALUATION_SEED = 1_000_000  # the first seed of evaluations; agents are trained with seeds below it

PROTOCOL: dict[str, Any] = {"repeat": REPEAT, "longest_wait": MAX_WAIT, "time_limit": TIME_LIMIT}
"""The settings of ``evaluate`` and of the environments of the benchmark."""

CHANCES = 2**32  # kernels take a probability as a whole number of this many parts


def draw_starts(drawn: NDArray[np.uint64], longest_wait: int) -> NDArray[np.int64]:
    """Draw, from a random number of 64 bits per episode, its waiting steps and the first state of ``next_random``."""
    high, low = np.divmod(drawn, np.uint64(CHANCES))
    return np.stack([high % np.uint64(longest_wait + 1), low % np.uint64(CHANCES - 1) + np.uint64(1)]).astype(np.int64)


@fast
def next_random(state: int) -> int:
    """The random number that follows ``state``, 1 to 2^32 - 1 (Marsaglia, "Xorshift RNGs", 2003)."""
    state ^= (state << 13) & 0xFFFFFFFF
    state ^= state >> 17
    return state ^ (state << 5) & 0xFFFFFFFF
