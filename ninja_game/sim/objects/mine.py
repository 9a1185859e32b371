"""Mine (objects.md §8.9)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.death import kill
from ninja_game.sim.events import MINE_EXPLODED, emit
from ninja_game.sim.grid import grid_insert, grid_remove
from ninja_game.sim.rules import MINE_RADIUS, RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Mine
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import EXPLOSIVE


@fast
def create_mine(w: World, o: Mine) -> None:
    """Enter the grid."""
    grid_insert(w, o)


@fast
def touch_mine(w: World, o: Mine) -> None:
    """Disc contact: first the ninja dies, then the mine leaves the grid."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    if sqrt(dx * dx + dy * dy) < MINE_RADIUS + RADIUS:
        kill(w, EXPLOSIVE, o.slot, -dx, -dy, o.x, o.y)
        o.exploded = 1
        grid_remove(w, o)
        emit(w, MINE_EXPLODED, o.slot, o.x, o.y, 0.0, 0.0)
