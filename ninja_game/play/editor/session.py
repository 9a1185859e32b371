"""The state of the level editor: tools, file, recovery copy, findings, certificate and tests."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic

from ninja_game.editor import files
from ninja_game.editor.draft import Draft
from ninja_game.editor.playtests import PathPoints, TestMap, Try, drone_round, map_of, round_of, route_of
from ninja_game.editor.reach import STARTS, Ask, Reach, find_reach
from ninja_game.editor.solver import Certification, Certifier, search_of
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.reading import NO_FILE, file_stamp
from ninja_game.files.user_folder import LEVELS
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import Pack, is_pack
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import Replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import GAME, YOURS, Entry
from ninja_game.levels.findings import Finding
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_text, pasted_text
from ninja_game.play.window import save_picture
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Catalogue
from ninja_game.player.player_data import keep_replay
from ninja_game.runs.problems import level_problems
from ninja_game.runtime import NewestJob
from ninja_game.sim.grid import is_inside
from ninja_game.sim.kinds import DRONE, EXIT, NINJA
from ninja_game.sim.level import Level, ObjectSpec, well_formed
from ninja_game.ui.widgets import next_option
from ninja_game.view.sprites.thumbnail import thumbnail

LOOK_SPACING = 0.5  # seconds between two checks of the level's file

UNREACHABLE_CODES = "unreachable", "unreachable-switch"
"""Codes of the findings about places that the ninja cannot reach."""

CHECK_SPACING = 0.1  # least seconds between two examinations of the level
REST = 1.0  # seconds without a change after which a search begins again with the level as it is

LEVEL_PICTURE_WIDTH = 1584

_Question = tuple[Level, tuple[Finding, ...], str, bytes]
"""A level to examine, what the solver has found about it, its messages, and the inputs of its known run, if any."""
Examined = tuple[Level, list[Finding]]


def _examine(question: _Question) -> Examined:
    level, searched, says, inputs = question
    odd = level_problems(level, says, inputs)
    # An unreachable exit needs no finding of the solver too.
    out_of_reach = {number for finding in odd if finding.code in UNREACHABLE_CODES for number in finding.records}
    return level, [*(finding for finding in searched if not out_of_reach.intersection(finding.records)), *odd]


class EditorSession:
    """A level under edit, with its file, its tests, and the searches about it."""

    def __init__(self, app: App, source: files.Source | None = None) -> None:
        self.app = app
        self.certifier = Certifier(app.solver)
        self.tools = EditorTools(files.new_source().draft)
        self.tools.slopes = app.settings.slopes
        self._begin(source or files.new_source(app.settings.name, room=True))
        if source:
            self._recognise()

    def _begin(self, source: files.Source, draft: files.RecoveredDraft | None = None) -> None:
        self.autosave = files.Autosave(self.app.player.folder, draft.file if draft else None)
        self.source = draft.source if draft else source
        key = draft.file.stem if draft else source.digest
        self.tools.load(files.kept_history(self.app.player.folder, key, (draft or source).draft))
        self.accepted = dict[str, str]()  #: why its pack accepts findings about it, by code
        with suppress(NinjaGameError, OSError):
            path = self.source.path
            reasons = Pack(path.parent).index.reasons if path and is_pack(path.parent) else {}
            self.accepted = {code: why for (file, code), why in reasons.items() if path and file == path.name}
        self.certifier.edit(self.draft.level)
        self._objects = self.draft.objects
        # Running searches are about another level.
        self._checks = NewestJob(_examine)
        self._reaches = NewestJob(find_reach)
        self._maps = NewestJob(map_of)
        self._known_runs: NewestJob[tuple[Level, Replay], Certification] = NewestJob(lambda known: search_of(*known))
        self.rounds = NewestJob(round_of)
        self._drone: tuple[Level, ObjectSpec | None] | None = None
        self.start = "off"  #: the ninja's state at the pointer for the search of what it can reach, of STARTS
        self._start_asked: Ask | None = None
        self._tries: dict[Level, tuple[Try, ...]] = {}
        self._tried_level: Level | None = None
        self.tries: tuple[Try, ...] = ()  #: all tests of the level as it is
        self.last_try: PathPoints = ()  #: route of the last test
        self.last_death: PathPoints = ()  #: where the last of the tries died
        self._file_stamp, self._looked_at = NO_FILE, 0.0
        self._certified: tuple[object, ...] = ()
        self._resting = self.draft.level, 0.0  #: the level, and when it became that, s
        self._asked: _Question | None = None
        self._asked_at = 0.0

    def begin(self, source: files.Source, draft: files.RecoveredDraft | None = None) -> None:
        """Edit another level, or a recovered one; unsaved changes of the present one are discarded.

        Raises FileError for a level that another window has recovered.
        """
        before = self.autosave
        self._leave_search()
        self._begin(source, draft)
        before.close()
        self._recognise()

    def _recognise(self) -> None:
        """Use this level's certificate if there is one: beside its file, or of the same level elsewhere."""
        catalogue, level, path = self.app.player.catalogue, self.draft.level, self.source.path
        same = [alone] if (alone := self.entry) else []
        same += [item for item in catalogue.single_levels() if item.named.level == level]
        runs = ((item, run) for item in same if (run := catalogue.author_run(item)))
        entry, run = next(runs, (None, None))
        if run:
            self._known_runs.ask((level, run))
            if path and entry is same[0]:
                self._certified = run, run if run.gold >= level.gold else None, path

    @property
    def entry(self) -> Entry | None:
        """The level as an entry of the player's folder; None without a file."""
        path = self.source.path
        return Entry(NamedLevel(self.name, "", "", self.draft.level, str(path)), YOURS) if path else None

    def set_slopes(self, slopes: bool) -> None:
        """Switch automatic slopes on or off, in this editor and all later ones."""
        self.tools.slopes = slopes
        self.app.change_settings(slopes=slopes)

    @property
    def certifying_inputs(self) -> bytes:
        """The inputs of the run that certifies the level in its present state; none without such a run."""
        run = self.certifier.certification.run
        return run.inputs if run and not self.certifier.is_stale(self.draft.level) else b""

    @property
    def draft(self) -> Draft:
        return self.tools.draft

    @property
    def is_saved(self) -> bool:
        return self.draft == self.source.draft

    @property
    def name(self) -> str:
        return self.draft.name or (self.source.path.stem if self.source.path else "") or "New level"

    @property
    def findings(self) -> list[Finding]:
        """The findings of the last examination."""
        return self._checks.result[1] if self._checks.result else []

    @property
    def examined(self) -> Level | None:
        return self._checks.result[0] if self._checks.result else None

    @property
    def reach(self) -> Reach | None:
        """The reach of a ninja at the pointer, or at the pointer's last place."""
        return self._reaches.result if self.start != "off" else None

    def next_start(self) -> None:
        self.start = next_option(list(STARTS), self.start)
        self._start_asked = None

    def _follow_pointer(self) -> None:
        """Search the reach from the pointer; the earlier result stays until the new one is there."""
        speed = STARTS[self.start]
        if self._reaches.problem:
            self.app.notify(self._reaches.problem)
            self.start, self._reaches.problem = "off", ""
        elif speed is not None:
            ask, before = Ask(self.draft, self.tools.pointer, speed), self._start_asked
            if before is None or before.draft is not ask.draft or before[1:] != ask[1:]:
                self._start_asked = ask
                self._reaches.ask(ask)

    def _follow_drone(self) -> None:
        """Look for the round of the drone that is selected, or in hand over the level."""
        tools = self.tools
        in_hand = tools.draws_objects and not tools.selection and tools.effective_tool not in ("select", "pick")
        spec = tools.chosen or (tools.placed(*tools.pointer) if in_hand and is_inside(tools.cell) else None)
        now = self.draft.level, spec if spec and spec.kind == DRONE and well_formed(spec) else None
        if now != self._drone:
            self._drone, self.rounds.result = now, None
            if now[1]:
                self.rounds.ask(drone_round(self.draft, now[1]))

    @property
    def drone_round(self) -> PathPoints:
        return self.rounds.result or () if self._drone and self._drone[1] else ()

    def update(self) -> None:
        self._follow_pointer()
        self._follow_drone()
        if self.draft.level is not self._tried_level:
            self._show_tries()
        known, self._known_runs.result = self._known_runs.result, None
        if known and known.level == self.draft.level:
            self.certifier.adopt(known)
        self._search_again()
        if not self.certifier.is_busy:
            self.certify_file()
        self.autosave.poll(self.tools.history, self.source)
        if self.autosave.problem:
            self.app.notify(self.autosave.problem)
            self.autosave.problem = ""
        if self._checks.problem:
            self.app.notify(f"The level could not be examined: {self._checks.problem}")
            self._checks.problem = ""
        level, says, inputs = self.draft.level, self.draft.says, self.certifying_inputs
        obstacles = () if self.certifier.is_stale(level) else self.certifier.certification.obstacles
        before = self._asked
        news = before is None or level is not before[0] or obstacles is not before[1] or (says, inputs) != before[2:]
        due = news and monotonic() - self._asked_at >= CHECK_SPACING
        if due and not self.tools.is_dragging:
            self._asked, self._asked_at = (level, obstacles, says, inputs), monotonic()
            self._checks.ask(self._asked)
        if not self.tools.history.in_stroke and self.draft.objects is not self._objects:
            self._tell_of_exits()

    def _search_again(self) -> None:
        """A search under way follows the level: at once while it waits, else once nothing has changed for REST."""
        certifier, level = self.certifier, self.draft.level
        if level is not self._resting[0]:
            self._resting = level, monotonic()
        rests = not self.tools.history.in_stroke and (certifier.is_waiting or monotonic() - self._resting[1] >= REST)
        stale = rests and certifier.is_busy and certifier.is_stale(level)
        if stale and {NINJA, EXIT} <= {spec.kind for spec in level.objects}:
            certifier.start(level)

    def _tell_of_exits(self) -> None:
        """Say how to move the exit to a player who placed a second one."""
        before, now = ([spec.kind for spec in objects].count(EXIT) for objects in (self._objects, self.draft.objects))
        self._objects = self.draft.objects
        if now > max(1, before):
            self.app.notify(
                f"{now} exits now: each has its own switch, any open one ends the level. Undo takes it back"
            )

    def examine(self) -> list[Finding]:
        """The findings of the present level."""
        self._asked_at = 0.0
        self.update()
        self._checks.finish()
        return self.findings

    @property
    def certify_text(self) -> str:
        """What F7 does now."""
        certifier = self.certifier
        if not certifier.is_busy or certifier.is_stale(self.draft.level):
            return "Certify"
        return certifier.waited if certifier.is_compiling else f"Stop {certifier.waited}"[:9].strip()

    @property
    def test_map(self) -> TestMap | None:
        return self._maps.result if self.tries else None

    def changed_source(self) -> files.Source | None:
        """The level's file if another program has changed it. Raises NinjaGameError, OSError."""
        path, now = self.source.path, monotonic()
        if path is None or now - self._looked_at < LOOK_SPACING or self.tools.history.in_stroke:
            return None
        self._looked_at = now
        stamp, before = file_stamp(path), self._file_stamp
        self._file_stamp = stamp
        if stamp in (before, NO_FILE):
            return None
        source = files.open_source(path)
        return source if source.digest != self.source.digest else None

    def follow_move(self) -> None:
        """If the level's file was moved, as into a pack, go on with it there. Raises NinjaGameError, OSError."""
        path = self.source.path
        if path and not path.exists():
            paths = (Path(item.named.file) for item in self.app.player.catalogue.single_levels())
            sources = (files.open_source(file) for file in paths if file.name == path.name and file.is_file())
            self.source = next((source for source in sources if source.digest == self.source.digest), self.source)

    def take(self, source: files.Source) -> None:
        """Load the level from its changed file; this can be undone."""
        self.tools.finish()
        self.source = source
        self.tools.history.change(source.draft)

    @property
    def keeping(self) -> str:
        """What happens to the run that the solver has found, a sentence."""
        path = self.source.path
        if path and not self._keeps_runs(path):
            return "To keep it: File, Save the run that was found"
        return "Kept with the level" if path and self.is_saved else "Kept when the level is saved"

    def _keeps_runs(self, path: Path) -> bool:
        """Whether certificates are kept beside a file: in the player's folder of levels, and in packs."""
        return path.parent == self.app.player.folder / LEVELS or is_pack(path.parent)

    def certify_file(self) -> None:
        """Write the known runs beside the level's file if that holds their level: packs then need no other."""
        search, path = self.certifier.certification, self.source.path
        known = search.run, search.gold_run, path
        if path and self.certifying_inputs and known != self._certified and self.is_saved:
            self._certified = known
            self._keep(path, search)

    def _keep(self, path: Path, search: Certification, *, name: str = "") -> None:
        """Write the runs of a search beside a file with its level. ``name``: of a level left by now, for a notice."""
        from ninja_game.search.certificate import update_certificates

        which = f"{name}: " if name else ""
        try:
            named = self._file_now(path, search)
            if named is None and search.run:
                self.app.notify(f"{which}no certificate, as no file has the level any more. Open it, and press F7")
                return
            for run in filter(None, (search.run, search.gold_run)):
                if named and self._keeps_runs(Path(named.file)):
                    update_certificates(named, run)
        except (NinjaGameError, OSError) as error:
            self.app.notify(f"{which}no certificate: {reason(error)}")
        else:
            if name:
                end = f"no run in {search.seconds:.0f} s"
                if search.run:
                    end = f"certified, {seconds_text(search.run.end_tick)} s, kept with the level"
                self.app.notify(f"{name}: {end}")

    def _file_now(self, path: Path, search: Certification) -> NamedLevel | None:
        """The level of a search in its file, or in another of the player's files, as in a pack; None if it is gone."""
        with suppress(NinjaGameError, OSError):
            if (named := load_levels(path)[0]).level == search.level:
                return named
        # The window's catalogue is not thread-safe.
        own = (item.named for item in Catalogue(self.app.player.folder / LEVELS).single_levels() if item.source != GAME)
        return next((entry for entry in own if entry.level == search.level and Path(entry.file).is_file()), None)

    def _leave_search(self) -> None:
        """The level is closed: a search of the level in its file continues in the background, any other one ends."""
        path, level = self.source.path, self.source.draft.level
        files.keep_history(self.app.player.folder, self.source.digest, self.tools.history)
        if path and self._keeps_runs(path) and self.certifier.is_busy and not self.certifier.is_stale(level):
            self.certifier.leave(partial(self._keep, path, name=self.source.draft.name or path.stem))
        else:
            self.certifier.leave(None)
        self.certify_file()

    def close(self) -> None:
        self._leave_search()
        self.autosave.close()

    def end(self) -> None:
        self.tools.finish()

    def save(self, path: Path, *, replacing: bool = False, name: str | None = None) -> None:
        """Write the level; it gets another ``name`` only if that succeeds.

        Raises OccupiedError where that would replace a file that another program wrote, OSError.
        """
        self.tools.finish()
        named = self.draft if name is None else replace(self.draft, name=name)
        self.source = files.save(self.source, named, path, replacing=replacing)
        # The file has the new name, so undo keeps it.
        self.tools.history.amend(lambda draft: replace(draft, name=named.name))
        files.keep_history(self.app.player.folder, self.source.digest, self.tools.history)

    def export_picture(self) -> None:
        surface = thumbnail(self.draft.level, self.app.theme.palette, LEVEL_PICTURE_WIDTH)
        self.app.write_export(self.name, ".png", lambda path: save_picture(surface, path))

    def copy_string(self) -> None:
        """Copy the level as an in-game string of N into the clipboard, or into a file where there is none."""
        with self.app.noting("This level cannot be written as N level code: "):
            text = write_level_string(self.draft.level, exact=True)
            copy_text(self.app, text, title=self.name, suffix=".nlevel")

    def paste_string(self) -> None:
        """Replace the level by the one in the clipboard, in any format; this can be undone."""
        try:
            self.tools.finish()
            self.tools.history.change(files.draft_of_text(pasted_text(), self.draft))
            self.app.notify("The level of the clipboard; undo brings yours back")
        except NinjaGameError:
            self.app.notify("There is no level in the clipboard: copy its text first")

    def tried(self, level: Level, inputs: bytes, *, over: bool) -> None:
        """Show the route and death of a test that was left or is ``over``.

        A test that continues after that is the same one.
        """
        if not inputs:
            return
        tries = self._tries.get(self.draft.level, ())
        goes_on = tries and not tries[-1].over and tries[-1].level is level and inputs.startswith(tries[-1].inputs)
        self._tries[self.draft.level] = (*(tries[:-1] if goes_on else tries), Try(level, inputs, over))
        self.last_try = route_of(level, inputs)
        self._show_tries()

    def _show_tries(self) -> None:
        """Show only tests of the present version of the level: others may have met objects that are gone."""
        self._tried_level = self.draft.level
        self.tries = self._tries.get(self.draft.level, ())
        self.last_death = map_of(self.tries[-1:]).deaths
        if self.tries:
            self._maps.ask(self.tries)

    def passed(self, level: Level, attempt: Attempt) -> bool:
        """A test reached the exit; True if it certifies the present level: played from its start, in its time."""
        helped = attempt.assists - {"practice"} or attempt.lifetime <= attempt.ended_tick
        if helped or level != self.draft.level:
            return False
        replay = attempt.replay(self.name, self.app.settings.name)
        self.certifier.adopt(search_of(level, replace(replay, made=Provenance(played=True))))
        return True

    def keep_certificate(self) -> None:
        run = self.certifier.certification.run
        if run is None or self.certifier.is_stale(self.draft.level):
            self.app.notify("Certify the level first (F7)")
            return
        from ninja_game.search.certificate import named_replay

        replay = named_replay(run, "solve", name=self.name, author="solver", level_author=self.draft.author)
        self.app.notify(keep_replay(self.app.player, replay))
