"""Level files and replay texts: ``$name#author#comment#level string#``, perhaps with a demo before the last ``#``.

Published files break these rules in many ways (game.md §5.4-§5.6); this reader accepts them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from urllib.parse import unquote

from ninja_game.errors import LevelError
from ninja_game.formats.lines import MAX_NAME
from ninja_game.formats.n14.level_string import tidy_level_string
from ninja_game.sim.level import TILES

MARKER = "&userdata="
"""Comes before the data of the game's own level file; the data is URL-encoded and ends at the next ``&``."""

_SHAPE = "$name#author#comment#level string#"  # the form of a record, for error messages

_SEPARATOR, _ENCODED_SEPARATOR = re.compile(r"\$"), re.compile(r"\$|%24")
_ENCODING = str.maketrans({"%": "%25", "&": "%26", "+": "%2B"})
_LINE_BREAK = re.compile(r"[\r\n]+")

# A demo after a level, not free text: numbers and separators with a colon, or a legacy demo.
_DEMO = re.compile(r"(?=[.+\-eE]*[0-9])[0-9.+\-eE]*:[0-9.+\-eE|:]*")
_LEGACY_DEMO = re.compile(r'A["%-\[\]-b\x67-\x96]{2,}')
# A demo in the place of the level: its numbers must be short, since digits and colons may also be tiles.
_SHORT_DEMO = re.compile(r"[0-9.]{1,12}:[0-9\-]{0,14}(?:\|[0-9\-]{0,14})*")

# After white space, this can still be the wrapped rest of data without a closing '#'.
_DEMO_PIECE = re.compile(r"[0-9|\-]+")
_OBJECTS_PIECE = re.compile(r"[0-9.,^!\-Na]+")


@dataclass(frozen=True)
class LevelRecord:
    """One record of a level file or replay text.

    ``level``: the in-game string, wrapped lines joined, '' if the record omits it; ``demo``: the demo text, or '';
    ``note``: a text in the place of the demo that is not one; ``number``: from 0; ``line``: its first one, from 1.
    """

    name: str
    author: str
    comment: str
    level: str
    demo: str = ""
    number: int = 0
    line: int = 0
    note: str = ""


def is_demo(text: str) -> bool:
    """Whether a text without white space is a demo, not free text."""
    return bool(_DEMO.fullmatch(text) or _LEGACY_DEMO.fullmatch(text))


def read_level_file(text: str, *, file: str = "") -> list[LevelRecord]:
    """Read the records of a level file or replay text, in order.

    Common errors of published files are accepted: text before the first ``$``, free text after a record, no closing
    ``#``, lines wrapped inside data, no names, no level. After a ``&userdata=`` marker, and only there, the text is
    URL-decoded (``%xx``, ``+``) and ends at ``&``.

    Raises LevelError, naming the line, for a record without its fields or its level, and for a text without records.
    """
    records: list[LevelRecord] = []
    for line, part in _parts(text):
        record = _read_record(part, len(records), line, file)
        if record:
            records.append(record)
    if not records:
        raise LevelError("no level record", file=file, found=repr(text[:40]), expected=_SHAPE)
    return records


def _parts(text: str) -> Iterator[tuple[int, str]]:
    """Line and text of everything after a ``$``, decoded."""
    free, marker, data = text.partition(MARKER)
    if not marker:
        free, data = "", text
    line = 1 + free.count("\n")
    pieces = (_ENCODED_SEPARATOR.split(data.partition("&")[0])) if marker else _SEPARATOR.split(data)
    # Copying may have lost the '$' of a replay text.
    lacks_dollar = len(pieces) == 1 and pieces[0].lstrip().startswith("#")
    for index, piece in enumerate(pieces):
        if index or lacks_dollar:
            yield line, _url_decoded(piece) if marker else piece
        line += piece.count("\n")


def _url_decoded(text: str) -> str:
    """Decode ``+`` to blanks and ``%xx`` to characters: UTF-8, or Latin-1 if it is not valid UTF-8."""
    text = text.replace("+", " ")
    try:
        return unquote(text, errors="strict")
    except UnicodeDecodeError:
        return unquote(text, encoding="latin-1")


