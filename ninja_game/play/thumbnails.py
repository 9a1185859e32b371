"""Small pictures of levels, made a few per picture, so that no screen waits for them when it opens."""

from __future__ import annotations

from collections.abc import Sequence
from time import perf_counter

import pygame

from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.pack.pars import MARGINS, Pars
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import GAME, YOURS, Entry
from ninja_game.play.app import App
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.player.progress import Mark, has_all_gold, medal_of
from ninja_game.player.records import Played
from ninja_game.ui.audio.music import MENU
from ninja_game.ui.medals import MEDALS_FROM_BRONZE, draw_all_gold, draw_medal
from ninja_game.ui.theme import Theme
from ninja_game.view.sprites.thumbnail import thumbnail

BUDGET = 0.006  # seconds per picture that may go to thumbnails after the first

MAX_KEPT = 600

_Key = tuple[str, int, str]


class Thumbnails:
    """Pictures of levels by level, width and palette. Call ``get`` while drawing, ``work`` once per picture."""

    def __init__(self, app: App) -> None:
        self.app = app
        self._made: dict[_Key, pygame.Surface] = {}
        self._wanted: dict[_Key, Entry] = {}

    def get(self, entry: Entry, width: float) -> pygame.Surface | None:
        """The picture of a level, ``width`` logical px wide; None if it is not made yet."""
        palette = self.app.palette_in(entry.mood)
        key = entry.digest, self.app.canvas.px(width), palette.name
        if key not in self._made:
            self._wanted[key] = entry
        return self._made.get(key)

    def work(self) -> bool:
        """Make some of the requested pictures; whether there are new ones."""
        start = perf_counter()
        has_drawn = False
        while self._wanted and (not has_drawn or perf_counter() - start < BUDGET):
            key, entry = self._wanted.popitem()
            picture = thumbnail(entry.named.level, self.app.palette_in(entry.mood), key[1])
            if len(self._made) >= MAX_KEPT:
                self._made.clear()
            self._made[key] = picture
            has_drawn = True
        return has_drawn

    def draw(self, surface: pygame.Surface, entry: Entry, x: float, y: float, width: float) -> None:
        canvas, palette = self.app.canvas, self.app.theme.palette
        picture = self.get(entry, width)
        height = width * 25 / 33
        if picture is None:
            canvas.fill_rect(surface, palette.panel, x, y, width, height)
        else:
            surface.blit(picture, canvas.point(x, y))
        canvas.frame_rect(surface, palette.panel_edge, x - 0.5, y - 0.5, width + 1, height + 1, 1)

    def draw_pack(self, surface: pygame.Surface, levels: Sequence[Entry], x: float, y: float, width: float) -> None:
        """Draw a pack as four of its levels, from its first to its last fourth, or as its first one."""
        parts = 2 if len(levels) >= 4 else 1
        size = width / parts
        for k, level in enumerate(levels[len(levels) * k // parts**2] for k in range(parts**2 if levels else 0)):
            self.draw(surface, level, x + k % 2 * size, y + k // 2 * size * 25 / 33, size)


class ThumbnailScreen(MenuScreen):
    """A menu with pictures of levels, drawn again as they become ready."""

    music = MENU

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.thumbnails = Thumbnails(app)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        self.redraw = self.thumbnails.work() or self.redraw


def all_gold_and_medal(
    surface: pygame.Surface, theme: Theme, entry: Entry, mark: Mark | None, right: float, middle: float
) -> None:
    """The medal of a level, centred at ``right``, and left of it the mark for all gold; nothing without a medal."""
    medal = medal_of(entry, mark)
    if medal:
        draw_medal(surface, theme, medal, right, middle)
    if has_all_gold(entry, mark):
        draw_all_gold(surface, theme, right - 18, middle)


def tries_text(played: Played) -> str:
    return f"{counted(played.attempts, 'try', 'tries')}, {counted(played.deaths, 'death', 'deaths')}"


def draw_pars(
    surface: pygame.Surface,
    theme: Theme,
    pars: Pars | None,
    tick: int | None,
    x: float,
    y: float,
    medals: Sequence[str] = MEDALS_FROM_BRONZE,
) -> None:
    """Draw pars in a row; those that a tick reaches are filled."""
    if pars is None:
        return
    for medal in medals:
        par = pars.par(medal) if medal in MARGINS else None
        reached = tick is not None and (par is None or tick <= par)
        draw_medal(surface, theme, medal, x + 8, y + 8, 16, reached=reached)
        theme.text(surface, "pass it" if par is None else f"{seconds_text(par)} s", x + 20, y + 3.5, size=9.5)
        x += 80


def where_from(entry: Entry) -> str:
    pack = shown_text(entry.source) if entry.source not in {GAME, YOURS} else ""
    place = entry.place or ("Your folder" if entry.source == YOURS else "")
    return "    ".join(filter(None, (pack, place, entry.pars.grade if entry.pars else "")))
