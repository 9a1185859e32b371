"""A level in the making: its tiles, its open cells, the places to stand, and the objects so far."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from itertools import pairwise
from math import dist, hypot
from random import Random
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ninja_game.formats.ascii.legend import TILE_OF_CHAR
from ninja_game.formats.ascii.object_lines import ListedObject, read_object_line
from ninja_game.formats.ascii.places import READING_ORDER
from ninja_game.generator.shaping import SAMPLES, Ink
from ninja_game.sim import kinds
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside, middle_of
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec
from ninja_game.sim.rules import CELL

MIDDLE_COLUMN = (COLUMNS + 1) // 2


def mirrored(cell: Cell) -> Cell:
    return COLUMNS + 1 - cell[0], cell[1]


Y, X = (1 + (np.indices((ROWS * SAMPLES, COLUMNS * SAMPLES)) + 0.5) / SAMPLES).astype(float)
"""Row and column of the samples, in cells."""


def disc(x: float, y: float, half_width: float, half_height: float) -> Ink:
    """An ellipse around a point; ``half_width``, ``half_height``: half its width and height."""
    shape: Ink = ((X - x) / half_width) ** 2 + ((Y - y) / half_height) ** 2 <= 1
    return shape


def box(left: float, top: float, right: float, bottom: float) -> Ink:
    shape: Ink = (left <= X) & (right >= X) & (top <= Y) & (bottom >= Y)
    return shape


def polygon(*corners: Point) -> Ink:
    odd = np.zeros(X.shape, bool)
    for (x0, y0), (x1, y1) in pairwise([*corners, corners[0]]):
        if y0 != y1:
            odd ^= ((y0 <= Y) != (y1 <= Y)) & ((x1 - x0) * (Y - y0) / (y1 - y0) + x0 >= X)
    return odd


def path(width: float, *points: Point) -> Ink:
    """A line with round ends."""
    drawn = np.zeros(X.shape, bool)
    for (x0, y0), (x1, y1) in pairwise(points):
        dx, dy = x1 - x0, y1 - y0
        t = (((X - x0) * dx + (Y - y0) * dy) / (dx * dx + dy * dy)).clip(0, 1)
        drawn |= (X - x0 - t * dx) ** 2 + (Y - y0 - t * dy) ** 2 <= width * width / 4
    return drawn


def dish(x: float, y: float, half_width: float, depth: float) -> Ink:
    """An island with a flat top; ``half_width``: half its width, ``depth``: its depth."""
    return disc(x, round(y), half_width, depth) & box(1, round(y), 32, 24)


STONES: tuple[Callable[[float, float, float], Ink], ...] = (
    lambda x, y, size: dish(x, y, size, 1.3),
    lambda x, y, size: box(round(x - size), y, round(x + size), y + 1),
    lambda x, y, size: polygon((x - size, y), (x, y - 1.5), (x + size, y), (x, y + 1.5)),
    lambda x, y, _: box(round(x), y - 1, round(x) + 1, y + 2),
    lambda x, y, size: polygon((x - size, y + 1), (x + size, y + 1), (x + size, y - size / 2)),
    lambda x, y, size: polygon((x + size, y + 1), (x - size, y + 1), (x - size, y - size / 2)),
)
"""Small stones around a point, by half their width: islands, slabs, diamonds, pillars, ramps."""


class RockBoard:
    """Painted rock, all solid at first. While it is ``even``, everything is also painted at the mirrored place.

    ``vault_floor``: the vault's floor. ``gate``: the only way into it, cells for two locks of ``doors`` doors each.
    ``danger_places``: places for a group of gold around a danger, in cells.
    """

    def __init__(self, doors: int = 1) -> None:
        self.doors = doors
        self.ink = np.ones(X.shape, bool)
        self.even = True
        self.vault_floor: list[Cell] = []
        self.gate: list[Cell] = []
        self.danger_places: list[Point] = []
        self.side = "right"  #: side of the gate's cells with the door

    def rock(self, *shapes: Ink) -> None:
        """Paint shapes solid."""
        for shape in shapes:
            self.ink |= shape | shape[:, ::-1] if self.even else shape

    def dig(self, *shapes: Ink) -> None:
        """Dig shapes out."""
        for shape in shapes:
            self.ink &= ~(shape | shape[:, ::-1] if self.even else shape)

    def dig_vault(self, first: int, last: int, row: int, gate: int) -> None:
        """Dig a flat floor from column to column, and a way out to the right from the column ``gate`` on."""
        top = row + 1 - self.doors
        self.ink |= box(first, row + 1, last + 1, row + 2)
        self.ink |= box(gate, top - 1, gate + 2, row + 2)
        self.ink &= ~(box(first, row - 1, gate, row + 1) | box(first, top, gate + 4, row + 1))
        self.vault_floor = [(column, row) for column in range(first, last + 1)]
        self.gate = [(gate + lock, row - k) for lock in (0, 1) for k in range(self.doors)]

    def is_rock(self, cell: Cell) -> bool:
        """Whether the middle of a cell is rock, or the cell belongs to the border."""
        return not is_inside(cell) or bool(self.ink[cell[1] * SAMPLES - SAMPLES // 2, cell[0] * SAMPLES - SAMPLES // 2])

    def open_roof(self, rng: Random) -> None:
        """Close the way into the vault and open its roof instead, if there is open space not far above."""
        column, row = rng.choice(self.vault_floor[1:-1])
        near = next((k for k in range(1, 6) if self.is_rock((column, row - k))), 6)
        far = next((k for k in range(near, near + 6) if not self.is_rock((column, row - k))), 0)
        if not near + 2 <= far:
            return
        left, right = sorted((self.gate[0][0], self.gate[-1][0]))
        self.ink |= box(left, row - self.doors, right + 1, row + 1)
        low, high = row - near, row - far + 1
        self.ink &= ~box(column - 1, high - 1, column + 2, low + 1)
        self.even, self.side, self.doors = False, "top", 3
        self.gate = [(column + k, high + lock) for lock in (0, 1) for k in (-1, 0, 1)]

    def fill(self, rng: Random) -> None:
        """Put stones of one or two kinds into spaces that are too wide and open, some of them on one side only."""
        for row in self.ink:  # Rock close to the border is extended to it.
            row[:SAMPLES], row[-SAMPLES:] = row[SAMPLES], row[-SAMPLES - 1]
        self.ink[:SAMPLES] = self.ink[SAMPLES]
        makers, even = rng.sample(STONES, 2), self.even
        for number in range(11):
            air = np.pad(~self.ink.reshape(ROWS, SAMPLES, COLUMNS, SAMPLES).any((1, 3)), 1)
            width, height = ((9, 6), (7, 5), (6, 4))[number // 4]
            free = np.argwhere(sliding_window_view(air, (height, width)).all((2, 3)))
            if not len(free):
                continue
            top, left = rng.choice(free.tolist())
            x, y = left + width / 2 + rng.choice((-0.5, 0.5)), top + height // 2 + rng.choice((0, 1))
            self.even = even and rng.random() < 0.6
            self.rock(rng.choice(makers)(x, y, rng.uniform(1.0, 1.0 + width / 9)))
        self.even &= even

    def flip(self) -> None:
        """Swap left and right."""
        self.ink = self.ink[:, ::-1]
        self.side = "left" if self.side == "right" else "right"
        self.vault_floor, self.gate = [list(map(mirrored, cells)) for cells in (self.vault_floor, self.gate)]
        self.danger_places = [(COLUMNS + 2 - x, y) for x, y in self.danger_places]


def flood(first: Cell, within: set[Cell]) -> set[Cell]:
    """The cells of a set that are connected with ``first`` by their sides."""
    return set(steps_from(first, within))


def steps_from(first: Cell, within: set[Cell]) -> dict[Cell, int]:
    """The number of steps, from cell to cell of a set, from ``first`` to every cell in reach."""
    steps, frontier = {first: 0}, [first]
    for cell in frontier:
        for neighbour in neighbours(cell):
            if neighbour in within and neighbour not in steps:
                steps[neighbour] = steps[cell] + 1
                frontier.append(neighbour)
    return steps


def neighbours(cell: Cell) -> tuple[Cell, ...]:
    column, row = cell
    return (column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)


class FloorRun(NamedTuple):
    """Cells in a row that the ninja can stand in: ``length`` of them from ``column`` on."""

    column: int
    row: int
    length: int

    @property
    def middle(self) -> Point:
        """The middle of its cells, px."""
        return CELL * (self.column + self.length / 2), CELL * (self.row + 0.5)


class Face(NamedTuple):
    """A side of a cell, or a slope in it, px: its middle, and the direction away from the rock."""

    x: float
    y: float
    away_x: float
    away_y: float

    def out_by(self, distance: float) -> Point:
        """The point ``distance`` px away from the rock."""
        return self.x + distance * self.away_x, self.y + distance * self.away_y

    def joins(self, other: Face) -> bool:
        """Whether two faces are neighbours on one piece of rock."""
        return (
            dist(self[:2], other[:2]) < 1.45 * CELL and self.away_x * other.away_x + self.away_y * other.away_y > -0.5
        )


_LEANS = {
    tile: way
    for tiles, way in (("ajJdDgG", (1, -1)), ("skKfFhH", (-1, -1)), ("wiIrRyY", (-1, 1)), ("quUeEtT", (1, 1)))
    for tile in tiles
}
"""The side on which a tile with a shape is open."""


def object_of(line: str) -> ObjectSpec:
    """Make the object of a line of the list of an ASCII level."""
    (listed,) = read_object_line(line)
    assert isinstance(listed, ListedObject)  # noqa: S101 - lines of this package place objects
    return listed.spec


class Scene:
    """A level in the making.

    ``needed``: objects that every route needs (ninja, exit, doors). ``fixtures``: harmless objects. ``hazards``: groups
    of objects that belong together: an enemy, or a line of mines.
    """

    def __init__(self, board: RockBoard, tiles: dict[Cell, str], start: Cell) -> None:
        self.board = board
        self.tiles = tiles
        self.start = start
        self.empty = {(c, r) for c in range(1, COLUMNS + 1) for r in range(1, ROWS + 1)} - tiles.keys()
        self.reachable = steps_from(start, self.empty)
        self.needed: list[ObjectSpec] = []
        self.fixtures: list[ObjectSpec] = []
        self.gold: list[ObjectSpec] = []
        self.gold_middles: list[Point] = []  #: the middles of groups of gold
        self.rings: list[Point] = []  #: those of rings of gold with room for a danger inside
        self.hazards: list[list[ObjectSpec]] = []

    @property
    def objects(self) -> list[ObjectSpec]:
        return [*self.needed, *self.fixtures, *self.gold, *(spec for group in self.hazards for spec in group)]

    @property
    def level(self) -> Level:
        cells = ((c, r) for c in range(1, COLUMNS + 1) for r in range(1, ROWS + 1))
        return Level(tuple(TILE_OF_CHAR[self.tiles.get(cell, ".")] for cell in cells), tuple(self.objects))

    def count(self, *which: int) -> int:
        """Count the objects of these kinds."""
        return sum(spec.kind in which for spec in self.objects)

    def stones(self) -> list[set[Cell]]:
        """The connected groups of cells with a tile that do not touch the border."""
        left, groups = set(self.tiles), []
        while left:
            groups.append(flood(min(left), left))
            left -= groups[-1]
        return [stone for stone in groups if all(1 < c < COLUMNS and 1 < r < ROWS for c, r in stone)]

    def full(self, cell: Cell) -> bool:
        """Whether a cell is a full tile or belongs to the border."""
        return self.tiles.get(cell) == "#" or not is_inside(cell)

    def can_stand(self, cell: Cell) -> bool:
        """Whether the ninja can reach a cell and stand in it."""
        column, row = cell
        return cell in self.reachable and (column, row - 1) in self.empty and self.full((column, row + 1))

    def runs(self) -> list[FloorRun]:
        """The floors in reach, in reading order."""
        floors: list[FloorRun] = []
        for column, row in filter(self.can_stand, READING_ORDER):
            if floors and floors[-1].row == row and floors[-1].column + floors[-1].length == column:
                floors[-1] = floors[-1]._replace(length=floors[-1].length + 1)
            else:
                floors.append(FloorRun(column, row, 1))
        return floors

    @cached_property
    def surfaces(self) -> list[list[Face]]:
        """The rock's surface in reach: chains of neighbouring faces."""
        faces = list[Face]()
        for cell in sorted(self.reachable):
            x, y = middle_of(cell)
            for neighbour in filter(self.full, neighbours(cell)):
                dx, dy = neighbour[0] - cell[0], neighbour[1] - cell[1]
                faces.append(Face(x + CELL / 2 * dx, y + CELL / 2 * dy, -dx, -dy))
        for cell, tile in sorted(self.tiles.items()):
            if tile in _LEANS and any(neighbour in self.reachable for neighbour in neighbours(cell)):
                dx, dy = _LEANS[tile]
                faces.append(Face(*middle_of(cell), dx * 0.7, dy * 0.7))
        chains, left = list[list[Face]](), dict.fromkeys(faces)
        for first in faces:
            if first in left:
                chain = [first]
                del left[first]
                for end in (-1, 0):  # extend the chain at both ends
                    while near := [face for face in left if face.joins(chain[end])]:
                        following = min(near, key=lambda face: dist(face[:2], chain[end][:2]))
                        del left[following]
                        chain.insert(len(chain) if end else 0, following)
                chains.append(chain)
        return chains

    def wanted(self) -> list[Point]:
        """The places that a player wants or has to touch, px: groups of gold (middle), exit, doors, switches."""
        return [*self.gold_middles, *(point for spec in self.needed[1:] for point in object_places(spec))]

    def mirrored_points(self, points: list[Point]) -> list[Point]:
        """Mirror the points at the middle column."""
        return [(2 * middle_of((MIDDLE_COLUMN, 0))[0] - x, y) for x, y in points]

    def is_clear(self, point: Point, *, needed: float, other: float) -> bool:
        """Whether a point is in a cell in reach, ``needed`` px from needed objects and ``other`` px from others."""
        is_reachable = cell_of(*point) in self.reachable
        return is_reachable and all(
            dist(point, place) >= (needed if spec.kind in _NEEDED else max(other, _CLEARANCE.get(spec.kind, 0.0)))
            for spec in self.objects
            for place in object_places(spec)
        )

    def sees(self, a: Point, b: Point) -> bool:
        """Whether no tile is between two points, as far as cells can tell."""
        count = int(hypot(b[0] - a[0], b[1] - a[1]) // 8) + 1
        line = ((a[0] + (b[0] - a[0]) * k / count, a[1] + (b[1] - a[1]) * k / count) for k in range(count + 1))
        return all(cell_of(*point) not in self.tiles for point in line)


_NEEDED = (kinds.NINJA, kinds.EXIT, kinds.DOOR)
_CLEARANCE = {kinds.LAUNCH_PAD: 20.0, kinds.ONE_WAY: 16.0, kinds.BOUNCE_BLOCK: 22.0}
"""px around fixtures that stay free."""


def object_places(spec: ObjectSpec) -> Iterator[Point]:
    """The place of an object, and that of its switch."""
    x, y, *more = spec.values
    yield x, y
    if spec.kind == kinds.EXIT:
        yield more[0], more[1]
