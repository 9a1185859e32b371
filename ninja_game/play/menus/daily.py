"""The daily level: made in the background on the day's first visit, then played like any other."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date, timedelta
from functools import partial
from pathlib import Path
from random import Random
from threading import Event

import pygame

from ninja_game.backend.memories import choose_memory
from ninja_game.files.user_folder import LEVELS
from ninja_game.formats.run_time import seconds_text
from ninja_game.generator import daily
from ninja_game.levels.episodes import Entry
from ninja_game.play.app import App
from ninja_game.play.level.screen import play_level
from ninja_game.play.panels.settings import PRACTICE_HINT
from ninja_game.play.thumbnails import ThumbnailScreen, all_gold_and_medal, draw_pars, tries_text
from ninja_game.player.progress import next_par
from ninja_game.runtime import require_desktop, run_in_background
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.ui.theme import Theme, wrapped
from ninja_game.ui.widgets import Button, Widget

_LEFT, _TOP, _WIDTH = 44, 74, 480
_SIDE, _SIDE_WIDTH, _WEEK = 548, 200, 272

DIG_MS = 60  # ms per cell of the cave that is drawn while a level is made


class _DailyMaker:
    """A thread that makes the level of a day. ``progress``: a text; ``problem``: why it failed."""

    def __init__(self, levels: Path, day: date) -> None:
        self.progress = "getting started"
        self.problem = ""
        self.stop = Event()
        self.thread = run_in_background(lambda: self._run(levels, day), self._fail)

    def _run(self, levels: Path, day: date) -> None:
        if daily.take_packed(levels, day):
            return
        require_desktop()
        choose_memory("compiled")
        self.progress = "this takes a minute or two the first time"
        if not daily.make_daily(levels, day, report=partial(setattr, self, "progress"), stop=self.stop):
            self.problem = "No level could be made for today."

    def _fail(self, why: str) -> None:
        self.problem = f"No level could be made for today: {why}"


class DailyScreen(ThumbnailScreen):
    """Today's level, large, with its facts; while it is made, its progress."""

    title = "Daily level"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.day = date.today()  # noqa: DTZ011 - the player's day
        self.entry: Entry | None = None
        self.days: dict[str, Entry] = {}
        self.message = ""
        self.maker: _DailyMaker | None = None
        self._shown = ""
        self._rng = Random(self.day.toordinal())  # noqa: S311 - a picture
        self._dug = [(16, 12)]
        self._heading = 1, 0
        self._dig_ms = 0
        self.play = Button((_SIDE, 390, _SIDE_WIDTH, 36), "Play", self._play)
        self.practice = Button((_SIDE, 436, _SIDE_WIDTH, 36), "Practice", lambda: self._play(practice=True))
        self.practice.hint = PRACTICE_HINT

    @property
    def file(self) -> Path:
        return daily.daily_file(self.player.folder / LEVELS, self.day)

    def enter(self) -> None:
        self._find()
        super().enter()
        if self.entry is None and not self.message:
            self.maker = _DailyMaker(self.player.folder / LEVELS, self.day)

    def leave(self) -> None:
        """Stop making the level; the next visit starts again."""
        super().leave()
        if self.maker:
            self.maker.stop.set()
            self.maker = None

    def build(self) -> Sequence[Widget]:
        return [self.play, self.practice] if self.entry else []

    def _find(self) -> None:
        catalogue = self.player.catalogue
        catalogue.problems.clear()
        files = ((Path(entry.named.file), entry) for entry in catalogue.single_levels())
        self.days = {file.stem: entry for file, entry in files if file.parent == self.file.parent}
        self.entry = self.days.get(self.file.stem) if self.file.exists() else None
        self.message = ""
        if self.entry is None and self.file.exists():
            self.message = next(iter(catalogue.problems), f"{self.file} is not a level")

    def is_passed(self, day: date) -> bool:
        """Whether the level of a day has been passed, with help or without."""
        entry = self.days.get(day.isoformat())
        return entry is not None and self.player.marks.is_passed(entry.digest)

    @property
    def streak(self) -> int:
        """The number of days in a row with a passed level, up to today or yesterday, whenever they were passed."""
        count = int(self.is_passed(self.day))
        day = self.day - timedelta(1)
        while self.is_passed(day):
            count, day = count + 1, day - timedelta(1)
        return count

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        maker = self.maker
        if maker is None:
            return
        if not self.app.settings.reduced_motion:
            self._dig(real_ms)
        if not maker.thread.is_alive():
            self.maker = None
            self._find()
            self.message = self.message or maker.problem
            super().enter()
        if maker.progress != self._shown or self.maker is None:
            self._shown = maker.progress
            self.redraw = True

    def _dig(self, real_ms: int) -> None:
        self._dig_ms += real_ms
        for _ in range(self._dig_ms // DIG_MS):
            self._heading = self._rng.choice([self._heading] * 3 + [(1, 0), (-1, 0), (0, 1), (0, -1)])
            (x, y), (dx, dy) = self._dug[-1], self._heading
            self._dug.append((min(max(x + dx, 1), COLUMNS), min(max(y + dy, 1), ROWS)))
            self.redraw = True
        self._dig_ms %= DIG_MS

    def _play(self, *, practice: bool = False) -> None:
        if self.entry is not None:
            self.message = play_level(self.app, self.entry, practice=practice)
            self.redraw = True

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette, entry = self.app.theme, self.app.theme.palette, self.entry
        theme.text(surface, f"{self.day:%A}, {self.day.isoformat()}", _SIDE, _TOP, size=12, colour=palette.faint)
        if entry is None:
            canvas = self.app.canvas
            cell = _WIDTH / (COLUMNS + 2)
            canvas.fill_rect(surface, palette.tile, _LEFT, _TOP, _WIDTH, _WIDTH * 25 / 33, 4)
            for column, row in set(self._dug):
                canvas.fill_rect(surface, palette.background, _LEFT + cell * column, _TOP + cell * row, cell, cell)
            if self.maker:
                theme.panel(surface, _LEFT + 20, _TOP + 140, _WIDTH - 40, 64)
                for offset, size, text in ((150, 16, "Building today's level"), (180, 11, self.maker.progress)):
                    middle = _LEFT + _WIDTH / 2
                    theme.text(surface, text, middle, _TOP + offset, size=size, align="centre", width=_WIDTH - 60)
        else:
            self._draw_entry(surface, entry)
        if self.message:
            colour = palette.bad if entry else palette.on_tile
            for number, line in enumerate(wrapped(theme, self.message, _WIDTH - 40, 11)):
                theme.text(surface, line, _LEFT + 20, _TOP + 150 + 18 * number, size=11, colour=colour)

    def _draw_entry(self, surface: pygame.Surface, entry: Entry) -> None:
        theme = self.app.theme
        self.thumbnails.draw(surface, entry, _LEFT, _TOP, _WIDTH)
        theme.text(surface, entry.title, _SIDE, _TOP + 24, size=17, bold=True, width=_SIDE_WIDTH)
        mark = self.player.marks.of(entry.digest)
        played = self.player.statistics.played(entry.digest)
        streak = self.streak
        lines = [f"{streak} daily levels in a row"] if streak > 1 else []
        lines += [entry.pars.grade] if entry.pars and entry.pars.grade else []
        lines.append(f"{entry.all_gold} gold")
        lines.append(self.player.reached(entry, mark))
        if entry.pars and mark:
            lines.append(next_par(entry.pars, mark))
        if played.attempts:
            lines.append(tries_text(played))
        self._draw_week(surface, theme)
        for number, line in enumerate(lines):
            theme.text(surface, line, _SIDE, _TOP + 60 + 20 * number, size=11, width=_SIDE_WIDTH)
        draw_pars(surface, theme, entry.pars, mark and mark.fastest, _LEFT, _TOP + _WIDTH * 25 / 33 + 12)

    def _draw_week(self, surface: pygame.Surface, theme: Theme) -> None:
        for place in range(7):
            day = self.day + timedelta(place - self.day.weekday())
            entry = self.days.get(day.isoformat())
            mark = self.player.marks.of(entry.digest) if entry else None
            passed = self.is_passed(day)
            text = "not passed" if entry else ""
            if passed:
                text = f"{seconds_text(mark.fastest)} s" if mark else "with help"
            y = _WEEK + 16 * place
            colour = theme.palette.good if passed else theme.palette.faint
            theme.text(surface, f"{day:%a}", _SIDE, y, size=10, bold=day == self.day, width=40)
            theme.text(surface, text, _SIDE + 44, y, size=10, colour=colour, width=_SIDE_WIDTH - 70)
            if entry:
                all_gold_and_medal(surface, theme, entry, mark, _SIDE + _SIDE_WIDTH - 10, y + 5)
