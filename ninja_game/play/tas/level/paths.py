"""The ways of runs over the level: drawn once, and again only where they change."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.formats.replay.input_runs import Marker
from ninja_game.play.replay.paths import draw_path
from ninja_game.play.tas.bench import Span
from ninja_game.play.ui.canvas import HEIGHT, WIDTH, Canvas, Point
from ninja_game.play.ui.theme import Theme
from ninja_game.simulation import ObjectView
from ninja_game.tas.course import Course

Positions = NDArray[np.float64]

NEAR = 40
"""Ticks before and after the cursor whose way is bright."""
_DOT_EVERY = 10
"""Ticks between two dots on the bright way."""
FAINT, CLEAR = 110, 190
"""Of 255: how solid ways are."""
_BLOCK = 1000
"""Ticks by which the part of a long run moves whose way is shown."""
_LETTERS = 16
"""Size of names and numbers in the level, px of the level."""
_LONGEST_NAME = 180
"""px of the level."""


def shaded(colour: pygame.Color, alpha: int) -> pygame.Color:
    """A colour that lets shine through what is below."""
    return pygame.Color(colour.r, colour.g, colour.b, alpha)


def shown_span(cursor: int) -> Span:
    """The ticks whose ways are shown: more would be a tangle."""
    middle = cursor - cursor % _BLOCK
    return max(0, middle - 2 * _BLOCK), middle + 4 * _BLOCK


class Way(NamedTuple):
    """The way of another run in the ticks ``first`` … ``last`` - 1; ``alpha``: of 255, how solid."""

    course: Course
    colour: pygame.Color
    first: int
    last: int
    alpha: int = CLEAR


class WayLayer:
    """One surface with the way of one run, to which more ticks are added as they are known."""

    def __init__(self, canvas: Canvas, colour: pygame.Color) -> None:
        self.surface = pygame.Surface(canvas.size, pygame.SRCALPHA)
        self._canvas = canvas
        self._colour = colour
        self._drawn: Positions = np.zeros((0, 2))

    def show(self, positions: Positions) -> None:
        """Show this way; what it has in common with the last one stays."""
        known = len(self._drawn)
        if known > len(positions) or not np.array_equal(self._drawn, positions[:known]):
            self.surface.fill((0, 0, 0, 0))
            known = 0
        draw_path(self.surface, self._canvas, positions[max(0, known - 1) :], self._colour)
        self._drawn = positions


class LevelPaths:
    """What lies over a picture of the level in one size and palette. ``theme``: of that picture."""

    def __init__(self, theme: Theme) -> None:
        self.theme = theme
        self._present = WayLayer(theme.canvas, shaded(theme.palette.accent, FAINT))
        self._under = pygame.Surface(theme.canvas.size, pygame.SRCALPHA)
        self._beside: tuple[Way, ...] = ()

    def draw_beside(self, surface: pygame.Surface, ways: Sequence[Way]) -> None:
        """The other runs."""
        if tuple(ways) != self._beside:
            self._beside = tuple(ways)
            self._under.fill((0, 0, 0, 0))
            for way in ways:
                positions = way.course.positions[way.first : way.last]
                draw_path(self._under, self.theme.canvas, positions, shaded(way.colour, way.alpha))
        surface.blit(self._under, (0, 0))

    def draw_present(
        self, surface: pygame.Surface, positions: Positions, cursor: int, selected: Span, shown: Span
    ) -> None:
        """The run itself: faint, brighter near the cursor and dotted there; the selected ticks stand out."""
        canvas, palette = self.theme.canvas, self.theme.palette
        self._present.show(positions[slice(*shown)])
        surface.blit(self._present.surface, (0, 0))
        first, last = selected
        if last - first > 1:
            draw_path(surface, canvas, positions[max(0, first - 1) : last], palette.good, 5)
        low = max(0, cursor - NEAR)
        draw_path(surface, canvas, positions[low : cursor + NEAR + 1], palette.accent)
        for tick in range(low + -low % _DOT_EVERY, min(len(positions), cursor + NEAR + 1), _DOT_EVERY):
            canvas.circle(surface, palette.accent, _point(positions, tick), 3)

    def draw_flags(self, surface: pygame.Surface, positions: Positions, markers: Sequence[Marker]) -> None:
        """A flag where each marked tick is, with its name."""
        canvas, palette = self.theme.canvas, self.theme.palette
        for tick, name in markers:
            if tick < len(positions):
                x, y = _point(positions, tick)
                canvas.line(surface, palette.outline, (x, y), (x, y - 26), 1.5)
                canvas.polygon(surface, palette.good, [(x, y - 26), (x + 13, y - 21), (x, y - 16)])
                self._label(surface, name, x + 16, y - 30, palette.text)

    def draw_hover(self, surface: pygame.Surface, positions: Positions, tick: int) -> None:
        """A ring where the run is after a tick, and its number."""
        x, y = _point(positions, tick)
        self.theme.canvas.circle(surface, self.theme.palette.text, (x, y), 9, 2)
        self._label(surface, str(tick), x + 13, y + 4, self.theme.palette.text)

    def draw_object(self, surface: pygame.Surface, seen: ObjectView) -> None:
        """What an object is and its id, above it."""
        self._label(surface, f"{seen.kind} {seen.id}", seen.x + 10, seen.y - 26, self.theme.palette.text)

    def draw_name(self, surface: pygame.Surface, name: str, at: Point, colour: pygame.Color) -> None:
        """The name of a ghost, above it."""
        name = self.theme.fit(name, _LONGEST_NAME, _LETTERS)
        self._label(surface, name, at[0] - 8, at[1] - 34, colour)

    def _label(self, surface: pygame.Surface, text: str, x: float, y: float, colour: pygame.Color) -> None:
        """A small text on a plate, inside of the picture."""
        theme = self.theme
        w = theme.width(text, _LETTERS)
        x, y = min(max(2.0, x), WIDTH - w - 8), min(max(2.0, y), HEIGHT - 24)
        plate = shaded(theme.palette.background, 200)
        theme.canvas.fill_rect(surface, plate, x - 3, y - 1, w + 6, _LETTERS + 5, 2)
        theme.text(surface, text, x, y, size=_LETTERS, colour=colour)


def first_other_place(ours: Positions, theirs: Positions) -> int:
    """The first tick after which two runs are at different places; the length of the shorter one if there is none."""
    shared = min(len(ours), len(theirs))
    other = np.flatnonzero((ours[:shared] != theirs[:shared]).any(axis=1))
    return int(other[0]) if len(other) else shared


def _point(positions: Positions, tick: int) -> Point:
    return float(positions[tick, 0]), float(positions[tick, 1])
