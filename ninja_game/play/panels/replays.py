"""The lists of replays (in the records, in the player's folder, of the game) and of records."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import pygame

from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.bundled import bundled_replays
from ninja_game.files.reading import Skipped, files_below
from ninja_game.files.shown_text import files_text
from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.files.writing import write_atomically
from ninja_game.formats.links import recording_link, replay_link
from ninja_game.formats.load import load_replays, texts_of
from ninja_game.formats.recording import Recording, holds_recordings
from ninja_game.formats.replay.text import Replay, write_episode, write_replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import author_name
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_link
from ninja_game.play.menu_screen import MenuScreen, Question
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.player_data import forget_replay
from ninja_game.player.progress import opens_author
from ninja_game.player.records import NEWEST_SHOWN, SavedReplay, has_words
from ninja_game.sim.rules import TICK_MS
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Choice, Widget

_ROW = 34
FIRST_SECONDS, MORE_SECONDS = 0.05, 0.008
"""Seconds for reading files when the screen opens, and in each picture after that."""
FILES_SHOWN = 300  # most recordings read from the player's folder


_OUTCOMES = {"exit": "passed", "dead": "death", "running": "unfinished"}
YOU = "you"
OWNERS = [("All runs", "all"), ("Yours", "yours"), ("Others'", "others")]
_NONE_YET = "Your runs will show up here. Earn a gold medal and the author's run joins them"
NO_MATCH = "No replay matches"
HINT = "Enter to watch, Delete to remove, E to save as a text file, C to copy a link"


class ReplayRow(NamedTuple):
    """A replay: title, player, result, date; and its place."""

    text: str
    player: str
    result: str
    when: str
    good: bool
    source: SavedReplay | Recording


class ReplaysScreen(MenuScreen):
    """All replays. Delete removes one of the records that no best needs. ``hint``, ``empty``: of the list."""

    title = "Replays"
    heads = "Level", "Player", "Result, time", "From"
    hint = HINT
    empty = _NONE_YET

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.rows: list[ReplayRow] = []
        self.problems: list[str] = []
        self.without_runs: list[str] = []
        self._saved: list[ReplayRow] = []
        self._files: list[ReplayRow] = []
        self._unread = self._file_rows()
        self._words: list[str] = []
        self.shown_owner = "all"
        self.filter = Choice((346, 62, 180, 28), "", OWNERS, lambda: self.shown_owner, self._show)
        self.field = TextEntry((44, 62, 290, 28), "Search level or player", "", self._search)
        self.list = ListView((44, 120, 712, 12 * _ROW), _ROW, self._draw_row, self._choose, opens=True)
        self.list.hint = self.hint
        self.message = ""

    def build(self) -> Sequence[Widget]:
        self._find()
        self._read_files(FIRST_SECONDS)
        self._arrange()
        return [self.list, self.field, self.filter]

    def _show(self, owner: str) -> None:
        self.shown_owner = owner
        self._arrange()

    def _search(self, text: str) -> None:
        self._words = text.casefold().split()
        self._find()
        self._arrange()

    def _find(self) -> None:
        self._saved = list(map(_row_of, self.player.records.replays(self._words)))

    def _arrange(self) -> None:
        files = [row for row in self._files if has_words(self._words, row.text, row.player, row.result, row.when)]
        replays = {"yours": self._saved, "others": files}.get(self.shown_owner, [*self._saved, *files])
        self.rows = self.arranged(replays)
        self.list.empty = NO_MATCH if self._words or self.shown_owner != "all" else self.empty
        self.list.fill(self.rows)

    def _read_files(self, seconds: float) -> bool:
        """Read files for a number of seconds; whether any are left."""
        end, before = perf_counter() + seconds, len(self._files)
        while perf_counter() < end and (rows := next(self._unread, None)) is not None:
            self._files += rows
        return len(self._files) > before

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        if self._read_files(MORE_SECONDS):
            self._arrange()
            self.redraw = True

    def arranged(self, rows: list[ReplayRow]) -> list[ReplayRow]:
        return rows

    def lists(self, recording: Recording) -> bool:
        """Whether a run in a file is listed."""
        return True

    def places(self) -> list[tuple[str, Iterable[Path | Skipped]]]:
        return [("Your folder", files_below(self.player.replay_folder)), ("Included", self.bundled())]

    def bundled(self) -> list[Path]:
        """The authors' runs of the levels where a gold medal has unlocked them."""
        marks = self.player.marks.all()
        levels = self.player.catalogue.ours.levels if marks else []
        opened = {Path(level.named.file).stem for level in levels if opens_author(level, marks.get(level.digest))}
        return [file for file in bundled_replays() if file.name.partition(".")[0] in opened]

    def _file_rows(self) -> Iterator[list[ReplayRow]]:
        looks = set[tuple[object, ...]]()
        for when, files in self.places():
            for file in files:
                if isinstance(file, Skipped):
                    self.problems.append(file.path.name)
                    continue
                try:
                    recordings = load_replays(file)
                except (NinjaGameError, OSError):
                    (self.problems if _may_have_runs(file) else self.without_runs).append(file.name)
                    continue
                # An author's run for the exit may be the one for all gold too.
                read = (_row_of_recording(recording, when) for recording in recordings if self.lists(recording))
                rows = [row for row in read if _looks(row) not in looks]
                looks.update(map(_looks, rows))
                yield rows
                if len(self._files) > FILES_SHOWN:
                    break

    def _choose(self, index: int) -> None:
        self.choose(self.rows[index].source)

    def choose(self, source: SavedReplay | Recording) -> None:
        if isinstance(source, Recording):
            watch_recording(self.app, source)
        else:
            watch_replays(self.app, [self.player.records.replay(source.id)])

    def handle(self, event: InputEvent) -> None:
        if "export" in event.pressed and self.rows:
            self._export(self.rows[self.list.index])
        elif "link" in event.pressed and self.rows:
            self._copy_link(self.rows[self.list.index])
        else:
            super().handle(event)

    def _export(self, row: ReplayRow) -> None:
        source = row.source
        replay = source.replay if isinstance(source, Recording) else self.player.records.replay(source.id)
        if replay is None:
            self.app.notify("Only replays of this game can be saved as text")
        else:
            self.app.write_export(row.text, REPLAY_SUFFIX, write_replay(replay))

    def _copy_link(self, row: ReplayRow) -> None:
        def make() -> str:
            if isinstance(row.source, Recording):
                return recording_link([row.source])
            replay = self.player.records.replay(row.source.id)
            return replay_link([replay] if replay else [])

        copy_link(self.app, make, title=row.text)

    def act(self, action: str, *, held: bool = False) -> None:
        source = self.rows[self.list.index].source if self.rows else None
        if action == "delete" and isinstance(source, SavedReplay):
            number = source.id
            if number in {best.id for best in self.player.records.level_bests().values()}:
                self.message = "A personal best cannot be removed"
                self.redraw = True
                return
            self.app.push(Question(self.app, "Remove this replay?", "Remove", lambda: self._forget(number)))
            return
        super().act(action, held=held)

    def _forget(self, number: int) -> None:
        self.message = forget_replay(self.player, number)
        self.enter()
        self.redraw = True

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        places = (54, "left"), (340, "left"), (612, "right"), (734, "right")
        for text, (x, align) in zip(self.heads, places, strict=True):
            theme.text(surface, text, x, 100, size=10.5, colour=palette.faint, align=align)
        newest = f"The newest {NEWEST_SHOWN} of yours; a search finds all" if len(self._saved) == NEWEST_SHOWN else ""
        unread = files_text("Cannot be read", self.problems)
        message = self.message or unread or newest or files_text("No runs in", self.without_runs)
        theme.text(surface, message, 44, 545, size=10, colour=palette.faint, width=712)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        row = self.rows[index]
        palette = theme.palette
        x, y, w, h = area
        chosen = index == self.list.index
        theme.row(surface, (x, y + 2, w, h - 4), chosen=chosen, focused=focused, radius=3)
        top = y + h / 2 - 6
        theme.text(surface, row.text, x + 10, top, size=12, bold=chosen, width=270)
        theme.text(surface, row.player, 340, top + 0.5, size=11, colour=palette.faint, width=126)
        colour = palette.good if row.good else palette.faint
        theme.text(surface, row.result, 612, top, size=12, colour=colour, align="right", width=140)
        theme.text(surface, row.when, 734, top + 1, size=10, colour=palette.faint, align="right", width=114)