def _read_record(part: str, number: int, line: int, file: str) -> LevelRecord | None:
    """The record in the text after a ``$``; None for a ``$`` in free text."""
    fields = part.split("#")
    last = len(fields) - 1
    place, demo = _find_demo(fields)
    if last < 3 and not demo:
        if "|" not in part:
            return None
        what, hint = f"record {number} has only {last + 1} fields", "an empty field still needs its '#'"
        raise LevelError(what, file, line, 0, repr(part[:40]), _SHAPE, hint)
    level = _level_text(fields[3], closed=last > 3) if not demo or place == 4 else ""
    if not level and not demo:
        raise LevelError(f"record {number} has no level string", file=file, line=line, expected=_SHAPE)
    words = (" ".join(map(str.strip, _LINE_BREAK.split(field))).strip() for field in [*fields, "", "", ""][:3])
    name, author, comment = words
    if (longest := max(len(name), len(author))) > MAX_NAME:
        what = f"record {number} has a name of {longest:,} characters"
        raise LevelError(what, file=file, line=line, expected=f"at most {MAX_NAME:,}")
    if place == 2:
        comment = ""
    note = fields[4].strip() if last >= 4 and not demo else ""
    return LevelRecord(name, author, comment, level, demo, number, line, note)


def _find_demo(fields: list[str]) -> tuple[int, str]:
    """The number of the field with the demo, and its text; (0, '') without one.

    It is field 4 in a complete record, 3 or 2 in a record without a level.
    """
    for place in (4, 3, 2):
        if place >= len(fields):
            continue
        is_closed = place < len(fields) - 1
        text = "".join(fields[place].split()) if is_closed else _wrapped_demo(fields[place])
        is_short = _SHORT_DEMO.fullmatch(text) is not None
        is_bare = not fields[0].strip() and not fields[1].strip() and "|" not in "".join(fields[3:])
        # Free text such as AWESOME could look like a legacy demo.
        is_demo_text = is_demo(text) and (is_closed or not text.startswith("A"))
        if is_demo_text if place == 4 else is_short and (place == 3 or is_bare):
            return place, text
    return 0, ""


def _wrapped_demo(text: str) -> str:
    """The demo at the start of a field; free text may follow it."""
    first, *others = text.split() or [""]
    for piece in others:
        if not _DEMO_PIECE.fullmatch(piece):
            break
        first += piece
    return first


def _level_text(text: str, *, closed: bool) -> str:
    """The level string in a field, without the white space of wrapped lines.

    Without a closing ``#`` free text may follow. Then the level ends at the first white space (game.md §5.4), unless
    tiles are still missing or the rest can only be objects.
    """
    if closed:
        return tidy_level_string(text)
    first, *others = text.split() or [""]
    for piece in others:
        in_tiles = len(first) < TILES and "|" not in first
        in_objects = _OBJECTS_PIECE.fullmatch(piece) and (first[-1] in "|!^," or any(char in piece for char in "!^,"))
        if not in_tiles and not in_objects:
            break
        first += piece
    return first


def write_level_file(records: Iterable[LevelRecord], *, userdata: bool = False) -> str:
    """Write records as text, one per line; ``userdata``: in the form that the game itself reads (marker, URL-encoded).

    Raises LevelError for data that such a text cannot contain: ``#``, ``$`` or a line break in a field, white space in
    a level.
    """
    lines = []
    for number, record in enumerate(records):
        _check_record(record, number, userdata=userdata)
        fields = [record.name, record.author, record.comment, record.level]
        line = "$" + "#".join([*fields, record.demo] if record.demo else fields) + "#"
        lines.append(line.translate(_ENCODING) if userdata else line)
    return (MARKER if userdata else "") + "\n".join(lines) + "\n"


def _check_record(record: LevelRecord, number: int, *, userdata: bool) -> None:
    """Raise LevelError if the record would not read back the same."""
    words = {"name": record.name, "author": record.author, "comment": record.comment}
    for field, text in (words | {"level": record.level, "demo": record.demo}).items():
        for char in "#$\r\n":
            if char in text:
                hint = f"take {char!r} out of the {field}"
                raise LevelError(f"the {field} of record {number} does not fit", found=repr(text[:40]), hint=hint)
        if not userdata and MARKER in text:
            raise LevelError(f"the {field} of record {number} does not fit", found=MARKER)
    if not record.level and not record.demo:
        raise LevelError(f"record {number} has no level string", expected=_SHAPE)
    if tidy_level_string(record.level) != record.level:
        raise LevelError(f"the level of record {number} holds white space, which a level file cannot keep")
    if record.demo and not is_demo(record.demo):
        found = repr(record.demo[:40])
        raise LevelError(f"the demo of record {number} is not a demo", found=found, expected="length:word|word|…")
