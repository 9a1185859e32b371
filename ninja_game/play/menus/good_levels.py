"""Ten of the game's levels and what makes each of them good, with notes at places."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from typing import NamedTuple

import pygame

from ninja_game.files.bundled import asset_text, data_folder
from ninja_game.formats.load import load_levels
from ninja_game.levels.episodes import GAME, Entry
from ninja_game.play.app import App
from ninja_game.play.thumbnails import ThumbnailScreen
from ninja_game.sim.grid import middle_of
from ninja_game.ui.list_view import NameList
from ninja_game.ui.theme import Area
from ninja_game.ui.widgets import Button, Widget

FILE = "good-levels.toml"

LEVEL_AREA: Area = (212, 66, 540, 540 * 25 / 33)  # where the level is shown
_AWAY = 24  # distance of a number from its place, across and down, px


class GoodLevel(NamedTuple):
    """A good level. ``about``: what makes it good. ``notes``: column and row of a cell, and a text about it."""

    entry: Entry
    about: str
    notes: Sequence[tuple[int, int, str]]

    @property
    def texts(self) -> list[str]:
        return [self.about, *(f"{number}  {text}" for number, (_, _, text) in enumerate(self.notes, 1))]


def read_good_levels() -> list[GoodLevel]:
    tables = tomllib.loads(asset_text(FILE))["level"]
    files = [data_folder("levels") / f"{table['file']}.txt" for table in tables]
    entries = [Entry(load_levels(file)[0], GAME) for file in files]
    return [GoodLevel(entry, table["about"], table["notes"]) for entry, table in zip(entries, tables, strict=True)]


class GoodLevelsScreen(ThumbnailScreen):
    """Good levels, with notes on their pictures. ``edit``: opens a copy of the selected one in the editor."""

    title = "Ten good levels, and why"

    def __init__(self, app: App, edit: Callable[[Entry], object]) -> None:
        super().__init__(app)
        self._edit = edit
        self.levels = read_good_levels()
        titles = [level.entry.title for level in self.levels]
        self.list = NameList((36, 66, 160, 10 * 30), 30, titles, 11, self._show)
        self.list.hint = "Up and down: another level"
        self.list.fill(self.levels)

    def build(self) -> Sequence[Widget]:
        return [self.list, Button((36, 380, 148, 28), "Edit a copy", self._open, hint="Look how it is made")]

    @property
    def level(self) -> GoodLevel:
        return self.levels[self.list.index]

    def _show(self, _: int) -> None:
        self.redraw = True

    def _open(self) -> None:
        self.close()
        self._edit(self.level.entry)

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette, (left, top, width, height) = self.theme, self.theme.palette, LEVEL_AREA
        self.thumbnails.draw(surface, self.level.entry, left, top, width)
        for number, (column, row, _) in enumerate(self.level.notes, 1):
            # Beside its place, so that the place is visible.
            px = width / 792
            x, y = middle_of((column, row))
            at = left + x * px, top + y * px
            x = at[0] + (_AWAY if column < 3 else -_AWAY)
            y = at[1] + (_AWAY if row < 2 else -_AWAY)
            theme.canvas.line(surface, palette.accent, (x, y), at, 1.5)
            theme.canvas.circle(surface, palette.accent, at, 2.5)
            theme.canvas.circle(surface, palette.accent, (x, y), 9)
            theme.canvas.circle(surface, palette.background, (x, y), 9, 1.5)
            theme.text(surface, str(number), x, y - 5.5, size=11, bold=True, align="centre", colour=palette.background)
        theme.paragraph(surface, self.level.texts, (left, top + height + 5, width, 560 - top - height), 9.5, 12.5)
