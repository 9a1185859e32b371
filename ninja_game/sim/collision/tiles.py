"""The 34 tile shapes as tables: class, open side, normal, surface points, faces and edge states (world.md §2-§3)."""

from __future__ import annotations

from ninja_game.sim.rules import (
    CELL,
    GRID_CELLS,
    GRID_COLUMNS,
    GRID_ROWS,
    HALF,
    INTERESTING,
    OFF,
    ROOT2,
    ROOT5,
    SOLID,
    STRIDE,
)
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import TileMap, World

EMPTY, FULL, HALF_TILE, SLOPE_45, CONCAVE, CONVEX, THIN_22, THICK_22, THIN_67, THICK_67, UNDEFINED = range(11)
"""Tile classes. UNDEFINED is a malformed tile: never solid, but not empty for edges (world.md §2.3)."""

ODD_HALF_ID = 34  # the id that replaces a tile id above 33: a half tile without orientation
UNDEFINED_ID = 35  # the id that replaces a tile id below 0

_SIGNS = ((1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0))
_HALF_SIGNS = ((0.0, -1.0), (-1.0, 0.0), (0.0, 1.0), (1.0, 0.0))
_FAMILIES = (SLOPE_45, CONCAVE, CONVEX, THIN_22, THICK_22, THIN_67, THICK_67)
_NORMALS = {
    SLOPE_45: (1.0 / ROOT2, 1.0 / ROOT2),
    THIN_22: (1.0 / ROOT5, 2.0 / ROOT5),
    THICK_22: (1.0 / ROOT5, 2.0 / ROOT5),
    THIN_67: (2.0 / ROOT5, 1.0 / ROOT5),
    THICK_67: (2.0 / ROOT5, 1.0 / ROOT5),
}
_ORIENTED = [(family, sign) for family in _FAMILIES for sign in _SIGNS]

SHAPE = [EMPTY, FULL, *(family for family, _ in _ORIENTED), *[HALF_TILE] * 5, UNDEFINED]
SIGN_X = [0.0, 0.0, *(sign[0] for _, sign in _ORIENTED), *(sign[0] for sign in _HALF_SIGNS), 0.0, 0.0]
SIGN_Y = [0.0, 0.0, *(sign[1] for _, sign in _ORIENTED), *(sign[1] for sign in _HALF_SIGNS), 0.0, 0.0]
NORMAL_X = [0.0, 0.0, *(sign[0] * _NORMALS.get(family, (0.0, 0.0))[0] for family, sign in _ORIENTED)]
NORMAL_Y = [0.0, 0.0, *(sign[1] * _NORMALS.get(family, (0.0, 0.0))[1] for family, sign in _ORIENTED)]
NORMAL_X += [*(sign[0] for sign in _HALF_SIGNS), 0.0, 0.0]
NORMAL_Y += [*(sign[1] for sign in _HALF_SIGNS), 0.0, 0.0]
"""The tables from SHAPE on, per tile id: class, signs σ of the open side, unit surface normal n."""

# Surface end points T (towards the open y side) and S (towards the open x side), in units of σ·12 px (world.md §2.2).
_T = {SLOPE_45: (-1, 1), THIN_22: (-1, 0), THICK_22: (-1, 1), THIN_67: (-1, 1), THICK_67: (0, 1)}
_S = {SLOPE_45: (1, -1), THIN_22: (1, -1), THICK_22: (1, 0), THIN_67: (0, -1), THICK_67: (1, -1)}
_ANCHOR = {SLOPE_45: (0, 0), THIN_22: _S[THIN_22], THICK_22: _T[THICK_22], THIN_67: _T[THIN_67], THICK_67: _S[THICK_67]}


def _offsets(points: dict[int, tuple[int, int]], axis: int) -> list[float]:
    """Offset in px from the cell's centre, per tile id, of one reference point of each class (0: it has none)."""
    signs = (SIGN_X, SIGN_Y)[axis]
    return [HALF * points.get(shape, (0, 0))[axis] * sign for shape, sign in zip(SHAPE, signs, strict=True)]


