"""How far worlds are from a fact that is not so yet, such as ``won``: by the distance fields of the solver."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from ninja_game.backend.memories import open_worlds
from ninja_game.batch.batch import Batch
from ninja_game.search.formula.language import Values
from ninja_game.search.heuristics import FARTHEST, Field, Heuristics, points_at
from ninja_game.search.switches import open_masks
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import Level

_SPEED = 4.0
"""px that a tick of a field counts, so that distances in formulas and these are of one size: a step of 6 px is 1.5."""

Target = Callable[[int, float, float], Field]
"""The field of a target in a switch state, for a ninja at (x, y)."""


class Distances:
    """Fields of a level, by target and by switch state: made when a world of the batch first needs them."""

    def __init__(self, level: Level, batch: Batch) -> None:
        self._level, self._batch = level, batch
        self._fields: dict[tuple[object, int], Field] = {}

    @cached_property
    def _heuristics(self) -> Heuristics:
        alone = open_worlds(self._batch.memory, self._level, box=False)
        return Heuristics(alone.maps, alone.records)

    def to_exit(self) -> Values:
        """From the exit, by way of its switch: px about, less than 0 for all worlds."""
        return self._margins("exit", self._heuristics.field)

    def to_object(self, record: Any) -> Values:
        """The same from an object, or from the switch of an exit."""
        found = self._batch.objects[:, int(record["partner"][0])] if int(record["kind"][0]) == EXIT else record
        place = float(found["x"][0]), float(found["y"][0])
        return self._margins(place, lambda state, x, y: self._heuristics.field_to(place, state, x, y))

    def _margins(self, key: object, target: Target) -> Values:
        batch = self._batch
        places, states = batch.positions, open_masks(batch.objects, self._heuristics.slots)
        points = points_at(places)
        margins = np.empty(batch.count)
        for state in np.unique(states).tolist():
            here = states == state
            if (key, state) not in self._fields:
                x, y = places[np.argmax(here)].tolist()
                self._fields[key, state] = np.minimum(target(state, x, y), np.float32(FARTHEST))
            margins[here] = -1.0 - _SPEED * self._fields[key, state][points[here]]
        return margins
