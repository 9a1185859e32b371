"""The solver's ways from the start of a span: to the target of its goal, and along other runs to the exit."""

from __future__ import annotations

from functools import partial

import numpy as np

from ninja_game.backend.memories import compiled
from ninja_game.batch.batch import Keys
from ninja_game.runs.compare import nearest_state
from ninja_game.runs.run import run_level
from ninja_game.search.formula.task import SpanTask
from ninja_game.search.heuristics import Heuristics
from ninja_game.search.known_run import known_run, play_known
from ninja_game.search.legs import UNBOUNDED, FieldOf, Leg, Spend
from ninja_game.search.nodes import open_start
from ninja_game.search.route import LEG_NODES, ROUTE_ENDS, ROUTE_EXTRA, ROUTE_LEGS
from ninja_game.search.searching import Search
from ninja_game.search.spans import SPAN_TICKS, SpanSearches, draw_settings
from ninja_game.sim.inputs import KEYS_DOWN, with_press_bits
from ninja_game.sim.kinds import EXIT

MAX_LEG_TICKS = 2_000_000
"""Ticks of one search, doubled after every turn. Most searches end before: a span of 100 ticks has few states."""


class LegSearch:
    """Best-first searches from the start of a span to its target, with varied resolutions and seeds.

    Needs the compiled memory; the constructor compiles everything.
    """

    def __init__(self, task: SpanTask, target: int, seed: int) -> None:
        self.task = task
        start = open_start(task.level, box=task.body == "box")
        heuristics = Heuristics(start.maps, start.worlds)
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
        self._seed, self._begun, self._most = seed * 10_000, 0, MAX_LEG_TICKS
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


class OtherRoutes:
    """Searches from the start of a span along other runs, from where their ninja was nearest, in turn.

    Runs that do not reach the exit are left out. Needs the compiled memory; the constructor compiles everything.
    """

    def __init__(self, task: SpanTask, seed: int) -> None:
        self.task, self._turn = task, 0
        self._random = np.random.default_rng(seed)
        start = open_start(task.level, box=task.body == "box")
        self._searches = SpanSearches(start, Heuristics(start.maps, start.worlds), gold=0)
        places = run_level(task.level, task.inputs[: task.first], body=task.body).positions
        self._searches.search(0, 1, draw_settings(self._random), seed=0, ticks=1, spend=lambda _: True)
        self._joins: list[tuple[bytes, int]] = []  #: runs to the exit, and their ticks at which ours joins them
        for other in task.others:
            played = run_level(task.level, other, body=task.body)
            if played.outcome == "exit":
                there = nearest_state(places, task.first, played.positions)
                self._joins.append((with_press_bits(other[: played.ticks]), there))

    def search(self, spend: Spend) -> list[Keys]:
        """Search along the next run; gives the keys of the span, an empty list without a way to the exit."""
        if not self._joins:
            return []
        task, (other, there) = self.task, self._joins[self._turn % len(self._joins)]
        self._turn += 1
        settings, first = draw_settings(self._random), task.first
        joined = first + len(other) - there
        self._searches.follow_joined(task.inputs, first, other, there, joined + int(settings.max_delay))
        seed = int(self._random.integers(1 << 30))
        run = self._searches.search(first, joined, settings, seed=seed, ticks=SPAN_TICKS, spend=spend)
        keys = (run or b"")[first : task.last].ljust(task.length, b"\0")
        return [np.frombuffer(keys, np.uint8) & np.uint8(KEYS_DOWN)] if run else []
