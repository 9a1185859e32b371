"""Where training episodes begin: at the start of a level, or at a moment of a run that passes it.

A level is learnt from its end: from a moment shortly before the exit chance finds it, and what was learnt there serves
the moments before (Salimans and Chen, "Learning Montezuma's Revenge from a single demonstration", 2018). Moments from
which about half of the episodes pass teach most, and are chosen most.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import NinjaGameError
from ninja_game.files.resources import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.agents.search import SearchAgent
from ninja_game.learn.levels import LevelSource
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.inputs import KEYS_DOWN
from ninja_game.sim.level import Level

Numbers = NDArray[np.intp]

SPACING = 8
"""Ticks between two moments of a run."""
FLOOR = 0.003
"""Weight of what is always or never passed; what is passed every other time has 0.25."""
AHEAD = 0.15
"""Weight of what is never passed, but from the next moment of the run on always."""
START_SHARE = 0.25
"""Share of episodes that begin at the start of the level at least."""
LEARNT, LEARNT_WEIGHT = 0.97, 0.3
"""A level that is passed so often from its start has this weight; all others have 1."""
MEMORY = 0.95
"""What an episode leaves of the rate before it."""
LONGEST = 800
"""Ticks that a run is thought to take where none is known."""
PATIENCE, LEAST_TICKS = 2.0, 300
"""Episodes may take so many times the ticks that the run takes from there, and so many more."""


class Starts:
    """The start of each level (number k for level k) and moments of a run through it, if there is one.

    The run is the certificate of a level of the game; of another level, one that a search finds. ``rates``: which share
    of the episodes from each start was passed, an average over the last ones. ``level_of``: the level of each;
    ``limits``: the ticks that an episode from there may take in training.
    """

    def __init__(self, source: LevelSource, settings: dict[str, Any], seed: int) -> None:
        runs = [run_through(name, level, seed) for name, level in zip(source.names, source.levels, strict=True)]
        self.levels = len(runs)
        moments = [(level, k * SPACING) for level, run in enumerate(runs) for k in range(1, len(run) // SPACING)]
        self.level_of: Numbers = np.array([*range(self.levels), *(level for level, _ in moments)], np.intp)
        follow = np.append(np.arange(1, len(self.level_of)), 0)
        self._next = np.where(self.level_of[follow] == self.level_of, follow, np.arange(len(self.level_of)))
        for level in range(self.levels):
            own = np.flatnonzero(self.level_of == level)
            self._next[level] = own[min(1, len(own) - 1)]
        left = [len(run) or LONGEST for run in runs] + [len(runs[level]) - tick for level, tick in moments]
        self.limits = (PATIENCE * np.array(left)).astype(np.int64) + LEAST_TICKS
        self.rates = np.full(len(self.level_of), 0.5)
        self._saved = EnvWorlds(source, len(self.level_of), **settings)
        self._saved.reset(levels=self.level_of)
        player = EnvWorlds(source, 1, **{**settings, "frame_skip": 1})
        for start, (level, tick) in enumerate(moments, self.levels):
            if tick == SPACING:
                player.reset(0, levels=level)
            for keys in runs[level][tick - SPACING : tick]:
                player.step(np.array([keys]))
            self._saved.restore(player.save(), start)

    def choose(self, count: int, chance: np.random.Generator) -> Numbers:
        """Where ``count`` episodes begin."""
        failing = 1.0 - self.rates
        weights = self.rates * failing + AHEAD * self.rates[self._next] * failing + FLOOR
        weights /= np.bincount(self.level_of, weights)[self.level_of]
        weights *= 1.0 - START_SHARE
        weights[: self.levels] += START_SHARE
        weights *= np.where(self.rates[: self.levels] >= LEARNT, LEARNT_WEIGHT, 1.0)[self.level_of]
        return chance.choice(len(weights), count, p=weights / weights.sum())

    def put(self, worlds: EnvWorlds, which: Numbers, starts: Numbers) -> None:
        """Put worlds to starts."""
        worlds.restore(self._saved.save(starts), which)

    def note(self, starts: Numbers, passed: NDArray[np.bool_]) -> None:
        """Take note of episodes that have ended: where they began, whether they were passed."""
        episodes = np.bincount(starts, minlength=len(self.rates))
        passes = np.bincount(starts[passed], minlength=len(self.rates))
        kept = MEMORY**episodes
        self.rates = self.rates * kept + passes / np.maximum(episodes, 1) * (1.0 - kept)


def run_through(name: str, level: Level, seed: int) -> NDArray[np.uint8]:
    """The keys of each tick of a run through a level; none if there is no certificate and a search finds none."""
    for path in bundled_replays():
        if path.name == f"{name}.exit.replay.txt":
            try:
                inputs = load_replays(path, level=level)[0].demo.inputs
            except NinjaGameError:
                break
            return np.frombuffer(inputs, np.uint8) & np.uint8(KEYS_DOWN)
    agent = SearchAgent()
    return np.repeat(DISCRETE_KEYS[agent.plan(level, seed)], agent.settings["frame_skip"])
