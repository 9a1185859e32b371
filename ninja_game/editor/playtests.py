"""Playtests of a level under edit: where they begin, their routes, and the routes of its drones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache, partial
from itertools import product
from math import dist, isfinite
from struct import iter_unpack
from typing import NamedTuple

from ninja_game.editor.draft import Draft
from ninja_game.editor.palette import EMPTY, object_of_type, placed
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.errors import BudgetError, LevelError
from ninja_game.formats.messages import FRAME_SIZE
from ninja_game.runs.run import RunResult, run_level
from ninja_game.runtime import NewestJob
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside, middle_of
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bits
from ninja_game.sim.kinds import DOOR, NINJA
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.rules import CELL, GOLD_RADIUS, RADIUS, TICKS_PER_SECOND
from ninja_game.simulation import Simulation

TICKS = TICKS_PER_SECOND  # ticks simulated for the overlay, and least ticks of a playtest before its message: a second

_AROUND, _FLOORS = 8, 16
"""How many cells around a place, below it twice as many, and how many floors there, a playtest may begin on."""

PathPoints = tuple[Point, ...]  # the ninja's place after each tick, px


class Playtest(NamedTuple):
    """A play of the level in its state at that time. ``inputs``: a byte per tick; ``over``: it cannot be continued."""

    level: Level
    inputs: bytes
    over: bool


class PlaytestMap(NamedTuple):
    """Many playtests of a level: by cell the number of those with the ninja in it; and the deaths, px."""

    visits: Mapping[Cell, int]
    deaths: PathPoints


@lru_cache(maxsize=300)
def run_of(level: Level, inputs: bytes) -> RunResult | None:
    """The run of these inputs; None if it cannot be played, or costs too much."""
    try:
        return run_level(level, inputs, memory="plain")
    except (BudgetError, LevelError):
        return None


def route_of(level: Level, inputs: bytes) -> PathPoints:
    """The ninja's route to the end of the run or of the inputs; () if it cannot be played, or costs too much."""
    run = run_of(level, inputs)
    return tuple(iter_unpack("<2d", run.places)) if run else ()


def drone_round(draft: Draft, drone: ObjectSpec) -> Level:
    """The tiles and doors of a level with one drone, for ``round_of``; the ninja is far away."""
    doors = (spec for spec in draft.objects if spec.kind == DOOR)
    return Level(draft.level.tiles, (ObjectSpec(NINJA, (-400.0, -400.0)), drone, *doors))


def round_of(level: Level) -> PathPoints:
    """The places of the drone of a ``drone_round`` until it moves as before, px; at most a minute."""
    run, places = Simulation(level), dict[tuple[Point, Point], None]()
    drone = run.world.objects[2]
    now = drone.x, drone.y
    for _ in range(60 * TICKS_PER_SECOND):
        before = now
        run.step_keys(0)
        now = drone.x, drone.y
        if (before, now) in places:
            break
        places[before, now] = None
    return tuple(after for _, after in places)


def map_of(playtests: Iterable[Playtest]) -> PlaytestMap:
    visits: Counter[Cell] = Counter()
    deaths: list[Point] = []
    for level, inputs, over in playtests:
        # The tick of a death reads no input.
        whole = inputs + bytes([0]) * over
        run, route = run_of(level, whole), route_of(level, whole)
        visits.update(set(filter(is_inside, (cell_of(*place) for place in route if all(map(isfinite, place))))))
        deaths += route[-1:] if run and run.outcome == "dead" else ()
    return PlaytestMap(visits, tuple(deaths))


class Playtests:
    """All playtests of a level under edit; those of other versions may have met objects that are gone.

    ``shown``: those of the present version; ``last_deaths``: of the last of these; ``last_route``: of the last of all.
    """

    def __init__(self) -> None:
        self._by_version: dict[Level, tuple[Playtest, ...]] = {}
        self._version: Level | None = None
        self.maps = NewestJob(map_of)
        self.shown: tuple[Playtest, ...] = ()
        self.last_route: PathPoints = ()
        self.last_deaths: PathPoints = ()

    def add(self, version: Level, playtest: Playtest) -> None:
        """Add a playtest of a version. One that goes on after it was left is the same one."""
        earlier = self._by_version.get(version, ())
        last = earlier[-1] if earlier else None
        if last and not last.over and last.level is playtest.level and playtest.inputs.startswith(last.inputs):
            earlier = earlier[:-1]
        self._by_version[version] = (*earlier, playtest)
        self.last_route = route_of(playtest.level, playtest.inputs)
        self._version = None
        self.show(version)

    def show(self, version: Level) -> None:
        if version is self._version:
            return
        self._version, self.shown = version, self._by_version.get(version, ())
        self.last_deaths = map_of(self.shown[-1:]).deaths
        if self.shown:
            self.maps.ask(self.shown)

    @property
    def map(self) -> PlaytestMap | None:
        return self.maps.result if self.shown else None


