"""Levels as cells in rows, which the mouse drags."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from math import dist
from typing import NamedTuple

import pygame

from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, EpisodeIndex
from ninja_game.levels.episodes import Entry
from ninja_game.play.menus.packer import NOT_CERTIFIED, NOT_FOUND, PackStatus
from ninja_game.play.thumbnails import Thumbnails
from ninja_game.ui.list_view import BAR_WIDTH, ListView
from ninja_game.ui.medals import draw_all_gold
from ninja_game.ui.theme import Area, Theme, wrapped

CELL_WIDTH, CELL_HEIGHT = 93, 106

_GAP = 12  # px by which cells move aside for a dragged one
PULL = 6  # px that the mouse moves with its button down before a drag begins


class PackCell(NamedTuple):
    """A cell of the shelves: a level, a free place, or (``head``) the name of an episode before its levels."""

    episode: EpisodeIndex | None  #: None: in the row for a new episode
    level: Entry | None = None  #: None: a free place
    head: bool = False


class Rack(ListView):
    """Cells to drag: ``pull`` gets a cell and the mouse's place. A second click is for its screen (``release``).

    ``status``: of the levels' pack. ``marked``, ``lifted``: files of the marked and of the dragged levels. ``gap``: the
    cell from which on cells move aside, 0 for none.
    """

    def __init__(
        self,
        area: Area,
        columns: int,
        *,
        status: PackStatus,
        thumbnails: Thumbnails,
        marked: Collection[str],
        pull: Callable[[PackCell, tuple[float, float]], object],
        choose: Callable[[PackCell], object],
    ) -> None:
        super().__init__(area, CELL_HEIGHT, self._draw_cell, lambda index: choose(self.cells[index]), opens=True)
        self.columns, self.status, self.thumbnails, self.pull = columns, status, thumbnails, pull
        self.cells: Sequence[PackCell] = ()
        self.marked, self.gap = marked, 0
        self.lifted = set[str]()
        self._pressed = (0.0, 0.0)
        self._again = False

    def show(self, cells: Sequence[PackCell]) -> None:
        self.cells = cells
        self.fill(cells)

    def click(self, x: float, y: float) -> bool:
        index = self._index_at(x, y)
        self._again = index is not None and index == self._clicked
        self._clicked, self._pressed = -1, (x, y)
        return super().click(x, y)

    def drag(self, x: float, y: float) -> bool:
        index = self._index_at(*self._pressed)
        if index is None or self._pressed[0] >= self.area[0] + self.area[2] - BAR_WIDTH - 4:
            return super().drag(x, y)
        if dist((x, y), self._pressed) > PULL:
            self._again = False
            self.pull(self.cells[index], (x, y))
        return True

    def release(self) -> bool:
        """The button is released without a drag; whether that is a second click. The next one is a first one again."""
        self._clicked = -1 if self._again else self._clicked
        return self._again

    @property
    def chosen(self) -> PackCell:
        return self.cells[self.index] if self.cells else PackCell(None)

    def shift(self, index: int) -> float:
        """The distance by which a cell moves aside, px."""
        line, first = divmod(self.gap, self.columns)
        return _GAP if 0 < first <= index % self.columns and index // self.columns == line else 0.0

    @property
    def clicked(self) -> PackCell:
        """The cell that was clicked last, if it is still selected."""
        return self.cells[self._clicked] if self._clicked >= 0 else PackCell(None)

    def at(self, x: float, y: float) -> int | None:
        return self._index_at(x, y) if self.contains(x, y) else None

    def _draw_cell(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        cell = self.cells[index]
        chosen = index == self.index
        x, y, w, h = area
        x += self.shift(index)
        inner = (x + 2, y + 2, w - 4, h - 4)
        lifted = cell.level is not None and cell.level.named.file in self.lifted
        is_marked = cell.level is not None and cell.level.named.file in self.marked
        if cell.head:
            self._draw_head(surface, theme, cell, inner)
        elif cell.level and not lifted:
            theme.row(surface, inner, chosen=chosen and focused, focused=focused)
            self._draw_level(surface, theme, cell.level, x + 6, y + 6, w - 12)
        if is_marked and not lifted:
            theme.canvas.circle(surface, theme.palette.accent, (x + 11, y + 11), 6)
        free = not (cell.head or cell.level)
        if is_marked or (chosen and focused and not self.lifted):
            theme.canvas.frame_rect(surface, theme.palette.accent, *inner, 2.5, 4)
        elif lifted or free:
            theme.canvas.frame_rect(surface, theme.palette.panel_edge, *inner, 1, 4)
        if free and (self.cells[index - 1].head or self.cells[index - 1].level):
            text = "New level, or drag one here" if cell.episode else "Drag a level here"
            place, faint = (x + 8, y + h / 2 - 18, w - 16, 40), theme.palette.faint
            theme.paragraph(surface, [text], place, 9, 12, colour=faint, align="centre")

    def _draw_level(self, surface: pygame.Surface, theme: Theme, level: Entry, x: float, y: float, w: float) -> None:
        palette, state = theme.palette, self.status.state(level)
        self.thumbnails.draw(surface, level, x, y, CELL_WIDTH - 12)
        pars = level.pars if state not in (*NOT_CERTIFIED, NOT_FOUND) else None
        gold = pars is not None and pars.gold is not None and level.all_gold > 0
        title, width = shown_text(level.title), w - 12 * gold
        top = y + (63 if len(wrapped(theme, title, width, 9.5)) > 1 else 69)
        theme.paragraph(surface, [title], (x, top, width, 22), 9.5, 10.5)
        colour = palette.good if pars else palette.bad if state in ("changed", NOT_FOUND) else palette.faint
        theme.text(surface, state, x, y + 86, size=8.5, colour=colour, width=w - 40 if pars else w)
        if gold:
            draw_all_gold(surface, theme, x + w - 5, y + 73, 8)
        if pars:
            theme.text(surface, pars.grade, x + w, y + 86, size=8.5, align="right", width=40)
        if self.status.checked and level.named.file in self.status.checked.places:
            middle = x + CELL_WIDTH - 21
            theme.canvas.circle(surface, palette.panel, (middle, y + 9), 8)
            theme.text(surface, "!", middle, y + 3, size=11, bold=True, colour=palette.bad, align="centre")

    def _draw_head(self, surface: pygame.Surface, theme: Theme, cell: PackCell, area: Area) -> None:
        x, y, w, h = area
        theme.panel(surface, *area)
        if cell.episode is None:
            theme.paragraph(surface, ["New episode..."], (x + 6, y + h / 2 - 8, w - 12, 24), 10.5, 13)
            return
        number = cell.episode.number
        column = number // EPISODES_PER_COLUMN
        names = self.status.pack.columns if self.status.pack else ()
        place, faint = f"Episode {number + 1}", theme.palette.faint
        if place != cell.episode.name:
            theme.text(surface, place, x + 6, y + 6, size=9, colour=faint, width=w - 12)
        theme.paragraph(surface, [shown_text(cell.episode.name)], (x + 6, y + 21, w - 12, 42), 11, 14)
        if column < len(names):
            below = x + 6, y + 72, w - 12, 26
            theme.paragraph(surface, [f"in {shown_text(names[column])}"], below, 9, 12, colour=faint)


class Marks(set[str]):
    """Files of the marked levels: an action on one of them is done with all."""

    def together(self, level: Entry, levels: Sequence[Entry]) -> list[Entry]:
        """The levels of an action on ``level``: all marked ones if it is marked, else only itself."""
        return [other for other in levels if other.named.file in self] if level.named.file in self else [level]

    def click(self, rack: Rack, index: int) -> bool:
        """Mark levels if Ctrl or Shift is down; tells whether it was. Else a click on an unmarked one unmarks all."""
        mods = pygame.key.get_mods()
        level = rack.cells[index].level
        if not (level and mods & (pygame.KMOD_CTRL | pygame.KMOD_META | pygame.KMOD_SHIFT)):
            if not (level and level.named.file in self):
                self.clear()
            return False
        if mods & pygame.KMOD_SHIFT:
            first, last = sorted((rack.index, index))
            self.update(cell.level.named.file for cell in rack.cells[first : last + 1] if cell.level)
            return True
        if rack.clicked.level and not self:
            self.add(rack.clicked.level.named.file)
        if self != {level.named.file}:
            self.symmetric_difference_update({level.named.file})
        return True


def called(levels: Sequence[Entry]) -> str:
    return shown_text(levels[0].title) if len(levels) == 1 else counted(len(levels), "level")
