"""Small rooms as texts, for the help's pages and the lab's figures."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.sim.level import COLUMNS, ROWS, Level


def room_level(room: Sequence[str], objects: Sequence[str]) -> Level:
    """A level with a room's rows in its upper left corner; all the rest is solid."""
    rows = [row.ljust(COLUMNS, "#") for row in room]
    rows += ["#" * COLUMNS] * (ROWS - len(rows))
    picture = "\n".join(f"|{row}|" for row in rows)
    return parse_ascii_level(f"ninja-game level 1\n{picture}\n" + "\n".join(objects) + "\n").level
