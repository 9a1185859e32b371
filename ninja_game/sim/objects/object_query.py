"""The ninja's collision query: the lists of nine cells, and what touching each kind does (objects.md §3)."""

from __future__ import annotations

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
)
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import SWITCH, World
from ninja_game.sim.objects.bounce_block import touch_block
from ninja_game.sim.objects.door import touch_door
from ninja_game.sim.objects.drone_weapons import touch_drone
from ninja_game.sim.objects.exit import touch_exit, touch_switch
from ninja_game.sim.objects.floor_guard import touch_guard
from ninja_game.sim.objects.gold import touch_gold
from ninja_game.sim.objects.launch_pad import touch_pad
from ninja_game.sim.objects.launcher import touch_rocket
from ninja_game.sim.objects.mine import touch_mine
from ninja_game.sim.objects.one_way import touch_one_way
from ninja_game.sim.objects.thwump import touch_thwump
from ninja_game.sim.rules import STRIDE

NINE_CELLS = [0, STRIDE, STRIDE + 1, STRIDE - 1, -1, -STRIDE - 1, 1, -STRIDE + 1, -STRIDE]
"""Own, below, below right, below left, left, above left, right, above right, above."""


@fast
def touch_objects(w: World) -> None:
    """Test the ninja against everything filed in the nine cells about its registered cell.

    The link to the next object is read after the contact: one that unfiles itself ends the walk of its list (quirk).
    """
    centre = w.ninja.cell
    if centre == 0:
        return
    heads = w.heads
    for step in NINE_CELLS:
        slot = heads[centre + step]
        while slot:
            touch(w, slot)
            slot = w.objects[slot].next


@fast
def touch(w: World, slot: int) -> None:
    """The contact of one object, by kind."""
    o = w.objects[slot]
    kind = o.kind
    if kind == GOLD:
        touch_gold(w, o, slot)
    elif kind == MINE:
        touch_mine(w, o, slot)
    elif kind == DRONE:
        touch_drone(w, o)
    elif kind == DOOR:
        touch_door(w, o, slot)
    elif kind == ONE_WAY:
        touch_one_way(w, o)
    elif kind == LAUNCH_PAD:
        touch_pad(w, o, slot)
    elif kind == FLOOR_GUARD:
        touch_guard(w, o)
    elif kind == THWUMP:
        touch_thwump(w, o)
    elif kind == BOUNCE_BLOCK:
        touch_block(w, o, slot)
    elif kind == LAUNCHER:
        touch_rocket(w, o, slot)
    elif kind == SWITCH:
        touch_switch(w, o)
    elif kind == EXIT:
        touch_exit(w, o)
