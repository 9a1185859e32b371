"""Episodes that differ, though the world knows no chance: sticky actions, and a start that waits.

Machado, Bellemare, Talvitie, Veness, Hausknecht, Bowling, "Revisiting the Arcade Learning Environment", 2018: so an
agent must look at where it is; a list of actions learnt by heart fails.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.learn.actions import ACTION_NAMES

REPEAT = 0.25
"""Chance that a world gets the action of the step before once more instead of the one that was chosen."""
LONGEST_WAIT = 7
"""Steps at most that an episode begins with no key down; how many is drawn again for each episode, from 0 on."""

NONE = ACTION_NAMES.index("none")


class StickyActions:
    """Turns the discrete actions that were chosen into those that are played. The same seed draws the same.

    >>> sticky = StickyActions(2, seed=0, longest_wait=0)
    >>> [sticky.played([5, 0]).tolist() for _ in range(4)]
    [[5, 0], [5, 0], [5, 0], [5, 0]]
    """

    def __init__(self, count: int, seed: Any, *, repeat: float = REPEAT, longest_wait: int = LONGEST_WAIT) -> None:
        self._rng = np.random.default_rng(seed)
        self._repeat = repeat
        self._longest_wait = longest_wait
        self._last = np.full(count, NONE)
        self._waits = np.zeros(count, np.int64)
        self.begin(np.arange(count))

    def begin(self, worlds: NDArray[np.intp], *, wait: bool = True) -> None:
        """New episodes begin in these worlds; without ``wait`` at once."""
        self._last[worlds] = NONE
        self._waits[worlds] = self._rng.integers(self._longest_wait + 1, size=len(worlds)) if wait else 0

    def played(self, actions: Any) -> NDArray[np.int64]:
        """The actions of a step, (n,)."""
        again = self._rng.random(len(self._last)) < self._repeat
        self._last = np.where(again, self._last, actions)
        self._last[self._waits > 0] = NONE
        self._waits = np.maximum(self._waits - 1, 0)
        return self._last.copy()
