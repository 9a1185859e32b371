"""Bounce block (objects.md §8.3). It stays in the list of its anchor's cell, however far it is pushed."""

from __future__ import annotations

from ninja_game.sim.events import BLOCK_WOKEN, emit
from ninja_game.sim.grid import grid_insert
from ninja_game.sim.ninja.contact_response import box_contact, push
from ninja_game.sim.rules import BLOCK_DRAG, BLOCK_HALF, BLOCK_SHARE, BLOCK_SLEEP, BLOCK_SPRING, NINJA_SHARE
from ninja_game.sim.schedule import end_think, end_update, start_think, start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import BounceBlock
from ninja_game.sim.schema.world_fields import World


@fast
def create_block(w: World, o: BounceBlock) -> None:
    """Place it on its anchor, at rest and asleep."""
    o.anchor_x = o.prev_x = o.x
    o.anchor_y = o.prev_y = o.y
    grid_insert(w, o)


@fast
def touch_block(w: World, o: BounceBlock) -> None:
    """Box contact: four fifths of the overlap move the block, one fifth moves the ninja.

    Do not change the block's old place: the next update reads the displacement as velocity.
    """
    n = w.ninja
    depth, mx, my = box_contact(n, o, BLOCK_HALF)
    if depth == 0.0:
        return
    o.x = o.x - BLOCK_SHARE * (mx * depth)
    o.y = o.y - BLOCK_SHARE * (my * depth)
    push(n, NINJA_SHARE * (mx * depth), NINJA_SHARE * (my * depth), mx, my)
    o.counter = 0
    if not o.updating:
        start_update(w, o)
        start_think(w, o)
        emit(w, BLOCK_WOKEN, o.slot, o.x, o.y, 0.0, 0.0)


@fast
def update_block(o: BounceBlock) -> None:
    """Verlet step with drag; then the spring pulls it to the anchor."""
    vx = o.x - o.prev_x
    vy = o.y - o.prev_y
    o.prev_x = o.x
    o.prev_y = o.y
    o.x = o.x + BLOCK_DRAG * vx
    o.y = o.y + BLOCK_DRAG * vy
    ex = o.anchor_x - o.x
    ey = o.anchor_y - o.y
    if 0.0 < ex * ex + ey * ey:
        o.x = o.x + ex * BLOCK_SPRING
        o.y = o.y + ey * BLOCK_SPRING
    o.counter += 1


@fast
def think_block(w: World, o: BounceBlock) -> None:
    """Fall asleep after a second without contact. It stays where it is: it does not return to the anchor."""
    if o.counter > BLOCK_SLEEP:
        end_update(w, o)
        end_think(w, o)
        o.prev_x = o.x
        o.prev_y = o.y
