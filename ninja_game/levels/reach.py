"""Where a ninja could ever get in a level: a flood fill over cells that is generous, so that its "no" is certain."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from math import isnan
from typing import NamedTuple

from ninja_game.sim.collision.tiles import (
    CENTRE_X,
    CENTRE_Y,
    EMPTY,
    EXISTS,
    FULL,
    SHAPE,
    STEP,
    set_edges,
)
from ninja_game.sim.grid import cell_at, cell_index
from ninja_game.sim.level import DOOR, NINJA, VALUE_COUNTS, Level, ObjectSpec
from ninja_game.sim.loader import grid_tiles
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.rules import CELL, DOOR_SWITCH_RADIUS, RADIUS, SOLID, STRIDE


class Door(NamedTuple):
    """A door of a level: its switch (px), whether it needs that switch, and the two edge indices that it writes.

    An index is 0 where the cell does not exist (objects.md §8.6); ``closed``: at the start of the level.
    """

    x: float
    y: float
    locked: bool
    closed: bool
    edges: tuple[int, int]


def is_flag(value: float) -> bool:
    """Whether a flag counts as set: any number but 0 and NaN (objects.md §2.1)."""
    return value != 0 and not isnan(value)


def well_formed(record: ObjectSpec) -> bool:
    """Whether a record is of a known kind and has the number of values that it needs."""
    return 0 <= record.kind < len(VALUE_COUNTS) and len(record.values) == VALUE_COUNTS[record.kind]


def door_of(record: ObjectSpec) -> Door:
    """What a well-formed door record makes (objects.md §8.6)."""
    x, y, vertical, trap, column, row, locked, i, j = record.values
    first = cell_index(column + i, row + j)
    second = first + STEP[1 if vertical == 1 else 0] if first else 0
    # Odd flags: the doubtful door writes P1's lower and P2's upper edge all the same.
    side = 0 if vertical == 0 else 1
    edges = (4 * first + side if first else 0, 4 * second + side + 2 if second and EXISTS[second] else 0)
    return Door(x, y, is_flag(locked), is_flag(locked) or not is_flag(trap), edges)


class Ground:
    """The tiles and edges of a level, and the cells that the ninja's centre could reach.

    Passable is every cell that is not full, across every side that no face closes; nothing is asked of jumps. A locked
    door opens once its switch can be touched; automatic and trap doors never stop the fill.
    """

    def __init__(self, level: Level) -> None:
        self.level = TileMap()
        self.level.tiles = grid_tiles(level)
        world = World()
        set_edges(self.level, world)
        self.edges: list[int] = world.edges
        self.doors = [door_of(record) for record in level.objects if record.kind == DOOR and well_formed(record)]
        self.doors_on_side = Counter(frozenset(door.edges) for door in self.doors)
        self.closed_edges = {edge for door in self.doors if door.closed for edge in door.edges}
        ninjas = [record for record in level.objects if record.kind == NINJA]
        start = cell_at(*ninjas[-1].values) if ninjas and well_formed(ninjas[-1]) else 0
        # A ninja that starts in a tile may be pushed out on any side: nothing is certain then.
        self.certain = bool(start) and SHAPE[self.level.tiles[start]] == EMPTY
        self.cells: set[int] = set()
        if self.certain:
            self._fill(start)

    def touchable(self, x: float, y: float, radius: float) -> bool:
        """Whether a ninja in a reached cell could touch a disc (radius at most 14 px); True if nothing is certain."""
        if not self.certain:
            return True
        here = cell_at(x, y)
        near = [here + row + column for row in (-STRIDE, 0, STRIDE) for column in (-1, 0, 1)] if here else []
        return any(cell in self.cells and _distance_squared(cell, x, y) < (radius + RADIUS) ** 2 for cell in near)

    def _fill(self, start: int) -> None:
        waiting = [door for door in self.doors if door.locked]
        # A side with another door than locked ones may be open for other reasons.
        free = {edge for door in self.doors if not door.locked for edge in door.edges}
        while True:
            closed = {edge for door in waiting for edge in door.edges if edge and edge not in free}
            self.cells = self._flood(start, closed)
            touched = {door for door in waiting if self.touchable(door.x, door.y, DOOR_SWITCH_RADIUS)}
            if not touched:
                return
            # Where locked doors share a side, one that opens counts for all.
            free |= {edge for door in touched for edge in door.edges}
            waiting = [door for door in waiting if door not in touched]

    def _flood(self, start: int, closed: set[int]) -> set[int]:
        reached, frontier = {start}, [start]
        while frontier:
            cell = frontier.pop()
            for neighbour in self._ways(cell, closed):
                if neighbour not in reached:
                    reached.add(neighbour)
                    frontier.append(neighbour)
        return reached

    def _ways(self, cell: int, closed: set[int]) -> Iterator[int]:
        for side, step in enumerate(STEP):
            there, here = 4 * cell + side, 4 * (cell + step) + (side ^ 2)
            if EXISTS[cell + step] and SHAPE[self.level.tiles[cell + step]] != FULL:
                tiles_open = self.edges[there] != SOLID and self.edges[here] != SOLID
                if tiles_open and there not in closed and here not in closed:
                    yield cell + step


def _distance_squared(cell: int, x: float, y: float) -> float:
    """Square of the distance of a point from a cell's square, px²."""
    dx = max(abs(x - CENTRE_X[cell]) - CELL / 2, 0.0)
    dy = max(abs(y - CENTRE_Y[cell]) - CELL / 2, 0.0)
    return dx * dx + dy * dy
