"""Rewards: a weighted sum of terms.

>>> terms_of("gold")
[GoldReward(weight=0.01)]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Indices
from ninja_game.errors import ArgumentError
from ninja_game.learn.goal_distance import GoalDistance
from ninja_game.search.heuristics import FARTHEST


@dataclass(frozen=True)
class ExitReward:
    """``weight`` for reaching the exit."""

    weight: float = 1.0


@dataclass(frozen=True)
class DeathPenalty:
    """-``weight`` for dying."""

    weight: float = 1.0


@dataclass(frozen=True)
class GoldReward:
    """``weight`` for each piece of gold."""

    weight: float = 0.01


@dataclass(frozen=True)
class TimePenalty:
    """-``weight`` for each tick (1/40 s)."""

    weight: float = 0.0001


@dataclass(frozen=True)
class DistanceShaping:
    """``weight`` times (``discount`` Φ(s') - Φ(s)), where Φ(s) = 1 - ticks to the exit from s / ticks from the start.

    The ticks come from the solver's distance fields (`goal_distance.py`). Φ is 0 at the start, about 1 before the exit,
    never below -1, and 0 where the episode terminates; so a death takes back all gains. Φ is always 0 in a level whose
    start has no way to the exit.

    It keeps the optimum: along any episode the discounted sum of these terms telescopes to ``weight`` times -Φ(s₀) = 0
    at the terminal state, whatever the actions were, so every policy's return changes by the same constant (Ng, Harada,
    Russell 1999). ``discount`` must be the one with which the agent learns, per step, not per tick.
    """

    weight: float = 1.0
    discount: float = 0.99


RewardTerm: TypeAlias = ExitReward | DeathPenalty | GoldReward | TimePenalty | DistanceShaping
RewardLike: TypeAlias = RewardTerm | str
REWARD_TERMS: dict[str, type[RewardTerm]] = {
    "exit": ExitReward, "death": DeathPenalty, "gold": GoldReward, "time": TimePenalty, "distance": DistanceShaping
}  # fmt: skip
"""The terms, by name."""


def terms_of(reward: RewardLike | Sequence[RewardLike] | None) -> list[RewardTerm]:
    """Resolve terms: one, several, or None for the sparse reward; names mean terms with default weights.

    Raises ArgumentError for anything else.
    """
    several = isinstance(reward, Sequence) and not isinstance(reward, str)
    choices: Any = ["exit"] if reward is None else reward if several else [reward]
    terms = [REWARD_TERMS[term]() if isinstance(term, str) and term in REWARD_TERMS else term for term in choices]
    wrong = [term for term in terms if type(term) not in REWARD_TERMS.values()]
    if wrong:
        expected = ", ".join(f"{name!r} ({kind.__name__})" for name, kind in REWARD_TERMS.items())
        raise ArgumentError(f"a term of the reward is {wrong[0]!r:.60}; expected one of {expected}")
    return terms


def event_rewards(terms: Sequence[RewardTerm]) -> dict[str, float]:
    """The rewards of an exit, a death, a piece of gold and a tick, summed over the terms, without shaping."""
    worth = dict.fromkeys(REWARD_TERMS.values(), 0.0)
    for term in terms:
        worth[type(term)] += term.weight
    return {
        "exit_reward": worth[ExitReward], "death_reward": -worth[DeathPenalty],
        "gold_reward": worth[GoldReward], "tick_reward": -worth[TimePenalty],
    }  # fmt: skip


MIN_POTENTIAL = -1.0  # the lowest Φ: at least twice as far from the exit as the start


class Shaping:
    """Adds the shaping terms to the rewards of each step, and remembers Φ of every world for the next step."""

    def __init__(self, terms: Sequence[DistanceShaping], goal: GoalDistance) -> None:
        self._terms, self._goal = list(terms), goal
        self._potential = np.zeros(len(goal.ticks))

    def begin(self, indices: Indices) -> None:
        """Forget Φ of worlds that were reset or restored, since that earns no reward."""
        self._potential[indices] = self._measured(indices)

    def add(self, rewards: NDArray[np.float64], indices: Indices, terminated: NDArray[np.bool_]) -> None:
        """Add the shaping terms of the last step to ``rewards`` (n,), for the worlds ``indices`` (k,)."""
        before, now = self._potential[indices], self._measured(indices)
        after = np.where(terminated[indices], 0.0, now)
        for term in self._terms:
            rewards[indices] += term.weight * (term.discount * after - before)
        self._potential[indices] = now

    def _measured(self, indices: Indices) -> NDArray[np.float64]:
        ticks, start = self._goal.ticks[indices], self._goal.start[indices]
        there = (start > 0.0) & (start < FARTHEST)
        potential = 1.0 - ticks / np.where(there, start, 1.0)
        return np.where(there, np.maximum(potential, MIN_POTENTIAL), 0.0)
