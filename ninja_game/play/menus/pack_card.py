"""The card of a pack, which a player sees first."""

from __future__ import annotations

from collections.abc import Sequence

import pygame

from ninja_game.files.shown_text import shown_text
from ninja_game.levels.episodes import EpisodeSet
from ninja_game.play.app import App
from ninja_game.play.menu_screen import Menu, MenuRow
from ninja_game.play.menus.pack_list import pack_size
from ninja_game.play.thumbnails import Thumbnails

_PICTURE = 240.0


class PackCard(Menu):
    """A menu below name, author, version, picture, size and comment of a pack."""

    head = 300

    def __init__(self, app: App, pack: EpisodeSet, rows: Sequence[MenuRow]) -> None:
        self._pack, self._index = pack, pack.pack.index if pack.pack else None
        self._thumbnails = Thumbnails(app)
        super().__init__(app, shown_text(self._index.name if self._index else pack.name), rows)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        self.redraw = self._thumbnails.work() or self.redraw

    def draw_widgets(self, surface: pygame.Surface) -> None:
        super().draw_widgets(surface)
        (x, y, w, _), theme, index = self._box, self.theme, self._index
        middle, faint = x + w / 2, theme.palette.faint
        by = shown_text(index.byline) if index else ""
        theme.text(surface, by, middle, y + 41, size=11, align="centre", width=w - 24)
        self._thumbnails.draw_pack(surface, self._pack.levels, middle - _PICTURE / 2, y + 62, _PICTURE)
        theme.text(surface, pack_size(self._pack), middle, y + 250, size=10, align="centre", colour=faint)
        comment = shown_text(index.comment, 200) if index else ""
        theme.paragraph(surface, [comment], (x + 24, y + 266, w - 48, 28), 10, 13, align="centre")
