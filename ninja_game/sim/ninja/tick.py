"""The ninja's tick: integrate, collide, evaluate, think (ninja.md §3, §6). Its states are in control.py."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.collision.box import collide_box
from ninja_game.sim.collision.circle import collide_circle
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.death import kill
from ninja_game.sim.grid import cell_at
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEY_LEFT, KEY_RIGHT
from ninja_game.sim.ninja.control import celebrate, think_in_air, think_on_ground
from ninja_game.sim.objects.dispatch import touch_objects
from ninja_game.sim.rules import FATAL_IMPACT, FLOOR_ALLOWANCE, PARALLEL_FLOORS, WALL_PROBE
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import Ninja, TileMap, World
from ninja_game.sim.states import CELEBRATING, DEAD, FALL


@fast
def tick_ninja(tiles: TileMap, w: World, keys: int) -> None:
    """Advance the living or celebrating ninja by one tick. ``keys``: a sum of ``Input`` flags."""
    n = w.ninja
    x = n.x
    y = n.y
    ux = x - n.prev_x
    uy = y - n.prev_y
    n.prev_x = x
    n.prev_y = y
    n.x = x + n.drag * ux
    n.y = y + (n.drag * uy + n.gravity)
    n.cell = cell_at(n.x, n.y)

    n.impact_x = n.x - x
    n.impact_y = n.y - y
    n.was_in_air = n.in_air
    n.near_wall = 0
    n.in_air = 1
    n.floor_contacts = 0

    if not w.round_over:
        touch_objects(w)
    if n.box:
        collide_box(tiles, w)
    else:
        collide_circle(tiles, w)
    if n.floor_contacts:
        evaluate_floor(w, n)
    if n.in_air and not n.near_wall:
        probe_walls(tiles, n)
    n.cell = cell_at(n.x, n.y)

    if n.state == CELEBRATING:
        celebrate(n)
    elif n.state != DEAD:
        # Do not move this up: keys count only after all physics, and only if the ninja lives and does not celebrate.
        n.direction = (1 if keys & KEY_RIGHT else 0) - (1 if keys & KEY_LEFT else 0)
        n.jump_held = 1 if keys & JUMP_HELD else 0
        n.jump_pressed = 1 if keys & JUMP_PRESSED else 0
        if n.in_air:
            think_in_air(w, n)
        else:
            think_on_ground(w, n)


@fast
def evaluate_floor(w: World, n: Ninja) -> None:
    """Choose the floor normal from this tick's floor contacts; a hard landing kills."""
    n.in_air = 0
    if n.floor_contacts == 1:
        n.floor_x = n.first_floor_x
        n.floor_y = n.first_floor_y
    elif n.first_floor_x * n.last_floor_x + n.first_floor_y * n.last_floor_y > PARALLEL_FLOORS:
        # Nearly parallel: keep the normal if it is that of the first contact, otherwise take that of the last one.
        if not (n.first_floor_x == n.floor_x and n.first_floor_y == n.floor_y):
            n.floor_x = n.last_floor_x
            n.floor_y = n.last_floor_y
    else:
        ax = 0.5 * (n.first_floor_x + n.last_floor_x)
        ay = 0.5 * (n.first_floor_y + n.last_floor_y)
        length = sqrt(ax * ax + ay * ay)
        if length == 0.0:
            n.floor_x = n.first_floor_x
            n.floor_y = n.first_floor_y
        else:
            n.floor_x = ax / length
            n.floor_y = ay / length
    if n.was_in_air:
        impact = n.impact_x * n.floor_x + n.impact_y * n.floor_y
        if n.impact_y > 0.0 and impact - FLOOR_ALLOWANCE * abs(n.floor_y) < -FATAL_IMPACT:
            kill(w, FALL, 0, 0.0, 0.0, n.x, n.y)


@fast
def probe_walls(tiles: TileMap, n: Ninja) -> None:
    """Look for a tile, not a door or object, right beside a ninja that is in the air without a wall contact."""
    if solid_at(tiles, n.x + WALL_PROBE, n.y):
        n.near_wall = 1
        n.wall_x = -1.0
        n.wall_y = 0.0
    elif solid_at(tiles, n.x - WALL_PROBE, n.y):
        n.near_wall = 1
        n.wall_x = 1.0
        n.wall_y = 0.0
