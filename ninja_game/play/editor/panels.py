"""Panels over the editor: the file menu, fields to fill in, questions about files, the help page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.editor.controls import Command, key_text
from ninja_game.play.input.gamepad import pad_label
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.panels import ROW, Panel
from ninja_game.play.ui.canvas import WIDTH
from ninja_game.play.ui.text_entry import TextEntry
from ninja_game.play.ui.text_layout import wrapped
from ninja_game.play.ui.widgets import Button, Widget
from ninja_game.player.catalogue import Entry

if TYPE_CHECKING:
    from ninja_game.play.app import App

Row = tuple[str, Callable[[], object], str]
"""Text, action, hint."""


class Menu(Panel):
    """Some actions; each of them closes the panel first."""

    def __init__(self, app: App, title: str, rows: Sequence[Row]) -> None:
        super().__init__(app, title)
        self._rows = [(text, self._closing(action), hint) for text, action, hint in rows]

    def _closing(self, action: Callable[[], object]) -> Callable[[], object]:
        def close_and_do() -> None:
            self.app.pop()
            action()

        return close_and_do

    def rows(self) -> list[Row]:
        """The buttons."""
        return self._rows


class Form(Menu):
    """Fields to fill in above two buttons. ``fields``: prompt, text, how many characters fit in.

    The text of a single field is a proposal.
    """

    def __init__(
        self, app: App, title: str, fields: Sequence[tuple[str, str, int]], yes: str,
        action: Callable[[list[str]], object],
    ) -> None:  # fmt: skip
        self.texts = [text for _, text, _ in fields]
        self._fields = fields
        super().__init__(app, title, [(yes, lambda: action(self.texts), ""), ("Cancel", lambda: None, "")])

    def rows(self) -> list[Row]:
        """The buttons, below as many empty rows as there are fields."""
        return [("", lambda: None, "")] * len(self._fields) + self._rows

    def build(self) -> Sequence[Widget]:
        """The fields, then the buttons."""
        x, y, w, _ = self._box
        alone = len(self._fields) == 1
        places = [(x + 30, y + 48 + ROW * k, w - 60, 30) for k in range(len(self._fields))]
        entries = [
            TextEntry(places[k], prompt, text, self._taker(k), longest=longest, proposed=alone)
            for k, (prompt, text, longest) in enumerate(self._fields)
        ]
        return [*entries, *list(super().build())[len(entries) :]]

    def act(self, action: str, *, held: bool = False) -> None:
        """Enter in a field means the first button."""
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self._rows[0][1]()
        else:
            super().act(action, held=held)

    def _taker(self, place: int) -> Callable[[str], None]:
        def take(text: str) -> None:
            self.texts[place] = text

        return take


STAY: Row = ("Stay", lambda: None, "")


class LevelChoice(Browser):
    """The browser of levels, to choose one for the editor."""

    title = "Open a level"

    def __init__(self, app: App, choose: Callable[[Entry], object]) -> None:
        super().__init__(app)
        self._choose = choose
        self.list.hint = "Enter opens the level in the editor"

    def build(self) -> Sequence[Widget]:
        """The list and its search; no buttons to play."""
        return [*list(super().build())[:3], Button((436, 470, 320, 32), "Edit", lambda: self._play(self.list.index))]

    def _play(self, index: int, *, practice: bool = False) -> None:
        if index < len(self.shown):
            self.app.pop()
            self._choose(self.shown[index])


HELP = """\
A first level: draw a floor with the left mouse button. Take the ninja from the objects at the right and click where \
it begins; take the exit, click where it is, then where its switch is. Test plays the level, Certify lets the solver \
look for a run, Save (in File) puts it into the menu Levels.
The right button erases, the middle one picks. Doors go to the nearest side of a cell; then click where the switch is. \
Tiles: 1 to 8 choose a shape, Q W A S its solid corner, E is full, D empty. Objects: the keys that the palette shows; \
W A S D turn them. Without a mouse: arrows move the pointer, Space draws, Shift and arrows move what is selected."""
"""What one has to know to begin."""


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
