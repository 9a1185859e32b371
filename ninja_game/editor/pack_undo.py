"""Undo of what is done to packs: what each step did to the texts in some folders."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import SUFFIXES, read_bytes
from ninja_game.files.tree import Tree
from ninja_game.formats.pack.pack import MOST_BYTES

MOST = 12  # steps that are kept


class Step(NamedTuple):
    """``texts``: of each file that was changed, before and after; None where there was none. ``moved``: from, to."""

    what: str
    texts: Mapping[Path, tuple[bytes | None, bytes | None]] = {}
    moved: tuple[Path, Path] | None = None


class Steps(list[Step]):
    """What was done, in memory; files over 4 MiB are not among it."""

    def do(self, what: str, action: Callable[[], object], folders: Iterable[Path]) -> None:
        """Do something to the texts in folders. Raises what ``action`` raises; what it has done by then is a step."""
        before = _texts(folders)
        try:
            action()
        finally:
            after = _texts(folders)
            pairs = {path: (before.get(path), after.get(path)) for path in before | after}
            if texts := {path: (old, new) for path, (old, new) in pairs.items() if old != new}:
                self[:] = [*self, Step(what, texts)][-MOST:]

    def undo(self) -> str:
        """Take the newest step back; what it was. Nothing is done where its files were changed since.

        Raises NinjaGameError then, OSError.
        """
        if not self:
            raise NinjaGameError("there is nothing to undo")
        what, texts, moved = self.pop()
        changed = [path.name for path, (_, new) in texts.items() if _text(path) != new]
        changed += [moved[0].name] if moved and moved[0].exists() else []
        if changed:
            raise NinjaGameError(f"{what}: not undone, as {changed[0]} was changed since")
        if moved:
            moved[1].rename(moved[0])
        for path, (old, _) in texts.items():
            if old is not None:
                Tree(path.parent).write(path.name, old)
                continue
            Tree(path.parent).remove(path.name)
            with suppress(OSError):
                path.parent.rmdir()  # if it is empty
                path.parent.parent.rmdir()
        return what


def _texts(folders: Iterable[Path]) -> dict[Path, bytes]:
    suffixes = (*SUFFIXES, ".toml")
    paths = {path for folder in folders for path in folder.rglob("*") if path.suffix.lower() in suffixes}
    return {path: text for path in paths if (text := _text(path)) is not None}


def _text(path: Path) -> bytes | None:
    try:
        return read_bytes(path, MOST_BYTES)
    except (NinjaGameError, OSError):
        return None
