"""Analyses of a level under edit: routes of test runs, results of the solver, the places that can be reached."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from itertools import product, takewhile
from math import dist, isfinite
from struct import iter_unpack
from threading import Event
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

from ninja_game.backend.memories import compiled_available, open_worlds
from ninja_game.editor.brush import EMPTY, object_of_type, placed
from ninja_game.editor.draft import Draft
from ninja_game.editor.specs import object_type_name
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.errors import BudgetError, LevelError, NinjaGameError, reason
from ninja_game.formats.messages import FRAME_SIZE
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.findings import Finding, level_finding
from ninja_game.levels.lint import object_name
from ninja_game.runs.run import RunResult, run_level
from ninja_game.runtime import NewestJob, install_hint
from ninja_game.sim.events import LOCK_OPENED
from ninja_game.sim.grid import Cell, cell_of, is_inside, middle_of
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEY_LEFT, KEY_RIGHT, with_press_bits
from ninja_game.sim.kinds import DOOR, MOVING_ENEMIES, NINJA
from ninja_game.sim.level import Body, Level, ObjectSpec, makes_object
from ninja_game.sim.rules import CELL, GOLD_RADIUS, RADIUS, TICKS_PER_SECOND, TOP_SPEED, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.states import FALLING, JUMPING, OUTCOME_DEAD
from ninja_game.simulation import Simulation

if TYPE_CHECKING:
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.task import Progress

LOADING, COMPILING = "Loading the solver", "Compiling the solver, the first time on a machine a minute or more"

SECONDS = 20.0
"""How long the solver looks for better runs."""


PathPoints = tuple[tuple[float, float], ...]
"""The ninja's place after each tick, px."""


class Try(NamedTuple):
    """A test of the level in its state at that time. ``inputs``: a byte per tick; ``over``: it cannot be continued."""

    level: Level
    inputs: bytes
    over: bool


class TestMap(NamedTuple):
    """Many tests of a level: by cell the number of tests with the ninja in it; and the deaths, px."""

    visits: Mapping[Cell, int]
    deaths: PathPoints


@lru_cache(maxsize=300)
def _played(level: Level, inputs: bytes) -> RunResult | None:
    """The run of these inputs; None if it cannot be played, or costs too much."""
    try:
        return run_level(level, inputs, memory="plain")
    except (BudgetError, LevelError):
        return None


def route_of(level: Level, inputs: bytes) -> PathPoints:
    """The ninja's route to the end of the run or of the inputs; () if it cannot be played, or costs too much."""
    run = _played(level, inputs)
    return tuple(iter_unpack("<2d", run.places)) if run else ()


def drone_round(draft: Draft, drone: ObjectSpec) -> Level:
    """The tiles and doors of a level with one drone, for ``round_of``; the ninja is far away."""
    doors = (spec for spec in draft.objects if spec.kind == DOOR)
    return Level(draft.level.tiles, (ObjectSpec(NINJA, (-400.0, -400.0)), drone, *doors))


def round_of(level: Level) -> PathPoints:
    """The places of the drone of a ``drone_round`` until it moves as before, px; at most a minute."""
    run, places = Simulation(level), dict[tuple[tuple[float, float], tuple[float, float]], None]()
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


def map_of(tries: Iterable[Try]) -> TestMap:
    visits: Counter[Cell] = Counter()
    deaths: list[tuple[float, float]] = []
    for level, inputs, over in tries:
        # The tick of a death reads no input.
        whole = inputs + bytes([0]) * over
        run, route = _played(level, whole), route_of(level, whole)
        visits.update(set(filter(is_inside, (cell_of(*place) for place in route if all(map(isfinite, place))))))
        deaths += route[-1:] if run and run.outcome == "dead" else ()
    return TestMap(visits, tuple(deaths))


