"""The look of the interface at one window size: palette and lettering."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.canvas import Canvas, Colour
from ninja_game.play.ui.lettering import Lettering
from ninja_game.play.ui.palette import Palette


class Theme:
    """Palette and lettering for a canvas; made anew when either changes."""

    def __init__(self, palette: Palette, canvas: Canvas) -> None:
        self.palette = palette
        self.canvas = canvas
        self.lettering = Lettering(canvas)

    def text(
        self, surface: pygame.Surface | None, text: str, x: float, y: float, *, size: float = 8,
        colour: Colour | None = None, align: str = "left", bold: bool = False,
    ) -> pygame.Rect:  # fmt: skip
        """Draw a text (or, without a surface, only measure it); its px rectangle. ``y``: its top."""
        return self.lettering.draw(surface, text, x, y, size, colour or self.palette.text, align=align, bold=bold)

    def width(self, text: str, size: float = 8, *, bold: bool = False) -> float:
        """Width of a text, logical px."""
        return self.lettering.width(text, size, bold=bold)

    def panel(self, surface: pygame.Surface, x: float, y: float, w: float, h: float, radius: float = 3) -> pygame.Rect:
        """A panel of the interface: filled, with a thin edge; its px rectangle."""
        self.canvas.fill_rect(surface, self.palette.panel, x, y, w, h, radius)
        return self.canvas.frame_rect(surface, self.palette.panel_edge, x, y, w, h, 1, radius)
