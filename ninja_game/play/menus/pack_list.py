"""The player's packs with their pictures, to choose one."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game.files.shown_text import counted, shown_text
from ninja_game.levels.episodes import EpisodeSet
from ninja_game.play.app import App
from ninja_game.play.thumbnails import ThumbnailScreen
from ninja_game.player.records import has_words
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Widget

_ROW = 88
_PICTURE = 104


class PackList(ThumbnailScreen):
    """``choose`` gets the pack. Typed letters search in names, authors and comments."""

    title = "Your packs"

    def __init__(self, app: App, packs: Sequence[EpisodeSet], choose: Callable[[EpisodeSet], object]) -> None:
        super().__init__(app)
        self._packs, self._choose = packs, choose
        self.shown = packs
        self.list = ListView(
            (44, 106, 704, 5 * _ROW), _ROW, self._draw_row, self._choose_row, empty="No pack is called so"
        )
        self.field = self.search = TextEntry((44, 64, 300, 32), "Search name or author", "", self._find)

    def build(self) -> Sequence[Widget]:
        self.list.fill(self.shown)
        return [self.list, self.field]

    def act(self, action: str, *, held: bool = False) -> None:
        if action == "confirm" and self.focus is self.field:
            self._choose_row(self.list.index)
        else:
            super().act(action, held=held)

    def _find(self, text: str) -> None:
        self.shown = [pack for pack in self._packs if has_words(text.casefold().split(), _description(pack))]
        self.list.index = self.list.first = 0
        self.list.fill(self.shown)

    def _choose_row(self, index: int) -> None:
        if index < len(self.shown):
            self.app.pop()
            self._choose(self.shown[index])

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        pack = self.shown[index]
        chosen = index == self.list.index
        faint = theme.palette.faint
        theme.row(surface, (x, y + 1, w, h - 2), chosen=chosen, focused=focused)
        self.thumbnails.draw_pack(surface, pack.levels, x + 6, y + 4, _PICTURE)
        left, width = x + _PICTURE + 20, w - _PICTURE - 30
        theme.text(surface, shown_text(pack.name), left, y + 16, size=13, bold=chosen, width=width)
        theme.text(surface, _description(pack), left, y + 38, size=10, colour=faint, width=width)
        text = f"{pack_size(pack)}{', received' if pack.received else ''}"
        theme.text(surface, text, left, y + 58, size=10, colour=faint, width=width)


def pack_size(pack: EpisodeSet) -> str:
    return f"{counted(len(pack.levels), 'level')} in {counted(len(pack.episodes), 'episode')}"


def _description(pack: EpisodeSet) -> str:
    index = pack.pack.index if pack.pack else None
    return shown_text(index.summary, 200) if index else ""
