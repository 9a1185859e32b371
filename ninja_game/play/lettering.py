"""Text, crisp at any window size: rendered at the scaled size and kept while it is used."""

from __future__ import annotations

from collections import OrderedDict

import pygame

from ninja_game.play.canvas import Canvas, Colour

_KEPT = 400
"""Rendered texts kept; a changing time adds one a picture."""


class Lettering:
    """Draws text on a canvas; keeps what it rendered."""

    def __init__(self, canvas: Canvas) -> None:
        self.canvas = canvas
        self._fonts: dict[tuple[int, bool], pygame.font.Font] = {}
        self._kept: OrderedDict[tuple[str, int, tuple[int, ...], bool], pygame.Surface] = OrderedDict()

    def _font(self, px: int, bold: bool) -> pygame.font.Font:
        """The font at a size in px. Kept here and not for good: it dies with pygame."""
        key = px, bold
        if key not in self._fonts:
            if not pygame.font.get_init():
                pygame.font.init()
            self._fonts[key] = pygame.font.Font(None, px)
            self._fonts[key].set_bold(bold)
        return self._fonts[key]

    def rendered(self, text: str, size: float, colour: Colour, *, bold: bool = False) -> pygame.Surface:
        """The picture of a text, ``size`` logical px high."""
        px = max(6, round(size * self.canvas.scale * FONT_SCALE))
        key = text, px, tuple(pygame.Color(colour)), bold
        found = self._kept.get(key)
        if found is None:
            found = self._font(px, bold).render(text, True, colour)
            self._kept[key] = found
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        else:
            self._kept.move_to_end(key)
        return found

    def width(self, text: str, size: float, *, bold: bool = False) -> float:
        """Width of a text in logical px."""
        px = max(6, round(size * self.canvas.scale * FONT_SCALE))
        return self._font(px, bold).size(text)[0] / self.canvas.scale

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


FONT_SCALE = 1.35
"""The font's size in px for letters 1 px high."""

_SHARE_LEFT = {"left": 0.0, "centre": 0.5, "right": 1.0}
