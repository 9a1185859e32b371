"""Exit and its switch (objects.md §8.1)."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from ninja_game.sim.death import win
from ninja_game.sim.events import EXIT_OPENED, emit
from ninja_game.sim.grid import grid_insert
from ninja_game.sim.kinds import SWITCH
from ninja_game.sim.rules import EXIT_RADIUS, RADIUS, SWITCH_RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Exit, Switch
from ninja_game.sim.schema.world_fields import World


@fast
def create_exit(w: World, o: Exit, values: Sequence[float]) -> None:
    """Enter only the exit's switch into the grid. The switch has no id; its slot is behind those of the ids."""
    o.partner = w.slots_used
    w.slots_used += 1
    switch = w.objects[o.partner]
    switch.slot = o.partner
    switch.kind = SWITCH
    switch.id = -1
    switch.x = values[2]
    switch.y = values[3]
    switch.partner = o.slot
    grid_insert(w, switch)


@fast
def touch_switch(w: World, o: Switch) -> None:
    """Open the exit and enter it into the grid. The switch stays in its list, without effect (objects.md §2.2)."""
    exit_ = w.objects[o.partner]
    if exit_.is_open:
        return
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    if sqrt(dx * dx + dy * dy) < SWITCH_RADIUS + RADIUS:
        exit_.is_open = 1
        grid_insert(w, exit_)
        emit(w, EXIT_OPENED, o.partner, o.x, o.y, 0.0, 0.0)


@fast
def touch_exit(w: World, o: Exit) -> None:
    """Pass the level at an open exit; a closed one is in no list."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    if sqrt(dx * dx + dy * dy) < EXIT_RADIUS + RADIUS:
        win(w)
