"""The moments that a search remembers: a save-state each, what it promises, and how it was reached."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.learn.worlds import EnvState, EnvWorlds
from ninja_game.sim.level import Level

Numbers = NDArray[np.intp]
Actions = NDArray[np.uint8]

TICK_WEIGHT = 0.5
"""What a tick played counts beside a tick to go: less, so that the search is drawn to the exit."""
VISIT_WEIGHT = 25.0
"""Ticks that each walk from a moment counts against it, so that others have their turn."""
NOISE = 10.0


class Archive:
    """Up to ``size`` moments of a level, each saved in a world of an environment that is never stepped.

    How a moment was reached is a chain of *legs*: the actions since the moment before.
    """

    def __init__(self, level: Level, size: int, settings: dict[str, Any]) -> None:
        self._worlds = EnvWorlds([level], size, goal_distance=True, **settings)
        self._size = size
        self._used = 0
        self._promise = np.full(size, np.inf)
        self._visits = np.zeros(size)
        self._leg = np.zeros(size, np.intp)
        self._before: list[int] = []
        self._actions: list[bytes] = []
        self._walking: Numbers = np.full(1, -1, np.intp)
        self._since: Numbers = np.zeros(1, np.intp)

    def choose(self, count: int, rng: np.random.Generator) -> EnvState:
        """The states from which ``count`` walks begin: the most promising moments that were least walked from."""
        score = self._score()[: self._used] + NOISE * rng.random(self._used)
        if self._used > count:
            chosen = np.argpartition(score, count)[:count]
        else:
            chosen = np.resize(np.argsort(score), count)
        np.add.at(self._visits, chosen, 1.0)
        self._walking = self._leg[chosen]
        self._since = np.zeros(count, np.intp)
        return self._worlds.save(chosen)

    def add(self, walkers: EnvWorlds, which: Numbers, walk: Actions) -> None:
        """Remember the moments in which the walkers ``which`` are; ``walk``: their actions, (steps, walkers)."""
        if not which.size:
            return
        if len(self._walking) != walkers.count:
            self._walking, self._since = np.full(walkers.count, -1, np.intp), np.zeros(walkers.count, np.intp)
        assert walkers.goal  # noqa: S101 - `goal_distance` makes it
        places = self._room(len(which))
        self._worlds.restore(walkers.save(which), places)
        self._promise[places] = walkers.goal.ticks[which] + TICK_WEIGHT * walkers.ticks[which]
        self._visits[places] = 0.0
        for world in which.tolist():
            self._before.append(int(self._walking[world]))
            self._actions.append(walk[self._since[world] :, world].tobytes())
        self._leg[places] = self._walking[which] = np.arange(len(self._before) - len(which), len(self._before))
        self._since[which] = len(walk)

    def path(self, walker: int, walk: Actions) -> Actions:
        """All actions from the start of the level to where a walker is."""
        parts = [walk[self._since[walker] :, walker].tobytes()]
        leg = int(self._walking[walker])
        while leg >= 0:
            parts.append(self._actions[leg])
            leg = self._before[leg]
        return np.frombuffer(b"".join(reversed(parts)), np.uint8)

    def _score(self) -> NDArray[np.float64]:
        return self._promise + VISIT_WEIGHT * self._visits

    def _room(self, count: int) -> Numbers:
        """Places for so many moments; the least promising ones give way."""
        if self._used + count <= self._size:
            self._used += count
            return np.arange(self._used - count, self._used)
        self._used = self._size
        return np.argpartition(-self._score(), count)[:count]
