"""One-way platform (objects.md §8.5)."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.sim.collision.tiles import UNIT_X, UNIT_Y
from ninja_game.sim.grid import grid_insert
from ninja_game.sim.ninja.contact_response import box_contact, push
from ninja_game.sim.rules import ONE_WAY_HALF, RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import OneWay
from ninja_game.sim.schema.world_fields import World


@fast
def create_one_way(w: World, o: OneWay, values: Sequence[float]) -> None:
    """Face the direction of the record; a direction that does not exist counts as down."""
    o.face_x = 0.0
    o.face_y = 1.0
    for direction in range(4):
        if values[2] == direction:
            o.face_x = UNIT_X[direction]
            o.face_y = UNIT_Y[direction]
    grid_insert(w, o)


@fast
def touch_one_way(w: World, o: OneWay) -> None:
    """Hold a ninja that comes from the facing side and was on or outside the face in the last tick."""
    n = w.ninja
    if box_contact(n, o, ONE_WAY_HALF)[0] == 0.0:
        return
    if o.face_x == 0.0:
        face = o.face_y
        if (n.y - n.prev_y) * face <= 0.0:
            gap = n.prev_y - face * RADIUS - (o.y + face * ONE_WAY_HALF)
            if 0.0 <= gap * face:
                push(n, 0.0, o.y + face * ONE_WAY_HALF - (n.y - face * RADIUS), 0.0, face)
    else:
        face = o.face_x
        if (n.x - n.prev_x) * face <= 0.0:
            gap = n.prev_x - face * RADIUS - (o.x + face * ONE_WAY_HALF)
            if 0.0 <= gap * face:
                push(n, o.x + face * ONE_WAY_HALF - (n.x - face * RADIUS), 0.0, face, 0.0)