def _looks(row: ReplayRow) -> tuple[object, ...]:
    """The words that tell a run of a file from its other runs."""
    return *row[:4], row.source.inputs if isinstance(row.source, Recording) else b""


def _may_have_runs(file: Path) -> bool:
    """Whether there are recordings in a file that cannot be read as such, as far as one can say."""
    with suppress(NinjaGameError, OSError):
        return any(holds_recordings(text) for _, text in texts_of(file, may_be_link=False))
    return True


def _row_of(saved: SavedReplay) -> ReplayRow:
    result = result_of(saved.outcome, saved.gold, saved.final_tick)
    when = saved.made_at[:16].replace("T", "  ")
    return ReplayRow(saved.name or "unnamed", saved.player or YOU, result, when, saved.outcome == "exit", saved)


def _row_of_recording(recording: Recording, when: str) -> ReplayRow:
    replay = recording.replay
    if replay.unclaimed:
        result = f"recording, {seconds_text(recording.ticks - 1)} s"
    else:
        result = result_of(replay.outcome, replay.gold, replay.final_tick, recording.level.gold)
    passed = replay.outcome == "exit"
    return ReplayRow(recording.name or "unnamed", author_name(recording.credit), result, when, passed, recording)


def result_of(outcome: str, gold: int, final_tick: int, all_gold: int = 0) -> str:
    """The time of a passed run; of any other one its outcome and time."""
    at_exit = "all gold" if gold == all_gold > 0 else f"{gold} gold" if gold else "exit"
    result = at_exit if outcome == "exit" else _OUTCOMES[outcome]
    return f"{result}, {seconds_text(final_tick + (outcome == 'running'))} s"


