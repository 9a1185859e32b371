"""The base of the tabs below the level: their place, widgets, lists and fields."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import ClassVar

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.play.workspace import Commands, key_text
from ninja_game.search.formula.language import FormulaError
from ninja_game.tas_editor.commands import TAS_COMMANDS
from ninja_game.tas_editor.editor import OtherRun, TasEditor, TasPart
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Widget, next_option
from ninja_game.view.overlays import OVERLAY_ACTIONS, Overlays

SMALL = 9.0  # size of the text in lists and buttons, px
TAB_ROW = 16  # height of a row of a list, px
UNPLACED: Area = (0, 0, 0, 0)  # the area of widgets that are not arranged yet
_SHORT = 60  # longer lists of expected words are left out of a line


class Tab(TasPart):
    """A part with widgets, which are made once."""

    slot = "tabs"
    name: ClassVar[str] = ""

    @property
    def preview(self) -> OtherRun | None:
        return None

    def place(self, area: Area) -> None:
        super().place(area)
        self.arrange(*area)

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        raise NotImplementedError

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        theme.panel(surface, *self.area)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """Show the hint of the widget under the mouse; widgets handle the rest."""
        if event.type == pygame.MOUSEMOTION:
            self._leave_lists(x, y)
            self.editor.hint = next((widget.hint for widget in self.widgets if widget.contains(x, y)), "")
        return False

    def mouse_left(self) -> None:
        self._leave_lists(-1, -1)

    def _leave_lists(self, x: float, y: float) -> None:
        for widget in self.widgets:
            if isinstance(widget, Rows) and not widget.contains(x, y):
                widget.over = -1

    def stop(self) -> bool:
        """Stop running work; whether there was any."""
        return False

    def left(self) -> None:
        """Escape has taken the focus away."""

    def close(self) -> None:
        """Stop running work: the TAS editor is left."""


class LitButton(Button):
    """A button that is highlighted while ``is_lit()``."""

    def __init__(self, text: str, action: Callable[[], object], is_lit: Callable[[], bool], hint: str = "") -> None:
        super().__init__(UNPLACED, text, action, size=SMALL, hint=hint)
        self.is_lit = is_lit

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        lit, (x, y) = focused or self.is_lit(), self.centre
        theme.row(surface, self.area, chosen=lit, focused=focused)
        theme.text(surface, self.text, x, y - SMALL / 2, size=SMALL, align="centre", bold=lit, width=self.area[2])


_OVERLAY = 16.0  # width of the button of an overlay, px


class TabStrip(TasPart):
    """The names of the tabs, and a button for each overlay of the level."""

    slot = "strip"

    def __init__(self, editor: TasEditor, tabs: Sequence[Tab], overlays: Overlays) -> None:
        super().__init__(editor)
        self.tabs, self._overlays = tabs, overlays
        self.widgets = [
            LitButton(tab.name, partial(setattr, editor, "tab", tab.name), partial(self._is_on, tab.name))
            for tab in tabs
        ]
        for name in OVERLAY_ACTIONS:
            key = key_text(TAS_COMMANDS.by_name[name])
            toggle = partial(overlays.toggle, name)
            self.widgets.append(LitButton(key, toggle, partial(self._is_on, name), TAS_COMMANDS.hint(name)))

    def _is_on(self, name: str) -> bool:
        return name == self.editor.tab or name in self._overlays.on

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        self.editor.hint = next((widget.hint for widget in self.widgets if widget.contains(x, y)), "")
        return False

    def commands(self) -> Commands:
        return {"next_tab": self._show_next}

    def _show_next(self) -> None:
        self.editor.tab = next_option([tab.name for tab in self.tabs], self.editor.tab)

    @property
    def shown(self) -> Tab:
        return next(tab for tab in self.tabs if tab.name == self.editor.tab)

    def place(self, area: Area) -> None:
        super().place(area)
        x, y, w, h = area
        tabs, switches = self.widgets[: len(self.tabs)], self.widgets[len(self.tabs) :]
        width = (w - _OVERLAY * len(switches)) / len(tabs)
        for number, name in enumerate(tabs):
            name.area = x + number * width, y, width - 4, h
        for number, switch in enumerate(switches):
            switch.area = x + len(tabs) * width + number * _OVERLAY, y, _OVERLAY - 2, h

    def render_key(self) -> tuple[object, ...]:
        return self.editor.tab, frozenset(self._overlays.on)

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        theme.canvas.fill_rect(surface, theme.palette.tile, *self.area)


class Rows(ListView):
    """A list in a tab: only a click chooses, the mouse over it does not. ``over``: the row under the mouse, or -1.

    ``keeps``: the last chosen row is highlighted.
    """

    def __init__(
        self,
        draw_row: Callable[[pygame.Surface, Theme, int, Area, bool], None],
        choose: Callable[[int], object],
        *,
        empty: str = "",
        hint: str = "",
        keeps: bool = True,
        opens: bool = False,
    ) -> None:
        super().__init__(UNPLACED, TAB_ROW, self._draw_row, choose, empty=empty, hint=hint, opens=opens)
        self.over = -1
        self._keeps = keeps
        self._draw = draw_row

    @property
    def looked_at(self) -> int:
        """The row under the mouse, else the last clicked one, or -1."""
        return self.over if self.over >= 0 else self._clicked

    def draw_heads(
        self, surface: pygame.Surface, theme: Theme, first: str, heads: Sequence[str], places: Sequence[float]
    ) -> None:
        """The names of the columns above the list; ``places``: of all but the first, px from the right of a row."""
        x, _, w, _ = self.row_area(0)
        named = [(x + 8, first), *((x + w - place, head) for place, head in zip(places, heads, strict=True))]
        for at, head in named:
            theme.text(surface, head, at, self.area[1] - 13, size=8, colour=theme.palette.faint)

    def hover(self, x: float, y: float) -> bool:
        index = self._index_at(x, y)
        before, self.over = self.over, -1 if index is None else index
        return self.over != before

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        if index == self.over:
            theme.canvas.fill_rect(surface, theme.palette.background, *area, 2)
        if index == self.index and (self._keeps or focused):
            theme.canvas.fill_rect(surface, theme.palette.background, *area, 2)
            theme.canvas.frame_rect(surface, theme.palette.accent, *area, 1.5 if focused else 0.75, 2)
        self._draw(surface, theme, index, area, index == self.index)


class EntryField(TextEntry):
    """A field in a tab. Enter calls ``enter``; Up and Down call ``step`` with -1 or 1."""

    def __init__(
        self,
        prompt: str,
        enter: Callable[[], object],
        *,
        longest: int,
        hint: str = "",
        put: Callable[[str], object] = lambda _: None,
        step: Callable[[int], object] | None = None,
    ) -> None:
        super().__init__(UNPLACED, prompt, "", put, longest=longest, hint=hint)
        self._enter, self._step = enter, step

    def nudge(self, action: str) -> bool:
        if self._step is None or action not in ("up", "down"):
            return super().nudge(action)
        self._step(1 if action == "down" else -1)
        return True

    def confirm(self) -> bool:
        self._enter()
        return True


def put_in_a_row(area: Area, widgets: Sequence[Widget], widths: Sequence[float]) -> None:
    """Place widgets beside each other, 4 px apart. A width of 0 takes what the others leave."""
    x, y, w, h = area
    for widget, fixed in zip(widgets, widths, strict=True):
        width = fixed or w - sum(widths) - 4 * (len(widths) - 1)
        widget.area = x, y, width, h
        x += width + 4


def what_is_wrong(error: NinjaGameError) -> str:
    """An error as a line; for an error in a formula with the column."""
    if isinstance(error, FormulaError) and error.column:
        message = f"Column {error.column}: {error.what}, {error.found}"
        return f"{message}; expected {error.expected}" if len(error.expected) < _SHORT else message
    return str(error)
