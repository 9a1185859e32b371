"""Choose the rule of an object's kind: at load, for contacts, in updates and in thinks (objects.md §2-§3).

Chains of ifs over small integers are the fastest choice in both memories. Reactions to a death or a win are in
``death.py``, the numbers that traces show in ``traces.py``, the numbers of the kinds in ``kinds.py``.
"""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.sim.kinds import (
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
    SWITCH,
    THWUMP,
    TURRET,
)
from ninja_game.sim.objects.bounce_block import create_block, think_block, touch_block, update_block
from ninja_game.sim.objects.door import create_door, touch_door, update_door
from ninja_game.sim.objects.drone import create_drone, move_drone
from ninja_game.sim.objects.drone_weapons import think_drone, touch_drone, update_weapon
from ninja_game.sim.objects.exit import create_exit, touch_exit, touch_switch
from ninja_game.sim.objects.floor_guard import create_guard, touch_guard, update_guard
from ninja_game.sim.objects.gold import create_gold, touch_gold
from ninja_game.sim.objects.launch_pad import create_pad, touch_pad
from ninja_game.sim.objects.launcher import create_launcher, think_launcher, touch_rocket, update_launcher
from ninja_game.sim.objects.mine import create_mine, touch_mine
from ninja_game.sim.objects.one_way import create_one_way, touch_one_way
from ninja_game.sim.objects.thwump import create_thwump, touch_thwump, update_thwump
from ninja_game.sim.objects.turret import create_turret, think_turret, update_turret
from ninja_game.sim.rules import STRIDE
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import DRONE_MOVE

NINE_CELLS = [0, STRIDE, STRIDE + 1, STRIDE - 1, -1, -STRIDE - 1, 1, -STRIDE + 1, -STRIDE]
"""The ninja's own cell, below, below right, below left, left, above left, right, above right, above."""


@fast
def create(tiles: TileMap, w: World, o: Object, values: Sequence[float]) -> None:
    """Create an object at load; its kind and place are set already. ``values``: the nine values of its record."""
    kind = o.kind
    if kind == GOLD:
        create_gold(w, o)
    elif kind == MINE:
        create_mine(w, o)
    elif kind == BOUNCE_BLOCK:
        create_block(w, o)
    elif kind == LAUNCH_PAD:
        create_pad(w, o, values)
    elif kind == ONE_WAY:
        create_one_way(w, o, values)
    elif kind == EXIT:
        create_exit(w, o, values)
    elif kind == TURRET:
        create_turret(w, o)
    elif kind == LAUNCHER:
        create_launcher(w, o)
    elif kind == DOOR:
        create_door(w, o, values)
    elif kind == THWUMP:
        create_thwump(tiles, w, o, values[2])
    elif kind == FLOOR_GUARD:
        create_guard(tiles, w, o)
    elif kind == DRONE:
        create_drone(w, o, values)


@fast
def touch_objects(w: World) -> None:
    """Test the ninja against every object in its own cell and the eight around it.

    Quirk: the link to the next object is read after the contact, so an object that leaves the grid ends the walk.
    """
    centre = w.ninja.cell
    if centre == 0:
        return
    heads = w.heads
    for offset in NINE_CELLS:
        slot = heads[centre + offset]
        while slot:
            o = w.objects[slot]
            touch(w, o)
            slot = o.next


@fast
def touch(w: World, o: Object) -> None:
    """Run the contact of one object with the ninja."""
    kind = o.kind
    if kind == GOLD:
        touch_gold(w, o)
    elif kind == MINE:
        touch_mine(w, o)
    elif kind == DRONE:
        touch_drone(w, o)
    elif kind == DOOR:
        touch_door(w, o)
    elif kind == ONE_WAY:
        touch_one_way(w, o)
    elif kind == LAUNCH_PAD:
        touch_pad(w, o)
    elif kind == FLOOR_GUARD:
        touch_guard(w, o)
    elif kind == THWUMP:
        touch_thwump(w, o)
    elif kind == BOUNCE_BLOCK:
        touch_block(w, o)
    elif kind == LAUNCHER:
        touch_rocket(w, o)
    elif kind == SWITCH:
        touch_switch(w, o)
    elif kind == EXIT:
        touch_exit(w, o)


@fast
def update_objects(tiles: TileMap, w: World) -> None:
    """Update all objects of the set. The cursor is in the world: an object that leaves the set meanwhile moves it."""
    slot = w.update_head
    while slot:
        o = w.objects[slot]
        w.update_cursor = o.older
        kind = o.kind
        if kind == DRONE:
            if o.routine == DRONE_MOVE:
                move_drone(w, o)
            else:
                update_weapon(tiles, w, o)
        elif kind == THWUMP:
            update_thwump(w, o)
        elif kind == FLOOR_GUARD:
            update_guard(w, o)
        elif kind == TURRET:
            update_turret(tiles, w, o)
        elif kind == LAUNCHER:
            update_launcher(tiles, w, o)
        elif kind == BOUNCE_BLOCK:
            update_block(o)
        elif kind == DOOR:
            update_door(w, o)
        slot = w.update_cursor


@fast
def think(tiles: TileMap, w: World, o: Object) -> None:
    """Run the think of one object."""
    kind = o.kind
    if kind == DRONE:
        think_drone(tiles, w, o)
    elif kind == TURRET:
        think_turret(tiles, w, o)
    elif kind == LAUNCHER:
        think_launcher(tiles, w, o)
    elif kind == BOUNCE_BLOCK:
        think_block(w, o)
