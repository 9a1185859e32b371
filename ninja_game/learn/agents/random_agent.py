"""An agent that presses keys at random: the line that every other one must be above."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from ninja_game.learn.actions import ACTION_NAMES

KEPT = 0.8
"""Chance that a world keeps its action for another step: keys pressed again ten times a second lead nowhere."""


class RandomAgent:
    """Presses each of the six combinations of keys as often, for half a second on average."""

    settings: ClassVar[dict[str, Any]] = {}

    def __init__(self) -> None:
        self.reset(1, 0)

    def reset(self, count: int, seed: int) -> None:
        """Begin with ``count`` worlds."""
        self._chance = np.random.default_rng(seed)
        self._actions = self._chance.integers(len(ACTION_NAMES), size=count)

    def act(self, observations: Any) -> NDArray[np.int64]:  # noqa: ARG002 - as all agents
        """An action for each world, (n,), whatever is observed."""
        count = len(self._actions)
        drawn = self._chance.integers(len(ACTION_NAMES), size=count)
        self._actions = np.where(self._chance.random(count) < KEPT, self._actions, drawn)
        return self._actions
