"""Launch pad (objects.md §8.4) and its effect on the ninja (ninja.md §10)."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from ninja_game.sim.events import LAUNCHED, emit
from ninja_game.sim.grid import grid_insert
from ninja_game.sim.rules import PAD_RADIUS, PAD_STRENGTH, RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import LaunchPad
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import FALLING, enter_state


@fast
def create_pad(w: World, o: LaunchPad, values: Sequence[float]) -> None:
    """Take the normal of the record and enter the grid."""
    o.face_x = values[2]
    o.face_y = values[3]
    grid_insert(w, o)


@fast
def touch_pad(w: World, o: LaunchPad) -> None:
    """Disc contact: launch if the ninja's point that faces the pad is on or behind the pad's plane. No cooldown."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    if sqrt(dx * dx + dy * dy) < PAD_RADIUS + RADIUS:
        u = o.x - (n.x - o.face_x * RADIUS)
        v = o.y - (n.y - o.face_y * RADIUS)
        # Do not write this as ">= 0.0": a NaN in the normal launches too, as in the original.
        if not u * o.face_x + v * o.face_y < 0.0:
            m = 1.0
            if o.face_y < 0.0:
                m = 1.0 + abs(o.face_y)
            launch(w, o, o.face_x * PAD_STRENGTH, o.face_y * PAD_STRENGTH * m)


@fast
def launch(w: World, o: LaunchPad, lx: float, ly: float) -> None:
    """Replace the ninja's velocity, whatever its state: a launch brings the dead back to life (objects.md §3)."""
    n = w.ninja
    n.prev_x = n.x
    n.prev_y = n.y
    n.x = n.x + lx
    n.y = n.y + ly
    enter_state(w, FALLING)
    emit(w, LAUNCHED, o.slot, n.prev_x, n.prev_y, lx, ly)
