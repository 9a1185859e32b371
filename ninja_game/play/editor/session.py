"""The state of the level editor: the level under edit, the tools, and the solver's work on it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic

from ninja_game.editor import files
from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import Examination, LevelQuestion
from ninja_game.editor.playtests import Playtest, Playtests
from ninja_game.editor.solver import Certification, Certifier, search_of
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.user_folder import LEVELS
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import is_pack
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import GAME, YOURS, Entry
from ninja_game.levels.findings import Finding
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_text, pasted_text
from ninja_game.play.editor.edited_level import EditedLevel
from ninja_game.play.editor.pointer_searches import PointerSearches
from ninja_game.play.window import save_picture
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Catalogue
from ninja_game.player.player_data import keep_replay
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import Level
from ninja_game.view.sprites.thumbnail import thumbnail

REST = 1.0  # seconds without a change after which a search begins again with the level as it is

LEVEL_PICTURE_WIDTH = 1584


class EditorSession:
    """The level under edit, with what stays when another one is opened: the tools and the certifier."""

    def __init__(self, app: App, source: files.Source | None = None) -> None:
        self.app = app
        self.certifier = Certifier(app.solver)
        self.edited = EditedLevel(app.player.folder, source or files.new_source(app.settings.name, room=True))
        self.tools = EditorTools(self.edited.draft)
        self.tools.brush.slopes = app.settings.slopes
        self._edit(self.edited)
        if source:
            self._recognise()

    def _edit(self, edited: EditedLevel) -> None:
        self.edited = edited
        self.tools.load(edited.history)
        self.certifier.edit(self.draft.level)

    def begin(self, source: files.Source, draft: files.RecoveredDraft | None = None) -> None:
        """Edit another level, or a recovered one; unsaved changes of the present one are discarded.

        Raises FileError for a level that another window has recovered.
        """
        before = self.edited
        self._leave_search()
        self._edit(EditedLevel(self.app.player.folder, source, draft))
        before.autosave.close()
        self._recognise()

    def _recognise(self) -> None:
        """Use this level's certificate if there is one: beside its file, or of the same level elsewhere."""
        catalogue, level, path = self.app.player.catalogue, self.draft.level, self.source.path
        same = [alone] if (alone := self.entry) else []
        same += [item for item in catalogue.single_levels() if item.named.level == level]
        runs = ((item, run) for item in same if (run := catalogue.author_run(item)))
        entry, run = next(runs, (None, None))
        if run:
            self.edited.known_runs.ask((level, run))
            if path and entry is same[0]:
                self.edited.kept_runs = run, run if run.gold >= level.gold else None, path

    @property
    def entry(self) -> Entry | None:
        """The level as an entry of the player's folder; None without a file."""
        path = self.source.path
        return Entry(NamedLevel(self.name, "", "", self.draft.level, str(path)), YOURS) if path else None

    def set_slopes(self, slopes: bool) -> None:
        """Switch automatic slopes on or off, in this editor and all later ones."""
        self.tools.brush.slopes = slopes
        self.app.change_settings(slopes=slopes)

    @property
    def certifying_inputs(self) -> bytes:
        """The inputs of the run that certifies the level in its present state; none without such a run."""
        run = self.certifier.certification.run
        return run.inputs if run and not self.certifier.is_stale(self.draft.level) else b""

    @property
    def source(self) -> files.Source:
        return self.edited.source

    @property
    def examination(self) -> Examination:
        return self.edited.examination

    @property
    def playtests(self) -> Playtests:
        return self.edited.playtests

    @property
    def at_pointer(self) -> PointerSearches:
        return self.edited.at_pointer

    @property
    def draft(self) -> Draft:
        return self.tools.draft

    @property
    def is_saved(self) -> bool:
        return self.draft == self.source.draft

    @property
    def name(self) -> str:
        return self.draft.name or (self.source.path.stem if self.source.path else "") or "New level"

    def update(self) -> None:
        edited = self.edited
        if problem := edited.at_pointer.follow(self.tools):
            self.app.notify(problem)
        edited.playtests.show(self.draft.level)
        known, edited.known_runs.result = edited.known_runs.result, None
        if known and known.level == self.draft.level:
            self.certifier.adopt(known)
        self._search_again()
        if not self.certifier.is_busy:
            self.certify_file()
        edited.autosave.poll(edited.history, edited.source)
        if edited.autosave.problem:
            self.app.notify(edited.autosave.problem)
            edited.autosave.problem = ""
        checks = edited.examination.job
        if checks.problem:
            self.app.notify(f"The level could not be examined: {checks.problem}")
            checks.problem = ""
        self._examine()
        if not edited.history.in_stroke and self.draft.objects is not edited.objects:
            self._tell_of_exits()

    def _examine(self, *, at_once: bool = False) -> None:
        level, certifier = self.draft.level, self.certifier
        obstacles = () if certifier.is_stale(level) else certifier.certification.obstacles
        if not self.tools.is_dragging:
            question = LevelQuestion(level, obstacles, self.draft.says, self.certifying_inputs)
            self.examination.follow(question, at_once=at_once)

    def _search_again(self) -> None:
        """A search under way follows the level: at once while it waits, else once nothing has changed for REST."""
        edited, certifier, level = self.edited, self.certifier, self.draft.level
        if level is not edited.unchanged:
            edited.unchanged, edited.unchanged_since = level, monotonic()
        due = certifier.is_waiting or monotonic() - edited.unchanged_since >= REST
        rests = due and not edited.history.in_stroke
        stale = rests and certifier.is_busy and certifier.is_stale(level)
        if stale and {NINJA, EXIT} <= {spec.kind for spec in level.objects}:
            certifier.start(level)

    def _tell_of_exits(self) -> None:
        """Say how to move the exit to a player who placed a second one."""
        objects = self.edited.objects, self.draft.objects
        before, now = ([spec.kind for spec in specs].count(EXIT) for specs in objects)
        self.edited.objects = self.draft.objects
        if now > max(1, before):
            self.app.notify(
                f"{now} exits now: each has its own switch, any open one ends the level. Undo takes it back"
            )

    def examine(self) -> list[Finding]:
        """The findings of the present level."""
        self.update()
        self._examine(at_once=True)
        self.examination.job.finish()
        return self.examination.findings

    @property
    def certify_text(self) -> str:
        """What F7 does now."""
        certifier = self.certifier
        if not certifier.is_busy or certifier.is_stale(self.draft.level):
            return "Certify"
        return certifier.waited if certifier.is_compiling else f"Stop {certifier.waited}"[:9].strip()

    def follow_move(self) -> None:
        """If the level's file was moved, as into a pack, go on with it there. Raises NinjaGameError, OSError."""
        path = self.source.path
        if path and not path.exists():
            paths = (Path(item.named.file) for item in self.app.player.catalogue.single_levels())
            sources = (files.open_source(file) for file in paths if file.name == path.name and file.is_file())
            same = (source for source in sources if source.digest == self.source.digest)
            self.edited.source = next(same, self.source)

    def take(self, source: files.Source) -> None:
        """Load the level from its changed file; this can be undone."""
        self.tools.finish()
        self.edited.source = source
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
        if path and self.certifying_inputs and known != self.edited.kept_runs and self.is_saved:
            self.edited.kept_runs = known
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
        self.edited.autosave.close()

    def end(self) -> None:
        self.tools.finish()

    def save(self, path: Path, *, replacing: bool = False, name: str | None = None) -> None:
        """Write the level; it gets another ``name`` only if that succeeds.

        Raises OccupiedError where that would replace a file that another program wrote, OSError.
        """
        self.tools.finish()
        named = self.draft if name is None else replace(self.draft, name=name)
        self.edited.source = files.save(self.source, named, path, replacing=replacing)
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

    def add_playtest(self, level: Level, inputs: bytes, *, over: bool) -> None:
        """Show the route and death of a playtest that was left or is ``over``."""
        if inputs:
            self.playtests.add(self.draft.level, Playtest(level, inputs, over))

    def passed(self, level: Level, attempt: Attempt) -> bool:
        """A playtest reached the exit; True if it certifies the present level: played from its start, in its time."""
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
