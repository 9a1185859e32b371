"""Circle against one tile: the narrow phase by tile class and side (world.md §4.3-§4.4).

Each function takes the tile's id and its cell's centre, pushes the ninja if there is a contact and tells its kind.
"Open" is the side to which the surface faces (the sign σ), "solid" the other one. T and S are the surface's end points.
"""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import div
from ninja_game.sim.contacts import push_from_tile
from ninja_game.sim.memory import fast
from ninja_game.sim.rules import CELL, HALF, RADIUS, ROOT2
from ninja_game.sim.schema import World
from ninja_game.sim.tiles import (
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
    UNDEFINED,
)

NONE, AXIS, SHAPED = 0, 1, 2
"""Result kinds."""


@fast
def axis(w: World, ox: float, oy: float, hx: float, hy: float) -> int:
    """Push straight out of the side: AXH with hy = 0, AXV with hx = 0."""
    push_from_tile(w, ox * hx, oy * hy, hx, hy)
    return AXIS


@fast
def point(w: World, vx: float, vy: float, fx: float, fy: float) -> int:
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
        return SHAPED
    return NONE


@fast
def face(w: World, tile: int, ax: float, ay: float) -> int:
    """FACE: push along the surface normal. A centre behind the surface is pushed out too little: |D| is a quirk."""
    n = w.ninja
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    depth = RADIUS - abs((n.x - ax) * nx + (n.y - ay) * ny)
    if depth > 0.0:
        push_from_tile(w, nx * depth, ny * depth, nx, ny)
        return SHAPED
    return NONE


@fast
def beyond(w: World, tile: int, ax: float, ay: float) -> float:
    """Where the body is along the surface relative to an end point: > 0 beyond a T, < 0 beyond an S."""
    n = w.ninja
    along = (n.x - ax) * (-NORMAL_Y[tile]) + (n.y - ay) * NORMAL_X[tile]
    return along * SIGN_X[tile] * SIGN_Y[tile]


@fast
def segment_t(w: World, tile: int, cx: float, cy: float, hx: float, hy: float) -> int:
    """SEGT: the surface, or its end point T for a body beyond it."""
    ax = cx + T_X[tile]
    ay = cy + T_Y[tile]
    if beyond(w, tile, ax, ay) > 0.0:
        return point(w, ax, ay, hx / ROOT2, hy / ROOT2)
    return face(w, tile, ax, ay)


@fast
def segment_s(w: World, tile: int, cx: float, cy: float, hx: float, hy: float) -> int:
    """SEGS: the surface, or its end point S for a body beyond it."""
    ax = cx + S_X[tile]
    ay = cy + S_Y[tile]
    if beyond(w, tile, ax, ay) < 0.0:
        return point(w, ax, ay, hx / ROOT2, hy / ROOT2)
    return face(w, tile, ax, ay)


@fast
def line(w: World, tile: int, ax: float, ay: float) -> int:
    """LINE: push the body's deepest point back to the surface."""
    n = w.ninja
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    depth = ((n.x - nx * RADIUS) - ax) * nx + ((n.y - ny * RADIUS) - ay) * ny
    if depth < 0.0:
        push_from_tile(w, -nx * depth, -ny * depth, nx, ny)
        return SHAPED
    return NONE


@fast
def round_side(w: World, tile: int, cx: float, cy: float) -> int:
    """ROUND: push away from a convex tile's centre; not clipped to the arc."""
    n = w.ninja
    dx = n.x - (cx - SIGN_X[tile] * HALF)
    dy = n.y - (cy - SIGN_Y[tile] * HALF)
    length = sqrt(dx * dx + dy * dy)
    depth = (CELL + RADIUS) - length
    if depth > 0.0:
        dx = div(dx, length)
        dy = div(dy, length)
        push_from_tile(w, dx * depth, dy * depth, dx, dy)
        return SHAPED
    return NONE


