"""The TAS editor in the window: its parts, and a run in them; the lines above and below."""

from __future__ import annotations

import gc
import re
from collections.abc import Sequence
from pathlib import Path

import pygame

from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.recording import Recording
from ninja_game.formats.run_time import seconds_text
from ninja_game.play.app import App
from ninja_game.play.workspace import Commands, WorkspaceScreen
from ninja_game.tas.files import OpenedRun, new_run, same_level
from ninja_game.tas.journal import RecoveredRun
from ninja_game.tas.session import TasSession
from ninja_game.tas_editor.commands import TAS_COMMANDS, RunCommands
from ninja_game.tas_editor.editor import Splitters, TasEditor, TasPart
from ninja_game.tas_editor.level.part import LevelPart
from ninja_game.tas_editor.roll.commands import first_change
from ninja_game.tas_editor.roll.part import Roll
from ninja_game.tas_editor.tabs.branches_tab import BranchesTab
from ninja_game.tas_editor.tabs.lead_tab import LeadTab
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from ninja_game.tas_editor.tabs.tab import Tab, TabStrip
from ninja_game.tas_editor.tabs.text_tab import TextTab
from ninja_game.tas_editor.tabs.values_tab import ValuesTab
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.theme import Theme


class TasScreen(WorkspaceScreen):
    """The screen for editing a run. ``editor``: cursor, selection, layout; ``session``: the run.

    ``others``: other runs of its level; ``recovered_run``: unsaved work of the last time. Raises LevelError for a run
    on a level that cannot be played, ReplayError for another run on another level or with another body, FileError for
    a run that another window has recovered.
    """

    table = TAS_COMMANDS
    small_notices = True

    def __init__(
        self, app: App, opened: OpenedRun, others: Sequence[Recording] = (), recovered_run: RecoveredRun | None = None
    ) -> None:
        super().__init__(app)
        self.session = TasSession(opened, app.player.folder, player=app.settings.name)
        if recovered_run is not None:
            self.session.recover(recovered_run)
        self.editor = TasEditor(app, self.session)
        values = ValuesTab(self.editor)
        self.tabs: list[Tab] = [values, *(tab(self.editor) for tab in (BranchesTab, LeadTab, SearchTab, TextTab))]
        self.level, self.roll = LevelPart(self.editor, values.ask), Roll(self.editor)
        self.strip = TabStrip(self.editor, self.tabs, self.level.picture.overlays)
        self.head, self.foot_line = Head(self.editor), Foot(self.editor)
        self.files = RunCommands(app, self.editor, self.run, self._recover, self._begin_new)
        self.level.others.open(others)
        if recovered_run is not None:
            for run in recovered_run.beside:
                self.editor.others.append(self.editor.other_run(run.name, run.track, run.made))
            tracks = (recovered_run.opened.track, *recovered_run.tracks)[-2:]
            self.editor.go(first_change(tracks[0], tracks[-1]))
        placed = [self.head, self.level, self.roll, self.foot_line, self.strip, *self.tabs]
        self.splitters = Splitters(self.editor, placed)
        self._entered = recovered_run is not None

    @property
    def tab(self) -> Tab:
        return self.strip.shown

    @property
    def parts(self) -> Sequence[TasPart]:
        return [self.head, self.level, self.roll, self.tab, self.strip, self.foot_line, self.splitters]

    @property
    def theme(self) -> Theme:
        """The TAS editor's own theme: a larger window has room for more, while other screens become larger."""
        if self.splitters.fit():
            self.redraw = True
        return self.editor.theme

    @property
    def notice_room(self) -> tuple[float, float]:
        return 0.0, self.splitters.layout.roll[0]  # not over its rows

    @property
    def foot_height(self) -> float:  # type: ignore[override]
        """Notices lie over the floor of the level, not over the tabs and the status."""
        layout = self.splitters.layout
        return layout.size[1] - layout.level[1] - layout.level[3]

    def commands(self) -> Commands:
        own = dict(self.files.commands())
        for part in (*self.parts, *self.tabs):
            own.update(part.commands())
        return own

    def run(self, name: str) -> None:
        self.commands()[name]()

    def hint(self, text: str) -> None:
        self.editor.hint = text

    def _begin_new(self) -> None:
        """Open an empty run of the level over this one."""
        origin = self.session.origin
        on = NamedLevel(origin.replay.level_name or origin.name, origin.level_author, "", origin.level, origin.file)
        self.app.push(TasScreen(self.app, new_run(on, body=origin.body)))

    def _recover(self, run: RecoveredRun) -> None:
        screen = TasScreen(self.app, run.opened, recovered_run=run)
        if same_level(run.opened.recording, self.session.origin):
            tracks = {other.track for other in screen.editor.others}
            for other in self.editor.others:
                if other.track not in tracks:
                    screen.editor.show_beside(other)
        self.app.replace(screen)

    def enter(self) -> None:
        self.editor.theme = self.theme  # all parts are placed before the first of them reads its area
        super().enter()
        # Exclude present objects (compiled code has many) from garbage collection: that took 80 ms.
        gc.freeze()
        self._garbage = gc.get_threshold()
        gc.set_threshold(20_000)  # a path is a list of thousands of points, which would be searched several times
        if not self._entered:
            self._entered = True
            self.files.offer_recovered()

    def leave(self) -> None:
        super().leave()
        gc.unfreeze()
        gc.set_threshold(*self._garbage)
        self.level.stop()
        self.session.end()
        if self not in self.app.stack:
            for tab in self.tabs:
                tab.close()
            self.session.close(keep=True)  # unsaved work is offered again

    def meaning(self, event: InputEvent) -> str:
        return self.level.meaning(event)

    def capture(self, event: InputEvent) -> bool:
        """During play by hand the game's keys go to the ninja; Escape ends a visible search."""
        if self.level.capture(event):
            self.held.follow(event.raw)
            return True
        hides = self.level.take_over.on and "boss" in event.pressed
        is_used = not hides and super().capture(event)
        escape = event.source == ("keys", "escape")
        if is_used and escape:
            self.tab.left()
        return is_used or (escape and not hides and self.tab.stop())

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        if not self.level.take_over.on:
            self.session.timeline.simulate(self.session.ticks_per_frame)
        for part in (self.level, self.roll, *self.tabs):
            part.update(real_ms)
        self.editor.preview = self.tab.preview
        self.follow_parts()


