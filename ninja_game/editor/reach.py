"""What the ninja can reach from a place in a level under edit."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile
from math import isfinite
from typing import Any, NamedTuple

from ninja_game.backend.memories import compiled_available, open_worlds
from ninja_game.editor.draft import Draft
from ninja_game.editor.playtests import TICKS, PathPoints, with_ninja_at
from ninja_game.errors import NinjaGameError
from ninja_game.runtime import install_hint
from ninja_game.sim.grid import Point
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEY_LEFT, KEY_RIGHT
from ninja_game.sim.kinds import MOVING_ENEMIES
from ninja_game.sim.rules import TOP_SPEED, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.states import FALLING, JUMPING, OUTCOME_DEAD

STARTS = {"off": None, "standing": 0.0, "running right": TOP_SPEED, "running left": -TOP_SPEED}
"""Speeds at the start to the right, px/tick; "off": nothing is shown."""

SQUARE = 4.0  # side of the squares in which reached places are shown, px
SquareRow = tuple[float, float, float]  # squares side by side: left edge, top, width, px


class Ask(NamedTuple):
    """The start of the runs: a point, px, and the speed to the right, px/tick."""

    draft: Draft
    place: Point
    speed: float


class Reach(NamedTuple):
    """What the ninja can reach from a place. ``spans``: of its centre; ``deaths``: its deaths there.

    ``arcs``: some of the jumps. ``latest``: the last places to jump from before the floor ends under a runner.
    ``dangers``: the routes of drones, guards, thwumps and rockets while the ninja presses nothing.
    """

    ask: Ask
    spans: tuple[SquareRow, ...]
    deaths: tuple[SquareRow, ...]
    arcs: tuple[PathPoints, ...]
    latest: PathPoints
    dangers: tuple[PathPoints, ...]


LANDED_TICK = 4  # the first tick in which a ninja that was placed on the floor stands and can jump
_BOUNCE = 9  # ticks for which jumps at walls hold the jump key


class _Plan(NamedTuple):
    """The keys of one run: ``run`` until it jumps at tick ``jump`` and holds that key ``hold`` ticks, ``steer`` then.

    Directions are -1, 0 or 1. ``wall``: jump again at each wall touched in the air, away from it if 1, up it if 2; 0:
    slide.
    """

    run: int
    jump: int = TICKS
    hold: int = 0
    steer: int = 0
    wall: int = 0


def _fan() -> Iterator[_Plan]:
    """All runs to try; the first presses nothing, the last ones jump at walls."""
    yield from (_Plan(side, steer=side) for side in (0, -1, 1))
    for steer in (-1, 0, 1):
        yield from (_Plan(0, jump, hold, steer) for jump in (LANDED_TICK, 20) for hold in (1, 3, 6, 10, 16, TICKS))
        for side in (-1, 1):
            yield from (_Plan(side, jump, TICKS, steer) for jump in range(1, TICKS))
            yield from (_Plan(side, jump, hold, steer) for jump in range(1, TICKS, 3) for hold in (1, 4, 9))
    for side in (-1, 1):
        yield from (_Plan(side, jump, _BOUNCE, side, wall) for jump in range(1, TICKS, 4) for wall in (1, 2))


FAN = tuple(_fan())
_FIRST_WALL = next(number for number, plan in enumerate(FAN) if plan.wall)


def find_reach(ask: Ask) -> Reach:
    """Run the fan. Raises LevelError for a level that cannot be played, NinjaGameError without Numba."""
    if not compiled_available():
        raise NinjaGameError(f"What can be reached needs Numba: {install_hint('fast')}")
    worlds = open_worlds("compiled", with_ninja_at(ask.draft, ask.place), len(FAN), box=False)
    import numpy as np

    ninja = worlds.records["ninja"]
    ninja["prev_x"] -= ask.speed
    going, jump, hold, steer, wall = np.array(FAN, np.int16).T
    climbers, climbing = ninja[_FIRST_WALL:], wall[_FIRST_WALL:]
    places, states = np.empty((TICKS + 1, len(FAN), 2)), np.empty((TICKS + 1, len(FAN)), np.uint8)
    objects = worlds.records["objects"][0, : int(worlds.records["slots_used"][0])]
    dangers = np.flatnonzero(np.isin(objects["kind"], MOVING_ENEMIES))
    clock = np.empty((TICKS + 1, len(dangers), 2))
    until, bounces = np.zeros(len(FAN), np.int16), np.zeros(len(FAN), bool)
    for tick in range(TICKS + 1):
        places[tick, :, 0], places[tick, :, 1], states[tick] = ninja["x"], ninja["y"], ninja["state"]
        clock[tick, :, 0], clock[tick, :, 1] = objects["x"][dangers], objects["y"][dangers]
        there = (climbers["near_wall"] > 0) & (climbers["in_air"] > 0) & (tick > jump[_FIRST_WALL:] + 4)
        bounces[_FIRST_WALL:] = there & (until[_FIRST_WALL:] < tick)
        going = np.where(jump == tick, steer, going)
        going[_FIRST_WALL:] = np.where(there & (climbing == 1), np.sign(climbers["wall_x"]), going[_FIRST_WALL:])
        begins = (jump == tick) | bounces
        until = np.where(begins, tick + np.where(bounces, _BOUNCE, hold), until)
        down = until > tick
        keys = np.select([going < 0, going > 0], [KEY_LEFT, KEY_RIGHT], 0)
        keys += down * JUMP_HELD + begins * JUMP_PRESSED
        worlds.run_batch(np.require(keys[np.newaxis], np.uint8, ["C", "W"]), 0, len(FAN), stop=True)
    latest: list[Point] = []
    shown = [*(FAN.index(_Plan(0, LANDED_TICK, hold, steer)) for steer in (-1, 0, 1) for hold in (1, TICKS))]
    for side in (-1, 1):
        walks = FAN.index(_Plan(side, steer=side))
        jumps = [FAN.index(_Plan(side, tick, TICKS, side)) for tick in range(1, TICKS)]
        shown.append(walks)
        gone = states[:, walks] == FALLING
        falls = [t for t in range(1, TICKS - 3) if gone[t : t + 4].all() and not gone[t - 1]]
        before = [n for n in jumps if falls and FAN[n].jump <= falls[0] and states[FAN[n].jump + 1, n] == JUMPING]
        if before:
            late = FAN[before[-1]].jump
            latest += _route(places[late : late + 1, walks])
            shown.append(before[-1])
    ends = places[-1][worlds.records["outcome"] == OUTCOME_DEAD]
    return Reach(
        ask,
        _spans(places.reshape(-1, 2)),
        _spans(ends),
        tuple(_route(places[:, n]) for n in shown),
        tuple(latest),
        tuple(_route(clock[:, n]) for n in range(len(dangers))),
    )


def _route(places: Any) -> PathPoints:
    """The points of an array (ticks, 2) up to the first NaN."""
    return tuple(takewhile(lambda point: isfinite(sum(point)), map(tuple, places.tolist())))


def _spans(places: Any) -> tuple[SquareRow, ...]:
    """The squares with any of these points (points, 2) in the level, merged where they touch."""
    import numpy as np

    columns = int(WORLD_WIDTH // SQUARE) + 1
    inside = places[((places >= 0) & (places < (WORLD_WIDTH, WORLD_HEIGHT))).all(axis=1)]
    cells = np.unique((inside // SQUARE).astype(np.intp) @ (1, columns))
    rows = np.split(cells, np.flatnonzero(np.diff(cells) > 1) + 1) if len(cells) else []
    return tuple((SQUARE * (row[0] % columns), SQUARE * (row[0] // columns), SQUARE * len(row)) for row in rows)