def watch_replays(app: App, replays: Iterable[Replay | None]) -> bool:
    """Watch replays of the records one after another, without deleted ones; whether there were any."""
    runs = [Recording(replay.level, replay) for replay in replays if replay is not None and replay.level is not None]
    if runs:
        app.push(ReplayScreen(app, runs))
    return bool(runs)


def watch_recording(app: App, recording: Recording) -> None:
    """Watch a recording from a file; a notice says why its level cannot be played."""
    try:
        app.push(ReplayScreen(app, [recording]))
    except LevelError as error:
        app.notify(f"{recording.name or 'The replay'} cannot be watched: {error.what}")


RECORD_ROW = 30
_SIDE, _SIDE_WIDTH = 528, 228


class RecordRow(NamedTuple):
    """A record in the list."""

    text: str
    score: str = ""  #: an episode's clock or a level's time; "": not passed
    replays: tuple[int, ...] = ()
    when: str = ""  #: the day of the run
    head: bool = False  #: whether it heads a group


class RecordsScreen(MenuScreen):
    """The player's bests, by episode and level; a click watches the run, and statistics stand beside the list."""

    title = "Records"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.rows: list[RecordRow] = []
        self.list = ListView(
            (44, 92, 468, 15 * RECORD_ROW), RECORD_ROW, self._draw_row, self._watch, selected=self._say, opens=True
        )
        self.list.empty = "No records yet. Pass a level and it shows up here"

    def build(self) -> Sequence[Widget]:
        self.rows = self._rows()
        self.list.fill(self.rows)
        return [self.list]

    def _rows(self) -> list[RecordRow]:
        records, catalogue = self.player.records, self.player.catalogue
        bests, marks = records.level_bests(), self.player.marks.all()

        def row(text: str, saved: SavedReplay) -> RecordRow:
            time = marks[saved.level].fastest if saved.level in marks else saved.final_tick
            return RecordRow(text, f"{seconds_text(time)} s", (saved.id,), saved.made_at[:10])

        rows = []
        listed = set()
        episodes = [(pack, episode) for pack in catalogue.packs() for episode in pack.episodes.values()]
        for pack, episode in episodes:
            best = records.episode_best(episode.key)
            text = f"{pack.key}{', e' if pack.key else 'E'}pisode {episode.code}: {episode.name}"
            clock = f"{seconds_text(best.score)} s left" if best else ""
            rows.append(RecordRow(text, clock, best.replays if best else (), head=True))
            for entry in episode.levels:
                listed.add(entry.digest)
                saved = bests.get(entry.digest)
                rows.append(row(entry.title, saved) if saved else RecordRow(entry.title))
        others = [saved for digest, saved in bests.items() if digest not in listed]
        if others:
            rows.append(RecordRow("Other levels", head=True))
        others.sort(key=lambda saved: saved.name.casefold())
        return rows + [row(saved.name or "unnamed", saved) for saved in others]

    def _say(self, index: int) -> None:
        row = self.rows[index]
        missing = "Not yet passed in one go" if row.head else "Not passed yet"
        self.list.hint = "Enter to watch, E to save as a text file" if row.replays else missing

    def _watch(self, index: int) -> None:
        watch_replays(self.app, [self.player.records.replay(number) for number in self.rows[index].replays])

    def handle(self, event: InputEvent) -> None:
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
                self.app.write_export(row.text, REPLAY_SUFFIX, write_replay(*replays))
        else:
            super().handle(event)

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        theme.text(surface, "Your best", 44, 68, size=14, bold=True)
        theme.text(surface, "What killed you", _SIDE, 68, size=14, bold=True)
        deaths = {killer: times for killer, times in self.player.statistics.deaths().items() if times}
        most = max(deaths.values(), default=1)
        if not deaths:
            theme.text(surface, "Nothing so far", _SIDE, 98, size=11, colour=palette.faint)
        for place, (killer, times) in enumerate(deaths.items()):
            y = 98 + 27 * place
            theme.text(surface, _NAMES.get(killer, killer.capitalize()), _SIDE, y, size=11)
            theme.text(surface, str(times), _SIDE + _SIDE_WIDTH, y, size=11, align="right")
            theme.canvas.fill_rect(surface, palette.panel, _SIDE, y + 15, _SIDE_WIDTH, 4, 2)
            theme.canvas.fill_rect(surface, palette.bad, _SIDE, y + 15, max(4, _SIDE_WIDTH * times / most), 4, 2)
        played = self.player.statistics.played()
        hours, minutes = divmod(played.ticks * TICK_MS // 60_000, 60)
        lines = (
            ("Tries", str(played.attempts)),
            ("Passes", str(played.passes)),
            ("Gold collected", str(played.gold)),
            ("Time played", (f"{hours} h " if hours else "") + f"{minutes} min"),
        )
        for place, (name, number) in enumerate(lines):
            y = 364 + 22 * place
            theme.text(surface, name, _SIDE, y, size=11, colour=palette.faint)
            theme.text(surface, number, _SIDE + _SIDE_WIDTH, y, size=11, align="right")

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