@fast
def vertical(w: World, tile: int, cx: float, cy: float, oy: float, hy: float) -> int:
    """The tile above or below."""
    shape = SHAPE[tile]
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    if shape == UNDEFINED or tile == 0:
        return NONE
    if shape == FULL:
        return axis(w, 0.0, oy, 0.0, hy)
    if shape == HALF_TILE:
        facing = sy * hy
        if facing > 0.0:
            return NONE
        if facing < 0.0 or (w.ninja.x - cx) * sx < 0.0:
            return axis(w, 0.0, oy, 0.0, hy)
        return point(w, cx, cy + hy * HALF, sx / ROOT2, hy / ROOT2)
    if sy * hy < 0.0:
        if shape == THIN_67 and not (w.ninja.x - cx) * sx < 0.0:
            return point(w, cx + S_X[tile], cy + S_Y[tile], 0.0, hy / ROOT2)
        return axis(w, 0.0, oy, 0.0, hy)
    if shape == THIN_22:
        return NONE
    if shape == THICK_67 and (w.ninja.x - cx) * sx < 0.0:
        return axis(w, 0.0, oy, 0.0, hy)
    if shape == CONCAVE:
        return point(w, cx - sx * HALF, cy + sy * HALF, 0.0, hy)
    if shape == CONVEX:
        return round_side(w, tile, cx, cy)
    return segment_t(w, tile, cx, cy, 0.0, hy)


@fast
def horizontal(w: World, tile: int, cx: float, cy: float, ox: float, hx: float) -> int:
    """The tile to the left or right."""
    shape = SHAPE[tile]
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    if shape == UNDEFINED or tile == 0:
        return NONE
    if shape == FULL:
        return axis(w, ox, 0.0, hx, 0.0)
    if shape == HALF_TILE:
        facing = sx * hx
        if facing > 0.0:
            return NONE
        if facing < 0.0 or (w.ninja.y - cy) * sy < 0.0:
            return axis(w, ox, 0.0, hx, 0.0)
        # Quirk: a centre exactly on this point is pushed by nothing, with the normal (0, 0) that reads as a wall.
        return point(w, cx + hx * HALF, cy, 0.0, 0.0)
    if sx * hx < 0.0:
        if shape == THIN_22 and not (w.ninja.y - cy) * sy < 0.0:
            return point(w, cx + T_X[tile], cy + T_Y[tile], hx / ROOT2, 0.0)
        return axis(w, ox, 0.0, hx, 0.0)
    if shape == THIN_67:
        return NONE
    if shape == THICK_22 and (w.ninja.y - cy) * sy < 0.0:
        return axis(w, ox, 0.0, hx, 0.0)
    if shape == CONCAVE:
        return point(w, cx + sx * HALF, cy - sy * HALF, hx, 0.0)
    if shape == CONVEX:
        return round_side(w, tile, cx, cy)
    return segment_s(w, tile, cx, cy, hx, 0.0)


@fast
def diagonal(w: World, tile: int, cx: float, cy: float, hx: float, hy: float) -> int:
    """The tile at the corner: its corner point, unless the shape leaves that corner open."""
    shape = SHAPE[tile]
    if shape == UNDEFINED or tile == 0:
        return NONE
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    facing = sx * hx + sy * hy
    if shape == HALF_TILE:
        if facing > 0.0:
            return NONE
    elif shape == THIN_22:
        if sy * hy > 0.0:
            return NONE
    elif shape == THIN_67:
        if sx * hx > 0.0:
            return NONE
    elif facing > 0.0:
        if shape == THICK_22:
            return line(w, tile, cx + T_X[tile], cy + T_Y[tile])
        if shape == THICK_67:
            return line(w, tile, cx + S_X[tile], cy + S_Y[tile])
        if shape == CONVEX:
            return round_side(w, tile, cx, cy)
        return NONE
    return point(w, cx + hx * HALF, cy + hy * HALF, hx / ROOT2, hy / ROOT2)


