"""One process at a time: locks between games that use the same folder (the library filelock takes 90 ms to import)."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TypeVar

Found = TypeVar("Found")

LOCK_SUFFIX = ".lock"  # suffix of the lock file that a program holds while it uses another file

_OWN_FILE = os.O_CREAT | os.O_RDWR | getattr(os, "O_NOFOLLOW", 0)

if sys.platform == "win32":
    import msvcrt

    def _try_to_lock(handle: int) -> None:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _try_to_lock(handle: int) -> None:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def locked(path: Path, seconds: float) -> Iterator[None]:
    """A block that one process at a time can be in, for the same ``path``.

    The lock is on a hidden file next to it, which stays; the system frees it when a process dies. After ``seconds``, or
    without locks on this disk, the block continues without: a missing lock must not keep anyone from playing.
    """
    try:
        handle = os.open(path.with_name(f".{path.name}.lock"), _OWN_FILE, 0o666)
    except (OSError, ValueError):
        yield
        return
    try:
        end = time.monotonic() + seconds
        while time.monotonic() < end and not lock(handle):
            time.sleep(0.005)
        yield
    finally:
        # Closing frees it.
        os.close(handle)


def lock(handle: int) -> bool:
    """Lock an open file for as long as it stays open; False if another program holds it.

    True on a disk without locks: there every program may have the file.
    """
    try:
        _try_to_lock(handle)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        pass
    return True


def try_lock(path: Path) -> int | None:
    """Lock a file, which is made if it is missing, for as long as its handle stays open; None if another holds it.

    The system frees it when a process dies, however it dies. Raises OSError for a place without files.
    """
    handle = os.open(path, _OWN_FILE, 0o666)
    if lock(handle):
        return handle
    os.close(handle)
    return None


def read_abandoned(
    folder: Path, pattern: str, read: Callable[[Path], Found], damaged: tuple[type[Exception], ...]
) -> Iterator[Found]:
    """Read the files of crashed programs, the newest first; those of running programs are left out.

    ``damaged``: errors of ``read``, besides OSError, for which a file is left out too.
    """
    dated: list[tuple[float, Path]] = []
    with suppress(OSError):
        for file in folder.glob(pattern):
            with suppress(OSError):
                dated.append((file.stat().st_mtime, file))
    for _, file in sorted(dated, reverse=True):
        with suppress(OSError, *damaged):
            handle = try_lock(file.with_suffix(LOCK_SUFFIX))
            if handle is None:
                continue
            try:
                data = read(file)
            finally:
                os.close(handle)
            yield data


def remove_abandoned(file: Path) -> bool:
    """Remove a file that no program uses any more, and its lock; False where another program uses it."""
    with suppress(OSError):
        handle = try_lock(file.with_suffix(LOCK_SUFFIX))
        if handle is None:
            return False
        os.close(handle)
        for path in (file, file.with_suffix(LOCK_SUFFIX)):
            path.unlink(missing_ok=True)
    return True
