"""Make a world of level data: the tiles of the grid, then every object in the order of its record (objects.md §2.1)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ninja_game.errors import LevelError
from ninja_game.sim.collision.tiles import ODD_HALF_ID, UNDEFINED_ID
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import EXIT, INERT, NINJA, VALUE_COUNTS
from ninja_game.sim.level import COLUMNS, ROWS, Level, check_level, makes_object
from ninja_game.sim.objects.dispatch import create
from ninja_game.sim.rules import DEFAULT_SPAWN_X, DEFAULT_SPAWN_Y, DRAG, GRAVITY, GRID_COLUMNS, GRID_ROWS, STRIDE
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.world_fields import CAPACITY, Ninja, TileMap, World


def grid_tiles(level: Level) -> list[int]:
    """The tile of every grid index: the level's 31 x 23, a border of full tiles, and a ring of empty cells."""
    tiles = [0] * STRIDE + ([0] + [1] * GRID_COLUMNS + [0]) * GRID_ROWS + [0] * STRIDE
    ids = level.tiles
    if min(ids) < 0 or max(ids) >= ODD_HALF_ID:
        ids = tuple(UNDEFINED_ID if tile < 0 else min(tile, ODD_HALF_ID) for tile in ids)
    for row in range(ROWS):
        start = (row + 2) * STRIDE + 2
        tiles[start : start + COLUMNS] = ids[row::ROWS]
    return tiles


def tile_map(level: Level) -> TileMap:
    """A level as the rules read it."""
    tiles = TileMap()
    tiles.ids = grid_tiles(level)
    return tiles


class ObjectTable(NamedTuple):
    """A level's records as ``populate`` takes them, and the number of slots that its world needs, slot 0 included."""

    kinds: list[int]
    counts: list[int]
    values: list[list[float]]
    slots: int


def object_table(level: Level) -> ObjectTable:
    """Collect the records that make an object. Every level is checked here, whatever its origin.

    The rules can rely on what passes. A record of an unknown kind creates nothing (objects.md §2.1). Raises LevelError
    for an argument that is not a level, and for a level without a ninja or with too many objects.
    """
    check_level(level)
    specs = list(filter(makes_object, level.objects))
    kinds = [int(spec.kind) for spec in specs]
    if NINJA not in kinds:
        raise LevelError("this level cannot be played: it has no ninja", hint="add one, a record of type 5")
    counts = [len(spec.values) for spec in specs]
    values = [[*map(float, spec.values[:9]), *[0.0] * (9 - len(spec.values))] for spec in specs]
    slots = len(specs) + 1 + kinds.count(EXIT)
    if slots > CAPACITY:
        raise LevelError(
            "this level has too many objects",
            found=f"{slots - 1} (an exit counts twice)",
            expected=f"at most {CAPACITY - 1}",
        )
    return ObjectTable(kinds, counts, values, slots)


@fast
def populate(
    tiles: TileMap, w: World, kinds: Sequence[int], counts: Sequence[int], values: Sequence[Sequence[float]]
) -> None:
    """Create the object of every record; its id is its index. Edges must be set; objects must be zero.

    ``values`` holds nine numbers per record, ``counts`` how many of them the record really had.
    """
    count = len(kinds)
    w.id_count = count
    w.slots_used = count + 1
    place_ninja(w.ninja, 0.0, 0.0)
    for index in range(count):
        kind = kinds[index]
        o = w.objects[index + 1]
        o.id = index
        o.slot = index + 1
        o.kind = INERT
        record = values[index]
        if kind == NINJA:
            o.kind = NINJA
            o.x = DEFAULT_SPAWN_X
            o.y = DEFAULT_SPAWN_Y
            if counts[index] == 2:
                o.x = record[0]
                o.y = record[1]
            place_ninja(w.ninja, o.x, o.y)
            if counts[index] == 2:
                w.ninja.cell = cell_at(o.x, o.y)
        elif counts[index] == VALUE_COUNTS[kind]:
            o.kind = kind
            o.x = record[0]
            o.y = record[1]
            create(tiles, w, o, record)


@fast
def place_ninja(n: Ninja, x: float, y: float) -> None:
    """Place the ninja, standing still (ninja.md §2)."""
    n.x = x
    n.y = y
    n.prev_x = x
    n.prev_y = y
    n.gravity = GRAVITY
    n.drag = DRAG
    n.in_air = 1
    n.was_in_air = 1
    n.cell = 0
