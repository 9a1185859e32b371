"""A list of rows that scrolls, and a grid of cells, to choose one of many things."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Widget

DrawRow = Callable[[pygame.Surface, Theme, int, Area, bool], None]
"""Draws a row: surface, theme, number, area, whether it is selected while the list has the focus."""

BAR_WIDTH = 8


class ListView(Widget):
    """Cells of one size in ``columns`` columns, top to bottom; one is selected. One column: a list.

    ``choose`` is called with the number of a confirmed or clicked cell, ``selected`` when the selection moves.
    ``opens``: choosing leaves the screen, so a first click only selects, and a second one on the same cell chooses.
    """

    def __init__(
        self, area: Area, cell_height: float, draw_row: DrawRow, choose: Callable[[int], object], *,
        selected: Callable[[int], object] = lambda _: None, empty: str = "", hint: str = "", opens: bool = False,
    ) -> None:  # fmt: skip
        super().__init__(area, hint=hint)
        self.cell_height = cell_height
        self.columns = 1
        self.draw_row = draw_row
        self.choose = choose
        self.selected = selected
        self.empty = empty
        self.opens = opens
        self._clicked = -1
        self._rows: Sequence[object] = ()
        self.count = 0
        self.index = 0
        self.first = 0

    def fill(self, rows: Sequence[object]) -> None:
        """Set the number of rows; the selection stays if possible, and so does a first click on an unchanged row."""
        at = self._clicked
        stays = 0 <= at < min(len(self._rows), len(rows)) and self._rows[at] == rows[at]
        self._rows, self.count = rows, len(rows)
        self.select(min(self.index, max(0, self.count - 1)))
        self._clicked = at if stays else -1

    @property
    def visible_lines(self) -> int:
        return max(1, int(self.area[3] // self.cell_height))

    @property
    def lines(self) -> int:
        return -(-self.count // self.columns)

    def select(self, index: int) -> None:
        self.index = min(max(0, index), max(0, self.count - 1))
        self._clicked = -1
        line = self.index // self.columns
        self.first = max(min(self.first, line), line - self.visible_lines + 1, 0)
        if self.count:
            self.selected(self.index)

    def show_around(self) -> None:
        """Scroll as little as brings the selection into the middle third, as far as there are rows."""
        third, line = self.visible_lines // 3, self.index // self.columns
        self.first = min(max(self.first, line - 2 * third), line - third)
        self.wheel(0)

    def confirm(self) -> bool:
        if self.count:
            self.choose(self.index)
        return True

    def nudge(self, action: str) -> bool:
        """Move the selection; beyond the ends the focus moves on."""
        page = self.visible_lines * self.columns
        steps = {"up": -self.columns, "down": self.columns, "page_up": -page, "page_down": page}
        if self.columns > 1:
            steps |= {"left": -1, "right": 1}
            place = self.index % self.columns
            if (action == "left" and place == 0) or (action == "right" and place == self.columns - 1):
                return False
        if action in ("first", "last"):
            self.select(0 if action == "first" else self.count - 1)
            return True
        if action not in steps or not self.count:
            return False
        goal = self.index + steps[action]
        if action.startswith("page"):
            goal = min(max(goal, 0), self.count - 1)
        last_line = self.index // self.columns == self.lines - 1
        if goal < 0 or (goal >= self.count and (last_line or action == "right")):
            return False
        self.select(goal)
        return True

    def row_area(self, index: int) -> Area:
        x, y, w, _ = self.area
        line, column = divmod(index, self.columns)
        width = (w - BAR_WIDTH - 4) / self.columns
        return x + column * width, y + (line - self.first) * self.cell_height, width, self.cell_height

    def _index_at(self, x: float, y: float) -> int | None:
        left, top, *_ = self.area
        column, line = int((x - left) // self.row_area(0)[2]), int((y - top) // self.cell_height)
        index = (self.first + line) * self.columns + column
        shown = 0 <= column < self.columns and line < self.visible_lines and index < self.count
        return index if shown else None

    def click(self, x: float, y: float) -> bool:
        """Choose the clicked row; on the bar: scroll there."""
        if x >= self.area[0] + self.area[2] - BAR_WIDTH - 4:
            return self.drag(x, y)
        index = self._index_at(x, y)
        if index is not None:
            chosen_before = index == self._clicked or not self.opens
            self.select(index)
            self._clicked = index
            if chosen_before:
                self.choose(index)
        return index is not None

    def hover(self, x: float, y: float) -> bool:
        """The mouse is over the list: select that row, unless rows need a click; whether the selection changed."""
        index = self._index_at(x, y)
        if index is None or index == self.index or self.opens:
            return False
        self.index = index
        self.selected(index)
        return True

    def drag(self, x: float, y: float) -> bool:
        hidden = self.lines - self.visible_lines
        if hidden <= 0 or x < self.area[0] + self.area[2] - BAR_WIDTH - 30:
            return False
        share = (y - self.area[1]) / self.area[3]
        self.first = round(min(1.0, max(0.0, share)) * hidden)
        return True

    def wheel(self, steps: int) -> bool:
        self.first = min(max(0, self.first - steps), max(0, self.lines - self.visible_lines))
        return True

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        x, y, w, h = self.area
        start = self.first * self.columns
        for index in range(start, min(self.count, start + self.visible_lines * self.columns)):
            self.draw_row(surface, theme, index, self.row_area(index), focused and index == self.index)
        if not self.count and self.empty:
            place, faint = (x + 6, y + h / 2 - 6, w - 12, h / 2), theme.palette.faint
            theme.paragraph(surface, [self.empty], place, 11, 15, colour=faint, align="centre")
        if self.lines > self.visible_lines:
            length = max(20.0, h * self.visible_lines / self.lines)
            top = y + (h - length) * self.first / (self.lines - self.visible_lines)
            theme.canvas.fill_rect(surface, theme.palette.panel_edge, x + w - BAR_WIDTH, y, BAR_WIDTH - 3, h, 2)
            theme.canvas.fill_rect(surface, theme.palette.accent, x + w - BAR_WIDTH, top, BAR_WIDTH - 3, length, 2)


class NameList(ListView):
    """A list of names, the selected one bold, beside what it shows; ``size``: of the letters, logical px."""

    def __init__(
        self,
        area: Area,
        row_height: float,
        names: Sequence[str],
        size: float,
        selected: Callable[[int], object],
        choose: Callable[[int], object] = lambda _: None,
    ) -> None:
        super().__init__(area, row_height, self._draw_name, choose, selected=selected)
        self._names, self._size = names, size

    def _draw_name(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        chosen, size = index == self.index, self._size
        if chosen:
            theme.row(surface, (x, y + 1, w, h - 2), chosen=True, focused=focused, radius=3)
        height = min(h, theme.common_height(self._names, size, w - 10))
        top = y + (h - size) // 2
        theme.text(surface, self._names[index], x + 8, top, size=size, bold=chosen, width=w - 10, height=height)
