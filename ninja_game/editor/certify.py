"""Routes through a level while it is edited: those of tests, and what the solver finds in its own thread."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import lru_cache
from math import isfinite
from struct import iter_unpack
from time import monotonic
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from ninja_game.backend.memories import compiled_available
from ninja_game.editor.draft import Cell, cell_of, is_inside
from ninja_game.errors import BudgetError, LevelError
from ninja_game.files.user_folder import how_to_install
from ninja_game.levels.findings import Finding
from ninja_game.runs.run import RunResult, run_level
from ninja_game.runtime import NewestJob
from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND

if TYPE_CHECKING:
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.task import Progress

SECONDS, STOPPED = 20.0, "Stopped"
"""How long the solver looks for better runs; the end of a search that nobody wants any more."""


Route = tuple[tuple[float, float], ...]
"""Where the ninja was after each tick, px."""


class Try(NamedTuple):
    """A test of the level as it was then. ``inputs``: a byte a tick; ``over``: whether it may not go on."""

    level: Level
    inputs: bytes
    over: bool


class TestMap(NamedTuple):
    """Many tests of a level: in how many the ninja was in each cell, and where it died, px."""

    visits: Mapping[Cell, int]
    deaths: Route


NO_TESTS = TestMap({}, ())


@lru_cache(maxsize=300)
def _played(level: Level, inputs: bytes) -> RunResult | None:
    """The run of these inputs; None where it cannot be played, or costs too much."""
    try:
        return run_level(level, inputs, memory="plain")
    except (BudgetError, LevelError):
        return None


def route_of(level: Level, inputs: bytes) -> Route:
    """The ninja's route to the end of the run or of the inputs; () where it cannot be played, or costs too much."""
    run = _played(level, inputs)
    return tuple(iter_unpack("<2d", run.places)) if run else ()


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


class _StoppedError(Exception):
    """Ends the solver from within its report."""


@dataclass(eq=False)
class Search:
    """The solver's work on a level: ``run``, the best one found, and its ``route``; ``full``: the best with all gold.

    ``progress``: the newest one, None until the solver is ready. ``end``: why it is over, "" as long as it is not;
    ``obstacles``: what kept it from a run in all its ``seconds``. ``then``: called at the end, in the solver's thread.
    """

    level: Level | None = None
    run: Replay | None = None
    route: Route = ()
    progress: Progress | None = None
    began: float = field(default_factory=monotonic)
    end: str = ""
    seconds: float = 0.0
    obstacles: tuple[Finding, ...] = ()
    full: Replay | None = None
    then: Callable[[Search], object] | None = None

    def take(self, run: Replay) -> None:
        """A run of the level is kept if it is the fastest, or the fastest with all gold."""
        assert self.level is not None  # noqa: S101 - for the type checker
        if self.run is None or run.end_tick < self.run.end_tick:
            self.run, self.route = run, route_of(self.level, run.inputs)
        if run.gold >= self.level.gold and (self.full is None or run.end_tick < self.full.end_tick):
            self.full = run

    @property
    def share(self) -> float:
        """The share of the time that is over."""
        return min(1.0, self.progress.seconds / self.seconds) if self.progress else 0.0


class Certifier:
    """The solver in its own thread, the same for all editors: what it has made ready once stays so.

    ``search``: the newest one of the level under edit. Those of levels that were left go on, one after the other.
    """

    _left: ClassVar[list[Search]] = []
    _at_work: ClassVar[Search] = Search(end=STOPPED)

    def __init__(self, seconds: float = SECONDS) -> None:
        self.seconds = seconds
        self.search = Search()

    @property
    def text(self) -> str:
        """How it stands, in a line, "" before the first start; while the solver is made ready, for how long."""
        search = self.search
        if self._job.problem:
            return self._job.problem
        if search.run is not None:
            gold = f", {search.run.gold} gold" if search.run.gold else ""
            shortening = ", shortening" * self.busy
            return f"Certified: {search.run.end_tick / TICKS_PER_SECOND:.2f} s{gold}{shortening}"
        if search.end or search.level is None:
            return search.end
        if search.progress is None:
            if search is not self._at_work and not self._at_work.end:
                return "Another level's search comes first. Go on editing, or save and leave: it goes on"
            waited = f"{monotonic() - search.began:.0f} s"
            return f"Getting ready, {waited}: minutes the first time. Go on editing, or save and leave: it goes on"
        return f"Looking for a run: {search.progress.worlds // 1000} thousand moments tried"

    @property
    def busy(self) -> bool:
        """Whether the solver is at work on the newest search."""
        return self.search.level is not None and not (self.search.end or self._job.idle)

    def is_stale(self, level: Level) -> bool:
        """Whether there is a result, but of another level than this one."""
        return self.search.level is not None and level != self.search.level

    def start(self, level: Level) -> None:
        """Begin with a level, for twice as long as a time that found nothing; known runs of this level stay."""
        self.stop()
        before = self.search
        longer = 2 * self.search.seconds if self.search.obstacles and self.search.level == level else self.seconds
        if not compiled_available():
            self.search = Search(end=f"Certifying needs Numba: {how_to_install('fast')}")
            return
        self.search, self._job.problem = Search(level, seconds=longer), ""
        for run in (before.run, before.full) if before.level == level else ():
            if run:
                self.search.take(run)
        self._job.ask(self.search)

    def passed(self, level: Level, run: Replay) -> None:
        """A player's own run certifies a level, until the solver has a better one."""
        if self.search.level != level:
            self.stop()
            self.search = Search(level, end="Done")
        self.search.take(run)

    def stop(self) -> None:
        """End the search; what was found stays. Nobody waits: a solver that is being compiled ends when it is ready."""
        if self.busy:
            self.search.end = STOPPED

    def leave(self, then: Callable[[Search], object] | None) -> None:
        """The level is left. ``then``: called when its search, which goes on, has ended; None: it is stopped."""
        self.search.then = then
        if then is None:
            self.stop()
        self._left[:] = [each for each in (*self._left, self.search) if each.then and not each.end]

    def edit(self, level: Level) -> None:
        """Another level is under edit, perhaps one whose search goes on."""
        self.search = next((each for each in self._left if each.level == level and not each.end), Search())
        self._job.problem = ""

    @staticmethod
    def _work(search: Search) -> None:
        def report(progress: Progress) -> None:
            if search.end:
                raise _StoppedError
            search.progress = progress

        def better(run: Replay) -> None:
            if search.end:
                raise _StoppedError
            search.take(run)

        if search.end or search.level is None:
            return
        Certifier._at_work = search
        with suppress(_StoppedError):
            from ninja_game.search.solve import Task, solve
            from ninja_game.search.task import obstacle

            found = solve(Task(search.level, seconds=search.seconds), report=report, on_better=better)
            if not (found or search.run) and search.progress:
                search.obstacles = (obstacle(search.level, 0, search.progress),)
        nothing = f"No run in {search.seconds:.0f} s: the first problem says why. F7 looks twice as long"
        search.end = search.end or ("Done" if search.run else nothing)
        if search.then and search.end != STOPPED:
            search.then(search)

    _job: ClassVar[NewestJob[Search, None]] = NewestJob(_work, every=True)
