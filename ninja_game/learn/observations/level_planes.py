"""The whole level, a plane for each thing that there is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.learn.observations.near_objects import KIND_NAMES, OBSERVED
from ninja_game.learn.observations.object_facts import is_there, place_of
from ninja_game.learn.observations.part import Part, Ragged, Setting
from ninja_game.learn.observations.solidity import FINE, solidity
from ninja_game.sim.collision.tiles import COLUMN as GRID_COLUMN
from ninja_game.sim.collision.tiles import ROW as GRID_ROW
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import COLUMNS, ROWS, TILES
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.rules import GRID_COLUMNS, GRID_ROWS

PLANES = ("solid", *KIND_NAMES, "ninja")
"""How much of a cell is solid; where objects of each kind are; where the ninja is."""
HIGHEST = 255
CLOSED_EXIT = 128


@dataclass(frozen=True)
class LevelPlanes(Part):
    """The level's 31 x 23 cells in a plane for each of ``PLANES``: uint8 (15, 23, 31); normalised: float32, 0 to 1.

    255 (1.0): there is one in this cell, by its middle; a closed exit is 128 (0.5). What is gone is not seen (as by
    ``NearObjects``). Of a locked or trap door its switch is seen.
    """

    name: ClassVar[str] = "planes"

    @property
    def box(self) -> Box:
        """(15, 23, 31)."""
        shape = (len(PLANES), ROWS, COLUMNS)
        return Box(0.0, 1.0, shape, np.float32) if self.normalised else Box(0, HIGHEST, shape, np.uint8)

    @property
    def kernel(self) -> Callable[..., None]:
        """``observe_planes``."""
        return observe_planes

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """The solid plane of each level; each level's objects and their planes; the values."""
        solid = [
            solidity(setting, number, GRID_COLUMNS * FINE, GRID_ROWS * FINE)
            .reshape(GRID_ROWS, FINE, GRID_COLUMNS, FINE)
            .mean((1, 3))[1:-1, 1:-1]
            for number in range(len(setting.fresh))
        ]
        shades = np.rint(np.array(solid) * HIGHEST)
        factor = 1.0 / HIGHEST if self.normalised else 1
        values: Any = np.float64 if self.normalised else np.int64
        planes = {kind.number: 1 + place for place, kind in enumerate(OBSERVED)}
        objects = [[(o.slot, planes[o.kind]) for _, o in found] for found in setting.objects(*planes)]
        return (
            setting.table((shades * factor).ravel(), values),
            *Ragged(objects).columns(setting, 2),
            HIGHEST * factor,
            CLOSED_EXIT * factor,
        )


@entry_point
def observe_planes(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    solid: Any, starts: Any, slots: Any, planes: Any, highest: Any, closed: Any,
) -> None:  # fmt: skip
    """Write the planes of some worlds."""
    for k in range(first, last):
        index = which[k]
        level = level_of[index]
        w = worlds[index]
        for j in range(TILES):
            out[index, offset + j] = solid[level * TILES + j]
        for j in range(offset + TILES, offset + len(PLANES) * TILES):
            out[index, j] = 0
        for number in range(starts[level], starts[level + 1]):
            o = w.objects[int(slots[number])]
            if is_there(w, o):
                x, y = place_of(o)
                cell = interior_cell(x, y)
                if cell >= 0:
                    is_closed = o.kind == EXIT and not o.is_open
                    out[index, offset + int(planes[number]) * TILES + cell] = closed if is_closed else highest
        cell = interior_cell(w.ninja.x, w.ninja.y)
        if cell >= 0:
            out[index, offset + (len(PLANES) - 1) * TILES + cell] = highest


@fast
def interior_cell(x: float, y: float) -> int:
    """Index of the level's cell that holds a place, row by row; -1 for the border and outside."""
    cell = cell_at(x, y)
    column = GRID_COLUMN[cell]
    row = GRID_ROW[cell]
    if 1 <= column <= COLUMNS and 1 <= row <= ROWS:
        return (row - 1) * COLUMNS + column - 1
    return -1
