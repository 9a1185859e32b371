"""`ninja-game compile`: all kernels of all commands are compiled at once, and kept."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from importlib.util import find_spec
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ninja_game.sim.level import Level

LEVEL = "0" * 713 + "|5^100,566!11^160,564,130,564!0^115,566"
"""The level that is played so that kernels are compiled; machine code does not depend on it."""

MOST_PROCESSES = 2
"""Each compiles the rules again for what it makes of them; more would only wait for each other."""

EVERY = 0.5
"""Seconds between two looks whether another process is done."""


@click.command(name="compile")
@click.option("--background", is_flag=True, help="At low priority; nothing where another process is at it.")
def compile(background: bool) -> None:  # noqa: A001 - the name of the command
    """Compile the rules for this machine now, so that no other command waits for it.

    What is there already is not compiled again. Commands and the game start the same by themselves, in the background;
    with NINJA_GAME_BACKGROUND_COMPILER=0 in the environment they do not, and wait where they need it.

    \b
    Examples:
      ninja-game compile
      NINJA_GAME_BACKGROUND_COMPILER=0 ninja-game verify levels/certificates
    """
    from ninja_game.backend.background_compiler import hold_work, step_back
    from ninja_game.backend.kernel_cache import before_compiling

    # This command says itself what it does.
    before_compiling.clear()
    handle = hold_work()
    if background:
        if handle is None:
            return
        step_back()
    elif handle is None:
        click.echo("Another process compiles; waiting for it", err=True)
        while (handle := hold_work()) is None:
            time.sleep(EVERY)
    try:
        compile_everything(min(MOST_PROCESSES, os.cpu_count() or 1), quiet=background)
    finally:
        os.close(handle)


def compile_everything(processes: int, *, quiet: bool) -> None:
    """Do a little of all work that needs kernels, most wanted first, in so many processes.

    Raises NinjaGameError where nothing is kept.
    """
    from ninja_game.backend.kernel_cache import are_kept, cache_folder
    from ninja_game.errors import NinjaGameError
    from ninja_game.runs.workers import in_order, workers
    from ninja_game.sim.memory.kernels import run_world

    began = time.monotonic()
    with workers(processes, processes=processes > 1) as pool:
        for number, (name, lost) in enumerate(in_order(pool, compile_for, WORK), 1):
            if lost is not None:
                raise lost
            if number == 1 and not any(are_kept([run_world], checked) for checked in (False, True)):
                where = cache_folder()
                raise NinjaGameError(f"compiled code is not kept in {where}: make room there, or let it be written")
            if not quiet:
                click.echo(f"{number} of {len(WORK)} compiled: {name}", err=True)
    if not quiet:
        click.echo(f"All is compiled, in {time.monotonic() - began:.0f} s: {cache_folder()}")


def compile_for(name: str) -> None:
    """Do a little work of that name: its kernels are in the cache then."""
    from ninja_game.formats.n14.level_string import parse_level_string

    WORK[name](parse_level_string(LEVEL))


def _runs(level: Level) -> None:
    from ninja_game.backend.memories import open_worlds
    from ninja_game.sim.states import NO_CAUSE

    worlds = open_worlds("compiled", level, box=False)
    worlds.run(b"\0")
    worlds.trace(b"\0", [worlds.observe(1)[0]], events=True)
    worlds.step(0)
    worlds.kill(NO_CAUSE, 0.0, 0.0)


def _verdicts(_: Level) -> None:
    from ninja_game.backend.memories import proven_memory

    proven_memory("compiled")


def _many_worlds(level: Level) -> None:
    from ninja_game.batch.difficulty import difficulty

    difficulty(level, b"\2" * 20, tries=1)


def _solver(_: Level) -> None:
    from ninja_game.search.solve import compile_solver

    compile_solver()


def _spans(level: Level) -> None:
    from ninja_game.search.formula.methods import search_span
    from ninja_game.search.formula.task import SpanTask

    search_span(SpanTask(level, b"\2" * 9, 0, 9, measure="x"), lambda *_: False)


def _observations(level: Level) -> None:
    if find_spec("gymnasium") is None:
        return
    import numpy as np

    from ninja_game.learn.worlds import EnvWorlds

    worlds = EnvWorlds(level, 1)
    worlds.reset()
    worlds.step(np.zeros(1, np.uint8))


WORK: dict[str, Callable[[Level], None]] = {
    "runs and traces": _runs,
    "verdicts": _verdicts,
    "many worlds": _many_worlds,
    "the solver": _solver,
    "searches in spans of runs": _spans,
    "what agents observe": _observations,
}
"""Work by its name, in the order in which it is done."""
