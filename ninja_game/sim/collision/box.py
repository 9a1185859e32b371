"""AABB against the tile map: the stages of the circle, with the box's own rules for corners (world.md §5)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.arithmetic import ieee_divide
from ninja_game.sim.collision.circle_contacts import NO_CONTACT, SHAPE_CONTACT, SIDE_CONTACT
from ninja_game.sim.collision.tiles import (
    ANCHOR_X,
    ANCHOR_Y,
    CENTRE_X,
    CENTRE_Y,
    CONCAVE,
    CONVEX,
    EMPTY,
    FULL,
    NORMAL_X,
    NORMAL_Y,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    THIN_22,
    THIN_67,
    UNDEFINED,
)
from ninja_game.sim.grid import cell_at
from ninja_game.sim.ninja.contact_response import push_from_tile
from ninja_game.sim.rules import CELL, DOWN, HALF, LEFT, OFF, RADIUS, RIGHT, SOLID, STRIDE, UP
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import TileMap, World

BOX_HALF = RADIUS  # half width and half height of the ninja as a box, px


@fast
def collide_box(tiles: TileMap, w: World) -> None:
    """Push the ninja's box out of the tiles and solid edges that it touches."""
    n = w.ninja
    cell = cell_at(n.x, n.y)
    if cell == 0:
        return
    ids = tiles.ids
    edges = w.edges
    cx = CENTRE_X[cell]
    cy = CENTRE_Y[cell]
    if ids[cell]:
        collide_own_tile(w, ids[cell], cx, cy)

    dy = n.y - cy
    oy = (abs(dy) + BOX_HALF) - HALF
    side_v = UP if dy < 0.0 else DOWN
    hy = 1.0 if dy < 0.0 else -1.0
    edge_v = edges[4 * cell + side_v]
    kind_v = NO_CONTACT
    if oy > 0.0:
        if edge_v == SOLID:
            push_from_tile(w, 0.0, oy * hy, 0.0, hy)
            kind_v = SIDE_CONTACT
        elif edge_v != OFF:
            neighbour = cell - STRIDE if side_v == UP else cell + STRIDE
            kind_v = collide_tile(w, ids[neighbour], CENTRE_X[neighbour], CENTRE_Y[neighbour], 0.0, oy * hy)

    dx = n.x - cx
    ox = (abs(dx) + BOX_HALF) - HALF
    side_h = LEFT if dx < 0.0 else RIGHT
    hx = 1.0 if dx < 0.0 else -1.0
    edge_h = edges[4 * cell + side_h]
    kind_h = NO_CONTACT
    if ox > 0.0:
        if edge_h == SOLID:
            push_from_tile(w, ox * hx, 0.0, hx, 0.0)
            kind_h = SIDE_CONTACT
        elif edge_h != OFF:
            neighbour = cell - 1 if side_h == LEFT else cell + 1
            kind_h = collide_tile(w, ids[neighbour], CENTRE_X[neighbour], CENTRE_Y[neighbour], ox * hx, 0.0)

    if oy > 0.0 and ox > 0.0 and kind_v != SIDE_CONTACT and kind_h != SIDE_CONTACT:
        collide_corner(tiles, w, cell, edge_h, edge_v, ox * hx, hx, oy * hy, hy)


@fast
def collide_corner(
    tiles: TileMap, w: World, cell: int, edge_h: int, edge_v: int, push_h: float, hx: float, push_v: float, hy: float
) -> None:
    """Collide with the cell at the corner. ``push_h``, ``push_v``: how far a solid edge there pushes the box, px.

    Do not test whether the new overlaps are still positive: in replays a box that a slope has freed is pulled back.
    """
    n = w.ninja
    dx = n.x - CENTRE_X[cell]
    dy = n.y - CENTRE_Y[cell]
    ox = (abs(dx) + BOX_HALF) - HALF
    oy = (abs(dy) + BOX_HALF) - HALF
    corner = 0
    if dx != 0.0 and dy != 0.0:
        side_h = LEFT if dx < 0.0 else RIGHT
        side_v = UP if dy < 0.0 else DOWN
        beside = cell - 1 if dx < 0.0 else cell + 1
        above = cell - STRIDE if dy < 0.0 else cell + STRIDE
        corner = above + (beside - cell)
        edge_h = w.edges[4 * above + side_h]
        edge_v = w.edges[4 * beside + side_v]
    if ox < oy:
        a = ox if dx < 0.0 else -ox
        b = 0.0
        mx = 1.0 if dx < 0.0 else -1.0
        my = 0.0
    else:
        a = 0.0
        b = oy if dy < 0.0 else -oy
        mx = 0.0
        my = 1.0 if dy < 0.0 else -1.0
    if edge_h == SOLID and edge_v == SOLID:
        push_from_tile(w, a, b, mx, my)
        return
    if edge_h == OFF and edge_v == SOLID:
        push_from_tile(w, 0.0, push_v, 0.0, hy)
        return
    if edge_h == SOLID and edge_v == OFF:
        push_from_tile(w, push_h, 0.0, hx, 0.0)
        return
    if edge_h == OFF and edge_v == OFF:
        return
    if collide_tile(w, tiles.ids[corner], CENTRE_X[corner], CENTRE_Y[corner], a, b) == NO_CONTACT:
        if edge_v == SOLID:
            push_from_tile(w, 0.0, push_v, 0.0, hy)
        elif edge_h == SOLID:
            push_from_tile(w, push_h, 0.0, hx, 0.0)


