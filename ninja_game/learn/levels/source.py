"""Levels, and which of them an episode is played in.

What is drawn, is drawn by counting: draw e of a seed is a hash of both, and each world has a stream of its own. So a
vector of worlds plays what as many single ones play, with any number of threads and whatever the order in which their
episodes end.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from difflib import get_close_matches
from hashlib import sha256
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Indices
from ninja_game.batch.thread_pool import whole_number
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.sim.level import Level

LevelChoice: TypeAlias = str | int | Sequence[str | int] | NDArray[np.integer]
"""Levels of a source, by name or number."""


class LevelSource:
    """Levels with their names; each is as likely as any other. ``names`` and ``levels`` are lists of one length.

    Names that are there twice get a number: "level#0", "level#1".
    """

    levels: Sequence[Level]
    largest: Level | None = None
    """Where there are too many levels to hold (`bench.py`), one with as many objects as any of them."""

    def __init__(self, names: Sequence[str], levels: Sequence[Level]) -> None:
        if not levels or len(names) != len(levels):
            raise ArgumentError(f"{len(names)} names for {len(levels)} levels; expected at least one level, named")
        count = Counter(names)
        seen: Counter[str] = Counter()
        self.names = []
        for name in names:
            self.names.append(f"{name}#{seen[name]}" if count[name] > 1 else name)
            seen[name] += 1
        self.levels = list(levels)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {len(self.levels)} levels: {', '.join(self.names):.60}>"

    def choose(self, draws: NDArray[np.uint64]) -> NDArray[np.intp]:
        """The number of the level of each episode, (k,), by a random number of 64 bits for each."""
        return (draws % np.uint64(len(self.levels))).astype(np.intp)

    def report(self, numbers: NDArray[np.intp], passed: NDArray[np.bool_]) -> None:
        """Take note of episodes that have ended: the numbers of their levels (k,), whether they were passed (k,)."""

    def numbers(self, which: LevelChoice, count: int = 1) -> NDArray[np.intp]:
        """The numbers (count,) of levels chosen by name or number, one for all or one for each.

        Raises ArgumentError for others.
        """
        chosen = list(which) if isinstance(which, Sequence | np.ndarray) and not isinstance(which, str) else [which]
        found = [self.names.index(each) if isinstance(each, str) and each in self.names else each for each in chosen]
        for each in found:
            if not isinstance(each, int | np.integer) or not 0 <= each < len(self.levels):
                expected = f"0 to {len(self.levels) - 1} or a name: {nearest(str(each), self.names)}"
                raise ArgumentError(f"there is no level {each!r:.60}; expected {expected}")
        if len(found) not in (1, count):
            raise ArgumentError(f"{len(found)} levels for {count} worlds; expected one, or one for each")
        return np.resize(np.array(found, np.intp), count)

    @property
    def digest(self) -> str:
        """Sha256 (hex) of the levels in their order: equal for equal levels, whatever they are called."""
        return sha256("".join(map(level_digest, self.levels)).encode()).hexdigest()


def nearest(word: str, words: Sequence[str]) -> str:
    """Words like one that is not known, or the first of all, to be told."""
    return ", ".join(get_close_matches(word, words, 3, 0.5) or words[:3])


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
