"""What an object of each kind does when a level is loaded (objects.md §8)."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.sim.collision.tiles import UNIT_X, UNIT_Y
from ninja_game.sim.grid import grid_insert
from ninja_game.sim.level import (
    BOUNCE_BLOCK,
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    LAUNCH_PAD,
    LAUNCHER,
    MINE,
    ONE_WAY,
    THWUMP,
    TURRET,
)
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import Object, TileMap, World
from ninja_game.sim.objects.door import create_door
from ninja_game.sim.objects.drone import create_drone
from ninja_game.sim.objects.exit import create_switch
from ninja_game.sim.objects.floor_guard import create_guard
from ninja_game.sim.objects.thwump import create_thwump
from ninja_game.sim.rules import ROCKET_HEADING_X, ROCKET_HEADING_Y
from ninja_game.sim.schedule import start_think


@fast
def create(level: TileMap, w: World, o: Object, slot: int, p: Sequence[float]) -> None:
    """What an object does at load, by kind; its kind and place are set."""
    kind = o.kind
    if kind == GOLD or kind == MINE:
        grid_insert(w, o, slot)
    elif kind == BOUNCE_BLOCK:
        o.anchor_x = o.prev_x = o.x
        o.anchor_y = o.prev_y = o.y
        grid_insert(w, o, slot)
    elif kind == LAUNCH_PAD:
        o.face_x = p[2]
        o.face_y = p[3]
        grid_insert(w, o, slot)
    elif kind == ONE_WAY:
        o.face_x = 0.0
        o.face_y = 1.0
        for direction in range(4):
            if p[2] == direction:
                o.face_x = UNIT_X[direction]
                o.face_y = UNIT_Y[direction]
        grid_insert(w, o, slot)
    elif kind == EXIT:
        create_switch(w, o, slot, p[2], p[3])
    elif kind == TURRET:
        o.aim_x = o.x
        o.aim_y = o.y
        start_think(w, o, slot)
    elif kind == LAUNCHER:
        o.base_x = o.x
        o.base_y = o.y
        o.heading_x = ROCKET_HEADING_X
        o.heading_y = ROCKET_HEADING_Y
        start_think(w, o, slot)
    elif kind == DOOR:
        create_door(w, o, slot, p)
    elif kind == THWUMP:
        create_thwump(level, w, o, slot, p[2])
    elif kind == FLOOR_GUARD:
        create_guard(level, w, o, slot)
    elif kind == DRONE:
        create_drone(w, o, slot, p)
