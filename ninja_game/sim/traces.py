"""What a trace shows of an object: its place and one number, by kind."""

from __future__ import annotations

from ninja_game.sim import kinds
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import AUTOMATIC, LAUNCHER_FLIGHT, THWUMP_REST


def is_traced(w: World, slot: int) -> bool:
    """Whether traces show an object: ninjas and inert objects are left out."""
    return kinds.KIND_OF[w.objects[slot].kind].traced


@fast
def contact_place_of(o: Object) -> tuple[float, float]:
    """The place where an object is touched, px: a launcher's rocket, a door's switch (automatic: its middle)."""
    if o.kind == kinds.LAUNCHER and o.routine != LAUNCHER_FLIGHT:
        return o.base_x, o.base_y
    return o.x, o.y


@fast
def place_of(w: World, slot: int) -> tuple[float, float]:
    """An object's place, px: a turret's aim point, a launcher's rocket in flight, the grid point of a door."""
    o = w.objects[slot]
    if o.kind == kinds.TURRET:
        return o.aim_x, o.aim_y
    return contact_place_of(o)


@fast
def is_switched(w: World, slot: int) -> int:
    """1 for a door that is not in its first state, else 0. ``status_of`` also changes without a switch."""
    o = w.objects[slot]
    return o.switched if o.kind == kinds.DOOR else 0


@fast
def is_open(w: World, slot: int) -> int:
    """1 for an open exit, and for a door that is not in its first state."""
    o = w.objects[slot]
    return o.is_open if o.kind == kinds.EXIT else is_switched(w, slot)


@fast
def status_of(w: World, slot: int) -> int:
    """An object's activity as one number (table in docs/replay-format.md)."""
    o = w.objects[slot]
    kind = o.kind
    if kind == kinds.GOLD:
        return 1 - o.taken
    if kind == kinds.MINE:
        return 1 - o.exploded
    if kind == kinds.DRONE:
        direction = o.direction if 0 <= o.direction <= 3 else 9
        return o.routine * 100 + o.chasing * 10 + direction
    if kind == kinds.DOOR:
        first = w.edges[o.edge_1] if o.edge_1 else 9
        second = w.edges[o.edge_2] if o.edge_2 else 9
        counter = o.counter if o.mechanism == AUTOMATIC else 0
        return 100 * counter + 10 * int(first) + int(second)
    if kind == kinds.THWUMP:
        if o.routine == THWUMP_REST:
            return 0
        return 1 if o.sign > 0.0 else 2
    if kind == kinds.FLOOR_GUARD:
        return 1 if o.routine and o.updating else 0
    if kind == kinds.TURRET:
        return o.routine if o.updating else 0
    if kind == kinds.BOUNCE_BLOCK:
        return o.updating
    if kind == kinds.LAUNCHER:
        return o.routine
    if kind == kinds.EXIT:
        return o.is_open
    return 0