@fast
def collide_own_tile(w: World, tile: int, cx: float, cy: float) -> None:
    """Collide with the tile of the centre's cell. The candidate push is the shortest way out of that cell."""
    dx = w.ninja.x - cx
    dy = w.ninja.y - cy
    ox = (HALF + BOX_HALF) - abs(dx)
    oy = (HALF + BOX_HALF) - abs(dy)
    if ox < oy:
        collide_tile(w, tile, cx, cy, -ox if dx < 0.0 else ox, 0.0)
    else:
        collide_tile(w, tile, cx, cy, 0.0, -oy if dy < 0.0 else oy)


@fast
def push_along_candidate(w: World, a: float, b: float) -> int:
    """AX: push the box by the candidate (a, b) itself."""
    m = sqrt(a * a + b * b)
    push_from_tile(w, a, b, ieee_divide(a, m), ieee_divide(b, m))
    return SIDE_CONTACT


@fast
def collide_tile(w: World, tile: int, cx: float, cy: float, a: float, b: float) -> int:
    """Collide the box with one tile; (a, b) is the candidate push, px. Gives the kind of contact."""
    shape = SHAPE[tile]
    if shape == EMPTY or shape == UNDEFINED:
        return NO_CONTACT
    if shape == FULL:
        return push_along_candidate(w, a, b)
    sx = SIGN_X[tile]
    sy = SIGN_Y[tile]
    kx = w.ninja.x - sx * BOX_HALF
    ky = w.ninja.y - sy * BOX_HALF
    m = sqrt(a * a + b * b)
    if shape == CONCAVE:
        dx = (cx + sx * HALF) - kx
        dy = (cy + sy * HALF) - ky
        length = sqrt(dx * dx + dy * dy)
        return push_from_arc(w, dx, dy, length, length - CELL, a, b, m)
    if shape == CONVEX:
        dx = kx - (cx - sx * HALF)
        dy = ky - (cy - sy * HALF)
        if sx * dx < 0.0 or sy * dy < 0.0:
            return push_along_candidate(w, a, b)
        length = sqrt(dx * dx + dy * dy)
        depth = CELL - length
        if depth > 0.0:
            dx = ieee_divide(dx, length)
            dy = ieee_divide(dy, length)
            push_from_tile(w, dx * depth, dy * depth, dx, dy)
            return SHAPE_CONTACT
        return NO_CONTACT
    nx = NORMAL_X[tile]
    ny = NORMAL_Y[tile]
    depth = (kx - (cx + ANCHOR_X[tile])) * nx + (ky - (cy + ANCHOR_Y[tile])) * ny
    if shape == THIN_22:
        gap = cy - ky
        if gap * sy > 0.0 and depth < 0.0:
            return push_from_wedge(w, depth, nx, ny, 0.0, gap, a, b, m)
        return NO_CONTACT
    if shape == THIN_67:
        gap = cx - kx
        if gap * sx > 0.0 and depth < 0.0:
            return push_from_wedge(w, depth, nx, ny, gap, 0.0, a, b, m)
        return NO_CONTACT
    if depth < 0.0:
        qx = nx * (-depth)
        qy = ny * (-depth)
        if m < sqrt(qx * qx + qy * qy):
            return push_along_candidate(w, a, b)
        push_from_tile(w, qx, qy, nx, ny)
        return SHAPE_CONTACT
    return NO_CONTACT


@fast
def push_from_wedge(
    w: World, depth: float, nx: float, ny: float, gap_x: float, gap_y: float, a: float, b: float, m: float
) -> int:
    """Push the box out of a thin wedge by the least way: over its flat side (the gap), the candidate or its normal."""
    qx = nx * (-depth)
    qy = ny * (-depth)
    q = sqrt(qx * qx + qy * qy)
    gap = abs(gap_x + gap_y)
    if gap < (m if m < q else q):
        push_from_tile(w, gap_x, gap_y, gap_x / gap, gap_y / gap)
        return SHAPE_CONTACT
    if m < q:
        return push_along_candidate(w, a, b)
    push_from_tile(w, qx, qy, nx, ny)
    return SHAPE_CONTACT


@fast
def push_from_arc(w: World, dx: float, dy: float, length: float, depth: float, a: float, b: float, m: float) -> int:
    """Push the box out of the hollow arc of a concave tile."""
    if depth > 0.0:
        if m < depth:
            return push_along_candidate(w, a, b)
        dx = dx / length
        dy = dy / length
        push_from_tile(w, dx * depth, dy * depth, dx, dy)
        return SHAPE_CONTACT
    return NO_CONTACT
