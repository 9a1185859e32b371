"""What levels are made of, in figures: counts, symmetry, variants, motifs, shared cells; and those of the reference."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations
from statistics import quantiles
from typing import NamedTuple

from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS
from ninja_game.formats.ascii.object_forms import DOORS, MOVEMENTS, WEAPONS
from ninja_game.sim import kinds
from ninja_game.sim.level import COLUMNS, ROWS, TILES, Level, ObjectSpec, well_formed

SHAPES = range(2, 34)
"""Ids of the tiles that are neither empty nor full."""

MOTIF = 5, 3
"""Columns and rows of a motif."""
MOTIF_SHAPES = 3
"""A motif has at least so many cells with a shape, not all of one straight slope: nobody copies a slope."""
STRAIGHT = {2: "45°", 14: "22°", 18: "22°", 22: "67°", 26: "67°"}
"""First ids of the families of slopes, each with three more that are turned; both ends make one slope."""

NAMES = {kind.number: kind.name for kind in kinds.KINDS if kind.number >= 0}
BY_WEAPON = {number: name for name, number in WEAPONS.items()}
BY_MOVEMENT = {number: name for name, number in MOVEMENTS.items()}
BY_DIRECTION = {number: name for name, number in DIRECTION_WORDS.items()}
BY_NORMAL = {normal: name for name, normal in PAD_NORMALS.items()}
BY_FLAGS = {flags: name for name, flags in DOORS.items()}

ALL_VARIANTS = frozenset(
    [
        NAMES[kind]
        for kind in NAMES
        if kind not in {kinds.DRONE, kinds.DOOR, kinds.ONE_WAY, kinds.THWUMP, kinds.LAUNCH_PAD}
    ]
    + [f"{NAMES[kind]} {word}" for kind in (kinds.ONE_WAY, kinds.THWUMP) for word in DIRECTION_WORDS]
    + [f"launch pad {word}" for word in PAD_NORMALS]
    + [f"{sort} {way}" for sort in DOORS for way in ("upright", "flat")]
    + [*WEAPONS, "zap drone seeker"]
    + [f"drone {movement}" for movement in MOVEMENTS]
)
"""Every kind with every variant."""


class Row(NamedTuple):
    """A figure: what it is called, and the reference's first quartile, median and third quartile."""

    title: str
    first: float
    median: float
    third: float

    def mark(self, value: float) -> str:
        """Whether a value is below or above the reference's quartiles."""
        return "-" if value < self.first else "+" if value > self.third else " "


KNOWN = {
    "objects": Row("objects", 50, 66, 88),
    "gold": Row("gold", 24, 36, 49),
    "enemies": Row("enemies other than mines", 3, 5, 7),
    "mines": Row("mines", 0, 7, 21),
    "kinds": Row("kinds besides ninja and exit", 3, 4, 6),
    "solid": Row("solid share of the cells", 0.13, 0.224, 0.373),
    "shapes": Row("tiles with a shape", 20, 40, 72.25),
    "mirror": Row("cells equal to their left-right mirror", 0.736, 0.893, 0.997),
    "exit_s": Row("best run to the exit, s", 7.156, 11.363, 17.619),
    "gold_s": Row("best run with (nearly) all gold, s", 16.8, 22.913, 28.694),
}
"""Of 500 levels, and the best recorded runs on them. "Solid" is what is not empty."""

DESIGN = {
    "hazard_distance": Row("distance of hazards to the run, px", 36.6, 66.4, 126.4),
    "bait": Row("share of the gold in danger", 0.277, 0.608, 0.952),
    "gold_evenness": Row("evenness of the gold", 0.268, 0.4, 0.67),
    "mine_evenness": Row("evenness of the mines", 0.608, 0.861, 1.178),
    "bays": Row("bays with the same tiles", 1, 2, 3),
    "unused": Row("share of the space that is not used", 0.0, 0.024, 0.102),
    "detour": Row("length of the run over start to exit", 4.56, 8.76, 22.4),
    "near_ticks": Row("share of the run within 20 px of death", 0.018, 0.091, 0.192),
}
"""Of 334 levels with the best recorded run: what docs/good-levels.md counts (`ninja_game.runs.level_design`)."""

DIFFICULTY = Row("difficulty", 2.71, 5.58, 9.9)
"""Of the best recorded runs on 334 levels of the reference."""

KINDS_OF_REFERENCE = {
    "bounce block": 41, "launch pad": 30, "gauss turret": 36, "floor guard": 28, "drone": 64, "one-way platform": 12,
    "thwump": 21, "door": 52, "homing launcher": 20, "mine": 61,
}  # fmt: skip
"""In how many of a hundred levels of the reference a kind occurs."""


def figures(level: Level) -> dict[str, float]:
    """The figures of a level that are compared, by the names of ``KNOWN``."""
    count = Counter(record.kind for record in level.objects)
    tiles = level.tiles
    mirrored = sum(
        (tiles[i * ROWS + j] > 0) == (tiles[(COLUMNS - 1 - i) * ROWS + j] > 0)
        for i in range(COLUMNS)
        for j in range(ROWS)
    )
    return {
        "objects": len(level.objects),
        "gold": count[kinds.GOLD],
        "enemies": sum(count[kind] for kind in kinds.ENEMIES),
        "mines": count[kinds.MINE],
        "kinds": len(count.keys() - {kinds.NINJA, kinds.EXIT}),
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
    if kind in {kinds.ONE_WAY, kinds.THWUMP}:
        return {f"{NAMES[kind]} {BY_DIRECTION.get(values[2], '?')}"}
    if kind == kinds.LAUNCH_PAD:
        return {f"launch pad {BY_NORMAL.get((values[2], values[3]), 'oblique')}"}
    if kind == kinds.DOOR:
        return {f"{BY_FLAGS.get((values[3], values[6]), 'door')} {'flat' if values[2] else 'upright'}"}
    if kind == kinds.DRONE:
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
