"""Solid surroundings of the ninja: the cells of a square, and rays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.part import Array, Lookup, Part, PartContext, clamp, copy_values
from ninja_game.sim.collision.ray_shapes import ray_tile
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, EXISTS, FULL, SHAPE
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import DOOR
from ninja_game.sim.rules import (
    CELL,
    DOWN,
    GRID_COLUMNS,
    GRID_ROWS,
    HALF,
    INTERESTING,
    LEFT,
    NEVER,
    OFF,
    RIGHT,
    SOLID,
    STRIDE,
    UP,
    WORLD_HEIGHT,
    WORLD_WIDTH,
)
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.world_fields import EDGE_STATES, TileMap, World

SAMPLES = 8  # points across a cell for measuring distances: the error is below 3 px, the distance of the points


def solidity(
    context: PartContext, number: int, across: int, down: int, spacing: tuple[float, float] | None = None
) -> NDArray[np.uint8]:
    """Which points of a level are solid, uint8 (down, across): spread evenly over it, or ``spacing`` px apart."""
    points = np.zeros((down, across), np.uint8)
    cell_width, cell_height = spacing or (WORLD_WIDTH / across, WORLD_HEIGHT / down)
    context.worlds.kernel(mark_solid)(context.worlds.maps, number, cell_width, cell_height, points)
    return points


@kernel
def mark_solid(maps: Sequence[TileMap], number: int, width: float, height: float, points: Array) -> None:
    """Mark the points that are solid, ``width`` and ``height`` px apart."""
    for row in range(len(points)):
        for column in range(len(points[row])):
            if solid_at(maps[number], (column + 0.5) * width, (row + 0.5) * height):
                points[row, column] = 1


_BY_TILES: dict[Any, NDArray[Any]] = {}
MAX_CACHED = 4096  # most results that are kept, by the tiles of their level: many levels have the same tiles


def cached_by_tiles(
    make: Callable[..., NDArray[Any]], context: PartContext, number: int, *lengths: float
) -> NDArray[Any]:
    """The result of ``make`` for a level's tiles, kept for other levels with the same tiles."""
    key = make, tuple(context.fresh[number].tiles), lengths
    if key not in _BY_TILES:
        if len(_BY_TILES) >= MAX_CACHED:
            _BY_TILES.clear()
        _BY_TILES[key] = make(context, number, *lengths)
    return _BY_TILES[key]


