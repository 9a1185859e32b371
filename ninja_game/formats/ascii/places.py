"""Places and numbers in the list of an ASCII level: cells ``5,7``, half cells ``5.5,7``, exact px ``60,564px``."""

from __future__ import annotations

import math
import re
import struct

from ninja_game.errors import LevelError
from ninja_game.sim.grid import Cell
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import CELL, HALF

_NUMBER = re.compile(r"[+-]?(\d++(\.\d*+)?|\.\d++)(e[+-]?\d++)?|nan|[+-]?inf", re.ASCII)
_MAX_SHOWN = 40

READING_ORDER: list[Cell] = [(column, row) for row in range(1, ROWS + 1) for column in range(1, COLUMNS + 1)]
"""All cells of a level, row by row."""


def quoted(text: str) -> str:
    """A word of the file in quotes, truncated if it is long."""
    return repr(text if len(text) <= _MAX_SHOWN else f"{text[:_MAX_SHOWN]}...")


def same_bits(a: float, b: float) -> bool:
    """Whether two float64 are equal to the last bit: -0.0 differs from 0.0; all NaNs are equal."""
    return struct.pack("<d", a) == struct.pack("<d", b) or (math.isnan(a) and math.isnan(b))


def number_text(value: float) -> str:
    """The shortest decimal that reads as exactly this float64; ``nan``, ``inf``, ``-inf``, ``-0`` for such values."""
    return repr(value).removesuffix(".0")


def read_number(text: str) -> float:
    """Read a decimal as the nearest float64.

    It is rounded correctly, as in any programming language; only the N strings follow Flash's rule.

    Raises LevelError (without a place) for anything else.
    """
    if _NUMBER.fullmatch(text) is None:
        raise LevelError("not a number", found=quoted(text), expected="a decimal such as 12, -0.5 or 408.15")
    value = float(text)
    if math.isinf(value) and "inf" not in text:
        raise LevelError("number too large", found=quoted(text), hint="write inf if you mean infinity")
    return value


def _cell_number(value: float, count: int) -> str:
    """Cell coordinate of a px coordinate if a multiple of 1/4 from 0 to the far border gives it exactly, else ''."""
    cell = (value - HALF) / CELL
    if not 0 <= cell <= count + 1 or cell * 4 != int(cell * 4) or not same_bits(cell * CELL + HALF, value):
        return ""
    return number_text(cell)


def place_text(x: float, y: float, dx: float = 0.0, dy: float = 0.0) -> str:
    """The shortest exact notation of a px point; ``dx``, ``dy``: offset of its kind of object from a cell's middle."""
    column, row = _cell_number(x - dx, COLUMNS), _cell_number(y - dy, ROWS)
    # The subtraction rounds odd values: write a point in cells only if reading it gives the same bits.
    if column and row and all(map(same_bits, read_place(f"{column},{row}", dx, dy), (x, y))):
        return f"{column},{row}"
    return f"{number_text(x)},{number_text(y)}px"


def read_place(text: str, dx: float = 0.0, dy: float = 0.0) -> tuple[float, float]:
    """Read ``5,7`` (cells, quarters allowed) or ``60,564px`` as a px point. Raises LevelError (without a place)."""
    px = text.endswith("px")
    numbers = text.removesuffix("px").split(",")
    if len(numbers) != 2 or "" in numbers:
        raise LevelError(
            "not a place",
            found=quoted(text),
            expected="column,row such as 5,7 (or 5.5,7), or exact px such as 60,564px",
        )
    x, y = map(read_number, numbers)
    if px:
        return x, y
    for value, count, what in ((x, COLUMNS, "column"), (y, ROWS, "row")):
        found, hint = number_text(value), "if it is meant to be px, write px after it, as in 60,564px"
        if not 0 <= value <= count + 1:
            expected = f"1 to {count} (0 and {count + 1} are the border)"
            raise LevelError(f"{what} outside the grid", found=found, expected=expected, hint=hint)
        if value * 4 != int(value * 4):
            expected, hint = "steps of 0.25 (6 px)", "write finer positions in px, as in 60,564px"
            raise LevelError(f"{what} between the quarter cells", found=found, expected=expected, hint=hint)
    return x * CELL + HALF + dx, y * CELL + HALF + dy


def read_cell(text: str) -> Cell:
    """Read column and row of a whole cell (0…32, 0…24). Raises LevelError (without a place)."""
    x, y = read_place(text)
    column, row = (x - HALF) / CELL, (y - HALF) / CELL
    if text.endswith("px") or not (column.is_integer() and row.is_integer()):
        raise LevelError("not a whole cell", found=quoted(text), expected="column,row such as 20,14")
    return int(column), int(row)
