"""How a circle is pushed out of the parts of a tile: a side, a corner point, a surface, an arc (world.md §4.3).

The functions take the tile's id and the centre of its cell, push the ninja on a contact and give the kind of contact.
"Open" is the side that the surface faces (the sign σ), "solid" the other one. T and S are the surface's end points.
"""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.tiles import NORMAL_X, NORMAL_Y, S_X, S_Y, SIGN_X, SIGN_Y, T_X, T_Y
from ninja_game.sim.ninja.contact_response import push_from_tile
from ninja_game.sim.rules import CELL, HALF, RADIUS, ROOT2
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import World

NO_CONTACT, SIDE_CONTACT, SHAPE_CONTACT = 0, 1, 2  # result kinds


@fast
def push_from_side(w: World, ox: float, oy: float, hx: float, hy: float) -> int:
    """Push straight out of the side: AXH with hy = 0, AXV with hx = 0."""
    push_from_tile(w, ox * hx, oy * hy, hx, hy)
    return SIDE_CONTACT


@fast
def push_from_corner(w: World, vx: float, vy: float, fx: float, fy: float) -> int:
    """POINT: push away from a corner point; (fx, fy) is the normal when the centre lies exactly on it."""
    n = w.ninja
    dx = n.x - vx
    dy = n.y - vy
    length = sqrt(dx * dx + dy * dy)
    depth = RADIUS - length
    if depth > 0.0:
        if length == 0.0:
            dx = fx
            dy = fy
        else:
            dx = dx / length
            dy = dy / length
        push_from_tile(w, dx * depth, dy * depth, dx, dy)
        return SHAPE_CONTACT
    return NO_CONTACT


@fast
def push_from_face(w: World, tile: int, ax: float, ay: float) -> int:
    """FACE: push along the surface normal. Quirk: |D| pushes a centre behind the surface too little."""
    n = w.ninja
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    depth = RADIUS - abs((n.x - ax) * nx + (n.y - ay) * ny)
    if depth > 0.0:
        push_from_tile(w, nx * depth, ny * depth, nx, ny)
        return SHAPE_CONTACT
    return NO_CONTACT


@fast
def position_past_end(w: World, tile: int, ax: float, ay: float) -> float:
    """The body's position along the surface relative to an end point: > 0 beyond a T, < 0 beyond an S."""
    n = w.ninja
    along = (n.x - ax) * (-NORMAL_Y[tile]) + (n.y - ay) * NORMAL_X[tile]
    return along * SIGN_X[tile] * SIGN_Y[tile]


@fast
def collide_segment_t(w: World, tile: int, cx: float, cy: float, hx: float, hy: float) -> int:
    """SEGT: push off the surface, or off its end point T if the body is beyond it."""
    ax = cx + T_X[tile]
    ay = cy + T_Y[tile]
    if position_past_end(w, tile, ax, ay) > 0.0:
        return push_from_corner(w, ax, ay, hx / ROOT2, hy / ROOT2)
    return push_from_face(w, tile, ax, ay)


@fast
def collide_segment_s(w: World, tile: int, cx: float, cy: float, hx: float, hy: float) -> int:
    """SEGS: push off the surface, or off its end point S if the body is beyond it."""
    ax = cx + S_X[tile]
    ay = cy + S_Y[tile]
    if position_past_end(w, tile, ax, ay) < 0.0:
        return push_from_corner(w, ax, ay, hx / ROOT2, hy / ROOT2)
    return push_from_face(w, tile, ax, ay)


@fast
def push_from_line(w: World, tile: int, ax: float, ay: float) -> int:
    """LINE: push the body's deepest point back to the surface."""
    n = w.ninja
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    depth = ((n.x - nx * RADIUS) - ax) * nx + ((n.y - ny * RADIUS) - ay) * ny
    if depth < 0.0:
        push_from_tile(w, -nx * depth, -ny * depth, nx, ny)
        return SHAPE_CONTACT
    return NO_CONTACT


@fast
def push_from_round_side(w: World, tile: int, cx: float, cy: float) -> int:
    """ROUND: push away from a convex tile's centre; not clipped to the arc."""
    n = w.ninja
    dx = n.x - (cx - SIGN_X[tile] * HALF)
    dy = n.y - (cy - SIGN_Y[tile] * HALF)
    length = sqrt(dx * dx + dy * dy)
    depth = (CELL + RADIUS) - length
    if depth > 0.0:
        dx = ieee_divide(dx, length)
        dy = ieee_divide(dy, length)
        push_from_tile(w, dx * depth, dy * depth, dx, dy)
        return SHAPE_CONTACT
    return NO_CONTACT
