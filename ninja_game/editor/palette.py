"""What can be drawn: tiles by family and quarter, types of objects, the keys that choose them, and their places."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from ninja_game.editor.motion import TILE_IDS, Motion
from ninja_game.editor.specs import (
    BODY_PART,
    SWITCH_PART,
    carried,
    has_switch,
    object_type_name,
    points,
    properties,
    settled,
    with_word,
    word,
)
from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.formats.ascii.object_lines import SIDES, ListedObject, natural_offset, read_object_line
from ninja_game.sim import kinds
from ninja_game.sim.grid import Cell, cell_of, middle_of
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL, HALF

SNAPS: dict[str, float] = {"cell": CELL, "half": HALF, "quarter": HALF / 2, "px": 1.0}
"""px between possible places of objects, by name; "cell": in the middle, or where the kind sits in a cell."""

QUARTERS = "qwas"  # keys placed like the solid corner of a tile: upper left, upper right, lower left, lower right


class Family(NamedTuple):
    """Four tiles of one shape. ``key``: its digit, as in Ned (game.md §6); ``tiles``: by quarter."""

    key: str
    tiles: tuple[int, ...]


FAMILIES = tuple(
    Family(str(number), tuple(map(TILE_CHARS.index, chars)))
    for number, chars in enumerate(("qwas", "tygh", "erdf", "uijk", '["_]', "TYGH", "ERDF", "UIJK"), 1)
)
"""The families of tiles. Halves by quarter: left, upper, lower, right."""

EMPTY, FULL = 0, 1
TILE_KEYS = {EMPTY: "0", FULL: "9"}  # the keys of the tiles without a family

_SHAPES = ("45° slope", "hollow curve", "round curve", "22° thin", "22° thick", "67° thin", "67° thick")
_CORNERS = ("lower left", "lower right", "upper right", "upper left")
_TILE_NAMES = (
    "empty", "full tile", *(f"{shape} {corner}" for shape in _SHAPES for corner in _CORNERS),
    "lower half", "right half", "upper half", "left half",
)  # fmt: skip


def tile_name(tile: int) -> str:
    return _TILE_NAMES[tile] if tile in TILE_IDS else f"odd tile {tile}"


class ObjectType(NamedTuple):
    """A type of object in the palette. ``key``: its letter, pressed with Shift; ``line``: its first properties."""

    name: str
    key: str
    line: str

    @property
    def spec(self) -> ObjectSpec:
        listed = read_object_line(self.line)[0]
        assert isinstance(listed, ListedObject)  # noqa: S101 - the table below holds objects only
        return listed.spec


OBJECT_TYPES = tuple(
    ObjectType(name, key, f"{name} {rest}")
    for name, key, rest in (
        ("ninja", "n", "1,1"),
        ("exit", "e", "1,1 switch 1,1"),
        ("gold", "g", "1,1"),
        ("mine", "i", "1,1"),
        ("locked door", "k", "1,1 right switch 1,1"),
        ("trap door", "r", "1,1 right switch 1,1"),
        ("automatic door", "a", "1,1 right"),
        ("one-way", "o", "1,1 up"),
        ("launch pad", "p", "1,1 up"),
        ("bounce block", "b", "1,1"),
        ("thwump", "t", "1,1 down"),
        ("floor guard", "f", "1,1"),
        ("zap drone", "z", "1,1 surface-cw right"),
        ("laser drone", "l", "1,1 alternating right"),
        ("chaingun drone", "c", "1,1 alternating right"),
        ("gauss turret", "u", "1,1"),
        ("homing launcher", "h", "1,1"),
    )
)
"""All objects; each key is a letter of the name, and no command's."""

OBJECT_TYPE_NAMES = tuple(object_type.name for object_type in OBJECT_TYPES)


def object_of_type(name: str) -> ObjectSpec:
    """An object of the type with this name, at the first cell."""
    return OBJECT_TYPES[OBJECT_TYPE_NAMES.index(name)].spec


