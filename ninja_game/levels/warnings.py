"""What is legal in a level but odd: each warning names the objects and says what the game will do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ninja_game.formats.ascii.object_writer import best_form
from ninja_game.formats.ascii.places import place_text
from ninja_game.levels.object_checks import oddities
from ninja_game.levels.reach import Ground, well_formed
from ninja_game.sim.level import DOOR, EXIT, KIND_NAMES, NINJA, ROWS, Level, ObjectSpec

MANY_OBJECTS = 2000
_NAMES_SHOWN = 3


def level_warnings(level: Level) -> list[str]:
    """What is legal but odd in a level, in words for its maker; empty for a proper level.

    "Cannot be reached" is said only where it is certain: by cells and closed sides, whatever the ninja could jump.
    """
    objects = [record for record in level.objects if record.kind >= 0]  # what gets an id (objects.md §2.1)
    ground = Ground(level)
    named = (
        (text, object_name(record, number))
        for number, record in enumerate(objects)
        for text in oddities(record, ground)
    )
    return [*_level_oddities(level, objects), *_shared(_odd_tiles(level)), *_shared(named)]


def object_name(record: ObjectSpec, number: int) -> str:
    """An object as its level's file places it: ``thwump at 12,3 (object 7)``; ids count from 0."""
    keyword, place, _ = best_form(record)
    name = keyword or KIND_NAMES[record.kind]
    if not place and len(record.values) > 1:
        place = place_text(*record.values[:2])
        name = f"{name} with its switch" if record.kind == DOOR else name
    return f"{name} at {place} (object {number})" if place else f"{name} (object {number})"


def _shared(named: Iterable[tuple[str, str]]) -> list[str]:
    """One line for each oddity, with the names of all that share it."""
    names: dict[str, list[str]] = {}
    for text, name in named:
        names.setdefault(text, []).append(name)
    return [f"{_some(group)}: {text}" for text, group in names.items()]


def _some(names: Sequence[str]) -> str:
    more = len(names) - _NAMES_SHOWN
    return ", ".join(names[:_NAMES_SHOWN]) + (f" and {more} more" if more > 0 else "")


def _odd_tiles(level: Level) -> Iterator[tuple[str, str]]:
    for cell, tile in enumerate(level.tiles):
        if not 0 <= tile <= 33:
            what = "above 33 is a half tile without direction" if tile > 33 else "below 0 is never solid, yet not empty"
            yield f"a tile id {what}", f"tile {tile} at {cell // ROWS + 1},{cell % ROWS + 1}"


def _level_oddities(level: Level, objects: Sequence[ObjectSpec]) -> Iterator[str]:
    """What concerns the level as a whole."""
    ninjas = [number for number, record in enumerate(objects) if record.kind == NINJA]
    if not ninjas:
        yield "there is no ninja: the level cannot be played"
    elif len(ninjas) > 1:
        last = object_name(objects[ninjas[-1]], ninjas[-1])
        yield f"there are {len(ninjas)} ninjas: the last one plays, {last}; the others only stand there"
    if not any(record.kind == EXIT and well_formed(record) for record in objects):
        yield "there is no exit: the level cannot be passed"
    if len(objects) > MANY_OBJECTS:
        yield f"there are {len(objects)} objects, more than {MANY_OBJECTS}: the game may be slow"
    ignored = [record.text for record in level.objects if record.kind < 0]
    if ignored:
        yield f"{len(ignored)} records create nothing (unknown type), the first is {ignored[0][:40]!r}"
