"""What is being edited, kept on the disk while it is edited, and found again after the program was killed."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from ninja_game.document import RecoveryFile, recovered_from
from ninja_game.editor.ascii_text import ascii_text
from ninja_game.editor.background import NewestJob
from ninja_game.editor.draft import Draft
from ninja_game.editor.files import Source, draft_of, new_source, open_source
from ninja_game.errors import NinjaGameError
from ninja_game.files.locking import forget
from ninja_game.files.reading import read_utf8
from ninja_game.files.writing import write_atomically
from ninja_game.formats.named_level import parse_levels

FOLDER, SUFFIX = "editing", ".json"
"""In the player's folder."""

SPACING = 0.4
"""Seconds from one autosave to the next, at least."""


class Autosave(RecoveryFile):
    """Keeps the newest draft of one document, in a thread of its own."""

    def __init__(self, folder: Path, file: Path | None = None) -> None:
        super().__init__(folder / FOLDER, SUFFIX, file)
        self._job: NewestJob[tuple[Draft, Source] | None, None] = NewestJob(self._work)
        self._kept: Draft | None = None
        self._asked_at = 0.0

    def poll(self, draft: Draft, source: Source) -> None:
        """Keep the draft if it has changed and it is time; nothing is kept of one that is as its file has it."""
        wanted = None if draft == source.draft else draft
        if wanted is not self._kept and time.monotonic() - self._asked_at >= SPACING and self._job.idle:
            self._asked_at = time.monotonic()
            self._kept = wanted
            self._job.ask((draft, source) if wanted else None)

    def flush(self, draft: Draft, source: Source) -> None:
        """Keep the draft now, if it has changed, and wait until it is kept."""
        self._job.finish()
        self._asked_at = -SPACING
        self.poll(draft, source)
        self._job.finish()

    def _work(self, job: tuple[Draft, Source] | None) -> None:
        if job is None:
            with suppress(OSError):
                self.file.unlink(missing_ok=True)
            return
        with self.reporting():
            self.lock()
            draft, source = job
            path = str(source.path.absolute()) if source.path else ""
            kept = {"path": path, "digest": source.digest, "level": ascii_text(draft)}
            write_atomically(self.file, json.dumps(kept, indent=1))

    def close(self, *, keep: bool = False) -> None:
        """End. ``keep``: what is kept stays, to be found by the next editor."""
        self._job.finish()
        super().close(keep=keep)


@dataclass(frozen=True)
class RecoveredDraft:
    """A draft whose program has died, the file that it came from, and the one in which it was kept."""

    draft: Draft
    source: Source
    file: Path

    def forget(self) -> None:
        forget(self.file)


def recovered(folder: Path) -> Iterator[RecoveredDraft]:
    """What editors that have died were editing, the newest first; those of running editors are left out."""
    return recovered_from(folder / FOLDER, SUFFIX, _read)


def _read(file: Path) -> RecoveredDraft:
    """What an autosave holds; its path counts only for a level that is still there. Raises what ``recovered`` names."""
    kept = json.loads(read_utf8(file))
    draft = draft_of(parse_levels(kept["level"])[0])
    source = new_source()
    if kept["path"]:
        with suppress(OSError, NinjaGameError):
            # Where somebody else has changed it since, saving will ask.
            source = replace(open_source(Path(kept["path"])), digest=str(kept["digest"]))
    return RecoveredDraft(draft, source, file)
