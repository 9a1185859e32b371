"""Rewards: terms that are added up, each with its weight.

>>> [term.weight for term in reward_terms(None)]
[1.0]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ninja_game.errors import ArgumentError


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

    The ticks are those of the solver's distance fields (`goal_distance.py`). Φ is 0 at the start, about 1 before the
    exit, never below -1, and counts as 0 where the episode terminates; so a death takes back what was gained. Where a
    level's start has no way to the exit, Φ is 0.

    It keeps the optimum: along any episode the discounted sum of these terms telescopes to -Φ(s₀) = 0 times ``weight``
    at the terminal state, whatever was done, so every policy's return changes by the same constant (Ng, Harada, Russell
    1999). This needs ``discount`` to be the one with which the agent learns, per step, not per tick.
    """

    weight: float = 1.0
    discount: float = 0.99


RewardTerm: TypeAlias = ExitReward | DeathPenalty | GoldReward | TimePenalty | DistanceShaping
REWARD_TERMS = (ExitReward, DeathPenalty, GoldReward, TimePenalty, DistanceShaping)


def reward_terms(reward: RewardTerm | Sequence[RewardTerm] | None) -> list[RewardTerm]:
    """The terms that are meant: one, several, or None for the sparse reward. Raises ArgumentError for anything else."""
    if reward is None:
        return [ExitReward()]
    terms = list(reward) if isinstance(reward, Sequence) else [reward]
    wrong = [term for term in terms if type(term) not in REWARD_TERMS]
    if wrong:
        expected = ", ".join(kind.__name__ for kind in REWARD_TERMS)
        raise ArgumentError(f"a term of the reward is {wrong[0]!r:.60}; expected one of {expected}")
    return terms


def weights_of(terms: Sequence[RewardTerm]) -> list[float]:
    """What an exit, a death, a piece of gold and a tick are worth to terms; shaping is none of these."""
    worth = dict.fromkeys(REWARD_TERMS, 0.0)
    for term in terms:
        worth[type(term)] += term.weight
    return [worth[ExitReward], -worth[DeathPenalty], worth[GoldReward], -worth[TimePenalty]]
