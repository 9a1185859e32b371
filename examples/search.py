"""An agent that searches with nothing but the environment's own save and restore.

Many short random walks go on at once, each from a moment that an earlier one has reached, with the distance field as
the promise of a moment. The actions that it gives for a level are to be played without looking. After Go-Explore
(Ecoffet, Huizinga, Lehman, Stanley, Clune, "First return, then explore", Nature 590, 2021).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.learn.actions import ACTION_NAMES, DISCRETE_KEYS
from ninja_game.learn.observations.vectors import FIELDS, StateVector
from ninja_game.learn.worlds import EnvState, EnvWorlds
from ninja_game.sim.level import Level
from ninja_game.sim.states import OUTCOME_EXIT, OUTCOME_RUNNING

Indices = NDArray[np.intp]
Actions = NDArray[np.uint8]

SETTINGS: dict[str, Any] = {"observation": StateVector(normalised=False), "frame_skip": 4, "actions": "discrete"}
WALK = 4  # steps of a walk
CHANGED = 0.5  # chance that a walk changes its action before a step
CELL = 12.0  # px: what is less apart counts as the same place
SPEED = 1.0  # px/tick: what differs less counts as the same velocity
EARLIER = 8  # ticks by which another arrival at the same moment must be earlier to count
TICK_WEIGHT = 0.5  # what a tick played counts beside a tick to go: less, so that the search is drawn to the exit
VISIT_WEIGHT = 25.0  # ticks that each walk from a moment counts against it, so that others have their turn
NOISE = 10.0

_X, _Y, _VX, _VY, _IN_AIR, _HELD = map(list(FIELDS).index, ("x", "y", "vx", "vy", "in_air", "jump_held"))


class SearchResult(NamedTuple):
    """What a search gives. ``actions``: one per step up to the exit, or None; ``ticks``: played in all its worlds."""

    actions: Actions | None
    ticks: int


@dataclass(frozen=True)
class SearchAgent:
    """Searches each level again, with ``ticks`` of all its worlds together at most.

    ``worlds``: walks at a time. ``kept``: moments that are remembered, each in a world of its own; the least promising
    ones are forgotten. The same seed finds the same run. ``settings``: the keywords of the environment in which the
    run is to be played.
    """

    ticks: int = 6_000_000
    worlds: int = 512
    kept: int = 8192
    settings: dict[str, Any] = field(default_factory=lambda: dict(SETTINGS))

    def plan(self, level: Level, seed: int = 0) -> Actions:
        """The actions of a run to the exit; none where the search found no run."""
        actions = self.search(level, seed).actions
        return np.zeros(0, np.uint8) if actions is None else actions

    def search(self, level: Level, seed: int = 0) -> SearchResult:
        rng = np.random.default_rng(seed)
        settings = {name: value for name, value in self.settings.items() if name != "actions"}
        walkers = EnvWorlds([level], self.worlds, goal_distance=True, **settings)
        archive = Archive(level, self.kept, settings)
        archive.add(walkers, np.array([0]), np.zeros((0, self.worlds), np.uint8))
        seen = {_cells(walkers)[0]: 0}
        ticks = 0
        while ticks + WALK * self.worlds * walkers.frame_skip <= self.ticks:
            walkers.restore(archive.choose(self.worlds, rng))
            walk = np.zeros((WALK, self.worlds), np.uint8)
            for step in range(WALK):
                drawn = rng.integers(len(ACTION_NAMES), size=self.worlds)
                changed = rng.random(self.worlds) < (CHANGED if step else 1.0)
                walk[step] = np.where(changed, drawn, walk[step - 1])
                ticks += walkers.step(DISCRETE_KEYS[walk[step]])
                won = np.flatnonzero(walkers.outcomes == OUTCOME_EXIT)
                if won.size:
                    return SearchResult(archive.path(won[0], walk[: step + 1]), ticks)
                archive.add(walkers, _news(walkers, seen), walk[: step + 1])
        return SearchResult(None, ticks)


def _cells(walkers: EnvWorlds) -> list[int]:
    """What counts as the same moment: about the same place and velocity, same switches, on the ground or not."""
    assert walkers.goal
    seen = np.asarray(walkers.observations)
    whole = np.stack(
        [
            seen[:, _X] // CELL,
            seen[:, _Y] // CELL,
            np.floor(seen[:, _VX] / SPEED + 0.5) + 32,
            np.floor(seen[:, _VY] / SPEED + 0.5) + 32,
            seen[:, _IN_AIR] * 2 + seen[:, _HELD],
        ],
        axis=1,
    ).astype(np.int64)
    place = whole @ (1 << np.array([0, 7, 14, 20, 26]))
    cells: list[int] = (place + (walkers.goal.states << 28)).tolist()
    return cells


def _news(walkers: EnvWorlds, seen: dict[int, int]) -> Indices:
    """The worlds that are where none was, or not as early; they are seen from now on."""
    news = []
    ticks = walkers.ticks.tolist()
    cells = _cells(walkers)
    for world in np.flatnonzero((walkers.outcomes == OUTCOME_RUNNING) & ~walkers.truncated).tolist():
        if ticks[world] + EARLIER < seen.get(cells[world], 1 << 40):
            seen[cells[world]] = ticks[world]
            news.append(world)
    return np.array(news, np.intp)


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
        self._walking: Indices = np.full(1, -1, np.intp)
        self._since: Indices = np.zeros(1, np.intp)

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

    def add(self, walkers: EnvWorlds, which: Indices, walk: Actions) -> None:
        """Remember the moments in which the walkers ``which`` are; ``walk``: their actions, (steps, walkers)."""
        if not which.size:
            return
        if len(self._walking) != walkers.count:
            self._walking, self._since = np.full(walkers.count, -1, np.intp), np.zeros(walkers.count, np.intp)
        assert walkers.goal
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

    def _room(self, count: int) -> Indices:
        """Places for this many moments; the least promising ones give way."""
        if self._used + count <= self._size:
            self._used += count
            return np.arange(self._used - count, self._used)
        self._used = self._size
        return np.argpartition(-self._score(), count)[:count]
