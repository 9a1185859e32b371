"""Where a figure draws: a part of the world, magnified into a rectangle of the screen."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from math import atan2, cos, sin
from typing import NamedTuple

import pygame

from ninja_game.play.ui.canvas import HEIGHT, WIDTH, Canvas, Colour, Point
from ninja_game.play.ui.theme import Area, Palette, Theme
from ninja_game.play.view.sprites.tile_sheet import outline
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, EXISTS, UNIT_X, UNIT_Y
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.rules import CELL, HALF, INTERESTING, OFF

FIGURE: Area = (212, 62, 540, 324)
"""Where a figure is seen, logical px."""


ALL_CELLS = range(len(EXISTS))


class View(NamedTuple):
    """The part of the world that a figure shows: its upper left corner, px, and its magnification."""

    left: float
    top: float
    zoom: float


CORNER = View(0, 0, 1.5)
"""15 x 9 cells with the border."""
FIELD = View(CELL, CELL, 0.75)
"""30 x 18 cells."""


class _ViewCanvas(Canvas):
    """A canvas whose logical px are those of the world, as a figure shows it."""

    def __init__(self, canvas: Canvas, view: View) -> None:
        super().__init__(canvas.window)
        x, y = canvas.exact(FIGURE[0], FIGURE[1])
        self.scale = canvas.scale * view.zoom
        self.origin = round(x - view.left * self.scale), round(y - view.top * self.scale)


class Sheet:
    """Draws on a surface in px of the world; nothing leaves the figure's rectangle."""

    def __init__(self, surface: pygame.Surface, theme: Theme, view: View) -> None:
        self.surface = surface
        self.view = view
        self.canvas = _ViewCanvas(theme.canvas, view)
        self.theme = theme
        self.area = theme.canvas.rect(*FIGURE)
        surface.set_clip(self.area)
        surface.fill(theme.palette.background, self.area)

    @property
    def palette(self) -> Palette:
        """The colours."""
        return self.theme.palette

    def close(self) -> None:
        """End drawing: the frame."""
        self.surface.set_clip(None)
        self.theme.canvas.frame_rect(self.surface, self.palette.panel_edge, *FIGURE, 1)

    def text(self, text: str, x: float, y: float, *, size: float = 9, colour: Colour | None = None) -> None:
        """A text about a point of the world; ``size`` in logical px of the screen."""
        at = self.theme.canvas.logical(self.canvas.point(x, y))
        self.theme.text(self.surface, text, at[0], at[1] - size / 2, size=size, colour=colour, align="centre")

    def grid(self) -> None:
        """The lines between cells."""
        upright: list[tuple[Point, Point]] = [((CELL * k, 0), (CELL * k, HEIGHT)) for k in range(34)]
        level: list[tuple[Point, Point]] = [((0, CELL * k), (WIDTH, CELL * k)) for k in range(26)]
        for a, b in upright + level:
            pygame.draw.line(self.surface, self.palette.panel_edge, self.canvas.point(*a), self.canvas.point(*b))

    def shade(self, cell: int, colour: Colour, alpha: int = 70) -> None:
        """Mark a cell."""
        if EXISTS[cell]:
            ink = pygame.Color(colour)
            self.canvas.fill_rect(
                self.surface, (ink.r, ink.g, ink.b, alpha), CENTRE_X[cell] - HALF, CENTRE_Y[cell] - HALF, CELL, CELL
            )

    def tiles(self, level: TileMap) -> None:
        """All tiles that are seen."""
        for cell, tile in enumerate(level.tiles):
            x, y = CENTRE_X[cell], CENTRE_Y[cell]
            seen = self.area.inflate(200, 200).collidepoint(self.canvas.point(x, y))
            if seen and EXISTS[cell] and (corners := [(x + dx, y + dy) for dx, dy in outline(tile)]):
                self.canvas.polygon(self.surface, self.palette.tile, corners)

    def edges(self, w: World, cells: Iterable[int] = ALL_CELLS) -> None:
        """Each cell's own edge states, a little inside it: solid thick, interesting thin, off not at all."""
        for cell, side in product(cells, range(4)):
            state = w.edges[4 * cell + side]
            if state != OFF and EXISTS[cell]:
                x, y = CENTRE_X[cell] + 10.5 * UNIT_X[side], CENTRE_Y[cell] + 10.5 * UNIT_Y[side]
                a, b = abs(UNIT_Y[side]) * 10, abs(UNIT_X[side]) * 10
                thin = state == INTERESTING
                self.line(
                    self.palette.gold if thin else self.palette.bad, (x - a, y - b), (x + a, y + b), 1 if thin else 2
                )

    def circle(self, colour: Colour, x: float, y: float, radius: float, width: float = 0) -> None:
        """A disc, or a ring of some ``width``, logical px."""
        self.canvas.circle(self.surface, colour, (x, y), radius, width / self.view.zoom)

    def body(self, colour: Colour, x: float, y: float, half: float, *, box: bool, width: float = 2) -> None:
        """A circle or a box; ``half``: its radius or half side."""
        if box:
            self.canvas.frame_rect(self.surface, colour, x - half, y - half, 2 * half, 2 * half, width / self.view.zoom)
        else:
            self.circle(colour, x, y, half, width)

    def line(self, colour: Colour, a: Point, b: Point, width: float = 1) -> None:
        """A straight line; ``width``: logical px."""
        self.canvas.line(self.surface, colour, a, b, width / self.view.zoom)

    def arrow(self, colour: Colour, a: Point, b: Point, width: float = 2) -> None:
        """A line with a head; nothing for no length."""
        if a == b:
            return
        self.line(colour, a, b, width)
        angle, size = atan2(b[1] - a[1], b[0] - a[0]), 7 / self.view.zoom
        tips = [(b[0] - size * cos(angle + turn), b[1] - size * sin(angle + turn)) for turn in (0.45, -0.45)]
        self.canvas.polygon(self.surface, colour, [b, *tips])
