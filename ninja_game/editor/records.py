"""Object records as a level maker sees them: points that can be dragged, and properties with words for values."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import isfinite
from typing import NamedTuple

from ninja_game.editor.draft import cell_of
from ninja_game.editor.motion import Motion
from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS
from ninja_game.formats.ascii.object_forms import DOORS, MOVEMENTS, SIDES, WEAPONS, door_middle
from ninja_game.sim.kinds import DOOR, DRONE, EXIT, FLOOR_GUARD, KIND_NAMES, LAUNCH_PAD, ONE_WAY, THWUMP
from ninja_game.sim.level import ObjectSpec, makes_object, well_formed

BODY, SWITCH = 0, 1
"""Parts of an object: the thing itself, and what opens it."""

Point = tuple[float, float]


class Property(NamedTuple):
    """Which values of a record say something, and the words for them."""

    slots: tuple[int, ...]
    words: Mapping[str, tuple[float, ...]]


def _single(vocabulary: Mapping[str, float]) -> dict[str, tuple[float, ...]]:
    return {word: (number,) for word, number in vocabulary.items()}


_FACING = {"direction": Property((2,), _single(DIRECTION_WORDS))}

PROPERTIES: dict[int, dict[str, Property]] = {
    ONE_WAY: _FACING,
    THWUMP: _FACING,
    LAUNCH_PAD: {"direction": Property((2, 3), PAD_NORMALS)},
    DRONE: {
        "type": Property((4,), _single(WEAPONS)),
        "movement": Property((2,), _single(MOVEMENTS)),
        "direction": Property((5,), _single(DIRECTION_WORDS)),
        "seeker": Property((3,), {"no": (0.0,), "yes": (1.0,)}),
    },
    DOOR: {"type": Property((3, 6), DOORS), "side": Property((2, 7, 8), SIDES)},
}
"""The properties of each kind that has any."""

_SIDES = ("right", "bottom", "left", "top")
"""By the numbers of their directions."""


def properties(record: ObjectSpec) -> dict[str, Property]:
    """The properties that a record has."""
    return PROPERTIES.get(record.kind, {}) if well_formed(record) else {}


def word(record: ObjectSpec, name: str) -> str:
    """The word for a property of a record; '' for values that have none."""
    slots, words = properties(record)[name]
    values = tuple(record.values[slot] for slot in slots)
    return next((text for text, meant in words.items() if meant == values), "")


def with_word(record: ObjectSpec, name: str, text: str) -> ObjectSpec:
    """A record with another word for a property."""
    values = list(record.values)
    slots, words = properties(record)[name]
    for slot, value in zip(slots, words[text], strict=True):
        values[slot] = value
    return settled(record._replace(values=tuple(values)))


def settled(record: ObjectSpec) -> ObjectSpec:
    """A record whose values agree: an automatic door senses in the middle of its side."""
    if record.kind == DOOR and well_formed(record) and not has_switch(record):
        side = word(record, "side")
        column, row = record.values[4:6]
        if side and column.is_integer() and row.is_integer():
            return record._replace(values=(*door_middle(int(column), int(row), side), *record.values[2:]))
    return record


def object_type_name(record: ObjectSpec) -> str:
    """What an object is called: its type where it has one, else its kind."""
    if "type" in properties(record) and word(record, "type"):
        return word(record, "type")
    return KIND_NAMES[record.kind] if makes_object(record) else "a record that makes nothing"


def has_switch(record: ObjectSpec) -> bool:
    """Whether an object has a second part: the switch of an exit, of a locked door, of a trap door."""
    if not well_formed(record):
        return False
    return record.kind == EXIT or (record.kind == DOOR and (record.values[3] != 0 or record.values[6] != 0))


def points(record: ObjectSpec) -> dict[int, Point]:
    """Where the parts of an object are, px; nothing for what is nowhere."""
    if not makes_object(record) or len(record.values) < 2:
        return {}
    x, y = record.values[:2]
    if record.kind not in (EXIT, DOOR) or not well_formed(record):
        return {BODY: (x, y)} if isfinite(x) and isfinite(y) else {}
    if record.kind == EXIT:
        found = {BODY: (x, y), SWITCH: (record.values[2], record.values[3])}
    else:
        found = {BODY: _door_point(record.values)} | ({SWITCH: (x, y)} if has_switch(record) else {})
    return {part: point for part, point in found.items() if all(map(isfinite, point))}


def _door_point(values: tuple[float, ...]) -> Point:
    """The middle of a door's bar, px."""
    x, y = 24.0 * (values[4] + values[7]) + 12.0, 24.0 * (values[5] + values[8]) + 12.0
    return (x, y + 12.0) if values[2] else (x + 12.0, y)


def carried(record: ObjectSpec, motion: Motion, parts: Collection[int] = (BODY, SWITCH)) -> ObjectSpec:
    """A record after a motion of some of its parts; directions turn with the body."""
    kind, values = record.kind, list(record.values)
    if not points(record):
        return record
    if well_formed(record) and kind in (EXIT, DOOR):
        return _carried_in_parts(record, motion, parts)
    if BODY not in parts:
        return record
    if kind == FLOOR_GUARD and motion.turns:
        # It stands on the floor of its cell, whichever side that was.
        x, y = motion.point(values[0], 24.0 * cell_of(*values[:2])[1] + 12.0)
        values[:2] = x, 24.0 * cell_of(x, y)[1] + 18.0
        return record._replace(values=tuple(values))
    values[:2] = motion.point(*values[:2])
    if well_formed(record) and motion.turns:
        if kind in (ONE_WAY, THWUMP):
            values[2] = motion.direction(values[2])
        elif kind == LAUNCH_PAD:
            values[2:] = motion.vector(*values[2:])
        elif kind == DRONE:
            values[5] = motion.direction(values[5])
            # 0 and 1, 2 and 3 are the two senses of rotation.
            values[2] = float(int(values[2]) ^ 1) if motion.reverses and values[2] in (0, 1, 2, 3) else values[2]
    return record._replace(values=tuple(values))


def _carried_in_parts(record: ObjectSpec, motion: Motion, parts: Collection[int]) -> ObjectSpec:
    """An exit or a door: its parts move each by itself, the door from side to side of cells."""
    values = list(record.values)
    if record.kind == EXIT:
        if BODY in parts:
            values[:2] = motion.point(*values[:2])
        if SWITCH in parts:
            values[2:] = motion.point(*values[2:])
        return record._replace(values=tuple(values))
    if SWITCH in parts or not has_switch(record):
        values[:2] = motion.point(*values[:2])
    if BODY in parts:
        # A door moves by whole cells.
        whole = motion if motion.turns else motion._replace(dx=_whole(motion.dx), dy=_whole(motion.dy))
        x, y = whole.point(24.0 * values[4] + 12.0, 24.0 * values[5] + 12.0)
        values[4:6] = (x - 12.0) / 24.0, (y - 12.0) / 24.0
        side = word(record, "side")
        if motion.turns and side:
            turned = _SIDES[int(motion.direction(_SIDES.index(side)))]
            values[2], values[7], values[8] = SIDES[turned]
    return settled(record._replace(values=tuple(values)))


def _whole(length: float) -> float:
    return 24.0 * round(length / 24.0)
