"""The cells and tiles of shapes: lines, curves, boxes and ellipses, ramps, slopes at the corners of rock."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping
from functools import cache
from itertools import accumulate, pairwise
from math import cos, dist, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

from ninja_game.editor.draft import Draft, Tiles, changed_cells
from ninja_game.editor.motion import FLIP, MIRROR
from ninja_game.editor.palette import EMPTY, FAMILIES, FULL, QUARTERS, cells_between
from ninja_game.editor.stamp import area_around, area_between, area_cells
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside
from ninja_game.sim.rules import CELL, HALF

_PIECES = 64  # straight pieces of a curve

_DIAGONAL = "1"  # family of the slopes of 45°
_STEEP = ("2", "6")  # families of the thin and the thick end of a slope of 67°
_GENTLE = ("3", "7")  # the same of 22°
_SLOPES = {family.key: family.tiles for family in FAMILIES if family.key in (_DIAGONAL, *_STEEP, *_GENTLE)}
_SOFT = {FULL, *(tile for tiles in _SLOPES.values() for tile in tiles)}
"""Tiles that automatic slopes may replace; other ones stay."""
_AIR = dict(zip(((1, 1), (-1, 1), (1, -1), (-1, -1)), range(len(QUARTERS)), strict=True))
"""The quarter of a slope by the sides, right or left and below or above, with air."""
_OTHER_HALF = {
    _SLOPES[key][quarter]: (dx * sign * along, dy * sign * (1 - along))
    for keys, along in ((_STEEP, 0), (_GENTLE, 1))
    for key, sign in zip(keys, (-1, 1), strict=True)
    for (dx, dy), quarter in _AIR.items()
}
"""Offset of the other half of a slope of two tiles, cells."""


class _Stretch(NamedTuple):
    """A piece of an edge of rock: cells to the right and up, slope at both ends in degrees, tiles."""

    right: int
    up: int
    begins: float
    ends: float
    tiles: tuple[int, ...] = ()


_STRETCHES = (
    _Stretch(1, 0, 0.0, 0.0), _Stretch(0, 1, 90.0, 90.0), _Stretch(1, 1, 90.0, 0.0, (FAMILIES[7].tiles[3],)),
    _Stretch(1, 1, 45.0, 45.0, (_SLOPES[_DIAGONAL][3],)),
    _Stretch(2, 1, 26.6, 26.6, tuple(_SLOPES[key][3] for key in _GENTLE)),
    _Stretch(1, 2, 63.4, 63.4, tuple(_SLOPES[key][3] for key in _STEEP)),
)  # fmt: skip
"""Pieces for the upper left quarter of an ellipse: full at its lower right."""
_TURN = 2e-4  # cost of a turn, cells of area per square degree
_MAX_STEP = 4  # longer steps, or steps ending farther apart on both sides, are treated alike


def curve(shape: str, a: Point, b: Point, bend: float = 0.0) -> list[Point]:
    """Points of a line from a to b, its middle ``bend`` px to the right of it, or of the ellipse in their box, px."""
    (ax, ay), (bx, by) = a, b
    if shape == "ellipse":
        turns = [2 * pi * k / _PIECES - pi / 2 for k in range(_PIECES)]
        outline = [((ax + bx + (bx - ax) * cos(t)) / 2, (ay + by + abs(by - ay) * sin(t)) / 2) for t in turns]
        return [*outline, outline[0]]
    length = hypot(bx - ax, by - ay) or 1.0
    across = (ay - by) / length, (bx - ax) / length
    shares = [k / _PIECES for k in range(_PIECES + 1)] if bend else [0.0, 1.0]
    bends = [4 * bend * share * (1 - share) for share in shares]
    return [
        (ax + (bx - ax) * share + across[0] * sideways, ay + (by - ay) * share + across[1] * sideways)
        for share, sideways in zip(shares, bends, strict=True)
    ]


def spaced_places(path: list[Point], spacing: float) -> list[Point]:
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
        start, end = ((CELL * column + HALF, CELL * row + HALF) for column, row in (a, b))
        path = [cell_of(*point) for point in curve(shape, start, end, bend)]
        return [cell for ends in pairwise(path) for cell in cells_between(*ends)]
    column, row, columns, rows = area
    x, y = column + (columns - 1) / 2, row + (rows - 1) / 2
    return [
        (i, j) for i, j in area_cells(area) if shape == "rectangle" or hypot((i - x) / columns, (j - y) / rows) <= 0.5
    ]


def ramp_cells(cells: list[Cell]) -> list[Cell]:
    """A line of cells, doubled if it slants: two cells side by side make a ramp."""
    _, _, columns, rows = area_around(cells)
    dx, dy = (0, 1) if columns >= rows else (1, 0)
    return cells if 1 in (columns, rows) else [*cells, *((x + dx, y + dy) for x, y in cells)]


def ramp(a: Cell, b: Cell) -> Tiles:
    """The tiles of a line, one cell thick: slopes of 22° or 67°, of 45° between, else full; {} if it does not slant."""
    steep = abs(b[1] - a[1]) > abs(b[0] - a[0])

    def turned(cell: Cell) -> Cell:
        """A steep ramp is a gentle one with x and y exchanged."""
        return (cell[1], cell[0]) if steep else cell

    (x, y), end = sorted((turned(a), turned(b)), key=lambda cell: cell[1])
    down, long = end[1] - y, abs(end[0] - x) + 1
    side = 1 if end[0] > x else -1
    if not down:
        return {}
    # It ends at its last cell, or one row lower if slopes alone then fill its length.
    drops = down + (long <= 2 * down or long == 2 * down + 2)
    tiles, slopes = {}, _STEEP if steep else _GENTLE
    if drops == down:
        tiles[end] = FULL
        long -= 1
    for k in range(drops):
        run = long * (k + 1) // drops - long * k // drops
        keys = (_DIAGONAL,) if run == 1 else slopes
        for left in range(run, 0, -1):
            if left > 2:
                tiles[x, y] = FULL
            else:
                tiles[x, y] = _SLOPES[keys[left - 1]][_AIR[turned((side, -1))]]
                tiles[x, y + 1] = _SLOPES[keys[-left]][_AIR[turned((-side, 1))]]
            x += side
        y += 1
    return {turned(cell): tile for cell, tile in tiles.items()}


def stair_cells(cells: list[Cell]) -> list[Cell]:
    """Of a line, for two cells that touch only at a corner: the cell below the upper one, so that slopes join them."""
    return [(min(a, b, key=lambda cell: cell[1])[0], max(a[1], b[1])) for a, b in pairwise(cells) if dist(a, b) > 1]


def behind(cells: list[Cell], tile: int) -> list[Cell]:
    """Of a line of slopes or curves, the cells on their solid side where two touch only at a corner."""
    filling = (family.tiles for family in FAMILIES if family.key != "5")
    quarter = next((tiles.index(tile) for tiles in filling if tile in tiles), -1)
    if quarter < 0:
        return []
    dx, dy = next(air for air, of in _AIR.items() if of == quarter)
    corners = list[Cell]()
    for (ax, ay), (bx, by) in pairwise(cells):
        if (ax, ay) != (bx, by):
            corners += {(ax - dx, ay), (ax, ay - dy)} & {(bx - dx, by), (bx, by - dy)}
    return corners


def sloped(before: Draft, after: Draft) -> Draft:
    """The draft after a stroke of full or empty tiles, with slopes at the corners of rock that it touched.

    Steps of one cell become slopes of 45°, longer ones end in a slope of 22° or 67°; other corners are cut at 45°. Only
    the changed cells and their neighbours get other tiles, with the other halves of slopes of two tiles there.
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