@dataclass(eq=False)
class Certification:
    """The solver's work on a level."""

    level: Level | None = None
    run: Replay | None = None  #: the best one that was found
    route: PathPoints = ()  #: of that run
    progress: Progress | None = None  #: the newest one; None until the solver is ready
    began: float = field(default_factory=monotonic)
    end: str = ""  #: why it is over; "" before that
    seconds: float = 0.0  #: for the search
    #: Why it found no run in all its seconds, or the doors that its run leaves closed
    obstacles: tuple[Finding, ...] = ()
    gold_run: Replay | None = None  #: the best run with all gold
    then: Callable[[Certification], object] | None = None  #: called at the end, in the solver's thread
    failed: bool = False  #: whether an error ended it
    known: tuple[bytes, ...] = ()  #: inputs of runs of the level as it was before, tried first
    stopping: Event = field(default_factory=Event)  #: set to end it

    def take(self, run: Replay) -> None:
        """Keep a run of the level if it is the fastest, or the fastest with all gold."""
        assert self.level is not None  # noqa: S101 - for the type checker
        if self.run is None or run.end_tick < self.run.end_tick:
            self.run, self.route = run, route_of(self.level, run.inputs)
        if run.gold >= self.level.gold and (self.gold_run is None or run.end_tick < self.gold_run.end_tick):
            self.gold_run = run
        self.obstacles = passed_by(self.level, [known for known in (self.run, self.gold_run) if known])

    @property
    def share(self) -> float:
        return min(1.0, self.progress.seconds / self.seconds) if self.progress else 0.0


@lru_cache(maxsize=300)
def _unlocked(level: Level, inputs: bytes, body: Body) -> set[tuple[float, float]]:
    """The places of the switches by which these inputs open doors, px. Cached, since the window's thread asks again."""
    run, opened = Simulation(level, body=body), set[tuple[float, float]]()
    for keys in inputs:
        run.step_keys(keys)
        events = run.world.events[: run.world.event_count]
        opened.update((event.x, event.y) for event in events if event.kind == LOCK_OPENED)
    return opened


def passed_by(level: Level, runs: Sequence[Replay]) -> tuple[Finding, ...]:
    """The locked doors whose switches none of these runs touches."""
    made = [number for number, spec in enumerate(level.objects) if makes_object(spec)]
    names = [object_type_name(level.objects[number]) for number in made]
    played = runs if "locked door" in names else ()
    opened = {place for run in played for place in _unlocked(level, run.inputs, run.body)}
    findings = []
    for id_, (number, name) in enumerate(zip(made, names, strict=True)):
        spec = level.objects[number]
        if name == "locked door" and spec.values[:2] not in opened:
            findings.append(level_finding("unneeded-door", (number,))._replace(names=object_name(spec, id_)))
    return tuple(findings)


def search_of(level: Level, run: Replay) -> Certification:
    """A finished search with this run; without a run if it fails in the level."""
    certification = Certification(level, end="Done")
    played = _played(level, run.inputs + bytes(1))  # the tick of the contact may read no input
    if played and played.outcome == "exit":
        certification.take(run)
    return certification


class Solver:
    """The solver in its own thread: one search after the other. Prepared kernels stay ready.

    ``left``: searches of closed levels, which continue. ``at_work``: the one begun last. ``stopped``: levels whose
    search was cancelled before it had a run. ``compiles``: whether the one at work waits for a compilation.
    """

    def __init__(self) -> None:
        self.left: list[Certification] = []
        self.stopped: set[Level] = set()
        self.at_work = Certification(end="Stopped")
        self.compiles = False
        self.job: NewestJob[Certification, None] = NewestJob(self._work, every=True)

    def _work(self, certification: Certification) -> None:
        if certification.end or certification.level is None:
            return
        self.at_work = certification
        try:
            from ninja_game.search.solve import is_compiled, solve
            from ninja_game.search.task import Task, obstacle

            self.compiles = not is_compiled()
            task = Task(certification.level, seconds=certification.seconds, others=certification.known)
            report = partial(setattr, certification, "progress")
            result = solve(task, report=report, on_better=certification.take, stop=certification.stopping)
            if not (result or certification.run or certification.end) and certification.progress:
                certification.obstacles = (obstacle(certification.level, 0, certification.progress),)
        except BaseException as error:
            certification.end, certification.failed = reason(error), True
            raise
        nothing = f"No run in {certification.seconds:.0f} s: the first problem says why. F7 looks twice as long"
        certification.end = certification.end or ("Done" if certification.run else nothing)
        if certification.then and not certification.stopping.is_set():
            certification.then(certification)


SOLVER = Solver()
"""Shared by all editors."""


