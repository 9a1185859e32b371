"""Compiled kernels, once per process, with their machine code kept in the user's cache folder.

Numba's own cache notices a change only in the file of an entry point, so the folder is named after a digest of all
sources with compiled functions. Numba reads that name when it is first imported.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Literal

from ninja_game.errors import NinjaGameError
from ninja_game.sim.memory.declare import REGISTERED

if TYPE_CHECKING:
    from ninja_game.sim.memory.compiled import Compiler, Kernels

Memory = Literal["plain", "compiled"]

_LOCK = Lock()
"""One thread at a time imports Numba and makes twins."""
_TABLES: dict[int, Kernels] = {}
"""The kernels by how many functions were registered when they were made."""

KEPT_VERSIONS = 5
"""How many versions of the sources keep their compiled code."""

_REGISTERS = re.compile(rb"^@(fast|entry_point)$", re.MULTILINE)
_IMPORTS = re.compile(rb"ninja_game\.(?:batch|solver)\.(\w+)")


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


def compiled_sources() -> list[Path]:
    """Every source file that goes into the machine code, so that an edit elsewhere compiles nothing anew.

    All of ``sim``; of ``batch`` and ``solver`` the files that register functions, and what those import from there.
    """
    package = Path(__file__).parent
    paths = {path.stem: path for folder in ("batch", "solver") for path in (package / folder).glob("*.py")}
    texts = {name: path.read_bytes() for name, path in paths.items()}
    found = {name for name, text in texts.items() if _REGISTERS.search(text)}
    waiting = list(found)
    while waiting:
        imported = {name.decode() for name in _IMPORTS.findall(texts[waiting.pop()])}
        new = imported & texts.keys() - found
        found |= new
        waiting += new
    return sorted((package / "sim").rglob("*.py")) + [paths[name] for name in sorted(found)]


def source_digest() -> str:
    """A short digest of every source file with compiled functions and of the Python that compiles them."""
    digest = hashlib.sha256(sys.version.encode())
    package = Path(__file__).parent
    for path in compiled_sources():
        digest.update(path.relative_to(package).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def forget_old_code(folder: Path) -> None:
    """Remove what older sources left behind, but for the newest few; what cannot be removed stays."""
    try:
        kept = sorted(folder.iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)[:KEPT_VERSIONS]
        for path in set(folder.iterdir()) - set(kept):
            shutil.rmtree(path, ignore_errors=True)
    except OSError:
        return


def kernels() -> Kernels:
    """Compiled entry points of all modules imported so far, by name; any thread may ask.

    Raises MemoryUnavailableError without Numba.
    """
    known = _TABLES.get(len(REGISTERED))
    if known is None:
        with _LOCK:
            known = _TABLES[len(REGISTERED)] = _compiler().kernels()
    return known


@cache
def _compiler() -> Compiler:
    """The compiler of this process; tells Numba where its cache is, also where something has imported Numba before."""
    choose_memory("compiled")
    if "NUMBA_CACHE_DIR" not in os.environ:
        from platformdirs import user_cache_path

        folder = user_cache_path("ninja-game") / "compiled"
        os.environ["NUMBA_CACHE_DIR"] = str(folder / source_digest())
        if "numba" in sys.modules:
            # Numba has read the environment already: it would keep code beside the sources, and run old rules.
            sys.modules["numba"].config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]
        forget_old_code(folder)
    from ninja_game.sim.memory.compiled import Compiler

    return Compiler()
