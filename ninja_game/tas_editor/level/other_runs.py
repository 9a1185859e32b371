"""Other runs of the same level beside the one under edit: to open, to choose, and to copy from."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from time import thread_time

from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import NinjaGameError, ReplayError
from ninja_game.files.bundled import bundled_replays
from ninja_game.files.reading import SUFFIXES, Skipped, files_in
from ninja_game.files.shown_text import unused_name
from ninja_game.formats.links import is_link
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.play.app import WARNING_MS, App
from ninja_game.play.menu_screen import Action, MenuScreen
from ninja_game.play.panels.files import FilesScreen
from ninja_game.play.panels.replays import FILES_SHOWN, ReplayRow, ReplaysScreen, result_of
from ninja_game.play.workspace import Commands
from ninja_game.player.records import SavedReplay
from ninja_game.runs.compare import nearest_state
from ninja_game.runs.run import run_level
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.files import runs_of_level, same_level, same_place, track_of
from ninja_game.tas.timeline import Timeline, difference_text
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import OtherRun, TasEditor
from ninja_game.tas_editor.tabs.tab import EntryField
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.widgets import Button, Widget

QUICK = RUN_BUDGET // 100  # work that a run may cost in a list: 30 ms compiled, enough for a run of some ten minutes
LOOK_SECONDS = 0.3  # processor time for looking into the files of a folder
NONE_YET = "No other run is open: Ctrl+O opens one"


class OtherRuns:
    """The commands about runs shown beside the one under edit: open, choose, and copy a part of one into it."""

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor

    def commands(self) -> Commands:
        return {
            "open_other": lambda: self.editor.app.push(OtherRunScreen(self.editor.app, self)),
            "next_other": self.next,
            "splice": self.splice,
            "splice_here": self.splice_here,
            "splice_start": self.splice_start,
        }

    def open(self, recordings: Sequence[Recording]) -> None:
        """Show recordings beside the run, the first chosen. Raises ReplayError for another level or another body."""
        editor = self.editor
        first = len(editor.others)
        for recording in recordings:
            editor.show_beside(other_run(editor, recording))
            editor.chosen = first

    @property
    def chosen(self) -> OtherRun | None:
        """The run to copy from; a notice without one."""
        if not self.editor.others:
            self.editor.app.notify(NONE_YET)
        return self.editor.beside

    def next(self) -> None:
        editor = self.editor
        if self.chosen is not None:
            editor.chosen = (editor.chosen + 1) % len(editor.others)
            editor.app.notify(f"Compared, and parts are taken from: {editor.others[editor.chosen].name}")

    def splice(self) -> None:
        """Copy the keys of the selected ticks from the same ticks of the other run; all other ticks keep theirs."""
        other = self.chosen
        if other is not None:
            first, last = self.editor.selection
            keys = [other.track.keys_at(tick) for tick in range(first, last)]
            if self.editor.edit_selected(lambda track: track.replaced(first, last, keys), other.made):
                self.editor.app.notify(f"Ticks {first} to {last - 1} are those of {other.name}")

    def splice_here(self) -> None:
        """Replace all ticks from the cursor on by the other run's, from the tick where its ninja was nearest to ours.

        All runs begin alike: in tick 0 it is the other one's tick 0.
        """
        other, tick = self.chosen, self.editor.cursor
        if other is not None and tick <= self.editor.session.timeline.simulated_until:
            theirs = self._nearest(other, tick)
            keys = [other.track.keys_at(k) for k in range(theirs, len(other.track))]
            what = f"From tick {tick} on {other.name} from its tick {theirs} on"
            self._join(lambda track: track.replaced(tick, max(tick, len(track)), keys), other, tick, theirs, what, tick)

    def splice_start(self) -> None:
        """Replace all ticks before the cursor by the other run's, up to where its ninja was nearest to ours."""
        editor, other, tick = self.editor, self.chosen, self.editor.cursor
        if other is not None and not tick:
            editor.app.notify("No tick is before this one: go to where your own run goes on")
        elif other is not None and tick <= editor.session.timeline.simulated_until:
            theirs = self._nearest(other, tick)
            keys = [other.track.keys_at(k) for k in range(theirs)]
            what = f"Up to tick {theirs - 1} {other.name}, then this run from its tick {tick} on"
            self._join(lambda track: track.replaced(0, tick, keys), other, tick, theirs, what, theirs)

    def _nearest(self, other: OtherRun, tick: int) -> int:
        return nearest_state(self.editor.session.timeline.trajectory().positions, tick, other.trajectory.positions)

    def _join(
        self, make: Callable[[InputTrack], InputTrack], other: OtherRun, tick: int, theirs: int, what: str, at: int
    ) -> None:
        """Make an edit that joins two runs, before ``tick`` of ours and ``theirs`` of the other one; tell the gap.

        ``at``: the joint in the new run; up to a death behind it the ticks are selected, to be searched.
        """
        editor, timeline = self.editor, self.editor.session.timeline
        gap = "its start"
        if tick:
            beside = Timeline(timeline.level, other.track.inputs[:theirs], body=timeline.body, memory=timeline.memory)
            beside.ensure(theirs - 1)
            gap = difference_text(timeline.world(tick - 1), beside.world(theirs - 1))
        if editor.edit_selected(make, other.made):
            timeline.simulate(len(timeline))
            end, outcome = timeline.end
            editor.go(at)
            now = timeline.ending() or "no exit yet"
            if outcome == "dead" and end >= at:
                editor.select(at, end + 1)
                now += "; F searches other keys up to there"
            editor.app.notify(f"{what}, {gap}. Now: {now}", ms=WARNING_MS)


