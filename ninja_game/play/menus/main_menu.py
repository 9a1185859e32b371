"""The main menu, with replays playing behind it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game import __version__
from ninja_game.play.menus.attract import Attract
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.panels import Question
from ninja_game.play.screen import Screen
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.ui.widgets import Area, Button, Widget
from ninja_game.play.ui.wording import fit

if TYPE_CHECKING:
    from ninja_game.play.app import App

PANEL: Area = (44, 96, 232, 420)
TITLE = "NINJA"


class MainMenu(MenuScreen):
    """Where the game begins and where every way back ends."""

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.attract = Attract(app)

    def build(self) -> Sequence[Widget]:
        """One button for each screen."""
        x, y, w, _ = PANEL
        return [
            Button((x + 22, y + 98 + 43 * k, w - 44, 34), text, action, hint=hint, size=13)
            for k, (text, action, hint) in enumerate(self._entries())
        ]

    def _entries(self) -> list[tuple[str, Callable[[], object], str]]:
        return [
            ("Play", self._open("episode_grid", "EpisodeGrid"), "Episodes: up to five levels in a row on one clock"),
            ("Levels", self._open("browser", "Browser"), "Single levels, and your own files"),
            ("Records", self._open("records", "RecordsScreen"), "Your best runs, and what killed you"),
            ("Replays", self._open("replays", "ReplaysScreen"), "Watch runs again"),
            ("Settings", self._open("settings", "SettingsScreen"), "Keys, sound, colours, comfort"),
            ("Help", self._open("help", "HelpScreen"), "How to move, and what everything does"),
            ("Quit", self.back, "Leave the game"),
        ]

    def _open(self, module: str, name: str) -> Callable[[], None]:
        """What opens a screen; its module is imported only then."""

        def open_screen() -> None:
            from importlib import import_module

            screen: Screen = getattr(import_module(f"ninja_game.play.menus.{module}"), name)(self.app)
            self.app.push(screen)

        return open_screen

    def back(self) -> None:
        """Ask before the game ends."""
        self.app.push(Question(self.app, "Leave the game?", "Leave", self.app.quit))

    def update(self, real_ms: int) -> None:
        """The replay behind goes on."""
        super().update(real_ms)
        self.attract.update(real_ms)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """The replay, and the menu over it."""
        changed = self.attract.draw(surface, whole=self.redraw)
        canvas, theme = self.app.canvas, self.app.theme
        x, y, w, h = PANEL
        rect = canvas.fill_rect(surface, theme.palette.background, x, y, w, h, 6)
        canvas.frame_rect(surface, theme.palette.panel_edge, x, y, w, h, 1.5, 6)
        theme.text(surface, TITLE, x + w / 2, y + 22, size=40, align="centre", bold=True)
        theme.text(
            surface, f"version {__version__}", x + w / 2, y + 68, size=9, colour=theme.palette.faint, align="centre"
        )
        self.draw_widgets(surface)
        foot = canvas.rect(0, HEIGHT - 24, WIDTH, 24)
        self._draw_foot(surface)
        written = [rect.inflate(4, 4), foot]
        if self.attract.view is not None:
            for each in written:
                self.attract.view.also_covered(each)
        return None if changed is None else changed + written

    def _draw_foot(self, surface: pygame.Surface) -> None:
        """The hint."""
        canvas, theme, palette = self.app.canvas, self.app.theme, self.app.theme.palette
        text = self.focus.hint if self.focus else ""
        canvas.fill_rect(surface, palette.tile, 0, HEIGHT - 24, WIDTH, 24)
        theme.text(surface, fit(theme, text, WIDTH - 40, 10.5), WIDTH / 2, HEIGHT - 18, size=10.5,
                   colour=palette.on_tile, align="centre")  # fmt: skip
