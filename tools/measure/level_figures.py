"""What levels are made of, in figures: counts, shares, symmetry, kinds and their variants, motifs, shared cells."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations
from statistics import quantiles

from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS
from ninja_game.formats.ascii.object_forms import DOORS, MOVEMENTS, WEAPONS
from ninja_game.sim.kinds import (
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    KINDS,
    LAUNCH_PAD,
    LAUNCHER,
    MINE,
    NINJA,
    ONE_WAY,
    THWUMP,
    TURRET,
)  # fmt: skip
from ninja_game.sim.level import COLUMNS, ROWS, TILES, Level, ObjectSpec, well_formed

ENEMIES = (DRONE, FLOOR_GUARD, THWUMP, TURRET, LAUNCHER)
SHAPES = range(2, 34)
"""Ids of the tiles that are neither empty nor full."""

MOTIF = 5, 3
"""Columns and rows of a motif."""
MOTIF_SHAPES = 3
"""A motif has at least so many cells with a shape, not all of one straight slope: nobody copies a slope."""
STRAIGHT = {2: "45°", 14: "22°", 18: "22°", 22: "67°", 26: "67°"}
"""First ids of the families of slopes, each with three more that are turned; both ends make one slope."""

NAMES = {kind.number: kind.name for kind in KINDS if kind.number >= 0}
BY_WEAPON = {number: name for name, number in WEAPONS.items()}
BY_MOVEMENT = {number: name for name, number in MOVEMENTS.items()}
BY_DIRECTION = {number: name for name, number in DIRECTION_WORDS.items()}
BY_NORMAL = {normal: name for name, normal in PAD_NORMALS.items()}
BY_FLAGS = {flags: name for name, flags in DOORS.items()}

ALL_VARIANTS = frozenset(
    [NAMES[kind] for kind in NAMES if kind not in {DRONE, DOOR, ONE_WAY, THWUMP, LAUNCH_PAD}]
    + [f"{NAMES[kind]} {word}" for kind in (ONE_WAY, THWUMP) for word in DIRECTION_WORDS]
    + [f"launch pad {word}" for word in PAD_NORMALS]
    + [f"{sort} {way}" for sort in DOORS for way in ("upright", "flat")]
    + [*WEAPONS, "zap drone seeker"]
    + [f"drone {movement}" for movement in MOVEMENTS]
)
"""Every kind with every variant."""


def figures(level: Level) -> dict[str, float]:
    """The figures of a level that are compared, by the names of ``ROWS`` in level_reference."""
    count = Counter(record.kind for record in level.objects)
    tiles = level.tiles
    mirrored = sum(
        (tiles[i * ROWS + j] > 0) == (tiles[(COLUMNS - 1 - i) * ROWS + j] > 0)
        for i in range(COLUMNS)
        for j in range(ROWS)
    )
    return {
        "objects": len(level.objects),
        "gold": count[GOLD],
        "enemies": sum(count[kind] for kind in ENEMIES),
        "mines": count[MINE],
        "kinds": len(count.keys() - {NINJA, EXIT}),
        "solid": len(solid_cells(level)) / TILES,
        "shapes": sum(tile in SHAPES for tile in tiles),
        "mirror": mirrored / TILES,
    }


def solid_cells(level: Level) -> frozenset[int]:
    """The cells that are not empty, as indices of ``tiles``."""
    return frozenset(cell for cell, tile in enumerate(level.tiles) if tile > 0)


def shared_share(first: frozenset[int], second: frozenset[int]) -> float:
    """Of the cells that are solid in one of two levels, the share that is solid in both.

    >>> shared_share(frozenset({1, 2, 3}), frozenset({2, 3, 4}))
    0.5
    """
    return len(first & second) / max(1, len(first | second))


def alike(levels: Mapping[str, Level], limit: float) -> list[tuple[float, str, str]]:
    """The pairs of levels that share more than ``limit`` of their solid cells, the most alike first."""
    cells = {name: solid_cells(level) for name, level in levels.items()}
    pairs = ((shared_share(cells[a], cells[b]), a, b) for a, b in combinations(levels, 2))
    return sorted((pair for pair in pairs if pair[0] > limit), reverse=True)


def motifs(level: Level) -> set[tuple[int, ...]]:
    """The blocks of 5 x 3 cells with ``MOTIF_SHAPES`` shapes or more of two slopes or more, column by column."""
    wide, high = MOTIF
    found = set()
    for i in range(COLUMNS - wide + 1):
        for j in range(ROWS - high + 1):
            block = [level.tiles[(i + k) * ROWS + j : (i + k) * ROWS + j + high] for k in range(wide)]
            tiles = tuple(tile for column in block for tile in column)
            shapes = [tile for tile in tiles if tile in SHAPES]
            if len(shapes) >= MOTIF_SHAPES and len({slope(tile) for tile in shapes}) > 1:
                found.add(tiles)
    return found


def slope(tile: int) -> tuple[str, int]:
    """What slope a tile with a shape is part of: its steepness and its solid corner; of others the tile itself.

    >>> slope(14) == slope(18), slope(14) == slope(15)
    (True, False)
    """
    turned = (tile - 2) % 4
    return STRAIGHT.get(tile - turned, str(tile)), turned


def common_motifs(levels: Mapping[str, Level], most: float) -> list[tuple[tuple[int, ...], list[str]]]:
    """The motifs that occur in more than ``most`` levels, with the names of these, the commonest first."""
    where: dict[tuple[int, ...], list[str]] = {}
    for name, level in levels.items():
        for motif in motifs(level):
            where.setdefault(motif, []).append(name)
    found = [(motif, names) for motif, names in where.items() if len(names) > most]
    return sorted(found, key=lambda each: -len(each[1]))


def variants(record: ObjectSpec) -> set[str]:
    """What of ``ALL_VARIANTS`` an object is."""
    if not well_formed(record):
        return set()
    kind, values = record.kind, record.values
    if kind in {ONE_WAY, THWUMP}:
        return {f"{NAMES[kind]} {BY_DIRECTION.get(values[2], '?')}"}
    if kind == LAUNCH_PAD:
        return {f"launch pad {BY_NORMAL.get((values[2], values[3]), 'oblique')}"}
    if kind == DOOR:
        return {f"{BY_FLAGS.get((values[3], values[6]), 'door')} {'flat' if values[2] else 'upright'}"}
    if kind == DRONE:
        weapon = BY_WEAPON.get(values[4], "drone")
        seeking = {"zap drone seeker"} if values[3] and weapon == "zap drone" else set()
        return {weapon, f"drone {BY_MOVEMENT.get(values[2], '?')}"} | seeking
    return {NAMES[kind]}


def quartiles(values: Sequence[float]) -> tuple[float, float, float]:
    """First quartile, median, third quartile.

    >>> quartiles([1, 2, 3, 4, 5])
    (2.0, 3.0, 4.0)
    """
    if len(values) < 2:
        return (float(values[0]),) * 3 if values else (0.0,) * 3
    first, middle, third = quantiles(values, n=4, method="inclusive")
    return first, middle, third