@fast
def own(w: World, tile: int, cx: float, cy: float) -> None:
    """The tile of the cell that holds the body's centre."""
    shape = SHAPE[tile]
    n = w.ninja
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    if shape == SLOPE_45:
        sink(w, ((n.x - nx * RADIUS) - cx) * nx + ((n.y - ny * RADIUS) - cy) * ny, nx, ny, cx, cy)
    elif shape == THICK_22:
        depth = ((n.x - nx * RADIUS) - (cx + T_X[tile])) * nx + ((n.y - ny * RADIUS) - (cy + T_Y[tile])) * ny
        sink(w, depth, nx, ny, cx, cy)
    elif shape == THICK_67:
        depth = ((n.x - nx * RADIUS) - (cx + S_X[tile])) * nx + ((n.y - ny * RADIUS) - (cy + S_Y[tile])) * ny
        sink(w, depth, nx, ny, cx, cy)
    elif shape == THIN_22:
        ax = cx + T_X[tile]
        ay = cy + T_Y[tile]
        if beyond(w, tile, ax, ay) > 0.0:
            point(w, ax, ay, 0.0, 0.0)
        else:
            sink(w, ((n.x - ax) - RADIUS * nx) * nx + ((n.y - ay) - RADIUS * ny) * ny, nx, ny, cx, cy)
    elif shape == THIN_67:
        ax = cx + S_X[tile]
        ay = cy + S_Y[tile]
        if beyond(w, tile, ax, ay) < 0.0:
            point(w, ax, ay, 0.0, 0.0)
        else:
            sink(w, ((n.x - ax) - RADIUS * nx) * nx + ((n.y - ay) - RADIUS * ny) * ny, nx, ny, cx, cy)
    elif shape == CONCAVE:
        dx = (cx + SIGN_X[tile] * HALF) - n.x
        dy = (cy + SIGN_Y[tile] * HALF) - n.y
        length = sqrt(dx * dx + dy * dy)
        own_arc(w, dx, dy, length, (length + RADIUS) - CELL, cx, cy)
    elif shape == CONVEX:
        dx = n.x - (cx - SIGN_X[tile] * HALF)
        dy = n.y - (cy - SIGN_Y[tile] * HALF)
        length = sqrt(dx * dx + dy * dy)
        own_arc(w, dx, dy, length, (CELL + RADIUS) - length, cx, cy)
    elif shape == FULL:
        exit_side(w, cx, cy)
    elif shape == HALF_TILE:
        own_half(w, SIGN_X[tile], SIGN_Y[tile], cx, cy)


@fast
def own_arc(w: World, dx: float, dy: float, length: float, depth: float, cx: float, cy: float) -> None:
    """Push along (dx, dy) by the depth below an arc, or out of the cell if that is nearer."""
    if depth > 0.0:
        if nearest_side(w, cx, cy) < depth:
            exit_side(w, cx, cy)
        else:
            dx = div(dx, length)
            dy = div(dy, length)
            push_from_tile(w, dx * depth, dy * depth, dx, dy)


@fast
def own_half(w: World, sx: float, sy: float, cx: float, cy: float) -> None:
    """A half tile. Quirk: the short way out is (ox, oy), both overlaps at once, always right and down."""
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
def sink(w: World, depth: float, nx: float, ny: float, cx: float, cy: float) -> None:
    """SINK: push a body with depth < 0 back to the surface, or out of the cell if that is nearer."""
    if depth < 0.0:
        qx = nx * (-depth)
        qy = ny * (-depth)
        if nearest_side(w, cx, cy) < sqrt(qx * qx + qy * qy):
            exit_side(w, cx, cy)
        else:
            push_from_tile(w, qx, qy, nx, ny)


@fast
def nearest_side(w: World, cx: float, cy: float) -> float:
    """ℓ: how far the body is from leaving its own cell's square over the nearest side."""
    ox = (HALF + RADIUS) - abs(w.ninja.x - cx)
    oy = (HALF + RADIUS) - abs(w.ninja.y - cy)
    return ox if ox < oy else oy


@fast
def exit_side(w: World, cx: float, cy: float) -> None:
    """EXIT: push the body out of its own cell's square over the nearest side (vertically when equal)."""
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
