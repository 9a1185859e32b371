"""Text at any window size: the game's own letters, round strokes in two weights, cached as pictures.

Letters with accents are composed of their parts. A text with any other character is drawn as a whole in pygame's font.
"""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache
from math import ceil, cos, floor, radians, sin
from typing import NamedTuple

import pygame

from ninja_game.files.bundled import asset_lines
from ninja_game.files.shown_text import shown_text
from ninja_game.sim.grid import Point
from ninja_game.ui.canvas import Canvas, Colour, draw_limb

_KEPT = 400  # cached texts; a running clock adds one per picture

_SHARE_LEFT = {"left": 0.0, "centre": 0.5, "right": 1.0}


class Lettering:
    """Draws text on a canvas; caches the pictures."""

    def __init__(self, canvas: Canvas) -> None:
        self.canvas = canvas
        self._font = lru_cache(self._made_font)
        self._rendered = lru_cache(maxsize=_KEPT)(self._render)

    def _made_font(self, size: float, bold: bool) -> StrokeFont:
        if not pygame.font.get_init():
            pygame.font.init()
        return StrokeFont(max(5.0, size * self.canvas.scale), bold=bold)

    def _render(self, text: str, size: float, colour: tuple[int, ...], bold: bool) -> pygame.Surface:
        return self._font(size, bold).render(_safe(text), pygame.Color(colour))

    def rendered(self, text: str, size: float, colour: Colour, *, bold: bool = False) -> pygame.Surface:
        """The picture of a text in letters of some size, logical px."""
        return self._rendered(text, size, tuple(pygame.Color(colour)), bold)

    def width(self, text: str, size: float, *, bold: bool = False) -> float:
        """Width of a text in logical px."""
        return self._font(size, bold).width(_safe(text)) / self.canvas.scale

    def draw(
        self, surface: pygame.Surface | None, text: str, x: float, y: float, size: float, colour: Colour,
        *, align: str = "left", bold: bool = False,
    ) -> pygame.Rect:  # fmt: skip
        """Draw a text whose top is at logical ``y``; ``align``: whether ``x`` is its "left", "centre" or "right"."""
        picture = self.rendered(text, size, colour, bold=bold)
        rect = picture.get_rect()
        px, py = self.canvas.point(x, y)
        rect.topleft = (px - round(_SHARE_LEFT[align] * rect.width), py)
        if surface is not None:
            surface.blit(picture, rect)
        return rect


@lru_cache(maxsize=_KEPT)
def _safe(text: str) -> str:
    """A text without what could break drawing; four spaces become a wide one."""
    return "\u2003".join(map(shown_text, text.split("    ")))


LINE_HEIGHT = 1.08  # height of a line of text for letters of size 1; capitals are 0.675 of the size
_CAP_SHARE = 0.675
_TOP = 0.1
WEIGHTS = (0.95, 1.42)  # width of the strokes of plain and bold letters, on the glyphs' grid
LETTER_SPACING = 1.18  # free space between two letters, on the grid, stroke ends not counted
_FINE = 4
_LOWERED = 0.8  # height of a tall letter under an accent, as a share of its usual height
_COMMANDS = re.compile(r"([MLQOAD])([^MLQOAD]*)")


CAP = 7.0  # height of capitals on the glyphs' grid
ASCENDERS = frozenset("bdfhklt")  # small letters as tall as capitals: lower under an accent


def _read_glyphs() -> dict[str, tuple[float, str]]:
    """Width and path of every letter and mark of the bundled table."""
    rows = (line.split(" ", 2) for line in asset_lines("glyphs.txt"))
    return {
        chr(int(name, base=0)) if name.startswith("0x") else name: (float(width), "".join(path))
        for name, width, *path in rows
    }


_STROKES = _read_glyphs()
GLYPHS = {name: drawn for name, drawn in _STROKES.items() if not unicodedata.combining(name)}
MARKS = {name: path for name, (_, path) in _STROKES.items() if unicodedata.combining(name)}
ABOVE = 230  # the combining class of marks above a letter


class Glyph(NamedTuple):
    """Width of a letter, and its polylines, on the glyphs' grid; a dot is a line of one point."""

    width: float
    lines: tuple[tuple[Point, ...], ...]


