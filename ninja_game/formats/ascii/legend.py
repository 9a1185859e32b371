"""The legend of the ASCII level format: one character for each tile shape and each object that can be drawn.

The tables here define the format; `docs/level-format.md` shows them as pictures. Every character has one meaning only.
"""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

from ninja_game.sim import kinds
from ninja_game.sim.level import COLUMNS, ROWS, ObjectSpec, well_formed
from ninja_game.sim.rules import CELL, HALF

TILE_CHARS = ".#" + "aswq" + "jkiu" + "JKIU" + "dfre" + "DFRE" + "ghyt" + "GHYT" + '_]"['
"""Character of tile id 0…33 (world.md §2.1).

A slope or curve is a key of a 2 x 2 block of the keyboard; the key's place in the block is that of the solid corner.
Within a family, ids are ordered bottom left, bottom right, top right, top left.
"""

ODD_TILE = "?"  # stands for a tile id outside 0…33; a tile line gives the id

TILE_OF_CHAR = {char: number for number, char in enumerate(TILE_CHARS)} | {" ": 0}
"""Tile id of a picture character; a blank is empty, like a dot."""

TILE_FAMILIES = (
    ("45° slope", "qwas"),
    ("22° slope, thin end", "erdf"),
    ("22° slope, thick end", "ERDF"),
    ("67° slope, thin end", "tygh"),
    ("67° slope, thick end", "TYGH"),
    ("concave curve (hollow)", "uijk"),
    ("convex curve (round)", "UIJK"),
)
"""Families of slopes: name, then the characters with the solid corner top left, top right, bottom left, bottom
right."""

_RIGHT, _DOWN, _LEFT, _UP = 0.0, 1.0, 2.0, 3.0
DIRECTION_WORDS = {"right": _RIGHT, "down": _DOWN, "left": _LEFT, "up": _UP}
"""Direction numbers of the N records (objects.md §1)."""

WEAPONS = {"zap drone": 0.0, "laser drone": 1.0, "chaingun drone": 2.0}  # weapon numbers of drones (objects.md §5)

DIAGONAL = 0.7071067811865468  # what a diagonal pad's 0.707106781186547 loads as (game.md §5.2)

PAD_NORMALS = {
    "up": (0.0, -1.0),
    "up-right": (DIAGONAL, -DIAGONAL),
    "right": (1.0, 0.0),
    "down-right": (DIAGONAL, DIAGONAL),
    "down": (0.0, 1.0),
    "down-left": (-DIAGONAL, DIAGONAL),
    "left": (-1.0, 0.0),
    "up-left": (-DIAGONAL, -DIAGONAL),
}
"""Normal of a launch pad for each direction word."""

PAD_DIGITS = dict(zip(PAD_NORMALS, "89632147", strict=True))
"""A pad is drawn as the digit in its direction on the numeric keypad."""


class Symbol(NamedTuple):
    """A character that draws an object: its meaning, and the place of the object in its cell.

    ``dx``, ``dy``: px from the cell's centre. ``values``: the values after x and y in the record of an object that
    needs no line in the list, None if it needs one.
    """

    char: str
    name: str
    kind: int
    dx: float = 0.0
    dy: float = 0.0
    values: tuple[float, ...] | None = ()


def _pad(word: str) -> Symbol:
    # A straight pad lies on the side of the cell that it pushes away from; a diagonal pad crosses the middle, like the
    # surface of a 45° tile.
    a, b = PAD_NORMALS[word]
    dx, dy = (0.0, 0.0) if a and b else (0.0 - 12.0 * a, 0.0 - 12.0 * b)
    return Symbol(PAD_DIGITS[word], f"launch pad {word}", kinds.LAUNCH_PAD, dx, dy, (a, b))


