"""Distance of the ninjas from the exit, in ticks, by the solver's distance fields.

A level has one field per *switch state*: which exits are open and which doors are switched. A field is made when a
world first reaches its state, and then kept. Fields know walls, mines and doors, not jumps: they only estimate.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ninja_game.backend.memories import open_worlds
from ninja_game.batch.batch import Indices
from ninja_game.learn.observations.part import Array, Lookup, PartContext, clamp
from ninja_game.search.heuristics import FARTHEST, POINTS, Heuristics, open_bits, point_at
from ninja_game.sim.level import Level
from ninja_game.sim.rules import WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.world_fields import TileMap, World

SPARE_FIELDS = 1024  # fields that are kept although no world is in their state; 53 KB each

NO_STATE = NO_ROW = -1


class GoalDistance:
    """Ticks to the exit of ``count`` worlds.

    ``ticks`` (n,) float64; ``states`` (n,) int64: the switch states, one bit per entry of ``Heuristics.switches``;
    ``start`` (n,) float64: ticks at the episode's start; ``fields`` (rows, POINTS) float32 and ``rows`` (n,): the row
    of each world's switch state.
    """

    def __init__(self, levels: Sequence[Level], context: PartContext) -> None:
        self._levels, self._worlds, self._context = levels, context.worlds, context
        self._kernel = context.worlds.kernel(measure_distance)
        self._made: dict[int, Heuristics] = {}
        count = context.count
        self.ticks, self.start = np.zeros((2, count))
        self.states = np.full(count, NO_STATE, np.int64)
        self.rows = np.zeros(count, np.int64)
        self.fields = np.zeros((count + SPARE_FIELDS, POINTS), np.float32)
        self._free = list(range(len(self.fields)))
        self._row_of: dict[tuple[int, int], int] = {}
        self._stale = np.zeros(count, np.bool_)
        self._switches = context.rows(lambda number: self._heuristics(number).slots.tolist(), int)

    def _heuristics(self, number: int) -> Heuristics:
        """The fields of a level. Both memories make equal ones, so the faster memory is used."""
        if number not in self._made:
            alone = open_worlds("auto", self._levels[number], box=False)
            self._made[number] = Heuristics(alone.maps, alone.records)
        return self._made[number]

    def begin(self, level_of: Indices, indices: Indices) -> None:
        """Measure worlds that were reset or restored, and forget their old switch states."""
        self.states[indices] = NO_STATE
        self.measure(level_of, indices, 0, len(indices))
        self.settle(level_of)

    def measure(self, level_of: Indices, indices: Indices, first: int, last: int) -> None:
        """Measure the worlds ``indices[first:last]``, except those with a new switch state (``settle``)."""
        worlds = self._worlds
        self._kernel(
            worlds.maps, level_of, worlds.worlds, indices, first, last,
            *self._switches, self.states, self._stale, self.fields, self.rows, self.ticks,
        )  # fmt: skip

    def settle(self, level_of: Indices) -> Indices:
        """Give worlds with a new switch state its field, and measure them again; returns their indices (k,)."""
        stale = np.flatnonzero(self._stale)
        if stale.size:
            self._stale[stale] = False
            self.rows[stale] = NO_ROW
            for index in stale.tolist():
                self.rows[index] = self._row(int(level_of[index]), int(self.states[index]))
            self.measure(level_of, stale, 0, len(stale))
        return stale

    def _row(self, level: int, state: int) -> int:
        """The row of a field; make the field if it is missing."""
        key = (level, state)
        if key not in self._row_of:
            if not self._free:
                used = set(self.rows.tolist())
                self._free = [row for row in range(len(self.fields)) if row not in used]
                self._row_of = {known: row for known, row in self._row_of.items() if row in used}
            self._row_of[key] = row = self._free.pop()
            start = self._context.fresh[level].start
            np.minimum(self._heuristics(level).field(state, *start), np.float32(FARTHEST), out=self.fields[row])
        return self._row_of[key]


@fast
def point_within(x: float, y: float) -> int:
    """Index of the point nearest to a place; places outside the world count as at its border, NaN as 0."""
    return point_at(clamp(x, 0.0, WORLD_WIDTH), clamp(y, 0.0, WORLD_HEIGHT))


@kernel
def measure_distance(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    bounds: Lookup, switches: Lookup, states: Array, stale: Array, fields: Array, rows: Array, ticks: Array,
) -> None:  # fmt: skip
    """Write the switch states of some worlds and their ``ticks`` to the exit; ``stale``: the state has changed."""
    for k in range(first, last):
        index = indices[k]
        level = level_of[index]
        w = worlds[index]
        state = open_bits(w, switches, bounds[2 * level], bounds[2 * level + 1])
        if state != states[index]:
            states[index] = state
            stale[index] = True
        else:
            ticks[index] = fields[rows[index], point_within(w.ninja.x, w.ninja.y)]