class Head(TasPart):
    """The line above the level: the file, its players, the end of the run, and whether all is saved."""

    slot = "head"

    def render_key(self) -> tuple[object, ...]:
        session = self.editor.session
        run = session.origin.replay.credit, session.timeline.end
        return *run, session.file.path, session.is_run_saved, session.is_saved, session.journal.problem

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        session, palette = self.editor.session, theme.palette
        right = self.area[2] - 8
        theme.canvas.fill_rect(surface, palette.tile, *self.area)
        end = session.timeline.end[0]
        opened = Path(session.origin.file).name
        level_note = ", on another level" if session.moved else ""
        unsaved = f"{opened}{level_note}, to be saved as a new file" if opened else "no file yet"
        file = session.file.path.name if session.file.path else unsaved
        origin, replay = session.origin, session.origin.replay
        how, width = f" {replay.how}".rstrip(), right / 2 - 62
        begun_by = replay.made.begun_by if replay.co_authors else ""
        names = filter(None, dict.fromkeys((replay.author, begun_by, *replay.co_authors)))
        credit = ", ".join(re.sub(r"^unknown \((.*)\)$", r"\1", name) for name in names)
        name = " - ".join(filter(None, (origin.name, credit)))
        name = theme.fit(name, width - theme.width(how, 13, bold=True), 13, bold=True) + how
        title = theme.text(surface, name, 8, 6, size=13, bold=True, colour=palette.on_tile, width=width)
        x = title.right / theme.canvas.scale + 12
        saved = ", not saved"
        if session.is_run_saved:
            rest = "branches" if len(session.branches) else "watched values"
            unsaved_note = "" if session.is_saved else f", not its {rest}"
            saved = f", saved{unsaved_note}" if session.file.path else unsaved_note
        state = session.journal.problem or file + saved
        seconds = f", {seconds_text(end)} s" if end >= 0 else ""
        words = (session.timeline.ending() or "no exit yet") + seconds
        ends = theme.text(surface, words, right, 8, size=11, bold=True, colour=palette.on_tile, align="right")
        width = ends.left / theme.canvas.scale - 12 - x
        theme.text(surface, state, x, 9, size=9.5, colour=palette.on_tile, width=width)


class Foot(TasPart):
    """The line below the level: the cursor's tick, the selection, the run beside, and a hint."""

    slot = "foot"

    def render_key(self) -> tuple[object, ...]:
        editor = self.editor
        other_run = editor.chosen, len(editor.others), editor.ghosts
        run = len(editor.track), editor.session.timeline.simulated_until
        return editor.cursor, editor.selection, run, editor.hint, other_run

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        editor, palette, (_, y, w, _) = self.editor, theme.palette, self.area
        theme.canvas.fill_rect(surface, palette.tile, *self.area)
        first, last = editor.selection
        selected = f", {last - first} selected" if last - first > 1 else ""
        timeline = editor.session.timeline
        progress = "" if timeline.is_complete else f", simulated up to {timeline.simulated_until}"
        other = editor.beside if editor.ghosts else None
        other_note = f", beside {theme.fit(other.name, 110, 9.5)}" if other else ""
        behind = ", behind the run's" if editor.cursor >= len(editor.track) else " of"
        text = f"tick {editor.cursor}{behind} {len(editor.track)}{selected}{progress}{other_note}"
        theme.text(surface, text, 8, y + 5, size=9.5, colour=palette.on_tile)
        hint = editor.hint or "Click L R J to change keys; Enter: take over; F: search; F1: help"
        width = w - 28 - theme.width(text, 9.5)
        theme.text(surface, hint, w - 8, y + 5, size=9.5, colour=palette.on_tile, align="right", width=width)
