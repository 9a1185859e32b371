"""What is legal in a level but odd: each warning names the objects and says what the game will do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist

from ninja_game.formats.ascii.places import place_text
from ninja_game.formats.ascii.writer import best_form
from ninja_game.levels.findings import Finding, found
from ninja_game.levels.object_checks import oddities
from ninja_game.levels.reach import Ground
from ninja_game.sim import kinds
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.level import ROWS, Level, ObjectSpec, makes_object, well_formed
from ninja_game.sim.memory.schema import CAPACITY
from ninja_game.sim.rules import MINE_RADIUS, RADIUS, THINK_PAUSE, TICKS_PER_SECOND

MANY_OBJECTS = 2000
MANY_THINKERS = 30
"""With more enemies than these that think in turn, one waits more than three seconds for its turn."""
_NAMES_SHOWN = 3
_OVER = 8.0
"""Nearer than this, px, a mine covers a piece of gold."""


def level_warnings(level: Level) -> list[str]:
    """What is legal but odd in a level, in words for its maker; empty for a proper level.

    "Cannot be reached" is said only where it is certain: by cells and closed sides, whatever the ninja could jump.
    """
    return [finding.sentence for finding in level_findings(level)]


def level_findings(level: Level) -> list[Finding]:
    """What is odd about a level, with the places: first the level as a whole, then tiles, then objects."""
    numbers = [number for number, record in enumerate(level.objects) if makes_object(record)]
    objects = [level.objects[number] for number in numbers]
    if len(objects) >= CAPACITY:
        return [found("too-many-objects", count=len(objects), most=CAPACITY - 1)]
    ground = Ground(level)
    odd: dict[Finding, list[int]] = {}
    first: dict[ObjectSpec, int] = {}
    covering = _mines_over_gold(objects)
    for id_, record in enumerate(objects):
        again = [found("duplicate")] if first.setdefault(record, id_) != id_ else []
        over = [found("mine-over-gold")] if record in covering else []
        for finding in (*oddities(record, ground), *again, *over):
            odd.setdefault(finding, []).append(id_)
    of_objects = []
    for finding, ids in odd.items():
        names = _some([object_name(objects[id_], id_) for id_ in ids[:_NAMES_SHOWN]], len(ids))
        of_objects.append(finding._replace(records=tuple(numbers[id_] for id_ in ids), names=names))
    whole = _level_oddities(level, objects)
    of_level = [each._replace(records=tuple(numbers[id_] for id_ in each.records)) for each in whole]
    return [*of_level, *_odd_tiles(level), *of_objects]


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


def _odd_tiles(level: Level) -> Iterator[Finding]:
    """A finding for each sort of odd tile, with its first places by name."""
    odd: dict[str, list[int]] = {}
    for cell, tile in enumerate(level.tiles):
        if not 0 <= tile <= 33:
            what = "above 33 is a half tile without direction" if tile > 33 else "below 0 is never solid, yet not empty"
            odd.setdefault(what, []).append(cell)
    for what, some in odd.items():
        places = [(cell // ROWS + 1, cell % ROWS + 1) for cell in some]
        names = [f"tile {level.tile(*place)} at {place[0]},{place[1]}" for place in places[:_NAMES_SHOWN]]
        yield found("odd-tile", cells=tuple(places), what=what)._replace(names=_some(names, len(places)))


def _level_oddities(level: Level, objects: Sequence[ObjectSpec]) -> Iterator[Finding]:
    """What concerns the level as a whole, with the ids of the objects to look at."""
    ninjas = [id_ for id_, record in enumerate(objects) if record.kind == kinds.NINJA]
    if not ninjas:
        yield found("no-ninja")
    elif len(ninjas) > 1:
        last = object_name(objects[ninjas[-1]], ninjas[-1])
        yield found("several-ninjas", tuple(ninjas[:-1]), count=len(ninjas), last=last)
    yield from _deadly_start(objects)
    if not any(record.kind == kinds.EXIT and well_formed(record) for record in objects):
        yield found("no-exit")
    if len(objects) > MANY_OBJECTS:
        yield found("many-objects", count=len(objects), most=MANY_OBJECTS)
    waiting = [id_ for id_, record in enumerate(objects) if _waits_for_its_turn(record)]
    if len(waiting) > MANY_THINKERS:
        seconds = len(waiting) * (THINK_PAUSE + 1) / TICKS_PER_SECOND
        yield found("slow-thinkers", tuple(waiting), count=len(waiting), seconds=seconds)
    ignored = [record.text or str(record.kind) for record in level.objects if not makes_object(record)]
    if ignored:
        yield found("unknown-type", count=len(ignored), first=ignored[0][:40])


def _waits_for_its_turn(record: ObjectSpec) -> bool:
    """Whether an object looks for the ninja only when its turn in the thinker ring comes."""
    if record.kind == kinds.DRONE and well_formed(record):
        return record.values[4] in (1, 2)
    return record.kind in (kinds.TURRET, kinds.LAUNCHER)


def _mines_over_gold(objects: Sequence[ObjectSpec]) -> set[ObjectSpec]:
    """The mines that cover a piece of gold."""
    gold: dict[tuple[float, float], list[tuple[float, ...]]] = {}
    for record in objects:
        if record.kind == kinds.GOLD and well_formed(record):
            x, y = record.values
            gold.setdefault((x // _OVER, y // _OVER), []).append(record.values)
    covering = set()
    for record in objects:
        if gold and record.kind == kinds.MINE and well_formed(record):
            column, row = (value // _OVER for value in record.values)
            places = [(column + a, row + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
            if any(dist(record.values, piece) < _OVER for place in places for piece in gold.get(place, ())):
                covering.add(record)
    return covering


def _deadly_start(objects: Sequence[ObjectSpec]) -> Iterator[Finding]:
    """The mine that the ninja touches where it starts."""
    starts = [record.values for record in objects if record.kind == kinds.NINJA and well_formed(record)]
    for id_, record in enumerate(objects):
        mine = record.kind == kinds.MINE and well_formed(record)
        if mine and starts and dist(record.values, starts[-1]) < MINE_RADIUS + RADIUS:
            yield found("deadly-start", (id_,), mine=object_name(record, id_))
            return
