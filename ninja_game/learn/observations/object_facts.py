"""What is observed of an object: whether it is there, where, how fast, which way it faces, what it does."""

from __future__ import annotations

from ninja_game.sim import kinds
from ninja_game.sim.collision.tiles import UNIT_X, UNIT_Y
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import CHASE_PACE, GUARD_SPEED, WORLD_WIDTH
from ninja_game.sim.states import (
    DRONE_MOVE,
    GUARD_CHASE,
    LAUNCHER_FLIGHT,
    LAUNCHER_IDLE,
    THWUMP_MOVE,
    TRAP,
)

MOST_ROUTINES = 3.0
"""The highest number of a drone's or a turret's routine."""


@fast
def is_there(w: World, o: Object) -> bool:
    """Whether there is anything left of an object."""
    if o.kind == kinds.GOLD:
        return o.taken == 0
    if o.kind == kinds.MINE:
        return o.exploded == 0
    if o.kind == kinds.SWITCH:
        return w.objects[o.partner].is_open == 0
    return True


@fast
def place_of(o: Object) -> tuple[float, float]:
    """Where an object is, px: of a launcher its rocket in flight, of a door its switch (automatic: its middle)."""
    if o.kind == kinds.LAUNCHER and o.routine != LAUNCHER_FLIGHT:
        return o.base_x, o.base_y
    return o.x, o.y


@fast
def velocity_of(o: Object) -> tuple[float, float]:
    """How it moves, px/tick, as far as it tells: what has no speed of its own is at rest."""
    if o.kind == kinds.BOUNCE_BLOCK:
        return o.x - o.prev_x, o.y - o.prev_y
    if o.kind == kinds.THWUMP and o.routine == THWUMP_MOVE:
        return o.sign * o.face_x * o.speed, o.sign * o.face_y * o.speed
    if o.kind == kinds.FLOOR_GUARD and o.routine == GUARD_CHASE and o.updating:
        return o.facing * GUARD_SPEED, 0.0
    if o.kind == kinds.LAUNCHER and o.routine == LAUNCHER_FLIGHT:
        return o.speed * o.heading_x, o.speed * o.heading_y
    if o.kind == kinds.DRONE and o.routine == DRONE_MOVE and o.updating and 0 <= o.direction <= 3:
        speed = o.speed * CHASE_PACE if o.chasing else o.speed
        return UNIT_X[o.direction] * speed, UNIT_Y[o.direction] * speed
    return 0.0, 0.0


@fast
def face_of(o: Object) -> tuple[float, float]:
    """The way it faces: a normal, the way a drone goes or a thwump falls; of a turret the way to its crosshair.

    All are about unit vectors but the last: that is a share of the world's width.
    """
    if o.kind == kinds.LAUNCH_PAD or o.kind == kinds.ONE_WAY or o.kind == kinds.THWUMP:
        return o.face_x, o.face_y
    if o.kind == kinds.DRONE and 0 <= o.direction <= 3:
        return UNIT_X[o.direction], UNIT_Y[o.direction]
    if o.kind == kinds.TURRET:
        return (o.aim_x - o.x) / WORLD_WIDTH, (o.aim_y - o.y) / WORLD_WIDTH
    return 0.0, 0.0


@fast
def moment_of(o: Object) -> float:
    """What it is doing, one number.

    Exit: 1 open. Door: 1 closed. Thwump: 1 falls, -1 rises. Guard: 1 runs. Bounce block: 1 moves. Rocket: 1 flies,
    1/2 before. Drone: 1/3 before it fires, 2/3 firing, 1 after. Turret: 1/3 aims, 2/3 before it fires, 1 after. Else 0.
    """
    kind = o.kind
    if kind == kinds.EXIT:
        return float(o.is_open)
    if kind == kinds.DOOR:
        return float(o.switched) if o.mechanism == TRAP else 1.0 - o.switched
    if kind == kinds.THWUMP:
        return o.sign if o.routine == THWUMP_MOVE else 0.0
    if kind == kinds.FLOOR_GUARD:
        return 1.0 if o.routine == GUARD_CHASE and o.updating else 0.0
    if kind == kinds.BOUNCE_BLOCK:
        return float(o.updating)
    if kind == kinds.LAUNCHER:
        return 1.0 if o.routine == LAUNCHER_FLIGHT else 0.0 if o.routine == LAUNCHER_IDLE else 0.5
    if kind == kinds.DRONE or kind == kinds.TURRET:
        return float(o.routine) / MOST_ROUTINES if o.updating else 0.0
    return 0.0
