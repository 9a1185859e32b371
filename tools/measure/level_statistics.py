"""Compare levels with the 500 of the reference.

    python3 tools/dev.py tool measure.level_statistics   # our set
    python3 tools/dev.py tool measure.level_statistics levels/20-0-*.txt   # single levels

A figure outside the reference's quartiles is marked: - below, + above. Of a single level it says which kinds it has,
and which levels of the set share most of its solid cells. Of the set it says what it lacks and which levels are too
alike.
"""

import argparse
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path
from statistics import quantiles
from typing import Any, NamedTuple

from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS, TILE_CHARS, WEAPONS
from ninja_game.formats.ascii.object_lines import DOORS, MOVEMENTS
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.pack.pack import Pack
from ninja_game.runs.level_design import measure_design
from ninja_game.runs.packs import read_pack_certificate
from ninja_game.sim import kinds
from ninja_game.sim.level import COLUMNS, ROWS, TILES, Level, ObjectSpec, well_formed
from ninja_game.sim.rules import TICKS_PER_SECOND
from tools import ROOT

SHAPES = range(2, 34)  # ids of the tiles that are neither empty nor full
MOTIF = 5, 3  # columns and rows of a motif
MOTIF_SHAPES = 3
"""A motif has at least this many cells with a shape, not all of one straight slope: nobody copies a slope."""
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

DIFFICULTY = Row("difficulty", 2.71, 5.58, 9.9)  # of the best recorded runs on 334 levels of the reference

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


HEADING = "## The figures"  # of the page docs/level-set.md, below which the tables stand

MAX_SHARED = 0.6
"""Share of their solid cells that two levels may have in common at most. Caves in rock share much of the rock."""
MAX_WITH_MOTIF = 0.2
"""Share of the levels that may have a motif in common: where curves are fitted to tiles, their joints repeat."""


def runs(pack: Pack, file: str) -> dict[str, float]:
    """The times of a level's certificates, s."""
    found = {}
    for kind, name in (("exit", "exit_s"), ("gold", "gold_s")):
        certificate = pack.certificate(file, kind)
        if certificate:
            (recording,) = load_replays(pack.files.path / certificate)
            found[name] = (recording.ticks - 1) / TICKS_PER_SECOND
    return found


def figures_of_set(pack: Pack) -> dict[str, dict[str, float]]:
    """The figures of each level file of a pack, with the times of its certificates and its difficulty."""
    found = {file: figures(named.level) | runs(pack, file) for file, named in pack.levels.items()}
    for file, pars in pack.pars.items():
        if pars.difficulty is not None:
            found[file]["difficulty"] = pars.difficulty
    for file, figures_of_level in found.items():
        run = read_pack_certificate(pack, file, "exit")
        counts = measure_design(run.level, run.recording.inputs)._asdict() if run else {}
        figures_of_level |= {name: float(value) for name, value in counts.items() if value is not None}
    return found


def number(value: float) -> str:
    """A figure with as many digits as it needs."""
    return f"{value:.2f}" if abs(value) < 1.005 and value != int(value) else f"{value:.1f}".removesuffix(".0")


def table_of_levels(rows: Mapping[str, Mapping[str, float]]) -> str:
    wide = max([len(name) for name in rows] + [20])
    lines = [" " * wide + "".join(f"{key:>9}" for key in KNOWN)]
    for place, end in enumerate(("25 %", "median", "75 %")):
        cells = (f"{number((row.first, row.median, row.third)[place]):>8} " for row in KNOWN.values())
        lines.append(f"{'reference, ' + end:<{wide}}" + "".join(cells))
    for name, row in rows.items():
        cells = (f"{number(row[key]):>8}{KNOWN[key].mark(row[key])}" if key in row else " " * 9 for key in KNOWN)
        lines.append(f"{name:<{wide}}" + "".join(cells))
    return "\n".join(lines)


def table_of_set(rows: Sequence[Mapping[str, float]]) -> str:
    """The quartiles of the set beside the reference's, in Markdown."""
    lines = ["| per level | reference | ours | median within |", "|---|---|---|---|"]
    for key, row in (*KNOWN.items(), ("difficulty", DIFFICULTY), *DESIGN.items()):
        values = [each[key] for each in rows if key in each]
        ours = quartiles(values)
        inside = "-" if not values else "yes" if row.first <= ours[1] <= row.third else "no"
        lines.append(f"| {row.title} | {_three(row[1:])} | {_three(ours) if values else '-'} | {inside} |")
    return "\n".join(lines)


