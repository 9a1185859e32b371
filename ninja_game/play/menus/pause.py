"""The pause: a panel over the level."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ninja_game.play.clipboard import copy_level_link
from ninja_game.play.input.bindings import InputEvent
from ninja_game.play.menus.help import HelpScreen
from ninja_game.play.menus.panels import Panel
from ninja_game.play.menus.settings import SettingsScreen

if TYPE_CHECKING:
    from ninja_game.play.app import App
    from ninja_game.play.level.screen import LevelScreen


class PausePanel(Panel):
    """The game waits. Space, the pause key or Esc go on."""

    def __init__(self, app: App, playing: LevelScreen) -> None:
        super().__init__(app, "Paused")
        self.playing = playing

    def rows(self) -> list[tuple[str, Callable[[], object], str]]:
        """What can be done."""
        return [
            ("Resume", self.back, ""),
            ("Retry", lambda: self._leave(self.playing.retry), ""),
            ("Copy a link", self._copy_link, "Whoever opens the link plays this level"),
            ("Settings", lambda: self.app.push(SettingsScreen(self.app)), ""),
            ("Help", lambda: self.app.push(HelpScreen(self.app)), ""),
            ("Leave the level", lambda: self._leave(self.playing.quit), ""),
        ]

    def _copy_link(self) -> None:
        """The level as a link, in the clipboard."""
        entry = self.playing.context.entry
        copy_level_link(self.app, entry.named, entry.title)

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
