"""One tick of the whole world (objects.md §2.5, game.md §1.2)."""

from __future__ import annotations

from ninja_game.sim.ninja.tick import tick_ninja
from ninja_game.sim.objects.dispatch import think, update_objects
from ninja_game.sim.rules import THINK_PAUSE
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import DEAD


@fast
def step(tiles: TileMap, w: World, keys: int) -> None:
    """Advance the world by one tick. ``keys``: the keys of this tick, a sum of ``Input`` flags."""
    w.event_count = 0
    # 1. All objects in the update set, the most recently started first.
    if w.update_head:
        update_objects(tiles, w)
    # 2. At most one thinking object; one thinks every fourth tick.
    if w.think_cursor:
        if w.think_counter >= THINK_PAUSE:
            w.think_counter = 0
            think(tiles, w, w.objects[w.think_cursor])
            if w.think_cursor:
                w.think_cursor = w.objects[w.think_cursor].ring_next
        else:
            w.think_counter += 1
    # 3. The ninja, which tests the objects of nine cells and the tiles of the cells that it touches.
    if w.ninja.state != DEAD:
        tick_ninja(tiles, w, keys)
    w.tick += 1
