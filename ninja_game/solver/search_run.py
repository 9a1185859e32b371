"""One search of one level, driven in slices of work: set up, run on, read the best run so far."""

from __future__ import annotations

import numpy as np

from ninja_game.compile_cache import compiled
from ninja_game.solver.distance_field import POINTS
from ninja_game.solver.heuristics import Heuristics
from ninja_game.solver.macro_actions import action_inputs
from ninja_game.solver.search import MORE, begin, expand
from ninja_game.solver.search_memory import (
    Entry,
    Guide,
    Resolution,
    Start,
    back_up_values,
    clear,
    new_memory,
    new_table,
    zeroed,
)
from ninja_game.solver.state_abstraction import MAX_SWITCH_STATES, Goals

NO_GUIDE = Guide(zeroed(Entry, 1), Resolution())
SWEEPS = 40
"""Most sweeps over all links that make a guide's values."""


class Search:
    """Best-first searches from the start of a level, one after the other, in memory for so many ``nodes``.

    ``gold``: pieces that every run must collect.
    """

    def __init__(self, start: Start, *, nodes: int, gold: int) -> None:
        self.start = start
        self.heuristics = heuristics = Heuristics(start.levels, start.worlds)
        self.goals = Goals(
            gold,
            heuristics.gold_slots,
            heuristics.gold_fields() if gold else np.zeros((1, 1), np.float32),
            heuristics.slots,
            masks=np.full(MAX_SWITCH_STATES, -1, np.int64),
            places=np.zeros((MAX_SWITCH_STATES, 2)),
            fields=np.zeros((MAX_SWITCH_STATES, POINTS), np.float32),
        )
        self.goals.fields[:, 0] = -1.0
        self.resolution = Resolution()
        self.memory = new_memory(nodes)
        self.counters = self.memory.counters[0]
        self.guide = NO_GUIDE
        self._other_table = new_table(nodes)

    def begin(self, resolution: Resolution, *, seed: int, bound: int, guided: bool = False) -> None:
        """Begin a new search. ``bound``: only runs of fewer ticks count (0: any).

        ``guided``: by what the last search has learned; otherwise that is forgotten.
        """
        self.guide = self._learned() if guided else NO_GUIDE
        clear(self.memory)
        random = np.random.default_rng([seed, 6])
        shifts = random.random(2) * resolution.cell
        speed_shifts = resolution.speed * 0.5 + random.random(2) * resolution.speed * 0.5
        self.resolution = resolution._replace(
            shift_x=float(shifts[0]),
            shift_y=float(shifts[1]),
            shift_vx=float(speed_shifts[0]),
            shift_vy=float(speed_shifts[1]),
        )
        self.counters.best_ticks = bound
        self.counters.random = int(random.integers(1, 1 << 62))
        compiled(begin)(self.start, self.memory, self.goals, self.resolution)
        self._fill_fields()

    def _learned(self) -> Guide:
        """The table of the search just made, with its values; the next search gets the other table."""
        table = self.memory.table
        compiled(back_up_values)(table, self.memory.links, int(self.counters.links), SWEEPS)
        self.memory = self.memory._replace(table=self._other_table)
        self._other_table = table
        return Guide(table, self.resolution)

    def run(self, budget: int) -> int:
        """Search on for about ``budget`` ticks; MORE, EXHAUSTED or NO_ROOM."""
        end = self.ticks + budget
        while self.ticks < end:
            left = end - self.ticks
            ended = compiled(expand)(self.start, self.memory, self.goals, self.guide, self.resolution, left)
            if self.counters.new_switch_states:
                self._fill_fields()
            elif ended != MORE:
                return int(ended)
        return MORE

    def _fill_fields(self) -> None:
        """Make the distance fields of the switch states that were seen for the first time."""
        goals = self.goals
        for index in np.flatnonzero((goals.masks >= 0) & (goals.fields[:, 0] < 0.0)):
            x, y = goals.places[index]
            goals.fields[index] = self.heuristics.field(int(goals.masks[index]), float(x), float(y))
        self.counters.new_switch_states = 0

    @property
    def ticks(self) -> int:
        """Ticks simulated since ``begin``."""
        return int(self.counters.ticks)

    @property
    def worlds(self) -> int:
        """Save-states expanded since ``begin``."""
        return int(self.counters.expanded)

    def best(self) -> bytes | None:
        """The inputs of the shortest run to the exit that this search has found, one byte a tick; None if none."""
        index = int(self.counters.best_node)
        parts = []
        while index >= 0:
            node = self.memory.nodes[index]
            parts.append(action_inputs(int(node.action)))
            index = int(node.parent)
        return b"".join(reversed(parts)) or None
