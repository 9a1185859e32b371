"""The paths of runs over the level, of which only changed parts are drawn again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.formats.replay.notations import Marker
from ninja_game.play.replay.paths import draw_path
from ninja_game.sim.grid import Point
from ninja_game.sim.rules import RADIUS
from ninja_game.simulation import ObjectView
from ninja_game.tas.timeline import Trajectory
from ninja_game.tas_editor.editor import Span
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import Theme

Positions = NDArray[np.float64]

BRIGHT_TICKS = 40  # ticks before and after the cursor with a bright path
_DOT_EVERY = 10  # ticks between two dots on the bright path
_CLOSE = 0.5  # px of the level per px of the window, below which each tick has a dot
FAINT, CLEAR = 110, 190  # opacity of paths, of 255
_BLOCK = 1000  # ticks by which the visible part of a long run moves
LETTERS = 9  # size of texts over the level, in logical px of the TAS editor, as all sizes here
_MAX_NAME = 100
_THIN = 0.8  # width of paths
_THICK = 2.7  # width of their selected part


def with_alpha(colour: pygame.Color, alpha: int) -> pygame.Color:
    return pygame.Color(colour.r, colour.g, colour.b, alpha)


def shown_span(cursor: int) -> Span:
    """The ticks with a visible path: more would be a tangle."""
    middle = cursor - cursor % _BLOCK
    return max(0, middle - 2 * _BLOCK), middle + 4 * _BLOCK


class OtherRunPath(NamedTuple):
    """The path of another run in the ticks ``first`` … ``last`` - 1; ``alpha``: opacity, of 255."""

    trajectory: Trajectory
    colour: pygame.Color
    first: int
    last: int
    alpha: int = CLEAR


class LevelPaths:
    """Draws paths of runs over a picture of the level. ``canvas``: the picture's; ``theme``: the TAS editor's."""

    def __init__(self, theme: Theme, canvas: Canvas) -> None:
        self.theme = theme
        self.canvas = canvas
        # The run's own path, which is extended as ticks become known.
        self._present = pygame.Surface(canvas.window, pygame.SRCALPHA)
        self._present_covered = pygame.Rect(0, 0, 0, 0)
        self._drawn: Positions = np.zeros((0, 2))
        self._under = pygame.Surface(canvas.window, pygame.SRCALPHA)
        self._covered = pygame.Rect(0, 0, 0, 0)
        self._beside: tuple[OtherRunPath, ...] = ()
        self.labels: list[pygame.Rect] = []

    def _px(self, length: float) -> float:
        """A length of the TAS editor in px of the level: drawings over the level do not grow with it."""
        return length * self.theme.canvas.scale / self.canvas.scale

    def _put(self, surface: pygame.Surface, layer: pygame.Surface, covered: pygame.Rect) -> None:
        area = covered.clip(self.canvas.stage)
        surface.blit(layer, area, area)

    def draw_beside(self, surface: pygame.Surface, paths: Sequence[OtherRunPath]) -> None:
        """Begin a picture, with the other runs."""
        self.labels.clear()
        if tuple(paths) != self._beside:
            self._beside = tuple(paths)
            self._under.fill((0, 0, 0, 0), self._covered)
            drawn = []
            for path in paths:
                positions = path.trajectory.positions[path.first : path.last]
                colour = with_alpha(path.colour, path.alpha)
                drawn.append(draw_path(self._under, self.canvas, positions, colour, self._px(_THIN)))
            self._covered = union_of(drawn)
        self._put(surface, self._under, self._covered)

    def draw_present(
        self, surface: pygame.Surface, positions: Positions, cursor: int, selected: Span, shown: Span
    ) -> None:
        """The run itself: faint, bright and dotted near the cursor; the selected ticks thick."""
        canvas, palette = self.canvas, self.theme.palette
        self._extend(positions[slice(*shown)])
        self._put(surface, self._present, self._present_covered)
        first, last = selected
        if last - first > 1:
            draw_path(surface, canvas, positions[max(0, first - 1) : last], palette.good, self._px(_THICK))
        low = max(0, cursor - BRIGHT_TICKS)
        draw_path(surface, canvas, positions[low : cursor + BRIGHT_TICKS + 1], palette.accent, self._px(_THIN))
        every = 1 if self._px(1.0) < _CLOSE else _DOT_EVERY
        for tick in range(low + -low % every, min(len(positions), cursor + BRIGHT_TICKS + 1), every):
            radius = 1.0 if tick % _DOT_EVERY else 1.6
            canvas.circle(surface, palette.accent, _point(positions, tick), self._px(radius))

    def _extend(self, positions: Positions) -> None:
        """Show this path of the run; the part in common with the last one is kept."""
        count = len(self._drawn)
        if count > len(positions) or not np.array_equal(self._drawn, positions[:count]):
            self._present.fill((0, 0, 0, 0), self._present_covered)
            self._present_covered, count = pygame.Rect(0, 0, 0, 0), 0
        colour = with_alpha(self.theme.palette.accent, FAINT)
        added = positions[max(0, count - 1) :]
        rect = draw_path(self._present, self.canvas, added, colour, self._px(_THIN))
        self._present_covered = union_of([self._present_covered, rect])
        self._drawn = positions

    def draw_flags(self, surface: pygame.Surface, positions: Positions, markers: Sequence[Marker]) -> None:
        canvas, palette, px = self.canvas, self.theme.palette, self._px
        for tick, name in markers:
            if tick < len(positions):
                x, y = at = _point(positions, tick)
                canvas.line(surface, palette.outline, at, (x, y - px(14)), px(_THIN))
                tips = [(x, y - px(14)), (x + px(7), y - px(11)), (x, y - px(8.5))]
                self.labels.append(canvas.polygon(surface, palette.good, tips))
                self._label(surface, self.theme.fit(name, _MAX_NAME, LETTERS), at, (8.5, -16), palette.text)

    def draw_hover(self, surface: pygame.Surface, positions: Positions, tick: int) -> None:
        at = _point(positions, tick)
        self.canvas.circle(surface, self.theme.palette.text, at, self._px(4.8), self._px(1))
        self._label(surface, str(tick), at, (7, 2), self.theme.palette.text)

    def draw_object(self, surface: pygame.Surface, seen: ObjectView) -> None:
        self._label(surface, f"{seen.kind} {seen.id}", (seen.x, seen.y), (5, -14), self.theme.palette.text)

    def draw_names(self, surface: pygame.Surface, ghosts: Sequence[tuple[str, Point, pygame.Color]], at: Point) -> None:
        """The names of ghosts ("": none) above them; no name covers a ghost or the ninja, which is ``at`` a place."""
        places = [at, *(place for _, place, _ in ghosts)]
        ninjas = [self.canvas.rect(x - RADIUS, y - RADIUS, 2 * RADIUS, 2 * RADIUS) for x, y in places]
        self.labels[:0] = ninjas
        above = -RADIUS * self.canvas.scale / self.theme.canvas.scale - LETTERS - 4
        for name, place, colour in ghosts:
            if name:
                self._label(surface, self.theme.fit(name, _MAX_NAME, LETTERS), place, (-4, above), colour)
        del self.labels[: len(ninjas)]

    def _label(self, surface: pygame.Surface, text: str, at: Point, beside: Point, colour: pygame.Color) -> None:
        """A small text on a plate beside a place of the level, kept inside of the picture if the place is."""
        theme, px = self.theme, self.canvas.point(*at)
        if not surface.get_rect().collidepoint(px):
            return
        # The TAS editor fills its window: its logical px begin at the window's corner.
        scale = theme.canvas.scale
        w = theme.width(text, LETTERS)
        width, height = surface.get_size()
        x = min(max(1.0, px[0] / scale + beside[0]), width / scale - w - 4)
        y = min(max(1.0, px[1] / scale + beside[1]), height / scale - 13)
        plate = theme.canvas.rect(x - 1.5, y - 0.5, w + 3, LETTERS + 2.5)
        up = beside[1] < 0
        while (hidden := plate.collidelist(self.labels)) >= 0 and self.labels[hidden].bottom < surface.get_height():
            other = self.labels[hidden]
            # A label above a place moves up, away from the ninja, as long as there is room, and only then down.
            up = up and plate.top <= other.top and other.top > plate.height
            top = other.top - plate.height - 1 if up else other.bottom + 1
            y += (top - plate.top) / scale
            plate.top = top
        self.labels.append(plate)
        ground = with_alpha(theme.palette.background, 200)
        theme.canvas.fill_rect(surface, ground, x - 1.5, y - 0.5, w + 3, LETTERS + 2.5, 1)
        theme.text(surface, text, x, y, size=LETTERS, colour=colour)


def union_of(rects: Sequence[pygame.Rect]) -> pygame.Rect:
    """The smallest rectangle around all non-empty ones."""
    drawn = [rect for rect in rects if rect]
    return drawn[0].unionall(drawn) if drawn else pygame.Rect(0, 0, 0, 0)


def first_other_place(ours: Positions, theirs: Positions) -> int:
    """The first tick after which two runs are at different places; the length of the shorter one if there is none."""
    shared = min(len(ours), len(theirs))
    other = np.flatnonzero((ours[:shared] != theirs[:shared]).any(axis=1))
    return int(other[0]) if len(other) else shared


def _point(positions: Positions, tick: int) -> Point:
    return float(positions[tick, 0]), float(positions[tick, 1])
