"""Circle against the tile map: at most four touched cells, edges first, shapes only where an edge is interesting.

world.md §4. The order is fixed: own, vertical, horizontal, diagonal. Each contact moves the body at once, and there is
exactly one pass. (hx, hy) always points from the neighbour to the body.
"""

from __future__ import annotations

from ninja_game.sim.collision.circle_contacts import NO_CONTACT, SIDE_CONTACT, push_from_corner
from ninja_game.sim.collision.circle_neighbours import collide_diagonal, collide_horizontal, collide_vertical
from ninja_game.sim.collision.circle_own_tile import collide_own_tile
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import cell_at
from ninja_game.sim.ninja.contact_response import push_from_tile
from ninja_game.sim.rules import DOWN, HALF, LEFT, OFF, RADIUS, RIGHT, ROOT2, SOLID, STRIDE, UP
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import TileMap, World


@fast
def collide_circle(tiles: TileMap, w: World) -> None:
    """Push the ninja's circle out of the tiles and solid edges that it touches."""
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
    oy = (abs(dy) + RADIUS) - HALF
    kind_v = NO_CONTACT
    side_v = DOWN
    hy = -1.0
    if oy > 0.0:
        if dy < 0.0:
            side_v = UP
            hy = 1.0
        edge = edges[4 * cell + side_v]
        if edge == SOLID:
            push_from_tile(w, 0.0, oy * hy, 0.0, hy)
            kind_v = SIDE_CONTACT
        elif edge != OFF:
            neighbour = cell - STRIDE if side_v == UP else cell + STRIDE
            kind_v = collide_vertical(w, ids[neighbour], CENTRE_X[neighbour], CENTRE_Y[neighbour], oy, hy)

    dx = n.x - cx
    ox = (abs(dx) + RADIUS) - HALF
    kind_h = NO_CONTACT
    side_h = RIGHT
    hx = -1.0
    if ox > 0.0:
        if dx < 0.0:
            side_h = LEFT
            hx = 1.0
        edge = edges[4 * cell + side_h]
        if edge == SOLID:
            push_from_tile(w, ox * hx, 0.0, hx, 0.0)
            kind_h = SIDE_CONTACT
        elif edge != OFF:
            neighbour = cell - 1 if side_h == LEFT else cell + 1
            kind_h = collide_horizontal(w, ids[neighbour], CENTRE_X[neighbour], CENTRE_Y[neighbour], ox, hx)

    if oy > 0.0 and ox > 0.0 and kind_v != SIDE_CONTACT and kind_h != SIDE_CONTACT:
        beside = cell - 1 if side_h == LEFT else cell + 1
        above = cell - STRIDE if side_v == UP else cell + STRIDE
        corner = above + (beside - cell)
        edge_h = edges[4 * above + side_h]
        edge_v = edges[4 * beside + side_v]
        if edge_h == SOLID or edge_v == SOLID:
            cx = CENTRE_X[corner]
            cy = CENTRE_Y[corner]
            push_from_corner(w, cx + hx * HALF, cy + hy * HALF, hx / ROOT2, hy / ROOT2)
        elif edge_h != OFF or edge_v != OFF:
            collide_diagonal(w, ids[corner], CENTRE_X[corner], CENTRE_Y[corner], hx, hy)
