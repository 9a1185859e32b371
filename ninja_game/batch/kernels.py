"""What batches call of the compiled memory: a range of worlds, some ticks each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.world import step


@entry_point
def run_worlds(
    levels: Sequence[TileMap],
    level_of: Any,
    worlds: Sequence[World],
    inputs: Any,
    first: int,
    last: int,
    stop: int,
) -> int:
    """Run worlds ``first`` … ``last`` - 1, each for all rows of ``inputs`` (ticks x worlds); the number of ticks run.

    ``level_of``: which level each world plays. ``stop``: leave worlds alone whose exit contact or death has been. World
    after world, not tick after tick: so a world stays in the processor's cache while its ticks run.
    """
    ticks = 0
    for index in range(first, last):
        level = levels[level_of[index]]
        w = worlds[index]
        for tick in range(len(inputs)):
            if stop and w.outcome:
                break
            step(level, w, int(inputs[tick, index]))
            ticks += 1
    return ticks