class Certifier:
    """Certifies the level under edit. ``certification``: the newest one."""

    def __init__(self) -> None:
        self.seconds, self.solver, self.certification = SECONDS, SOLVER, Certification()

    @property
    def text(self) -> str:
        """The state of the search in a line, "" before the first start; while kernels are compiled, for how long."""
        certification = self.certification
        if certification.run is not None and not certification.failed:
            gold = f", {certification.run.gold} gold" if certification.run.gold else ""
            shortening = ", shortening" if self.is_busy else ""
            return f"Certified: {seconds_text(certification.run.end_tick)} s{gold}{shortening}"
        if certification.stopping.is_set() and certification.progress:
            return f"Stopped: no exit found in {certification.progress.seconds:.0f} s"
        if certification.end or certification.level is None:
            return certification.end
        if certification.progress is None:
            why = COMPILING if self.solver.compiles else LOADING
            why = why if self.is_compiling else "Another level's search comes first"
            waited = self.waited if self.is_compiling else f"{self.waited} in the queue"
            return f"{why}: {waited}. Go on editing, or save and leave"
        ticks = certification.progress.ticks
        tried = f"{ticks / 1e6:.1f} million" if ticks >= 1e6 else f"{ticks // 1000} thousand"
        return f"Looking for a run: {tried} ticks tried"

    @property
    def place_in_queue(self) -> int:
        """Its place among the searches that wait, from 1; 0 while it is at work."""
        queued = self.certification is not self.solver.at_work and not self.solver.at_work.end
        return queued * (1 + sum(not other.end for other in self.solver.left))

    @property
    def waited(self) -> str:
        """Its place in the queue, or for how long it has been at work."""
        certification, place = self.certification, self.place_in_queue
        seconds = certification.progress.seconds if certification.progress else monotonic() - certification.began
        return f"#{place}" if place else f"{seconds:.0f} s"

    @property
    def is_busy(self) -> bool:
        return self.certification.level is not None and not self.certification.end

    @property
    def is_compiling(self) -> bool:
        """Whether the solver is made ready for the search: nothing can be stopped."""
        return self.is_busy and self.certification.progress is None and not self.place_in_queue

    @property
    def is_waiting(self) -> bool:
        """Whether the search has begun without any report yet."""
        return self.is_busy and self.certification.progress is None and self.certification.run is None

    def is_stale(self, level: Level) -> bool:
        """Whether there is a result, but for another level than this one."""
        return self.certification.level is not None and level != self.certification.level

    def start(self, level: Level) -> None:
        """Begin to search a level, for twice as long as an earlier search that failed.

        Known runs stay; those of the level before its change are tried first.
        """
        before, waits = self.certification, self.is_waiting
        self.stop()
        longer = 2 * before.seconds if before.obstacles and not before.run and before.level == level else self.seconds
        if not compiled_available():
            self.certification = Certification(end=f"Certifying needs Numba: {install_hint('fast')}")
            return
        # The shorter of two known runs comes last: the solver reports a run only if it is no longer than those before.
        known = tuple(run.inputs for run in (before.gold_run, before.run) if run) or before.known
        began = before.began if waits else monotonic()
        self.certification = Certification(level, seconds=longer, began=began, known=known)
        for run in (before.run, before.gold_run) if before.level == level else ():
            if run:
                self.certification.take(run)
        self.solver.stopped.discard(level)
        self.solver.job.ask(self.certification)

    def adopt(self, certification: Certification) -> None:
        """Use a known result for a level until the solver finds a better one; one without a run changes nothing."""
        if certification.run and self.certification.level != certification.level:
            self.stop()
            self.certification = certification
        elif certification.run:
            self.certification.take(certification.run)

    def stop(self) -> None:
        """Cancel the search; its results stay. It does not wait: kernels being compiled are finished first."""
        certification = self.certification
        if self.is_busy:
            certification.end = "Stopped"
            if certification.level and not certification.run:
                self.solver.stopped.add(certification.level)
            certification.stopping.set()

    def leave(self, then: Callable[[Certification], object] | None) -> None:
        """The level is closed. ``then``: called when its search, which continues, has ended; None: cancel it."""
        self.certification.then = then
        if then is None:
            self.stop()
        self.solver.left = [one for one in (*self.solver.left, self.certification) if one.then and not one.end]

    def edit(self, level: Level) -> None:
        """Another level is under edit, perhaps one with a running search."""
        self.certification = next(
            (old for old in self.solver.left if old.level == level and not old.end), Certification()
        )
        self.certification.then = None


TICKS = TICKS_PER_SECOND
"""Ticks simulated for the overlay, and least ticks of a test before its message: a second."""

_AROUND, _FLOORS = 8, 16
"""How many cells around a place, below it twice as many, and how many floors there, a test may begin on."""

STARTS = {"off": None, "standing": 0.0, "running right": TOP_SPEED, "running left": -TOP_SPEED}
"""Speeds at the start to the right, px/tick; "off": nothing is shown."""

