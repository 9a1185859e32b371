"""The tiles of a level in one size, on a sheet that is transparent elsewhere."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from math import cos, pi, sin

import pygame

from ninja_game.sim.collision import tiles
from ninja_game.sim.collision.tiles import EMPTY, FULL, SHAPE
from ninja_game.sim.grid import Point
from ninja_game.sim.rules import GRID_COLUMNS, GRID_ROWS, STRIDE
from ninja_game.ui.canvas import Canvas
from ninja_game.view.sprites.sketch import ENLARGED

TileKey = tuple[int, int, int, float, float]  # tile, size, and offset from the px


class TileSheet:
    """All tiles. ``surface``: premultiplied; its px count from the upper left corner of the stage's visible part."""

    def __init__(self, canvas: Canvas, colour: pygame.Color) -> None:
        self.colour = colour
        self.surface = pygame.Surface(canvas.size, pygame.SRCALPHA)
        self._set_canvas(canvas)
        self._shown: dict[tuple[int, int], TileKey] = {}
        # A bit for each column of a row that is not empty.
        self._rows = [0] * GRID_ROWS

    def _set_canvas(self, canvas: Canvas) -> None:
        self.canvas = canvas
        self._corner = canvas.stage.topleft
        self._shift = canvas.origin[0] - self._corner[0], canvas.origin[1] - self._corner[1]

    def scroll(self, canvas: Canvas, grid: Sequence[int]) -> None:
        """Show another part of the level at the same scale."""
        x, y = self._shift
        self._set_canvas(canvas)
        kept = scrolled(self.surface, self._shift[0] - x, self._shift[1] - y)
        for area in rects_around(kept, self.surface.get_rect()):
            self.surface.fill((0, 0, 0, 0), area)
        self.show(grid, kept)

    def show(self, grid: Sequence[int], kept: pygame.Rect | None = None) -> None:
        """Show a world's tiles. ``kept``: px that show them already."""
        visible, logical = self.canvas.stage, self.canvas.logical
        (left, top), (right, bottom) = logical(visible.topleft), logical((visible.right, visible.bottom))
        for row in range(GRID_ROWS)[int((top - 1) / 24) : int(bottom / 24) + 1]:
            for column in range(GRID_COLUMNS)[int((left - 1) / 24) : int(right / 24) + 1]:
                if not (kept and kept.contains(self.cell(column, row))):
                    self.draw(column, row, grid[(row + 1) * STRIDE + column + 1])

    def cell(self, column: int, row: int) -> pygame.Rect:
        """The px of a cell, between its rounded edges."""
        return self.canvas.rect(24 * column, 24 * row, 24, 24).move(-self._corner[0], -self._corner[1])

    def draw(self, column: int, row: int, tile: int) -> None:
        """Draw a tile into a cell, replacing what was there."""
        bit = 1 << column
        filled, before = SHAPE[tile] != EMPTY, self._rows[row] & bit
        if not filled and not before:
            return
        rect = self.cell(column, row)
        if before:
            self._rows[row] ^= bit
            self._shown.pop((column, row), None)
            self.surface.fill((0, 0, 0, 0), rect)
        if filled:
            self._rows[row] |= bit
            if not rect.colliderect(self.surface.get_rect()):
                return
            key = self.key(column, row, tile)
            self._shown[column, row] = key
            self._draw_tile(self.surface, key, rect, self.colour)

    def in_colour(self, colour: pygame.Color) -> pygame.Surface:
        """The sheet in another colour."""
        other = pygame.Surface(self.surface.size, pygame.SRCALPHA)
        for cell, key in self._shown.items():
            self._draw_tile(other, key, self.cell(*cell), colour)
        return other

    def _draw_tile(self, surface: pygame.Surface, key: TileKey, rect: pygame.Rect, colour: pygame.Color) -> None:
        if SHAPE[key[0]] == FULL:
            surface.fill(colour, rect)
        else:
            surface.blit(tile_picture(key[0], key[1:3], tuple(colour), self.canvas.scale, key[3:]), rect)

    def key(self, column: int, row: int, tile: int) -> TileKey:
        """The identity of the picture of a tile in a cell."""
        rect, scale = self.cell(column, row), self.canvas.scale
        # Offset of the cell's true corner from its px: in eighths, so that few pictures are drawn.
        left, top = self._shift[0] + 24 * column * scale, self._shift[1] + 24 * row * scale
        return tile, *rect.size, round(8 * (left - rect.left)) / 8, round(8 * (top - rect.top)) / 8

    def on_tiles(self, areas: Iterable[pygame.Rect]) -> list[pygame.Rect]:
        """The areas with at least one px of a tile."""
        # Inlined, since a picture has a hundred of them.
        left, top = self._shift
        size = 24 * self.canvas.scale
        rows, rects = self._rows, []
        for area in areas:
            x, y, w, h = area
            x, y = x - left, y - top
            columns = (1 << max(0, int((x + w) / size) + 1)) - (1 << max(0, int(x / size)))
            for row in rows[max(0, int(y / size)) : max(0, int((y + h) / size) + 1)]:
                if row & columns:
                    rects.append(area)
                    break
        return rects