def _three(values: Sequence[float]) -> str:
    return " - ".join(map(number, values))


def table_of_kinds(levels: Mapping[str, Level]) -> str:
    """In how many levels each kind occurs, in Markdown."""
    found = {name: {NAMES.get(record.kind) for record in level.objects} for name, level in levels.items()}
    lines = ["| levels with, % | reference | ours |", "|---|---|---|"]
    for kind, theirs in KINDS_OF_REFERENCE.items():
        share = 100 * sum(kind in kinds for kinds in found.values()) / max(1, len(found))
        lines.append(f"| {kind} | {theirs} | {share:.0f} |")
    return "\n".join(lines)


def missing(levels: Mapping[str, Level]) -> tuple[list[str], list[int]]:
    """The variants of kinds and the tile ids that no level has."""
    records = [record for level in levels.values() for record in level.objects]
    seen = set().union(*map(variants, records))
    tiles = {tile for level in levels.values() for tile in level.tiles}
    return sorted(ALL_VARIANTS - seen), sorted({0, 1, *SHAPES} - tiles)


def write_page(pack: Pack, page: Path) -> None:
    """Write the tables of a pack at the end of a page, below their heading."""
    levels = {file: named.level for file, named in pack.levels.items()}
    tables = [table_of_set(list(figures_of_set(pack).values())), table_of_kinds(levels)]
    head = page.read_text("utf-8").partition(HEADING)[0]
    page.write_text("\n\n".join([head + HEADING, *tables]) + "\n", "utf-8")


def motif_text(motif: Sequence[int]) -> str:
    """A motif's rows in the characters of ASCII levels."""
    return " ".join("".join(TILE_CHARS[tile] for tile in motif[row::3]) for row in range(3))


def tell_set(pack: Pack) -> None:
    """Print everything about a pack."""
    rows, levels = figures_of_set(pack), {file: named.level for file, named in pack.levels.items()}
    print(table_of_levels(rows), table_of_set(list(rows.values())), table_of_kinds(levels), sep="\n\n")
    absent, tiles = missing(levels)
    print(f"\n{len(levels)} levels; variants that none has: {', '.join(absent) or 'none'}; tiles: {tiles or 'none'}")
    for share, first, second in alike(levels, MAX_SHARED):
        print(f"{first} and {second} share {share:.2f} of their solid cells")
    for motif, names in common_motifs(levels, max(2, MAX_WITH_MOTIF * len(levels))):
        print(f"the motif {motif_text(motif)} is in {len(names)} levels: {', '.join(names)}")


def tell_levels(paths: Sequence[Path], pack: Pack) -> None:
    """Print a row for each level of some files, and its nearest neighbours in the set."""
    chosen = {path.name: load_levels(path)[0].level for path in paths}
    print(table_of_levels({name: figures(level) | runs(pack, name) for name, level in chosen.items()}))
    others = {file: solid_cells(named.level) for file, named in pack.levels.items()}
    for name, level in chosen.items():
        cells = solid_cells(level)
        near = sorted(
            ((shared_share(cells, other), file) for file, other in others.items() if file != name), reverse=True
        )
        shares = ", ".join(f"{file} {share:.2f}" for share, file in near[:3])
        print(f"{name}: {', '.join(sorted(set().union(*map(variants, level.objects))))}\n    shares with: {shares}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("levels", nargs="*", type=Path, help="single levels; without them the whole pack")
    parser.add_argument("--pack", type=Path, default=ROOT / "levels")
    parser.add_argument("--doc", metavar="PAGE", type=Path, help=f"write the tables below {HEADING!r} of this page")
    arguments: Any = parser.parse_args()
    pack = Pack(arguments.pack)
    if arguments.levels:
        tell_levels(arguments.levels, pack)
    else:
        tell_set(pack)
    if arguments.doc:
        write_page(pack, arguments.doc)


if __name__ == "__main__":
    main()
