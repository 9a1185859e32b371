"""The order of objects: update set (newest first), thinker ring (one think every fourth tick): objects.md §2.3-§2.4."""

from __future__ import annotations

from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Header
from ninja_game.sim.schema.world_fields import World


@fast
def start_update(w: World, o: Header) -> None:
    """Make an object the newest member of the update set, if it is not in it."""
    if o.updating:
        return
    o.updating = 1
    o.newer = 0
    o.older = w.update_head
    if w.update_head:
        w.objects[w.update_head].newer = o.slot
    w.update_head = o.slot


@fast
def end_update(w: World, o: Header) -> None:
    """Take an object out of the update set. ``w.update_cursor``, the place of the pass, moves along."""
    if not o.updating:
        return
    o.updating = 0
    if w.update_cursor == o.slot:
        w.update_cursor = o.older
    if o.newer:
        w.objects[o.newer].older = o.older
    else:
        w.update_head = o.older
    if o.older:
        w.objects[o.older].newer = o.newer


@fast
def start_think(w: World, o: Header) -> None:
    """Insert an object right before the cursor of the thinker ring and move the cursor to it: it thinks next."""
    if o.thinking:
        return
    o.thinking = 1
    if w.think_cursor:
        successor = w.objects[w.think_cursor]
        o.ring_prev = successor.ring_prev
        o.ring_next = w.think_cursor
        w.objects[o.ring_prev].ring_next = o.slot
        successor.ring_prev = o.slot
    else:
        o.ring_prev = o.slot
        o.ring_next = o.slot
    w.think_cursor = o.slot


@fast
def end_think(w: World, o: Header) -> None:
    """Take an object out of the thinker ring; if the cursor was on it, the cursor goes to its successor."""
    if not o.thinking:
        return
    o.thinking = 0
    if o.ring_next == o.slot:
        w.think_cursor = 0
    else:
        w.objects[o.ring_prev].ring_next = o.ring_next
        w.objects[o.ring_next].ring_prev = o.ring_prev
        if w.think_cursor == o.slot:
            w.think_cursor = o.ring_next