SQUARE = 4.0
"""Side of the squares in which reached places are shown, px."""

SquareRow = tuple[float, float, float]
"""Squares side by side: left edge, top, width, px."""


class Ask(NamedTuple):
    """The start of the runs: a point, px, and the speed to the right, px/tick."""

    draft: Draft
    place: tuple[float, float]
    speed: float


class Reach(NamedTuple):
    """What the ninja can reach from a place. ``spans``: of its centre; ``deaths``: its deaths there.

    ``arcs``: some of the jumps. ``latest``: the last places to jump from before the floor ends under a runner.
    ``dangers``: the routes of drones, guards, thwumps and rockets while the ninja presses nothing.
    """

    ask: Ask
    spans: tuple[SquareRow, ...]
    deaths: tuple[SquareRow, ...]
    arcs: tuple[PathPoints, ...]
    latest: PathPoints
    dangers: tuple[PathPoints, ...]


LANDED_TICK = 4
"""The first tick in which a ninja that was placed on the floor stands and can jump."""

_BOUNCE = 9
"""Ticks for which jumps at walls hold the jump key."""


class _Plan(NamedTuple):
    """The keys of one run: ``run`` until it jumps at tick ``jump`` and holds that key ``hold`` ticks, ``steer`` then.

    Directions are -1, 0 or 1. ``wall``: jump again at each wall touched in the air, away from it if 1, up it if 2; 0:
    slide.
    """

    run: int
    jump: int = TICKS
    hold: int = 0
    steer: int = 0
    wall: int = 0


def _fan() -> Iterator[_Plan]:
    """All runs to try; the first presses nothing, the last ones jump at walls."""
    yield from (_Plan(side, steer=side) for side in (0, -1, 1))
    for steer in (-1, 0, 1):
        yield from (_Plan(0, jump, hold, steer) for jump in (LANDED_TICK, 20) for hold in (1, 3, 6, 10, 16, TICKS))
        for side in (-1, 1):
            yield from (_Plan(side, jump, TICKS, steer) for jump in range(1, TICKS))
            yield from (_Plan(side, jump, hold, steer) for jump in range(1, TICKS, 3) for hold in (1, 4, 9))
    for side in (-1, 1):
        yield from (_Plan(side, jump, _BOUNCE, side, wall) for jump in range(1, TICKS, 4) for wall in (1, 2))


FAN = tuple(_fan())
_FIRST_WALL = next(number for number, plan in enumerate(FAN) if plan.wall)


def with_ninja_at(draft: Draft, place: tuple[float, float]) -> Level:
    return with_stamp(draft, Stamp({}, (placed(object_of_type("ninja"), *place, "px"),))).level


def lead_in(level: Level, inputs: bytes, tick: int) -> bytes:
    """The part of a run with which a test of a tick begins.

    It ends a second before, or where the ninja last stood if that is at most two seconds earlier.
    """
    run, stood, alive = Simulation(level), 0, 0
    for number, keys in enumerate(inputs[: max(0, tick - TICKS)], 1):
        run.step_keys(keys)
        if run.outcome == "running":
            stood, alive = stood if run.ninja.in_air else number, number
    return inputs[: stood if alive - stood <= 2 * TICKS else alive]


TOUCH = RADIUS + GOLD_RADIUS
"""px between the ninja and gold or a switch that it touches."""


