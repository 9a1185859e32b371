"""One level under edit with all that is known about it."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from time import monotonic

from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import Examination
from ninja_game.editor.files import Autosave, RecoveredDraft, Source, keep_history, kept_history, open_source
from ninja_game.editor.playtests import Playtests
from ninja_game.editor.solver import Certification, search_of
from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import NO_FILE, file_stamp
from ninja_game.formats.pack.pack import Pack, is_pack
from ninja_game.formats.replay.text import Replay
from ninja_game.play.editor.pointer_searches import PointerSearches
from ninja_game.runtime import NewestJob
from ninja_game.sim.level import Level

LOOK_SPACING = 0.5  # seconds between two checks of the level's file


class EditedLevel:
    """A level under edit: its file, history, findings, playtests and searches. Another level is another object.

    ``folder``: the player's. Raises FileError for a level that another window has recovered.
    """

    def __init__(self, folder: Path, source: Source, recovered: RecoveredDraft | None = None) -> None:
        self._folder = folder
        self.autosave = Autosave(folder, recovered.file if recovered else None)
        self.source = recovered.source if recovered else source
        key = recovered.file.stem if recovered else source.digest
        self.history = kept_history(folder, key, (recovered or source).draft)
        self.accepted = _accepted(self.source.path)  #: why its pack accepts findings about it, by code
        self.examination = Examination()
        self.playtests = Playtests()
        self.at_pointer = PointerSearches()
        self.known_runs = NewestJob(_search_of_known)  #: plays a run that may certify the level
        self.unchanged, self.unchanged_since = self.draft.level, 0.0  #: the level of the last update; since when, s
        self.objects = self.draft.objects  #: those after the last stroke
        self.looked_at = 0.0  #: when the file was checked for changes, s
        self._stamp = NO_FILE

    @property
    def draft(self) -> Draft:
        return self.history.draft

    def follow(self) -> list[str]:
        """Keep the draft safe if it is time; gives what has failed since the last call, here or in the examination."""
        self.autosave.poll(self.history, self.source)
        checks = self.examination.job
        failed = [self.autosave.problem, checks.problem and f"The level could not be examined: {checks.problem}"]
        self.autosave.problem = checks.problem = ""
        return list(filter(None, failed))

    def flush(self) -> None:
        """Keep the draft safe now, and wait for the disk."""
        self.autosave.flush(self.history, self.source)

    def keep_history(self) -> None:
        """Keep the steps of undo with the level's file."""
        keep_history(self._folder, self.source.digest, self.history)

    def close(self) -> None:
        self.autosave.close()

    def changed_source(self) -> Source | None:
        """The level's file if another program has changed it. Raises NinjaGameError, OSError."""
        path, now = self.source.path, monotonic()
        if path is None or now - self.looked_at < LOOK_SPACING or self.history.in_stroke:
            return None
        self.looked_at = now
        stamp, before = file_stamp(path), self._stamp
        self._stamp = stamp
        if stamp in (before, NO_FILE):
            return None
        source = open_source(path)
        return source if source.digest != self.source.digest else None


def _accepted(path: Path | None) -> dict[str, str]:
    with suppress(NinjaGameError, OSError):
        reasons = Pack(path.parent).index.reasons if path and is_pack(path.parent) else {}
        return {code: why for (file, code), why in reasons.items() if path and file == path.name}
    return {}


def _search_of_known(known: tuple[Level, Replay]) -> Certification:
    return search_of(*known)
