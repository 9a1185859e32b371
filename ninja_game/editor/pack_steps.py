"""Steps that change packs on the disk, and undo them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from typing import NamedTuple

from ninja_game.editor.files import UNDO, UNDO_BYTES
from ninja_game.errors import DAMAGED, FileError, NinjaGameError
from ninja_game.files.reading import read_bytes, read_utf8
from ninja_game.files.tree import Tree, leads_below
from ninja_game.files.user_folder import EDITING
from ninja_game.formats.pack.pack import CERTIFICATES, INDEX


class Step(NamedTuple):
    """A change of packs that can be undone."""

    name: str
    #: By folder and name of a changed file: its bytes before and after; None for a missing file
    texts: dict[tuple[Path, str], tuple[bytes | None, bytes | None]]
    moves: list[tuple[Path, Path]]  #: folders, from and to


_step: ContextVar[Step | None] = ContextVar("step", default=None)
"""The present step of this thread, to which each change below is added."""


class Steps(list[Step]):
    """The last dozen steps. ``root``: the player's folder; steps that change only files below it are saved there."""

    def __init__(self, root: Path) -> None:
        super().__init__()
        self._root, self._file = root, f"{EDITING}/{UNDO}/packs.steps"
        with suppress(OSError, *DAMAGED):
            self[:] = [self._step(*kept) for kept in json.loads(read_utf8(root / self._file))]

    def _keep(self) -> None:
        """Save the newest steps, as many as have room, back to the first that changes files elsewhere."""

        def plain(value: Path | bytes) -> str:
            return value.decode("latin-1") if isinstance(value, bytes) else value.relative_to(self._root).as_posix()

        kept, room = list[str](), UNDO_BYTES
        with suppress(ValueError):
            for name, texts, moves in reversed(self):
                step = json.dumps([name, [[*key, *both] for key, both in texts.items()], moves], default=plain)
                if (room := room - len(step)) < 0:
                    break
                kept.insert(0, step)
        with suppress(OSError, NinjaGameError):
            Tree(self._root).write(self._file, f"[{','.join(kept)}]")

    def _place(self, name: str) -> Path:
        if not leads_below(name):
            raise FileError("no place below the player's folder", found=ascii(name))
        return self._root / name

    def _step(self, title: str, texts: list[list[str | None]], moves: list[list[str]]) -> Step:
        """A step that was kept. Raises one of DAMAGED for anything else."""
        versions = {}
        for folder, name, *both in texts:
            old, new = (text if text is None else text.encode("latin-1") for text in both)
            versions[self._place(str(folder)), str(name)] = old, new
        return Step(str(title), versions, [(self._place(old), self._place(new)) for old, new in moves])

    def run(self, name: str, action: Callable[[], object]) -> bool:
        """Change packs by the functions here; whether anything changed. Raises as ``action`` does.

        Changes before an error are a step too.
        """
        step = Step(name, {}, [])
        token = _step.set(step)
        try:
            action()
        finally:
            _step.reset(token)
            changed = bool(step.moves) or any(old != new for old, new in step.texts.values())
            if changed:
                self[:] = [*self, step][-12:]
                self._keep()
        return changed

    def undo(self) -> str:
        """Undo the newest step; its name. Nothing is done if its files have changed since.

        Raises NinjaGameError then, OSError: a failed undo can be tried again.
        """
        if not self:
            raise NinjaGameError("there is nothing to undo")
        step_name, texts, moves = self[-1]
        changed = [name for (folder, name), versions in texts.items() if _text(folder / name) not in versions]
        changed += [old.name for old, new in moves if old.exists() or not new.exists()]
        if changed:
            self._drop_newest()
            raise NinjaGameError(f"{step_name}: not undone, as {changed[0]} was changed since")
        for old_place, new_place in moves:
            new_place.rename(old_place)
        for (folder, name), (old, _) in texts.items():
            write_file(folder, name, old)
        new_packs = [folder for (folder, name), (old, _) in texts.items() if name == INDEX and old is None]
        for empty in [place for folder in new_packs for place in (folder / CERTIFICATES, folder)]:
            with suppress(OSError):
                empty.rmdir()
        self._drop_newest()
        return step_name

    def _drop_newest(self) -> None:
        self.pop()
        self._keep()


def _text(path: Path) -> bytes | None:
    """None for a missing file. Raises FileError, OSError for one that cannot be read."""
    return read_bytes(path) if path.exists() else None


@contextmanager
def noted(folder: Path, name: str) -> Iterator[None]:
    """Add a file's change within the block to the step."""
    step = _step.get()
    before = _text(folder / name) if step else None
    yield
    if step:
        first, _ = step.texts.get((folder, name), (before, None))
        step.texts[folder, name] = first, _text(folder / name)


def write_file(folder: Path, name: str, text: bytes | str | None) -> None:
    """Write a file, or delete it if ``text`` is None."""
    with noted(folder, name):
        if text is None:
            Tree(folder).remove(name)
        else:
            Tree(folder).write(name, text)


def move_folder(old: Path, new: Path) -> None:
    old.rename(new)
    if step := _step.get():
        step.moves.append((old, new))
