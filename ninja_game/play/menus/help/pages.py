"""The help's pages: texts, and small rooms with what is played in them (``assets/help/pages.toml``)."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ninja_game.errors import LevelError
from ninja_game.files.resources import data_folder
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bits
from ninja_game.sim.level import COLUMNS, ROWS, Level

PAGES_FILE = "help/pages.toml"

KEY_BITS = {"l": KEY_LEFT, "r": KEY_RIGHT, "j": JUMP_HELD}

_STROKE = re.compile(r"([lrj]*)([0-9]+)")


@dataclass(frozen=True)
class Page:
    """A page of the help. ``inputs``: one byte per tick; ``shows``: names of events that must happen in it."""

    title: str
    text: tuple[str, ...]
    level: Level
    inputs: bytes
    shows: tuple[str, ...]


def read_pages(path: Path | None = None) -> list[Page]:
    """The pages of the bundled file, or of another. Raises LevelError naming the page that is wrong."""
    path = path or data_folder("assets") / PAGES_FILE
    tables = tomllib.loads(path.read_text("utf-8"))["page"]
    return [_page(table, str(path)) for table in tables]


def _page(table: dict[str, object], file: str) -> Page:
    title = str(table["title"])
    room = str(table["room"]).strip("\n").split("\n")
    objects = table.get("objects", [])
    assert isinstance(objects, list)  # noqa: S101 - our own file, read by a test
    try:
        level = room_level(room, objects)
    except LevelError as error:
        raise LevelError(f"the page {title!r}: {error}", file) from error
    text, shows = table["text"], table["shows"]
    assert isinstance(text, list)  # noqa: S101 - as above
    assert isinstance(shows, list)  # noqa: S101 - as above
    return Page(title, tuple(text), level, strokes(str(table["keys"])), tuple(shows))


def room_level(room: Sequence[str], objects: Sequence[str]) -> Level:
    """A level with the rows of a room in its upper left corner and solid all around."""
    rows = [row.ljust(COLUMNS, "#") for row in room]
    rows += ["#" * COLUMNS] * (ROWS - len(rows))
    picture = "\n".join(f"|{row}|" for row in rows)
    return parse_ascii_level(f"ninja-game level 1\n{picture}\n" + "\n".join(objects) + "\n").level


def strokes(text: str) -> bytes:
    r"""The inputs that key strokes mean: letters and how many ticks they are held.

    >>> strokes("r2 rj2 1")
    b'\x02\x02\x0e\x06\x00'
    """
    inputs = bytearray()
    for stroke in text.split():
        match = _STROKE.fullmatch(stroke)
        if match is None:
            raise LevelError("not a key stroke", found=repr(stroke), expected="letters of lrj and a number of ticks")
        inputs += bytes([sum(KEY_BITS[letter] for letter in match[1])]) * int(match[2])
    return with_press_bits(inputs)
