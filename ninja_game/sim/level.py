"""A level as data, before a world is made of it: 713 tile ids and the object records, in order."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256
from typing import Literal, NamedTuple

from ninja_game.errors import ArgumentError, LevelError
from ninja_game.sim.kinds import GOLD, VALUE_COUNTS

COLUMNS = 31
ROWS = 23
TILES = COLUMNS * ROWS
NOT_A_NUMBER = float("nan")

Body = Literal["circle", "box"]

BODIES: tuple[Body, ...] = ("circle", "box")
"""The shapes that the ninja can have: the circle of the classic rules, and a box of the same size."""


def is_box(body: str) -> bool:
    """Whether a body is the box. Raises ArgumentError for an unknown body."""
    if body not in BODIES:
        raise ArgumentError(f"body is {body!r}; expected 'circle' or 'box'")
    return body == "box"


class ObjectSpec(NamedTuple):
    """One object record of a level string (objects.md §5).

    ``kind`` is the type number 0…12, or -1 for a record that creates nothing (unknown type, empty); ``values`` are
    float64 as Flash reads numbers (px, flags, cells), NaN where the text was not a number. ``text`` is kept only for
    kind -1, whose record cannot be rebuilt from kind and values, so that such a level can be written back.
    """

    kind: int
    values: tuple[float, ...]
    text: str = ""


def makes_object(spec: ObjectSpec) -> bool:
    """Whether a record is of a known kind; all others create nothing and get no id (objects.md §2.1)."""
    return 0 <= spec.kind < len(VALUE_COUNTS)


def well_formed(spec: ObjectSpec) -> bool:
    """Whether a record makes an object and has the number of values that its kind needs."""
    return makes_object(spec) and len(spec.values) == VALUE_COUNTS[spec.kind]


@dataclass(frozen=True)
class Level:
    """A level's tiles and object records.

    ``tiles``: 713 ids, column by column, 31 columns of 23 rows, top to bottom (world.md §2.3). 0…33 are the shapes;
    above 33 is an odd half tile, below 0 a tile that is never solid (both occur only in malformed levels).
    ``objects``: in creation order, which decides ids, update order and list order.
    """

    tiles: tuple[int, ...] = field(default=(0,) * TILES, repr=False)
    objects: tuple[ObjectSpec, ...] = ()

    def __post_init__(self) -> None:
        """Make all NaNs one object: tuples compare NaN by identity, so a level equals its copy from another process."""
        if any(value != value for spec in self.objects for value in spec.values):
            objects = [
                spec._replace(values=tuple(NOT_A_NUMBER if value != value else value for value in spec.values))
                for spec in self.objects
            ]
            object.__setattr__(self, "objects", tuple(objects))

    def __reduce__(self) -> tuple[type[Level], tuple[tuple[int, ...], tuple[ObjectSpec, ...]]]:
        """Copy and unpickle by the constructor, so that ``__post_init__`` runs."""
        return type(self), (self.tiles, self.objects)

    @cached_property
    def digest(self) -> str:
        """Sha256 (hex) over tiles and records that make an object; a board asks for it many times."""
        records = "!".join(
            f"{spec.kind}^" + ",".join(repr(value or 0.0) for value in spec.values)
            for spec in self.objects
            if makes_object(spec)
        )
        return sha256(f"{','.join(map(str, self.tiles))}|{records}".encode()).hexdigest()

    @property
    def gold(self) -> int:
        """The number of pieces of gold."""
        return [spec.kind for spec in self.objects].count(GOLD)

    def tile(self, column: int, row: int) -> int:
        """The tile id at interior cell ``column`` 1…31, ``row`` 1…23 (indices of the full 33 x 25 grid)."""
        return self.tiles[(column - 1) * ROWS + (row - 1)]


def check_level(level: object) -> None:
    """Raise LevelError for anything but a level: 713 whole numbers and records of numbers."""
    if not isinstance(level, Level):
        hint = "load_level(path) and parse_level(text) read one"
        raise LevelError("this is not a level", found=repr(level)[:40], expected="a Level", hint=hint)
    if len(level.tiles) != TILES or not all(isinstance(tile, int) for tile in level.tiles):
        raise LevelError("not the tiles of a level", expected=f"{TILES} whole numbers")
    for number, spec in enumerate(level.objects):
        try:
            good = isinstance(spec.kind, int) and all(isinstance(float(value), float) for value in spec.values)
        except (TypeError, ValueError, OverflowError, AttributeError):
            good = False
        if not good:
            expected = "a whole number as its kind, and float64 numbers"
            raise LevelError(
                f"object {number} of the level is not an ObjectSpec", found=repr(spec)[:60], expected=expected
            )
