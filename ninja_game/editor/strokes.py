"""Strokes: the cells that lines, bent lines and ellipses cover, places along them, and slopes that set themselves."""

from __future__ import annotations

from bisect import bisect_right
from itertools import accumulate, pairwise
from math import cos, dist, hypot, pi, sin

from ninja_game.editor.brush import EMPTY, FAMILIES, FULL, QUARTERS, cells_between
from ninja_game.editor.draft import Cell, Draft, Tiles, cell_of, changed_cells, is_inside
from ninja_game.editor.specs import Point
from ninja_game.editor.stamp import area_between, cells_of

_PIECES = 64
"""Straight pieces of a curve."""

_SLOPES = {family.key: family.tiles for family in FAMILIES if family.key in "12367"}
_STEEP, _GENTLE = ("2", "6"), ("3", "7")
"""Families of the thin and the thick end of a slope of 67° and of 22°; "1": 45°."""
_SOFT = {FULL, *(tile for tiles in _SLOPES.values() for tile in tiles)}
"""Tiles that are rock whose shape is found; other ones stay as they are."""
_AIR = dict(zip(((1, 1), (-1, 1), (1, -1), (-1, -1)), range(len(QUARTERS)), strict=True))
"""The quarter of a slope by the sides, right or left and below or above, where it has air."""
_OTHER_HALF = {
    _SLOPES[key][quarter]: (dx * sign * along, dy * sign * (1 - along))
    for keys, along in ((_STEEP, 0), (_GENTLE, 1))
    for key, sign in zip(keys, (-1, 1), strict=True)
    for (dx, dy), quarter in _AIR.items()
}
"""Where the other half of a slope of two tiles is, cells from it."""
_LONGEST = 4
"""Steps that are longer, or end on both sides farther apart, are all alike."""


def curve(shape: str, a: Point, b: Point, bend: float = 0.0) -> list[Point]:
    """Points of a line from a to b, its middle ``bend`` px to the right of it, or of the ellipse in their box, px."""
    (ax, ay), (bx, by) = a, b
    if shape == "ellipse":
        turns = [2 * pi * k / _PIECES - pi / 2 for k in range(_PIECES)]
        points = [((ax + bx + (bx - ax) * cos(t)) / 2, (ay + by + abs(by - ay) * sin(t)) / 2) for t in turns]
        return [*points, points[0]]
    length = hypot(bx - ax, by - ay) or 1.0
    across = (ay - by) / length, (bx - ax) / length
    shares = [k / _PIECES for k in range(_PIECES + 1)] if bend else [0.0, 1.0]
    bends = [4 * bend * share * (1 - share) for share in shares]
    return [
        (ax + (bx - ax) * share + across[0] * aside, ay + (by - ay) * share + across[1] * aside)
        for share, aside in zip(shares, bends, strict=True)
    ]


def spread(path: list[Point], spacing: float) -> list[Point]:
    """Places along a path, evenly and about ``spacing`` px apart, from its first point to its last."""
    lengths = list(accumulate((dist(*ends) for ends in pairwise(path)), initial=0.0))
    count = max(1, round(lengths[-1] / spacing))
    places = []
    for k in range(count + (path[0] != path[-1])):
        at = lengths[-1] * k / count
        n = min(bisect_right(lengths, at), len(path) - 1)
        share = (at - lengths[n - 1]) / ((lengths[n] - lengths[n - 1]) or 1.0)
        (ax, ay), (bx, by) = path[n - 1], path[n]
        places.append((ax + (bx - ax) * share, ay + (by - ay) * share))
    return places


def covered(shape: str, a: Cell, b: Cell, bend: float) -> list[Cell]:
    """The cells of a box or of the ellipse in it, filled, or those of a line."""
    area = area_between(a, b)
    if shape == "line":
        start, end = ((24.0 * column + 12, 24.0 * row + 12) for column, row in (a, b))
        path = [cell_of(*point) for point in curve(shape, start, end, bend)]
        return [cell for ends in pairwise(path) for cell in cells_between(*ends)]
    column, row, columns, rows = area
    x, y = column + (columns - 1) / 2, row + (rows - 1) / 2
    return [
        (i, j) for i, j in cells_of(area) if shape == "rectangle" or hypot((i - x) / columns, (j - y) / rows) <= 0.5
    ]


def joined(cells: list[Cell]) -> list[Cell]:
    """A line of cells, and if it slants those beside it, so that they touch at their sides: two make a ramp."""
    (left, right), (top, bottom) = ((min(along), max(along)) for along in zip(*cells, strict=True))
    dx, dy = (0, 1) if right - left >= bottom - top else (1, 0)
    return cells if left == right or top == bottom else [*cells, *((x + dx, y + dy) for x, y in cells)]


def sloped(before: Draft, after: Draft) -> Draft:
    """The draft after a stroke of full or empty tiles, with slopes at corners of the rock that it has touched.

    Steps of one cell become slopes of 45°, longer ones end in a slope of 22° or 67°; other corners are cut at 45°.
    Only what changed and the cells round it become other tiles, with the other halves of slopes of two tiles there.
    """
    steps = (-1, 0, 1)
    near = {(x + i, y + j) for x, y in changed_cells(before, after) for i in steps for j in steps}
    halves = {(x, y): _OTHER_HALF.get(after.tile((x, y)), (0, 0)) for x, y in near}
    near = {cell for cell in near.union((x + i, y + j) for (x, y), (i, j) in halves.items()) if is_inside(cell)}
    tiles: Tiles = dict.fromkeys(near, FULL)
    for cell in near:
        if after.tile(cell) in _SOFT:
            tiles |= _corner(after, cell, near)
    return after.with_tiles({cell: tile for cell, tile in tiles.items() if after.tile(cell) in _SOFT})


def _corner(draft: Draft, cell: Cell, near: set[Cell]) -> Tiles:
    """The slope of a cell with air on two sides that meet, and the thick end behind it, if it has one there."""
    column, row = cell

    def rock(i: int, j: int) -> bool:
        return draft.tile((column + i, row + j)) != EMPTY

    open_x, open_y = [i for i in (-1, 1) if not rock(i, 0)], [j for j in (-1, 1) if not rock(0, j)]
    if len(open_x) != 1 or len(open_y) != 1:
        return {}
    (dx,), (dy,) = open_x, open_y
    quarter = _AIR[dx, dy]
    # How many cells wide and high the step is that ends here: behind it the rock rises, or goes on, or ends (0).
    wide = next((n for n in range(1, _LONGEST) if rock(-dx * n, dy) and rock(-dx * n, 0)), _LONGEST)
    high = next((n for n in range(1, _LONGEST) if rock(dx, -dy * n) and rock(0, -dy * n)), _LONGEST)
    wide *= all(rock(-dx * n, 0) for n in range(1, wide))
    high *= all(rock(0, -dy * n) for n in range(1, high))
    thin, thick, behind = (*_GENTLE, (column - dx, row)) if wide > high else (*_STEEP, (column, row - dy))
    if min(wide, high) != 1 or wide == high or behind not in near:
        return {cell: _SLOPES["1"][quarter]}
    return {cell: _SLOPES[thin][quarter], behind: _SLOPES[thick][quarter]}