@cache
def rounded(columns: int, rows: int) -> Mapping[Cell, int]:
    """The full tiles, slopes and curves, by column and row from 0 on, most like the ellipse of that many cells.

    The edge of its upper left quarter, from its left end up to its top, is the cheapest path of _STRETCHES over the
    corners of cells: by the area between path and ellipse, and by the turns between stretches. The rest is its image.
    """
    width, height = (columns + 1) // 2, (rows + 1) // 2

    @cache
    def between(at: Cell, stretch: _Stretch) -> float:
        """The area between a stretch from a corner and the ellipse, cells."""
        shares = [(k + 0.5) / _PIECES for k in range(_PIECES)]
        tops = [rows / 2 * (1 - sqrt(1 - (1 - 2 * (at[0] + stretch.right * s) / columns) ** 2)) for s in shares]
        paths = [at[1] - stretch.up * (sqrt(s * (2 - s)) if stretch.ends != stretch.begins else s) for s in shares]
        return stretch.right * sum(abs(a - b) for a, b in zip(tops, paths, strict=True)) / _PIECES

    @cache
    def cheapest(at: Cell, heading: float) -> tuple[float, tuple[_Stretch, ...]]:
        """The cost of the cheapest path from a corner of cells to the top, and the path; ``heading``: before it."""
        if at == (width, 0):
            return _TURN * heading**2, ()
        choices: list[tuple[float, tuple[_Stretch, ...]]] = [(inf, ())]
        for stretch in _STRETCHES:
            x, y = at[0] + stretch.right, at[1] - stretch.up
            # The path begins upright in a middle row and ends flat in a middle column; no cell at its ends stays empty.
            last = x == width and stretch.up and (columns % 2 or not stretch.right)
            first = at[1] == height and stretch.right and (rows % 2 or not stretch.up)
            if x <= width and y >= 0 and stretch.begins <= heading and not (first or last):
                cost, path = cheapest((x, y), stretch.ends)
                cost += between(at, stretch) + _TURN * (stretch.begins - heading) ** 2
                choices.append((cost, (stretch, *path)))
        return min(choices, key=lambda choice: choice[0])

    tiles, (x, y) = dict[Cell, int](), (0, height)
    for stretch in cheapest((0, height), 90.0)[1]:
        tiles |= dict.fromkeys(((i, j) for i in range(x, x + stretch.right) for j in range(y, height)), FULL)
        y -= stretch.up
        boxed = area_cells((x, y, stretch.right, stretch.up))
        tiles |= dict(zip(boxed, stretch.tiles, strict=True))
        x += stretch.right
    for i, j in area_cells((0, 0, columns, rows)):
        tile = tiles.get((min(i, columns - 1 - i), min(j, rows - 1 - j)), EMPTY)
        tile = MIRROR.tile(tile) if i >= width else tile
        tiles[i, j] = FLIP.tile(tile) if j >= height else tile
    return {cell: tile for cell, tile in tiles.items() if tile != EMPTY}


