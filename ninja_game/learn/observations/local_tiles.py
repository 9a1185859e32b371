"""The cells round the ninja."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.part import Part, Setting, clamp
from ninja_game.learn.observations.solidity import surface_distances
from ninja_game.sim.collision.tiles import FULL, SHAPE
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.rules import CELL, GRID_COLUMNS, GRID_ROWS, STRIDE

FORMS = ("distance", "one-hot")
TILE_KINDS = len(SHAPE)
FULL_TILE = SHAPE.index(FULL)
BIGGEST = 31
REACH = 48.0
"""px; distances are cut off there."""


@dataclass(frozen=True)
class LocalTiles(Part):
    """``size`` x ``size`` cells, the ninja's in the middle; rows from top to bottom. What is outside counts as solid.

    ``form``: "distance", float32 (size, size): from the cell's centre to the nearest surface, px, below 0 within
    something solid, at most 48; or "one-hot", uint8 (size, size, 36): which tile it is, by its id (docs/rules/world.md
    §2.2; 34: malformed half, 35: undefined). Doors and objects play no part.
    """

    name: ClassVar[str] = "tiles"

    size: int = 9
    form: str = "distance"

    def __post_init__(self) -> None:
        if self.size not in range(1, BIGGEST + 1, 2):
            raise ArgumentError(f"the size of local tiles is {self.size!r}; expected an odd number up to {BIGGEST}")
        if self.form not in FORMS:
            raise ArgumentError(f"the form of local tiles is {self.form!r}; expected one of {FORMS}")

    @property
    def box(self) -> Box:
        """Float32 (size, size), or uint8 (size, size, 36)."""
        if self.form == "one-hot":
            return Box(0, 1, (self.size, self.size, TILE_KINDS), np.uint8)
        reach = 1.0 if self.normalised else REACH
        return Box(-reach, reach, (self.size, self.size), np.float32)

    @property
    def kernel(self) -> Callable[..., None]:
        """By its form."""
        return observe_distances if self.form == "distance" else observe_tiles

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """Of each level a padded picture: distances, or tile ids; the width and height of a picture, and the size."""
        margin = self.size // 2
        height, width = GRID_ROWS + 2 * margin, GRID_COLUMNS + 2 * margin
        maps = [tiles for tiles, _ in setting.fresh]
        pictures = np.full((len(maps), height, width), FULL_TILE if self.form == "one-hot" else -1.0)
        for number, (picture, tiles) in enumerate(zip(pictures, maps, strict=True)):
            inner = picture[margin : height - margin, margin : width - margin]
            if self.form == "one-hot":
                inner[:] = np.reshape(tiles.tiles, (-1, STRIDE))[1 : GRID_ROWS + 1, 1 : GRID_COLUMNS + 1]
            else:
                inner[:] = surface_distances(setting, number, REACH) / REACH
        if not self.normalised and self.form == "distance":
            pictures *= REACH
        dtype: Any = np.int64 if self.form == "one-hot" else np.float32
        return setting.table(pictures.ravel(), dtype), width, height, self.size


@entry_point
def observe_distances(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    pictures: Any, width: int, height: int, size: int,
) -> None:  # fmt: skip
    """Copy the part of the level's picture round the ninja."""
    for k in range(first, last):
        index = which[k]
        n = worlds[index].ninja
        start = level_of[index] * width * height + corner(n.x, n.y, width)
        at = offset
        for _ in range(size):
            for column in range(size):
                out[index, at + column] = pictures[start + column]
            start += width
            at += size


@entry_point
def observe_tiles(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    pictures: Any, width: int, height: int, size: int,
) -> None:  # fmt: skip
    """Mark the tile of each cell round the ninja."""
    for k in range(first, last):
        index = which[k]
        n = worlds[index].ninja
        start = level_of[index] * width * height + corner(n.x, n.y, width)
        for j in range(offset, offset + size * size * TILE_KINDS):
            out[index, j] = 0
        at = offset
        for _ in range(size):
            for column in range(size):
                out[index, at + pictures[start + column]] = 1
                at += TILE_KINDS
            start += width


@fast
def corner(x: float, y: float, width: int) -> int:
    """Where in a padded picture the square round the cell of a place begins; places outside count as at the rim."""
    column = int(clamp(x / CELL, 0.0, GRID_COLUMNS - 1.0))
    row = int(clamp(y / CELL, 0.0, GRID_ROWS - 1.0))
    return row * width + column
