"""Panels over another screen: a few buttons, a question, fields to fill in."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Theme, wrapped
from ninja_game.ui.widgets import Button, Widget

PANEL_WIDTH = 300
ROW = 40

Action = Callable[[], object]
Row = tuple[str, Action | None, str]
"""Text, action, hint; without an action it is seen, but cannot be chosen: the hint says why."""


def nothing() -> None:
    """The action of a button that does nothing but close; what is done behind saving, as a rule."""


CANCEL: Row = ("Cancel", nothing, "")


class Panel(MenuScreen):
    """A few buttons in a panel over the screen below."""

    see_through = True
    offers_back = False

    def __init__(self, app: App, title: str) -> None:
        super().__init__(app)
        self.title = title
        self._mood = app.mood

    @property
    def mood(self) -> int:
        """That of the screen below, which is seen; the panel itself looks like all menus."""
        return self._mood

    @property
    def theme(self) -> Theme:
        return self.app.menu_theme

    def rows(self) -> list[Row]:
        raise NotImplementedError

    @property
    def _box(self) -> tuple[float, float, float, float]:
        height = 64 + ROW * len(self.rows())
        return (WIDTH - PANEL_WIDTH) / 2, (HEIGHT - height) / 2, PANEL_WIDTH, height

    def build(self) -> Sequence[Widget]:
        x, y, w, _ = self._box
        return [
            Button((x + 30, y + 48 + ROW * k, w - 60, 32), text, action, hint=hint, size=12)
            for k, (text, action, hint) in enumerate(self.rows())
        ]

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """The panel; the screen below, which is drawn again whenever this one is, shines through a veil."""
        if not self.redraw:
            return []
        canvas, theme, palette = self.app.canvas, self.theme, self.theme.palette
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


class Menu(Panel):
    """Some actions; each of them closes the panel first. ``then``: done when it is left by the key for back."""

    def __init__(self, app: App, title: str, rows: Sequence[Row], then: Action = nothing) -> None:
        super().__init__(app, title)
        self._then = then
        self._rows: list[Row] = [(text, action and self._closing(action), hint) for text, action, hint in rows]

    def back(self) -> None:
        super().back()
        self._then()

    def _closing(self, action: Callable[[], object]) -> Callable[[], object]:
        def close_and_do() -> None:
            self.app.pop()
            action()

        return close_and_do

    def rows(self) -> list[Row]:
        return self._rows


class Question(Menu):
    """Asks before something is done that cannot be undone. No first, and up stays there: a hasty key does no harm."""

    wraps = False

    def __init__(self, app: App, title: str, yes: str, action: Callable[[], object]) -> None:
        super().__init__(app, title, [CANCEL, (yes, action, "")])


class FormPanel(Menu):
    """Fields to fill in above two buttons. ``fields``: prompt, text, how many characters fit in.

    The text of the first is a proposal.
    """

    def __init__(
        self, app: App, title: str, fields: Sequence[tuple[str, str, int]], yes: str,
        action: Callable[[list[str]], object],
    ) -> None:  # fmt: skip
        self.texts = [text for _, text, _ in fields]
        self._fields = fields
        super().__init__(app, title, [(yes, lambda: action(self.texts), ""), CANCEL])

    def rows(self) -> list[Row]:
        """The buttons, below as many empty rows as there are fields."""
        return [("", nothing, "")] * len(self._fields) + self._rows

    def build(self) -> Sequence[Widget]:
        x, y, w, _ = self._box
        places = [(x + 30, y + 48 + ROW * k, w - 60, 30) for k in range(len(self._fields))]
        entries = [
            TextEntry(places[k], prompt, text, self._taker(k), longest=longest, proposed=k == 0)
            for k, (prompt, text, longest) in enumerate(self._fields)
        ]
        return [*entries, *list(super().build())[len(entries) :]]

    def act(self, action: str, *, held: bool = False) -> None:
        """Enter in a field means the first button."""
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self.widgets[len(self._fields)].confirm()
        else:
            super().act(action, held=held)

    def _taker(self, place: int) -> Callable[[str], None]:
        def take(text: str) -> None:
            self.texts[place] = text

        return take
