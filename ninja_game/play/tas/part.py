"""A part of the TAS editor's window: it draws itself when what it shows has changed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import ClassVar

import pygame

from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.ui.theme import Area, Theme

Commands = Mapping[str, Callable[[], object]]
"""What a part does, by the names of ``controls.COMMANDS``."""


class Part:
    """``area``: where it is, logical px. ``slot``: the name of that place in the TAS editor's layout."""

    slot: ClassVar[str] = ""
    area: Area = (0, 0, 0, 0)

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor
        self._drawn: tuple[object, ...] = ()

    # --- what parts say of themselves ---

    def render_key(self) -> tuple[object, ...]:
        """All that its picture depends on, besides the window's size and the palette."""
        raise NotImplementedError

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Draw all of it; the clip is its area."""
        raise NotImplementedError

    def commands(self) -> Commands:
        """The commands that are its own."""
        return {}

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """A mouse event in its area, or one that ends or continues with a drag that began there; whether it was used.

        ``x``, ``y``: logical px of the window.
        """
        return False

    def mouse_left(self) -> None:
        """The mouse is elsewhere now."""

    def update(self, real_ms: int) -> None:
        """Let real time pass."""

    # --- for the screen ---

    def place(self, area: Area) -> None:
        """Be there from now on; all is drawn again."""
        self.area = area

    def contains(self, x: float, y: float) -> bool:
        """Whether a point lies in it."""
        left, top, w, h = self.area
        return left <= x < left + w and top <= y < top + h

    def draw(self, surface: pygame.Surface, theme: Theme, *, whole: bool) -> list[pygame.Rect]:
        """Draw it if anything has changed; the px that did."""
        render_key = self.render_key()
        if not whole and render_key == self._drawn:
            return []
        self._drawn = render_key
        rect = theme.canvas.rect(*self.area)
        surface.set_clip(rect)
        self.paint(surface, theme)
        surface.set_clip(None)
        return [rect]
