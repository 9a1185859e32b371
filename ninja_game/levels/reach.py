"""Where a ninja could ever get in a level: a flood fill over cells that is generous, so that its "no" is certain."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ninja_game.sim.collision import tiles
from ninja_game.sim.grid import cell_at, grid_remove
from ninja_game.sim.kinds import DOOR, NINJA
from ninja_game.sim.level import Level, ObjectSpec, well_formed
from ninja_game.sim.loader import grid_tiles
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.objects.door import create_door
from ninja_game.sim.rules import CELL, DOOR_SWITCH_RADIUS, RADIUS, SOLID, STRIDE
from ninja_game.sim.states import LOCKED, TRAP


def _made_door(world: World, record: ObjectSpec) -> Object:
    """The door that the game makes of a well-formed record."""
    door = Object()
    door.kind, (door.x, door.y) = DOOR, record.values[:2]
    create_door(world, door, record.values)
    grid_remove(world, door)
    return door


def edges_of(door: Object) -> tuple[int, int]:
    """The two edge indices that a door writes; 0 for one that does not exist (objects.md §8.6)."""
    return door.edge_1, door.edge_2


class Ground:
    """The tiles and edges of a level, its doors, and the cells that the ninja's centre could reach.

    Passable is every cell that is not full, across every side that no face closes; nothing is asked of jumps. A locked
    door opens once its switch can be touched; automatic and trap doors never stop the fill.
    """

    def __init__(self, level: Level) -> None:
        self.level = TileMap()
        self.level.tiles = grid_tiles(level)
        world = World()
        tiles.set_edges(self.level, world)
        self.edges: list[int] = list(world.edges)
        specs = [spec for spec in level.objects if spec.kind == DOOR and well_formed(spec)]
        self.doors = {spec: _made_door(world, spec) for spec in set(specs)}
        self.doors_on_side = Counter(edges_of(self.doors[spec]) for spec in specs)
        self.closed_edges = {edge for door in self.doors.values() if door.mechanism != TRAP for edge in edges_of(door)}
        ninjas = [record for record in level.objects if record.kind == NINJA]
        start = cell_at(*ninjas[-1].values) if ninjas and well_formed(ninjas[-1]) else 0
        # A ninja that starts in a tile may be pushed out on any side: nothing is certain then.
        self.certain = bool(start) and tiles.SHAPE[self.level.tiles[start]] == tiles.EMPTY
        self.cells: set[int] = set()
        if self.certain:
            self._fill(start)

    def touchable(self, x: float, y: float, radius: float) -> bool:
        """Whether a ninja in a reached cell could touch a disc (radius at most 14 px); True if nothing is certain."""
        near = (cell for cell in _around(cell_at(x, y)) if cell in self.cells)
        return not self.certain or any(_touches(cell, x, y, radius) for cell in near)

    def _fill(self, start: int) -> None:
        """Reach cell after cell. A locked door is looked at once for each cell around its switch, as it is reached."""
        locked = [door for door in self.doors.values() if door.mechanism == LOCKED]
        waiting: dict[int, list[Object]] = {}
        for door in locked:
            waiting.setdefault(cell_at(door.x, door.y), []).append(door)
        # Where doors share a side, one that is open or opens counts for all.
        closed = {edge for door in locked for edge in edges_of(door)}
        closed -= {edge for door in self.doors.values() if door.mechanism != LOCKED for edge in edges_of(door)}
        frontier = [start]
        while frontier:
            cell = frontier.pop()
            if cell not in self.cells:
                self.cells.add(cell)
                touched = (
                    door
                    for place in _around(cell)
                    for door in waiting.get(place, ())
                    if _touches(cell, door.x, door.y, DOOR_SWITCH_RADIUS)
                )
                opened = closed.intersection(edge for door in touched for edge in edges_of(door))
                closed -= opened
                frontier += [edge // 4 for edge in opened if edge // 4 in self.cells]
            frontier += [there for there in self._ways(cell, closed) if there not in self.cells]

    def _ways(self, cell: int, closed: set[int]) -> Iterator[int]:
        for side, step in enumerate(tiles.NEIGHBOUR_OFFSET):
            there, here = 4 * cell + side, 4 * (cell + step) + (side ^ 2)
            if tiles.EXISTS[cell + step] and tiles.SHAPE[self.level.tiles[cell + step]] != tiles.FULL:
                tiles_open = self.edges[there] != SOLID and self.edges[here] != SOLID
                if tiles_open and there not in closed and here not in closed:
                    yield cell + step


def _around(cell: int) -> list[int]:
    """A cell and its eight neighbours; none for the cell outside the grid."""
    return [cell + row + column for row in (-STRIDE, 0, STRIDE) for column in (-1, 0, 1)] if cell else []


def _touches(cell: int, x: float, y: float, radius: float) -> bool:
    """Whether a ninja with its centre in a cell could touch a disc (px)."""
    dx = max(abs(x - tiles.CENTRE_X[cell]) - CELL / 2, 0.0)
    dy = max(abs(y - tiles.CENTRE_Y[cell]) - CELL / 2, 0.0)
    return dx * dx + dy * dy < (radius + RADIUS) ** 2
