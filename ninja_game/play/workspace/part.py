"""A part of an editor's window: it draws itself when what it shows has changed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import pygame

from ninja_game.ui.theme import Area, Theme, inside
from ninja_game.ui.widgets import Widget

Commands = Mapping[str, Callable[[], object]]
"""What is done, by the names of the table of commands."""


class Part:
    """``area``: where it is, logical px. ``widgets``: in it; what they show is part of ``render_key``.

    ``wants``: the widget that is to get the focus as soon as the part is shown.
    """

    area: Area = (0, 0, 0, 0)
    widgets: Sequence[Widget] = ()
    wants: Widget | None = None
    _drawn: tuple[object, ...] | None = None

    # --- what parts say of themselves ---

    def render_key(self) -> tuple[object, ...]:
        """All that its picture depends on, besides the window's size, the palette and the focus."""
        raise NotImplementedError

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Draw all of it but the widgets; the clip is its area."""
        raise NotImplementedError

    def commands(self) -> Commands:
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
        return inside(self.area, x, y)

    def draw(self, surface: pygame.Surface, theme: Theme, focus: Widget | None, *, whole: bool) -> list[pygame.Rect]:
        """Draw it if anything has changed; the px that did."""
        key = self.render_key()
        if not whole and key == self._drawn:
            return []
        self._drawn = key
        rect = theme.canvas.rect(*self.area)
        surface.set_clip(rect)
        self.paint(surface, theme)
        for widget in sorted(self.widgets, key=lambda widget: widget is focus):
            widget.draw(surface, theme, focused=widget is focus)
        surface.set_clip(None)
        return [rect]
