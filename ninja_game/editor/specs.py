"""Objects of a level for a level maker: points to drag, and properties with words for values."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import isfinite
from typing import NamedTuple

from ninja_game.editor.motion import Motion
from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS, WEAPONS
from ninja_game.formats.ascii.object_lines import DOORS, MOVEMENTS, SIDES, door_middle
from ninja_game.sim.grid import Point, cell_of
from ninja_game.sim.kinds import DOOR, DRONE, EXIT, FLOOR_GUARD, KIND_NAMES, LAUNCH_PAD, ONE_WAY, THWUMP
from ninja_game.sim.level import ObjectSpec, makes_object, well_formed
from ninja_game.sim.rules import CELL, HALF

BODY_PART, SWITCH_PART = 0, 1  # parts of an object: its body, and its switch


class Property(NamedTuple):
    """The values of a spec for a property, and the words for them."""

    slots: tuple[int, ...]
    words: Mapping[str, tuple[float, ...]]


def _single(vocabulary: Mapping[str, float]) -> dict[str, tuple[float, ...]]:
    return {text: (number,) for text, number in vocabulary.items()}


_FACING = {"direction": Property((2,), _single(DIRECTION_WORDS))}

PROPERTIES_BY_KIND: dict[int, dict[str, Property]] = {
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

_SIDES = ("right", "bottom", "left", "top")  # indexed by direction


def properties(spec: ObjectSpec) -> dict[str, Property]:
    return PROPERTIES_BY_KIND.get(spec.kind, {}) if well_formed(spec) else {}


def word(spec: ObjectSpec, name: str) -> str:
    """The word for a property of a spec; '' for a value without one."""
    slots, words = properties(spec)[name]
    values = tuple(spec.values[slot] for slot in slots)
    return next((text for text, meant in words.items() if meant == values), "")


def with_word(spec: ObjectSpec, name: str, text: str) -> ObjectSpec:
    values = list(spec.values)
    slots, words = properties(spec)[name]
    for slot, value in zip(slots, words[text], strict=True):
        values[slot] = value
    return settled(spec._replace(values=tuple(values)))


def settled(spec: ObjectSpec) -> ObjectSpec:
    """A spec with consistent values: an automatic door senses in the middle of its side."""
    automatic = spec.kind == DOOR and well_formed(spec) and not has_switch(spec)
    if automatic and word(spec, "side") and all(value.is_integer() for value in spec.values[4:6]):
        return spec._replace(values=(*door_middle(spec.values), *spec.values[2:]))
    return spec


def object_type_name(spec: ObjectSpec) -> str:
    """The name of an object: its type if it has one, else its kind."""
    if "type" in properties(spec) and word(spec, "type"):
        return word(spec, "type")
    return KIND_NAMES[spec.kind] if makes_object(spec) else "a record that makes nothing"


def has_switch(spec: ObjectSpec) -> bool:
    """Whether an object has a second part: the switch of an exit, of a locked door, of a trap door."""
    if not well_formed(spec):
        return False
    return spec.kind == EXIT or (spec.kind == DOOR and (spec.values[3] != 0 or spec.values[6] != 0))


def points(spec: ObjectSpec) -> dict[int, Point]:
    """The places of an object's parts, px; none for an object without a valid place."""
    if not makes_object(spec) or len(spec.values) < 2:
        return {}
    x, y = spec.values[:2]
    if spec.kind not in (EXIT, DOOR) or not well_formed(spec):
        return {BODY_PART: (x, y)} if isfinite(x) and isfinite(y) else {}
    if spec.kind == EXIT:
        places = {BODY_PART: (x, y), SWITCH_PART: (spec.values[2], spec.values[3])}
    else:
        places = {BODY_PART: door_middle(spec.values)} | ({SWITCH_PART: (x, y)} if has_switch(spec) else {})
    return {part: point for part, point in places.items() if all(map(isfinite, point))}


def grip(spec: ObjectSpec) -> Point | None:
    """Another place to take an object by, px: the middle of a door's or pad's cell, the side that a one-way closes."""
    if spec.kind == DOOR and points(spec) and well_formed(spec):
        return CELL * spec.values[4] + HALF, CELL * spec.values[5] + HALF
    if spec.kind not in (LAUNCH_PAD, ONE_WAY) or not points(spec) or not (properties(spec) and word(spec, "direction")):
        return None
    a, b = PAD_NORMALS[word(spec, "direction")]
    return spec.values[0] + HALF * a, spec.values[1] + HALF * b


def carried(spec: ObjectSpec, motion: Motion, parts: Collection[int] = (BODY_PART, SWITCH_PART)) -> ObjectSpec:
    """A spec after a motion of some of its parts; directions turn with the body."""
    kind, values = spec.kind, list(spec.values)
    if not points(spec):
        return spec
    if well_formed(spec) and kind in (EXIT, DOOR):
        return _carried_in_parts(spec, motion, parts)
    if BODY_PART not in parts:
        return spec
    if kind == FLOOR_GUARD and motion.turns:
        # It stands on the floor of its cell, also after a turn.
        x, y = motion.point(values[0], CELL * cell_of(*values[:2])[1] + HALF)
        values[:2] = x, CELL * cell_of(x, y)[1] + 18.0
        return spec._replace(values=tuple(values))
    values[:2] = motion.point(*values[:2])
    if well_formed(spec) and motion.turns:
        if kind in (ONE_WAY, THWUMP):
            values[2] = motion.direction(values[2])
        elif kind == LAUNCH_PAD:
            values[2:] = motion.vector(*values[2:])
        elif kind == DRONE:
            values[5] = motion.direction(values[5])
            # 0 and 1, 2 and 3 are the two senses of rotation.
            values[2] = float(int(values[2]) ^ 1) if motion.reverses and values[2] in (0, 1, 2, 3) else values[2]
    return spec._replace(values=tuple(values))


def _carried_in_parts(spec: ObjectSpec, motion: Motion, parts: Collection[int]) -> ObjectSpec:
    """An exit or a door: each part moves by itself, the door from side to side of cells."""
    values = list(spec.values)
    if spec.kind == EXIT:
        if BODY_PART in parts:
            values[:2] = motion.point(*values[:2])
        if SWITCH_PART in parts:
            values[2:] = motion.point(*values[2:])
        return spec._replace(values=tuple(values))
    if SWITCH_PART in parts or not has_switch(spec):
        values[:2] = motion.point(*values[:2])
    if BODY_PART in parts:
        # A door moves by whole cells.
        whole = motion if motion.turns else motion._replace(dx=_whole(motion.dx), dy=_whole(motion.dy))
        x, y = whole.point(CELL * values[4] + HALF, CELL * values[5] + HALF)
        values[4:6] = (x - HALF) / CELL, (y - HALF) / CELL
        side = word(spec, "side")
        if motion.turns and side:
            turned = _SIDES[int(motion.direction(_SIDES.index(side)))]
            values[2], values[7], values[8] = SIDES[turned]
    return settled(spec._replace(values=tuple(values)))


def _whole(length: float) -> float:
    return CELL * round(length / CELL)
