"""Moves, flips and quarter turns of the plane, applied to points, cells, directions and tiles."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import NamedTuple

from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.collision.tiles import UNIT_X, UNIT_Y
from ninja_game.sim.grid import Cell, cell_of
from ninja_game.sim.rules import CELL, HALF, STRIDE, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.schema.world_fields import TileMap

TILE_IDS = range(34)


class Motion(NamedTuple):
    """The point (x, y) goes to (xx·x + xy·y + dx, yx·x + yy·y + dy), px; the matrix is one of the square's eight."""

    xx: int = 1
    xy: int = 0
    yx: int = 0
    yy: int = 1
    dx: float = 0.0
    dy: float = 0.0

    @property
    def reverses(self) -> bool:
        """Whether clockwise becomes counter-clockwise."""
        return self.xx * self.yy - self.xy * self.yx < 0

    @property
    def turns(self) -> bool:
        return self[:4] != (1, 0, 0, 1)

    def vector(self, x: float, y: float) -> tuple[float, float]:
        return self.xx * x + self.xy * y + 0.0, self.yx * x + self.yy * y + 0.0

    def point(self, x: float, y: float) -> tuple[float, float]:
        a, b = self.vector(x, y)
        return a + self.dx, b + self.dy

    def cell(self, cell: Cell) -> Cell:
        return cell_of(*self.point(CELL * cell[0] + HALF, CELL * cell[1] + HALF))

    def direction(self, number: float) -> float:
        """The number of a direction (0 right, 1 down, 2 left, 3 up) after the motion; other numbers stay."""
        if number not in (0, 1, 2, 3):
            return number
        units = list(zip(UNIT_X, UNIT_Y, strict=True))
        return float(units.index(self.vector(*units[int(number)])))

    def tile(self, tile: int) -> int:
        """The tile whose shape is the moved one; an odd tile stays."""
        return _turned_tiles(self[:4])[tile] if tile in TILE_IDS else tile

    def about(self, x: float, y: float) -> Motion:
        """This motion about a point instead of the origin."""
        a, b = self.vector(x, y)
        return self._replace(dx=x - a, dy=y - b)


FLIP, MIRROR = Motion(yy=-1), Motion(xx=-1)  # up-down and left-right
CLOCKWISE, HALF_TURN = Motion(0, -1, 1, 0), Motion(-1, 0, 0, -1)

_MIDDLE = WORLD_WIDTH / 2, WORLD_HEIGHT / 2
SYMMETRIES: dict[str, tuple[Motion, ...]] = {
    "off": (),
    "left-right": (MIRROR.about(*_MIDDLE),),
    "up-down": (FLIP.about(*_MIDDLE),),
    "both": (MIRROR.about(*_MIDDLE), FLIP.about(*_MIDDLE), HALF_TURN.about(*_MIDDLE)),
    "point": (HALF_TURN.about(*_MIDDLE),),
}
"""The images of a stroke, by the name of the symmetry."""

_SAMPLES = [
    (x, y) for x, y in product((-10.6, -8.1, -5.3, -2.9, -0.7, 0.7, 2.9, 5.3, 8.1, 10.6), repeat=2) if abs(x) != abs(y)
]
"""Points of a cell, px from its middle, alike under all eight motions; none on the surface of a tile."""


@cache
def _solid_samples() -> list[frozenset[tuple[float, float]]]:
    """For every tile the sample points that are solid in the world."""
    tiles = TileMap()
    here = STRIDE + 1
    shapes = []
    for tile in TILE_IDS:
        tiles.ids[here] = tile
        shapes.append(frozenset((x, y) for x, y in _SAMPLES if solid_at(tiles, 12.0 + x, 12.0 + y)))
    return shapes


@cache
def _turned_tiles(matrix: tuple[int, int, int, int]) -> list[int]:
    """For each tile the one whose solid points are the moved ones."""
    shapes = _solid_samples()
    motion = Motion(*matrix)
    return [shapes.index(frozenset(motion.vector(x, y) for x, y in shape)) for shape in shapes]
