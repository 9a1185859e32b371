"""Any level as ASCII text: drawn as far as possible, listed where order or parameters need it, equal when read back."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence

from ninja_game.formats.ascii.legend import (
    ODD_TILE,
    SYMBOL_OF_CHAR,
    TILE_CHARS,
    Part,
    legend_text,
    visible_parts,
)
from ninja_game.formats.ascii.match import point_of
from ninja_game.formats.ascii.object_writer import same_record, write_object_lines
from ninja_game.formats.ascii.picture import FRAME, Cell
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

MAGIC = "ninja-game level"
VERSION = 1
HEADER_KEYS = ("name", "author", "comment", "teaches")

RULER = (
    ";    " + "".join(str(column // 10) if column > 9 else " " for column in range(1, COLUMNS + 1)) + "\n"
    ";    " + "".join(str(column % 10) for column in range(1, COLUMNS + 1)) + "\n"
)
"""Comment lines above and below the picture that number its columns."""


def write_ascii_level(
    level: Level, *, name: str = "", author: str = "", comment: str = "", teaches: str = "", legend: bool = False
) -> str:
    """A level in our ASCII format; reading it gives the same tiles, records, order and float64 values.

    Objects keep their ids: as many as the picture puts in the right order are only drawn, the others are listed too.
    ``legend`` adds the meaning of all characters as comment lines.
    """
    parts = [visible_parts(record) for record in level.objects]
    drawn = drawn_only(level, parts)
    rows = picture_rows(level, parts)
    fields = zip(HEADER_KEYS, (name, author, comment, teaches), strict=True)
    text = [f"{MAGIC} {VERSION}\n"]
    text += [f"{key}: {header_text(value)}".rstrip() + "\n" for key, value in fields if value or key in HEADER_KEYS[:2]]
    text += ["\n", RULER]
    text += [f" {row:2d} {FRAME}{chars}{FRAME}\n" for row, chars in enumerate(rows, 1)]
    text.append(RULER)
    lines = tile_lines(level) + write_object_lines(level.objects[drawn:])
    text += ["\n", *(f"{line}\n" for line in lines)] if lines else []
    text += ["\n", legend_text()] if legend else []
    return "".join(text)


def header_text(value: str) -> str:
    """A header's value as it is written: in double quotes as JSON where it would not come back otherwise."""
    plain = value == value.strip() and not value.startswith('"') and value.isprintable()
    return value if plain else json.dumps(value)


def _tile_char(number: int) -> str:
    return TILE_CHARS[number] if 0 <= number < len(TILE_CHARS) else ODD_TILE


def picture_rows(level: Level, parts: Sequence[Sequence[Part]]) -> list[str]:
    """Rows of characters; where several objects share a cell the first one shows."""
    cells = {
        (column, row): _tile_char(level.tile(column, row))
        for row in range(1, ROWS + 1)
        for column in range(1, COLUMNS + 1)
    }
    for char, column, row in (part for group in parts for part in group):
        if cells[column, row] == ".":
            cells[column, row] = char
    return ["".join(cells[column, row] for column in range(1, COLUMNS + 1)) for row in range(1, ROWS + 1)]


def tile_lines(level: Level) -> list[str]:
    """A line for each odd tile id, with all its cells."""
    places: dict[int, list[str]] = {}
    for row in range(1, ROWS + 1):
        for column in range(1, COLUMNS + 1):
            number = level.tile(column, row)
            if _tile_char(number) == ODD_TILE:
                places.setdefault(number, []).append(f"{column},{row}")
    return [f"tile {' '.join(cells)} id {number}" for number, cells in places.items()]


def drawn_only(level: Level, parts: Sequence[Sequence[Part]]) -> int:
    """How many of the first records the picture alone creates, in this very order."""
    claims = Counter((column, row, SYMBOL_OF_CHAR[char].kind) for group in parts for char, column, row in group)
    taken: set[Cell] = set()
    last = (-1, 0, 0)
    pairs = 0
    for count, (record, group) in enumerate(zip(level.objects, parts, strict=True)):
        if not group or not same_record(record, _as_drawn(record.kind, group)):
            return count
        cells = {(column, row) for _, column, row in group}
        place = (int(record.kind != NINJA), group[0].row, group[0].column)
        pairs += record.kind == EXIT
        if (
            place <= last
            or pairs > 1
            or cells & taken
            or any(level.tile(*cell) != 0 or claims[(*cell, record.kind)] > 1 for cell in cells)
        ):
            return count
        taken |= cells
        last = place
    return len(level.objects)


def _as_drawn(kind: int, group: Sequence[Part]) -> ObjectSpec:
    """What the picture makes of an object's characters if no line mentions it; no valid record if it needs a line."""
    values: tuple[float, ...] = ()
    for char, column, row in group:
        symbol = SYMBOL_OF_CHAR[char]
        if symbol.values is None:
            return ObjectSpec(-1, ())
        values += (*point_of((column, row), symbol), *symbol.values)
    return ObjectSpec(kind, values)
