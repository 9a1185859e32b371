"""Picture and list of an ASCII level brought together: which line speaks of which drawn object, and in what order."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ninja_game.formats.ascii.legend import ODD_TILE, SYMBOL_OF_CHAR, TILE_CHARS, Symbol, visible_parts
from ninja_game.formats.ascii.object_lines import Listed, OddTile
from ninja_game.formats.ascii.picture import Cell, Picture
from ninja_game.formats.ascii.problems import Problems
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

_NEEDED_LINES = {
    "5": "launch pad {cell} normal 0.6,-0.8",
    "Z": "zap drone {cell} wander-cw right",
    "L": "laser drone {cell} wander-cw right",
    "C": "chaingun drone {cell} wander-cw right",
    "&": "locked door 20,14 left switch {cell}",
    "!": "trap door 20,14 left switch {cell}",
}
"""A line to copy for each drawn object that needs one."""


class Placed(NamedTuple):
    """An object of the list and the line that gives it."""

    listed: Listed
    line: int


class PlacedTile(NamedTuple):
    """A tile of the list and the line that gives it."""

    tile: OddTile
    line: int


def merge_picture_and_list(
    picture: Picture, objects: Sequence[Placed], tiles: Sequence[PlacedTile], problems: Problems
) -> Level:
    """The level: drawn objects that no line mentions (ninjas first, then in reading order), then the list in order.

    Mistakes are noted in ``problems``; the level is then of no use.
    """
    mentioned, conflicts = _mentioned(picture, objects, problems)
    drawn: list[tuple[Cell, Symbol]] = []
    for cell in picture.cells():
        symbol = SYMBOL_OF_CHAR.get(picture.char(cell))
        if symbol is None or cell in mentioned:
            continue
        if cell in conflicts:
            placed, wanted = conflicts[cell]
            problems.add(f"picture and list disagree at {cell[0]},{cell[1]}", *picture.where(cell),
                         found=_named(symbol), expected=f"{_named(wanted)}, as line {placed.line} says")  # fmt: skip
        elif symbol.values is None:
            example = _NEEDED_LINES[symbol.char].format(cell=f"{cell[0]},{cell[1]}")
            problems.add(f"{_named(symbol)} without its line", *picture.where(cell),
                         hint=f"add a line below the picture, such as: {example}")  # fmt: skip
        else:
            drawn.append((cell, symbol))
    records = _drawn_records(picture, drawn, problems) + [placed.listed.record for placed in objects]
    return Level(tuple(_tiles(picture, tiles, problems)), tuple(records))


def _mentioned(
    picture: Picture, objects: Iterable[Placed], problems: Problems
) -> tuple[set[Cell], dict[Cell, tuple[Placed, Symbol]]]:
    """Cells whose drawn object a line speaks of; cells where a line has another form of the same kind."""
    mentioned: set[Cell] = set()
    conflicts: dict[Cell, tuple[Placed, Symbol]] = {}
    for placed in objects:
        for part in visible_parts(placed.listed.record):
            cell, wanted = (part.column, part.row), SYMBOL_OF_CHAR[part.char]
            char = picture.char(cell)
            if char == part.char:
                mentioned.add(cell)
            elif char in ". ":
                problems.add(
                    f"{_named(wanted)} at {part.column},{part.row} is not in the picture",
                    placed.line,
                    placed.listed.column,
                    hint=f"draw {part.char} in line {picture.where(cell)[0]}, column {picture.where(cell)[1]}, "
                    "or correct the place",
                )
            elif char in SYMBOL_OF_CHAR and SYMBOL_OF_CHAR[char].kind == wanted.kind:
                conflicts[cell] = placed, wanted
    return mentioned, conflicts


def _named(symbol: Symbol) -> str:
    return f"{symbol.char} ({symbol.name})"


def point_of(cell: Cell, symbol: Symbol) -> tuple[float, float]:
    """Where a drawn object stands, px."""
    return 24.0 * cell[0] + 12.0 + symbol.dx, 24.0 * cell[1] + 12.0 + symbol.dy


def _drawn_records(picture: Picture, drawn: Sequence[tuple[Cell, Symbol]], problems: Problems) -> list[ObjectSpec]:
    """Records of the objects that the picture alone creates."""
    exits = [cell for cell, symbol in drawn if symbol.char == "X"]
    switches = [cell for cell, symbol in drawn if symbol.char == "x"]
    if (len(exits), len(switches)) not in ((0, 0), (1, 1)):
        first, other = (exits, "x, its switch") if exits else (switches, "X, its exit")
        problems.add(
            "exits and switches that no line mentions and that make no pair",
            *picture.where(first[0]),
            found=f"{len(exits)} X and {len(switches)} x",
            hint="say which belong together in lines such as: exit 29,21 switch 3,4"
            if exits and switches
            else f"draw {other}, or add a line such as: exit 29,21 switch 3.5,4",
        )
    ninjas: list[ObjectSpec] = []
    others: list[ObjectSpec] = []
    for cell, symbol in drawn:
        if symbol.kind == EXIT:
            if symbol.char == "X" and switches:
                switch = point_of(switches[0], SYMBOL_OF_CHAR["x"])
                others.append(ObjectSpec(EXIT, (*point_of(cell, symbol), *switch)))
        else:
            record = ObjectSpec(symbol.kind, (*point_of(cell, symbol), *(symbol.values or ())))
            (ninjas if symbol.kind == NINJA else others).append(record)
    return ninjas + others


def _tiles(picture: Picture, lines: Iterable[PlacedTile], problems: Problems) -> list[int]:
    """The 713 tile ids, odd ones from their lines."""
    tiles = picture.tiles()
    given: set[Cell] = set()
    for tile, line in lines:
        (column, row), mistake = tile.cell, ""
        if not (1 <= column <= COLUMNS and 1 <= row <= ROWS):
            mistake, hint = "a tile line for a border cell", "only 1,1 to 31,23 have tiles of the level"
        elif tile.cell in given:
            mistake, hint = "a second tile line for one cell", "keep one"
        elif 0 <= tile.id < len(TILE_CHARS):
            mistake, hint = f"tile {tile.id} has a character", f"draw {TILE_CHARS[tile.id]} in the picture instead"
        elif picture.char(tile.cell) != ODD_TILE:
            mistake, hint = "a tile line for a cell that is not marked", f"draw {ODD_TILE} in the picture there"
        given.add(tile.cell)
        if mistake:
            problems.add(mistake, line, tile.column, found=f"{column},{row}", hint=hint)
            continue
        tiles[(column - 1) * ROWS + row - 1] = tile.id
    for cell in picture.cells():
        if picture.char(cell) == ODD_TILE and cell not in given:
            hint = f"add a line below the picture: tile {cell[0]},{cell[1]} id 70, or draw another character"
            problems.add("an odd tile without its line", *picture.where(cell), found=repr(ODD_TILE), hint=hint)
    return tiles
