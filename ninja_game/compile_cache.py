"""Which memory to use, and compiled kernels, each made once per process."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from importlib.util import find_spec
from threading import Lock
from typing import TYPE_CHECKING, Any, TypeVar

from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.files.resources import how_to_install
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import Memory, MemoryName
from ninja_game.sim.memory.plain import PlainMemory

if TYPE_CHECKING:
    from ninja_game.sim.memory.compiler import Compiler

R = TypeVar("R")

_LOCK = Lock()
"""One thread at a time imports Numba and makes twins."""
_KERNELS: dict[Callable[..., Any], Any] = {}


class MemoryUnavailableError(NinjaGameError):
    """The compiled memory was asked for, but Numba is not installed, or its compiler is switched off."""


def compiled_available() -> bool:
    """Is Numba installed, with its compiler on? Without it everything works on the plain memory."""
    return find_spec("numba") is not None and os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")


def choose_memory(memory: str) -> MemoryName:
    """Turn "plain", "compiled" or "auto" (compiled where it is available) into one of the two.

    Raises MemoryUnavailableError for "compiled" without Numba, ArgumentError for another word.
    """
    if memory == "auto":
        return "compiled" if compiled_available() else "plain"
    if memory == "compiled":
        if not compiled_available():
            raise MemoryUnavailableError(
                f"the compiled memory needs Numba; {how_to_install('fast')}, "
                "unset NUMBA_DISABLE_JIT, or use the plain memory"
            )
        return "compiled"
    if memory == "plain":
        return "plain"
    raise ArgumentError(f"memory is {memory!r}; expected 'plain', 'compiled' or 'auto'")


def open_memory(memory: str, level: Level, *, box: bool) -> Memory:
    """A new world in a level, in the memory of that name (as ``choose_memory`` takes it).

    Raises LevelError for a level that cannot be played, and what ``choose_memory`` raises.
    """
    if choose_memory(memory) == "plain":
        return PlainMemory(level, box=box)
    from ninja_game.sim.memory.compiled import CompiledMemory

    return CompiledMemory(compiled, level, box=box)


def compiled(entry: Callable[..., R]) -> Callable[..., R]:
    """The compiled twin of an entry point, which takes the same arguments; any thread may ask.

    Raises MemoryUnavailableError without Numba, TypeError for a function that is no entry point.
    """
    kernel: Callable[..., R] | None = _KERNELS.get(entry)
    if kernel is None:
        with _LOCK:
            kernel = _KERNELS[entry] = _compiler()(entry)
    return kernel


def is_compiled(entry: Callable[..., Any]) -> bool:
    """Whether this process has made the compiled twin of an entry point."""
    return entry in _KERNELS


def fastest(entry: Callable[..., R]) -> Callable[..., R]:
    """The compiled twin of an entry point that only takes arrays of numbers; without Numba the function itself."""
    return compiled(entry) if compiled_available() else entry


@cache
def _compiler() -> Compiler:
    """The compiler of this process. NINJA_GAME_CHECKED=1 makes kernels that refuse indices out of range."""
    choose_memory("compiled")
    from ninja_game.kernel_cache import keep
    from ninja_game.sim.memory.compiler import Compiler

    return Compiler(checked=os.environ.get("NINJA_GAME_CHECKED") == "1", keep=keep)
