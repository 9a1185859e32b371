"""Folders that are filled by file names: existing entries, links above all, cannot redirect a write elsewhere.

Each step goes from the handle of a folder to that of the next one, so that no link can appear between a check and a
use. Windows and pages have no such handles: there each path is compared with its resolved form, which protects against
existing links, not against a program that makes one at the same moment.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from ninja_game.errors import FileError
from ninja_game.files.reading import file_type
from ninja_game.files.writing import as_bytes, named, replacing
from ninja_game.runtime import FOLDER_HANDLES


class Tree:
    """The folder ``root``, made when it is first written into, and everything below it.

    ``kept``: a written file is on the disk at once; else when the system has time for it.

    ``root`` may be a link, since the user names it; below it none is followed. Names have ``/`` between their parts.
    Raises FileError for a name that leads out, and for a link or a file in place of a folder; OSError.
    """

    def __init__(self, root: Path, *, kept: bool = True) -> None:
        self.root = root
        self._kept = kept

    def write(self, name: str, content: bytes | str) -> None:
        """Put a file there, whole or not at all, as ``write_atomically`` does; only a regular file is replaced."""
        *folders, last = _parts(name)
        with (
            self._folder(folders, make=True) as (folder, at),
            replacing(folder / last, _replaceable(folder / last, at), at, kept=self._kept) as file,
        ):
            file.write(as_bytes(content))

    def check(self, name: str) -> None:
        """Raise now what ``write`` would raise about a name, for commands that work long before they write."""
        *folders, last = _parts(name)
        with suppress(FileNotFoundError), self._folder(folders) as (folder, at):
            _replaceable(folder / last, at)

    def names(self, folder: str = "") -> list[str]:
        """The names in a folder, hidden or not, sorted; none for a missing folder."""
        with suppress(FileNotFoundError), self._folder(_parts(folder) if folder else []) as (path, at):
            return sorted(entry.name for entry in _entries(path, at))
        return []

    def remove(self, name: str) -> None:
        """Delete a file, or a link and not its target, if it is there."""
        *folders, last = _parts(name)
        with suppress(FileNotFoundError), self._folder(folders) as (folder, at):
            os.unlink(named(folder / last, at), dir_fd=at)

    def remove_others(self, folder: str, keep: Collection[str]) -> None:
        with suppress(FileNotFoundError), self._folder(_parts(folder)) as (path, at):
            for entry in _entries(path, at):
                if entry.name not in keep and entry.is_file(follow_symlinks=False):
                    os.unlink(named(path / entry.name, at), dir_fd=at)

    @contextmanager
    def _folder(self, parts: Sequence[str], *, make: bool = False) -> Iterator[tuple[Path, int | None]]:
        """The path of a folder, and a handle of it on systems with handles."""
        path = self.root
        if make:
            path.mkdir(parents=True, exist_ok=True)
        at = os.open(path, os.O_RDONLY | os.O_DIRECTORY) if FOLDER_HANDLES else None
        try:
            for part in parts:
                path = path / part
                if make:
                    with suppress(FileExistsError):
                        os.mkdir(named(path, at), dir_fd=at)
                below = _entered(path, at)
                if at is not None:
                    os.close(at)
                at = below
            yield path, at
        finally:
            if at is not None:
                os.close(at)


def leads_below(name: str) -> bool:
    odd = "\0" if os.sep == "/" else "\0\\:"
    return not any(part in ("", ".", "..") or set(part) & set(odd) for part in name.split("/"))


def _parts(name: str) -> list[str]:
    """The parts of a name. Raises FileError for one that leads elsewhere."""
    if not leads_below(name):
        raise FileError("no name of a file in this folder", found=ascii(name))
    return name.split("/")


def _entered(path: Path, at: int | None) -> int | None:
    """A handle of a folder in the folder ``at``. Raises FileError for a link and for anything but a folder."""
    try:
        if at is not None:
            return os.open(path.name, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=at)
        if Path(os.path.realpath(path)) == Path(os.path.realpath(path.parent), path.name):
            return None
    except OSError as error:
        if error.errno not in (errno.ELOOP, errno.EMLINK, errno.ENOTDIR):
            raise OSError(error.errno, error.strerror, str(path)) from None
    hint = "nothing is written through links here; remove it, or choose another folder"
    raise FileError("a link, or no folder, in the place of a folder", str(path), hint=hint)


def _replaceable(path: Path, at: int | None) -> os.stat_result | None:
    """The state of the file with this name, for ``replacing``. Raises FileError for anything but a regular file."""
    try:
        status = os.stat(named(path, at), dir_fd=at, follow_symlinks=False)
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(status.st_mode):
        found, hint = file_type(status.st_mode), "nothing is written through links here; remove it"
        raise FileError("only a regular file is written", str(path), found=found, hint=hint)
    return status


def _entries(path: Path, at: int | None) -> list[os.DirEntry[str]]:
    with os.scandir(path if at is None else at) as entries:
        return list(entries)
