"""Small drawings: flat shapes in logical px, drawn four times as large and averaged down, so that every edge is smooth.

The result is premultiplied by its alpha: only then is averaging right, and SDL blends it faster.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import ceil, cos, floor, radians, sin
from typing import NamedTuple

import pygame

from ninja_game.sim.grid import Point
from ninja_game.ui.canvas import Colour, draw_limb

ENLARGED = 4  # how many times larger the shapes are drawn


class Sprite(NamedTuple):
    """A finished drawing: premultiplied; (``ax``, ``ay``): its px at the drawn point."""

    surface: pygame.Surface
    ax: int
    ay: int

    def blit(self, target: pygame.Surface, at: tuple[int, int]) -> pygame.Rect:
        """Draw it with its point at a px; the covered px."""
        surface, ax, ay = self
        return target.blit(surface, (at[0] - ax, at[1] - ay), None, pygame.BLEND_PREMULTIPLIED)


class Sketch:
    """A sheet for one drawing about the point (0, 0).

    ``extent``: reach to the left, up, right and down, logical px (the first two usually negative). ``turn``: degrees
    clockwise by which everything is turned; ``fine``: how many times larger the shapes are drawn. ``grown``: px by
    which strokes and discs are wider to all sides.
    """

    def __init__(
        self, scale: float, extent: tuple[float, float, float, float], *, turn: float = 0, fine: int = ENLARGED
    ) -> None:
        left, top, right, bottom = extent
        self._ax, self._ay = ceil(-left * scale) + 1, ceil(-top * scale) + 1
        self._size = floor(right * scale) + 2 + self._ax, floor(bottom * scale) + 2 + self._ay
        self._fine_by = fine
        self.grown = 0.0
        self._zoom = scale * fine
        self._fine = pygame.Surface((self._size[0] * fine, self._size[1] * fine), pygame.SRCALPHA)
        self._cos, self._sin = cos(radians(turn)), sin(radians(turn))

    def _at(self, x: float, y: float) -> Point:
        x, y = x * self._cos - y * self._sin, x * self._sin + y * self._cos
        return self._ax * self._fine_by + x * self._zoom, self._ay * self._fine_by + y * self._zoom

    def polygon(self, colour: Colour, points: Sequence[Point]) -> None:
        pygame.draw.polygon(self._fine, colour, [self._at(x, y) for x, y in points])

    def box(self, colour: Colour, x: float, y: float, w: float, h: float) -> None:
        """A filled rectangle with its upper left corner at (x, y)."""
        self.polygon(colour, [(x, y), (x + w, y), (x + w, y + h), (x, y + h)])

    def framed_box(
        self, fill: Colour, edge: Colour, x: float, y: float, w: float, h: float, width: float = 0.9
    ) -> None:
        """A filled rectangle with an edge inside of it."""
        self.box(edge, x, y, w, h)
        self.box(fill, x + width, y + width, w - 2 * width, h - 2 * width)

    def disc(self, colour: Colour, x: float, y: float, radius: float) -> None:
        pygame.draw.circle(self._fine, colour, self._at(x, y), (radius + self.grown) * self._zoom)

    def ring(self, colour: Colour, x: float, y: float, radius: float, width: float) -> None:
        """A circle's line, ``width`` wide inwards."""
        pygame.draw.circle(self._fine, colour, self._at(x, y), radius * self._zoom, max(1, round(width * self._zoom)))

    def stroke(self, colour: Colour, a: Point, b: Point, width: float, end_width: float | None = None) -> None:
        """A line with round ends; with ``end_width`` it tapers."""
        self.limb(colour, (a, b), (width, width if end_width is None else end_width))

    def rays(self, colour: Colour, angles: Iterable[float], near: float, far: float, width: float) -> None:
        """Strokes away from (0, 0), at some angles (degrees), from ``near`` to ``far`` px."""
        for x, y in ((cos(radians(angle)), sin(radians(angle))) for angle in angles):
            self.stroke(colour, (near * x, near * y), (far * x, far * y), width)

    def path(self, colour: Colour, points: Sequence[Point], width: float) -> None:
        self.limb(colour, points, [width] * len(points))

    def limb(self, colour: Colour, joints: Sequence[Point], widths: Sequence[float]) -> None:
        """A line through joints, with a radius at each and round ends."""
        # Directly in the sheet's px: a figure has some fifty of these, and is drawn again for each picture.
        zoom, cosine, sine = self._zoom, self._cos, self._sin
        left, top = self._ax * self._fine_by, self._ay * self._fine_by
        places = [(left + (x * cosine - y * sine) * zoom, top + (x * sine + y * cosine) * zoom) for x, y in joints]
        draw_limb(self._fine, colour, places, [(width / 2 + self.grown) * zoom for width in widths])

    def finish(self, alpha: float = 1.0) -> Sprite:
        """The drawing, with an opacity of ``alpha`` (0…1)."""
        surface = pygame.transform.smoothscale(self._fine, self._size)
        if alpha < 1.0:
            level = max(0, min(255, round(255 * alpha)))
            surface.fill((level, level, level, level), special_flags=pygame.BLEND_RGBA_MULT)
        return Sprite(surface, self._ax, self._ay)


def star(points: int, outer: float, inner: float, turn: float = 0) -> list[Point]:
    """The corners of a star about (0, 0), one point upwards."""
    corners = []
    for k in range(2 * points):
        angle = radians(turn - 90 + 180 * k / points)
        radius = inner if k % 2 else outer
        corners.append((radius * cos(angle), radius * sin(angle)))
    return corners


def arc(x: float, y: float, radius: float, start: float, end: float, steps: int = 16) -> list[Point]:
    """Points of a circle's arc from ``start`` to ``end`` degrees, clockwise from the right."""
    angles = [radians(start + (end - start) * k / steps) for k in range(steps + 1)]
    return [(x + radius * cos(angle), y + radius * sin(angle)) for angle in angles]
