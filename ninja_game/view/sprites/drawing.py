"""A drawing: a function over a sketch, with its extent; called with its parameters it gives the key of a sprite."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Concatenate, Generic, NamedTuple, ParamSpec

import pygame

from ninja_game.ui.canvas import Canvas, Colour
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.sketch import Sketch, Sprite

Extent = tuple[float, float, float, float]
"""Reach of a drawing to the left, up, right and down from its point, logical px."""

P = ParamSpec("P")


class SpriteKey(NamedTuple):
    """The identity of a sprite. ``turn``: degrees clockwise; ``alpha``: 0 to 8 eighths.

    The parameters are whole numbers or words: few enough to keep every sprite.
    """

    drawing: Drawing[Any]
    parameters: tuple[Any, ...]
    turn: int = 0
    alpha: int = 8

    def turned(self, degrees: int) -> SpriteKey:
        """This sprite, turned clockwise."""
        return SpriteKey(self.drawing, self.parameters, degrees, self.alpha)

    def faded(self, alpha: int) -> SpriteKey:
        """This sprite with ``alpha`` eighths of its opacity."""
        return SpriteKey(self.drawing, self.parameters, self.turn, alpha)


@dataclass(frozen=True, eq=False)
class Drawing(Generic[P]):
    """The content of a sprite: ``paint(sketch, palette, *parameters)`` draws it within ``extent``."""

    extent: Extent
    paint: Callable[Concatenate[Sketch, Palette, P], None]

    def __call__(self, *parameters: P.args, **_named: P.kwargs) -> SpriteKey:
        """The key of this drawing with these parameters."""
        return SpriteKey(self, parameters)


def drawn_within(*extent: float) -> Callable[[Callable[Concatenate[Sketch, Palette, P], None]], Drawing[P]]:
    """Make a drawing from a function. One number as ``extent`` is a reach to all sides."""
    reach = extent[0]
    box = (-reach, -reach, reach, reach) if len(extent) == 1 else (extent[0], extent[1], extent[2], extent[3])
    return lambda paint: Drawing(box, paint)


_FAR = 4000  # logical px beyond which nothing is drawn: some levels hold objects far off the stage


def is_near(x: float, y: float) -> bool:
    """Whether a point is a number and near enough to draw at."""
    return abs(x) < _FAR and abs(y) < _FAR


class DrawTarget:
    """A surface with the stage. ``covered``: px rectangles drawn so far in this picture.

    A rectangle within the one before, such as a drone's eye, is left out.
    """

    def __init__(self, canvas: Canvas, palette: Palette, book: SpriteBook) -> None:
        self.canvas = canvas
        self.palette = palette
        self.book = book
        self.surface: pygame.Surface = pygame.Surface((1, 1))
        self.covered: list[pygame.Rect] = []

    def begin(self, surface: pygame.Surface) -> None:
        self.surface = surface
        self.covered = []

    def sprite(self, key: SpriteKey, x: float, y: float) -> None:
        """A sprite of the book, its point at (x, y)."""
        self._put(self.book.sprite(key), x, y)

    def picture(self, sprite: Sprite, x: float, y: float) -> None:
        """A drawing outside of the book."""
        self._put(sprite, x, y)

    def _put(self, sprite: Sprite, x: float, y: float) -> None:
        # Inlined is_near, Canvas.point and Sprite.blit: called a hundred times per picture.
        if -_FAR < x < _FAR and -_FAR < y < _FAR:
            (left, top), scale, covered = self.canvas.origin, self.canvas.scale, self.covered
            surface, ax, ay = sprite
            place = left + round(x * scale) - ax, top + round(y * scale) - ay
            rect = self.surface.blit(surface, place, None, pygame.BLEND_PREMULTIPLIED)
            if not (covered and covered[-1].contains(rect)):
                covered.append(rect)

    def line(self, colour: Colour, ax: float, ay: float, bx: float, by: float, width: float = 0) -> None:
        """A straight line; without a width as thin as possible."""
        # The sum is NaN if any coordinate is: levels may hold such places.
        if abs(ax) + abs(ay) + abs(bx) + abs(by) < 4 * _FAR:
            a, b = self.canvas.exact(ax, ay), self.canvas.exact(bx, by)
            thick = max(1, round(width * self.canvas.scale))
            rect = pygame.draw.aaline(self.surface, colour, a, b, thick)
            self.covered.append(rect.inflate(2, 2))

    def disc(self, colour: Colour, x: float, y: float, radius: float, width: float = 0) -> None:
        """A disc, or a ring of some ``width``."""
        if is_near(x, y):
            self.covered.append(self.canvas.circle(self.surface, colour, (x, y), radius, width).inflate(2, 2))


_KEPT = 3000


class SpriteBook:
    """The sprites at one scale in one palette. ``sprite``: gives that of a key."""

    def __init__(self, scale: float, palette: Palette) -> None:
        self.scale = scale
        self.palette = palette
        self.sprite = lru_cache(maxsize=_KEPT)(self._drawn)

    def _drawn(self, key: SpriteKey) -> Sprite:
        extent = key.drawing.extent if key.turn == 0 else _turned(key.drawing.extent)
        sketch = Sketch(self.scale, extent, turn=key.turn)
        key.drawing.paint(sketch, self.palette, *key.parameters)
        return sketch.finish(key.alpha / 8)


shared_book = lru_cache(maxsize=8)(SpriteBook)  # shared by all levels that are shown at one scale in one palette


def _turned(extent: Extent) -> Extent:
    """The extent of a drawing that is turned by any angle."""
    reach = max((x * x + y * y) ** 0.5 for x in extent[::2] for y in extent[1::2])
    return -reach, -reach, reach, reach
