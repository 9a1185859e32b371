"""A curriculum: levels from the easiest on, by measured difficulty; the next one opens when those open are passed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError
from ninja_game.files.reading import read_text
from ninja_game.files.user_folder import data_folder
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.files import PARS
from ninja_game.formats.pack.pars import DIGITS, parse_pars
from ninja_game.learn.levels.source import LevelSource

UNPASSED_WEIGHT = 0.1
"""What is added to the share of failures: so a level that is always passed is still played now and then."""


class Curriculum(LevelSource):
    """The levels of a source in the order of their difficulty, of which the first ``open`` are played.

    ``rates`` (levels,): the share of each level's episodes that were passed, an exponential average over about
    ``memory`` of them, from 0. As long as its mean over the open levels is ``threshold`` or more, the next one opens.
    Of the open levels those with more failures are chosen more often, in proportion to 1.1 - rate.

    ``difficulties``: one for each level; None: those in the table of the game's levels (docs/making-levels.md).
    ``start``: how many are open at first. Raises ArgumentError for what is not a source, and
    for a level whose difficulty is not known.
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

    def choose(self, draws: NDArray[np.uint64]) -> NDArray[np.intp]:
        """The number of the level of each episode, (k,), by a random number of 64 bits for each."""
        shares = np.cumsum(1.0 + UNPASSED_WEIGHT - self.rates[: self.open])
        chosen: NDArray[np.intp] = np.searchsorted(shares, draws / 2.0**64 * shares[-1], side="right")
        return np.minimum(chosen, self.open - 1)

    def report(self, numbers: NDArray[np.intp], passed: NDArray[np.bool_]) -> None:
        """Take note of episodes that have ended; open further levels if those open are passed often enough."""
        episodes = np.bincount(numbers, minlength=len(self.levels))
        passes = np.bincount(numbers[passed], minlength=len(self.levels))
        kept = (1.0 - 1.0 / self.memory) ** episodes
        self.rates = self.rates * kept + passes / np.maximum(episodes, 1) * (1.0 - kept)
        while self.open < len(self.levels) and self.rates[: self.open].mean() >= self.threshold:
            self.open += 1


def measured_difficulties(source: LevelSource) -> list[float]:
    """The difficulties of levels as the table of the game's own levels has them. Raises ArgumentError for others."""
    pars = parse_pars(read_text(data_folder("levels") / PARS)).values()
    known = {each.level: each.difficulty for each in pars if each.difficulty is not None}
    digests = [level_digest(level)[:DIGITS] for level in source.levels]
    unknown = [name for name, digest in zip(source.names, digests, strict=True) if digest not in known]
    if unknown:
        hint = "give `difficulties`, or take levels of the game"
        raise ArgumentError(f"the difficulty of {', '.join(unknown[:3])} is not known; {hint}")
    return [known[digest] for digest in digests]
