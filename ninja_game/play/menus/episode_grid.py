"""The grid of episodes, and what is in the one that is selected (game.md §2.1, §7)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.settings.screen import PRACTICE_HINT
from ninja_game.play.menus.thumbnails import ThumbnailScreen
from ninja_game.play.ui.list_view import BAR, ListView
from ninja_game.play.ui.text_layout import counted
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Choice, Widget
from ninja_game.player.catalogue import Episode
from ninja_game.player.playthrough import EpisodeRun, LevelRun
from ninja_game.player.progress import CHEATED, LOCKED
from ninja_game.player.scoring import seconds_text

if TYPE_CHECKING:
    from ninja_game.play.app import App

LEFT, TOP, WIDE, MOST_HIGH = 44, 92, 318, 318
"""Where the grid lies: it is as large as the episodes that there are, cells up to LARGEST px."""

LARGEST = 62
SIDE = 392
ROW = 84
PICTURE = 96
LOOKS = (("beaten", "beaten"), ("open", "open"), ("cheated", "reached in practice"), ("locked", "locked"))


class Cells(ListView):
    """The grid of the episodes that there are. ``numbers``: each cell's episode, -1 where there is none."""

    numbers: list[int]

    def arrange(self, episodes: Iterable[int]) -> None:
        """Columns and lines as far as there are episodes."""
        numbers = set(episodes)
        columns = sorted({number // EPISODES_PER_COLUMN for number in numbers})
        lines = max((number % EPISODES_PER_COLUMN for number in numbers), default=0) + 1
        self.columns = max(1, len(columns))
        self.cell_height = min(LARGEST, WIDE / self.columns, MOST_HIGH / lines)
        self.area = LEFT, TOP, self.cell_height * self.columns + BAR + 4, self.cell_height * lines
        places = [column * EPISODES_PER_COLUMN + line for line in range(lines) for column in columns]
        self.numbers = [number if number in numbers else -1 for number in places]
        self.fill(self.numbers)

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


class EpisodeGrid(ThumbnailScreen):
    """Choose an episode to play, or one of its levels for a time trial."""

    title = "Episodes"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.grid = Cells((LEFT, TOP, WIDE, MOST_HIGH), LARGEST, self._draw_cell, self._play, selected=self._selected)
        self.rows = ListView((SIDE, 132, 364, ROW * 5), ROW, self._draw_row, self._trial)
        self.rows.hint = "Enter: time trial, this level alone on a full clock"
        self.grid.arrange(self.player.catalogue.episodes)

    # --- which ---

    @property
    def number(self) -> int:
        """The selected episode's number."""
        return self.grid.numbers[self.grid.index]

    @property
    def episode(self) -> Episode | None:
        """The selected episode, where there is one."""
        return self.player.catalogue.episodes.get(self.number)

    def _selected(self, _index: int) -> None:
        self.rows.index = 0
        self.rows.fill(self.episode.levels if self.episode and self._state(self.number) != LOCKED else ())
        self.rows.focusable = bool(self.rows.count)
        self.grid.hint = self._hint()

    def _state(self, number: int) -> str:
        return self.player.progress.state(number)

    def _hint(self) -> str:
        if self.episode is None:
            return "There are no episodes"
        if self._state(self.number) == LOCKED:
            return f"Locked: pass episode {self.number - 1} first"
        cheated = self._state(self.number) == CHEATED
        return "Enter: play, without records (reached in practice)" if cheated else "Enter: play this episode"

    @property
    def _below(self) -> float:
        """Where what stands below the grid begins."""
        return TOP + self.grid.area[3] + 20

    def build(self) -> Sequence[Widget]:
        """The grid, the levels of the selected episode, practice."""
        self._selected(self.grid.index)
        practice = Choice(
            (LEFT, self._below, WIDE, 30), "Practice mode", [("off", False), ("on", True)],
            lambda: self.player.settings.practice, self._set_practice,
            hint=PRACTICE_HINT,
        )  # fmt: skip
        return [self.grid, practice, self.rows]

    def _set_practice(self, value: object) -> None:
        self.app.change_settings(practice=value)

    # --- go ---

    def _play(self, _index: int) -> None:
        if self.episode is not None and self._state(self.number) != LOCKED:
            practice_mode = self.player.settings.practice
            self.app.push(LevelScreen(self.app, EpisodeRun(self.player, self.episode, practice_mode=practice_mode)))

    def _trial(self, index: int) -> None:
        if self.episode is not None:
            entry = self.episode.levels[index]
            run = LevelRun(self.player, entry, practice_mode=self.player.settings.practice)
            self.app.push(LevelScreen(self.app, run))

    # --- picture ---

    def draw_frame(self, surface: pygame.Surface) -> None:
        """What the grid's looks mean, and the head of the selected episode."""
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        theme.text(surface, "Beat an episode to unlock the one below", LEFT, 66, size=10, colour=palette.faint)
        for place, (look, text) in enumerate(LOOKS):
            x, y = LEFT + 160 * (place % 2), self._below + 46 + 26 * (place // 2)
            self._draw_look(surface, theme, look, (x, y, 20, 20))
            theme.text(surface, text, x + 27, y + 4, size=10)
        episode = self.episode
        if episode is None:
            theme.text(surface, "No episodes", SIDE, 66, size=16, colour=palette.faint, bold=True)
            return
        theme.text(surface, f"Episode {episode.number}: {episode.name}", SIDE, 66, size=16, bold=True)
        best = self.player.records.episode_best(episode.key)
        text = f"Your best: {seconds_text(best.score)}" if best else f"{len(episode.levels)} levels, not passed yet"
        theme.text(surface, self._hint() if self._state(episode.number) == LOCKED else text, SIDE, 96, size=11,
                   colour=palette.good if best else palette.faint)  # fmt: skip

    def _draw_cell(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        number = self.grid.numbers[index]
        if number < 0:
            return
        x, y, w, h = area
        inner = (x + 1.5, y + 1.5, w - 3, h - 3)
        look = self._look_of(number)
        self._draw_look(surface, theme, look, inner)
        if look != "locked":
            colour = theme.palette.on_tile if look == "beaten" else theme.palette.text
            size = min(16.0, h / 2)
            theme.text(surface, str(number), x + w / 2, y + (h - size) / 2, size=size, colour=colour, align="centre")
        if index == self.grid.index:
            width = 2.5 if focused else 1.2
            theme.canvas.frame_rect(surface, theme.palette.accent, x, y, w, h, width, 4)

    def _look_of(self, number: int) -> str:
        state = self._state(number)
        if self.player.progress.is_beaten(number):
            return "beaten"
        return {LOCKED: "locked", CHEATED: "cheated"}.get(state, "open")

    @staticmethod
    def _draw_look(surface: pygame.Surface, theme: Theme, look: str, area: Area) -> None:
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

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        episode = self.episode
        if episode is None or index >= len(episode.levels):
            return
        x, y, w, h = area
        entry = episode.levels[index]
        theme.row(surface, (x, y + 2, w, h - 4), chosen=focused, focused=focused)
        self.thumbnails.draw(surface, entry, x + 6, y + 5, PICTURE)
        left = x + PICTURE + 18
        theme.text(surface, f"{index}  {entry.title}", left, y + 16, size=13, bold=True, width=w - PICTURE - 30)
        best = self.player.records.level_best(entry.digest)
        played = self.player.statistics.played(entry.digest)
        text = f"best {seconds_text(best.score)}, {best.gold} gold" if best else "not passed yet"
        colour = theme.palette.good if best else theme.palette.faint
        theme.text(surface, text, left, y + 37, size=11, colour=colour)
        if played.attempts:
            tries = f"{counted(played.attempts, 'try', 'tries')}, {counted(played.deaths, 'death', 'deaths')}"
            theme.text(surface, tries, left, y + 54, size=10, colour=theme.palette.faint)
