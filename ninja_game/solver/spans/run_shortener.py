"""Shortens a run: searches of spans and local searches in turn."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from ninja_game.solver.heuristics import Heuristics
from ninja_game.solver.local_search import LocalSearch
from ninja_game.solver.search_memory import Start
from ninja_game.solver.spans.span_run import SpanSearches, draw_fineness
from ninja_game.solver.task import COOLING, SEARCH_COST, SHORT_CLIMB, SLICE


class RunShortener:
    """Shortens runs of one level that must collect so much gold.

    ``submit`` is given every shorter run; ``over`` gets the ticks of each part and what they cost, and may end it.
    """

    def __init__(
        self, start: Start, heuristics: Heuristics, *, gold: int, seed: int, submit: Callable[[bytes], None],
        over: Callable[[int, float], bool],
    ) -> None:  # fmt: skip
        self.start = start
        self.heuristics = heuristics
        self.gold = gold
        self.seed = seed
        self._submit = submit
        self._over = over
        self._climbs = self._searches = 0

    @cached_property
    def _spans(self) -> SpanSearches:
        return SpanSearches(self.start, self.heuristics, gold=self.gold)

    def compile(self, inputs: bytes) -> None:
        """Have all kernels compiled, with a run of the level."""
        self._spans.know(inputs)
        self._spans.search(0, 1, draw_fineness(np.random.default_rng(0)), seed=0, ticks=1, over=lambda _: True)

    def search_spans(self, inputs: bytes, ticks: int) -> bytes:
        """Search spans of a run, and those of the shorter ones that come of it; the shortest."""
        left = ticks

        def over(played: int) -> bool:
            nonlocal left
            left -= played
            return self._over(played, played * SEARCH_COST) or left <= 0

        while not over(0):
            self._searches += 1
            found = self._spans.shorter(inputs, seed=self.seed * 1000 + self._searches, over=over)
            if found:
                self._submit(found)
                inputs = self.climb(found, SHORT_CLIMB)
        return inputs

    def climb(self, inputs: bytes, ticks: int) -> bytes:
        """Go on from a run by a local search of so many ticks; its best run."""
        self._climbs += 1
        local_search = LocalSearch(self.start, inputs, gold=self.gold, seed=self.seed + 7919 * self._climbs)
        for temperature in COOLING:
            until = local_search.played + ticks // len(COOLING)
            while local_search.played < until and not self._over(0, 0.0):
                before, best = local_search.played, local_search.ticks
                local_search.run(min(SLICE, until - before), temperature=temperature)
                self._over(local_search.played - before, local_search.played - before)
                if local_search.ticks < best:
                    self._submit(local_search.best())
            local_search.return_to_best()
        return local_search.best()
