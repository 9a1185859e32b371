"""Levels, and which of them an episode is played in."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from difflib import get_close_matches
from hashlib import sha256
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

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