T_X, T_Y = _offsets(_T, 0), _offsets(_T, 1)
S_X, S_Y = _offsets(_S, 0), _offsets(_S, 1)
ANCHOR_X, ANCHOR_Y = _offsets(_ANCHOR, 0), _offsets(_ANCHOR, 1)
"""The tables from T_X on, per tile id: T, S and the anchor A of box tests and point queries (world.md §5.2), px from
the cell's centre."""

# Faces and edge states (world.md §3).
NO_FACE, PARTIAL_FACE, FULL_FACE = 0, 1, 2
_OUTWARD = ((1, 0), (0, 1), (-1, 0), (0, -1))


def _face(tile: int, side: int) -> int:
    """The face that a tile shows on one side (0 right, 1 down, 2 left, 3 up)."""
    shape = SHAPE[tile]
    if shape == EMPTY:
        return NO_FACE
    if shape == FULL:
        return FULL_FACE
    if (shape == THIN_22 and side in (0, 2)) or (shape == THIN_67 and side in (1, 3)):
        return PARTIAL_FACE
    facing = SIGN_X[tile] * _OUTWARD[side][0] + SIGN_Y[tile] * _OUTWARD[side][1]
    return FULL_FACE if facing < 0 else PARTIAL_FACE


FACE = [_face(tile, side) for tile in range(len(SHAPE)) for side in range(4)]
"""Face of tile id t on side s at index 4 t + s."""

# The tutorial that this design comes from calls its own edge code "complex and prone to bugs" and asks for a simpler
# one. Here an edge depends only on the two faces that touch: the cell's own and the neighbour's. For every pair of
# tiles on every side the result equals the original's.
EDGE_OF_FACES = [OFF, INTERESTING, SOLID, OFF, INTERESTING, SOLID, OFF, INTERESTING, OFF]
"""Edge state at index 3 · own face + neighbour's face."""

NEIGHBOUR_OFFSET = [1, STRIDE, -1, -STRIDE]
"""From a cell to its neighbour right, down, left, up: add this to the grid index."""
UNIT_X = [1.0, 0.0, -1.0, 0.0]
UNIT_Y = [0.0, 1.0, 0.0, -1.0]  # the unit vector of each direction number

CENTRE_X = [0.0] * (GRID_CELLS)
CENTRE_Y = [0.0] * (GRID_CELLS)
COLUMN = [0] * (GRID_CELLS)
ROW = [0] * (GRID_CELLS)
EXISTS = [0] * (GRID_CELLS)
"""The five tables above, per grid index: centre in px, column, row, 1 for a cell of the world.

Index 0 (no cell) has zeros (objects.md §1).
"""
for _row in range(GRID_ROWS):
    for _column in range(GRID_COLUMNS):
        _cell = (_row + 1) * STRIDE + _column + 1
        CENTRE_X[_cell] = CELL * _column + HALF
        CENTRE_Y[_cell] = CELL * _row + HALF
        COLUMN[_cell] = _column
        ROW[_cell] = _row
        EXISTS[_cell] = 1


@fast
def set_edges(tiles: TileMap, w: World) -> None:
    """Derive all edge states from the tiles, as the original does after loading a map."""
    ids = tiles.ids
    edges = w.edges
    for row in range(1, GRID_ROWS + 1):
        start = row * STRIDE + 1
        for cell in range(start, start + GRID_COLUMNS):
            tile = ids[cell]
            for side in range(4):
                neighbour = cell + NEIGHBOUR_OFFSET[side]
                if EXISTS[neighbour]:
                    # The neighbour's touching face is on the opposite side: 0 <-> 2, 1 <-> 3.
                    touching = FACE[4 * ids[neighbour] + (side ^ 2)]
                    edges[4 * cell + side] = EDGE_OF_FACES[3 * FACE[4 * tile + side] + touching]
                else:
                    edges[4 * cell + side] = INTERESTING
