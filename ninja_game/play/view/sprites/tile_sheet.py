"""The tiles of a level in one size, on a sheet that is transparent elsewhere."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.palette import Palette
from ninja_game.play.view.sprites.tile_shapes import tile_picture
from ninja_game.sim.collision.tiles import EMPTY, SHAPE
from ninja_game.sim.memory.schema import TileMap
from ninja_game.sim.rules import GRID_COLUMNS, GRID_ROWS, STRIDE

TilePictures = dict[tuple[int, int, int, float, float], pygame.Surface]
"""By tile, size and place beside the px."""


class TileSheet:
    """``surface``: premultiplied; its px count from the upper left corner of what is seen of the stage.

    ``pictures``: those that were made before, at the same scale in the same palette.
    """

    def __init__(self, canvas: Canvas, palette: Palette, pictures: TilePictures | None = None) -> None:
        self.canvas = canvas
        self._corner = canvas.stage.topleft
        self._shift = canvas.origin[0] - self._corner[0], canvas.origin[1] - self._corner[1]
        self.palette = palette
        self.surface = pygame.Surface(canvas.size, pygame.SRCALPHA)
        # A bit for each column of a row that is not empty.
        self._rows = [0] * GRID_ROWS
        self._pictures: TilePictures = {} if pictures is None else pictures

    def show(self, level: TileMap) -> None:
        """Draw all cells."""
        for row in range(GRID_ROWS):
            for column in range(GRID_COLUMNS):
                self.draw(column, row, level.tiles[(row + 1) * STRIDE + column + 1])

    def cell(self, column: int, row: int) -> pygame.Rect:
        """The px of a cell, between its rounded edges."""
        return self.canvas.rect(24 * column, 24 * row, 24, 24).move(-self._corner[0], -self._corner[1])

    def draw(self, column: int, row: int, tile: int) -> None:
        """Show a tile in a cell, in the place of what is there."""
        bit = 1 << column
        filled, before = SHAPE[tile] != EMPTY, self._rows[row] & bit
        if not filled and not before:
            return
        rect, scale = self.cell(column, row), self.canvas.scale
        if before:
            self._rows[row] ^= bit
            self.surface.fill((0, 0, 0, 0), rect)
        if filled:
            self._rows[row] |= bit
            if not rect.colliderect(self.surface.get_rect()):
                return
            # How far the cell's true corner lies beside its px: in eighths, so that few pictures are drawn.
            left, top = self._shift[0] + 24 * column * scale, self._shift[1] + 24 * row * scale
            shift = round(8 * (left - rect.left)) / 8, round(8 * (top - rect.top)) / 8
            key = tile, *rect.size, *shift
            if key not in self._pictures:
                self._pictures[key] = tile_picture(tile, rect.size, self.palette.tile, scale=scale, shift=shift)
            self.surface.blit(self._pictures[key], rect)

    def has_tile(self, area: pygame.Rect) -> bool:
        """Whether any px of an area may be a tile's."""
        scale = 24 * self.canvas.scale
        area = area.move(-self._shift[0], -self._shift[1])
        first_column, last_column = max(0, int(area.left / scale)), min(GRID_COLUMNS - 1, int(area.right / scale))
        first_row, last_row = max(0, int(area.top / scale)), min(GRID_ROWS - 1, int(area.bottom / scale))
        columns = (1 << max(0, last_column + 1)) - (1 << min(first_column, GRID_COLUMNS))
        for row in range(first_row, last_row + 1):  # noqa: SIM110 - a hundred times a picture
            if self._rows[row] & columns:
                return True
        return False
