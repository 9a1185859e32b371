"""The kinds of line in the list of an ASCII level: what each needs, and the record values it stands for.

One table serves both directions: `object_lines` reads and writes by it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS, SYMBOL_OF_NAME
from ninja_game.formats.ascii.places import read_cell, read_number, read_place, shown
from ninja_game.sim.kinds import DOOR, DRONE, EXIT, FLOOR_GUARD, KINDS, LAUNCH_PAD, ONE_WAY, THWUMP

T = TypeVar("T")

MOVEMENTS = {
    "surface-cw": 0.0,
    "surface-ccw": 1.0,
    "wander-cw": 2.0,
    "wander-ccw": 3.0,
    "alternating": 4.0,
    "random": 5.0,
}
"""Movement numbers of drones (objects.md §5)."""

SIDES = {"right": (0.0, 0.0, 0.0), "bottom": (1.0, 0.0, 0.0), "left": (0.0, -1.0, 0.0), "top": (1.0, 0.0, -1.0)}
"""Side of a door's cell: vertical flag, column offset, row offset (objects.md §8.6)."""

WEAPONS = {"zap drone": 0.0, "laser drone": 1.0, "chaingun drone": 2.0}
DOORS = {"automatic door": (0.0, 0.0), "locked door": (0.0, 1.0), "trap door": (1.0, 0.0)}
"""Trap flag and locked flag of the three sorts of door."""


@dataclass(frozen=True)
class Token:
    """A word of a line and the column where it starts (from 1)."""

    text: str
    column: int


@dataclass(frozen=True)
class Form:
    """One kind of line: ``keyword PLACE… words``.

    ``words``: for each property its vocabulary. ``takes``: keywords followed by a value. ``needs``: of each group of
    properties exactly one must be given; what is in no group is optional. ``single``: one place a line.
    """

    kind: int
    words: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    takes: tuple[str, ...] = ()
    needs: tuple[tuple[str, ...], ...] = ()
    single: bool = False


_DIRECTED = {"direction": DIRECTION_WORDS}
_DRONE = Form(
    DRONE,
    {"movement": MOVEMENTS, "direction": DIRECTION_WORDS, "seeker": {"seeker": 1.0}},
    needs=(("movement",), ("direction",)),
)

FORMS: dict[str, Form] = {
    **{kind.name: Form(kind.number) for kind in KINDS if kind.value_count == 2},
    "floor guard": Form(FLOOR_GUARD, takes=("facing",)),
    "one-way": Form(ONE_WAY, _DIRECTED, needs=(("direction",),)),
    "thwump": Form(THWUMP, _DIRECTED, needs=(("direction",),)),
    "launch pad": Form(LAUNCH_PAD, {"direction": PAD_NORMALS}, ("normal",), (("direction", "normal"),)),
    "zap drone": _DRONE,
    "laser drone": _DRONE,
    "chaingun drone": _DRONE,
    "exit": Form(EXIT, takes=("switch",), needs=(("switch",),), single=True),
    "automatic door": Form(DOOR, {"side": SIDES}, (), (("side",),), single=True),
    "locked door": Form(DOOR, {"side": SIDES}, ("switch",), (("side",), ("switch",)), single=True),
    "trap door": Form(DOOR, {"side": SIDES}, ("switch",), (("side",), ("switch",)), single=True),
}
"""Every keyword that begins a line of an object with a readable form."""


def natural_offset(keyword: str, direction: str = "") -> tuple[float, float]:
    """Where an object given by cell sits from the cell's middle, px: as the picture would place it."""
    symbol = SYMBOL_OF_NAME.get(f"{keyword} {direction}" if direction else keyword)
    return (symbol.dx, symbol.dy) if symbol is not None else (0.0, 0.0)


def door_middle(column: int, row: int, side: str) -> tuple[float, float]:
    """The middle of a cell's side, px: where an automatic door senses the ninja."""
    vertical, i, j = SIDES[side]
    x, y = 24.0 * (column + i) + 12.0, 24.0 * (row + j) + 12.0
    return (x, y + 12.0) if vertical else (x + 12.0, y)


def record_values(keyword: str, place: Token, given: Mapping[str, Token]) -> tuple[float, ...]:
    """The values of the record that a line stands for; ``given``: property or keyword to its word.

    Raises LevelError with the column of the word that cannot be read.
    """
    kind = FORMS[keyword].kind
    if kind == DOOR:
        return _door_values(keyword, place, given)
    direction = given["direction"].text if "direction" in given else ""
    x, y = at_token(place, read_place, *natural_offset(keyword, direction))
    if kind in (ONE_WAY, THWUMP):
        return x, y, DIRECTION_WORDS[direction]
    if kind == DRONE:
        move, seeker = MOVEMENTS[given["movement"].text], float("seeker" in given)
        return x, y, move, seeker, WEAPONS[keyword], DIRECTION_WORDS[direction]
    if kind == LAUNCH_PAD:
        return x, y, *(PAD_NORMALS[direction] if direction else at_token(given["normal"], _read_pair))
    if kind == FLOOR_GUARD:
        return x, y, at_token(given["facing"], read_number) if "facing" in given else 1.0
    if kind == EXIT:
        return x, y, *at_token(given["switch"], read_place)
    return x, y


def _door_values(keyword: str, place: Token, given: Mapping[str, Token]) -> tuple[float, ...]:
    column, row = at_token(place, read_cell)
    side = given["side"].text
    x, y = at_token(given["switch"], read_place) if "switch" in given else door_middle(column, row, side)
    trap, locked = DOORS[keyword]
    vertical, i, j = SIDES[side]
    return x, y, vertical, trap, float(column), float(row), locked, i, j


def _read_pair(text: str) -> tuple[float, float]:
    """Two numbers ``a,b``. Raises LevelError."""
    numbers = text.split(",")
    if len(numbers) != 2:
        raise LevelError("not a pair of numbers", found=shown(text), expected="x,y such as 0.6,-0.8")
    return read_number(numbers[0]), read_number(numbers[1])


def at_token(token: Token, read: Callable[..., T], *offset: float) -> T:
    """What ``read`` makes of a word; an error of its gets the word's column."""
    try:
        return read(token.text, *offset)
    except LevelError as error:
        error.column = token.column
        raise
