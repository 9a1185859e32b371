"""Any level as ASCII text: drawn where a picture suffices, else listed too. Reading it gives an equal level."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import (
    DIRECTION_WORDS,
    ODD_TILE,
    PAD_NORMALS,
    SYMBOL_OF_CHAR,
    TILE_CHARS,
    WEAPONS,
    PlacedCharacter,
    legend_text,
    visible_glyphs,
)
from ninja_game.formats.ascii.object_lines import (
    DOORS,
    FORMS,
    MOVEMENTS,
    SIDES,
    ListedObject,
    door_middle,
    natural_offset,
    read_object_line,
)
from ninja_game.formats.ascii.picture import FRAME, point_of
from ninja_game.formats.ascii.places import READING_ORDER, number_text, place_text, read_cell, same_bits
from ninja_game.formats.lines import header_text
from ninja_game.sim import kinds
from ninja_game.sim.grid import Cell
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec, well_formed

ASCII_MAGIC = "ninja-game level"
ASCII_VERSION = 1
HEADER_KEYS = ("name", "author", "comment", "teaches", "says")

LEVELS_KEPT = 512  # in memory, some 10 MB: most recordings in a row are of the same level

RULER = (
    ";    " + "".join(str(column // 10) if column > 9 else " " for column in range(1, COLUMNS + 1)) + "\n"
    ";    " + "".join(str(column % 10) for column in range(1, COLUMNS + 1)) + "\n"
)
"""Comment lines above and below the picture with the numbers of its columns."""


def write_ascii_level(
    level: Level,
    *,
    name: str = "",
    author: str = "",
    comment: str = "",
    teaches: str = "",
    says: str = "",
    legend: bool = False,
) -> str:
    """Write a level in the ASCII format; reading it gives the same tiles, records, order and float64 values.

    Objects keep their ids: the picture alone draws the first ones as long as their order is right, the rest is listed,
    too. ``legend`` adds the meanings of all characters as comment lines.
    """
    fields = zip(HEADER_KEYS, (name, author, comment, teaches, says), strict=True)
    text = [f"{ASCII_MAGIC} {ASCII_VERSION}\n"]
    text += [f"{key}: {header_text(value)}".rstrip() + "\n" for key, value in fields if value or key in HEADER_KEYS[:2]]
    text += ["\n", _picture_and_lines(_Same(level)), *(["\n", legend_text()] if legend else [])]
    return "".join(text)


@dataclass(frozen=True, eq=False)
class _Same:
    """A level that only equals itself: equal levels may still differ in the sign of zeros, so in their text."""

    level: Level

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Same) and self.level is other.level

    def __hash__(self) -> int:
        return id(self.level)


@lru_cache(LEVELS_KEPT)
def _picture_and_lines(same: _Same) -> str:
    level = same.level
    parts = [visible_glyphs(spec) for spec in level.objects]
    drawn = drawn_only(level, parts)
    rows = [f" {row:2d} {FRAME}{chars}{FRAME}\n" for row, chars in enumerate(picture_rows(level, parts), 1)]
    lines = tile_lines(level) + write_object_lines(level.objects[drawn:])
    return "".join([RULER, *rows, RULER, *(["\n", *(f"{line}\n" for line in lines)] if lines else [])])


def headers_of(named: object) -> dict[str, Any]:
    """Collect all headers of a level's file from a NamedLevel or a Draft."""
    return {key: getattr(named, key) for key in HEADER_KEYS}


def _tile_char(number: int) -> str:
    return TILE_CHARS[number] if 0 <= number < len(TILE_CHARS) else ODD_TILE


def picture_rows(level: Level, parts: Sequence[Sequence[PlacedCharacter]]) -> list[str]:
    """Rows of characters; if several objects share a cell, the first one shows."""
    cells = {cell: _tile_char(level.tile(*cell)) for cell in READING_ORDER}
    for char, column, row in (part for group in parts for part in group):
        if cells[column, row] == ".":
            cells[column, row] = char
    return ["".join(cells[column, row] for column in range(1, COLUMNS + 1)) for row in range(1, ROWS + 1)]


def tile_lines(level: Level) -> list[str]:
    """A line for each odd tile id, with all its cells."""
    places: dict[int, list[str]] = {}
    for column, row in READING_ORDER:
        number = level.tile(column, row)
        if _tile_char(number) == ODD_TILE:
            places.setdefault(number, []).append(f"{column},{row}")
    return [f"tile {' '.join(cells)} id {number}" for number, cells in places.items()]


def drawn_only(level: Level, parts: Sequence[Sequence[PlacedCharacter]]) -> int:
    """Count the first records that the picture alone creates in this order."""
    claims = Counter((column, row, SYMBOL_OF_CHAR[char].kind) for group in parts for char, column, row in group)
    taken: set[Cell] = set()
    last = (-1, 0, 0)
    pairs = 0
    for count, (spec, group) in enumerate(zip(level.objects, parts, strict=True)):
        if not group or not same_spec(spec, _as_drawn(spec.kind, group)):
            return count
        cells = {(column, row) for _, column, row in group}
        place = (int(spec.kind != NINJA), group[0].row, group[0].column)
        pairs += spec.kind == EXIT
        if (
            place <= last
            or pairs > 1
            or cells & taken
            or any(level.tile(*cell) != 0 or claims[(*cell, spec.kind)] > 1 for cell in cells)
        ):
            return count
        taken |= cells
        last = place
    return len(level.objects)


