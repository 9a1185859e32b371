"""Levels from files and back, and a copy while they are edited: nothing is lost, nothing of others is replaced."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from ninja_game.document import RecoveryFile, check_free, digest_of, digest_of_file, recovered_from
from ninja_game.editor.ascii_text import ascii_text, updated_text
from ninja_game.editor.draft import Draft
from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.locking import forget
from ninja_game.files.reading import read_bytes, read_utf8
from ninja_game.files.user_folder import EDITING
from ninja_game.files.writing import write_atomically
from ninja_game.formats.ascii.writer import headers_of
from ninja_game.formats.links import is_link
from ninja_game.formats.load import load_levels, texts_of
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.runtime import NewestJob
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

SUFFIX = ".txt"


@dataclass(frozen=True)
class Source:
    """The file that a draft came from and is saved to. ``path``: None if it has none yet. ``text``: what the file says.

    ``draft``: the one that the file holds; ``digest``: of its bytes; ``windows``: whether lines end as on Windows.
    """

    draft: Draft
    path: Path | None = None
    text: str = ""
    digest: str = ""
    windows: bool = False


def new_source(author: str = "", *, room: bool = False) -> Source:
    """A level that has no file: an empty one, or a room with a floor, the ninja and an exit."""
    floor = tuple(int(row == ROWS - 1) for _ in range(COLUMNS) for row in range(ROWS))
    things = ObjectSpec(NINJA, (84.0, 542.0)), ObjectSpec(EXIT, (684.0, 540.0, 396.0, 540.0))
    return Source(Draft(Level(floor, things) if room else Level(), author=author))


def open_source(path: Path, record: int = 0) -> Source:
    """The level number ``record`` of a file or link. Only our readable files, which hold one level, are written back.

    Raises NinjaGameError for what cannot be read, OSError.
    """
    linked = is_link(path)
    data = b"" if linked else read_bytes(path)
    texts = list(texts_of(path))
    text = texts[0][1]
    levels = [level for file, each in texts for level in parse_levels(each, file=file)]
    named = next((each for each in levels if each.record == record), None)
    if named is None:
        raise LevelError(f"there is no record {record}", str(path))
    draft = draft_of(named)
    if linked or not named.ascii:
        return Source(draft)
    return Source(draft, path, text, digest_of(data), b"\r\n" in data)


def draft_of(named: NamedLevel) -> Draft:
    """A level of any file as a draft."""
    return Draft(named.level, **headers_of(named))


def save(source: Source, draft: Draft, path: Path, *, replacing: bool = False) -> Source:
    """Write a draft into a file, in the file's own form where it is the source's; the new source.

    Raises OccupiedError where that would replace another file, or one that was changed since it was read, unless
    ``replacing``; FileError, OSError for what cannot be written.
    """
    own = source.path is not None and path == source.path
    there = digest_of_file(path)
    if own and draft == source.draft and there == source.digest:
        return source
    check_free(path, there, source.digest if own else None, replacing=replacing)
    text = updated_text(source.text, source.draft, draft) if own and source.text else ascii_text(draft)
    data = (text.replace("\n", "\r\n") if own and source.windows else text).encode("utf-8", "replace")
    if digest_of(data) != there:
        write_atomically(path, data)
    return Source(draft, path, text, digest_of(data), own and source.windows)


def draft_of_text(text: str, about: Draft) -> Draft:
    """The first level of a text of any format, or of a link; name and author of ``about`` where the text has none.

    Raises NinjaGameError for a text without a level.
    """
    text = text.strip("\0 \r\n\t")
    named = (load_levels(text) if is_link(text) else parse_levels(text))[0]
    read = draft_of(named)
    return replace(read, name=read.name or about.name, author=read.author or about.author)


AUTOSAVE_SUFFIX = ".json"

SPACING = 0.4
"""Seconds from one autosave to the next, at least."""


class Autosave(RecoveryFile):
    """Keeps the newest draft of one document, in a thread of its own."""

    def __init__(self, folder: Path, file: Path | None = None) -> None:
        super().__init__(folder / EDITING, AUTOSAVE_SUFFIX, file)
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

    def forget(self) -> bool:
        """Remove it; whether no other program goes on with it."""
        return forget(self.file)


def recovered(folder: Path) -> Iterator[RecoveredDraft]:
    """What editors that have died were editing, the newest first; those of running editors are left out."""
    return recovered_from(folder / EDITING, AUTOSAVE_SUFFIX, _read)


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
