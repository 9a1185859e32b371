"""Files that are whole or not there: written next to their place, flushed to the disk, then renamed into it.

Only regular files are written. A symbolic link named by the user stays, and its target is replaced (``files.tree``
follows none); an existing file keeps its mode. Other hard links to it keep the old content.
"""

from __future__ import annotations

import errno
import os
import stat
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

from ninja_game.errors import FileError
from ninja_game.files.reading import SUFFIXES, file_type, is_input
from ninja_game.signals import last_acts

PART_PREFIX, PART_SUFFIX = ".ninja-game-", ".part"
"""Name of a temporary file; it lies in the folder of the file that it will become."""

_unfinished: set[Path] = set()  # the temporary files that this process is writing

tidied: set[Path] = set()  # folders that this process has cleared of killed writers' temporary files


def write_atomically(
    path: Path, fill: Callable[[IO[bytes]], object] | bytes | str, *, keep: Iterable[Path] = ()
) -> None:
    """Write a file to ``path``, whole or not at all; when this returns it is on the disk.

    ``fill`` is the content, as for ``as_bytes``, or a function that writes it into a binary file. ``keep``: as in
    ``open_atomically``, with the same errors.
    """
    with open_atomically(path, keep=keep) as file:
        if callable(fill):
            fill(file)
        else:
            file.write(as_bytes(fill))


def as_bytes(content: bytes | str) -> bytes:
    """A file's content: text becomes UTF-8, lone surrogates question marks."""
    return content.encode("utf-8", "replace") if isinstance(content, str) else content


@contextmanager
def open_atomically(path: Path, *, keep: Iterable[Path] = ()) -> Iterator[IO[bytes]]:
    """A binary file that appears at ``path`` when the block ends, and never if it ends in an exception.

    ``keep``: files and folders that the block reads; a ``path`` that would replace one of them is refused.

    Raises FileError for a path that cannot be written on principle, OSError with the name ``path`` for the rest.
    """
    target, status = _target(path, keep)
    with replacing(target, status, shown=path) as file:
        yield file
        _target(path, keep)  # the block may have read it


@contextmanager
def replacing(
    target: Path, status: os.stat_result | None, at: int | None = None, *, shown: Path | None = None, kept: bool = True
) -> Iterator[IO[bytes]]:
    """A binary file that takes the place of ``target`` when the block ends, and never if it ends in an exception.

    ``status``: of the file that is there, None: none; ``at``: a handle of its folder, None: the folder is found by its
    path; ``shown``: what OSErrors call the file, None: ``target``; ``kept``: it is on the disk then.
    """
    remove_leftovers(target.parent, at)
    part = None
    try:
        handle, part = _new_part(target.parent, at)
        _unfinished.add(part)
        with os.fdopen(handle, "wb") as file:
            yield file
            file.flush()
            if status is not None:
                _keep_rights(part, handle, status)
            if kept:
                os.fsync(handle)
            if sys.platform != "win32":
                # Rename it while it is open and locked, so that no other process removes it as a leftover.
                os.replace(named(part, at), named(target, at), src_dir_fd=at, dst_dir_fd=at)
        if sys.platform == "win32":
            part.replace(target)
        if kept:
            _sync_folder(target.parent, at)
    except BaseException as error:
        if part is not None:
            with suppress(OSError):
                os.unlink(named(part, at), dir_fd=at)
        if isinstance(error, OSError) and _is_about_the_file(error):
            raise OSError(error.errno, error.strerror or str(error), str(shown or target)) from None
        raise
    finally:
        _unfinished.discard(part or target)


def named(path: Path, at: int | None) -> str:
    """A path for system calls: its name where ``at`` is a handle of its folder, else all of it."""
    return str(path) if at is None else path.name


def discard_unfinished() -> None:
    """Remove what this process was writing; only for a process that ends here and now."""
    for part in list(_unfinished):
        with suppress(OSError):
            part.unlink(missing_ok=True)


last_acts.append(discard_unfinished)


def check_output(path: Path, keep: Iterable[Path] = ()) -> None:
    """Raise now what ``open_atomically`` would raise about a path, for commands that work long before they write."""
    target, _ = _target(path, keep)
    if not target.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))


