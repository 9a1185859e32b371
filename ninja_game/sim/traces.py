"""What a trace shows of every object: place and one number, by kind."""

from __future__ import annotations

from ninja_game.sim.level import (
    BOUNCE_BLOCK,
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    LAUNCHER,
    MINE,
    NINJA,
    THWUMP,
    TURRET,
)
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import INERT, World
from ninja_game.sim.states import AUTOMATIC, LAUNCHER_FLIGHT, THWUMP_REST


@fast
def is_traced(w: World, slot: int) -> bool:
    """Ninjas and inert objects do not show in traces."""
    kind = w.objects[slot].kind
    return kind != NINJA and kind != INERT


@fast
def place_of(w: World, slot: int) -> tuple[float, float]:
    """Where an object is, px: a turret's aim point, the rocket in flight of a launcher, the filing point of a door."""
    o = w.objects[slot]
    if o.kind == TURRET:
        return o.aim_x, o.aim_y
    if o.kind == LAUNCHER and o.routine != LAUNCHER_FLIGHT:
        return o.base_x, o.base_y
    return o.x, o.y


@fast
def status_of(w: World, slot: int) -> int:
    """What an object is doing, as one number (the table is in docs/replay-format.md)."""
    o = w.objects[slot]
    kind = o.kind
    if kind == GOLD or kind == MINE:
        return 1 - o.spent
    if kind == DRONE:
        direction = o.direction if 0 <= o.direction <= 3 else 9
        return o.routine * 100 + o.chasing * 10 + direction
    if kind == DOOR:
        first = w.edges[o.edge_1] if o.edge_1 else 9
        second = w.edges[o.edge_2] if o.edge_2 else 9
        counter = o.counter if o.mechanism == AUTOMATIC else 0
        return 100 * counter + 10 * int(first) + int(second)
    if kind == THWUMP:
        if o.routine == THWUMP_REST:
            return 0
        return 1 if o.sign > 0.0 else 2
    if kind == FLOOR_GUARD:
        return 1 if o.routine and o.updating else 0
    if kind == TURRET:
        return o.routine if o.updating else 0
    if kind == BOUNCE_BLOCK:
        return o.updating
    if kind == LAUNCHER:
        return o.routine
    if kind == EXIT:
        return o.spent
    return 0
