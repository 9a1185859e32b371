"""Small pictures of levels on screens, made a few at a time, so that opening a screen never waits for them."""

from __future__ import annotations

from time import perf_counter

import pygame

from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.view.sprites.thumbnail import thumbnail
from ninja_game.player.catalogue import Entry

BUDGET = 0.006
"""Seconds a picture may cost beyond its first thumbnail."""

MOST_KEPT = 600

Key = tuple[int, int, str]


class Thumbnails:
    """Pictures of levels by level, width and palette. Ask ``get`` while drawing, call ``work`` once a picture."""

    def __init__(self, app: App) -> None:
        self.app = app
        self._made: dict[Key, tuple[Entry, pygame.Surface]] = {}
        self._wanted: dict[Key, Entry] = {}

    def get(self, entry: Entry, width: float) -> pygame.Surface | None:
        """The picture of a level, ``width`` logical px wide; None if it has yet to be made."""
        palette = self.app.theme.palette
        key = id(entry.named.level), self.app.canvas.px(width), palette.name
        if key not in self._made:
            self._wanted[key] = entry
            return None
        return self._made[key][1]

    def work(self) -> bool:
        """Make some of the pictures that were asked for; whether there are new ones."""
        start = perf_counter()
        made = False
        while self._wanted and (not made or perf_counter() - start < BUDGET):
            key, entry = self._wanted.popitem()
            picture = thumbnail(entry.named.level, self.app.theme.palette, key[1])
            if len(self._made) >= MOST_KEPT:
                self._made.clear()
            # The entry is kept too, so that its level's id stays its own.
            self._made[key] = entry, picture
            made = True
        return made

    def draw(self, surface: pygame.Surface, entry: Entry, x: float, y: float, width: float) -> None:
        """Show a level's picture, or its frame until it is made."""
        canvas, palette = self.app.canvas, self.app.theme.palette
        picture = self.get(entry, width)
        height = width * 25 / 33
        if picture is None:
            canvas.fill_rect(surface, palette.tile, x, y, width, height)
        else:
            surface.blit(picture, canvas.point(x, y))
        canvas.frame_rect(surface, palette.panel_edge, x - 0.5, y - 0.5, width + 1, height + 1, 1)


class ThumbnailScreen(MenuScreen):
    """A menu that shows pictures of levels."""

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.thumbnails = Thumbnails(app)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        self.redraw = self.thumbnails.work() or self.redraw
