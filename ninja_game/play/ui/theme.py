"""The look of the interface at one window size: palette and lettering."""

from __future__ import annotations

from bisect import bisect_right

import pygame

from ninja_game.play.ui.canvas import Canvas, Colour
from ninja_game.play.ui.lettering import Lettering
from ninja_game.play.ui.palette import Palette

Area = tuple[float, float, float, float]
"""x, y, width, height, logical px."""

NARROWEST = 0.2
"""Width of the narrowest letter with its space, as a share of the size: longer texts need not be measured."""


class Theme:
    """Palette and lettering for a canvas; made again when either changes."""

    def __init__(self, palette: Palette, canvas: Canvas) -> None:
        self.palette = palette
        self.canvas = canvas
        self.lettering = Lettering(canvas)

    def text(
        self, surface: pygame.Surface | None, text: str, x: float, y: float, *, size: float = 8,
        colour: Colour | None = None, align: str = "left", bold: bool = False, width: float | None = None,
    ) -> pygame.Rect:  # fmt: skip
        """Draw a text (or, without a surface, only measure it); its px rectangle. ``y``: its top.

        ``width``: logical px to which it is shortened by dots.
        """
        if width is not None:
            text = self.fit(text, width, size, bold=bold)
        return self.lettering.draw(surface, text, x, y, size, colour or self.palette.text, align=align, bold=bold)

    def width(self, text: str, size: float = 8, *, bold: bool = False) -> float:
        """Width of a text, logical px."""
        return self.lettering.width(text, size, bold=bold)

    def fit(self, text: str, width: float, size: float, *, bold: bool = False) -> str:
        """The text, shortened by dots to fit a width."""
        most = int(width / (NARROWEST * size)) + 1
        if len(text) <= most and self.width(text, size, bold=bold) <= width:
            return text
        lengths = range(min(len(text), most) + 1)
        kept = bisect_right(lengths, width, key=lambda n: self.width(text[:n] + "...", size, bold=bold)) - 1
        return text[: max(0, kept)].rstrip() + "..."

    def panel(self, surface: pygame.Surface, x: float, y: float, w: float, h: float, radius: float = 3) -> pygame.Rect:
        """A panel of the interface: filled, with a thin edge; its px rectangle."""
        self.canvas.fill_rect(surface, self.palette.panel, x, y, w, h, radius)
        return self.canvas.frame_rect(surface, self.palette.panel_edge, x, y, w, h, 1, radius)

    def window(self, surface: pygame.Surface, x: float, y: float, w: float, h: float) -> pygame.Rect:
        """A large panel that lies over a level or a screen; its px rectangle."""
        self.canvas.fill_rect(surface, self.palette.background, x, y, w, h, 6)
        return self.canvas.frame_rect(surface, self.palette.panel_edge, x, y, w, h, 1.5, 6)

    def row(
        self, surface: pygame.Surface, area: Area, *,
        chosen: bool, focused: bool, radius: float = 4, filled: bool = True,
    ) -> None:  # fmt: skip
        """The frame of a widget or of a row: accented if it is chosen, thick where it has the focus too."""
        if filled:
            self.canvas.fill_rect(surface, self.palette.panel, *area, radius)
        if filled or chosen:
            edge = self.palette.accent if chosen else self.palette.panel_edge
            self.canvas.frame_rect(surface, edge, *area, 2.5 if focused else 1, radius)
