"""Where training episodes begin: at the start of a level, or at a moment of one of the runs that pass it.

A level is learnt from its end: from a moment shortly before the exit chance finds it, and what was learnt there serves
the moments before (Salimans and Chen, "Learning Montezuma's Revenge from a single demonstration", 2018). Moments from
which about half of the episodes pass teach most, and are chosen most.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from examples.search import SearchAgent
from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.levels import LevelSource
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.inputs import KEYS_DOWN
from ninja_game.sim.level import Level

Indices = NDArray[np.intp]

SPACING = 12
"""Ticks between two moments of a run."""
FLOOR = 0.003
"""Weight of what is always or never passed; what is passed every other time has 0.25."""
AHEAD = 0.15
"""Weight of what is never passed, but from the next moment of the run on always."""
START_SHARE = 0.25
"""Share of episodes that begin at the start of the level at least."""
LEARNT, LEARNT_WEIGHT = 0.97, 0.3
"""A level that is passed so often from its start has this weight."""
LEAST_WEIGHT = 0.1
"""Of another level; to which comes the share of all its episodes that are passed."""
MEMORY, START_MEMORY = 0.9, 0.98
"""What an episode leaves of the rate before it; of the rate of a level's own start."""
LONGEST = 800
"""Ticks that a run is thought to take where none is known."""
PATIENCE, LEAST_TICKS = 2.0, 300
"""Episodes may take so many times the ticks that the run takes from there, and so many more."""


class Starts:
    """The start of each level (number k for level k) and moments of some runs through it, if there are any.

    The runs are the certificate of a level of the game and those that ``searches`` searches find. ``rates``: which
    share of the episodes from each start was passed, an average over the last ones. ``level_of``: the level of each;
    ``limits``: the ticks that an episode from there may take in training.
    """

    def __init__(self, source: LevelSource, settings: dict[str, Any], seed: int, searches: int = 2) -> None:
        runs = [
            (level, run)
            for level, name in enumerate(source.names)
            for run in runs_through(name, source.levels[level], seed, searches)
        ]
        self.levels = len(source.names)
        level_of, left = list(range(self.levels)), [LONGEST] * self.levels
        following = list(range(self.levels))
        for level, run in runs:
            first = len(level_of)
            count = max(len(run) - 1, 0) // SPACING
            level_of += [level] * count
            left += [len(run) - (k + 1) * SPACING for k in range(count)]
            following += [min(first + k + 1, first + count - 1) for k in range(count)]
            following[level] = first if count else level
            left[level] = len(run)
        self.level_of: Indices = np.array(level_of, np.intp)
        self.limits = (PATIENCE * np.array(left)).astype(np.int64) + LEAST_TICKS
        self._next = np.array(following, np.intp)
        self.rates = np.full(len(level_of), 0.5)
        self._saved = EnvWorlds(source, len(level_of), **settings)
        self._saved.reset(levels=self.level_of)
        player = EnvWorlds(source, 1, **{**settings, "frame_skip": 1})
        start = self.levels
        for level, run in runs:
            player.reset(0, levels=level)
            for tick in range(max(len(run) - 1, 0) // SPACING * SPACING):
                player.step(run[tick : tick + 1])
                if (tick + 1) % SPACING == 0:
                    self._saved.restore(player.save(), start)
                    start += 1

    def choose(self, count: int, rng: np.random.Generator) -> Indices:
        """Where ``count`` episodes begin."""
        failing = 1.0 - self.rates
        weights = self.rates * failing + AHEAD * self.rates[self._next] * failing + FLOOR
        weights /= np.bincount(self.level_of, weights)[self.level_of]
        weights *= 1.0 - START_SHARE
        weights[: self.levels] += START_SHARE
        # Levels of which most is learnt come first.
        mean = np.bincount(self.level_of, self.rates) / np.bincount(self.level_of)
        weights *= np.where(self.rates[: self.levels] >= LEARNT, LEARNT_WEIGHT, LEAST_WEIGHT + mean)[self.level_of]
        return rng.choice(len(weights), count, p=weights / weights.sum())

    def put(self, worlds: EnvWorlds, which: Indices, starts: Indices) -> None:
        """Have these worlds go on from these starts."""
        worlds.restore(self._saved.save(starts), which)

    def note(self, starts: Indices, passed: NDArray[np.bool_]) -> None:
        """Take note of episodes that have ended: where they began, whether they were passed."""
        episodes = np.bincount(starts, minlength=len(self.rates))
        passes = np.bincount(starts[passed], minlength=len(self.rates))
        kept = np.where(np.arange(len(episodes)) < self.levels, START_MEMORY, MEMORY) ** episodes
        self.rates = self.rates * kept + passes / np.maximum(episodes, 1) * (1.0 - kept)


def runs_through(name: str, level: Level, seed: int, searches: int) -> list[NDArray[np.uint8]]:
    """The keys of each tick of some runs through a level.

    A certificate is a speedrun: what it does in time for a trap leaves no room for a late key. A search's run does.
    """
    runs = []
    for path in bundled_replays():
        if path.name == f"{name}.exit.replay.txt":
            with suppress(NinjaGameError):
                inputs = load_replays(path, level=level)[0].replay.inputs
                runs.append(np.frombuffer(inputs, np.uint8) & np.uint8(KEYS_DOWN))
    agent = SearchAgent()
    plans = (agent.plan(level, seed + k) for k in range(searches))
    return runs + [np.repeat(DISCRETE_KEYS[plan], agent.settings["frame_skip"]) for plan in plans if plan.size]
