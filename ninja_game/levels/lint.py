"""Legal but odd content of a level: a finding names the objects and says what the game will do."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from math import dist, isnan, sqrt

from ninja_game.files.shown_text import counted
from ninja_game.formats.ascii.places import place_text
from ninja_game.formats.ascii.writer import best_form
from ninja_game.formats.messages import NO_CELL, Moment, parse_messages
from ninja_game.levels.findings import Finding, level_finding
from ninja_game.levels.ground import Ground, edges_of
from ninja_game.sim import kinds, rules
from ninja_game.sim.arithmetic import is_set
from ninja_game.sim.collision import tiles
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.grid import cell_at
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec, makes_object, well_formed
from ninja_game.sim.schema.world_fields import CAPACITY
from ninja_game.sim.states import LOCKED, TRAP

Squares = dict[tuple[float, float], set[tuple[float, float]]]  # places, px, by the square (column, row) that holds them
OddPlaces = list[tuple[str, Squares, set[int]]]
"""Exits, their switches and the start: a name, the places, and the kinds that are odd there."""

_FIXED = {kinds.LAUNCH_PAD, kinds.BOUNCE_BLOCK, kinds.THWUMP, kinds.TURRET, kinds.LAUNCHER}
_BARRING, _DEADLY = _FIXED | {kinds.MINE}, _FIXED | {kinds.DRONE, kinds.FLOOR_GUARD}
"""Kinds that are a mistake over an exit, which drones leave free, or over the start, where mines kill."""
MANY_OBJECTS = 2000
MANY_THINKERS = 30  # with more enemies that think in turn, one waits more than three seconds for its turn
_NAMES_SHOWN = 3
_OVER_GOLD = 8.0  # a mine nearer than this, px, covers a piece of gold
_COVER_PX = 12.5
"""An object nearer than this, px, covers an exit, a switch or the start; a launch pad on their floor is 12 px away."""

_DIRECTIONS = (0, 1, 2, 3)
_SAMPLES = (-1.0, -0.5, 0.0, 0.5, 1.0)  # tested points of a piece of gold, across and down, as shares of its radius
_HIDDEN = 2 / 3  # share of gold in rock from which on nobody sees it: tiles are drawn over it
_UNIT_TOLERANCE = 0.02  # pads of other editors have 0.7 for both parts of a diagonal

_IN_TILE = {
    kinds.NINJA: "starts inside a tile",
    kinds.TURRET: "is inside a tile: what it sees and hits is odd",
    kinds.MINE: "is inside a tile",
    kinds.LAUNCH_PAD: "is inside a tile",
    kinds.LAUNCHER: "is inside a tile: its rockets explode at once",
}


def _around(half: float) -> float:
    """The radius of a disc that a ninja touches wherever it touches a box, px; it stays in the cells around that."""
    return sqrt(2.0) * (half + rules.RADIUS) - rules.RADIUS


_TOUCHED = {
    kinds.LAUNCH_PAD: rules.PAD_RADIUS,
    kinds.BOUNCE_BLOCK: _around(rules.BLOCK_HALF),
    kinds.ONE_WAY: _around(rules.ONE_WAY_HALF),
}
"""Kinds that do nothing where no ninja touches them, with their radius, px. Mines, which decorate, are not named."""


def level_warnings(level: Level, says: str = "") -> list[str]:
    """Describe the oddities of a level and its messages, in words for its maker; empty for a proper level.

    "Cannot be reached" is only reported if it is certain: by cells and closed sides, whatever the ninja could jump.
    """
    return [finding.sentence for finding in level_findings(level, says)]


def level_findings(level: Level, says: str = "") -> list[Finding]:
    """Find the oddities of a level, with their places: the level as a whole, its messages, then tiles, then objects.

    ``says``: the header of its file. Raises LevelError if that cannot be read.
    """
    numbers = [number for number, spec in enumerate(level.objects) if makes_object(spec)]
    objects = [level.objects[number] for number in numbers]
    if len(objects) >= CAPACITY:
        return [level_finding("too-many-objects", count=len(objects), most=CAPACITY - 1)]
    ground = Ground(level)
    ends = _ends(ground)
    odd: dict[Finding, list[int]] = {}
    first: dict[ObjectSpec, int] = {}
    covering = _mines_over_gold(objects)
    for id_, spec in enumerate(objects):
        duplicate = [level_finding("duplicate")] if first.setdefault(spec, id_) != id_ else []
        over = [level_finding("mine-over-gold")] if spec in covering else []
        for finding in (*oddities(spec, ground, ends), *duplicate, *over):
            odd.setdefault(finding, []).append(id_)
    of_objects = []
    for finding, ids in odd.items():
        names = _first_names([object_name(objects[id_], id_) for id_ in ids[:_NAMES_SHOWN]], len(ids))
        of_objects.append(finding._replace(records=tuple(numbers[id_] for id_ in ids), names=names))
    whole = _level_oddities(level, objects)
    of_level = [oddity._replace(records=tuple(numbers[id_] for id_ in oddity.records)) for oddity in whole]
    return [*of_level, *unseen_messages(says, ground), *_odd_tiles(level), *of_objects]


def object_name(spec: ObjectSpec, number: int) -> str:
    """Name an object with its place (``_shown_place``): ``gold at 12,18 (288,442px, object 7)``; ids count from 0."""
    keyword, place, _ = best_form(spec)
    name = keyword or kinds.KIND_NAMES[spec.kind]
    if not place and len(spec.values) > 1:
        place = place_text(*spec.values[:2])
        name = f"{name} with its switch" if spec.kind == kinds.DOOR else name
    where = f"{name} at {_shown_place(spec.values[0], spec.values[1], place)}" if place else name
    return f"{where[:-1]}, object {number})" if where.endswith(")") else f"{where} (object {number})"


def _shown_place(x: float, y: float, text: str) -> str:
    """Show a place that a file writes as ``text``: its cell, and the px if only these are exact."""
    cell = cell_at(x, y) if text.endswith("px") else 0
    return f"{tiles.COLUMN[cell]},{tiles.ROW[cell]} ({text})" if cell else text


def _first_names(names: Sequence[str], count: int) -> str:
    """The first names of a list of ``count``."""
    more = count - _NAMES_SHOWN
    return ", ".join(names[:_NAMES_SHOWN]) + (f" and {more} more" if more > 0 else "")


def unseen_messages(says: str, ground: Ground) -> Iterator[Finding]:
    """Find the messages whose moment never comes. Raises LevelError if they cannot be read."""
    things = [spec for spec in ground.objects if well_formed(spec)]
    doors = {kind: [(o.x, o.y) for o in ground.doors.values() if o.mechanism == kind] for kind in (LOCKED, TRAP)}
    gold = [spec.values[:2] for spec in things if spec.kind == kinds.GOLD]
    named: dict[Moment, tuple[str, Sequence[Sequence[float]]]] = {
        Moment.SWITCH: ("exit", [spec.values[2:4] for spec in things if spec.kind == kinds.EXIT]),
        Moment.GOLD: ("gold", gold), Moment.ALL_GOLD: ("gold", gold),
        Moment.LOCK: ("locked door", doors[LOCKED]), Moment.TRAP: ("trap door", doors[TRAP]),
    }  # fmt: skip
    for number, message in enumerate(parse_messages(says)):
        missing, places = named.get(message.when, ("", ()))
        cells, why = (message.cell,) if message.cell != NO_CELL else (), ""
        if missing and not any(message.is_about(*place) for place in places):
            why = f"there is no {missing}"
            if cells:
                column, row = message.cell
                why += f" at {column},{row}" if missing == "gold" else f" with its switch at {column},{row}"
        elif message.when == Moment.GOLD and message.number > len(gold):
            why = f"the level has {counted(len(gold), 'piece')} of gold"
        elif message.place and not ground.comes_near(*message.middle, message.reach):
            why = "the ninja never comes near its place"
        if why:
            yield level_finding("unseen-message", cells=cells, message=number, text=message.one_line, why=why)


def _odd_tiles(level: Level) -> Iterator[Finding]:
    odd: dict[str, list[int]] = {}
    for cell, tile in enumerate(level.tiles):
        if not 0 <= tile <= 33:
            what = "above 33 is a half tile without direction" if tile > 33 else "below 0 is never solid, yet not empty"
            odd.setdefault(what, []).append(cell)
    for what, some in odd.items():
        places = [(cell // ROWS + 1, cell % ROWS + 1) for cell in some]
        names = [f"tile {level.tile(*place)} at {place[0]},{place[1]}" for place in places[:_NAMES_SHOWN]]
        yield level_finding("odd-tile", cells=tuple(places), what=what)._replace(names=_first_names(names, len(places)))


def _level_oddities(level: Level, objects: Sequence[ObjectSpec]) -> Iterator[Finding]:
    """Find oddities of the level as a whole, with the ids of the objects to look at."""
    ninjas = [id_ for id_, spec in enumerate(objects) if spec.kind == kinds.NINJA]
    if not ninjas:
        yield level_finding("no-ninja")
    elif len(ninjas) > 1:
        last = object_name(objects[ninjas[-1]], ninjas[-1])
        yield level_finding("several-ninjas", tuple(ninjas[:-1]), count=len(ninjas), last=last)
    yield from _deadly_start(objects)
    if not any(spec.kind == kinds.EXIT and well_formed(spec) for spec in objects):
        yield level_finding("no-exit")
    if len(objects) > MANY_OBJECTS:
        yield level_finding("many-objects", count=len(objects), most=MANY_OBJECTS)
    waiting = [id_ for id_, spec in enumerate(objects) if _waits_for_its_turn(spec)]
    if len(waiting) > MANY_THINKERS:
        seconds = len(waiting) * (rules.THINK_PAUSE + 1) / rules.TICKS_PER_SECOND
        yield level_finding("slow-thinkers", tuple(waiting), count=len(waiting), seconds=seconds)
    ignored = [spec.text or str(spec.kind) for spec in level.objects if not makes_object(spec)]
    if ignored:
        yield level_finding("unknown-type", count=len(ignored), first=ignored[0][:40])


def _waits_for_its_turn(spec: ObjectSpec) -> bool:
    """Whether an object looks for the ninja only in its turn of the thinker ring."""
    if spec.kind == kinds.DRONE and well_formed(spec):
        return spec.values[4] in (1, 2)
    return spec.kind in (kinds.TURRET, kinds.LAUNCHER)


def _mines_over_gold(objects: Sequence[ObjectSpec]) -> set[ObjectSpec]:
    gold = _in_squares((spec.values for spec in objects if spec.kind == kinds.GOLD and well_formed(spec)), _OVER_GOLD)
    mines = (spec for spec in objects if gold and spec.kind == kinds.MINE and well_formed(spec))
    return {spec for spec in mines if _is_near(spec.values, gold, _OVER_GOLD)}


def _in_squares(places: Iterable[tuple[float, ...]], side: float) -> Squares:
    squares: Squares = {}
    for x, y in places:
        squares.setdefault((x // side, y // side), set()).add((x, y))
    return squares


def _is_near(at: tuple[float, ...], places: Squares, side: float) -> bool:
    """Whether a place is nearer than the side of the squares, px: only a few of thousands are tested."""
    column, row = (value // side for value in at)
    around = [(column + a, row + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]
    return any(dist(at, place) < side for square in around for place in places.get(square, ()))


def _deadly_start(objects: Sequence[ObjectSpec]) -> Iterator[Finding]:
    starts = [spec.values for spec in objects if spec.kind == kinds.NINJA and well_formed(spec)]
    for id_, spec in enumerate(objects):
        mine = spec.kind == kinds.MINE and well_formed(spec)
        if mine and starts and dist(spec.values, starts[-1]) < rules.MINE_RADIUS + rules.RADIUS:
            yield level_finding("deadly-start", (id_,), mine=object_name(spec, id_))
            return


def oddities(spec: ObjectSpec, ground: Ground, ends: OddPlaces) -> Iterator[Finding]:
    """Find the oddities of an object in the level of ``ground``."""
    if not well_formed(spec):
        count, needed = len(spec.values), kinds.VALUE_COUNTS[spec.kind]
        does = "starts at 45,70px" if spec.kind == kinds.NINJA else "does nothing"
        yield level_finding("value-count", count=count, needed=needed, does=does)
        return
    if any(map(isnan, spec.values)):
        yield level_finding("not-a-number")
    if spec.kind != kinds.DOOR:
        yield from _place_oddities(spec, ground, ends)
    if spec.kind in _CHECKS:
        yield from _CHECKS[spec.kind](spec, ground)


def _ends(ground: Ground) -> OddPlaces:
    exits = [spec.values for spec in ground.objects if spec.kind == kinds.EXIT and well_formed(spec)]
    starts = [spec.values for spec in ground.objects if spec.kind == kinds.NINJA][-1:] if ground.start else []
    return [
        ("the exit", _in_squares((values[:2] for values in exits), _COVER_PX), _BARRING),
        ("the exit's switch", _in_squares((values[2:] for values in exits), _COVER_PX), _BARRING),
        ("the ninja's start", _in_squares(starts, _COVER_PX), _DEADLY),
    ]


def _place_oddities(spec: ObjectSpec, ground: Ground, ends: OddPlaces) -> Iterator[Finding]:
    x, y = spec.values[:2]
    if isnan(x) or isnan(y):
        return
    cell = cell_at(x, y)
    for what, places, barring in ends:
        if spec.kind in barring and _is_near((x, y), places, _COVER_PX):
            yield level_finding("covers", what=what)
    if spec.kind == kinds.FLOOR_GUARD:
        return
    if not cell:
        yield level_finding("outside-grid")
    elif spec.kind in _IN_TILE and _is_deep(ground, x, y):
        border = tiles.COLUMN[cell] in (0, COLUMNS + 1) or tiles.ROW[cell] in (0, ROWS + 1)
        yield level_finding("in-border") if border else level_finding("in-tile", what=_IN_TILE[spec.kind])
    elif spec.kind in (kinds.DRONE, kinds.THWUMP) and ground.is_full(cell):
        yield level_finding("in-full-tile")
    elif spec.kind in _TOUCHED:
        yield from _untouched(ground, x, y, _TOUCHED[spec.kind])


def _is_deep(ground: Ground, x: float, y: float) -> bool:
    """Whether a point is inside a tile and not on its surface, a usual place of turrets and launchers."""
    return all(solid_at(ground.tiles, x + dx, y + dy) for dx in (-0.5, 0.5) for dy in (-0.5, 0.5))


def _untouched(ground: Ground, x: float, y: float, radius: float, switch: str = "") -> Iterator[Finding]:
    """Report a disc that no ninja can touch, or no slow one. ``switch``: "-switch" if the disc is one."""
    if not ground.can_touch(x, y, radius):
        yield level_finding("unreachable" + switch, place=_shown_place(x, y, place_text(x, y)))
    elif ground.is_in_wall(x, y, radius):
        yield level_finding("in-wall" + switch, place=_shown_place(x, y, place_text(x, y)))


def _exit(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y, switch_x, switch_y = spec.values
    if cell_at(x, y):
        yield from _untouched(ground, x, y, rules.EXIT_RADIUS)
    yield from _untouched(ground, switch_x, switch_y, rules.SWITCH_RADIUS, "-switch")


def _gold(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y = spec.values
    if not cell_at(x, y):
        return
    places = [(x + a * rules.GOLD_RADIUS, y + b * rules.GOLD_RADIUS) for a in _SAMPLES for b in _SAMPLES]
    if untouched := [*_untouched(ground, x, y, rules.GOLD_RADIUS)]:
        yield from untouched
    elif sum(solid_at(ground.tiles, *place) for place in places) >= _HIDDEN * len(places):
        yield level_finding("hidden-gold")


def _launch_pad(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:  # noqa: ARG001 - all checks have one signature
    _, _, a, b = spec.values
    length = sqrt(a * a + b * b)
    if abs(length - 1.0) > _UNIT_TOLERANCE:
        yield level_finding("pad-normal", length=length)


def _one_way(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:  # noqa: ARG001
    if spec.values[2] not in _DIRECTIONS:
        yield level_finding("direction", but=": it faces down")


def _thwump(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:  # noqa: ARG001
    if spec.values[2] not in _DIRECTIONS:
        yield level_finding("direction", but=": it never moves, its right side kills")


def _floor_guard(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    cell = cell_at(*spec.values[:2])
    if tiles.COLUMN[cell] in (0, COLUMNS + 1):
        yield level_finding("guard-in-border")
    elif ground.is_full(cell):
        yield level_finding("in-full-tile")
    elif ground.edges[4 * cell + 1] != rules.SOLID:
        yield level_finding("guard-without-floor")


def _drone(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y, movement, seeker, weapon, direction = spec.values
    if weapon not in (0, 1, 2):
        yield level_finding("weapon")
    if movement not in range(6):
        yield level_finding("movement")
    if direction not in _DIRECTIONS:
        yield level_finding("direction", but="")
    if seeker not in (0, 1):
        yield level_finding("seeker-flag")
    elif seeker and weapon != 0:
        yield level_finding("seeker-with-weapon")
    cell = cell_at(x, y)
    sides = range(4 * cell, 4 * cell + 4)
    if cell and all(ground.edges[side] != rules.OFF or side in ground.closed_edges for side in sides):
        yield level_finding("closed-in")


def _door(spec: ObjectSpec, ground: Ground) -> Iterator[Finding]:
    x, y, vertical, trap, _, _, locked, _, _ = spec.values
    edges = edges_of(ground.doors[spec])
    if vertical not in (0, 1):
        yield level_finding("vertical-flag")
    if trap not in (0, 1) or locked not in (0, 1):
        yield level_finding("door-flags")
    elif trap and locked:
        yield level_finding("locked-trap")
    if 0 in edges:
        yield level_finding("door-outside")
    elif ground.doors_on_side[edges] > 1:
        yield level_finding("doors-on-one-side")
    elif any(ground.edges[edge] == rules.SOLID or ground.is_full(edge // 4) for edge in edges):
        yield level_finding("closed-anyway")
    if is_set(trap) or is_set(locked):
        yield from _untouched(ground, x, y, rules.DOOR_SWITCH_RADIUS, "-switch")


_CHECKS: dict[int, Callable[[ObjectSpec, Ground], Iterator[Finding]]] = {
    kinds.DOOR: _door,
    kinds.DRONE: _drone,
    kinds.EXIT: _exit,
    kinds.FLOOR_GUARD: _floor_guard,
    kinds.GOLD: _gold,
    kinds.LAUNCH_PAD: _launch_pad,
    kinds.ONE_WAY: _one_way,
    kinds.THWUMP: _thwump,
}
