"""Push the circle out of the tile of the cell that holds its centre (world.md §4.4)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.circle_contacts import position_past_end, push_from_corner
from ninja_game.sim.collision.tiles import (
    CONCAVE,
    CONVEX,
    FULL,
    HALF_TILE,
    NORMAL_X,
    NORMAL_Y,
    S_X,
    S_Y,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    SLOPE_45,
    T_X,
    T_Y,
    THICK_22,
    THICK_67,
    THIN_22,
    THIN_67,
)
from ninja_game.sim.ninja.contact_response import push_from_tile
from ninja_game.sim.rules import CELL, HALF, RADIUS
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import World


@fast
def collide_own_tile(w: World, tile: int, cx: float, cy: float) -> None:
    """Collide with the tile of the cell that holds the body's centre."""
    shape = SHAPE[tile]
    n = w.ninja
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    if shape == SLOPE_45:
        push_to_surface(w, ((n.x - nx * RADIUS) - cx) * nx + ((n.y - ny * RADIUS) - cy) * ny, nx, ny, cx, cy)
    elif shape == THICK_22:
        depth = ((n.x - nx * RADIUS) - (cx + T_X[tile])) * nx + ((n.y - ny * RADIUS) - (cy + T_Y[tile])) * ny
        push_to_surface(w, depth, nx, ny, cx, cy)
    elif shape == THICK_67:
        depth = ((n.x - nx * RADIUS) - (cx + S_X[tile])) * nx + ((n.y - ny * RADIUS) - (cy + S_Y[tile])) * ny
        push_to_surface(w, depth, nx, ny, cx, cy)
    elif shape == THIN_22:
        ax = cx + T_X[tile]
        ay = cy + T_Y[tile]
        if position_past_end(w, tile, ax, ay) > 0.0:
            push_from_corner(w, ax, ay, 0.0, 0.0)
        else:
            push_to_surface(w, ((n.x - ax) - RADIUS * nx) * nx + ((n.y - ay) - RADIUS * ny) * ny, nx, ny, cx, cy)
    elif shape == THIN_67:
        ax = cx + S_X[tile]
        ay = cy + S_Y[tile]
        if position_past_end(w, tile, ax, ay) < 0.0:
            push_from_corner(w, ax, ay, 0.0, 0.0)
        else:
            push_to_surface(w, ((n.x - ax) - RADIUS * nx) * nx + ((n.y - ay) - RADIUS * ny) * ny, nx, ny, cx, cy)
    elif shape == CONCAVE:
        dx = (cx + SIGN_X[tile] * HALF) - n.x
        dy = (cy + SIGN_Y[tile] * HALF) - n.y
        length = sqrt(dx * dx + dy * dy)
        collide_own_arc(w, dx, dy, length, (length + RADIUS) - CELL, cx, cy)
    elif shape == CONVEX:
        dx = n.x - (cx - SIGN_X[tile] * HALF)
        dy = n.y - (cy - SIGN_Y[tile] * HALF)
        length = sqrt(dx * dx + dy * dy)
        collide_own_arc(w, dx, dy, length, (CELL + RADIUS) - length, cx, cy)
    elif shape == FULL:
        push_out_of_cell(w, cx, cy)
    elif shape == HALF_TILE:
        collide_own_half(w, SIGN_X[tile], SIGN_Y[tile], cx, cy)


@fast
def collide_own_arc(w: World, dx: float, dy: float, length: float, depth: float, cx: float, cy: float) -> None:
    """Push along (dx, dy) by the depth below an arc, or out of the cell if that is nearer."""
    if depth > 0.0:
        if distance_to_nearest_side(w, cx, cy) < depth:
            push_out_of_cell(w, cx, cy)
        else:
            dx = ieee_divide(dx, length)
            dy = ieee_divide(dy, length)
            push_from_tile(w, dx * depth, dy * depth, dx, dy)


@fast
def collide_own_half(w: World, sx: float, sy: float, cx: float, cy: float) -> None:
    """Collide with a half tile. Quirk: its short way out is (ox, oy), both overlaps at once, always right and down."""
    n = w.ninja
    depth = ((n.x - sx * RADIUS) - cx) * sx + ((n.y - sy * RADIUS) - cy) * sy
    if depth < 0.0:
        qx = sx * (-depth)
        qy = sy * (-depth)
        ox = (HALF + RADIUS) - abs(n.x - cx)
        oy = (HALF + RADIUS) - abs(n.y - cy)
        m = sqrt(ox * ox + oy * oy)
        if m < sqrt(qx * qx + qy * qy):
            push_from_tile(w, ox, oy, ox / m, oy / m)
        else:
            push_from_tile(w, qx, qy, sx, sy)


@fast
def push_to_surface(w: World, depth: float, nx: float, ny: float, cx: float, cy: float) -> None:
    """SINK: push a body with depth < 0 back to the surface, or out of the cell if that is nearer."""
    if depth < 0.0:
        qx = nx * (-depth)
        qy = ny * (-depth)
        if distance_to_nearest_side(w, cx, cy) < sqrt(qx * qx + qy * qy):
            push_out_of_cell(w, cx, cy)
        else:
            push_from_tile(w, qx, qy, nx, ny)


@fast
def distance_to_nearest_side(w: World, cx: float, cy: float) -> float:
    """ℓ: the distance over which the body leaves its own cell's square by the nearest side, px."""
    ox = (HALF + RADIUS) - abs(w.ninja.x - cx)
    oy = (HALF + RADIUS) - abs(w.ninja.y - cy)
    return ox if ox < oy else oy


@fast
def push_out_of_cell(w: World, cx: float, cy: float) -> None:
    """EXIT: push the body out of its own cell's square over the nearest side (vertically if two are equally near)."""
    dx = w.ninja.x - cx
    dy = w.ninja.y - cy
    ox = (HALF + RADIUS) - abs(dx)
    oy = (HALF + RADIUS) - abs(dy)
    if ox < oy:
        hx = -1.0 if dx < 0.0 else 1.0
        push_from_tile(w, ox * hx, 0.0, hx, 0.0)
    else:
        hy = -1.0 if dy < 0.0 else 1.0
        push_from_tile(w, 0.0, oy * hy, 0.0, hy)