def _corner(draft: Draft, cell: Cell, near: set[Cell]) -> Tiles:
    """The slope of a cell with air on two adjacent sides, and the thick end behind it, if there is one."""
    column, row = cell

    def rock(i: int, j: int) -> bool:
        return draft.tile((column + i, row + j)) != EMPTY

    open_x, open_y = [i for i in (-1, 1) if not rock(i, 0)], [j for j in (-1, 1) if not rock(0, j)]
    if len(open_x) != 1 or len(open_y) != 1:
        return {}
    (dx,), (dy,) = open_x, open_y
    quarter = _AIR[dx, dy]
    # Width and height of the step that ends here, cells: behind it the rock rises, continues, or ends (0).
    width = next((n for n in range(1, _MAX_STEP) if rock(-dx * n, dy) and rock(-dx * n, 0)), _MAX_STEP)
    height = next((n for n in range(1, _MAX_STEP) if rock(dx, -dy * n) and rock(0, -dy * n)), _MAX_STEP)
    width *= all(rock(-dx * n, 0) for n in range(1, width))
    height *= all(rock(0, -dy * n) for n in range(1, height))
    thin, thick, next_cell = (*_GENTLE, (column - dx, row)) if width > height else (*_STEEP, (column, row - dy))
    if min(width, height) != 1 or width == height or next_cell not in near:
        return {cell: _SLOPES[_DIAGONAL][quarter]}
    return {cell: _SLOPES[thin][quarter], next_cell: _SLOPES[thick][quarter]}
