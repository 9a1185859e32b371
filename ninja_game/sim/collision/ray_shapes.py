"""A ray against one tile, by shape (world.md §7.5). Hits may lie behind the start: quirks that replays depend on."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.tiles import (
    CONCAVE,
    CONVEX,
    FULL,
    HALF_TILE,
    NORMAL_X,
    NORMAL_Y,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    SLOPE_45,
    THICK_22,
    THICK_67,
    THIN_22,
    THIN_67,
    UNDEFINED,
)
from ninja_game.sim.rules import CELL, HALF, QUARTER
from ninja_game.sim.schema.declare import fast


@fast
def ray_tile(tile: int, cx: float, cy: float, x: float, y: float, dx: float, dy: float) -> tuple[bool, float, float]:
    """Test a ray from (x, y) along (dx, dy) against the tile of the cell centred on (cx, cy): (hit, hit x, hit y), px.

    Comparisons keep the original's answer for NaN: "not (a < b)" is true for it.
    """
    shape = SHAPE[tile]
    if tile == 0 or shape == FULL or shape == UNDEFINED:
        return False, 0.0, 0.0
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    if shape == CONCAVE:
        return ray_concave(sx, sy, cx, cy, x, y, dx, dy)
    if shape == CONVEX:
        return ray_convex(sx, sy, cx, cy, x, y, dx, dy)
    ex = cx - x
    ey = cy - y
    if shape == SLOPE_45:
        if not sx * dx + sy * dy < 0.0:
            return False, 0.0, 0.0
        return ray_surface(cx, cy, ex, ey, sx * HALF, -sy * HALF, dx, dy)
    if shape == HALF_TILE:
        if not ex * sx + ey * sy < 0.0:
            return True, x, y
        if not sx * dx + sy * dy < 0.0:
            return False, 0.0, 0.0
        return ray_surface(cx, cy, ex, ey, sy * HALF, sx * HALF, dx, dy)
    return ray_wedge(tile, cx, cy, x, y, dx, dy)


@fast
def ray_surface(
    mx: float, my: float, ex: float, ey: float, ux: float, uy: float, dx: float, dy: float
) -> tuple[bool, float, float]:
    """Hit a straight surface. (mx, my): its middle; (ex, ey): from the ray's start to it; (ux, uy): half of it; px."""
    kappa = ieee_divide(dy * ex - dx * ey, dx * uy - dy * ux)
    if 1.0 < abs(kappa):
        return False, 0.0, 0.0
    return True, mx + kappa * ux, my + kappa * uy


@fast
def ray_wedge(tile: int, cx: float, cy: float, x: float, y: float, dx: float, dy: float) -> tuple[bool, float, float]:
    """Hit a wedge, thin or thick: a ray that starts within its box stops at once."""
    shape = SHAPE[tile]
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    ex = cx - x
    ey = cy - y
    inside = False
    if shape == THIN_22:
        ex = (cx - sx * HALF) - x
        inside = not ex * sx < 0.0 and not ey * sy < 0.0
    elif shape == THICK_22:
        inside = not 0.0 < ex * sx and not ey * sy < 0.0
    elif shape == THIN_67:
        ey = (cy - sy * HALF) - y
        inside = not ex * sx < 0.0 and not ey * sy < 0.0
    elif shape == THICK_67:
        inside = not 0.0 < ey * sy and not ex * sx < 0.0
    if inside:
        return True, x, y
    if not NORMAL_X[tile] * dx + NORMAL_Y[tile] * dy < 0.0:
        return False, 0.0, 0.0
    if shape == THIN_22:
        my = cy - sy * QUARTER
        return ray_surface(cx, my, ex + sx * HALF, ey - sy * QUARTER, -sy * HALF, sx * HALF / 2.0, dx, dy)
    if shape == THICK_22:
        my = cy + sy * QUARTER
        return ray_surface(cx, my, ex, ey + sy * QUARTER, -sy * HALF, sx * HALF / 2.0, dx, dy)
    if shape == THIN_67:
        mx = cx - sx * QUARTER
        return ray_surface(mx, cy, ex - sx * QUARTER, ey + sy * HALF, -sy * HALF / 2.0, sx * HALF, dx, dy)
    mx = cx + sx * QUARTER
    return ray_surface(mx, cy, ex + sx * QUARTER, ey, -sy * HALF / 2.0, sx * HALF, dx, dy)


@fast
def arc_roots(fx: float, fy: float, dx: float, dy: float) -> tuple[bool, float, float]:
    """Intersect a ray's line with a tile's arc (radius 24): (meets, t1, t2), distances along the ray in px."""
    a = dx * dx + dy * dy
    b = 2.0 * (dx * fx + dy * fy)
    g = fx * fx + fy * fy - CELL * CELL
    discriminant = b * b - 4.0 * a * g
    if discriminant < 0.0:
        return False, 0.0, 0.0
    k = ieee_divide(1.0, 2.0 * a)
    root = sqrt(discriminant)
    return True, (-b + root) * k, (-b - root) * k


@fast
def ray_concave(
    sx: float, sy: float, cx: float, cy: float, x: float, y: float, dx: float, dy: float
) -> tuple[bool, float, float]:
    """Hit a concave tile: the ray passes the chord between the arc's ends, then meets the far side of the circle."""
    if not sx * dx + sy * dy < 0.0:
        return False, 0.0, 0.0
    ex = cx - x
    ey = cy - y
    ux = sx * HALF
    uy = -sy * HALF
    kappa = ieee_divide(dy * ex - dx * ey, dx * uy - dy * ux)
    if 1.0 < abs(kappa):
        return False, 0.0, 0.0
    meets, t1, t2 = arc_roots(-ux - ex, uy - ey, dx, dy)
    if not meets:
        return False, 0.0, 0.0
    t = t1 if t2 < t1 else t2
    return True, x + t * dx, y + t * dy


@fast
def ray_convex(
    sx: float, sy: float, cx: float, cy: float, x: float, y: float, dx: float, dy: float
) -> tuple[bool, float, float]:
    """Hit a convex tile: the near side of the whole circle. Quirk: this stops a ray that moves away from it, too."""
    meets, t1, t2 = arc_roots(x - (cx - sx * HALF), y - (cy - sy * HALF), dx, dy)
    if not meets:
        return False, 0.0, 0.0
    t = t2 if t2 < t1 else t1
    return True, x + t * dx, y + t * dy
