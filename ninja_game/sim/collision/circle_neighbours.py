"""Circle against a neighbouring tile: above or below, left or right, at the corner (the table of world.md §4.4)."""

from __future__ import annotations

from ninja_game.sim.collision.circle_contacts import (
    NO_CONTACT,
    collide_segment_s,
    collide_segment_t,
    push_from_corner,
    push_from_line,
    push_from_round_side,
    push_from_side,
)
from ninja_game.sim.collision.tiles import (
    CONCAVE,
    CONVEX,
    FULL,
    HALF_TILE,
    S_X,
    S_Y,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    T_X,
    T_Y,
    THICK_22,
    THICK_67,
    THIN_22,
    THIN_67,
    UNDEFINED,
)
from ninja_game.sim.rules import HALF, ROOT2
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import World


@fast
def collide_vertical(w: World, tile: int, cx: float, cy: float, oy: float, hy: float) -> int:
    """Collide with the tile above or below."""
    shape = SHAPE[tile]
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    if shape == UNDEFINED or tile == 0:
        return NO_CONTACT
    if shape == FULL:
        return push_from_side(w, 0.0, oy, 0.0, hy)
    if shape == HALF_TILE:
        facing = sy * hy
        if facing > 0.0:
            return NO_CONTACT
        if facing < 0.0 or (w.ninja.x - cx) * sx < 0.0:
            return push_from_side(w, 0.0, oy, 0.0, hy)
        return push_from_corner(w, cx, cy + hy * HALF, sx / ROOT2, hy / ROOT2)
    if sy * hy < 0.0:
        if shape == THIN_67 and not (w.ninja.x - cx) * sx < 0.0:
            return push_from_corner(w, cx + S_X[tile], cy + S_Y[tile], 0.0, hy / ROOT2)
        return push_from_side(w, 0.0, oy, 0.0, hy)
    if shape == THIN_22:
        return NO_CONTACT
    if shape == THICK_67 and (w.ninja.x - cx) * sx < 0.0:
        return push_from_side(w, 0.0, oy, 0.0, hy)
    if shape == CONCAVE:
        return push_from_corner(w, cx - sx * HALF, cy + sy * HALF, 0.0, hy)
    if shape == CONVEX:
        return push_from_round_side(w, tile, cx, cy)
    return collide_segment_t(w, tile, cx, cy, 0.0, hy)


@fast
def collide_horizontal(w: World, tile: int, cx: float, cy: float, ox: float, hx: float) -> int:
    """Collide with the tile to the left or right."""
    shape = SHAPE[tile]
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    if shape == UNDEFINED or tile == 0:
        return NO_CONTACT
    if shape == FULL:
        return push_from_side(w, ox, 0.0, hx, 0.0)
    if shape == HALF_TILE:
        facing = sx * hx
        if facing > 0.0:
            return NO_CONTACT
        if facing < 0.0 or (w.ninja.y - cy) * sy < 0.0:
            return push_from_side(w, ox, 0.0, hx, 0.0)
        # Quirk: a centre exactly on this point is not pushed; the normal (0, 0) then counts as a wall.
        return push_from_corner(w, cx + hx * HALF, cy, 0.0, 0.0)
    if sx * hx < 0.0:
        if shape == THIN_22 and not (w.ninja.y - cy) * sy < 0.0:
            return push_from_corner(w, cx + T_X[tile], cy + T_Y[tile], hx / ROOT2, 0.0)
        return push_from_side(w, ox, 0.0, hx, 0.0)
    if shape == THIN_67:
        return NO_CONTACT
    if shape == THICK_22 and (w.ninja.y - cy) * sy < 0.0:
        return push_from_side(w, ox, 0.0, hx, 0.0)
    if shape == CONCAVE:
        return push_from_corner(w, cx + sx * HALF, cy - sy * HALF, hx, 0.0)
    if shape == CONVEX:
        return push_from_round_side(w, tile, cx, cy)
    return collide_segment_s(w, tile, cx, cy, hx, 0.0)


@fast
def collide_diagonal(w: World, tile: int, cx: float, cy: float, hx: float, hy: float) -> int:
    """Collide with the tile at the corner: with its corner point, unless the shape leaves that corner open."""
    shape = SHAPE[tile]
    if shape == UNDEFINED or tile == 0:
        return NO_CONTACT
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    facing = sx * hx + sy * hy
    if shape == HALF_TILE:
        if facing > 0.0:
            return NO_CONTACT
    elif shape == THIN_22:
        if sy * hy > 0.0:
            return NO_CONTACT
    elif shape == THIN_67:
        if sx * hx > 0.0:
            return NO_CONTACT
    elif facing > 0.0:
        if shape == THICK_22:
            return push_from_line(w, tile, cx + T_X[tile], cy + T_Y[tile])
        if shape == THICK_67:
            return push_from_line(w, tile, cx + S_X[tile], cy + S_Y[tile])
        if shape == CONVEX:
            return push_from_round_side(w, tile, cx, cy)
        return NO_CONTACT
    return push_from_corner(w, cx + hx * HALF, cy + hy * HALF, hx / ROOT2, hy / ROOT2)
