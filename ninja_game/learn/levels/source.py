"""Sources of levels, the choice of the level of an episode, and a curriculum that begins with the easiest levels.

Random numbers are counted: draw e of a seed is a hash of both, and each world has its own stream. So a vector of worlds
plays the same levels as as many single worlds, with any number of threads and in whatever order episodes end.
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
from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import read_text
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.pack import PARS
from ninja_game.formats.pack.pars import DIGEST_DIGITS, parse_pars
from ninja_game.sim.level import Level

ChosenLevels: TypeAlias = str | int | Sequence[str | int] | NDArray[np.integer]  # levels of a source, by name or number


class LevelSource:
    """Levels with their names, all equally likely. ``names`` and ``levels`` are lists of one length.

    Repeated names get a number: "level#0", "level#1".
    """

    levels: Sequence[Level]
    #: If there are too many levels to hold (`bench.py`): one with as many objects as any of them
    largest: Level | None = None

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

    def choose(self, drawn: NDArray[np.uint64]) -> NDArray[np.intp]:
        """Choose the number of the level of each episode, (k,), by a random number of 64 bits for each."""
        return (drawn % np.uint64(len(self.levels))).astype(np.intp)

    def report(self, numbers: NDArray[np.intp], passed: NDArray[np.bool_]) -> None:
        """Learn from episodes that have ended: the numbers of their levels (k,), whether they were passed (k,)."""

    def numbers(self, choice: ChosenLevels, count: int = 1) -> NDArray[np.intp]:
        """The numbers (count,) of levels chosen by name or number, one for all or one for each.

        Raises ArgumentError for unknown levels.
        """
        chosen = list(choice) if isinstance(choice, Sequence | np.ndarray) and not isinstance(choice, str) else [choice]
        numbers = [self.names.index(name) if isinstance(name, str) and name in self.names else name for name in chosen]
        for level in numbers:
            if not isinstance(level, int | np.integer) or not 0 <= level < len(self.levels):
                expected = f"0 to {len(self.levels) - 1} or a name: {word_like(str(level), self.names)}"
                raise ArgumentError(f"there is no level {level!r:.60}; expected {expected}")
        if len(numbers) not in (1, count):
            raise ArgumentError(f"{len(numbers)} levels for {count} worlds; expected one, or one for each")
        return np.resize(np.array(numbers, np.intp), count)

    @property
    def digest(self) -> str:
        """Sha256 (hex) of the levels in their order, whatever their names are."""
        return sha256("".join(map(level_digest, self.levels)).encode()).hexdigest()


def word_like(word: str, words: Sequence[str]) -> str:
    """The known words most like an unknown one, else the first words; for error messages."""
    return ", ".join(get_close_matches(word, words, 3, 0.5) or words[:3])


Uint64s = NDArray[np.uint64]

_STEP = np.uint64(0x9E3779B97F4A7C15)
_FIRST, _SECOND = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)


def draws(seeds: Uint64s, episodes: Uint64s) -> Uint64s:
    """Draw ``episodes[k]`` of the stream ``seeds[k]``, (k,) uint64, uniform in 0 … 2^64 - 1 (SplitMix64, Steele 2014).

    >>> draws(np.array([0, 0], np.uint64), np.array([0, 1], np.uint64)).tolist()
    [5197578548964807871, 12035550249420947055]
    """
    return _mix(_mix(seeds + _STEP) + episodes * _STEP)


def _mix(state: Uint64s) -> Uint64s:
    """SplitMix64's output function: every bit of the state affects every bit of the result."""
    state = (state ^ state >> np.uint64(30)) * _FIRST
    state = (state ^ state >> np.uint64(27)) * _SECOND
    return state ^ state >> np.uint64(31)


class LevelSequences:
    """The levels that ``count`` worlds play, episode after episode, drawn from a source by their seeds."""

    def __init__(self, source: LevelSource, count: int) -> None:
        self._source = source
        self._seeds, self._episodes = np.arange(count, dtype=np.uint64), np.zeros(count, np.uint64)

    def seed(self, worlds: Indices, seeds: Sequence[int]) -> None:
        """Begin the sequences of these seeds. Raises ArgumentError for a wrong number of seeds or invalid seeds."""
        if len(seeds) != len(worlds):
            raise ArgumentError(f"{len(seeds)} seeds for {len(worlds)} worlds; expected one for each")
        self._seeds[worlds] = [checked_seed(seed) for seed in seeds]
        self._episodes[worlds] = 0

    def next(self, worlds: Indices, chosen: ChosenLevels | None) -> tuple[Indices, Uint64s]:
        """The numbers of the levels of these worlds' next episodes, drawn or ``chosen``; both count as an episode.

        Also another random number per episode, for draws in it.
        """
        drawn = draws(self._seeds[worlds], self._episodes[worlds])
        self._episodes[worlds] += np.uint64(1)
        levels = self._source.choose(drawn) if chosen is None else self._source.numbers(chosen, len(worlds))
        return levels, _mix(drawn + _STEP)


