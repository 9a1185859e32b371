"""The main menu, with replays playing behind it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game import __version__
from ninja_game.play.app import App, Screen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.lab.screen import LabScreen
from ninja_game.play.menus.attract import Attract
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.daily import DailyScreen
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.menus.help import HelpScreen
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.panels import Question, Row
from ninja_game.play.menus.records import RecordsScreen
from ninja_game.play.menus.replays import ReplaysScreen
from ninja_game.play.menus.settings import SettingsScreen
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.ui.theme import Area
from ninja_game.play.ui.widgets import Button, Widget
from ninja_game.player.catalogue import Entry

LEFT, WIDE, MIDDLE = 44, 232, 306
"""Where the panel lies: its left edge, its width, the height of its middle."""

HEAD, ROW, FOOT = 98, 43, 12
"""Heights of the title, of a row, and of what is below the last row."""

TITLE = "NINJA"


class MainMenu(MenuScreen):
    """Where the game begins and where every way back ends."""

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.attract = Attract(app)

    def entries(self) -> list[Row]:
        """One for each screen; the panel is as high as they need."""
        return [
            ("Play", self._opener(EpisodeGrid), "Play the episodes"),
            ("Daily", self._opener(DailyScreen), "The level of the day, made from its date"),
            ("Levels", self._opener(self._browser), "Single levels, and your own files"),
            ("Records", self._opener(RecordsScreen), "Your best runs, and what killed you"),
            ("Replays", self._opener(ReplaysScreen), "Watch runs again"),
            ("Editor", self._opener(EditorScreen), "Make levels of your own"),
            ("Lab", self._opener(LabScreen), "Figures to drag: how the world works"),
            ("Settings", self._opener(SettingsScreen), "Keys, sound, colours, comfort"),
            ("Help", self._opener(HelpScreen), "How to move, and what everything does"),
            ("Quit", self.back, "Leave the game"),
        ]

    def _browser(self, app: App) -> Browser:
        """The levels, which can be opened in the editor from there."""

        def edit(entry: Entry) -> None:
            screen = EditorScreen(app)
            app.push(screen)
            screen.commands.edit_entry(entry)

        return Browser(app, edit)

    def _opener(self, screen: Callable[[App], Screen]) -> Callable[[], None]:
        return lambda: self.app.push(screen(self.app))

    def build(self) -> Sequence[Widget]:
        x, y, w, h = self.panel
        entries = self.entries()
        row = (h - HEAD - FOOT) / len(entries)
        return [
            Button((x + 22, y + HEAD + row * k, w - 44, row - 9), text, action, hint=hint, size=13)
            for k, (text, action, hint) in enumerate(entries)
        ]

    @property
    def panel(self) -> Area:
        """Where the panel lies: as high as its entries, as far as the stage allows."""
        height = min(HEAD + ROW * len(self.entries()) + FOOT, HEIGHT - 48)
        return LEFT, max(12, min(MIDDLE - height / 2, HEIGHT - 36 - height)), WIDE, height

    def back(self) -> None:
        self.app.push(Question(self.app, "Leave the game?", "Leave", self.app.quit))

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        self.attract.update(real_ms)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        changed = self.attract.draw(surface, whole=self.redraw)
        theme, palette = self.app.theme, self.app.theme.palette
        x, y, w, h = self.panel
        rect = theme.window(surface, x, y, w, h)
        theme.text(surface, TITLE, x + w / 2, y + 22, size=40, align="centre", bold=True)
        theme.text(surface, f"version {__version__}", x + w / 2, y + 68, size=9, colour=palette.faint, align="centre")
        self.draw_widgets(surface)
        foot = theme.canvas.fill_rect(surface, palette.tile, 0, HEIGHT - 24, WIDTH, 24)
        hint = theme.fit(self.focus.hint if self.focus else "", WIDTH - 40, 10.5)
        theme.text(surface, hint, WIDTH / 2, HEIGHT - 18, size=10.5, colour=palette.on_tile, align="centre")
        written = [rect.inflate(4, 4), foot]
        if self.attract.view is not None:
            for each in written:
                self.attract.view.also_covered(each)
        return None if changed is None else changed + written
