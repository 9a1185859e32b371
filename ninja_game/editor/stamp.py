"""Tiles and objects together: what is drawn, copied, pasted and mirrored, and what a selection of them undergoes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from ninja_game.editor.draft import Cell, Draft, Tiles, is_inside
from ninja_game.editor.motion import Motion
from ninja_game.editor.specs import carried, points
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, ObjectSpec

CellArea = tuple[int, int, int, int]
"""First column, first row, columns, rows."""

ObjectPart = tuple[int, int]
"""Number of an object in its draft, and which part of it."""


class Stamp(NamedTuple):
    """Tiles and objects at their places."""

    tiles: Tiles
    objects: tuple[ObjectSpec, ...] = ()

    def carried(self, motion: Motion) -> Stamp:
        """All of it after a motion."""
        tiles = {motion.cell(cell): motion.tile(tile) for cell, tile in self.tiles.items()}
        return Stamp(tiles, tuple(carried(spec, motion) for spec in self.objects))


@dataclass(frozen=True)
class Selection:
    """``area``: cells whose tiles are chosen. ``parts``: objects, or parts of them."""

    area: CellArea | None = None
    parts: frozenset[ObjectPart] = frozenset()

    def __bool__(self) -> bool:
        return self.area is not None or bool(self.parts)

    @property
    def numbers(self) -> set[int]:
        """Numbers of the objects of which anything is chosen."""
        return {number for number, _ in self.parts}


def area_between(a: Cell, b: Cell) -> CellArea:
    """The cells between two corners."""
    column, row = min(a[0], b[0]), min(a[1], b[1])
    return column, row, abs(a[0] - b[0]) + 1, abs(a[1] - b[1]) + 1


def cells_of(area: CellArea) -> list[Cell]:
    """All cells of an area, row by row."""
    column, row, columns, rows = area
    return [(i, j) for j in range(row, row + rows) for i in range(column, column + columns)]


WHOLE: CellArea = (1, 1, COLUMNS, ROWS)
"""All cells of a level."""


def put(draft: Draft, stamp: Stamp, symmetry: Iterable[Motion] = ()) -> Draft:
    """Draw a stamp, and its images in a symmetry. New objects come last; there is one ninja, and exits have no images.

    What is there already in the same form is not drawn twice.
    """
    objects = draft.objects
    tiles: Tiles = {}
    for number, motion in enumerate((Motion(), *symmetry)):
        image = stamp.carried(motion)
        # A cell that is its own image keeps what was drawn there.
        tiles |= {cell: tile for cell, tile in image.tiles.items() if number == 0 or cell not in stamp.tiles}
        for spec in image.objects:
            if number and spec.kind in (NINJA, EXIT):
                continue
            objects = _with_ninja(objects, spec) if spec.kind == NINJA else _with(objects, spec)
    return draft.with_tiles(tiles).with_objects(objects)


def _with(objects: tuple[ObjectSpec, ...], spec: ObjectSpec) -> tuple[ObjectSpec, ...]:
    return objects if spec in objects else (*objects, spec)


def _with_ninja(objects: tuple[ObjectSpec, ...], spec: ObjectSpec) -> tuple[ObjectSpec, ...]:
    """The ninja that plays, the last one, is put elsewhere; the first one of a level comes before everything."""
    last = max((number for number, other in enumerate(objects) if other.kind == NINJA), default=-1)
    return (*objects[: max(last, 0)], spec, *objects[last + 1 :])


def filled(draft: Draft, cell: Cell) -> list[Cell]:
    """The cells that are joined to a cell and have the same tile."""
    if not is_inside(cell):
        return []
    tile = draft.tile(cell)
    found = {cell}
    waiting = [cell]
    while waiting:
        column, row = waiting.pop()
        for there in ((column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)):
            if there not in found and is_inside(there) and draft.tile(there) == tile:
                found.add(there)
                waiting.append(there)
    return sorted(found)


def chosen_in(draft: Draft, area: CellArea) -> Selection:
    """An area with all parts of objects that lie in it, or on its edge, as a launch pad on the floor of its cell."""
    column, row, columns, rows = area
    inside = {
        (number, part)
        for number, spec in enumerate(draft.objects)
        for part, (x, y) in points(spec).items()
        if 24 * column <= x <= 24 * (column + columns) and 24 * row <= y <= 24 * (row + rows)
    }
    return Selection(area, frozenset(inside))


def everything(draft: Draft) -> Selection:
    """All tiles and objects, wherever they are."""
    parts = {(number, part) for number, spec in enumerate(draft.objects) for part in points(spec)}
    return Selection(WHOLE, frozenset(parts))


def copied(draft: Draft, selection: Selection) -> Stamp:
    """What is chosen; an object with one of its parts is copied whole."""
    tiles = {cell: draft.tile(cell) for cell in cells_of(selection.area) if is_inside(cell)} if selection.area else {}
    return Stamp(tiles, tuple(draft.objects[number] for number in sorted(selection.numbers)))


def removed(draft: Draft, selection: Selection) -> Draft:
    """The draft without what is chosen."""
    tiles = dict.fromkeys(cells_of(selection.area), 0) if selection.area else {}
    kept = tuple(spec for number, spec in enumerate(draft.objects) if number not in selection.numbers)
    return draft.with_tiles(tiles).with_objects(kept)


def reordered(draft: Draft, selection: Selection, by: int) -> tuple[Draft, Selection]:
    """The draft with the chosen objects together, so many places later in the order, and their selection."""
    chosen = sorted(selection.numbers)
    rest = [number for number in range(len(draft.objects)) if number not in selection.numbers]
    at = min(max(0, by + (chosen[0] if by < 0 else chosen[-1] + 1 - len(chosen))), len(rest))
    order = [*rest[:at], *chosen, *rest[at:]]
    parts = frozenset((order.index(number), part) for number, part in selection.parts)
    return draft.with_objects(tuple(draft.objects[number] for number in order)), Selection(selection.area, parts)


def moved(draft: Draft, selection: Selection, motion: Motion) -> tuple[Draft, Selection]:
    """The draft with what is chosen moved or turned, and the selection there. Tiles cover what they come to lie on."""
    objects = list(draft.objects)
    chosen: dict[int, set[int]] = {}
    for number, part in selection.parts:
        chosen.setdefault(number, set()).add(part)
    for number, parts in chosen.items():
        objects[number] = carried(objects[number], motion, parts)
    area = None
    tiles: Tiles = {}
    if selection.area is not None:
        tiles = dict.fromkeys(cells_of(selection.area), 0)
        tiles |= copied(draft, Selection(selection.area)).carried(motion).tiles
        column, row, columns, rows = selection.area
        area = area_between(motion.cell((column, row)), motion.cell((column + columns - 1, row + rows - 1)))
    return draft.with_tiles(tiles).with_objects(tuple(objects)), Selection(area, selection.parts)


def pasted(draft: Draft, stamp: Stamp) -> tuple[Draft, Selection]:
    """The draft with a stamp on it, and the selection of what came: objects are added, but a ninja moves."""
    after = put(draft, stamp)
    new = {number for number, spec in enumerate(after.objects) if spec in stamp.objects}
    parts = {(number, part) for number in new for part in points(after.objects[number])}
    cells = list(stamp.tiles)
    area = area_between(min(cells), max(cells)) if cells else None
    return after, Selection(area, frozenset(parts))


def middle_of(draft: Draft, selection: Selection, *, quarter: bool) -> tuple[float, float]:
    """The point about which a selection turns, px, so that cells come onto cells; ``quarter``: by a quarter turn.

    Where its middle is no such point, one beside it, to the right and to the left in turn: four turns are none.
    """
    if selection.area:
        column, row, columns, rows = selection.area
        x, y = 24.0 * column + 12.0 * columns, 24.0 * row + 12.0 * rows
    else:
        places = [points(draft.objects[number])[part] for number, part in selection.parts]
        xs, ys = zip(*places, strict=True)
        x, y = (12.0 * round((min(along) + max(along)) / 24.0) for along in (xs, ys))
    aside = (x + y) % 24.0 * quarter
    return x + (aside if x % 24.0 == 0.0 else -aside), y


def nearest(draft: Draft, x: float, y: float, reach: float) -> ObjectPart | None:
    """The part of an object nearest to a point and within ``reach`` px of it; of equals the newest."""
    found: ObjectPart | None = None
    best = reach * reach
    for number, spec in enumerate(draft.objects):
        for part, (px, py) in points(spec).items():
            distance = (px - x) ** 2 + (py - y) ** 2
            if distance <= best:
                found, best = (number, part), distance
    return found
