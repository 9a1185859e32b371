"""Observations of objects: those nearest to the ninja, or all objects of a level in planes of its cells."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np
from gymnasium.spaces import Box

from ninja_game.backend.worlds import InitialObject
from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.part import Array, Lookup, Part, PartContext, clamp, put_value
from ninja_game.learn.observations.surroundings import SAMPLES, solidity
from ninja_game.learn.observations.vectors import MAX_SPEED
from ninja_game.sim import kinds
from ninja_game.sim.collision.tiles import COLUMN as GRID_COLUMN, ROW as GRID_ROW, UNIT_X, UNIT_Y
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import EXIT, INERT, KINDS, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, TILES
from ninja_game.sim.rules import CHASE_PACE, GRID_COLUMNS, GRID_ROWS, GUARD_SPEED, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import DRONE_MOVE, GUARD_CHASE, LAUNCHER_FLIGHT, LAUNCHER_IDLE, THWUMP_MOVE, TRAP
from ninja_game.sim.traces import contact_place_of

MAX_ROUTINE = 3.0  # the highest number of a drone's or a turret's routine


@fast
def is_there(w: World, o: Object) -> bool:
    """Whether an object still exists."""
    if o.kind == kinds.GOLD:
        return o.taken == 0
    if o.kind == kinds.MINE:
        return o.exploded == 0
    if o.kind == kinds.SWITCH:
        return w.objects[o.partner].is_open == 0
    return True


@fast
def velocity_of(o: Object) -> tuple[float, float]:
    """The velocity of an object, px/tick; zero for kinds that do not move by themselves."""
    if o.kind == kinds.BOUNCE_BLOCK:
        return o.x - o.prev_x, o.y - o.prev_y
    if o.kind == kinds.THWUMP and o.routine == THWUMP_MOVE:
        return o.sign * o.face_x * o.speed, o.sign * o.face_y * o.speed
    if o.kind == kinds.FLOOR_GUARD and o.routine == GUARD_CHASE and o.updating:
        return o.facing * GUARD_SPEED, 0.0
    if o.kind == kinds.LAUNCHER and o.routine == LAUNCHER_FLIGHT:
        return o.speed * o.heading_x, o.speed * o.heading_y
    if o.kind == kinds.DRONE and o.routine == DRONE_MOVE and o.updating and 0 <= o.direction <= 3:
        speed = o.speed * CHASE_PACE if o.chasing else o.speed
        return UNIT_X[o.direction] * speed, UNIT_Y[o.direction] * speed
    return 0.0, 0.0


@fast
def face_of(o: Object) -> tuple[float, float]:
    """The direction of an object: a normal, the way a drone goes or a thwump falls, a turret's way to its crosshair.

    They are unit vectors, approximately; only the last is a share of the world's width.
    """
    if o.kind == kinds.LAUNCH_PAD or o.kind == kinds.ONE_WAY or o.kind == kinds.THWUMP:
        return o.face_x, o.face_y
    if o.kind == kinds.DRONE and 0 <= o.direction <= 3:
        return UNIT_X[o.direction], UNIT_Y[o.direction]
    if o.kind == kinds.TURRET:
        return (o.aim_x - o.x) / WORLD_WIDTH, (o.aim_y - o.y) / WORLD_WIDTH
    return 0.0, 0.0


@fast
def activity_of(o: Object) -> float:
    """The activity of an object, as one number.

    Exit: 1 open. Door: 1 closed. Thwump: 1 falls, -1 rises. Guard: 1 runs. Bounce block: 1 moves. Rocket: 1 flies,
    1/2 before. Drone: 1/3 before it fires, 2/3 firing, 1 after. Turret: 1/3 aims, 2/3 before it fires, 1 after. Else 0.
    """
    kind = o.kind
    if kind == kinds.EXIT:
        return float(o.is_open)
    if kind == kinds.DOOR:
        return float(o.switched) if o.mechanism == TRAP else 1.0 - o.switched
    if kind == kinds.THWUMP:
        return o.sign if o.routine == THWUMP_MOVE else 0.0
    if kind == kinds.FLOOR_GUARD:
        return 1.0 if o.routine == GUARD_CHASE and o.updating else 0.0
    if kind == kinds.BOUNCE_BLOCK:
        return float(o.updating)
    if kind == kinds.LAUNCHER:
        return 1.0 if o.routine == LAUNCHER_FLIGHT else 0.0 if o.routine == LAUNCHER_IDLE else 0.5
    if kind == kinds.DRONE or kind == kinds.TURRET:
        return float(o.routine) / MAX_ROUTINE if o.updating else 0.0
    return 0.0


OBSERVED = tuple(kind for kind in KINDS if kind.number not in {NINJA, INERT})
OBSERVED_KINDS = tuple(kind.name for kind in OBSERVED)
OBJECT_COLUMNS = (*OBSERVED_KINDS, "dx", "dy", "vx", "vy", "face_x", "face_y", "moment")
"""Columns of an object: its kind, one flag each; its offset from the ninja, px; its velocity, px/tick."""
DX = len(OBSERVED_KINDS)
_MAX_OBJECTS = 64


class ObservedObject(NamedTuple):
    """An object, by its slot, and the column or plane of its kind."""

    slot: int
    number: int


def _observed(objects: Iterable[InitialObject], numbers: Mapping[int, int]) -> list[ObservedObject]:
    return [ObservedObject(o.slot, numbers[o.kind]) for o in objects]


@dataclass(frozen=True)
class NearObjects(Part):
    """The ``count`` objects nearest to the ninja, nearest first, float32 (count, 20): ``OBJECT_COLUMNS``, else 0.

    Objects that are gone are left out: gold taken, mines exploded, the switch of an open exit. ``kinds``: names of the
    kinds to include (of ``OBSERVED_KINDS``), by default all.
    """

    name: ClassVar[str] = "objects"

    count: int = 8
    kinds: tuple[str, ...] = OBSERVED_KINDS

    def __post_init__(self) -> None:
        if self.count not in range(1, _MAX_OBJECTS + 1):
            raise ArgumentError(f"the count of near objects is {self.count!r}; expected 1 to {_MAX_OBJECTS}")
        if not self.kinds or not set(self.kinds) <= set(OBSERVED_KINDS):
            raise ArgumentError(f"the kinds of near objects are {self.kinds!r:.60}; expected some of {OBSERVED_KINDS}")

    @property
    def box(self) -> Box:
        low, high, _ = self._range()
        return Box(np.tile(low, (self.count, 1)), np.tile(high, (self.count, 1)), dtype=np.float32)

    def _range(self) -> Any:
        """Lowest and highest value and divisor of each column."""
        distances, speeds = [WORLD_WIDTH, WORLD_HEIGHT], [MAX_SPEED] * 2
        highest = np.array([1.0] * DX + distances + speeds + [1.0] * 3)
        lowest = np.where(np.arange(len(OBJECT_COLUMNS)) < DX, 0.0, -highest)
        divisors = np.array([1.0] * DX + [WORLD_WIDTH] * 2 + speeds + [1.0] * 3)
        divisors = divisors if self.normalised else np.ones(len(OBJECT_COLUMNS))
        return (lowest / divisors).astype(np.float32), (highest / divisors).astype(np.float32), divisors

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """The count; factors and limits; the objects of all levels, their columns; memory for the nearest."""
        low, high, divisors = self._range()
        columns = {kind.number: place for place, kind in enumerate(OBSERVED) if kind.name in self.kinds}
        memory = [[0] * (context.count * self.count)] * 2
        return (
            observe_objects,
            self.count,
            context.ranges(low, high, divisors),
            *context.rows(lambda number: _observed(context.objects(number, *columns), columns), ObservedObject),
            *(context.table(values, np.float64) for values in memory),
        )


@kernel
def observe_objects(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, count: int, ranges: Lookup, bounds: Lookup, objects: Lookup, nearest: Lookup,
    distances: Lookup,
) -> None:  # fmt: skip
    """Sort the nearest objects of some worlds by insertion, and write them."""
    for k in range(first, last):
        index = indices[k]
        level = level_of[index]
        w = worlds[index]
        n = w.ninja
        base = index * count
        count_here = 0
        for object_ in range(bounds[2 * level], bounds[2 * level + 1]):
            o = w.objects[objects[object_].slot]
            if not is_there(w, o):
                continue
            x, y = contact_place_of(o)
            distance = (x - n.x) * (x - n.x) + (y - n.y) * (y - n.y)
            if count_here < count or distance < distances[base + count - 1]:
                count_here = min(count_here + 1, count)
                place = base + count_here - 1
                while place > base and distance < distances[place - 1]:
                    distances[place] = distances[place - 1]
                    nearest[place] = nearest[place - 1]
                    place -= 1
                distances[place] = distance
                nearest[place] = object_
        width = len(ranges)
        for j in range(offset, offset + count * width):
            out[index, j] = 0.0
        for rank in range(count_here):
            object_ = int(nearest[base + rank])
            o = w.objects[objects[object_].slot]
            at = offset + rank * width
            x, y = contact_place_of(o)
            vx, vy = velocity_of(o)
            face_x, face_y = face_of(o)
            out[index, at + objects[object_].number] = 1.0
            put_value(out, index, at, DX, ranges, x - n.x)
            put_value(out, index, at, DX + 1, ranges, y - n.y)
            put_value(out, index, at, DX + 2, ranges, vx)
            put_value(out, index, at, DX + 3, ranges, vy)
            out[index, at + DX + 4] = clamp(face_x, -1.0, 1.0)
            out[index, at + DX + 5] = clamp(face_y, -1.0, 1.0)
            out[index, at + DX + 6] = activity_of(o)


PLANES = ("solid", *OBSERVED_KINDS, "ninja")
"""Planes: the solid share of a cell; the places of each kind of objects; the place of the ninja."""
MAX_BYTE = 255
CLOSED_EXIT = 128


@dataclass(frozen=True)
class LevelPlanes(Part):
    """The level's 31 x 23 cells, one plane per name in ``PLANES``: uint8 (15, 23, 31); normalised: float32, 0 to 1.

    255 (1.0): the middle of an object is in this cell; a closed exit is 128 (0.5). Objects that are gone are left out
    (as in ``NearObjects``). A locked or trap door is shown by its switch.
    """

    name: ClassVar[str] = "planes"

    @property
    def box(self) -> Box:
        shape = (len(PLANES), ROWS, COLUMNS)
        return Box(0.0, 1.0, shape, np.float32) if self.normalised else Box(0, MAX_BYTE, shape, np.uint8)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """The solid planes of the levels; their objects with the planes; the values."""

        def shades(number: int) -> Array:
            points = solidity(context, number, GRID_COLUMNS * SAMPLES, GRID_ROWS * SAMPLES)
            solid = points.reshape(GRID_ROWS, SAMPLES, GRID_COLUMNS, SAMPLES).mean((1, 3))[1:-1, 1:-1]
            return np.asarray(np.rint(solid * MAX_BYTE) * factor)

        factor = 1.0 / MAX_BYTE if self.normalised else 1
        values: Any = np.float64 if self.normalised else np.int64
        planes = {kind.number: 1 + place for place, kind in enumerate(OBSERVED)}
        return (
            observe_planes,
            context.values(shades, values),
            *context.rows(lambda number: _observed(context.objects(number, *planes), planes), ObservedObject),
            MAX_BYTE * factor,
            CLOSED_EXIT * factor,
        )


@kernel
def observe_planes(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, solid: Lookup, bounds: Lookup, objects: Lookup, highest: Lookup, closed: Lookup,
) -> None:  # fmt: skip
    for k in range(first, last):
        index = indices[k]
        level = level_of[index]
        w = worlds[index]
        for j in range(TILES):
            out[index, offset + j] = solid[level * TILES + j]
        for j in range(offset + TILES, offset + len(PLANES) * TILES):
            out[index, j] = 0
        for number in range(bounds[2 * level], bounds[2 * level + 1]):
            o = w.objects[objects[number].slot]
            if is_there(w, o):
                x, y = contact_place_of(o)
                cell = interior_cell(x, y)
                if cell >= 0:
                    is_closed = o.kind == EXIT and not o.is_open
                    out[index, offset + objects[number].number * TILES + cell] = closed if is_closed else highest
        cell = interior_cell(w.ninja.x, w.ninja.y)
        if cell >= 0:
            out[index, offset + (len(PLANES) - 1) * TILES + cell] = highest


@fast
def interior_cell(x: float, y: float) -> int:
    """Index of the level's cell with a place, row by row; -1 for the border and outside."""
    cell = cell_at(x, y)
    column = GRID_COLUMN[cell]
    row = GRID_ROW[cell]
    if 1 <= column <= COLUMNS and 1 <= row <= ROWS:
        return (row - 1) * COLUMNS + column - 1
    return -1
