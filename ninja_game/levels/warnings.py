"""What is legal in a level but odd: each warning names the objects and says what the game will do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist

from ninja_game.formats.ascii.object_writer import best_form
from ninja_game.formats.ascii.places import place_text
from ninja_game.levels.object_checks import oddities
from ninja_game.levels.reach import Ground
from ninja_game.sim import kinds
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import ROWS, Level, ObjectSpec, makes_object, well_formed
from ninja_game.sim.memory.schema import CAPACITY
from ninja_game.sim.rules import MINE_RADIUS, RADIUS

MANY_OBJECTS = 2000
_NAMES_SHOWN = 3
_AGAIN = "the same object is in this place already"


def level_warnings(level: Level) -> list[str]:
    """What is legal but odd in a level, in words for its maker; empty for a proper level.

    "Cannot be reached" is said only where it is certain: by cells and closed sides, whatever the ninja could jump.
    """
    objects = list(filter(makes_object, level.objects))
    if len(objects) >= CAPACITY:
        return [f"there are {len(objects)} objects, more than {CAPACITY - 1}: the level cannot be played"]
    ground = Ground(level)
    odd: dict[str, list[tuple[ObjectSpec, int]]] = {}
    first: dict[ObjectSpec, int] = {}
    for number, record in enumerate(objects):
        again = [_AGAIN] if first.setdefault(record, number) != number else []
        for text in (*oddities(record, ground), *again):
            odd.setdefault(text, []).append((record, number))
    named = (_some([object_name(*one) for one in some[:_NAMES_SHOWN]], len(some)) + f": {text}"
             for text, some in odd.items())  # fmt: skip
    return [*_level_oddities(level, objects), *_odd_tiles(level), *named]


def object_name(record: ObjectSpec, number: int) -> str:
    """An object as its level's file places it: ``thwump at 12,3 (object 7)``; ids count from 0."""
    keyword, place, _ = best_form(record)
    name = keyword or KIND_NAMES[record.kind]
    if not place and len(record.values) > 1:
        place = place_text(*record.values[:2])
        name = f"{name} with its switch" if record.kind == kinds.DOOR else name
    return f"{name} at {place} (object {number})" if place else f"{name} (object {number})"


def _some(names: Sequence[str], count: int) -> str:
    """The first names of a list of ``count``."""
    more = count - _NAMES_SHOWN
    return ", ".join(names[:_NAMES_SHOWN]) + (f" and {more} more" if more > 0 else "")


def _odd_tiles(level: Level) -> Iterator[str]:
    """A warning for each sort of odd tile, with its first places."""
    names: dict[str, list[str]] = {}
    for cell, tile in enumerate(level.tiles):
        if not 0 <= tile <= 33:
            what = "above 33 is a half tile without direction" if tile > 33 else "below 0 is never solid, yet not empty"
            names.setdefault(what, []).append(f"tile {tile} at {cell // ROWS + 1},{cell % ROWS + 1}")
    return (f"{_some(places, len(places))}: a tile id {what}" for what, places in names.items())


def _level_oddities(level: Level, objects: Sequence[ObjectSpec]) -> Iterator[str]:
    """What concerns the level as a whole."""
    ninjas = [number for number, record in enumerate(objects) if record.kind == kinds.NINJA]
    if not ninjas:
        yield "there is no ninja: the level cannot be played"
    elif len(ninjas) > 1:
        last = object_name(objects[ninjas[-1]], ninjas[-1])
        yield f"there are {len(ninjas)} ninjas: the last one plays, {last}; the others only stand there"
    yield from _deadly_start(objects)
    if not any(record.kind == kinds.EXIT and well_formed(record) for record in objects):
        yield "there is no exit: the level cannot be passed"
    if len(objects) > MANY_OBJECTS:
        yield f"there are {len(objects)} objects, more than {MANY_OBJECTS}: the game may be slow"
    ignored = [record.text or str(record.kind) for record in level.objects if not makes_object(record)]
    if ignored:
        yield f"{len(ignored)} records create nothing (unknown type), the first is {ignored[0][:40]!r}"


def _deadly_start(objects: Sequence[ObjectSpec]) -> Iterator[str]:
    """The mine that the ninja touches where it starts."""
    starts = [record.values for record in objects if record.kind == kinds.NINJA and well_formed(record)]
    for number, record in enumerate(objects):
        mine = record.kind == kinds.MINE and well_formed(record)
        if mine and starts and dist(record.values, starts[-1]) < MINE_RADIUS + RADIUS:
            yield f"{object_name(record, number)}: the ninja touches it where it starts and dies at once"
            return
