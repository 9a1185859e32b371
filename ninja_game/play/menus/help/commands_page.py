"""The help page of a screen that is a tool: some words, and the table of its commands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.input.gamepad import pad_label
from ninja_game.play.input.keys import Command, key_text
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.ui.canvas import WIDTH
from ninja_game.play.ui.theme import wrapped
from ninja_game.play.ui.widgets import Button, Widget

if TYPE_CHECKING:
    from ninja_game.play.app import App


class HelpPage(MenuScreen):
    """All that can be done, on one page: ``words``, then the table of ``commands``."""

    foot = "Esc goes back"

    def __init__(self, app: App, title: str, words: str, commands: Sequence[Command]) -> None:
        super().__init__(app)
        self.title = title
        self._words = words
        self._commands = [command for command in commands if command.keys or command.pad]

    def build(self) -> Sequence[Widget]:
        """One way back."""
        return [Button((640, 536, 112, 24), "Back", self.back, size=10)]

    def draw_frame(self, surface: pygame.Surface) -> None:
        """The words, then the table in two columns."""
        super().draw_frame(surface)
        theme = self.app.theme
        lines = [line for text in self._words.split("\n") for line in wrapped(theme, text, WIDTH - 80, 10)]
        for number, line in enumerate(lines):
            theme.text(surface, line, 40, 60 + 15 * number, size=10)
        rows = -(-len(self._commands) // 2)
        top = 70 + 15 * len(lines)
        keys, pads = (84, 86) if any(command.pad for command in self._commands) else (104, 0)
        for number, command in enumerate(self._commands):
            column, row = divmod(number, rows)
            x, y = 40 + 362 * column, top + min(19.0, (530 - top) / rows) * row
            theme.text(surface, key_text(command), x, y, size=10, bold=True, width=keys)
            theme.text(surface, pad_label(command.pad) if command.pad else "", x + keys + 2, y, size=9, width=pads,
                       colour=theme.palette.faint)  # fmt: skip
            theme.text(surface, command.label, x + keys + pads + 4, y, size=10, width=356 - keys - pads)
