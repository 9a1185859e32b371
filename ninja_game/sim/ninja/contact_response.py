"""Contacts of the ninja: with a solid box; its push out of a contact, kept as floor or wall (ninja.md §5)."""

from __future__ import annotations

from ninja_game.sim.death import kill
from ninja_game.sim.rules import CRUSH, RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Header
from ninja_game.sim.schema.world_fields import Ninja, World
from ninja_game.sim.states import CRUSHED


@fast
def box_contact(n: Ninja, o: Header, half: float) -> tuple[float, float, float]:
    """The ninja's depth in a box around an object, px, and the normal of the nearest side; zeros outside it."""
    dy = n.y - o.y
    overlap_y = half + RADIUS - abs(dy)
    if not 0.0 < overlap_y:
        return 0.0, 0.0, 0.0
    dx = n.x - o.x
    overlap_x = half + RADIUS - abs(dx)
    if not 0.0 < overlap_x:
        return 0.0, 0.0, 0.0
    if overlap_y < overlap_x:
        return overlap_y, 0.0, -1.0 if dy < 0.0 else 1.0
    return overlap_x, -1.0 if dx < 0.0 else 1.0, 0.0


@fast
def push(n: Ninja, qx: float, qy: float, mx: float, my: float) -> None:
    """Apply a contact with an object: push (qx, qy) px, normal (mx, my). It never crushes."""
    n.x += qx
    n.y += qy
    note_normal(n, mx, my)


@fast
def push_from_tile(w: World, qx: float, qy: float, mx: float, my: float) -> None:
    """Apply a contact with a tile or solid edge: like ``push``, but a push above √80 px crushes and keeps no normal."""
    n = w.ninja
    n.x += qx
    n.y += qy
    if qx * qx + qy * qy > CRUSH:
        kill(w, CRUSHED, 0, 0.0, 0.0, n.x, n.y)
        return
    note_normal(n, mx, my)


@fast
def note_normal(n: Ninja, mx: float, my: float) -> None:
    """Classify a contact by its normal: wall (my = 0 exactly), floor, or ceiling (only the push)."""
    if my == 0.0:
        n.near_wall = 1
        n.wall_x = mx
        n.wall_y = my
    elif my < 0.0:
        if n.floor_contacts == 0:
            n.first_floor_x = mx
            n.first_floor_y = my
            n.floor_contacts = 1
        else:
            n.last_floor_x = mx
            n.last_floor_y = my
            n.floor_contacts = 2
