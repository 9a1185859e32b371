"""What moving objects are drawn with: sprites and lines in logical px, and a list of what they covered."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.canvas import Canvas, Colour
from ninja_game.play.ui.palette import Palette
from ninja_game.play.view.sprites.drawing import SpriteKey
from ninja_game.play.view.sprites.sketch import Sprite
from ninja_game.play.view.sprites.sprite_book import SpriteBook

_FAR = 4000
"""Logical px beyond which nothing is drawn: some levels hold objects far off the stage."""


def is_near(x: float, y: float) -> bool:
    """Whether a point is worth drawing at: not far off, and a number."""
    return abs(x) < _FAR and abs(y) < _FAR


class DrawTarget:
    """A surface that shows the stage. ``covered``: px rectangles drawn so far in this picture."""

    def __init__(self, canvas: Canvas, palette: Palette, book: SpriteBook) -> None:
        self.canvas = canvas
        self.palette = palette
        self.book = book
        self.surface: pygame.Surface = pygame.Surface((1, 1))
        self.covered: list[pygame.Rect] = []

    def begin(self, surface: pygame.Surface) -> None:
        """Start a picture."""
        self.surface = surface
        self.covered = []

    def sprite(self, key: SpriteKey, x: float, y: float) -> None:
        """A sprite of the book, its point at (x, y)."""
        if is_near(x, y):
            self.covered.append(self.book.sprite(key).blit(self.surface, self.canvas.point(x, y)))

    def picture(self, sprite: Sprite, x: float, y: float) -> None:
        """A drawing that is not in the book."""
        if is_near(x, y):
            self.covered.append(sprite.blit(self.surface, self.canvas.point(x, y)))

    def line(self, colour: Colour, ax: float, ay: float, bx: float, by: float, width: float = 0) -> None:
        """A straight line; without a width as thin as can be."""
        # A sum, since it is not a number if one of them is none: levels may hold such places.
        if abs(ax) + abs(ay) + abs(bx) + abs(by) < 4 * _FAR:
            a, b = self.canvas.exact(ax, ay), self.canvas.exact(bx, by)
            thick = max(1, round(width * self.canvas.scale))
            rect = pygame.draw.aaline(self.surface, colour, a, b, thick)
            self.covered.append(rect.inflate(2, 2))

    def disc(self, colour: Colour, x: float, y: float, radius: float) -> None:
        """A small filled circle."""
        if is_near(x, y):
            px = max(1, round(radius * self.canvas.scale))
            rect = pygame.draw.aacircle(self.surface, colour, self.canvas.point(x, y), px)
            self.covered.append(rect.inflate(2, 2))
