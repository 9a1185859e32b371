"""One tick of the whole world (objects.md §2.5, game.md §1.2)."""

from __future__ import annotations

from ninja_game.sim.level import BOUNCE_BLOCK, DOOR, DRONE, FLOOR_GUARD, LAUNCHER, THWUMP, TURRET
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.ninja.tick import tick_ninja
from ninja_game.sim.objects.bounce_block import think_block, update_block
from ninja_game.sim.objects.door import update_door
from ninja_game.sim.objects.drone import move_drone
from ninja_game.sim.objects.drone_weapons import think_drone, update_weapon
from ninja_game.sim.objects.floor_guard import update_guard
from ninja_game.sim.objects.launcher import think_launcher, update_launcher
from ninja_game.sim.objects.thwump import update_thwump
from ninja_game.sim.objects.turret import think_turret, update_turret
from ninja_game.sim.rules import THINK_PAUSE
from ninja_game.sim.states import DEAD, DRONE_MOVE


@fast
def step(level: TileMap, w: World, keys: int) -> None:
    """Advance the world by one tick. ``keys``: those of this tick, a sum of ``Input`` flags."""
    w.event_count = 0
    # 1. All objects in the update set, the most recently started first.
    if w.update_head:
        update_objects(level, w)
    # 2. At most one of those that think: one every fourth tick.
    if w.think_cursor:
        if w.think_counter >= THINK_PAUSE:
            w.think_counter = 0
            think(level, w, w.think_cursor)
            if w.think_cursor:
                w.think_cursor = w.objects[w.think_cursor].ring_next
        else:
            w.think_counter += 1
    # 3. The ninja, which asks the nine cells for objects and the touched cells for tiles.
    if w.ninja.state != DEAD:
        tick_ninja(level, w, keys)
    w.tick += 1


@fast
def update_objects(level: TileMap, w: World) -> None:
    """The update pass. The cursor lives in the world, so that an object ended meanwhile can move it along."""
    slot = w.update_head
    while slot:
        o = w.objects[slot]
        w.update_cursor = o.older
        kind = o.kind
        if kind == DRONE:
            if o.routine == DRONE_MOVE:
                move_drone(w, o, slot)
            else:
                update_weapon(level, w, o, slot)
        elif kind == THWUMP:
            update_thwump(w, o, slot)
        elif kind == FLOOR_GUARD:
            update_guard(w, o, slot)
        elif kind == TURRET:
            update_turret(level, w, o, slot)
        elif kind == LAUNCHER:
            update_launcher(level, w, o, slot)
        elif kind == BOUNCE_BLOCK:
            update_block(o)
        elif kind == DOOR:
            update_door(w, o, slot)
        slot = w.update_cursor


@fast
def think(level: TileMap, w: World, slot: int) -> None:
    """The think of one object, by kind."""
    o = w.objects[slot]
    kind = o.kind
    if kind == DRONE:
        think_drone(level, w, o, slot)
    elif kind == TURRET:
        think_turret(level, w, o, slot)
    elif kind == LAUNCHER:
        think_launcher(level, w, o, slot)
    elif kind == BOUNCE_BLOCK:
        think_block(w, o, slot)
