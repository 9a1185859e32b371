"""Panels over another screen: a question, the pause."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.input.events import InputEvent
from ninja_game.play.menus.help import HelpScreen
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.settings import SettingsScreen
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.ui.widgets import Button, Widget

if TYPE_CHECKING:
    from ninja_game.play.app import App
    from ninja_game.play.level.play import LevelPlay

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
        veil = pygame.Color(palette.tile)
        veil.a = 130
        canvas.fill_rect(surface, veil, 0, 0, WIDTH, HEIGHT)
        x, y, w, h = self._box
        canvas.fill_rect(surface, palette.background, x, y, w, h, 6)
        canvas.frame_rect(surface, palette.panel_edge, x, y, w, h, 1.5, 6)
        theme.text(surface, self.title, x + w / 2, y + 17, size=17, align="centre", bold=True)
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


class PausePanel(Panel):
    """The game waits. Space, the pause key or Esc go on."""

    def __init__(self, app: App, playing: LevelPlay) -> None:
        super().__init__(app, "Paused")
        self.playing = playing

    def rows(self) -> list[tuple[str, Callable[[], object], str]]:
        """What can be done."""
        return [
            ("Go on", self.back, ""),
            ("Retry", lambda: self._leave(self.playing.retry), ""),
            ("Settings", lambda: self.app.push(SettingsScreen(self.app)), ""),
            ("Help", lambda: self.app.push(HelpScreen(self.app)), ""),
            ("Leave the level", lambda: self._leave(self.playing.quit), ""),
        ]

    def handle(self, event: InputEvent) -> None:
        """The pause key ends the pause too, the quit key leaves."""
        if "pause" in event.pressed:
            self.back()
        elif "quit" in event.pressed:
            self._leave(self.playing.quit)
        else:
            super().handle(event)

    def back(self) -> None:
        """Go on playing."""
        self._leave(self.playing.resume)

    def _leave(self, then: Callable[[], object]) -> None:
        self.app.pop()
        then()
