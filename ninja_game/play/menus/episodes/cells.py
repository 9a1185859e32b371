"""The cells of the grid of episodes: where each stands, and what shows its state."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import pygame

from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.play.ui.list_view import BAR, ListView
from ninja_game.play.ui.theme import Area, Theme

LEFT, TOP, WIDE, MOST_HIGH = 44, 116, 318, 286
"""Where the grid lies: it is as large as the episodes that there are, cells up to LARGEST px."""

LARGEST = 62
NAMED = 48
"""px from which on a cell is wide enough for its column's name."""

LOOKS = (("beaten", "beaten"), ("open", "open"), ("cheated", "reached in practice"), ("locked", "locked"))


class Cells(ListView):
    """The grid of the episodes that there are. ``numbers``: each cell's episode, -1 where there is none.

    ``heads``: the columns, as numbers, that are there.
    """

    numbers: list[int]
    heads: list[int]

    def arrange(self, episodes: Iterable[int]) -> None:
        """Columns and lines as far as there are episodes."""
        numbers = set(episodes)
        self.heads = sorted({number // EPISODES_PER_COLUMN for number in numbers})
        lines = max((number % EPISODES_PER_COLUMN for number in numbers), default=0) + 1
        self.columns = max(1, len(self.heads))
        self.cell_height = min(LARGEST, WIDE / self.columns, MOST_HIGH / lines)
        self.area = LEFT, TOP, self.cell_height * self.columns + BAR + 4, self.cell_height * lines
        places = [column * EPISODES_PER_COLUMN + line for line in range(lines) for column in self.heads]
        self.numbers = [number if number in numbers else -1 for number in places]
        self.index = self.first = 0
        if self.numbers[:1] == [-1]:
            self.index = next(place for place, number in enumerate(self.numbers) if number >= 0)
        self.fill(self.numbers)

    def draw_names(self, surface: pygame.Surface, theme: Theme, names: Sequence[str]) -> None:
        """The columns' names over them; where they are narrow that of the selected one alone."""
        size = self.cell_height
        faint = theme.palette.faint
        for place, column in enumerate(self.heads):
            name = names[column] if column < len(names) else ""
            chosen = place == self.index % self.columns
            if size >= NAMED:
                colour = theme.palette.text if chosen else faint
                middle = LEFT + (place + 0.5) * size
                theme.text(surface, name, middle, TOP - 15, size=9, colour=colour, align="centre", width=size - 2)
            elif chosen:
                theme.text(surface, name, LEFT, TOP - 15, size=10, colour=faint, width=WIDE)

    def nudge(self, action: str) -> bool:
        """Move the selection; where there is no episode the focus moves on instead."""
        before, first = self.index, self.first
        used = super().nudge(action)
        if used and self.numbers[self.index] < 0:
            self._select(before)
            self.first = first
            return False
        return used

    def click(self, x: float, y: float) -> bool:
        """Choose what is clicked, unless there is nothing."""
        index = self._index_at(x, y)
        return index is not None and self.numbers[index] >= 0 and super().click(x, y)

    def hover(self, x: float, y: float) -> bool:
        """The mouse is over it: select what is there, unless there is nothing."""
        index = self._index_at(x, y)
        return index is not None and self.numbers[index] >= 0 and super().hover(x, y)


def draw_look(surface: pygame.Surface, theme: Theme, look: str, area: Area) -> None:
    """One cell by its state: shape tells it as well as colour."""
    canvas, palette = theme.canvas, theme.palette
    x, y, w, h = area
    fill = {"beaten": palette.tile, "locked": palette.background}.get(look, palette.panel)
    canvas.fill_rect(surface, fill, x, y, w, h, 3)
    canvas.frame_rect(surface, palette.panel_edge, x, y, w, h, 1, 3)
    if look == "cheated":
        canvas.polygon(surface, palette.bad, [(x + w - 9, y + 1), (x + w - 1, y + 1), (x + w - 1, y + 9)])
    elif look == "locked":
        cx, cy = x + w / 2, y + h / 2
        canvas.fill_rect(surface, palette.panel_edge, cx - 4.5, cy - 1, 9, 7, 1)
        canvas.circle(surface, palette.panel_edge, (cx, cy - 2), 4, 1.5)
