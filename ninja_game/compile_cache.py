"""Compiled kernels, once per process, with their machine code kept in the user's cache folder.

Numba's own cache notices a change only in the file of an entry point, so the folder is named after a digest of all
sources of ``sim``. Numba reads that name when it is first imported and never again.
"""

from __future__ import annotations

import hashlib
import os
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from ninja_game.errors import NinjaGameError

if TYPE_CHECKING:
    from ninja_game.sim.compiled import Kernels

Memory = Literal["plain", "compiled"]


class MemoryUnavailableError(NinjaGameError):
    """The compiled memory was asked for, but Numba is not installed."""


def compiled_available() -> bool:
    """Is Numba installed? Without it everything works on the plain memory."""
    return find_spec("numba") is not None


def choose_memory(memory: str) -> Memory:
    """Turn "plain", "compiled" or "auto" (compiled where it is available) into one of the two.

    Raises MemoryUnavailableError for "compiled" without Numba, ValueError for another word.
    """
    if memory == "auto":
        return "compiled" if compiled_available() else "plain"
    if memory == "compiled":
        if not compiled_available():
            raise MemoryUnavailableError(
                "the compiled memory needs Numba; install the extra 'fast' (pip install 'ninja-game[fast]') "
                "or use the plain memory"
            )
        return "compiled"
    if memory == "plain":
        return "plain"
    raise ValueError(f"memory is {memory!r}; expected 'plain', 'compiled' or 'auto'")


def source_digest() -> str:
    """A short digest of every source file of the simulation and of the Python that compiles it."""
    digest = hashlib.sha256(sys.version.encode())
    folder = Path(__file__).parent / "sim"
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def kernels() -> Kernels:
    """The compiled entry points by name (``sim/kernels.py``). Raises MemoryUnavailableError without Numba."""
    choose_memory("compiled")
    if "numba" not in sys.modules:
        from platformdirs import user_cache_path

        folder = user_cache_path("ninja-game") / "compiled" / source_digest()
        os.environ.setdefault("NUMBA_CACHE_DIR", str(folder))
    from ninja_game.sim.compiled import compile_rules

    return compile_rules()
