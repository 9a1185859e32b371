"""Object records to lines of the list of an ASCII level: the readable form, or ``raw`` where none is exact."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS
from ninja_game.formats.ascii.object_forms import DOORS, FORMS, MOVEMENTS, SIDES, WEAPONS, door_middle, natural_offset
from ninja_game.formats.ascii.object_lines import Listed, read_object_line
from ninja_game.formats.ascii.places import number_text, place_text, read_cell, same_bits
from ninja_game.sim import kinds
from ninja_game.sim.level import ObjectSpec, well_formed

_LINE_WIDTH = 100


def same_record(a: ObjectSpec, b: ObjectSpec) -> bool:
    """Whether two records are the same in kind, text and every bit of their values."""
    return (
        (a.kind, a.text, len(a.values)) == (b.kind, b.text, len(b.values))
        and all(map(same_bits, a.values, b.values))
    )  # fmt: skip


def write_object_lines(records: Sequence[ObjectSpec]) -> list[str]:
    """Lines of the list that create just these records, in order; neighbours of one kind share a line."""
    lines: list[str] = []
    head = tail = ""
    for record in records:
        keyword, place, words = _readable(record)
        single = keyword not in FORMS or FORMS[keyword].single
        if not single and (keyword, words) == (head, tail) and len(lines[-1]) + len(place) < _LINE_WIDTH:
            stem = lines[-1].removesuffix(words) if words else lines[-1]
            lines[-1] = f"{stem.rstrip()} {place} {words}".rstrip()
        else:
            lines.append(" ".join(filter(None, (keyword, place, words))))
        head, tail = ("", "") if single else (keyword, words)
    return lines


def _readable(record: ObjectSpec) -> tuple[str, str, str]:
    """Keyword, place and further words of a record's line; ``raw`` if no form gives it back to the last bit."""
    keyword, place, words = best_form(record)
    if keyword:
        listed = read_object_line(f"{keyword} {place} {words}")
        if len(listed) == 1 and isinstance(listed[0], Listed) and same_record(listed[0].record, record):
            return keyword, place, words
    text = json.dumps(record.text) if record.text or record.kind == -1 else ""
    kind = "" if record.kind == -1 and not record.values else str(record.kind)
    return "raw", kind, f"{','.join(map(number_text, record.values))} {text}".strip()


def _word(vocabulary: Mapping[str, float], value: float) -> str:
    return next((word for word, number in vocabulary.items() if number == value), "")


def best_form(record: ObjectSpec) -> tuple[str, str, str]:
    """The form that fits a record's kind; keyword '' if none does. Not yet sure to give it back exactly."""
    kind, values = record.kind, record.values
    if not well_formed(record) or record.text:
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
        move, direction, keyword = (
            _word(MOVEMENTS, values[2]), _word(DIRECTION_WORDS, values[5]), _word(WEAPONS, values[4])
        )  # fmt: skip
        words = f"{move} {direction}{' seeker' if values[3] == 1 else ''}"
        return (keyword if move and direction else ""), place_text(x, y), words
    return keyword, place_text(x, y), ""


def _door_form(values: tuple[float, ...]) -> tuple[str, str, str]:
    x, y, vertical, trap, column, row, locked, i, j = values
    keyword = next((word for word, flags in DOORS.items() if flags == (trap, locked)), "")
    side = next((word for word, numbers in SIDES.items() if numbers == (vertical, i, j)), "")
    place = f"{number_text(column)},{number_text(row)}"
    try:
        cell = read_cell(place)
    except LevelError:
        return "", "", ""
    if not side:
        return "", "", ""
    if keyword == "automatic door":
        return keyword if door_middle(*cell, side) == (x, y) else "", place, side
    return keyword, place, f"{side} switch {place_text(x, y)}"
