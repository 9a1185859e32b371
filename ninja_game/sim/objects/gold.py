"""Gold (objects.md §8.2)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.events import GOLD_TAKEN, emit
from ninja_game.sim.grid import grid_insert, grid_remove
from ninja_game.sim.rules import GOLD_RADIUS, RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Gold
from ninja_game.sim.schema.world_fields import World


@fast
def create_gold(w: World, o: Gold) -> None:
    """Enter the grid."""
    grid_insert(w, o)


@fast
def touch_gold(w: World, o: Gold) -> None:
    """Disc contact: collect it and remove it from the grid."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    if sqrt(dx * dx + dy * dy) < GOLD_RADIUS + RADIUS:
        o.taken = 1
        w.gold += 1
        grid_remove(w, o)
        emit(w, GOLD_TAKEN, o.slot, o.x, o.y, 0.0, 0.0)
