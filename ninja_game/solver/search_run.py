"""One search of one level, driven in slices of work: set up, run on, read the best run so far."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ninja_game.compile_cache import compiled
from ninja_game.solver import search_memory as at
from ninja_game.solver.heuristics import Heuristics
from ninja_game.solver.macro_actions import action_inputs
from ninja_game.solver.search import begin, expand
from ninja_game.solver.search_memory import ENTRY, Resolution, SearchMemory, Start, back_up_values

MORE, EXHAUSTED, NO_ROOM = 0, 1, 2
"""How a slice of a search ended."""

NO_GUIDE = np.zeros(1, ENTRY)


class Search:
    """A best-first search from the start of a level, in memory that can be used again and again."""

    def __init__(self, start: Start, heuristics: Heuristics, memory: SearchMemory, gold: int) -> None:
        self.start = start
        self.heuristics = heuristics
        self.memory = memory
        self.gold = gold
        self._gold_fields = heuristics.gold_fields() if gold else np.zeros((1, 1), np.float32)
        memory.counters[at.SWITCH_STATES] = 0

    def begin(self, resolution: Resolution, *, seed: int, bound: int, guided: bool = False) -> None:
        """Begin a new search. ``bound``: only runs of fewer ticks count (0: any).

        ``guided``: by what the last search has learned; otherwise that is forgotten.
        """
        memory = self.memory
        if guided:
            memory.keep_as_guide(compiled(back_up_values))
        memory.clear()
        counters, parameters = memory.counters, memory.parameters
        random = np.random.default_rng([seed, 6])
        parameters[at.CELL_PX], parameters[at.SPEED_STEP] = resolution.cell, resolution.speed
        parameters[[at.SHIFT_X, at.SHIFT_Y]] = random.random(2) * resolution.cell
        parameters[[at.SHIFT_VX, at.SHIFT_VY]] = resolution.speed * 0.5 + random.random(2) * resolution.speed * 0.5
        parameters[at.MACRO_TICKS], parameters[at.MACRO_JITTER] = resolution.macro, resolution.jitter
        parameters[at.WEIGHT], parameters[at.PATIENCE] = resolution.weight, resolution.patience
        parameters[at.REVISITS], parameters[at.SLACK] = resolution.visits, resolution.slack
        parameters[at.OFF_GUIDE] = resolution.off_guide
        self._guide = memory.guide if guided else NO_GUIDE
        counters[at.GOLD_NEEDED] = self.gold
        counters[at.BEST_TICKS] = bound
        counters[at.RANDOM] = int(random.integers(1, 1 << 62))
        self._call(begin, 0)
        self._fill_fields()

    def run(self, budget: int) -> int:
        """Search on for about ``budget`` ticks; MORE, EXHAUSTED or NO_ROOM."""
        counters = self.memory.counters
        end = counters[at.TICKS] + budget
        while True:
            left = int(end - counters[at.TICKS])
            if left <= 0:
                return MORE
            ended = int(self._call(expand, left))
            if counters[at.NEW_SWITCH_STATES]:
                self._fill_fields()
            elif ended != MORE:
                return ended

    def _call(self, entry: Callable[..., Any], budget: int) -> Any:
        memory, start, heuristics = self.memory, self.start, self.heuristics
        return compiled(entry)(
            (start.levels, start.worlds, (start.base, start.node_words, start.work_words)),
            (memory.nodes, memory.table, memory.links, (memory.chunk_next, memory.chunk_index, memory.chunk_value),
             memory.buckets, memory.counters, memory.parameters),
            (memory.switch_states, memory.switch_state_places, memory.fields),
            (heuristics.slots, len(heuristics.switches), heuristics.gold_slots, self._gold_fields),
            (self._guide, memory.guided_by),
            budget,
        )  # fmt: skip

    def _fill_fields(self) -> None:
        """Make the distance fields of the switch states that were seen for the first time."""
        memory = self.memory
        for index in range(int(memory.counters[at.SWITCH_STATES])):
            if memory.fields[index, 0] < 0.0:
                x, y = memory.switch_state_places[index]
                memory.fields[index] = self.heuristics.field(int(memory.switch_states[index]), float(x), float(y))
        memory.counters[at.NEW_SWITCH_STATES] = 0

    @property
    def ticks(self) -> int:
        """Ticks simulated since ``begin``."""
        return int(self.memory.counters[at.TICKS])

    @property
    def worlds(self) -> int:
        """Save-states expanded since ``begin``."""
        return int(self.memory.counters[at.EXPANDED])

    def best(self) -> bytes | None:
        """The inputs of the shortest run to the exit that this search has found, one byte a tick; None if none."""
        index = int(self.memory.counters[at.BEST_NODE])
        if index < 0:
            return None
        parts = []
        nodes = self.memory.nodes
        while index >= 0:
            node = nodes[index]
            parts.append(action_inputs(int(node["action"])))
            index = int(node["parent"])
        return b"".join(reversed(parts))
