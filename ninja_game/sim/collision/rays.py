"""Rays through the grid: traversal by edges, what stops them, and "does A see the ninja" (world.md §6-§7)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.ray_shapes import ray_tile
from ninja_game.sim.collision.tiles import (
    ANCHOR_X,
    ANCHOR_Y,
    CENTRE_X,
    CENTRE_Y,
    CONCAVE,
    CONVEX,
    EXISTS,
    FULL,
    NORMAL_X,
    NORMAL_Y,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    UNDEFINED,
)
from ninja_game.sim.grid import cell_at
from ninja_game.sim.rules import CELL, DOWN, HALF, LEFT, NEVER, OFF, RADIUS, RIGHT, SOLID, STRIDE, UP
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import TileMap, World


@fast
def cast_ray(tiles: TileMap, w: World, x: float, y: float, dx: float, dy: float) -> tuple[bool, float, float]:
    """Follow a ray from (x, y) along the unit vector (dx, dy) until a tile or a solid edge stops it.

    Gives (stopped, x, y) with the stop point in px; (0, 0) for a ray that runs off the grid.
    """
    cell = cell_at(x, y)
    if cell == 0:
        return False, 0.0, 0.0
    tx = NEVER
    ty = NEVER
    delta_x = 0.0
    delta_y = 0.0
    if dx < 0.0:
        tx = ((CENTRE_X[cell] - HALF) - x) / dx
        delta_x = CELL / (-dx)
    elif dx > 0.0:
        tx = ((CENTRE_X[cell] + HALF) - x) / dx
        delta_x = CELL / dx
    if dy < 0.0:
        ty = ((CENTRE_Y[cell] - HALF) - y) / dy
        delta_y = CELL / (-dy)
    elif dy > 0.0:
        ty = ((CENTRE_Y[cell] + HALF) - y) / dy
        delta_y = CELL / dy
    side_x = LEFT if dx < 0.0 else RIGHT
    side_y = UP if dy < 0.0 else DOWN
    step_x = -1 if dx < 0.0 else 1
    step_y = -STRIDE if dy < 0.0 else STRIDE
    hit, hit_x, hit_y = ray_tile(tiles.ids[cell], CENTRE_X[cell], CENTRE_Y[cell], x, y, dx, dy)
    if hit:
        return True, hit_x, hit_y
    while EXISTS[cell]:
        if tx < ty:
            t = tx
            tx += delta_x
            edge = w.edges[4 * cell + side_x]
            cell += step_x
        else:
            t = ty
            ty += delta_y
            edge = w.edges[4 * cell + side_y]
            cell += step_y
        if edge != OFF:
            crossing_x = x + t * dx
            crossing_y = y + t * dy
            if edge == SOLID:
                return True, crossing_x, crossing_y
            hit, hit_x, hit_y = ray_tile(
                tiles.ids[cell], CENTRE_X[cell], CENTRE_Y[cell], crossing_x, crossing_y, dx, dy
            )
            if hit:
                return True, hit_x, hit_y
    return False, 0.0, 0.0


@fast
def ray_tiles(tiles: TileMap, w: World, x: float, y: float, to_x: float, to_y: float) -> tuple[bool, float, float]:
    """Cast a ray from (x, y) through (to_x, to_y) against tiles and edges: (stopped, stop x, stop y), px."""
    vx = to_x - x
    vy = to_y - y
    length = sqrt(vx * vx + vy * vy)
    if length == 0.0:
        return False, 0.0, 0.0
    return cast_ray(tiles, w, x, y, vx / length, vy / length)


@fast
def ray_circle(
    x: float, y: float, dx: float, dy: float, cx: float, cy: float, radius: float
) -> tuple[bool, float, float]:
    """Test a ray against a circle: (hit, hit x, hit y), px. From inside it hits where it leaves the circle."""
    fx = x - cx
    fy = y - cy
    a = dx * dx + dy * dy
    b = 2.0 * (dx * fx + dy * fy)
    g = fx * fx + fy * fy - radius * radius
    discriminant = b * b - 4.0 * a * g
    if discriminant < 0.0:
        return False, 0.0, 0.0
    k = ieee_divide(1.0, 2.0 * a)  # a is 0 if the target is so far away that the ray's direction vanishes
    root = sqrt(discriminant)
    t1 = (-b + root) * k
    t2 = (-b - root) * k
    t = t2
    if t2 < 0.0:
        if t1 < 0.0:
            return False, 0.0, 0.0
        t = t1
    return True, x + t * dx, y + t * dy


@fast
def sees(tiles: TileMap, w: World, x: float, y: float, to_x: float, to_y: float) -> tuple[bool, float, float]:
    """Whether a ray from (x, y) through (to_x, to_y) meets the ninja before any tile: (seen, hit x, hit y), px."""
    n = w.ninja
    vx = to_x - x
    vy = to_y - y
    length = sqrt(vx * vx + vy * vy)
    if length == 0.0:
        return False, 0.0, 0.0
    dx = vx / length
    dy = vy / length
    hit, hit_x, hit_y = ray_circle(x, y, dx, dy, n.x, n.y, RADIUS)
    if not hit:
        return False, 0.0, 0.0
    stopped, stop_x, stop_y = cast_ray(tiles, w, x, y, dx, dy)
    if stopped:
        alpha = (x - hit_x) * dx + (y - hit_y) * dy
        beta = (x - stop_x) * dx + (y - stop_y) * dy
        if alpha < beta:
            return False, stop_x, stop_y
    return True, hit_x, hit_y


@fast
def solid_at(tiles: TileMap, x: float, y: float) -> bool:
    """Whether a point is in the solid part of its cell's tile, boundary included. Edges and doors do not count."""
    cell = cell_at(x, y)
    tile = tiles.ids[cell]
    if tile == 0:
        return False
    shape = SHAPE[tile]
    if shape == UNDEFINED:
        return False
    if shape == FULL:
        return True
    if shape == CONCAVE:
        dx = (CENTRE_X[cell] + SIGN_X[tile] * HALF) - x
        dy = (CENTRE_Y[cell] + SIGN_Y[tile] * HALF) - y
        return dx * dx + dy * dy >= CELL * CELL
    if shape == CONVEX:
        dx = x - (CENTRE_X[cell] - SIGN_X[tile] * HALF)
        dy = y - (CENTRE_Y[cell] - SIGN_Y[tile] * HALF)
        return dx * dx + dy * dy <= CELL * CELL
    ax = CENTRE_X[cell] + ANCHOR_X[tile]
    ay = CENTRE_Y[cell] + ANCHOR_Y[tile]
    return (x - ax) * NORMAL_X[tile] + (y - ay) * NORMAL_Y[tile] <= 0.0