def with_ninja_at(draft: Draft, place: Point) -> Level:
    return with_stamp(draft, Stamp({}, (placed(object_of_type("ninja"), *place, "px"),))).level


def lead_in(level: Level, inputs: bytes, tick: int) -> bytes:
    """The part of a run with which a playtest of a tick begins.

    It ends a second before, or where the ninja last stood if that is at most two seconds earlier.
    """
    run = Simulation(level)
    stood = alive = 0
    for number, keys in enumerate(inputs[: max(0, tick - TICKS)], 1):
        run.step_keys(keys)
        if run.outcome == "running":
            stood = stood if run.ninja.in_air else number
            alive = number
    return inputs[: stood if alive - stood <= 2 * TICKS else alive]


TOUCH = RADIUS + GOLD_RADIUS  # px between the ninja and gold or a switch that it touches


def place_before(draft: Draft, place: Point, size: Cell = FRAME_SIZE, *, touch: bool = False) -> Point | None:
    """Where the playtest of a message near a place begins, px; None if that is at the level's start.

    It is a cell beside the frame, or nearer if there is no room; between walls it is below or above. A ninja that
    presses nothing lives there. Cells with a floor and on the side of the start are preferred. Instead of a cell in the
    air it is the nearest floor from which the ninja gets into the frame, or, with ``touch``, to the place itself.
    ``size``: of the frame around the place, in cells.
    """
    column, row = cell_of(*place)
    start = next(iter(route_of(draft.level, bytes(1))), place)
    across, down = ((side / 2 + 1) * CELL for side in size)
    if abs(start[0] - place[0]) <= across and abs(start[1] - place[1]) <= down and start != place:
        return None
    side = 1 if start > place else -1
    strips = [
        [(column + dx * k, row + dy * k) for k in range(1, last + 1)]
        for dx, dy in ((side, 0), (-side, 0), (0, 1), (0, -1))
        for last in range(size[dy != 0] // 2 + 1, 0, -1)
    ]

    def rank(strip: list[Cell]) -> tuple[bool, int, int]:
        floor = -sum(draft.tile((x, y + 1)) != EMPTY for x, y in strip)
        upright = strip[0][0] == column
        return (upright, floor, -len(strip)) if upright else (upright, -len(strip), floor)

    for strip in sorted(strips, key=rank):
        if all(is_inside(cell) and draft.tile(cell) == EMPTY for cell in strip):
            run = run_of(with_ninja_at(draft, at := middle_of(strip[-1])), bytes(TICKS))
            if run and run.outcome != "dead":
                column, row = strip[-1]
                stands = draft.tile((column, row + 1)) != EMPTY
                reach = (TOUCH, TOUCH) if touch else (size[0] * CELL / 2, size[1] * CELL / 2)
                return at if stands else _floor_before(draft, place, reach) or at
    return None


def _floor_before(draft: Draft, place: Point, reach: Point) -> Point | None:
    """The nearest floor from which one of a few jumps comes within ``reach`` px of a place, across and down.

    It is two cells away or more; None: the search, which is bounded, found none.
    """
    column, row = cell_of(*place)
    cells = product(range(column - _AROUND, column + _AROUND + 1), range(row - 2, row + 2 * _AROUND))
    floors = [
        middle_of((x, y))
        for x, y in cells
        if is_inside((x, y)) and draft.tile((x, y)) == EMPTY and draft.tile((x, y + 1)) != EMPTY
    ]
    apart = [at for at in floors if dist(at, place) >= 2 * CELL]
    for at in sorted(apart, key=partial(dist, place))[:_FLOORS]:
        level, side = with_ninja_at(draft, at), KEY_RIGHT if at[0] < place[0] else KEY_LEFT
        if any(_comes_near(level, jump, place, reach) for jump in _jumps(side)):
            return at
    return None


def _jumps(side: int) -> Iterator[bytes]:
    """The keys of jumps, high and low: straight up, to a side, and there after a short or a longer run."""
    for before, during, run in ((0, 0, 4), (0, side, 4), (side, side, 6), (side, side, 12), (side, side, 24)):
        for hold in (TICKS, 4):
            keys = bytes([before]) * run + bytes([during | JUMP_HELD]) * hold + bytes([during]) * (2 * TICKS - hold)
            yield with_press_bits(keys)


def _comes_near(level: Level, keys: bytes, place: Point, reach: Point) -> bool:
    run = Simulation(level)
    for key in keys:
        run.step_keys(key)
        if run.outcome != "running":
            return False
        if abs(run.ninja.x - place[0]) <= reach[0] and abs(run.ninja.y - place[1]) <= reach[1]:
            return True
    return False