def scrolled(surface: pygame.Surface, dx: int, dy: int) -> pygame.Rect:
    """Move a picture by a number of px; its new rectangle. The px around it stay."""
    surface.scroll(dx, dy)
    return surface.get_rect().clip(surface.get_rect(topleft=(dx, dy)))


def rects_around(inner: pygame.Rect, outer: pygame.Rect) -> list[pygame.Rect]:
    """A rectangle without one inside of it, as rectangles that do not overlap."""
    rows = [(outer.top, inner.top), (inner.bottom, outer.bottom)]
    columns = [(outer.left, inner.left), (inner.right, outer.right)]
    found = [pygame.Rect(outer.left, a, outer.width, b - a) for a, b in rows]
    return [*found, *(pygame.Rect(a, inner.top, b - a, inner.height) for a, b in columns)]


HALF = 12.0
_ARC_STEPS = 24


def outline(tile: int) -> list[Point]:
    """The corners of a tile's solid part, px from its cell's centre; [] for an empty one.

    >>> outline(2)
    [(-12.0, 12.0), (-12.0, -12.0), (12.0, 12.0)]
    """
    shape = tiles.SHAPE[tile]
    if shape in {tiles.EMPTY, tiles.UNDEFINED}:
        return []
    if shape == tiles.FULL:
        return [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)]
    sx, sy = tiles.SIGN_X[tile], tiles.SIGN_Y[tile]
    if shape == tiles.HALF_TILE:
        # The half against the open side: the square divided at its middle.
        left, right = (-HALF if sx >= 0 else 0.0), (HALF if sx <= 0 else 0.0)
        top, bottom = (-HALF if sy >= 0 else 0.0), (HALF if sy <= 0 else 0.0)
        return [(left, top), (right, top), (right, bottom), (left, bottom)]
    corner = (-HALF * sx, -HALF * sy)
    if shape in {tiles.CONCAVE, tiles.CONVEX}:
        # A quarter of a circle about the open (concave) or the solid corner, from one end of the surface to the other.
        sign = 1.0 if shape == tiles.CONCAVE else -1.0
        quarter = [pi / 2 * k / _ARC_STEPS for k in range(_ARC_STEPS + 1)]
        return [corner, *((sign * (1 - 2 * sin(a)) * sx * HALF, sign * (1 - 2 * cos(a)) * sy * HALF) for a in quarter)]
    points = [corner, (tiles.T_X[tile], tiles.T_Y[tile]), (tiles.S_X[tile], tiles.S_Y[tile])]
    # The thick wedges reach a second corner of the cell, next to the end of the surface in a side's middle.
    if tiles.T_X[tile] == 0.0:
        points.insert(1, (-HALF * sx, HALF * sy))
    if tiles.S_Y[tile] == 0.0:
        points.append((HALF * sx, -HALF * sy))
    return points


@lru_cache(maxsize=1000)
def tile_picture(
    tile: int, size: tuple[int, int], colour: tuple[int, ...], scale: float = 0.0, shift: Point = (0.0, 0.0)
) -> pygame.Surface:
    """A tile in a cell of that many px, premultiplied. It is shared, so never draw on it.

    ``shift``: px from the cell's px to its true corner, at ``scale`` px per logical px. Slopes are drawn at their true
    place, so that those of neighbouring cells form one line; other shapes fill the cell's px.
    """
    fine = pygame.Surface((size[0] * ENLARGED, size[1] * ENLARGED), pygame.SRCALPHA)
    # Drawing includes the px of the last corner: half a fine px less keeps the shape inside its cell.
    width, height = size[0] * ENLARGED, size[1] * ENLARGED
    if scale and tiles.SHAPE[tile] not in _FITTED:
        zoom = scale * ENLARGED
        corners = [
            ((x + HALF) * zoom + shift[0] * ENLARGED, (y + HALF) * zoom + shift[1] * ENLARGED)
            for x, y in _overlong(tile)
        ]
    else:
        exact = [((x + HALF) / 24 * width, (y + HALF) / 24 * height) for x, y in outline(tile)]
        corners = [(min(x, width - 0.5), min(y, height - 0.5)) for x, y in exact]
    if len(corners) > 2:
        pygame.draw.polygon(fine, colour, corners)
    return pygame.transform.smoothscale(fine, size)


_FITTED = {tiles.EMPTY, tiles.UNDEFINED, tiles.FULL, tiles.HALF_TILE, tiles.CONCAVE, tiles.CONVEX}
"""Shapes that are stretched to the px of their cell."""


def _overlong(tile: int) -> list[Point]:
    """The outline of a slope extended beyond its cell, so that the cell's edges have no gap."""
    start, end = (tiles.T_X[tile], tiles.T_Y[tile]), (tiles.S_X[tile], tiles.S_Y[tile])
    dx, dy = end[0] - start[0], end[1] - start[1]
    longer = {start: (start[0] - dx / 12, start[1] - dy / 12), end: (end[0] + dx / 12, end[1] + dy / 12)}
    return [longer.get(point, (point[0] * 1.2, point[1] * 1.2)) for point in outline(tile)]
