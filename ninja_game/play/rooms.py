"""Small rooms and what is played in them, as texts: of the help's pages and of the lab's figures."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bits
from ninja_game.sim.level import COLUMNS, ROWS, Level

KEY_BITS = {"l": KEY_LEFT, "r": KEY_RIGHT, "j": JUMP_HELD}

_STROKE = re.compile(r"([lrj]*)([0-9]+)")


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
