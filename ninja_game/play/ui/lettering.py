"""Text, crisp at any window size: drawn at the scaled size and kept while it is used."""

from __future__ import annotations

from collections import OrderedDict

import pygame

from ninja_game.files.shown_text import shown_text
from ninja_game.play.ui.canvas import Canvas, Colour
from ninja_game.play.ui.stroke_font import StrokeFont

_KEPT = 400
"""Texts kept; a changing time adds one a picture."""

_SHARE_LEFT = {"left": 0.0, "centre": 0.5, "right": 1.0}


class Lettering:
    """Draws text on a canvas; keeps what it rendered."""

    def __init__(self, canvas: Canvas) -> None:
        self.canvas = canvas
        self._fonts: dict[tuple[float, bool], StrokeFont] = {}
        self._kept: OrderedDict[tuple[str, float, tuple[int, ...], bool], pygame.Surface] = OrderedDict()

    def _font(self, size: float, bold: bool) -> StrokeFont:
        key = size, bold
        if key not in self._fonts:
            if not pygame.font.get_init():
                pygame.font.init()
            self._fonts[key] = StrokeFont(max(5.0, size * self.canvas.scale), bold=bold)
        return self._fonts[key]

    def rendered(self, text: str, size: float, colour: Colour, *, bold: bool = False) -> pygame.Surface:
        """The picture of a text in letters of some size, logical px."""
        key = text, size, tuple(pygame.Color(colour)), bold
        found = self._kept.get(key)
        if found is None:
            found = self._font(size, bold).render(shown_text(text), colour)
            self._kept[key] = found
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        else:
            self._kept.move_to_end(key)
        return found

    def width(self, text: str, size: float, *, bold: bool = False) -> float:
        """Width of a text in logical px."""
        return self._font(size, bold).width(shown_text(text)) / self.canvas.scale

    def draw(
        self, surface: pygame.Surface | None, text: str, x: float, y: float, size: float, colour: Colour,
        *, align: str = "left", bold: bool = False,
    ) -> pygame.Rect:  # fmt: skip
        """Draw a text whose top is at logical ``y``; ``align``: what ``x`` is, "left", "centre" or "right" of it."""
        picture = self.rendered(text, size, colour, bold=bold)
        rect = picture.get_rect()
        px, py = self.canvas.point(x, y)
        rect.topleft = (px - round(_SHARE_LEFT[align] * rect.width), py)
        if surface is not None:
            surface.blit(picture, rect)
        return rect
