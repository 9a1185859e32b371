"""Where in a level the ninja could get: a flood fill over cells. It is generous, so "cannot be reached" is certain."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from math import cos, pi, sin, sqrt

from ninja_game.sim import kinds, rules
from ninja_game.sim.collision import tiles
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.grid import cell_at, grid_remove
from ninja_game.sim.level import Level, ObjectSpec, well_formed
from ninja_game.sim.loader import tile_map
from ninja_game.sim.objects.door import create_door
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import LOCKED, TRAP

_BETWEEN = sqrt(2.0)  # greatest distance, px, of the ninja from the nearest place that `is_in_wall` tests
_INNER_RADIUS = rules.RADIUS - _BETWEEN
_BESIDE = 0.01  # distance of the tested places from a border, on both sides, px
_ALONG = [k - 11.5 for k in range(24)]
_RIM = [(0.0, 0.0), *((_INNER_RADIUS * cos(pi * k / 8), _INNER_RADIUS * sin(pi * k / 8)) for k in range(16))]


def _door_of(world: World, spec: ObjectSpec) -> Object:
    """Make the door of a well-formed record as the game does."""
    door = Object()
    door.kind, (door.x, door.y) = kinds.DOOR, spec.values[:2]
    create_door(world, door, spec.values)
    grid_remove(world, door)
    return door


def edges_of(door: Object) -> tuple[int, int]:
    """The two edge indices that a door writes; 0 for one that does not exist (objects.md §8.6)."""
    return door.edge_1, door.edge_2


class Ground:
    """The tiles and edges of a level, its doors, and the cells that the ninja's centre could reach.

    Every cell that is not full can be passed, across every side that no face closes; jumps are not considered. A locked
    door opens once its switch can be touched; automatic and trap doors never stop the fill. ``start``: the cell of the
    ninja's start, 0 without one.
    """

    def __init__(self, level: Level) -> None:
        self.tiles = tile_map(level)
        world = World()
        tiles.set_edges(self.tiles, world)
        self.edges: list[int] = list(world.edges)
        self.objects = level.objects
        specs = [spec for spec in self.objects if spec.kind == kinds.DOOR and well_formed(spec)]
        self.doors = {spec: _door_of(world, spec) for spec in set(specs)}
        self.doors_on_side = Counter(edges_of(self.doors[spec]) for spec in specs)
        self.closed_edges = {edge for door in self.doors.values() if door.mechanism != TRAP for edge in edges_of(door)}
        ninjas = [spec for spec in level.objects if spec.kind == kinds.NINJA]
        self.start = cell_at(*ninjas[-1].values) if ninjas and well_formed(ninjas[-1]) else 0
        # A ninja that starts in a tile may be pushed out on any side, so nothing is certain.
        self.is_certain = bool(self.start) and tiles.SHAPE[self.tiles.ids[self.start]] == tiles.EMPTY
        self.cells: set[int] = set()
        if self.is_certain:
            self._fill(self.start)

    def is_full(self, cell: int) -> bool:
        return bool(tiles.SHAPE[self.tiles.ids[cell]] == tiles.FULL)

    def can_touch(self, x: float, y: float, radius: float) -> bool:
        """Whether a ninja in a reached cell could touch a disc; True if uncertain.

        ``radius``: up to 14 px, or of ``lint._TOUCHED``.
        """
        near = (cell for cell in _cells_around(cell_at(x, y)) if cell in self.cells)
        return not self.is_certain or any(_touches(cell, x, y, radius) for cell in near)

    def comes_near(self, x: float, y: float, reach: tuple[float, float]) -> bool:
        """Whether a ninja in a reached cell could be within ``reach`` px of a point, across and down."""
        (width, height), half = reach, rules.CELL / 2
        centres = ((tiles.CENTRE_X[cell], tiles.CENTRE_Y[cell]) for cell in self.cells)
        return not self.is_certain or any(abs(x - a) < width + half and abs(y - b) < height + half for a, b in centres)

    def is_in_wall(self, x: float, y: float, radius: float) -> bool:
        """Whether only a fast ninja, which sinks into tiles, could touch a disc. Tests every 2 px, generously."""
        if not (cell_at(x, y) and solid_at(self.tiles, x, y)):
            return False
        reach = radius + rules.RADIUS + _BETWEEN
        steps = [2.0 * step for step in range(-int(reach / 2), int(reach / 2) + 1)]
        places = ((x + a, y + b) for a in steps for b in steps if a * a + b * b < reach * reach)
        return not any(self._fits_at(*place) for place in places)

    def _fits_at(self, x: float, y: float) -> bool:
        """Whether the ninja's centre could be here with the ninja outside of all tiles."""
        reached = cell_at(x, y) in self.cells or not self.is_certain
        return reached and not any(solid_at(self.tiles, x + a, y + b) for a, b in _RIM)

    def _fill(self, start: int) -> None:
        """Reach cell after cell. A locked door is tested whenever the fill reaches a cell around its switch."""
        locked = [door for door in self.doors.values() if door.mechanism == LOCKED]
        waiting: dict[int, list[Object]] = {}
        for door in locked:
            waiting.setdefault(cell_at(door.x, door.y), []).append(door)
        # If doors share a side, one door that is open or opens is enough.
        closed = {edge for door in locked for edge in edges_of(door)}
        closed -= {edge for door in self.doors.values() if door.mechanism != LOCKED for edge in edges_of(door)}
        frontier = [start]
        self.cells.add(start)
        while frontier:
            cell = frontier.pop()
            touched = (
                door
                for place in _cells_around(cell)
                for door in waiting.get(place, ())
                if _touches(cell, door.x, door.y, rules.DOOR_SWITCH_RADIUS)
            )
            opened = closed.intersection(edge for door in touched for edge in edges_of(door))
            closed -= opened
            frontier += [edge // 4 for edge in opened if edge // 4 in self.cells]
            new = [*self._reachable_neighbours(cell, closed)]
            self.cells.update(new)
            frontier += new

    def _reachable_neighbours(self, cell: int, closed: set[int]) -> Iterator[int]:
        """The neighbours of a cell that can be reached from it and are new."""
        for side, step in enumerate(tiles.NEIGHBOUR_OFFSET):
            out_edge, in_edge = 4 * cell + side, 4 * (cell + step) + (side ^ 2)
            if tiles.EXISTS[cell + step] and cell + step not in self.cells and not self.is_full(cell + step):
                tiles_open = self.edges[out_edge] != rules.SOLID and self.edges[in_edge] != rules.SOLID
                if tiles_open and out_edge not in closed and in_edge not in closed and self._has_gap(cell, cell + step):
                    yield cell + step

    def _has_gap(self, cell: int, neighbour: int) -> bool:
        """Whether the solid faces on both sides of a border leave a gap: two full faces are no edge."""
        if tiles.EMPTY in (tiles.SHAPE[self.tiles.ids[cell]], tiles.SHAPE[self.tiles.ids[neighbour]]):
            return True
        x, y = ((at[cell] + at[neighbour]) / 2 for at in (tiles.CENTRE_X, tiles.CENTRE_Y))
        dx, dy = ((at[neighbour] - at[cell]) / rules.CELL for at in (tiles.CENTRE_X, tiles.CENTRE_Y))
        for k in _ALONG:
            sides = ((x + dy * k + dx * by, y + dx * k + dy * by) for by in (-_BESIDE, _BESIDE))
            if not any(solid_at(self.tiles, *place) for place in sides):
                return True
        return False


def _cells_around(cell: int) -> list[int]:
    return [cell + row + column for row in (-rules.STRIDE, 0, rules.STRIDE) for column in (-1, 0, 1)] if cell else []


def _touches(cell: int, x: float, y: float, radius: float) -> bool:
    dx = max(abs(x - tiles.CENTRE_X[cell]) - rules.CELL / 2, 0.0)
    dy = max(abs(y - tiles.CENTRE_Y[cell]) - rules.CELL / 2, 0.0)
    return dx * dx + dy * dy < (radius + rules.RADIUS) ** 2
