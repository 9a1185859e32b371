"""Stamps: tiles and objects to draw, copy, paste or mirror; operations on selections."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import ceil, dist, inf
from typing import NamedTuple

from ninja_game.editor.draft import Draft, Tiles
from ninja_game.editor.motion import Motion
from ninja_game.editor.palette import EMPTY
from ninja_game.editor.specs import BODY_PART, carried, grip, points
from ninja_game.formats.messages import Moment, messages_at, parse_messages, with_message_moved
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
    """The draft with the selection moved or turned, and the selection there. Moved tiles replace those under them.

    A message near a place moves with the cells around it, one about a switch or a piece of gold with that.
    """
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
    after = draft.with_tiles(tiles).with_objects(tuple(objects))
    return replace(after, says=_messages_moved(draft, selection, motion)), Selection(area, selection.parts)


def _messages_moved(draft: Draft, selection: Selection, motion: Motion) -> str:
    """The messages of a draft after a move of the selection; those that would leave the level stay."""
    if not (says := draft.says):
        return ""
    cells = set(area_cells(selection.area)) if selection.area else set()
    things = {cell_of(*points(draft.objects[number])[part]) for number, part in selection.parts}
    for number, message in enumerate(parse_messages(says)):
        moves = message.cell in (cells if message.when == Moment.AT else things)
        if moves and is_inside(motion.cell(message.cell)):
            says = with_message_moved(says, number, motion.cell(message.cell))
    return says


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
