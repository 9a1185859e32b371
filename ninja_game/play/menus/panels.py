"""Panels over another screen: a few buttons, a question."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.ui.text_layout import wrapped
from ninja_game.play.ui.widgets import Button, Widget

if TYPE_CHECKING:
    from ninja_game.play.app import App

PANEL_WIDTH = 300
ROW = 40


class Panel(MenuScreen):
    """A few buttons in a panel over the screen below. ``rows``: text, action, hint."""

    see_through = True

    def __init__(self, app: App, title: str) -> None:
        super().__init__(app)
        self.title = title

    def rows(self) -> list[tuple[str, Callable[[], object], str]]:
        """The buttons."""
        raise NotImplementedError

    @property
    def _box(self) -> tuple[float, float, float, float]:
        height = 64 + ROW * len(self.rows())
        return (WIDTH - PANEL_WIDTH) / 2, (HEIGHT - height) / 2, PANEL_WIDTH, height

    def build(self) -> Sequence[Widget]:
        """The buttons one below another."""
        x, y, w, _ = self._box
        return [
            Button((x + 30, y + 48 + ROW * k, w - 60, 32), text, action, hint=hint, size=12)
            for k, (text, action, hint) in enumerate(self.rows())
        ]

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """The panel; the screen below, which is drawn again whenever this one is, shines through a veil."""
        if not self.redraw:
            return []
        canvas, theme, palette = self.app.canvas, self.app.theme, self.app.theme.palette
        veil = pygame.Color(palette.tile.r, palette.tile.g, palette.tile.b, 130)
        (left, top), (right, bottom) = canvas.logical((0, 0)), canvas.logical(canvas.window)
        canvas.fill_rect(surface, veil, left, top, right - left, bottom - top)
        x, y, w, h = self._box
        theme.window(surface, x, y, w, h)
        if theme.width(self.title, 17, bold=True) < w - 24:
            theme.text(surface, self.title, x + w / 2, y + 17, size=17, align="centre", bold=True)
        else:
            lines = wrapped(theme, self.title, w - 40, 12)
            for line, text in enumerate([*lines[:1], " ".join(lines[1:])]):
                top = y + (10 if len(lines) > 1 else 17) + 16 * line
                theme.text(surface, text, x + w / 2, top, size=12, align="centre", bold=True, width=w - 24)
        hint = self.focus.hint if self.focus is not None else ""
        theme.text(surface, hint, x + w / 2, y + h - 17, size=9.5, colour=palette.faint, align="centre", width=w - 16)
        self.draw_widgets(surface)
        return None


class Question(Panel):
    """Asks before something is done that cannot be undone."""

    def __init__(self, app: App, title: str, yes: str, action: Callable[[], object]) -> None:
        super().__init__(app, title)
        self._yes = yes
        self._action = action

    def rows(self) -> list[tuple[str, Callable[[], object], str]]:
        """No first, so that a hasty key does no harm."""
        return [("Stay", self.back, ""), (self._yes, self._do, "")]

    def _do(self) -> None:
        self.app.pop()
        self._action()