def _as_drawn(kind: int, group: Sequence[PlacedCharacter]) -> ObjectSpec:
    """The object that the picture's characters create without a line; not a valid record if it needs a line."""
    values: tuple[float, ...] = ()
    for char, column, row in group:
        symbol = SYMBOL_OF_CHAR[char]
        if symbol.values is None:
            return ObjectSpec(-1, ())
        values += (*point_of((column, row), symbol), *symbol.values)
    return ObjectSpec(kind, values)


_LINE_WIDTH = 100


def same_spec(a: ObjectSpec, b: ObjectSpec) -> bool:
    """Whether two records are equal in kind, text and every bit of their values."""
    return (a.kind, a.text, len(a.values)) == (b.kind, b.text, len(b.values)) and all(
        map(same_bits, a.values, b.values)
    )


def write_object_lines(specs: Sequence[ObjectSpec]) -> list[str]:
    """Lines of the list that create exactly these records, in order; neighbours of one kind share a line."""
    lines: list[str] = []
    head = tail = ""
    for spec in specs:
        keyword, place, words = _readable(spec)
        single = keyword not in FORMS or FORMS[keyword].single
        if not single and (keyword, words) == (head, tail) and len(lines[-1]) + len(place) < _LINE_WIDTH:
            stem = lines[-1].removesuffix(words) if words else lines[-1]
            lines[-1] = f"{stem.rstrip()} {place} {words}".rstrip()
        else:
            lines.append(" ".join(filter(None, (keyword, place, words))))
        head, tail = ("", "") if single else (keyword, words)
    return lines


def _readable(spec: ObjectSpec) -> tuple[str, str, str]:
    """Keyword, place and further words of a record's line; ``raw`` if no other form reproduces every bit of it."""
    keyword, place, words = best_form(spec)
    if keyword:
        listed = read_object_line(f"{keyword} {place} {words}")
        if len(listed) == 1 and isinstance(listed[0], ListedObject) and same_spec(listed[0].spec, spec):
            return keyword, place, words
    text = json.dumps(spec.text) if spec.text or spec.kind == -1 else ""
    kind = "" if spec.kind == -1 and not spec.values else str(spec.kind)
    return "raw", kind, f"{','.join(map(number_text, spec.values))} {text}".strip()


def _word(vocabulary: Mapping[str, float], value: float) -> str:
    return next((word for word, number in vocabulary.items() if number == value), "")


def best_form(spec: ObjectSpec) -> tuple[str, str, str]:
    """The form for a record's kind, keyword '' if there is none. It may not reproduce the record exactly."""
    kind, values = spec.kind, spec.values
    if not well_formed(spec) or spec.text:
        return "", "", ""
    x, y = values[:2]
    keyword = next(keyword for keyword, form in FORMS.items() if form.kind == kind)
    if kind == kinds.DOOR:
        return _door_form(values)
    if kind == kinds.EXIT:
        return keyword, place_text(x, y), f"switch {place_text(values[2], values[3])}"
    if kind == kinds.FLOOR_GUARD:
        words = "" if values[2] == 1 else f"facing {number_text(values[2])}"
        return keyword, place_text(x, y, *natural_offset(keyword)), words
    if kind == kinds.LAUNCH_PAD:
        direction = next((word for word, normal in PAD_NORMALS.items() if normal == values[2:]), "")
        if not all(map(same_bits, PAD_NORMALS.get(direction, ()), values[2:])):
            direction = ""
        words = direction or f"normal {number_text(values[2])},{number_text(values[3])}"
        return keyword, place_text(x, y, *natural_offset(keyword, direction)), words
    if kind in (kinds.ONE_WAY, kinds.THWUMP):
        word = _word(DIRECTION_WORDS, values[2])
        return (keyword if word else ""), place_text(x, y), word
    if kind == kinds.DRONE:
        move = _word(MOVEMENTS, values[2])
        direction = _word(DIRECTION_WORDS, values[5])
        keyword = _word(WEAPONS, values[4])
        words = f"{move} {direction}{' seeker' if values[3] == 1 else ''}"
        return (keyword if move and direction else ""), place_text(x, y), words
    return keyword, place_text(x, y), ""


def _door_form(values: tuple[float, ...]) -> tuple[str, str, str]:
    """As ``best_form``."""
    x, y, vertical, trap, column, row, locked, i, j = values
    keyword = next((word for word, flags in DOORS.items() if flags == (trap, locked)), "")
    side = next((word for word, numbers in SIDES.items() if numbers == (vertical, i, j)), "")
    place = f"{number_text(column)},{number_text(row)}"
    try:
        read_cell(place)
    except LevelError:
        return "", "", ""
    if not side:
        return "", "", ""
    if keyword == "automatic door":
        return keyword if door_middle(values) == (x, y) else "", place, side
    return keyword, place, f"{side} switch {place_text(x, y)}"
