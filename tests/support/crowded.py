"""Crowded little levels of our own, made from a seed: much happens in them, so that any changed rule shows.

A room of random size in solid rock, some random tiles, a few kinds of objects in numbers, and random keys. The random
numbers are our own: the standard library's may differ from one Python to the next, and golden digests must not.
"""

from dataclasses import dataclass, field

from ninja_game.sim.kinds import (
    BOUNCE_BLOCK,
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    LAUNCH_PAD,
    LAUNCHER,
    MINE,
    NINJA,
    ONE_WAY,
    THWUMP,
    TURRET,
)
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

TICKS = 300
MASK = (1 << 64) - 1
DIAGONAL = 0.7071067811865468  # of a diagonal launch pad, as the published levels' text loads (game.md §5.2)

HARMLESS = (GOLD, BOUNCE_BLOCK, LAUNCH_PAD, ONE_WAY, DOOR, EXIT)
LETHAL = (TURRET, FLOOR_GUARD, DRONE, THWUMP, LAUNCHER, MINE)


@dataclass
class Dice:
    """SplitMix64 (Steele, Lea, Flood 2014)."""

    state: int
    kept: list[int] = field(default_factory=list)

    def roll(self, sides: int) -> int:
        """A number from 0 to ``sides`` - 1."""
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        return (z ^ (z >> 31)) % sides

    def pick(self, *choices: float) -> float:
        """One of some numbers."""
        return choices[self.roll(len(choices))]


@dataclass(frozen=True)
class Room:
    """The free cells of a level: columns and rows from, to (inclusive)."""

    left: int
    top: int
    right: int
    bottom: int


def crowded_level(seed: int) -> Level:
    """The level of a seed."""
    dice = Dice(seed * 7919 + 1)
    left, top = 1 + dice.roll(12), 1 + dice.roll(8)
    room = Room(left, top, min(COLUMNS, left + 4 + dice.roll(14)), min(ROWS, top + 3 + dice.roll(9)))
    tiles = [1] * (COLUMNS * ROWS)
    density = dice.roll(4) * 7
    for column in range(room.left, room.right + 1):
        for row in range(room.top, room.bottom + 1):
            solid = dice.roll(100) < density
            tiles[(column - 1) * ROWS + row - 1] = 1 + dice.roll(33) if solid else 0
    start = (_along(dice, room.left, room.right), _along(dice, room.top, room.bottom))
    records = [ObjectSpec(NINJA, start)]
    kinds = [HARMLESS[dice.roll(len(HARMLESS))] for _ in range(2)]
    if seed % 3:
        kinds += [LETHAL[dice.roll(len(LETHAL))] for _ in range(1 + dice.roll(2))]
    records += [_object(dice, room, kinds[dice.roll(len(kinds))]) for _ in range(3 + dice.roll(22))]
    return Level(tuple(tiles), tuple(records))


def _along(dice: Dice, low: int, high: int) -> float:
    """A coordinate in the room, px: on a cell's centre, a quarter of a cell, or anywhere."""
    start, span = 24 * low, 24 * (high - low + 1)
    grain = (24, 6, 1)[dice.roll(3)]
    return float(start + (12 if grain == 24 else 0) + dice.roll(span // grain) * grain)


def _object(dice: Dice, room: Room, kind: int) -> ObjectSpec:
    """A random object of a kind in the room."""
    x, y = _along(dice, room.left, room.right), _along(dice, room.top, room.bottom)
    direction = float(dice.roll(4))
    if kind == LAUNCH_PAD:
        straight = dice.pick(-1.0, 1.0)
        normals = ((0.0, straight), (straight, 0.0), (straight * DIAGONAL, dice.pick(-DIAGONAL, DIAGONAL)))
        return ObjectSpec(kind, (x, y, *normals[dice.roll(3)]))
    if kind == FLOOR_GUARD:
        return ObjectSpec(kind, (x, y, 1.0))
    if kind == DRONE:
        return ObjectSpec(kind, (x, y, float(dice.roll(6)), float(dice.roll(2)), float(dice.roll(3)), direction))
    if kind in (ONE_WAY, THWUMP):
        return ObjectSpec(kind, (x, y, direction))
    if kind == EXIT:
        return ObjectSpec(kind, (x, y, _along(dice, room.left, room.right), _along(dice, room.top, room.bottom)))
    if kind == DOOR:
        column = float(room.left + dice.roll(room.right - room.left + 1))
        row = float(room.top + dice.roll(room.bottom - room.top + 1))
        vertical, trap, locked = float(dice.roll(2)), float(dice.roll(2)), float(dice.roll(3) == 0)
        offset = ((0.0, 0.0), (-1.0, 0.0), (0.0, -1.0))[dice.roll(3)]
        return ObjectSpec(kind, (x, y, vertical, trap, column, row, locked, *offset))
    return ObjectSpec(kind, (x, y))


def crowded_inputs(seed: int, ticks: int = TICKS) -> bytes:
    """Random keys: spans of 1 to 24 ticks; the jump triggers when it goes down."""
    dice = Dice(seed * 104729 + 3)
    inputs = bytearray()
    held = 0
    while len(inputs) < ticks:
        down = (0, 1, 2, 1, 2, 3)[dice.roll(6)]
        jump = dice.roll(2)
        for _ in range(1 + dice.roll(24)):
            inputs.append(down | 4 * jump | 8 * (jump & ~held))
            held = jump
    return bytes(inputs[:ticks])
