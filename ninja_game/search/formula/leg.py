"""The solver's way from the start of a span to the target of its goal, for goals with a single target."""

from __future__ import annotations

from functools import partial

import numpy as np

from ninja_game.backend.memories import compiled
from ninja_game.batch.batch import Keys
from ninja_game.search.formula.task import SpanTask
from ninja_game.search.heuristics import Heuristics
from ninja_game.search.known_run import known_run, play_known
from ninja_game.search.legs import UNBOUNDED, FieldOf, Leg, Spend
from ninja_game.search.nodes import open_start
from ninja_game.search.route import LEG_NODES, ROUTE_ENDS, ROUTE_EXTRA, ROUTE_LEGS
from ninja_game.search.searching import Search
from ninja_game.sim.inputs import KEYS_DOWN
from ninja_game.sim.kinds import EXIT

MAX_TICKS = 2_000_000
"""Ticks of one search, doubled after every turn. Most searches end before: a span of 100 ticks has few states."""


class LegSearch:
    """Best-first searches from the start of a span to its target, with varied resolutions and seeds.

    Needs the compiled memory; the constructor compiles everything.
    """

    def __init__(self, task: SpanTask, target: int, seed: int) -> None:
        self.task = task
        start = open_start(task.level, box=task.body == "box")
        heuristics = Heuristics(start.levels, start.worlds)
        self._search = Search(start, heuristics, nodes=LEG_NODES)
        compiled(play_known)(start, known_run(task.first, task.inputs[: task.first]), heuristics.slots, task.first, 0)
        root = self._search.checkpoint(None, b"")
        field: FieldOf = heuristics.field
        if target:
            thing = start.worlds["objects"][0][target]
            place = start.worlds["objects"][0][int(thing["partner"])] if thing["kind"] == EXIT else thing
            field = partial(heuristics.field_to, (float(place["x"]), float(place["y"])))
        until = UNBOUNDED if target else 0
        self._leg = Leg([root], until, root.mask, until, ROUTE_ENDS, 0, field, target=target)
        self._seed, self._begun, self._most = seed * 10_000, 0, MAX_TICKS
        self._search.begin_leg(self._leg, ROUTE_LEGS[0][0], seed=0, bound=1)
        self._search.run(1)

    def search(self, spend: Spend) -> list[Keys]:
        """Search until the target is reached: gives the keys of the span, an empty list if no resolution succeeds."""
        for resolution, ticks in ROUTE_LEGS:
            self._begun += 1
            self._search.begin_leg(self._leg, resolution, seed=self._seed + self._begun, bound=self.task.last + 1)
            self._search.run_leg(min(ticks, self._most), spend, part=ROUTE_EXTRA, least=ROUTE_EXTRA)
            ends = [end.inputs for end in sorted(self._search.ends(), key=lambda end: end.tick)]
            runs = ends if self._leg.target else [run for run in [self._search.best()] if run]
            if runs or spend(0):
                rows = [keys.ljust(self.task.length, b"\0") for keys in runs]
                return [np.frombuffer(row, np.uint8) & np.uint8(KEYS_DOWN) for row in rows]
        self._most *= 2
        return []
