"""The terms of a reward that look at the distance to the exit, before and after a step (``DistanceShaping``)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Indices
from ninja_game.learn.goal_distance import GoalDistance
from ninja_game.learn.rewards import DistanceShaping
from ninja_game.search.heuristics import FARTHEST

LOWEST = -1.0
"""Of Φ: twice as far as at the start, or farther."""


class Shaping:
    """Adds the terms to the rewards of each step, and remembers Φ of every world from one step to the next."""

    def __init__(self, terms: Sequence[DistanceShaping], goal: GoalDistance) -> None:
        self._terms, self._goal = list(terms), goal
        self._potential = np.zeros(len(goal.ticks))

    def begin(self, which: Indices) -> None:
        """These worlds are somewhere else now: no reward for that."""
        self._potential[which] = self._measured(which)

    def add(self, rewards: NDArray[np.float64], which: Indices, terminated: NDArray[np.bool_]) -> None:
        """Add what the last step of these worlds is worth."""
        before, now = self._potential[which], self._measured(which)
        after = np.where(terminated[which], 0.0, now)
        for term in self._terms:
            rewards[which] += term.weight * (term.discount * after - before)
        self._potential[which] = now

    def _measured(self, which: Indices) -> NDArray[np.float64]:
        ticks, start = self._goal.ticks[which], self._goal.start[which]
        there = (start > 0.0) & (start < FARTHEST)
        potential = 1.0 - ticks / np.where(there, start, 1.0)
        return np.where(there, np.maximum(potential, LOWEST), 0.0)