SYMBOLS = (
    Symbol("@", "ninja", kinds.NINJA),
    Symbol("X", "exit", kinds.EXIT),
    Symbol("x", "exit switch", kinds.EXIT),
    Symbol("o", "gold", kinds.GOLD),
    Symbol("*", "mine", kinds.MINE),
    Symbol("B", "bounce block", kinds.BOUNCE_BLOCK),
    Symbol("^", "one-way up", kinds.ONE_WAY, values=(_UP,)),
    Symbol("v", "one-way down", kinds.ONE_WAY, values=(_DOWN,)),
    Symbol("<", "one-way left", kinds.ONE_WAY, values=(_LEFT,)),
    Symbol(">", "one-way right", kinds.ONE_WAY, values=(_RIGHT,)),
    *(_pad(word) for word in PAD_NORMALS),
    Symbol("5", "launch pad, other normal", kinds.LAUNCH_PAD, values=None),
    Symbol("M", "thwump up", kinds.THWUMP, values=(_UP,)),
    Symbol("W", "thwump down", kinds.THWUMP, values=(_DOWN,)),
    Symbol("{", "thwump left", kinds.THWUMP, values=(_LEFT,)),
    Symbol("}", "thwump right", kinds.THWUMP, values=(_RIGHT,)),
    Symbol("n", "floor guard", kinds.FLOOR_GUARD, 0.0, 6.0, (1.0,)),
    Symbol("+", "gauss turret", kinds.TURRET),
    Symbol("Q", "homing launcher", kinds.LAUNCHER),
    Symbol("Z", "zap drone", kinds.DRONE, values=None),
    Symbol("L", "laser drone", kinds.DRONE, values=None),
    Symbol("C", "chaingun drone", kinds.DRONE, values=None),
    Symbol("&", "locked door switch", kinds.DOOR, values=None),
    Symbol("!", "trap door switch", kinds.DOOR, values=None),
)
"""Every character that draws an object, in the order of the legend."""

SYMBOL_OF_CHAR = {symbol.char: symbol for symbol in SYMBOLS}
SYMBOL_OF_NAME = {symbol.name: symbol for symbol in SYMBOLS}

_KINDS_OF_ONE = {kind for kind, count in Counter(symbol.kind for symbol in SYMBOLS).items() if count == 1}
_SINGLE = {symbol.kind: symbol.char for symbol in SYMBOLS if symbol.kind in _KINDS_OF_ONE}
_DRONES = {weapon: SYMBOL_OF_NAME[name].char for name, weapon in WEAPONS.items()}
_FACING = {
    kind: {symbol.values[0]: symbol.char for symbol in SYMBOLS if symbol.kind == kind and symbol.values}
    for kind in (kinds.ONE_WAY, kinds.THWUMP)
}
_PADS = {symbol.values: symbol.char for symbol in SYMBOLS if symbol.kind == kinds.LAUNCH_PAD and symbol.values}


class PlacedCharacter(NamedTuple):
    """A character of an object in the picture, and its cell (column 1…31, row 1…23)."""

    char: str
    column: int
    row: int


def symbol_chars(spec: ObjectSpec) -> tuple[tuple[str, float, float], ...]:
    """The characters that could draw an object, each with its point in px; empty if nothing can draw it."""
    kind, values = spec.kind, spec.values
    if not well_formed(spec):
        return ()
    x, y = values[:2]
    if kind == kinds.EXIT:
        return ("X", x, y), ("x", values[2], values[3])
    if kind == kinds.DOOR:
        return (("&", x, y),) if values[6] == 1 else (("!", x, y),) if values[3] == 1 else ()
    if kind == kinds.LAUNCH_PAD:
        return ((_PADS.get(values[2:], "5"), x, y),)
    if kind == kinds.DRONE:
        char = _DRONES.get(values[4], "")
    elif kind in _FACING:
        char = _FACING[kind].get(values[2], "")
    else:
        char = _SINGLE[kind]
    return ((char, x, y),) if char else ()


def visible_glyphs(spec: ObjectSpec) -> list[PlacedCharacter]:
    """The characters of an object in the picture: only for the parts that are exactly where a character puts them."""
    parts = []
    for char, x, y in symbol_chars(spec):
        symbol = SYMBOL_OF_CHAR[char]
        column, row = (x - symbol.dx - HALF) / CELL, (y - symbol.dy - HALF) / CELL
        if column.is_integer() and row.is_integer() and 1 <= column <= COLUMNS and 1 <= row <= ROWS:
            parts.append(PlacedCharacter(char, int(column), int(row)))
    return parts


def legend_text() -> str:
    """The whole legend as comment lines, for the end of a level file."""
    lines = ['; LEGEND   . empty   # full   halves: _ lower  " upper  [ left  ] right']
    lines.append("; Slopes are 2 x 2 blocks of keys; the key's place in its block is the solid corner:")
    for name, chars in TILE_FAMILIES:
        lines.append(f";   {chars[0]} {chars[1]} / {chars[2]} {chars[3]}   {name}")
    for title, needs_line in (("Objects:", False), ("Objects that also need a line below the picture:", True)):
        lines.append(f"; {title}")
        cells = [f"{symbol.char} {symbol.name}" for symbol in SYMBOLS if (symbol.values is None) is needs_line]
        width = max(map(len, cells)) + 2
        rows = (cells[start : start + 4] for start in range(0, len(cells), 4))
        lines.extend(";   " + "".join(cell.ljust(width) for cell in row).rstrip() for row in rows)
    return "\n".join(lines) + "\n"
