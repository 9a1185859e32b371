"""What the tabs below the level share: their place, their widgets, lists and fields in them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import ClassVar

import pygame

from ninja_game.directed.expressions import FormulaError
from ninja_game.errors import NinjaGameError
from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.part import Part
from ninja_game.play.ui.list_view import ListView
from ninja_game.play.ui.text_entry import TextEntry
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Button, Widget

SMALL = 9.0
"""Size of the text in lists and buttons, px."""
ROW = 16
"""Height of a row of a list, px."""
_SHORT = 60
"""Longer lists of what is expected are left out of a line."""


class Tab(Part):
    """A part with widgets. ``widgets``: all of them, made once; what they show is part of ``look``.

    ``wants``: the widget that is to get the focus as soon as the tab is shown.
    """

    name: ClassVar[str] = ""
    strip: ClassVar[Area] = (6, 353, 424, 18)
    area = (6, 373, 424, 203)

    def __init__(self, bench: Bench) -> None:
        super().__init__(bench)
        self.widgets: Sequence[Widget] = ()
        self.wants: Widget | None = None

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Its background."""
        theme.panel(surface, *self.area)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """What the mouse is over is told in the line below; all else is up to the widgets."""
        if event.type == pygame.MOUSEMOTION:
            self._leave_lists(x, y)
            self.bench.hint = next((each.hint for each in self.widgets if each.contains(x, y)), "")
        return False

    def mouse_left(self) -> None:
        """No row is under the mouse."""
        self._leave_lists(-1, -1)

    def _leave_lists(self, x: float, y: float) -> None:
        for widget in self.widgets:
            if isinstance(widget, Rows) and not widget.contains(x, y):
                widget.over = -1

    def close(self) -> None:
        """The bench is left: what goes on ends."""


class TabName(Button):
    """The name of a tab; that of the one that is shown stands out."""

    def __init__(self, area: Area, tab: Tab, action: Callable[[], object]) -> None:
        super().__init__(area, tab.name, action, size=SMALL)
        self._bench = tab.bench

    def draw_base(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        """Its panel."""
        theme.row(surface, self.area, chosen=focused or self.text == self._bench.tab, focused=focused)


class Rows(ListView):
    """A list in a tab: only a click chooses, the mouse over it does not. ``over``: the row under the mouse, or -1.

    ``keeps``: the row that was chosen last is shown as such.
    """

    def __init__(
        self, area: Area, draw_row: Callable[[pygame.Surface, Theme, int, Area, bool], None],
        choose: Callable[[int], object], *, empty: str = "", hint: str = "", keeps: bool = True,
    ) -> None:  # fmt: skip
        super().__init__(area, ROW, self._draw_row, choose, empty=empty, hint=hint)
        self.over = -1
        self._keeps = keeps
        self._draw = draw_row

    def hover(self, x: float, y: float) -> bool:
        """Note what the mouse is over."""
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


class Field(TextEntry):
    """A text field in which Enter does something."""

    def __init__(
        self, area: Area, prompt: str, enter: Callable[[], object], *, longest: int, hint: str = ""
    ) -> None:  # fmt: skip
        super().__init__(area, prompt, "", lambda _: None, longest=longest, hint=hint)
        self._enter = enter

    def show(self, text: str) -> None:
        """Put another text in it."""
        self.text, self.cursor = text, len(text)

    def confirm(self) -> bool:
        """Do it."""
        self._enter()
        return True

    def click(self, x: float, y: float) -> bool:
        """Only the focus."""
        return True


def buttons_in_a_row(
    x: float, y: float, rows: Sequence[tuple[str, float, Callable[[], object], str]]
) -> list[Button]:  # fmt: skip
    """Buttons side by side: text, width, action, hint."""
    made = []
    for text, width, action, hint in rows:
        made.append(Button((x, y, width, 17), text, action, hint=hint, size=SMALL))
        x += width + 4
    return made


def what_is_wrong(error: NinjaGameError) -> str:
    """What to tell of an error in a line; of a formula's in which column it is."""
    if isinstance(error, FormulaError) and error.column:
        told = f"Column {error.column}: {error.what}, {error.found}"
        return f"{told}; expected {error.expected}" if len(error.expected) < _SHORT else told
    return str(error)