def other_run(editor: TasEditor, recording: Recording) -> OtherRun:
    """A recording as another run. Raises ReplayError for another level, or another body."""
    origin = editor.session.origin
    if not same_level(recording, origin):
        what = "body" if recording.body != origin.body else "level"
        raise ReplayError(f"{recording.name or 'this run'} is a run with another {what} than the one in the TAS editor")
    name = _free_name(recording, origin, {other.name for other in editor.others})
    return editor.other_run(name, track_of(recording), Contributions.of(recording))


def _free_name(recording: Recording, origin: Recording, taken: set[str]) -> str:
    """A unique name: its author, or its file and number, or its name."""
    # Records of N are often many by one author: their files and numbers tell them apart.
    name = recording.whose if recording.player != origin.author else recording.place or recording.name
    return unused_name(name or "another run", taken)


class OtherRunScreen(ReplaysScreen):
    """The replays of the level in the TAS editor; the chosen one is shown beside the run."""

    title = "Another run of this level"
    heads = "Run", "Player", "Result", "From"
    empty = "No other run of this level is known. There may be one in a file"
    hint = "Enter shows it beside the run"

    def __init__(self, app: App, others: OtherRuns) -> None:
        self.others = others
        self._origin = others.editor.session.at_home
        self._digest = level_digest(self._origin.level)
        super().__init__(app)

    def build(self) -> Sequence[Widget]:
        return [*super().build(), Button((538, 15, 134, 26), "From a file ...", self._ask, hint="Any file with runs")]

    def arranged(self, rows: list[ReplayRow]) -> list[ReplayRow]:
        """The replays of the same level, fastest first, those without an exit last."""
        fitting = [row for row in rows if isinstance(row.source, Recording) or row.source.level == self._digest]
        return sorted(fitting, key=lambda row: (not row.good, _ticks(row)))

    def _file_rows(self) -> Iterator[list[ReplayRow]]:
        for rows in super()._file_rows():
            yield list(map(_named, rows))

    def places(self) -> list[tuple[str, Iterable[Path | Skipped]]]:
        """The file of the run and those beside it, too."""
        file = Path(self._origin.file)
        names = [name for name in files_in(file.parent) if name.lower().endswith(SUFFIXES)] if file.is_file() else []
        siblings = [file.parent / name for name in sorted(names, key=lambda name: name != file.name)]
        return [("Same folder", siblings[:FILES_SHOWN]), *super().places()]

    def bundled(self) -> list[Path]:
        """All bundled replays: an editor of runs needs no protection from solutions."""
        return bundled_replays()

    def lists(self, recording: Recording) -> bool:
        return level_digest(recording.level) == self._digest and not same_place(recording, self._origin)

    def handle(self, event: InputEvent) -> None:
        MenuScreen.handle(self, event)

    def act(self, action: str, *, held: bool = False) -> None:
        MenuScreen.act(self, action, held=held)

    def _ask(self) -> None:
        self.app.push(RunFiles(self.app, self.others, self.app.pop))

    def choose(self, source: SavedReplay | Recording) -> None:
        if not isinstance(source, Recording):
            replay = self.player.records.replay(source.id)
            if replay is None or replay.level is None:
                self.app.notify("This replay is not there any more")
                return
            source = Recording(replay.level, replay)
        recording = source
        if self.others.editor.attempt(lambda: self.others.open([recording])):
            self.app.pop()


class RunFiles(FilesScreen):
    """The folders and files beside the file of the run, then elsewhere: those with runs of its level.

    ``done``: called once a file's runs are shown.
    """

    foot = "Enter opens a folder, or shows the runs of a file; Esc goes back"
    suffixes = SUFFIXES

    def __init__(self, app: App, others: OtherRuns, done: Action) -> None:
        self.others, self._done = others, done
        self._origin = others.editor.session.at_home
        file = Path(self._origin.file)
        super().__init__(app, file.absolute().parent if file.is_file() else Path.cwd(), top=104)
        self.field = EntryField("Path or link", lambda: self.open_path(self.field.text), longest=2000)
        self.field.area = 44, 62, 712, 28

    def build(self) -> Sequence[Widget]:
        return [self.field, *super().build()]

    def fitting(self, names: Sequence[str]) -> list[Path]:
        """The files with runs of the level; files that would take long to read are kept too."""
        end = thread_time() + LOOK_SECONDS
        return [path for path in super().fitting(names) if thread_time() > end or self._has_runs(path)]

    def _has_runs(self, file: Path) -> bool:
        try:
            return bool(runs_of_level(file, self._origin))
        except (NinjaGameError, OSError):
            return False

    def open_path(self, text: str) -> None:
        """Show the runs of a file or a link, or the contents of a folder; a path may be relative to that shown."""
        path = Path(text if is_link(text) else self.folder / os.path.expanduser(text))  # noqa: PTH111 - fails on none
        if not is_link(path) and os.path.isdir(path):  # noqa: PTH112 - likewise
            self.open_folder(path.resolve())
        else:
            self.open_file(path)

    def open_file(self, path: Path) -> None:
        if self.others.editor.attempt(lambda: self.others.open(runs_of_level(path, self._origin))):
            self.app.pop()
            self._done()


def _named(row: ReplayRow) -> ReplayRow:
    """A file's run under the file's name; a run without claims is run to its end, if that is quick."""
    source = row.source
    if not isinstance(source, Recording):
        return row
    if source.replay.unclaimed:
        with suppress(NinjaGameError):
            run = run_level(source.level, source.inputs, body=source.body, budget=QUICK)
            result = result_of(run.outcome, run.gold, run.ticks - 1, source.level.gold)
            row = row._replace(result=result, good=run.outcome == "exit")
    return row._replace(text=f"{source.place}   {source.comment}".rstrip())


def _ticks(row: ReplayRow) -> int:
    return row.source.ticks if isinstance(row.source, Recording) else row.source.final_tick + 1
