"""Draws the game's own letters: round strokes at any size, smooth, two weights."""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise
from math import ceil, cos, radians, sin

import pygame

from ninja_game.play.ui.canvas import Colour, Point
from ninja_game.play.ui.glyphs import CAP, GLYPHS

HEIGHT = 1.08
"""Height of a line of text for letters of size 1; capitals are 0.675 of the size."""
_CAP_SHARE = 0.675
_TOP = 0.1
_WEIGHTS = (0.95, 1.42)
"""Width of the strokes of plain and bold letters, on the glyphs' grid."""
_SPACING = 1.18
"""Free space between two letters, on the grid, stroke ends not counted."""
_FINE = 4
_COMMANDS = re.compile(r"([MLQOAD])([^MLQOAD]*)")


@lru_cache(maxsize=256)
def strokes(character: str) -> tuple[tuple[Point, ...], ...]:
    """The polylines of a glyph; a dot is a line of one point."""
    lines: list[list[Point]] = []
    for command, numbers in _COMMANDS.findall(GLYPHS[character][1]):
        values = [float(number) for number in numbers.split()]
        if command in "MD":
            lines.append([(values[0], values[1])])
        elif command == "L":
            lines[-1].append((values[0], values[1]))
        elif command == "Q":
            lines[-1] += _curve(lines[-1][-1], *values)
        else:
            x, y, rx, ry = values[:4]
            start, end = (0.0, 360.0) if command == "O" else (values[4], values[5])
            points = _arc(x, y, rx, ry, start, end)
            # An arc goes on from where the pen is, if that is where it starts.
            joins = lines and command == "A" and _near(lines[-1][-1], points[0])
            if joins:
                lines[-1] += points
            else:
                lines.append(points)
    return tuple(tuple(line) for line in lines)


def _near(a: Point, b: Point) -> bool:
    return abs(a[0] - b[0]) + abs(a[1] - b[1]) < 0.6


def _curve(start: Point, cx: float, cy: float, x: float, y: float) -> list[Point]:
    points = []
    for k in range(1, 11):
        t = k / 10
        a, b, c = (1 - t) ** 2, 2 * t * (1 - t), t * t
        points.append((a * start[0] + b * cx + c * x, a * start[1] + b * cy + c * y))
    return points


def _arc(x: float, y: float, rx: float, ry: float, start: float, end: float) -> list[Point]:
    steps = max(6, int(abs(end - start) / 12))
    angles = [radians(start + (end - start) * k / steps) for k in range(steps + 1)]
    return [(x + rx * cos(angle), y + ry * sin(angle)) for angle in angles]


class StrokeFont:
    """Letters of one size (px) and weight."""

    def __init__(self, size: float, *, bold: bool) -> None:
        self._unit = size * _CAP_SHARE / CAP
        self._weight = _WEIGHTS[bold]
        self.height = max(1, ceil(size * HEIGHT))
        self._baseline_top = _TOP * size
        self._pad = self._weight / 2 * self._unit + 1
        self._fallback = pygame.font.Font(None, max(6, round(size * 1.35)))
        self._glyphs: dict[tuple[str, tuple[int, ...]], pygame.Surface] = {}

    def _advance(self, character: str) -> float:
        """From one letter to the next, px."""
        if character in GLYPHS:
            return (GLYPHS[character][0] + _SPACING + self._weight) * self._unit
        return float(self._fallback.size(character)[0])

    def width(self, text: str) -> int:
        """Width of a text, px."""
        return ceil(sum(map(self._advance, text)) - _SPACING * self._unit + 2) if text else 0

    def _glyph(self, character: str, colour: pygame.Color) -> pygame.Surface:
        """A letter on a sheet of its own, its origin ``_pad`` px from the left."""
        key = character, tuple(colour)
        if key not in self._glyphs:
            self._glyphs[key] = self._draw(character, colour)
        return self._glyphs[key]

    def _draw(self, character: str, colour: pygame.Color) -> pygame.Surface:
        if character not in GLYPHS:
            return self._fallback.render(character, True, colour)
        # One more unit to the left and right: a few strokes reach beyond their glyph's width.
        size = ceil((GLYPHS[character][0] + 2) * self._unit + 2 * self._pad), self.height
        # The colour is everywhere, only the alpha is the letter's: averaging does not darken its edge.
        fine = pygame.Surface((size[0] * _FINE, size[1] * _FINE), pygame.SRCALPHA)
        fine.fill((colour.r, colour.g, colour.b, 0))
        zoom = self._unit * _FINE
        left, top = (self._pad + self._unit) * _FINE, self._baseline_top * _FINE
        width = max(_FINE, self._weight * zoom)
        for line in strokes(character):
            points = [(left + x * zoom, top + y * zoom) for x, y in line]
            # Small dots would be lost.
            radius = max(width * 0.66, 0.85 * _FINE) if len(points) == 1 else width / 2
            for point in points:
                pygame.draw.circle(fine, colour, point, radius)
            for a, b in pairwise(points):
                dx, dy = b[0] - a[0], b[1] - a[1]
                length = (dx * dx + dy * dy) ** 0.5 or 1.0
                nx, ny = -dy / length * radius, dx / length * radius
                pygame.draw.polygon(
                    fine, colour,
                    [(a[0] + nx, a[1] + ny), (b[0] + nx, b[1] + ny), (b[0] - nx, b[1] - ny), (a[0] - nx, a[1] - ny)],
                )  # fmt: skip
        return pygame.transform.smoothscale(fine, size)

    def render(self, text: str, colour: Colour) -> pygame.Surface:
        """The picture of a text."""
        ink = pygame.Color(colour)
        picture = pygame.Surface((max(1, self.width(text)), self.height), pygame.SRCALPHA)
        picture.fill((ink.r, ink.g, ink.b, 0))
        x = 1 + self._weight / 2 * self._unit
        for character in text:
            own = character in GLYPHS
            glyph = self._glyph(character, ink)
            place = (round(x - self._pad - self._unit), 0) if own else (round(x), round(self._baseline_top * 0.2))
            picture.blit(glyph, place)
            x += self._advance(character)
        return picture
