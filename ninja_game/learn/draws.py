"""Random numbers by counting: draw e of a seed is a hash of both, so that it does not matter who draws when.

Each world has a stream of its own. So a vector of worlds plays what as many single ones play, with any number of
threads and whatever the order in which their episodes end.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Draws = NDArray[np.uint64]

_STEP = np.uint64(0x9E3779B97F4A7C15)
_FIRST, _SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)


def draws(seeds: Draws, episodes: Draws) -> Draws:
    """Draw ``episodes[k]`` of the stream ``seeds[k]``, (k,) uint64, uniform in 0 … 2^64 - 1 (SplitMix64, Steele 2014).

    >>> draws(np.array([0, 0], np.uint64), np.array([0, 1], np.uint64)).tolist()
    [5197578548964807871, 12035550249420947055]
    """
    return _mix(_mix(seeds + _STEP) + episodes * _STEP)


def _mix(state: Draws) -> Draws:
    """SplitMix64's output function: every bit of the state reaches every bit of the result."""
    state = (state ^ state >> np.uint64(30)) * _FIRST
    state = (state ^ state >> np.uint64(27)) * _SECOND
    return state ^ state >> np.uint64(31)
