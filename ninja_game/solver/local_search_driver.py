"""A local search from one run: its arrays, and slices of work."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ninja_game.compile_cache import compiled
from ninja_game.sim.inputs import press_jumps
from ninja_game.solver.local_search import (
    BEST_ROW,
    BEST_SCORE,
    CHECKPOINT,
    CURRENT_ROW,
    CURRENT_SCORE,
    CURRENT_TICKS,
    GOLD_WANTED,
    LEASH,
    PLAYED,
    SHORTEST,
    TEMPERATURE,
    TRIALS,
    local_search,
    retrace,
)
from ninja_game.solver.search_memory import Start

ROOM = 64
"""Ticks by which a current run may be longer than the run that the local search began with."""


class LocalSearch:
    """Improves a run by random mutations.

    ``inputs`` must reach the exit; ``gold``: pieces that every run must collect.
    """

    def __init__(self, start: Start, inputs: bytes, *, gold: int, seed: int) -> None:
        self.start = start
        room = len(inputs) + ROOM
        self.keys = np.zeros((3, room), np.uint8)
        self.path = np.zeros((room, 2))
        self.checkpoints = np.zeros((room // CHECKPOINT + 1, start.size), np.int64)
        self.counters = np.zeros(16, np.int64)
        self.scores = np.zeros(8)
        self.counters[0] = np.random.default_rng([seed, 7]).integers(1, 1 << 62)
        self.counters[GOLD_WANTED] = gold
        self.counters[SHORTEST] = len(inputs)
        self.scores[BEST_SCORE] = len(inputs)
        self.scores[LEASH] = 90.0
        self.keys[BEST_ROW, : len(inputs)] = np.frombuffer(inputs, np.uint8) & 7
        self.return_to_best()

    def return_to_best(self) -> None:
        """Make the best run the current one. Raises ValueError if it does not reach the exit."""
        self.keys[CURRENT_ROW] = self.keys[BEST_ROW]
        limit = int(self.counters[SHORTEST])
        if not self._call(retrace, 0, limit):
            raise ValueError("the run does not reach the exit with triggers only where the jump key goes down")
        self.scores[CURRENT_SCORE] = self.scores[BEST_SCORE]
        self.counters[CURRENT_TICKS] = limit

    def run(self, budget: int, *, temperature: float) -> None:
        """Try mutations for about ``budget`` ticks; ``temperature``: how many ticks longer a kept run may be."""
        self.scores[TEMPERATURE] = temperature
        self._call(local_search, self.counters, self.scores, budget)

    def _call(self, entry: Callable[..., Any], *more: Any) -> Any:
        start = self.start
        words = (start.base, start.work_words)
        return compiled(entry)(
            start.levels, start.worlds, words, self.keys, self.path, self.checkpoints, *more
        )  # fmt: skip

    def best(self) -> bytes:
        """The inputs of the best run, up to the tick of the exit contact."""
        return press_jumps(self.keys[BEST_ROW, : self.ticks].tolist())

    @property
    def ticks(self) -> int:
        """Ticks of the best run."""
        return int(self.counters[SHORTEST])

    @property
    def played(self) -> int:
        """Ticks simulated so far."""
        return int(self.counters[PLAYED])

    @property
    def trials(self) -> int:
        """Edited runs tried so far."""
        return int(self.counters[TRIALS])
