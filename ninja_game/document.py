"""Documents under edit, for the level editor and the TAS editor: undo, a safe way to save, and a recovery copy."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Generic, TypeVar

from ninja_game.errors import DAMAGED, FileError, NinjaGameError, reason
from ninja_game.files.locking import LOCK_SUFFIX, read_abandoned, remove_abandoned, try_lock
from ninja_game.files.reading import digest_of, read_bytes

Draft = TypeVar("Draft")  # a level or a run under edit: never changed, equal to another one that says the same
Found = TypeVar("Found")


class OccupiedError(NinjaGameError):
    """A file that saving would replace, and that was not made by this document's last save."""


def common_length(a: Sequence[object], b: Sequence[object]) -> int:
    """How many items are the same from the beginning on.

    >>> common_length("tonight", "today")
    2
    """
    shorter = min(len(a), len(b))
    return next((number for number in range(shorter) if a[number] != b[number]), shorter)


def digest_of_file(path: Path) -> str:
    """The digest of a file's bytes; '' without a file."""
    return digest_of(read_bytes(path)) if path.exists() else ""


def check_free(path: Path, there: str, known: str | None, *, replacing: bool) -> None:
    """Raise OccupiedError where writing would surprise: over another file, through a link to nothing, or again.

    ``there``: the digest of the file at ``path``; ``known``: that of the document's own, None for another's.
    """
    if replacing or (there == (known or "") and (there or not path.is_symlink())):
        return
    if known is None:
        raise OccupiedError(f"a file named {path.name} already exists")
    raise OccupiedError(f"another program has {'changed' if there else 'removed'} {path.name}")


class RecoveryFile:
    """The recovery copy of a document, in the player's folder: the next start offers it after a crash.

    It is locked as long as its program runs. ``file``: the copy of a crashed program, to go on with; None begins a new
    one. ``problem``: why the copy cannot be written, or ''. Raises FileError if another window has ``file`` already.
    """

    def __init__(self, folder: Path, suffix: str, file: Path | None = None) -> None:
        self.problem = ""
        self.file = file or folder / f"{secrets.token_hex(6)}{suffix}"
        self._lock: int | None = None
        if file is not None:
            self.lock()

    def lock(self) -> None:
        """Keep the file from others, if that is not done yet. Raises FileError, OSError."""
        if self._lock is None:
            self.file.parent.mkdir(parents=True, exist_ok=True)
            self._lock = try_lock(self.file.with_suffix(LOCK_SUFFIX))
            if self._lock is None:
                raise FileError("another window continues with this already", str(self.file))

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """Set ``problem`` by whether the block succeeds."""
        try:
            yield
            self.problem = ""
        except (OSError, NinjaGameError) as error:
            self.problem = f"What you edit cannot be kept safe: {reason(error)}"

    def close(self, *, keep: bool = False) -> None:
        """End. ``keep``: the copy stays, to be found at the next start."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None
            if not keep:
                remove_abandoned(self.file)


def recovered_from(folder: Path, suffix: str, read: Callable[[Path], Found]) -> Iterator[Found]:
    """The documents of programs that crashed, the newest first; running programs' and damaged files are left out."""
    return read_abandoned(folder, f"*{suffix}", read, DAMAGED)


class History(Generic[Draft]):
    """Undo and redo over drafts. ``draft``: the present one. The edits of a *stroke* (press to release) are one."""

    def __init__(self, draft: Draft, done: Sequence[Draft] = (), undone: Sequence[Draft] = ()) -> None:
        self.draft = draft
        self.done, self._undone = [*done], [*undone]
        self._began: Draft | None = None

    @property
    def can_undo(self) -> bool:
        return bool(self.done) or self._began not in (None, self.draft)

    @property
    def can_redo(self) -> bool:
        return bool(self._undone)

    def steps(self, most: int) -> tuple[list[Draft], list[Draft]]:
        """The drafts to which undo and redo lead, the next one last, at most this many of each."""
        began = [] if self._began in (None, self.draft) else [self.began]
        return [*self.done, *began][-most:], self._undone[-most:]

    def copy(self) -> History[Draft]:
        return History(self.draft, *self.steps(len(self.done) + len(self._undone) + 1))

    @property
    def began(self) -> Draft:
        """The draft at the begin of the stroke; the present one outside of strokes."""
        return self.draft if self._began is None else self._began

    @property
    def in_stroke(self) -> bool:
        return self._began is not None

    def begin(self) -> None:
        self.end()
        self._began = self.draft

    def change(self, draft: Draft) -> None:
        """Another draft, as a part of the stroke or as an edit of its own."""
        if draft == self.draft:
            return
        alone = self._began is None
        self._began = self.began
        self.draft = draft
        if alone:
            self.end()

    def amend(self, change: Callable[[Draft], Draft]) -> None:
        """Change the draft, and in the same way all that undo and redo lead to; steps that do nothing then go."""
        self.draft = change(self.draft)
        for steps in (self.done, self._undone):
            drafts = [*map(change, steps), self.draft]
            steps[:] = [draft for draft, following in pairwise(drafts) if draft != following]

    def end(self) -> None:
        began, self._began = self._began, None
        if began not in (None, self.draft):
            self.done.append(began)
            self._undone.clear()

    def abandon(self) -> None:
        """The stroke ends, and what it changed is taken back."""
        self.draft, self._began = self.began, None

    def undo(self) -> bool:
        """Take the last edit back; whether there was one."""
        return self._step(self.done, self._undone)

    def redo(self) -> bool:
        """Redo the edit that was undone last; whether there was one."""
        return self._step(self._undone, self.done)

    def _step(self, source: list[Draft], target: list[Draft]) -> bool:
        self.end()
        if not source:
            return False
        target.append(self.draft)
        self.draft = source.pop()
        return True