def checked_seed(seed: object) -> int:
    """A seed as a Python int. Raises ArgumentError for anything but a whole number of 64 bits."""
    return whole_number("the seed", seed, 0, 2**64 - 1)


UNPASSED_WEIGHT = 0.1
"""Added to the share of failures, so that a level that is always passed is still played now and then."""


class Curriculum(LevelSource):
    """The levels of a source by difficulty, of which only the first ``open`` are played.

    ``rates`` (levels,): the share of passed episodes of each level, an exponential average over about ``memory``
    episodes, from 0. While its mean over the open levels is at least ``threshold``, the next level opens. Open levels
    with more failures are chosen more often, in proportion to 1.1 - rate.

    ``difficulties``: one per level; None: those in the table of the game's levels (docs/making-levels.md). ``start``:
    number of levels open at first. Raises ArgumentError for anything but a source, and for an unknown difficulty.
    """

    def __init__(
        self,
        source: LevelSource,
        *,
        difficulties: Sequence[float] | None = None,
        start: int = 3,
        threshold: float = 0.5,
        memory: float = 20.0,
    ) -> None:
        if not isinstance(source, LevelSource) or source.largest is not None:
            raise ArgumentError(
                f"found {source!r:.60}; expected a LevelSource that holds its levels, such as level_source('train')"
            )
        measured = measured_difficulties(source) if difficulties is None else difficulties
        if len(measured) != len(source.levels) or start < 1 or not 0.0 < threshold < 1.0 or memory < 1.0:
            found = f"{len(measured)} difficulties for {len(source.levels)} levels, {start=}, {threshold=}, {memory=}"
            raise ArgumentError(f"{found}; expected one for each level, start >= 1, 0 < threshold < 1, memory >= 1")
        order = np.argsort(np.asarray(measured, np.float64), kind="stable").tolist()
        super().__init__([source.names[k] for k in order], [source.levels[k] for k in order])
        self.difficulties = [float(measured[k]) for k in order]
        self.threshold = threshold
        self.memory = memory
        self.open = min(start, len(order))
        self.rates = np.zeros(len(order))

    def choose(self, drawn: NDArray[np.uint64]) -> NDArray[np.intp]:
        """Choose the number of the level of each episode, (k,), by a random number of 64 bits for each."""
        shares = np.cumsum(1.0 + UNPASSED_WEIGHT - self.rates[: self.open])
        chosen: NDArray[np.intp] = np.searchsorted(shares, drawn / 2.0**64 * shares[-1], side="right")
        return np.minimum(chosen, self.open - 1)

    def report(self, numbers: NDArray[np.intp], passed: NDArray[np.bool_]) -> None:
        """Learn from episodes that have ended; open further levels if the open ones are passed often enough."""
        episodes = np.bincount(numbers, minlength=len(self.levels))
        passes = np.bincount(numbers[passed], minlength=len(self.levels))
        kept = (1.0 - 1.0 / self.memory) ** episodes
        self.rates = self.rates * kept + passes / np.maximum(episodes, 1) * (1.0 - kept)
        while self.open < len(self.levels) and self.rates[: self.open].mean() >= self.threshold:
            self.open += 1


def measured_difficulties(source: LevelSource) -> list[float]:
    """The difficulties of levels in the table of the game's own levels. Raises ArgumentError for other levels."""
    pars = parse_pars(read_text(data_folder("levels") / PARS)).values()
    known = {par.level: par.difficulty for par in pars if par.difficulty is not None}
    digests = [level_digest(level)[:DIGEST_DIGITS] for level in source.levels]
    unknown = [name for name, digest in zip(source.names, digests, strict=True) if digest not in known]
    if unknown:
        hint = "give `difficulties`, or take levels of the game"
        raise ArgumentError(f"the difficulty of {', '.join(unknown[:3])} is not known; {hint}")
    return [known[digest] for digest in digests]