@lru_cache(maxsize=1024)
def glyph_of(character: str) -> Glyph | None:
    """A letter, composed of its parts where it has accents; None for one without strokes."""
    if character in GLYPHS:
        width, path = GLYPHS[character]
        return Glyph(width, _lines(path))
    parts = unicodedata.normalize("NFD", character)
    base, marks = parts[0], parts[1:]
    if base not in GLYPHS or not marks or not set(marks) <= MARKS.keys():
        return None
    raised = any(map(_stands_on_top, marks))
    dotless = {"i": "\u0131", "j": "\u0237"}.get(base, base) if raised else base
    width, path = GLYPHS[dotless]
    lines = _lines(path)
    tall = base.isupper() or base in ASCENDERS
    if raised and tall:
        lines = tuple(tuple((x, CAP - (CAP - y) * _LOWERED) for x, y in line) for line in lines)
    lift = 0.6 if tall else 1.1
    for mark in marks:
        dy = lift if _stands_on_top(mark) else 0.0
        drawn = _lines(MARKS[mark])
        lines += tuple(tuple((x + width / 2, y + dy) for x, y in line) for line in drawn)
    return Glyph(width, lines)


def _stands_on_top(mark: str) -> bool:
    return unicodedata.combining(mark) == ABOVE


def _lines(path: str) -> tuple[tuple[Point, ...], ...]:
    lines: list[list[Point]] = []
    for command, numbers in _COMMANDS.findall(path):
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
            # An arc continues at the pen if it starts there.
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
        self._weight = WEIGHTS[bold]
        self.height = max(1, ceil(size * LINE_HEIGHT))
        self._baseline_top = _TOP * size
        self._pad = self._weight / 2 * self._unit + 1
        self._fallback = pygame.font.Font(None, max(6, round(size * 1.35)))
        self._picture = lru_cache(maxsize=None)(self._draw)
        self.width = lru_cache(maxsize=_KEPT)(self._width)

    def _advance(self, letter: Glyph) -> float:
        """Distance to the next letter, px."""
        return (letter.width + LETTER_SPACING + self._weight) * self._unit

    def _width(self, text: str) -> int:
        """Width of a text, px."""
        if not text:
            return 0
        letters = [glyph_of(character) for character in text]
        if None in letters:
            return self._fallback.size(text)[0] + 2
        return ceil(sum(self._advance(letter) for letter in letters if letter) - LETTER_SPACING * self._unit + 2)

    def _draw(self, character: str, colour: tuple[int, int, int, int], phase: int) -> pygame.Surface:
        """A letter on its own sheet, its origin ``phase`` quarters of a px beside ``_pad`` px from the left."""
        letter = glyph_of(character)
        assert letter is not None  # noqa: S101 - other texts are drawn as a whole
        # One more unit to the left and right: some strokes reach beyond their glyph's width.
        size = ceil((letter.width + 2) * self._unit + 2 * self._pad) + 1, self.height
        # The sheet has the colour everywhere and the letter as alpha: averaging then does not darken its edge.
        fine = pygame.Surface((size[0] * _FINE, size[1] * _FINE), pygame.SRCALPHA)
        fine.fill((*colour[:3], 0))
        zoom = self._unit * _FINE
        left, top = (self._pad + self._unit) * _FINE + phase, self._baseline_top * _FINE
        width = max(_FINE, self._weight * zoom)
        for line in letter.lines:
            points = [(left + x * zoom, top + y * zoom) for x, y in line]
            # A minimum radius, or small dots would vanish.
            radius = max(width * 0.66, 0.85 * _FINE) if len(points) == 1 else width / 2
            draw_limb(fine, colour, points, [radius] * len(points))
        return pygame.transform.smoothscale(fine, size)

    def render(self, text: str, colour: Colour) -> pygame.Surface:
        """The picture of a text. Letters lie on quarters of a px, so that small ones keep their distance."""
        ink = pygame.Color(colour)
        picture = pygame.Surface((max(1, self.width(text)), self.height), pygame.SRCALPHA)
        picture.fill((ink.r, ink.g, ink.b, 0))
        letters = [(character, glyph_of(character)) for character in text]
        if any(letter is None for _, letter in letters):
            # pygame refuses a text of characters without width; a space behind it changes no picture.
            picture.blit(self._fallback.render(f"{text} ", True, ink), (1, round(self._baseline_top * 0.2)))
            return picture
        x = 1 + self._weight / 2 * self._unit
        for character, letter in letters:
            if letter is not None:
                left, phase = divmod(floor((x - self._pad - self._unit) * _FINE), _FINE)
                picture.blit(self._picture(character, tuple(ink), phase), (left, 0))
                x += self._advance(letter)
        return picture
