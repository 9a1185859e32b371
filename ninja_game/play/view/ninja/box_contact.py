"""Small boxes against the tile map, for the corpse: the stages of world.md §5, reporting pushes as they come.

Presentation only, and apart from the world's own collision, which knows one body: the ninja's.
"""

from __future__ import annotations

from collections.abc import Iterator

from ninja_game.sim.collision import tiles
from ninja_game.sim.grid import cell_at
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.rules import DOWN, LEFT, OFF, RIGHT, SOLID, STRIDE, UP

Push = tuple[float, float, float, float]
"""By how much a box is pushed (px), and the surface's normal."""


class Box:
    """A box with a centre that moves when it is pushed, px."""

    __slots__ = ("half", "x", "y")

    def __init__(self, x: float, y: float, half: float) -> None:
        self.x = x
        self.y = y
        self.half = half


def tile_pushes(level: TileMap, world: World, box: Box) -> Iterator[Push]:
    """Push a box out of tiles and closed doors; each push is done when it is given."""
    cell = cell_at(box.x, box.y)
    if not cell:
        return
    cx, cy, half = tiles.CENTRE_X[cell], tiles.CENTRE_Y[cell], box.half
    if level.tiles[cell]:
        dx, dy = box.x - cx, box.y - cy
        ox, oy = 12 + half - abs(dx), 12 + half - abs(dy)
        a, b = (ox if dx >= 0 else -ox, 0.0) if ox < oy else (0.0, oy if dy >= 0 else -oy)
        yield from _narrow(level, box, cell, a, b)
    free = True
    dy = box.y - cy
    oy = abs(dy) + half - 12
    if oy > 0:
        side = UP if dy < 0 else DOWN
        sign = 1.0 if dy < 0 else -1.0
        for push in _side(level, world, box, cell, side, 0.0, oy * sign):
            free = False
            yield push
    dx = box.x - cx
    ox = abs(dx) + half - 12
    if ox > 0:
        side = LEFT if dx < 0 else RIGHT
        sign = 1.0 if dx < 0 else -1.0
        for push in _side(level, world, box, cell, side, ox * sign, 0.0):
            free = False
            yield push
    if free and ox > 0 and oy > 0:
        beside = cell + (1 if dx > 0 else -1)
        corner = beside + (STRIDE if dy > 0 else -STRIDE)
        a, b = (-ox if dx > 0 else ox, 0.0) if ox < oy else (0.0, -oy if dy > 0 else oy)
        yield from _narrow(level, box, corner, a, b)


def _side(level: TileMap, world: World, box: Box, cell: int, side: int, a: float, b: float) -> Iterator[Push]:
    """Over one edge of the own cell: a solid edge pushes back, an interesting one asks the tile behind it."""
    edge = world.edges[4 * cell + side]
    if edge == SOLID:
        yield _push(box, a, b, (a > 0) - (a < 0), (b > 0) - (b < 0))
    elif edge != OFF:
        yield from _narrow(level, box, cell + (1, STRIDE, -1, -STRIDE)[side], a, b)


def _push(box: Box, a: float, b: float, nx: float, ny: float) -> Push:
    box.x += a
    box.y += b
    return a, b, nx, ny


def _narrow(level: TileMap, box: Box, cell: int, a: float, b: float) -> Iterator[Push]:
    """One tile: out along its surface, or along the axis (a, b) if that is shorter."""
    tile = level.tiles[cell]
    shape = tiles.SHAPE[tile]
    if shape in {tiles.EMPTY, tiles.UNDEFINED}:
        return
    m = (a * a + b * b) ** 0.5
    axis = a, b, (a > 0) - (a < 0), (b > 0) - (b < 0)
    sx, sy = tiles.SIGN_X[tile], tiles.SIGN_Y[tile]
    kx, ky = box.x - sx * box.half, box.y - sy * box.half
    if shape == tiles.FULL:
        yield _push(box, *axis)
        return
    if shape in {tiles.CONCAVE, tiles.CONVEX}:
        out = _round_push(shape, kx, ky, tiles.CENTRE_X[cell], tiles.CENTRE_Y[cell], sx, sy)
    else:
        nx, ny = (sx, sy) if shape == tiles.HALF_TILE else (tiles.NORMAL_X[tile], tiles.NORMAL_Y[tile])
        dx, dy = kx - tiles.CENTRE_X[cell] - tiles.ANCHOR_X[tile], ky - tiles.CENTRE_Y[cell] - tiles.ANCHOR_Y[tile]
        depth = dx * nx + dy * ny
        out = (-depth, nx, ny) if depth < 0 else None
    if out is not None:
        depth, nx, ny = out
        yield _push(box, *(axis if m < depth else (nx * depth, ny * depth, nx, ny)))


def _round_push(
    shape: int, kx: float, ky: float, cx: float, cy: float, sx: float, sy: float
) -> tuple[float, float, float] | None:
    """Depth and normal in a quarter arc; a depth without end where only the axis will do."""
    sign = 1.0 if shape == tiles.CONCAVE else -1.0
    dx, dy = sign * (cx + sign * sx * 12 - kx), sign * (cy + sign * sy * 12 - ky)
    if shape == tiles.CONVEX and (sx * dx < 0 or sy * dy < 0):
        return float("inf"), 0.0, 0.0
    length = (dx * dx + dy * dy) ** 0.5
    depth = sign * (length - 24)
    return (depth, dx / length, dy / length) if depth > 0 and length > 0 else None
