"""The state of the level editor: the level under edit, the tools, and the solver's work on it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from time import monotonic

from ninja_game.editor import files
from ninja_game.editor.certificates import CertificateKeeper
from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import LevelQuestion
from ninja_game.editor.playtests import Playtest
from ninja_game.editor.solver import Certifier, search_of
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import NinjaGameError
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.levels.episodes import YOURS, Entry
from ninja_game.levels.findings import Finding
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_text, pasted_text
from ninja_game.play.editor.edited_level import EditedLevel
from ninja_game.play.window import save_picture
from ninja_game.player.attempt import Attempt
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
        self.certificates = CertificateKeeper(self.app.player.folder, self.app.notify)
        self.tools.load(edited.history)
        self.certifier.edit(self.draft.level)

    def begin(self, source: files.Source, draft: files.RecoveredDraft | None = None) -> None:
        """Edit another level, or a recovered one; unsaved changes of the present one are discarded.

        Raises FileError for a level that another window has recovered.
        """
        before = self.edited
        self._leave_search()
        self._edit(EditedLevel(self.app.player.folder, source, draft))
        before.close()
        self._recognise()

    def _recognise(self) -> None:
        """Use this level's certificate if there is one."""
        level = self.draft.level
        run = self.certificates.known_run(self.app.player.catalogue, level, self.entry)
        if run:
            self.edited.known_runs.ask((level, run))

    @property
    def entry(self) -> Entry | None:
        """The level as an entry of the player's folder; None without a file."""
        path = self.edited.source.path
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
    def draft(self) -> Draft:
        return self.tools.draft

    @property
    def is_saved(self) -> bool:
        return self.draft == self.edited.source.draft

    @property
    def name(self) -> str:
        return self.draft.name or (self.edited.source.path.stem if self.edited.source.path else "") or "New level"

    def update(self) -> None:
        edited = self.edited
        problem = edited.at_pointer.follow(self.tools)
        if problem:
            self.app.notify(problem)
        edited.playtests.show(self.draft.level)
        known = edited.known_runs.result
        edited.known_runs.result = None
        if known and known.level == self.draft.level:
            self.certifier.adopt(known)
        self._search_again()
        if not self.certifier.is_busy:
            self.certify_file()
        for problem in edited.follow():
            self.app.notify(problem)
        self._examine()
        if not edited.history.in_stroke and self.draft.objects is not edited.objects:
            self._tell_of_exits()

    def _examine(self, *, at_once: bool = False) -> None:
        level, certifier = self.draft.level, self.certifier
        obstacles = () if certifier.is_stale(level) else certifier.certification.obstacles
        if not self.tools.is_dragging:
            question = LevelQuestion(level, obstacles, self.draft.says, self.certifying_inputs)
            self.edited.examination.follow(question, at_once=at_once)

    def _search_again(self) -> None:
        """A search under way follows the level: at once while it waits, else once nothing has changed for REST."""
        edited, certifier, level = self.edited, self.certifier, self.draft.level
        if level is not edited.unchanged:
            edited.unchanged = level
            edited.unchanged_since = monotonic()
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
        self.edited.examination.job.finish()
        return self.edited.examination.findings

    @property
    def certify_text(self) -> str:
        """What F7 does now."""
        certifier = self.certifier
        if not certifier.is_busy or certifier.is_stale(self.draft.level):
            return "Certify"
        return certifier.waited if certifier.is_compiling else f"Stop {certifier.waited}"[:9].strip()

    def follow_move(self) -> None:
        """If the level's file was moved, as into a pack, go on with it there. Raises NinjaGameError, OSError."""
        path = self.edited.source.path
        if path and not path.exists():
            paths = (Path(item.named.file) for item in self.app.player.catalogue.single_levels())
            sources = (files.open_source(file) for file in paths if file.name == path.name and file.is_file())
            same = (source for source in sources if source.digest == self.edited.source.digest)
            self.edited.source = next(same, self.edited.source)

    def take(self, source: files.Source) -> None:
        """Load the level from its changed file; this can be undone."""
        self.tools.finish()
        self.edited.source = source
        self.tools.history.change(source.draft)

    @property
    def keeping(self) -> str:
        """What happens to the run that was found, a sentence."""
        return self.certificates.text(self.edited.source.path, is_saved=self.is_saved)

    def certify_file(self) -> None:
        """Write the known runs beside the level's file if that holds their level: packs then need no other."""
        path = self.edited.source.path
        if path and self.certifying_inputs and self.is_saved:
            self.certificates.keep(path, self.certifier.certification)

    def _leave_search(self) -> None:
        """The level is closed: a search of the level in its file continues in the background, any other one ends."""
        source, certifier = self.edited.source, self.certifier
        self.edited.keep_history()
        searches = certifier.is_busy and not certifier.is_stale(source.draft.level)
        if source.path and searches and self.certificates.keeps_beside(source.path):
            certifier.leave(self.certificates.keeping(source.path, source.draft.name or source.path.stem))
        else:
            certifier.leave(None)
        self.certify_file()

    def close(self) -> None:
        self._leave_search()
        self.edited.close()

    def leave(self) -> None:
        """The editor is left for now: keep all that is known."""
        self.certify_file()
        self.edited.flush()

    def end(self) -> None:
        self.tools.finish()

    def save(self, path: Path, *, replacing: bool = False, name: str | None = None) -> None:
        """Write the level; it gets another ``name`` only if that succeeds.

        Raises OccupiedError where that would replace a file that another program wrote, OSError.
        """
        self.tools.finish()
        named = self.draft if name is None else replace(self.draft, name=name)
        self.edited.source = files.save(self.edited.source, named, path, replacing=replacing)
        # The file has the new name, so undo keeps it.
        self.tools.history.amend(lambda draft: replace(draft, name=named.name))
        self.edited.keep_history()

    def export_picture(self) -> None:
        surface = thumbnail(self.draft.level, self.app.theme.palette, LEVEL_PICTURE_WIDTH)
        self.app.write_export(self.name, ".png", lambda path: save_picture(surface, path))

    def copy_string(self) -> None:
        """Copy the level as an in-game string of N into the clipboard, or into a file where there is none."""
        with self.app.errors_as_notices("This level cannot be written as N level code: "):
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
            self.edited.playtests.add(self.draft.level, Playtest(level, inputs, over))

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
