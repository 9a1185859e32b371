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


RewardTerm: TypeAlias = ExitReward | DeathPenalty | GoldReward | TimePenalty
REWARD_TERMS = (ExitReward, DeathPenalty, GoldReward, TimePenalty)


def reward_terms(reward: RewardTerm | Sequence[RewardTerm] | None) -> list[RewardTerm]:
    """The terms that are meant: one, several, or None for the sparse reward. Raises ArgumentError for anything else."""
    if reward is None:
        return [ExitReward()]
    terms = [reward] if isinstance(reward, REWARD_TERMS) else list(reward)
    wrong = [term for term in terms if type(term) not in REWARD_TERMS]
    if wrong:
        expected = ", ".join(kind.__name__ for kind in REWARD_TERMS)
        raise ArgumentError(f"a term of the reward is {wrong[0]!r:.60}; expected one of {expected}")
    return terms


def weights_of(terms: Sequence[RewardTerm]) -> list[float]:
    """What an exit, a death, a piece of gold and a tick are worth."""
    worth = {ExitReward: 0.0, DeathPenalty: 0.0, GoldReward: 0.0, TimePenalty: 0.0}
    for term in terms:
        worth[type(term)] += term.weight
    return [worth[ExitReward], -worth[DeathPenalty], worth[GoldReward], -worth[TimePenalty]]
