"""N's level string ``<tiles>|<objects>``, read exactly as N reads it (game.md §5.1-§5.3)."""

from __future__ import annotations

import re
from collections.abc import Callable

from ninja_game.errors import LevelError
from ninja_game.formats.numbers import format_exact, format_number, parse_flash_number
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import TILES, Level, ObjectSpec

MISSING_TILE = -1  # id of a cell beyond the end of the tile string: never solid, yet not empty

_NO_TILE = frozenset([ord("|"), *range(0xD800, 0xE000)])  # the separator; halves of surrogate pairs

_LINE_BREAK = re.compile(r"[\r\n]+")

_KINDS = len(KIND_NAMES)
_PLAIN_TILES = re.compile(r"[0-Q]{713}")
_TILE_OF_CHAR = bytes(max(code - 48, 0) for code in range(256))
_KIND_OF_TEXT = {str(kind): kind for kind in range(_KINDS)}


def parse_level_string(text: str, *, file: str = "", line: int = 0) -> Level:
    """Read ``text``, however malformed, as the game does (game.md §5.2); white space is not ignored.

    Raises LevelError only for a text that starts with ``$`` and has no fourth field; ``file`` and ``line`` are the
    text's place for errors.

    >>> level = parse_level_string("01|5^36,36!0^60,36")
    >>> level.tiles[:3], level.objects
    ((0, 1, -1), (ObjectSpec(kind=5, values=(36.0, 36.0), text=''), ObjectSpec(kind=0, values=(60.0, 36.0), text='')))
    """
    if text.startswith("$"):
        fields = text.split("#")
        if len(fields) < 4:
            what = "a text that starts with '$' must have the level string in its fourth field"
            raise LevelError(what, file, line, 0, f"only {len(fields)} of them", "$name#author#comment#level string#")
        text = fields[3]
    tiles, _, rest = text.partition("|")
    objects = rest.partition("|")[0]
    return Level(_parse_tiles(tiles), tuple(map(_parse_object, objects.split("!"))) if objects else ())


def tidy_level_string(text: str) -> str:
    """Remove the white space of wrapped lines, as a tolerant importer does (game.md §5.6).

    It removes all white space among the tiles, and line breaks with the blanks around them among the objects. Other
    blanks stay there: before a number they are harmless, after one the game reads NaN, and so does this program.
    """
    tiles, bar, objects = text.partition("|")
    return "".join(tiles.split()) + bar + "".join(line.strip() for line in _LINE_BREAK.split(objects))


def _parse_tiles(text: str) -> tuple[int, ...]:
    """713 tile ids; cells beyond the text are missing tiles, text beyond the cells is ignored."""
    text = text[:TILES]
    if _PLAIN_TILES.fullmatch(text):
        return tuple(text.encode("ascii").translate(_TILE_OF_CHAR))
    return tuple(ord(char) - 48 for char in text) + (MISSING_TILE,) * (TILES - len(text))


def _parse_object(text: str) -> ObjectSpec:
    """Read one object record: the type is before the first ``^``, the values between it and the second."""
    kind_text, caret, rest = text.partition("^")
    kind = _KIND_OF_TEXT.get(kind_text, -1)
    if kind < 0:
        number = parse_flash_number(kind_text)
        if number not in range(_KINDS):
            return ObjectSpec(-1, (), text)
        kind = int(number)
    if not caret:
        return ObjectSpec(kind, ())
    return ObjectSpec(kind, tuple(map(parse_flash_number, rest.partition("^")[0].split(","))))


def write_level_string(level: Level, *, exact: bool = False) -> str:
    """Write the level as in-game string (game.md §5.3).

    ``exact``: write numbers with as many digits as the same float64 needs, instead of the game's 15 digits. Levels read
    from texts with at most 15 digits per number are the same either way.

    Raises LevelError for a tile id without a character, and for a stray separator in an ignored record.
    """
    number = format_exact if exact else format_number
    text = _write_tiles(level.tiles) + "|" + "!".join(_write_object(spec, number) for spec in level.objects)
    if text.startswith("$"):
        raise LevelError("a level string cannot start with '$'", found="tile id -12 in the first cell")
    return text


def _write_tiles(tiles: tuple[int, ...]) -> str:
    if len(tiles) != TILES:
        raise LevelError("wrong number of tiles", found=str(len(tiles)), expected=f"{TILES} (31 columns of 23)")
    for cell, tile in enumerate(tiles):
        if not 0 <= tile + 48 < 0x110000 or tile + 48 in _NO_TILE:
            place = f"tile id {tile} in column {cell // 23 + 1}, row {cell % 23 + 1}"
            raise LevelError("a tile that no level string can hold", found=place, expected="an id of 0 to 33")
    return "".join(chr(tile + 48) for tile in tiles)


def _write_object(spec: ObjectSpec, number: Callable[[float], str]) -> str:
    """``type^value,value,…``; only the type without values; the original text of an ignored record."""
    if spec.kind < 0:
        if "!" in spec.text or "|" in spec.text:
            raise LevelError("an ignored record cannot hold '!' or '|'", found=repr(spec.text))
        return spec.text
    values = ",".join(map(number, spec.values))
    return f"{spec.kind}^{values}" if spec.values else str(spec.kind)


def level_digest(level: Level) -> str:
    """The level's sha256, as 64 hex digits, over tile ids and records with values to the last bit.

    Records that create nothing and the sign of a zero do not count.
    """
    return level.digest
