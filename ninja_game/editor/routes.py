"""The ways of runs through a level, to be drawn over it."""

from __future__ import annotations

from ninja_game.errors import LevelError
from ninja_game.sim.level import Level
from ninja_game.simulation import Body, Simulation

Route = tuple[tuple[float, float], ...]
"""Where the ninja was after each tick, px."""


def route_of(level: Level, inputs: bytes, body: Body = "circle") -> Route:
    """The way of the ninja from its start to the end of the run or of the inputs; () for a level without one."""
    try:
        run = Simulation(level, body=body)
    except LevelError:
        return ()
    world = run.world
    way = [(world.ninja.x, world.ninja.y)]
    for keys in inputs:
        run.step_keys(keys)
        way.append((world.ninja.x, world.ninja.y))
        if run.outcome != "running":
            break
    return tuple(way)
