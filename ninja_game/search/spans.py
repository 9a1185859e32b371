"""Searches along known runs of a level, one span after the other, with varied settings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ninja_game.backend.memories import compiled
from ninja_game.search.best_first import EXHAUSTED, MORE
from ninja_game.search.heuristics import Heuristics
from ninja_game.search.known_run import KnownRun, known_run, play_known
from ninja_game.search.legs import Spend
from ninja_game.search.local_search import LocalSearch
from ninja_game.search.nodes import PASSES, Resolution, Start
from ninja_game.search.searching import Search
from ninja_game.search.task import COOLING, SEARCH_COST, SHORT_LOCAL_TICKS, SLICE
from ninja_game.sim.inputs import with_press_bits

NODES = 300_000
SPAN_SLICE = 500_000  # ticks between two looks at the clock
LENGTHS = (40, 60, 90, 150)  # Ticks of a span. Not tuned, but widely spread.
MIN_DELAY_FACTOR, MAX_DELAY_FACTOR = 0.5, 6.0
"""Factor of ``max_delay``: greater while searches are exhausted early, smaller while they are not."""
FEW_TICKS, MANY_TICKS = 500_000, 2_000_000
"""A search exhausted before the first number counts as early, after the second as late."""
SPAN_TICKS = 1_000_000  # ticks of a search
DOUBLINGS = 3  # half of all searches get twice the ticks, half of these twice again, and so on
PREPARATION_TICKS = 10_000  # ticks that the preparation of a search is worth


class SpanSettings(NamedTuple):
    """Settings of the search of a span: its resolution, and those of the known run."""

    resolution: Resolution
    max_delay: float  #: as in KnownRun
    max_distance: float  #: as in KnownRun
    place_price: float  #: as in KnownRun
    speed_price: float  #: as in KnownRun


def draw_settings(random: np.random.Generator) -> SpanSettings:
    """Settings of one search. Their values are not tuned, but widely spread."""
    resolution = Resolution(
        cell=float(random.choice((3.0, 4.0, 6.0, 8.0))),
        speed=float(random.choice((0.2, 0.35, 0.5))),
        macro=int(random.choice((1, 2, 3, 4))),
        jitter=int(random.choice((3, 5, 8))),
        enemy_cell=float(random.choice((0.0, 24.0))),
    )
    return SpanSettings(
        resolution,
        max_delay=float(random.choice((4.0, 8.0, 16.0, 30.0))),
        max_distance=float(random.choice((48.0, 64.0, 96.0, 160.0))),
        place_price=float(random.choice((0.6, 0.9, 1.2))),
        speed_price=float(random.choice((0.5, 1.0, 2.0, 4.0))),
    )


class SpanSearches:
    """Searches along one known run at a time, all in the memory of one Search. ``gold``: least pieces to collect."""

    def __init__(self, start: Start, heuristics: Heuristics, *, gold: int) -> None:
        self.gold = gold
        self._search = Search(start, heuristics, nodes=NODES, along=True)
        self._inputs = b""
        self.run = self._recorded_run(b"")
        self._delay_factor = 1.0

    def follow(self, inputs: bytes) -> None:
        if inputs != self._inputs:
            self._inputs, self.run = inputs, self._recorded_run(inputs)

    def follow_joined(self, inputs: bytes, first: int, other: bytes, other_first: int, bound: int) -> None:
        """Follow another run to the exit from its tick ``other_first`` on, from tick ``first`` of a run on.

        ``bound``: ticks before which a way along it must reach the exit.
        """
        ours, theirs = self._recorded_run(inputs[:first]), self._recorded_run(other)
        self.run = theirs._replace(
            moves=np.concatenate([ours.moves[:first], theirs.moves[other_first:]]),
            keys=np.concatenate([ours.keys[:first], theirs.keys[other_first:]]),
            masks=np.concatenate([ours.masks[:first], theirs.masks[other_first:]]),
            gold=np.concatenate([ours.gold[:first], theirs.gold[other_first:]]),
        )
        self._inputs = (inputs[:first] + other[other_first:])[:bound].ljust(bound, b"\0")

    def _recorded_run(self, inputs: bytes) -> KnownRun:
        run = known_run(len(inputs), inputs)
        search = self._search
        compiled(play_known)(search.start, run, search.goal.switch_slots, len(inputs), 1)
        if not self.gold:
            run.gold[:] = 0
        return run._replace(most_moved=1.0 + float(np.abs(np.diff(run.moves[:, :2], axis=0)).max(initial=0.0)))

    def shorter(self, inputs: bytes, *, seed: int, spend: Spend) -> bytes | None:
        """Search random spans of a run until a shorter run is found; None if ``spend`` ends it first."""
        self.follow(inputs)
        random = np.random.default_rng([seed, PASSES])

        while not spend(PREPARATION_TICKS):
            length = int(random.choice(LENGTHS))
            first = max(0, int(random.integers(-length // 2, max(len(inputs) - 5, 1))))
            settings = draw_settings(random)
            settings = settings._replace(max_delay=settings.max_delay * self._delay_factor)
            search_seed = int(random.integers(1 << 30))
            ticks = SPAN_TICKS << min(int(random.geometric(0.5)) - 1, DOUBLINGS)
            run = self.search(first, first + length, settings, seed=search_seed, ticks=ticks, spend=spend)
            if run:
                return run
        return None

    def search(
        self, first: int, last: int, settings: SpanSettings, *, seed: int, ticks: int, spend: Spend
    ) -> bytes | None:
        """Search the ticks ``first`` … ``last`` - 1; gives a shorter run than the known one, or None."""
        search, of_run = self._search, settings._asdict()
        resolution = of_run.pop("resolution")
        run = self.run._replace(span=(first, last), **of_run)
        search.begin_along(run, self._inputs, resolution, seed=seed, gold=self.gold)
        end = MORE
        while end == MORE and search.ticks < ticks:
            before = search.ticks
            end = search.run(min(SPAN_SLICE, ticks - before))
            if spend(search.ticks - before):
                break
        is_early = end == EXHAUSTED and search.ticks < FEW_TICKS
        is_late = search.ticks >= MANY_TICKS
        factor = self._delay_factor * (1.15 if is_early else 0.8 if is_late else 1.0)
        self._delay_factor = min(max(factor, MIN_DELAY_FACTOR), MAX_DELAY_FACTOR)
        span = search.best()
        # A trigger belongs to the tick in which the key goes down; joining the parts can change that tick.
        return with_press_bits(self._inputs[:first] + span) if span else None


@dataclass(eq=False)
class RunShortener:
    """Shortens runs of one level that must collect ``gold`` pieces.

    ``start`` and ``heuristics`` are the level's, ``seed`` that of all its random numbers. ``submit`` gets every shorter
    run. ``spend`` gets the ticks and the cost of each part, and may end the work.
    """

    start: Start
    heuristics: Heuristics
    _: KW_ONLY
    gold: int
    seed: int
    submit: Callable[[bytes], None]
    spend: Callable[[int, float], bool]
    _local_searches: int = 0
    _searches: int = 0

    @cached_property
    def _spans(self) -> SpanSearches:
        return SpanSearches(self.start, self.heuristics, gold=self.gold)

    def compile(self, inputs: bytes) -> None:
        """Compile all kernels, with a run of the level."""
        self._spans.follow(inputs)
        self._spans.search(0, 1, draw_settings(np.random.default_rng(0)), seed=0, ticks=1, spend=lambda _: True)
        LocalSearch(self.start, inputs, gold=self.gold, seed=0).run(1, temperature=COOLING[0])

    def search_spans(self, inputs: bytes, ticks: int) -> bytes:
        """Search spans of a run, then of the shorter runs that come of it; gives the shortest."""
        left = ticks

        def spend(played: int) -> bool:
            nonlocal left
            left -= played
            return self.spend(played, played * SEARCH_COST) or left <= 0

        while not spend(0):
            self._searches += 1
            run = self._spans.shorter(inputs, seed=self.seed * 1000 + self._searches, spend=spend)
            if run:
                self.submit(run)
                inputs = self.search_locally(run, SHORT_LOCAL_TICKS)
        return inputs

    def search_locally(self, inputs: bytes, ticks: int) -> bytes:
        """Improve a run by a local search of this many ticks; gives its best run."""
        self._local_searches += 1
        local_search = LocalSearch(self.start, inputs, gold=self.gold, seed=self.seed + 7919 * self._local_searches)
        for temperature in COOLING:
            until = local_search.played + ticks // len(COOLING)
            while local_search.played < until and not self.spend(0, 0.0):
                before, best = local_search.played, local_search.ticks
                local_search.run(min(SLICE, until - before), temperature=temperature)
                self.spend(local_search.played - before, local_search.played - before)
                if local_search.ticks < best:
                    self.submit(local_search.best())
            local_search.return_to_best()
        return local_search.best()
