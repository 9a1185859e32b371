"""A background process that compiles all kernels of all commands once, so that no command waits for them.

It runs `ninja-game compile` at low priority, one at a time, in a session that outlives the process that started it.
"""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import suppress

from ninja_game.backend.kernel_cache import code_folder
from ninja_game.errors import FileError
from ninja_game.files.locking import try_lock

VARIABLE = "NINJA_GAME_BACKGROUND_COMPILER"
"""Environment variable: 0 turns the process off; commands then wait for their kernels."""

_BEHIND = 15  # how much its priority is lowered (os.nice)

_STARTED: list[subprocess.Popen[bytes]] = []  # the process that this one has started


def is_enabled() -> bool:
    return os.environ.get(VARIABLE) != "0"


def start() -> None:
    """Start it, once per process. Where that is impossible, every process compiles the kernels that it needs."""
    if _STARTED or not is_enabled():
        return
    environment = {**os.environ, "PYTHONSAFEPATH": "1", VARIABLE: "0"}
    quiet = subprocess.DEVNULL
    with suppress(OSError, FileError):
        folder = code_folder()
        folder.mkdir(parents=True, exist_ok=True)
        program = [sys.executable] if getattr(sys, "frozen", False) else [sys.executable, "-m", "ninja_game"]
        _STARTED.append(
            subprocess.Popen(  # noqa: S603 - this program itself
                [*program, "compile", "--background"],
                stdin=quiet,
                stdout=quiet,
                stderr=quiet,
                cwd=folder,
                env=environment,
                start_new_session=True,
                creationflags=getattr(subprocess, "BELOW_NORMAL_PRIORITY_CLASS", 0),
            )
        )


def is_compiling() -> bool:
    """Whether it, or the one of another process, compiles now."""
    if _STARTED and _STARTED[0].poll() is None:
        return True
    with suppress(OSError, FileError):
        handle = lock_compilation()
        if handle is None:
            return True
        os.close(handle)
    return False


def lock_compilation() -> int | None:
    """A handle that keeps others from compiling everything while it is open; None if another process has one.

    Raises OSError if no file can be written, and what ``code_folder`` raises.
    """
    folder = code_folder()
    folder.mkdir(parents=True, exist_ok=True)
    return try_lock(folder / "all.lock")


def lower_priority() -> None:
    """Lower the priority of this process, if the system has priorities."""
    if sys.platform != "win32":
        os.nice(_BEHIND)