def surface_distances(context: PartContext, number: int, reach: float) -> NDArray[np.float64]:
    """Distance of the centre of every cell (25, 33) from the nearest surface, px, at most ``reach``; inside below 0.

    Outside the world all is solid. The search takes the nearest point of each row near a cell, then the nearest row's.
    """
    spacing = WORLD_WIDTH / GRID_COLUMNS / SAMPLES
    margin = int(reach / spacing)
    solid = np.pad(solidity(context, number, GRID_COLUMNS * SAMPLES, GRID_ROWS * SAMPLES), margin, constant_values=1)
    within = solidity(context, number, GRID_COLUMNS, GRID_ROWS) == 1
    squares = ((np.arange(2 * margin) - margin + 0.5) * spacing) ** 2
    shares = sliding_window_view(solid, 2 * margin, axis=1)[:, SAMPLES // 2 :: SAMPLES][:, :GRID_COLUMNS]
    surfaces = []
    for side in (1, 0):
        along = np.where(shares == side, squares, np.inf).min(axis=2)
        rows = sliding_window_view(along, 2 * margin, axis=0)[SAMPLES // 2 :: SAMPLES][:GRID_ROWS]
        surfaces.append(np.sqrt((rows + squares).min(axis=2)))
    outside, inside = np.minimum(surfaces, reach)
    distances: NDArray[np.float64] = np.where(within, -inside, outside)
    return distances


_FORMS = ("distance", "one-hot")
TILE_KINDS = len(SHAPE)
FULL_TILE = SHAPE.index(FULL)
MAX_SIZE = 31
_REACH = 48.0  # px; greater distances are cut off


@dataclass(frozen=True)
class LocalTiles(Part):
    """``size`` x ``size`` cells around that of the ninja, rows from top to bottom. Outside the level all is solid.

    ``form``: "distance", float32 (size, size): from the cell's centre to the nearest surface, px, below 0 inside
    something solid, at most 48; or "one-hot", uint8 (size, size, 36): the tile by its id (docs/rules/world.md §2.2; 34:
    malformed half, 35: undefined). Doors and objects do not count.
    """

    name: ClassVar[str] = "tiles"

    size: int = 9
    form: str = "distance"

    def __post_init__(self) -> None:
        if self.size not in range(1, MAX_SIZE + 1, 2):
            raise ArgumentError(f"the size of local tiles is {self.size!r}; expected an odd number up to {MAX_SIZE}")
        if self.form not in _FORMS:
            raise ArgumentError(f"the form of local tiles is {self.form!r}; expected one of {_FORMS}")

    @property
    def box(self) -> Box:
        """Float32 (size, size), or uint8 (size, size, 36)."""
        if self.form == "one-hot":
            return Box(0, 1, (self.size, self.size, TILE_KINDS), np.uint8)
        reach = 1.0 if self.normalised else _REACH
        return Box(-reach, reach, (self.size, self.size), np.float32)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """A padded picture of each level (distances or tile ids); width and height of a picture, and the size."""
        margin = self.size // 2
        height, width = GRID_ROWS + 2 * margin, GRID_COLUMNS + 2 * margin
        unit = _REACH if self.normalised else 1.0

        def picture(number: int) -> NDArray[Any]:
            if self.form == "one-hot":
                tiles = np.reshape(context.fresh[number].tiles, (-1, STRIDE))
                return np.pad(tiles[1 : GRID_ROWS + 1, 1 : GRID_COLUMNS + 1], margin, constant_values=FULL_TILE)
            return (
                np.pad(cached_by_tiles(surface_distances, context, number, _REACH), margin, constant_values=-_REACH)
                / unit
            )

        observe, kind = (observe_tiles, np.int64) if self.form == "one-hot" else (observe_distances, np.float32)
        return observe, context.values(picture, kind), width, height, self.size


@kernel
def observe_distances(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, pictures: Lookup, width: int, height: int, size: int,
) -> None:  # fmt: skip
    for k in range(first, last):
        index = indices[k]
        n = worlds[index].ninja
        start = level_of[index] * width * height + corner(n.x, n.y, width)
        for row in range(size):
            at = offset + row * size
            copy_values(out[index, at : at + size], pictures[start + row * width : start + row * width + size], size)


@kernel
def observe_tiles(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, pictures: Lookup, width: int, height: int, size: int,
) -> None:  # fmt: skip
    """Write the tile of each cell around the ninja."""
    for k in range(first, last):
        index = indices[k]
        n = worlds[index].ninja
        start = level_of[index] * width * height + corner(n.x, n.y, width)
        for j in range(offset, offset + size * size * TILE_KINDS):
            out[index, j] = 0
        at = offset
        for _ in range(size):
            for column in range(size):
                out[index, at + pictures[start + column]] = 1
                at += TILE_KINDS
            start += width


@fast
def corner(x: float, y: float, width: int) -> int:
    """Start of the square around a place's cell in a padded picture; places outside count as at the border."""
    column = int(clamp(x / CELL, 0.0, GRID_COLUMNS - 1.0))
    row = int(clamp(y / CELL, 0.0, GRID_ROWS - 1.0))
    return row * width + column


MAX_RAYS = 360


@dataclass(frozen=True)
class Rays(Part):
    """``count`` rays at equal angles, from the right by way of down: distance to the obstacle of each ray, px.

    They are rays of the world itself: tiles and solid edges, such as closed doors, stop them, objects do not.
    ``reach``: the greatest distance, px.
    """

    name: ClassVar[str] = "rays"

    count: int = 16
    reach: float = WORLD_WIDTH / 2

    def __post_init__(self) -> None:
        if self.count not in range(1, MAX_RAYS + 1) or not self.reach > 0.0:
            found = f"{self.count!r} rays of {self.reach!r} px"
            raise ArgumentError(f"found {found}; expected 1 to {MAX_RAYS} rays of more than 0 px")

    @property
    def box(self) -> Box:
        return Box(0.0, 1.0 if self.normalised else self.reach, (self.count,), np.float32)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """What ``observe_rays`` reads: directions, px from one grid line to the next along them, reach, factor, edges.

        Directions are rounded to 12 digits, so that all machines agree.
        """
        angles = [2.0 * pi * k / self.count for k in range(self.count)]
        units = [[round(f(angle), 12) for angle in angles] for f in (cos, sin)]
        paces = [[CELL / abs(unit) if unit else 0.0 for unit in axis] for axis in units]

        def edges(number: int) -> NDArray[np.uint8]:
            states = np.zeros(EDGE_STATES, np.uint8)
            context.worlds.kernel(mark_edges)(context.worlds.fresh, number, states)
            return states

        factor = 1.0 / self.reach if self.normalised else 1.0
        directions = [context.table(axis, np.float64) for axis in (*units, *paces)]
        return observe_rays, *directions, float(self.reach), factor, context.values(edges, np.uint8)


# States of edges besides those of the world.
OUTSIDE = 3  # an edge of a cell outside the level
DOORWAY = 4  # a place of a door: the world knows its state


@kernel
def mark_edges(fresh: Any, number: int, states: Any) -> None:
    """Write the states of a level's edges, which never change, except those of doors."""
    w = fresh[number]
    for edge in range(EDGE_STATES):
        states[edge] = w.edges[edge] if EXISTS[edge // 4] else OUTSIDE
    for slot in range(1, w.slots_used):
        o = w.objects[slot]
        if o.kind == DOOR:
            states[o.edge_1] = states[o.edge_2] = DOORWAY
    states[0] = OUTSIDE


@kernel
def observe_rays(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, dx: Lookup, dy: Lookup, pace_x: Lookup, pace_y: Lookup, reach: float, factor: float,
    edges: Lookup,
) -> None:  # fmt: skip
    """Follow the rays of some worlds like ``cast_ray``, bit for bit, with fewer look-ups per line of the grid."""
    for k in range(first, last):
        index = indices[k]
        ids = maps[level_of[index]].ids
        base = level_of[index] * EDGE_STATES
        w = worlds[index]
        x = w.ninja.x
        y = w.ninja.y
        start = cell_at(x, y)
        for j in range(len(dx)):
            way_x = 1 if dx[j] > 0.0 else -1
            way_y = 1 if dy[j] > 0.0 else -1
            next_x = ((CENTRE_X[start] + way_x * HALF) - x) / dx[j] if dx[j] != 0.0 else NEVER
            next_y = ((CENTRE_Y[start] + way_y * HALF) - y) / dy[j] if dy[j] != 0.0 else NEVER
            side_x = RIGHT if way_x > 0 else LEFT
            side_y = DOWN if way_y > 0 else UP
            length = reach
            # The ray starts as if it had just entered its first cell.
            cell = start
            edge = 0
            t = 0.0
            state = INTERESTING if ids[start] else OFF
            while True:
                if state != OFF:
                    if state == DOORWAY:
                        state = int(w.edges[edge])
                    hit_x = x + t * dx[j]
                    hit_y = y + t * dy[j]
                    stopped = state == SOLID
                    if state == INTERESTING:
                        tile = int(ids[cell])
                        stopped, hit_x, hit_y = ray_tile(
                            tile, CENTRE_X[cell], CENTRE_Y[cell], hit_x, hit_y, dx[j], dy[j]
                        )
                    if stopped:
                        # Within a tile the hit may lie behind the start: its distance then counts as 0.
                        length = (hit_x - x) * dx[j] + (hit_y - y) * dy[j]
                    if stopped or state == OUTSIDE:
                        break
                if next_x < next_y:
                    edge = 4 * cell + side_x
                    cell += way_x
                    t = next_x
                    next_x += pace_x[j]
                else:
                    edge = 4 * cell + side_y
                    cell += way_y * STRIDE
                    t = next_y
                    next_y += pace_y[j]
                state = int(edges[base + edge])
            out[index, offset + j] = clamp(length, 0.0, reach) * factor