def remove_leftovers(folder: Path, at: int | None = None) -> None:
    """Remove the temporary files of killed writers from a folder; once for each folder and process.

    ``at``: a handle of it.
    """
    if folder in tidied:
        return
    tidied.add(folder)
    try:
        with os.scandir(folder if at is None else at) as entries:
            parts = [folder / entry.name for entry in entries if entry.name.startswith(PART_PREFIX)]
    except OSError:
        return
    for part in parts:
        if part.name.endswith(PART_SUFFIX):
            with suppress(OSError):
                _remove_unlocked(part, at)


def _target(path: Path, keep: Iterable[Path]) -> tuple[Path, os.stat_result | None]:
    """The file behind ``path`` and what is there already. Raises FileError, OSError."""
    try:
        target = path.resolve()
    except (ValueError, RuntimeError) as error:
        raise FileError("no file can have this name", ascii(str(path)), found=str(error)) from None
    try:
        status = target.stat()
    except FileNotFoundError:
        return target, None
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    if not stat.S_ISREG(status.st_mode):
        raise FileError("only a regular file is written", str(path), found=file_type(status.st_mode))
    if is_input(status) or any(_reads(kept, target) for kept in keep):
        raise FileError("this file is read by the same command", str(path), hint="choose another name for the output")
    if not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
    return target, status


def _keep_rights(part: Path, handle: int, status: os.stat_result) -> None:
    """Give the new file the mode and, where that is allowed, the owner of the one it replaces."""
    if sys.platform == "win32":
        part.chmod(stat.S_IMODE(status.st_mode))
    else:
        with suppress(OSError):
            os.fchown(handle, status.st_uid, status.st_gid)
        os.fchmod(handle, stat.S_IMODE(status.st_mode))


def _reads(source: Path, target: Path) -> bool:
    """Whether a reader of ``source``, a file or a folder, reads ``target``."""
    if source.is_dir():
        return target.name.lower().endswith(SUFFIXES) and target.is_relative_to(source.resolve())
    return source.exists() and source.samefile(target)


def _is_about_the_file(error: OSError) -> bool:
    """Whether an error names the temporary file, or no file at all as those of writing do."""
    if error.filename is None:
        return not isinstance(error, ConnectionError)
    return Path(os.fsdecode(error.filename)).name.startswith(PART_PREFIX)


def _sync_folder(folder: Path, at: int | None) -> None:
    """Flush a folder's list of names to the disk, if the system can do that."""
    if sys.platform != "win32":
        with suppress(OSError):
            handle = os.open(folder if at is None else ".", os.O_RDONLY, dir_fd=at)
            try:
                os.fsync(handle)
            finally:
                os.close(handle)


if sys.platform == "win32":

    def _new_part(folder: Path, _: int | None) -> tuple[int, Path]:
        """A new temporary file. Windows itself refuses to remove it while it is open."""
        part = folder / f"{PART_PREFIX}{os.urandom(8).hex()}{PART_SUFFIX}"
        return os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY | os.O_BINARY, 0o666), part

    def _remove_unlocked(part: Path, _: int | None) -> None:
        part.unlink()

else:
    import fcntl

    def _new_part(folder: Path, at: int | None) -> tuple[int, Path]:
        """A new temporary file, locked for as long as it is open; the system's mask decides on its mode."""
        while True:
            part = folder / f"{PART_PREFIX}{os.urandom(8).hex()}{PART_SUFFIX}"
            flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY | os.O_CLOEXEC
            handle = os.open(named(part, at), flags, 0o666, dir_fd=at)
            with suppress(OSError):
                # Some network disks have no locks.
                fcntl.flock(handle, fcntl.LOCK_EX)
            if os.fstat(handle).st_nlink:
                return handle, part
            # Another process removed it as a leftover, after it was made and before it was locked.
            os.close(handle)

    def _remove_unlocked(part: Path, at: int | None) -> None:
        """Remove a temporary file unless a process still writes it. Raises OSError."""
        handle = os.open(named(part, at), os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW, dir_fd=at)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.unlink(named(part, at), dir_fd=at)
        finally:
            os.close(handle)