def place_before(
    draft: Draft, place: tuple[float, float], size: Cell = FRAME_SIZE, *, touch: bool = False
) -> tuple[float, float] | None:
    """Where the test of a message near a place begins, px; None: at the level's start.

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
            run = _played(with_ninja_at(draft, at := middle_of(strip[-1])), bytes(TICKS))
            if run and run.outcome != "dead":
                column, row = strip[-1]
                stands = draft.tile((column, row + 1)) != EMPTY
                reach = (TOUCH, TOUCH) if touch else (size[0] * CELL / 2, size[1] * CELL / 2)
                return at if stands else _floor_before(draft, place, reach) or at
    return None


def _floor_before(draft: Draft, place: tuple[float, float], reach: tuple[float, float]) -> tuple[float, float] | None:
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


def _comes_near(level: Level, keys: bytes, place: tuple[float, float], reach: tuple[float, float]) -> bool:
    run = Simulation(level)
    for key in keys:
        run.step_keys(key)
        if run.outcome != "running":
            return False
        if abs(run.ninja.x - place[0]) <= reach[0] and abs(run.ninja.y - place[1]) <= reach[1]:
            return True
    return False


def find_reach(ask: Ask) -> Reach:
    """Run the fan. Raises LevelError for a level that cannot be played, NinjaGameError without Numba."""
    if not compiled_available():
        raise NinjaGameError(f"What can be reached needs Numba: {install_hint('fast')}")
    worlds = open_worlds("compiled", with_ninja_at(ask.draft, ask.place), len(FAN), box=False)
    import numpy as np

    ninja = worlds.records["ninja"]
    ninja["prev_x"] -= ask.speed
    going, jump, hold, steer, wall = np.array(FAN, np.int16).T
    climbers, climbing = ninja[_FIRST_WALL:], wall[_FIRST_WALL:]
    places, states = np.empty((TICKS + 1, len(FAN), 2)), np.empty((TICKS + 1, len(FAN)), np.uint8)
    objects = worlds.records["objects"][0, : int(worlds.records["slots_used"][0])]
    dangers = np.flatnonzero(np.isin(objects["kind"], MOVING_ENEMIES))
    clock = np.empty((TICKS + 1, len(dangers), 2))
    until, bounces = np.zeros(len(FAN), np.int16), np.zeros(len(FAN), bool)
    for tick in range(TICKS + 1):
        places[tick, :, 0], places[tick, :, 1], states[tick] = ninja["x"], ninja["y"], ninja["state"]
        clock[tick, :, 0], clock[tick, :, 1] = objects["x"][dangers], objects["y"][dangers]
        there = (climbers["near_wall"] > 0) & (climbers["in_air"] > 0) & (tick > jump[_FIRST_WALL:] + 4)
        bounces[_FIRST_WALL:] = there & (until[_FIRST_WALL:] < tick)
        going = np.where(jump == tick, steer, going)
        going[_FIRST_WALL:] = np.where(there & (climbing == 1), np.sign(climbers["wall_x"]), going[_FIRST_WALL:])
        begins = (jump == tick) | bounces
        until = np.where(begins, tick + np.where(bounces, _BOUNCE, hold), until)
        down = until > tick
        keys = np.select([going < 0, going > 0], [KEY_LEFT, KEY_RIGHT], 0)
        keys += down * JUMP_HELD + begins * JUMP_PRESSED
        worlds.run_batch(np.require(keys[np.newaxis], np.uint8, ["C", "W"]), 0, len(FAN), stop=True)
    latest: list[tuple[float, float]] = []
    shown = [*(FAN.index(_Plan(0, LANDED_TICK, hold, steer)) for steer in (-1, 0, 1) for hold in (1, TICKS))]
    for side in (-1, 1):
        walks = FAN.index(_Plan(side, steer=side))
        jumps = [FAN.index(_Plan(side, tick, TICKS, side)) for tick in range(1, TICKS)]
        shown.append(walks)
        gone = states[:, walks] == FALLING
        falls = [t for t in range(1, TICKS - 3) if gone[t : t + 4].all() and not gone[t - 1]]
        before = [n for n in jumps if falls and FAN[n].jump <= falls[0] and states[FAN[n].jump + 1, n] == JUMPING]
        if before:
            late = FAN[before[-1]].jump
            latest += _route(places[late : late + 1, walks])
            shown.append(before[-1])
    ends = places[-1][worlds.records["outcome"] == OUTCOME_DEAD]
    return Reach(
        ask,
        _spans(places.reshape(-1, 2)),
        _spans(ends),
        tuple(_route(places[:, n]) for n in shown),
        tuple(latest),
        tuple(_route(clock[:, n]) for n in range(len(dangers))),
    )


def _route(places: Any) -> PathPoints:
    """The points of an array (ticks, 2) up to the first NaN."""
    return tuple(takewhile(lambda point: isfinite(sum(point)), map(tuple, places.tolist())))


def _spans(places: Any) -> tuple[SquareRow, ...]:
    """The squares with any of these points (points, 2) in the level, merged where they touch."""
    import numpy as np

    columns = int(WORLD_WIDTH // SQUARE) + 1
    inside = places[((places >= 0) & (places < (WORLD_WIDTH, WORLD_HEIGHT))).all(axis=1)]
    cells = np.unique((inside // SQUARE).astype(np.intp) @ (1, columns))
    rows = np.split(cells, np.flatnonzero(np.diff(cells) > 1) + 1) if len(cells) else []
    return tuple((SQUARE * (row[0] % columns), SQUARE * (row[0] // columns), SQUARE * len(row)) for row in rows)
