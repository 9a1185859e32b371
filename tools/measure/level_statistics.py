"""Compare levels with the 500 of the reference.

    python3 tools/dev.py tool measure.level_statistics   # our set
    python3 tools/dev.py tool measure.level_statistics levels/20-0-*.txt   # single levels

A figure outside the reference's quartiles is marked: - below, + above. Of a single level it says which kinds it has,
and which levels of the set share most of its solid cells. Of the set it says what it lacks and which levels are too
alike.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.pack.pack import Pack
from ninja_game.runs.level_design import design
from ninja_game.runs.packs import certificate
from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND
from tools import ROOT
from tools.measure.level_figures import (
    ALL_VARIANTS,
    DESIGN,
    DIFFICULTY,
    KINDS_OF_REFERENCE,
    KNOWN,
    NAMES,
    SHAPES,
    alike,
    common_motifs,
    figures,
    quartiles,
    shared_share,
    solid_cells,
    variants,
)

HEADING = "## The figures"
"""Of the page docs/level-set.md, below which the tables stand."""

MOST_SHARED = 0.6
"""Share of their solid cells that two levels may have in common at most. Caves in rock share much of the rock."""
MOST_WITH_MOTIF = 0.2
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
        run = certificate(pack, file, "exit")
        counts = design(run.level, run.recording.inputs)._asdict() if run else {}
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
    for share, first, second in alike(levels, MOST_SHARED):
        print(f"{first} and {second} share {share:.2f} of their solid cells")
    for motif, names in common_motifs(levels, max(2, MOST_WITH_MOTIF * len(levels))):
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