def object_type_of(spec: ObjectSpec) -> str:
    name = object_type_name(spec)
    return {"one-way platform": "one-way"}.get(name, name)


def snapped(x: float, y: float, snap: str) -> tuple[float, float]:
    """The nearest place of a snap; with "cell" the middle of the cell."""
    step = SNAPS[snap]
    if snap == "cell":
        return middle_of(cell_of(x, y))
    return step * round(x / step), step * round(y / step)


def placed(spec: ObjectSpec, x: float, y: float, snap: str, sides: Collection[str] = SIDES) -> ObjectSpec:
    """The brush's object at a point; doors on the nearest of these ``sides``, () for their own, the switch there.

    Drones sit in the middle of their cell, guards on its floor, whatever the snap.
    """
    px, py = snapped(x, y, snap)
    if spec.kind == kinds.DOOR:
        return _placed_door(spec, x, y, (px, py), sides)
    if spec.kind == kinds.DRONE:
        px, py = snapped(x, y, "cell")
    elif spec.kind == kinds.FLOOR_GUARD:
        py = CELL * cell_of(px, y)[1] + 18.0
    elif snap == "cell":
        direction = word(spec, "direction") if spec.kind == kinds.LAUNCH_PAD else ""
        dx, dy = natural_offset(object_type_of(spec), direction)
        px, py = px + dx, py + dy
    values = (px, py, px, py) if spec.kind == kinds.EXIT else (px, py, *spec.values[2:])
    return spec._replace(values=values)


def _placed_door(spec: ObjectSpec, x: float, y: float, at: tuple[float, float], sides: Collection[str]) -> ObjectSpec:
    column, row = cell_of(x, y)
    right, down = x - CELL * column - HALF, y - CELL * row - HALF
    towards = {"left": -right, "right": right, "top": -down, "bottom": down}
    if sides and ((right, down) != (0.0, 0.0) or word(spec, "side") not in sides):
        spec = with_word(spec, "side", max(sides, key=towards.__getitem__))
    values = (*at, *spec.values[2:4], float(column), float(row), *spec.values[6:])
    return settled(spec._replace(values=values))


def with_switch(spec: ObjectSpec, x: float, y: float, snap: str) -> ObjectSpec:
    px, py = snapped(x, y, snap)
    old = points(spec)[SWITCH_PART] if has_switch(spec) else (px, py)
    return carried(spec, Motion(dx=px - old[0], dy=py - old[1]), (SWITCH_PART,))


def cells_between(a: Cell, b: Cell) -> list[Cell]:
    """The cells of a straight line from one cell to another, both included."""
    steps = max(abs(b[0] - a[0]), abs(b[1] - a[1]), 1)
    return [
        (round(a[0] + (b[0] - a[0]) * k / steps), round(a[1] + (b[1] - a[1]) * k / steps)) for k in range(steps + 1)
    ]


OTHER_KINDS = tuple(kind.name for kind in OBJECT_TYPES if kind.spec.kind not in (kinds.NINJA, kinds.EXIT, kinds.DOOR))
"""Types that an object can become: without single ones, and those with a side or a switch."""


def can_be_remade(spec: ObjectSpec) -> bool:
    return object_type_of(spec) in OTHER_KINDS and BODY_PART in points(spec)


def remade(spec: ObjectSpec, name: str) -> ObjectSpec:
    """An object as one of OTHER_KINDS, with its place, direction and movement; an object of another kind stays."""
    if not can_be_remade(spec):
        return spec
    place, made = points(spec)[BODY_PART], object_of_type(name)
    for shared in properties(made).keys() & properties(spec).keys() - {"type"}:
        if word(spec, shared) in properties(made)[shared].words:
            made = with_word(made, shared, word(spec, shared))
    return placed(made, *place, "cell" if placed(spec, *place, "cell") == spec else "px")
