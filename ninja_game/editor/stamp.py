"""Stamps: tiles and objects to draw, copy, paste or mirror; operations on selections."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import accumulate, pairwise
from math import ceil, cos, dist, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

from ninja_game.editor.draft import Draft, Tiles, changed_cells
from ninja_game.editor.motion import FLIP, MIRROR, Motion
from ninja_game.editor.palette import EMPTY, FAMILIES, FULL, QUARTERS, cells_between
from ninja_game.editor.specs import BODY_PART, carried, grip, points
from ninja_game.formats.messages import messages_at
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside
from ninja_game.sim.kinds import DOOR, EXIT, LAUNCH_PAD, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, ObjectSpec
from ninja_game.sim.rules import CELL, HALF, WORLD_HEIGHT, WORLD_WIDTH

CellArea = tuple[int, int, int, int]  # first column, first row, columns, rows
ObjectPart = tuple[int, int]  # number of an object in its draft, and number of its part


class Stamp(NamedTuple):
    """Tiles by cell, and objects, at the places where they would be drawn. Cells may be EMPTY."""

    tiles: Tiles
    objects: tuple[ObjectSpec, ...] = ()

    @property
    def solid(self) -> Stamp:
        """The stamp without its empty cells."""
        return self._replace(tiles={cell: tile for cell, tile in self.tiles.items() if tile != EMPTY})

    def carried(self, motion: Motion) -> Stamp:
        tiles = {motion.cell(cell): motion.tile(tile) for cell, tile in self.tiles.items()}
        return Stamp(tiles, tuple(carried(spec, motion) for spec in self.objects))


@dataclass(frozen=True)
class Selection:
    """What is selected in a draft. ``area``: cells whose tiles are selected. ``parts``: objects, or parts of them."""

    area: CellArea | None = None
    parts: frozenset[ObjectPart] = frozenset()

    def __bool__(self) -> bool:
        return self.area is not None or bool(self.parts)

    @property
    def numbers(self) -> set[int]:
        """Numbers of the objects with a selected part."""
        return {number for number, _ in self.parts}

    def joined(self, other: Selection) -> Selection:
        """Both together, with the cells of this one if it has any."""
        return Selection(self.area or other.area, self.parts | other.parts)


def area_between(a: Cell, b: Cell) -> CellArea:
    column, row = min(a[0], b[0]), min(a[1], b[1])
    return column, row, abs(a[0] - b[0]) + 1, abs(a[1] - b[1]) + 1


def area_around(cells: Iterable[Cell]) -> CellArea:
    """The smallest area with all these cells, of which there is one at least."""
    columns, rows = zip(*cells, strict=True)
    return area_between((min(columns), min(rows)), (max(columns), max(rows)))


def area_cells(area: CellArea) -> list[Cell]:
    column, row, columns, rows = area
    return [(i, j) for j in range(row, row + rows) for i in range(column, column + columns)]


def with_stamp(draft: Draft, stamp: Stamp, symmetry: Iterable[Motion] = ()) -> Draft:
    """Draw a stamp, and its images in a symmetry. New objects come last; there is one ninja, and exits have no images.

    An equal object at the same place is not drawn twice.
    """
    objects, present = draft.objects, set(draft.objects if stamp.objects else ())
    new: dict[ObjectSpec, None] = {}
    tiles: Tiles = {}
    for number, motion in enumerate((Motion(), *symmetry)):
        image = stamp.carried(motion)
        # A cell on the axis is its own mirror image: the stamp wins.
        tiles |= {cell: tile for cell, tile in image.tiles.items() if number == 0 or cell not in stamp.tiles}
        for spec in image.objects:
            if number and spec.kind in (NINJA, EXIT):
                continue
            if spec.kind == NINJA:
                # It replaces the one that plays, the last; the first ninja of a level comes before all objects.
                last = max((place for place, other in enumerate(objects) if other.kind == NINJA), default=-1)
                objects = (*objects[: max(last, 0)], spec, *objects[last + 1 :])
            elif spec not in present:
                new[spec] = None
    return draft.with_tiles(tiles).with_objects(objects + tuple(new))


def filled(draft: Draft, cell: Cell) -> list[Cell]:
    if not is_inside(cell):
        return []
    tile = draft.tile(cell)
    cells = {cell}
    waiting = [cell]
    while waiting:
        column, row = waiting.pop()
        for there in ((column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)):
            if there not in cells and is_inside(there) and draft.tile(there) == tile:
                cells.add(there)
                waiting.append(there)
    return sorted(cells)


def chosen_in(draft: Draft, area: CellArea) -> Selection:
    """An area with all parts of objects in it, or on its edge, as a launch pad on the floor of its cell."""
    column, row, columns, rows = area
    inside = {
        (number, part)
        for number, spec in enumerate(draft.objects)
        for part, (x, y) in points(spec).items()
        if CELL * column <= x <= CELL * (column + columns) and CELL * row <= y <= CELL * (row + rows)
    }
    return Selection(area, frozenset(inside))


def everything(draft: Draft) -> Selection:
    parts = {(number, part) for number, spec in enumerate(draft.objects) for part in points(spec)}
    return Selection((1, 1, COLUMNS, ROWS), frozenset(parts))


def copied(draft: Draft, selection: Selection) -> Stamp:
    """The selection as a stamp; an object with one selected part is copied whole."""
    tiles = {cell: draft.tile(cell) for cell in area_cells(selection.area) if is_inside(cell)} if selection.area else {}
    return Stamp(tiles, tuple(draft.objects[number] for number in sorted(selection.numbers)))


def level_stamp(draft: Draft) -> Stamp:
    """All of a level, from its first to its last column and row with a tile."""
    tiles = [cell for cell in area_cells((1, 1, COLUMNS, ROWS)) if draft.tile(cell)]
    return copied(draft, Selection(area_around(tiles) if tiles else None, everything(draft).parts))


def removed(draft: Draft, selection: Selection) -> Draft:
    tiles = dict.fromkeys(area_cells(selection.area), 0) if selection.area else {}
    kept = tuple(spec for number, spec in enumerate(draft.objects) if number not in selection.numbers)
    return draft.with_tiles(tiles).with_objects(kept)


def reordered(draft: Draft, selection: Selection, by: int) -> tuple[Draft, Selection]:
    """The draft with the selected objects together, moved in the order by a number of places, and their selection."""
    chosen = sorted(selection.numbers)
    rest = [number for number in range(len(draft.objects)) if number not in selection.numbers]
    at = min(max(0, by + (chosen[0] if by < 0 else chosen[-1] + 1 - len(chosen))), len(rest))
    order = [*rest[:at], *chosen, *rest[at:]]
    parts = frozenset((order.index(number), part) for number, part in selection.parts)
    return draft.with_objects(tuple(draft.objects[number] for number in order)), Selection(selection.area, parts)


def moved(draft: Draft, selection: Selection, motion: Motion) -> tuple[Draft, Selection]:
    """The draft with the selection moved or turned, and the selection there. Moved tiles replace those under them."""
    objects = list(draft.objects)
    chosen: dict[int, set[int]] = {}
    for number, part in selection.parts:
        chosen.setdefault(number, set()).add(part)
    for number, parts in chosen.items():
        objects[number] = carried(objects[number], motion, parts)
    area = None
    tiles: Tiles = {}
    if selection.area is not None:
        tiles = dict.fromkeys(area_cells(selection.area), 0)
        tiles |= copied(draft, Selection(selection.area)).carried(motion).tiles
        column, row, columns, rows = selection.area
        area = area_between(motion.cell((column, row)), motion.cell((column + columns - 1, row + rows - 1)))
    return draft.with_tiles(tiles).with_objects(tuple(objects)), Selection(area, selection.parts)


def arranged(draft: Draft, selection: Selection, axis: int, share: float | None) -> Draft:
    """The draft with all selected parts of objects at one x (``axis`` 0) or y (1), or spread along it; tiles stay.

    ``share``: the common place between the least and the greatest; None: spread evenly between these. To the px; doors
    go by cells.
    """
    places = {part: points(draft.objects[part[0]])[part[1]][axis] for part in selection.parts}
    order = sorted(places, key=lambda part: (places[part], part))
    low, high = places[order[0]], places[order[-1]]
    objects = list(draft.objects)
    for k, part in enumerate(order):
        goal = low + (high - low) * (k / (len(order) - 1) if share is None else share)
        by = (goal if goal in (low, high) else round(goal)) - places[part]
        objects[part[0]] = carried(objects[part[0]], Motion(dx=by) if axis == 0 else Motion(dy=by), part[1:])
    return draft.with_objects(tuple(objects))


def pasted(draft: Draft, stamp: Stamp, *, empty: bool = False) -> tuple[Draft, Selection]:
    """The draft with a stamp on it, and the selection of the pasted things: objects are added, but a ninja moves.

    ``empty``: its empty cells remove tiles.
    """
    after, stamped = with_stamp(draft, stamp if empty else stamp.solid), set(stamp.objects)
    new = {number for number, spec in enumerate(after.objects) if spec in stamped}
    parts = {(number, part) for number in new for part in points(after.objects[number])}
    return after, Selection(area_around(stamp.tiles) if stamp.tiles else None, frozenset(parts))


def centred(stamp: Stamp, place: Point, step: float) -> Stamp:
    """A stamp moved until its middle is near a place, and it is within the level if it fits.

    It moves by whole cells if it has tiles, else by steps of that size in px.
    """
    cells = [(CELL * column + at, CELL * row + at) for column, row in stamp.tiles for at in (0.0, CELL)]
    # Only pads and doors may lie on the border's edge.
    rims = [(spec, 0.0 if spec.kind in (DOOR, LAUNCH_PAD) else 0.5) for spec in stamp.objects]
    ends = [(x + d, y + d) for spec, rim in rims for x, y in points(spec).values() for d in (-rim, rim)]
    if not (cells or ends):
        return stamp
    step, moves = CELL if cells else step, []
    sides = zip(*cells, *ends, strict=True)
    for along, at, end in zip(sides, place, (WORLD_WIDTH, WORLD_HEIGHT), strict=True):
        low, high = min(along), max(along)
        by = step * round((at - (low + high) / 2) / step)
        # The border stays free, by whole steps.
        by += step * max(0, ceil((CELL - low - by) / step))
        moves.append(by - step * max(0, ceil((high + by - end + CELL) / step)))
    return stamp.carried(Motion(dx=moves[0], dy=moves[1]))


def turning_centre(draft: Draft, selection: Selection, *, quarter: bool) -> tuple[float, float]:
    """The centre for turning a selection, px, so that cells fall onto cells; ``quarter``: by a quarter turn.

    If its middle is no such point, it is one to the right and to the left in turn: four turns change nothing.
    """
    if selection.area:
        column, row, columns, rows = selection.area
        x, y = CELL * column + HALF * columns, CELL * row + HALF * rows
    else:
        places = [points(draft.objects[number])[part] for number, part in selection.parts]
        xs, ys = zip(*places, strict=True)
        x, y = (HALF * round((min(along) + max(along)) / CELL) for along in (xs, ys))
    sideways = (x + y) % CELL * quarter
    return x + (sideways if x % CELL == 0.0 else -sideways), y


def nearest_part(draft: Draft, x: float, y: float, reach: float) -> ObjectPart | None:
    """The part of an object nearest to a point, within ``reach`` px; the newest of equally near ones.

    Without one, and without a message in the cell there, the body of the object with the nearest ``grip``.
    """
    places = {(number, part): at for number, spec in enumerate(draft.objects) for part, at in points(spec).items()}
    closest = _closest(places, (x, y), reach)
    if closest or messages_at(draft.says, cell_of(x, y)):
        return closest
    near = [part for part, at in places.items() if part[1] == BODY_PART and dist(at, (x, y)) <= reach + HALF]
    return _closest({part: at for part in near if (at := grip(draft.objects[part[0]]))}, (x, y), reach)


def _closest(places: Mapping[ObjectPart, Point], point: Point, reach: float) -> ObjectPart | None:
    distance, number, part = min(((dist(at, point), -n, -p) for (n, p), at in places.items()), default=(inf, 0, 0))
    return (-number, -part) if distance <= reach else None


_PIECES = 64  # straight pieces of a curve

_SLOPES = {family.key: family.tiles for family in FAMILIES if family.key in "12367"}
_STEEP, _GENTLE = ("2", "6"), ("3", "7")
"""Families of the thin and the thick end of a slope of 67° and of 22°; "1": 45°."""
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
    _Stretch(1, 1, 45.0, 45.0, (_SLOPES["1"][3],)),
    _Stretch(2, 1, 26.6, 26.6, (_SLOPES["3"][3], _SLOPES["7"][3])),
    _Stretch(1, 2, 63.4, 63.4, (_SLOPES["2"][3], _SLOPES["6"][3])),
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
        keys = ("1",) if run == 1 else slopes
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
        return {cell: _SLOPES["1"][quarter]}
    return {cell: _SLOPES[thin][quarter], next_cell: _SLOPES[thick][quarter]}
