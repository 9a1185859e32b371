"""The ASCII level format: a header, a picture of 31 x 23 characters, a list of objects (`docs/level-format.md`)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.object_lines import ListedObject, OddTile, read_object_line, suggestion
from ninja_game.formats.ascii.picture import ROW_END, ROW_START, Problems, merge_picture_and_list, read_picture
from ninja_game.formats.ascii.places import quoted
from ninja_game.formats.ascii.writer import ASCII_MAGIC, ASCII_VERSION, HEADER_KEYS
from ninja_game.formats.lines import MAX_NAME, UNCOMMENTED, Line, numbered_lines, read_quoted
from ninja_game.formats.messages import parse_messages
from ninja_game.sim.level import COLUMNS, ROWS, Level


@dataclass(frozen=True)
class AsciiLevel:
    """The content of a level's file: author, comment, tiles and objects, its lesson, its messages."""

    name: str
    author: str
    comment: str
    level: Level
    teaches: str = ""  #: the header ``teaches``: the lesson of the level
    says: str = ""  #: the header ``says``: its messages


def is_ascii_level(text: str) -> bool:
    """Whether a text begins like an ASCII level, or nearly so (after blank and comment lines)."""
    _, first = next(numbered_lines(text, UNCOMMENTED), (1, ""))
    return "".join(filter(str.isalpha, first[:80].lower())).startswith("ninjagamelevel")


def parse_ascii_level(text: str, *, file: str = "") -> AsciiLevel:
    r"""The level that a text in our ASCII format describes.

    >>> rows = "\n".join(["|" + "." * 31 + "|"] * 22 + ["|@" + "." * 30 + "|"])
    >>> read = parse_ascii_level("ninja-game level 1\nname: Tiny\n" + rows)
    >>> read.name, read.level.objects
    ('Tiny', (ObjectSpec(kind=5, values=(36.0, 564.0), text=''),))

    Raises LevelError with the first mistake by line, and the others in its ``further``.
    """
    problems = Problems(file)
    lines = list(numbered_lines(text, UNCOMMENTED))
    _check_first(lines, problems)
    header, rows, listed = sections(lines[1:], problems)
    fields = _read_header(header, problems)
    last = rows[-1][0] if rows else lines[-1][0]
    picture = read_picture(rows, last + 1, problems)
    objects, tiles = _read_list(listed, problems)
    problems.raise_if_any()
    assert picture is not None  # noqa: S101 - a broken picture has been raised as a problem
    level = merge_picture_and_list(picture, objects, tiles, problems)
    problems.raise_if_any()
    return AsciiLevel(**dict.fromkeys(HEADER_KEYS, "") | fields, level=level)


def room_level(room: Sequence[str], objects: Sequence[str]) -> Level:
    """A level with a room's rows in its upper left corner; all the rest is solid."""
    rows = [row.ljust(COLUMNS, "#") for row in room]
    rows += ["#" * COLUMNS] * (ROWS - len(rows))
    picture = "\n".join(f"|{row}|" for row in rows)
    return parse_ascii_level(f"ninja-game level 1\n{picture}\n" + "\n".join(objects) + "\n").level


def _check_first(lines: Sequence[Line], problems: Problems) -> None:
    number, first = lines[0] if lines else (1, "")
    words = first.split()
    expected = f"'{ASCII_MAGIC} {ASCII_VERSION}' in the first line"
    if words[:2] != ASCII_MAGIC.split() or len(words) != 3:
        problems.add("not an ASCII level", number, 1, found=quoted(first), expected=expected)
    elif words[2] != str(ASCII_VERSION):
        hint = "a level for a newer ninja-game needs a newer ninja-game"
        problems.add(
            "unknown version of the level format", number, found=words[2], expected=str(ASCII_VERSION), hint=hint
        )
    problems.raise_if_any()


def sections(lines: Sequence[Line], problems: Problems) -> tuple[list[Line], list[Line], list[Line]]:
    """Separate header lines, picture rows and lines of the list; ``lines``: those after the first, without comments."""
    header: list[Line] = []
    rows: list[Line] = []
    listed: list[Line] = []
    for number, line in lines:
        if ROW_START.match(line) or (":" not in line and ROW_END.search(line)):
            if listed:
                hint = "the picture is one block; the list of objects stands below it"
                problems.add("a picture row below the list", number, found=quoted(line.strip()), hint=hint)
                break
            rows.append((number, line))
        else:
            (listed if rows else header).append((number, line))
    return header, rows, listed


def _read_header(lines: Sequence[Line], problems: Problems) -> dict[str, str]:
    fields: dict[str, str] = {}
    for number, line in lines:
        if problems.full:
            break
        key, colon, value = line.partition(":")
        key = key.strip()
        if not colon:
            expected = "key: value, or the first row of the picture, |...|"
            is_comment = line.lstrip().startswith(("#", "//"))
            hint = "comments begin with ;" if is_comment else "objects are listed below the picture"
            problems.add("not a header line", number, 1, found=quoted(line.strip()), expected=expected, hint=hint)
        elif key not in HEADER_KEYS:
            problems.add("unknown header", number, 1, found=quoted(key), hint=suggestion(key, HEADER_KEYS))
        elif key in fields:
            problems.add("a header given twice", number, 1, found=quoted(key), hint="keep one")
        else:
            value = value.strip()
            text = read_quoted(value) if value.startswith('"') else None
            fields[key] = value if text is None else text
            if len(fields[key]) > MAX_NAME and key not in {"comment", "says"}:
                what = f"a text of {len(fields[key]):,} characters"
                problems.add(what, number, found=quoted(fields[key]), expected=f"at most {MAX_NAME:,}")
            elif key == "says":
                try:
                    parse_messages(fields[key])
                except LevelError as error:
                    problems.add_error(error, number)
    return fields


def _read_list(lines: Sequence[Line], problems: Problems) -> tuple[list[ListedObject], list[OddTile]]:
    objects: list[ListedObject] = []
    tiles: list[OddTile] = []
    for number, line in lines:
        if problems.full:
            break
        try:
            entries = read_object_line(line)
        except LevelError as error:
            problems.add_error(error, number)
            continue
        for entry in entries:
            if isinstance(entry, OddTile):
                tiles.append(entry._replace(line=number))
            else:
                objects.append(entry._replace(line=number))
    return objects, tiles
