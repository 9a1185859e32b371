"""Random numbers by counting: draw e of a seed is a hash of both, so that it does not matter who draws when.

Each world has a stream of its own. So a vector of worlds plays what as many single ones play, with any number of
threads and whatever the order in which their episodes end.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Indices
from ninja_game.batch.thread_pool import whole_number
from ninja_game.errors import ArgumentError
from ninja_game.learn.levels.source import LevelChoice, LevelSource

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


class LevelSequences:
    """Which levels ``count`` worlds play, episode after episode: what their seeds draw of a source."""

    def __init__(self, source: LevelSource, count: int) -> None:
        self._source = source
        self._seeds, self._episodes = np.arange(count, dtype=np.uint64), np.zeros(count, np.uint64)

    def seed(self, worlds: Indices, seeds: Sequence[int]) -> None:
        """Begin the sequences of these seeds. Raises ArgumentError for another number of them and for other seeds."""
        if len(seeds) != len(worlds):
            raise ArgumentError(f"{len(seeds)} seeds for {len(worlds)} worlds; expected one for each")
        self._seeds[worlds] = [checked_seed(seed) for seed in seeds]
        self._episodes[worlds] = 0

    def next(self, worlds: Indices, chosen: LevelChoice | None) -> tuple[Indices, Draws]:
        """The numbers of the levels of the next episodes of these worlds, drawn or ``chosen``; either is an episode.

        And of each episode another random number, for what is drawn in it.
        """
        drawn = draws(self._seeds[worlds], self._episodes[worlds])
        self._episodes[worlds] += np.uint64(1)
        levels = self._source.choose(drawn) if chosen is None else self._source.numbers(chosen, len(worlds))
        return levels, _mix(drawn + _STEP)


def checked_seed(seed: object) -> int:
    """A seed as Python's own number. Raises ArgumentError for anything but a whole number of 64 bits."""
    return whole_number("the seed", seed, 0, 2**64 - 1)
