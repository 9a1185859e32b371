"""Plots of values over ticks: each in a lane of its own, with its own scale."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pygame

from ninja_game.ui.theme import RUN_COLOURS, Area, Palette, Theme

if TYPE_CHECKING:
    from ninja_game.search.formula.language import Values

SHORTEST = 10.0
"""Ticks that are shown at least."""
_STEPS = (1, 2, 5, 10, 20, 40, 100, 200, 400, 1000, 2000, 4000, 10_000, 40_000)
"""Ticks between two numbers of the axis."""


@dataclass
class TickRange:
    """The ticks ``first`` … ``last`` (with fractions) of a run of ``length`` ticks, from ``left`` over ``width`` px."""

    left: float = 0.0
    width: float = 1.0
    length: float = SHORTEST
    first: float = 0.0
    last: float = SHORTEST

    @property
    def is_whole(self) -> bool:
        return self.first <= 0 and self.last >= self.length

    def x(self, tick: float) -> float:
        """Where a tick is, logical px."""
        return self.left + self.width * (tick - self.first) / (self.last - self.first)

    def tick(self, x: float) -> float:
        return self.first + (self.last - self.first) * (x - self.left) / self.width

    def fit(self, length: float) -> None:
        """The run has another length now."""
        whole, self.length = self.is_whole, max(length, SHORTEST)
        if whole:
            self.show_all()
        self.move(0.0)

    def show_all(self) -> None:
        self.first, self.last = 0.0, self.length

    def zoom(self, x: float, steps: int) -> None:
        """Show fewer ticks (steps > 0) or more, around the one at a place."""
        shown = min(max((self.last - self.first) * 0.8**steps, SHORTEST), self.length)
        share = (x - self.left) / self.width
        self.first = self.tick(x) - share * shown
        self.last = self.first + shown
        self.move(0.0)

    def move(self, ticks: float) -> None:
        """Show earlier or later ticks."""
        shown = self.last - self.first
        self.first = max(0.0, min(self.first + ticks, self.length - shown))
        self.last = self.first + shown

    def follow(self, tick: float) -> None:
        """Have a tick in the picture."""
        if not self.first <= tick <= self.last:
            self.move(tick - (self.first + self.last) / 2)

    def axis(self) -> Iterator[int]:
        """The ticks that have a number below them."""
        step = next((each for each in _STEPS if self.width * each / (self.last - self.first) >= 36), _STEPS[-1])
        return iter(range(-(-int(self.first) // step) * step, int(self.last) + 1, step))


def colour_of(number: int, palette: Palette) -> pygame.Color:
    """The colour of a plot: on dark panels lighter, on light ones darker."""
    dark = palette.panel.hsla[2] < 50
    return RUN_COLOURS[number % len(RUN_COLOURS)].lerp("white" if dark else "black", 0.4 if dark else 0.25)


def draw_lane(
    surface: pygame.Surface, theme: Theme, area: Area, window: TickRange, values: Values, colour: pygame.Color
) -> None:
    """A value over ticks, float64 (ticks,), in the window; NaN leaves a gap. Its bounds stand at the left."""
    canvas, palette = theme.canvas, theme.palette
    x, y, w, h = area
    canvas.fill_rect(surface, palette.background, *area)
    start = max(0, int(window.first))
    shown = values[start : int(window.last) + 2]
    known = shown[np.isfinite(shown)]
    if not len(known):
        theme.text(surface, "no value here", x + w / 2, y + h / 2 - 5, size=9, colour=palette.faint, align="centre")
        return
    low, high = float(known.min()), float(known.max())
    middle, span = (low + high) / 2, max(high - low, 1e-9)
    top, room = y + 3, h - 6
    if low < 0 < high:
        zero = top + room * (high / span)
        canvas.fill_rect(surface, palette.panel_edge, x, zero, w, 0.5)
    ticks = np.arange(start, start + len(shown), dtype=np.float64)
    most = max(2, canvas.px(w))
    if len(shown) > 2 * most:
        ticks, shown = _thinned(ticks, shown, most)
    share = (high - shown) / span if high > low else np.full(len(shown), 0.5) + 0 * shown
    left, above = canvas.exact(window.left, top)
    px = left + (ticks - window.first) * (window.width * canvas.scale / (window.last - window.first))
    lane = canvas.rect(*area)
    inner = surface.subsurface(lane.clip(surface.get_rect()))
    points = np.column_stack([px, above + share * (room * canvas.scale)]) - inner.get_offset()
    _draw_line(inner, colour, points, canvas.px(1))
    bounds = ((high, y + 1), (low, y + h - 9)) if high > low else ((middle, y + h / 2 - 4),)
    for value, at in bounds:
        theme.text(surface, f"{value:.4g}", x - 3, at, size=8, colour=colour, align="right")


def _thinned(ticks: Values, values: Values, columns: int) -> tuple[Values, Values]:
    """The least and the greatest value in each column of px."""
    starts = np.unique(np.linspace(0, len(values), columns, endpoint=False).astype(np.intp))
    pairs = np.column_stack([np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)])
    return np.repeat(ticks[starts], 2), pairs.ravel()


def _draw_line(surface: pygame.Surface, colour: pygame.Color, points: Values, width: int) -> None:
    """A line through points, float64 (n, 2), px; NaN leaves a gap."""
    known = np.isfinite(points[:, 1])
    for piece in np.split(points, np.flatnonzero(np.diff(known)) + 1):
        if len(piece) > 1 and np.isfinite(piece[0, 1]):
            pygame.draw.lines(surface, colour, False, piece.tolist(), width)
