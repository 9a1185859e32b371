"""Homing launcher and its rocket (objects.md §8.11). Only the rocket in flight can be touched, not the launcher."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.rays import sees, solid_at
from ninja_game.sim.collision.tiles import NEIGHBOUR_OFFSET
from ninja_game.sim.death import kill
from ninja_game.sim.events import ROCKET_EXPLODED, ROCKET_LAUNCHED, emit
from ninja_game.sim.grid import grid_insert, grid_move, grid_remove
from ninja_game.sim.rules import (
    OFF,
    RADIUS,
    ROCKET_ACCELERATION,
    ROCKET_GROWTH,
    ROCKET_HEADING_X,
    ROCKET_HEADING_Y,
    ROCKET_PREPARE,
    ROCKET_RADIUS,
    ROCKET_SPEED,
    ROCKET_TURN,
    SOLID,
)
from ninja_game.sim.schedule import end_think, end_update, start_think, start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Launcher
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import EXPLOSIVE, LAUNCHER_FLIGHT, LAUNCHER_IDLE, LAUNCHER_PREPARE


@fast
def create_launcher(w: World, o: Launcher) -> None:
    """Wait for the ninja. It enters no cell: it cannot be touched."""
    o.base_x = o.x
    o.base_y = o.y
    o.heading_x = ROCKET_HEADING_X
    o.heading_y = ROCKET_HEADING_Y
    start_think(w, o)


@fast
def think_launcher(tiles: TileMap, w: World, o: Launcher) -> None:
    """Prepare a rocket when the ninja is in sight."""
    n = w.ninja
    if sees(tiles, w, o.base_x, o.base_y, n.x, n.y)[0]:
        end_think(w, o)
        start_update(w, o)
        o.counter = 0
        o.routine = LAUNCHER_PREPARE


@fast
def update_launcher(tiles: TileMap, w: World, o: Launcher) -> None:
    """Count down to the launch, then fly."""
    if o.routine == LAUNCHER_PREPARE:
        o.counter += 1
        if o.counter >= ROCKET_PREPARE:
            fire_rocket(w, o)
    elif o.routine == LAUNCHER_FLIGHT:
        fly(tiles, w, o)


@fast
def fire_rocket(w: World, o: Launcher) -> None:
    """Put the rocket on the base, heading for the ninja; it does not move in this tick."""
    n = w.ninja
    o.acceleration = ROCKET_ACCELERATION
    o.speed = 0.0
    o.x = o.base_x
    o.y = o.base_y
    grid_insert(w, o)
    o.routine = LAUNCHER_FLIGHT
    dx = n.x - o.base_x
    dy = n.y - o.base_y
    length = sqrt(dx * dx + dy * dy)
    if length != 0.0:
        o.heading_x = dx / length
        o.heading_y = dy / length
    emit(w, ROCKET_LAUNCHED, o.slot, o.x, o.y, o.heading_x, o.heading_y)


@fast
def fly(tiles: TileMap, w: World, o: Launcher) -> None:
    """Accelerate, move, explode in a tile or on a solid edge, and turn towards the ninja's next place."""
    if o.speed < ROCKET_SPEED:
        o.acceleration = o.acceleration * ROCKET_GROWTH
        o.speed = o.speed + o.acceleration
    else:
        o.speed = ROCKET_SPEED
    o.x = o.x + o.speed * o.heading_x
    o.y = o.y + o.speed * o.heading_y
    if solid_at(tiles, o.x, o.y):
        explode(w, o)
        return
    old = o.cell
    if grid_move(w, o) and edge_between(w, old, o.cell) == SOLID:
        explode(w, o)
        return
    steer(w, o)


@fast
def edge_between(w: World, old: int, new: int) -> int:
    """The old cell's own edge towards the new one; off if they are not neighbours or one is missing."""
    if old != 0 and new != 0:
        for side in range(4):
            if old + NEIGHBOUR_OFFSET[side] == new:
                return w.edges[4 * old + side]
    return OFF


@fast
def steer(w: World, o: Launcher) -> None:
    """Turn the heading. Quirk: no test for a distance of 0; heading and place then become NaN for ever."""
    n = w.ninja
    dx = 2.0 * n.x - n.prev_x - (o.x + o.speed * o.heading_x)
    dy = 2.0 * n.y - n.prev_y - (o.y + o.speed * o.heading_y)
    length = sqrt(dx * dx + dy * dy)
    dx = ieee_divide(dx, length)
    dy = ieee_divide(dy, length)
    q = (-o.heading_y) * dx + o.heading_x * dy
    hx = o.heading_x + q * (-o.heading_y) * ROCKET_TURN
    hy = o.heading_y + q * o.heading_x * ROCKET_TURN
    length = sqrt(hx * hx + hy * hy)
    if length != 0.0:
        hx = hx / length
        hy = hy / length
    o.heading_x = hx
    o.heading_y = hy


@fast
def touch_rocket(w: World, o: Launcher) -> None:
    """Kill the ninja if the rocket's tip is inside it, then explode."""
    n = w.ninja
    dx = n.x - o.x
    dy = n.y - o.y
    if sqrt(dx * dx + dy * dy) < ROCKET_RADIUS + RADIUS:
        kill(w, EXPLOSIVE, o.slot, dx, dy, o.x, o.y)
        explode(w, o)


@fast
def explode(w: World, o: Launcher) -> None:
    """Remove the rocket; the launcher thinks again, unless the ninja has died or won."""
    end_update(w, o)
    grid_remove(w, o)
    o.routine = LAUNCHER_IDLE
    if not w.round_over:
        start_think(w, o)
    emit(w, ROCKET_EXPLODED, o.slot, o.x, o.y, 0.0, 0.0)
