"""Records: the best of each episode and level, to be watched again, and what killed the player how often."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import pygame

from ninja_game.files.writing import write_atomically
from ninja_game.formats.replay.text import write_episode, write_replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.replays import watch
from ninja_game.player.records import SavedReplay
from ninja_game.sim.rules import TICK_MS
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Widget

ROW = 30
SIDE, SIDE_WIDTH = 528, 228


class RecordRow(NamedTuple):
    """A record: what, an episode's clock or a level's time ("": not passed), its replays, whether it heads a group."""

    text: str
    score: str
    replays: tuple[int, ...]
    head: bool
    when: str = ""


class RecordsScreen(MenuScreen):
    """Bests at the left, statistics at the right."""

    title = "Records"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.rows: list[RecordRow] = []
        self.list = ListView((44, 92, 468, 15 * ROW), ROW, self._draw_row, self._watch, selected=self._say, opens=True)
        self.list.empty = "No records yet. Pass a level and it shows up here"

    def build(self) -> Sequence[Widget]:
        self.rows = self._rows()
        self.list.fill(self.rows)
        return [self.list]

    def _rows(self) -> list[RecordRow]:
        """Episodes with their levels, then other levels that have been passed."""
        records, catalogue = self.player.records, self.player.catalogue
        bests, marks = records.level_bests(), self.player.marks.all()

        def row(text: str, saved: SavedReplay) -> RecordRow:
            time = marks[saved.level].fastest if saved.level in marks else saved.final_tick
            return RecordRow(text, f"{seconds_text(time)} s", (saved.id,), False, saved.made_at[:10])

        rows = []
        listed = set()
        episodes = [(pack, episode) for pack in catalogue.packs() for episode in pack.episodes.values()]
        for pack, episode in episodes:
            best = records.episode_best(episode.key)
            text = f"{pack.key}{', e' if pack.key else 'E'}pisode {episode.code}: {episode.name}"
            clock = f"{seconds_text(best.score)} s left" if best else ""
            rows.append(RecordRow(text, clock, best.replays if best else (), True))
            for entry in episode.levels:
                listed.add(entry.digest)
                saved = bests.get(entry.digest)
                rows.append(row(entry.title, saved) if saved else RecordRow(entry.title, "", (), False))
        others = [saved for digest, saved in bests.items() if digest not in listed]
        if others:
            rows.append(RecordRow("Other levels", "", (), True))
        others.sort(key=lambda saved: saved.name.casefold())
        return rows + [row(saved.name or "unnamed", saved) for saved in others]

    def _say(self, index: int) -> None:
        """The hint of the selected row."""
        row = self.rows[index]
        missing = "Not yet passed in one go" if row.head else "Not passed yet"
        self.list.hint = "Enter to watch, E to save as a text file" if row.replays else missing

    def _watch(self, index: int) -> None:
        watch(self.app, [self.player.records.replay(number) for number in self.rows[index].replays])

    def handle(self, event: InputEvent) -> None:
        """The export key writes the selected record as a text file: an episode's runs as one."""
        row = self.rows[self.list.index] if self.rows else None
        if "export" in event.pressed and row and row.replays:
            replays = list(filter(None, map(self.player.records.replay, row.replays)))
            if len(replays) < len(row.replays):
                self.app.notify("Not written: a run of it is damaged")
            elif row.head:
                self.app.write_export(
                    row.text, ".episode.txt", lambda path: write_atomically(path, write_episode(replays))
                )
            else:
                self.app.write_export(row.text, ".replay.txt", write_replay(*replays))
        else:
            super().handle(event)

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        theme.text(surface, "Your best", 44, 68, size=14, bold=True)
        theme.text(surface, "What killed you", SIDE, 68, size=14, bold=True)
        deaths = {killer: times for killer, times in self.player.statistics.deaths().items() if times}
        most = max(deaths.values(), default=1)
        if not deaths:
            theme.text(surface, "Nothing so far", SIDE, 98, size=11, colour=palette.faint)
        for place, (killer, times) in enumerate(deaths.items()):
            y = 98 + 27 * place
            theme.text(surface, _NAMES.get(killer, killer.capitalize()), SIDE, y, size=11)
            theme.text(surface, str(times), SIDE + SIDE_WIDTH, y, size=11, align="right")
            theme.canvas.fill_rect(surface, palette.panel, SIDE, y + 15, SIDE_WIDTH, 4, 2)
            theme.canvas.fill_rect(surface, palette.bad, SIDE, y + 15, max(4, SIDE_WIDTH * times / most), 4, 2)
        played = self.player.statistics.played()
        hours, minutes = divmod(played.ticks * TICK_MS // 60_000, 60)
        lines = (
            ("Tries", str(played.attempts)), ("Passes", str(played.passes)), ("Gold collected", str(played.gold)),
            ("Time played", (f"{hours} h " if hours else "") + f"{minutes} min"),
        )  # fmt: skip
        for place, (what, number) in enumerate(lines):
            y = 364 + 22 * place
            theme.text(surface, what, SIDE, y, size=11, colour=palette.faint)
            theme.text(surface, number, SIDE + SIDE_WIDTH, y, size=11, align="right")

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        row = self.rows[index]
        palette = theme.palette
        x, y, w, h = area
        chosen = index == self.list.index
        theme.row(surface, (x, y + 2, w, h - 4), chosen=chosen, focused=focused, radius=3, filled=row.head)
        top = y + h / 2 - 6
        left = x + (8 if row.head else 24)
        theme.text(surface, row.text, left, top, size=12, bold=row.head, width=w - 232)
        if row.score:
            right, ink = x + w - 90, palette.good
            theme.text(surface, row.score, right, top, size=12, colour=ink, align="right", bold=row.head, width=110)
            theme.text(surface, row.when, x + w - 8, top + 1, size=10, colour=palette.faint, align="right", width=76)
        elif not row.head or index == 0:
            theme.text(surface, "not passed yet", x + w - 8, top, size=10.5, colour=palette.faint, align="right")


_NAMES = {"player": "Falls, crushing, time"}
