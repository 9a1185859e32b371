"""The choice of memory, and compiled kernels, made once per process.

There are two memories: "plain" (Python objects) and "compiled" (arrays, by Numba). "auto" means the compiled one where
that is faster: a single short run stays on the plain memory, since loading Numba would take longer than the run. If its
kernels are not in the cache yet, any run begins on the plain memory, and moves to the compiled one
(``switch_to_compiled``) once a background process has compiled them: both give the same bits. A run that is judged
follows a ``Plan``; its compiled code checks indices.

Before the first compiled world of a process is loaded, the memory must pass a test (``self_test.py``).
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from importlib.util import find_spec
from threading import Lock
from typing import TYPE_CHECKING, Any, TypeVar

from ninja_game.backend.kernels import kill_ninja, load_world, observe_object, run_world, step_world, trace_world
from ninja_game.backend.plain import PlainWorlds
from ninja_game.backend.self_test import check_self_test
from ninja_game.backend.worlds import MemoryName, Worlds
from ninja_game.budget import NO_LIMIT, PAGE_TICK_COST, PLAIN_WORK, tick_cost
from ninja_game.errors import ArgumentError, LevelError, NinjaGameError
from ninja_game.runtime import in_page_or_not, install_hint
from ninja_game.sim.inputs import MAX_TICKS
from ninja_game.sim.level import Level

if TYPE_CHECKING:
    from ninja_game.backend.compiler import Compiler

R = TypeVar("R")

_LOCK = Lock()  # one thread at a time imports Numba and makes twins
_MAX_TICK_COST = in_page_or_not(PAGE_TICK_COST, NO_LIMIT)
_ALL_CHECKED = os.environ.get("NINJA_GAME_CHECKED") == "1"


@dataclass(frozen=True)
class Plan:
    """The memory in which a run begins (``first``), and the one to which it changes once that pays off (``then``).

    ``checked``: compiled code checks indices; one out of range raises IndexError.
    """

    first: MemoryName
    then: MemoryName
    checked: bool = True


PLAIN, CHECKED, CHECKED_LATER = Plan("plain", "plain"), Plan("compiled", "compiled"), Plan("plain", "compiled")


@dataclass
class _ProcessState:
    """The state of this process, which chooses the memory of its runs."""

    kernels: dict[tuple[Callable[..., Any], bool], Any] = field(default_factory=dict)  #: by kernel and ``checked``
    failures: list[str] = field(default_factory=list)  #: why the compiled memory cannot be used
    short_work: int = 0  #: work of the runs so far that were short enough for the plain memory; at most PLAIN_WORK


PROCESS = _ProcessState()

_RUN_KERNELS = {
    False: (load_world, run_world, step_world, observe_object, trace_world, kill_ninja),
    True: (load_world, run_world),
}
"""The kernels that a run, or a judged run, may need: it moves to the compiled memory when all are there."""


class MemoryUnavailableError(NinjaGameError):
    """The compiled memory was asked for, but Numba is not installed, or its compiler is turned off."""


def compiled_available() -> bool:
    """Whether Numba is installed, with its compiler on. Without it everything works on the plain memory."""
    return (
        not PROCESS.failures
        and find_spec("numba") is not None
        and os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")
    )


def choose_memory(memory: str) -> MemoryName:
    """Resolve "plain", "compiled" or "auto" (compiled if available) to one of the first two.

    Raises MemoryUnavailableError for "compiled" without Numba, ArgumentError for another word.
    """
    if memory == "auto":
        return "compiled" if compiled_available() else "plain"
    if memory == "compiled":
        if not compiled_available():
            needs = f"the compiled memory needs Numba; {install_hint('fast')}, unset NUMBA_DISABLE_JIT"
            raise MemoryUnavailableError(
                f"{PROCESS.failures[0] if PROCESS.failures else needs}, or use the plain memory"
            )
        return "compiled"
    if memory == "plain":
        return "plain"
    raise ArgumentError(f"memory is {memory!r}; expected 'plain', 'compiled' or 'auto'")


def open_worlds(
    memory: str | Plan,
    levels: Level | Sequence[Level],
    count: int = 1,
    *,
    box: bool,
    at_once: bool = False,
    ticks: int = MAX_TICKS,
) -> Worlds:
    """Open ``count`` new worlds in one level or several, in a memory as for ``choose_memory``, or by a plan.

    ``at_once``: never wait for a compiler; "auto" then gives plain worlds if it would wait, or if ``ticks`` are little
    work. Raises LevelError for a level that cannot be played or is too large for a page, and what ``choose_memory`` and
    ``compiled`` raise.
    """
    several = [levels] if isinstance(levels, Level | str) else levels
    if _MAX_TICK_COST < NO_LIMIT and (cost := max(map(tick_cost, several), default=0)) > _MAX_TICK_COST:
        found, expected = f"work of {cost:,} a tick", f"at most {_MAX_TICK_COST:,}"
        raise LevelError("too many objects for a page", found=found, expected=expected, hint="play it on a desktop")
    # The first call imports Numba, which must come before NumPy.
    if not isinstance(memory, Plan):
        begins = False
        if at_once and memory == "auto":
            work = ticks * max(map(tick_cost, several), default=0)
            if begins := begins_on_plain(memory, work):
                count_run(work)
        memory = Plan("plain" if begins else _usable_memory(memory), "compiled", checked=False)
    if memory.first == "plain":
        return PlainWorlds(several, count, box=box)
    from ninja_game.backend.compiled import CompiledWorlds

    return CompiledWorlds(partial(compiled, checked=memory.checked), several, count, box=box)


def begins_on_plain(memory: str, work: int, *, checked: bool = False) -> bool:
    """Whether a run that begins now is on the plain memory: by "auto", and little work or without its kernels."""
    little = PROCESS.short_work + work <= PLAIN_WORK
    return _has_choice(memory, checked=checked) and (little or not kernels_ready(checked=checked))


def count_run(work: int, *, checked: bool = False) -> None:
    """Count a run that begins on the plain memory; or let a background process compile its missing kernels."""
    # More than little work is there for lack of kernels only.
    if PROCESS.short_work + work <= PLAIN_WORK and kernels_ready(checked=checked):
        PROCESS.short_work += work
    else:
        _start_compiler()


def _has_choice(memory: str, *, checked: bool) -> bool:
    """Whether a run may begin on either memory: by "auto", with kernels that this process has not loaded yet."""
    if memory != "auto" or not compiled_available():
        return False
    from ninja_game.backend import background_compiler

    return background_compiler.is_enabled() and (load_world, checked or _ALL_CHECKED) not in PROCESS.kernels


def compile_missing() -> None:
    """Let a background process compile the kernels of a run that are not compiled yet."""
    if compiled_available() and not kernels_ready(checked=False):
        _start_compiler()


def _start_compiler() -> None:
    from ninja_game.backend import background_compiler

    background_compiler.start()


def kernels_ready(*, checked: bool) -> bool:
    """Whether the kernels of a run have been made, or are in the cache."""
    from ninja_game.backend.kernel_cache import are_cached

    checked = _ALL_CHECKED or checked
    missing = [entry for entry in _RUN_KERNELS[checked] if (entry, checked) not in PROCESS.kernels]
    return not missing or are_cached(missing, checked)


def switch_to_compiled(worlds: Worlds, memory: str | Plan, ticks: int) -> Worlds:
    """Worlds that were opened ``at_once``, or, if ``ticks`` are worth it, copies of them in the compiled memory.

    Call it between two ticks. While kernels are being compiled it gives the same worlds; if no process compiles them
    any more, it compiles them itself. Raises SelfTestError as ``compiled`` does.
    """
    plan = memory if isinstance(memory, Plan) else Plan("plain", choose_memory(memory), checked=False)
    small = ticks * max(map(tick_cost, worlds.levels)) <= PLAIN_WORK
    if small or worlds.name == "compiled" or plan.then == "plain":
        return worlds
    from ninja_game.backend import background_compiler

    compiling = not kernels_ready(checked=plan.checked) and background_compiler.is_compiling()
    if compiling or _usable_memory("auto", checked=plan.checked) == "plain":
        return worlds
    from ninja_game.backend.compiled import compiled_copy

    return compiled_copy(partial(compiled, checked=plan.checked), worlds)


def _usable_memory(memory: str, *, checked: bool = False) -> MemoryName:
    """Like ``choose_memory``, with the compiled memory made ready; "auto" is plain if its Numba does not work."""
    if choose_memory(memory) == "plain":
        return "plain"
    try:
        compiled(load_world, checked=checked)
    except MemoryUnavailableError as error:
        if memory != "auto":
            raise
        from ninja_game.backend.numba_import import warn_once

        warn_once(f"{error}; this is the plain memory, which is slower")
        return "plain"
    return "compiled"


def proven_memory(memory: str, work: int = NO_LIMIT) -> Plan:
    """The plan for a judged run of this much work, after the known run has passed on its first memory.

    Raises SelfTestError if it does not pass, and what ``choose_memory`` raises.
    """
    begins = begins_on_plain(memory, work, checked=True)
    if begins:
        count_run(work, checked=True)
    elif _usable_memory(memory, checked=True) == "compiled":
        return CHECKED
    _prove_plain()
    return CHECKED_LATER if begins else PLAIN


@cache
def _prove_plain() -> None:
    check_self_test(lambda level, box: PlainWorlds([level], box=box), "plain")


def compiled(entry: Callable[..., R], *, checked: bool = False) -> Callable[..., R]:
    """The compiled twin of a kernel, which takes the same arguments. Any thread may call this.

    Raises MemoryUnavailableError without Numba, TypeError for a function that is not a kernel, SelfTestError if
    compiled worlds compute something else.
    """
    checked = checked or _ALL_CHECKED
    kernel: Callable[..., R] | None = PROCESS.kernels.get((entry, checked))
    if kernel is None:
        with _LOCK:
            make = _compiler(checked)
            if entry is load_world and (entry, checked) not in PROCESS.kernels:
                from ninja_game.backend.compiled import CompiledWorlds

                try:
                    check_self_test(lambda level, box: CompiledWorlds(make, [level], box=box), "compiled")
                except NinjaGameError:
                    raise
                except Exception as error:
                    raise _unusable("compile the rules", error) from error
            kernel = PROCESS.kernels[entry, checked] = make(entry)
    return kernel


def has_compiled_twin(entry: Callable[..., Any]) -> bool:
    """Whether this process has made the compiled twin of a kernel."""
    return (entry, _ALL_CHECKED) in PROCESS.kernels


def compiled_if_possible(entry: Callable[..., R]) -> Callable[..., R]:
    """The compiled twin of a kernel that only takes arrays of numbers; without Numba the function itself."""
    return compiled(entry) if _usable_memory("auto") == "compiled" else entry


@cache
def _compiler(checked: bool) -> Compiler:
    """One of the two compilers of this process. NINJA_GAME_CHECKED=1 leaves only the one that checks indices."""
    choose_memory("compiled")
    from ninja_game.backend.kernel_cache import attach_cache
    from ninja_game.backend.numba_import import import_numba, make_pipeline

    try:
        numba = import_numba()
        from ninja_game.backend.compiler import Compiler

        return Compiler(numba, checked=checked, attach_cache=attach_cache, pipeline=make_pipeline())
    except Exception as error:
        raise _unusable("be loaded", error) from error


def _unusable(what: str, error: Exception) -> MemoryUnavailableError:
    """Make the error for a failure of Numba; the compiled memory is not tried again."""
    PROCESS.failures.append(f"Numba cannot {what} ({type(error).__name__}: {error!s:.200}); install another version")
    return MemoryUnavailableError(f"{PROCESS.failures[-1]}, or use the plain memory")
