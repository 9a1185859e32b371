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

LOCK_SUFFIX = ".lock"
"""Of the file that a program holds as long as it keeps another one."""

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
    """No other process is within such a block for the same ``path``.

    The lock is on a hidden file next to it, which stays; the system frees it when a process dies. After ``seconds``, or
    where the place has no locks, the block goes on without: a missing lock must not keep anyone from playing.
    """
    try:
        handle = os.open(path.with_name(f".{path.name}.lock"), os.O_CREAT | os.O_RDWR, 0o666)
    except (OSError, ValueError):
        yield
        return
    try:
        _lock(handle, seconds)
        yield
    finally:
        # Closing frees it.
        os.close(handle)


def _lock(handle: int, seconds: float) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            _try_to_lock(handle)
            return
        except (BlockingIOError, PermissionError):
            time.sleep(0.005)
        except OSError:
            # This disk has no locks.
            return


def lock(handle: int) -> bool:
    """Lock an open file for as long as it stays open; False where another program holds it."""
    try:
        _try_to_lock(handle)
    except (BlockingIOError, PermissionError):
        return False
    except OSError:
        # This disk has no locks.
        pass
    return True


def hold(path: Path) -> int | None:
    """Lock a file, which is made if it is missing, for as long as its handle stays open; None if another holds it.

    The system frees it when a process dies, however it dies. Raises OSError for a place without files.
    """
    handle = os.open(path, os.O_CREAT | os.O_RDWR, 0o666)
    try:
        _try_to_lock(handle)
    except (BlockingIOError, PermissionError):
        os.close(handle)
        return None
    return handle


def left_behind(
    folder: Path, pattern: str, read: Callable[[Path], Found], damaged: tuple[type[Exception], ...]
) -> Iterator[Found]:
    """What files hold whose programs have died, the newest first; those of running programs are left out.

    ``damaged``: what ``read`` raises for a file that is left out too.
    """
    with suppress(OSError):
        for file in sorted(folder.glob(pattern), key=lambda path: -path.stat().st_mtime):
            handle = hold(file.with_suffix(LOCK_SUFFIX))
            if handle is None:
                continue
            try:
                found = read(file)
            except damaged:
                continue
            finally:
                os.close(handle)
            yield found


def forget(file: Path) -> None:
    """Remove a file that was held, and its lock."""
    for each in (file, file.with_suffix(LOCK_SUFFIX)):
        with suppress(OSError):
            each.unlink(missing_ok=True)
