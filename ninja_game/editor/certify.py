"""Routes through a level while it is edited: those of tests, and what the solver finds in its own thread."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import lru_cache
from math import isfinite
from struct import iter_unpack
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple

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

SECONDS, CLOSING_SECONDS = 20.0, 0.5
"""How long the solver looks for better runs, and how long it is waited for when the editor is left."""


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
    """The solver's work on a level: ``run``, the best one found, and its ``route``.

    ``progress``: the newest one, None until the solver is ready. ``end``: why it is over, "" as long as it is not;
    ``obstacles``: what kept it from a run in all its ``seconds``.
    """

    level: Level | None = None
    run: Replay | None = None
    route: Route = ()
    progress: Progress | None = None
    began: float = field(default_factory=monotonic)
    end: str = ""
    seconds: float = 0.0
    obstacles: tuple[Finding, ...] = ()

    @property
    def share(self) -> float:
        return min(1.0, self.progress.seconds / self.seconds) if self.progress else 0.0


class Certifier:
    """The solver in its own thread. ``search``: the newest one; one before it can change nothing any more."""

    def __init__(self, seconds: float = SECONDS) -> None:
        self.seconds = seconds
        self.search = Search()
        self._job: NewestJob[Search, None] = NewestJob(self._work)

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
            return f"Getting ready, {monotonic() - search.began:.0f} s: minutes the first time. Go on editing"
        return f"Looking for a run: {search.progress.worlds // 1000} thousand moments tried"

    @property
    def busy(self) -> bool:
        return self.search.level is not None and not (self.search.end or self._job.idle)

    def is_stale(self, level: Level) -> bool:
        """Whether there is a result, but of another level than this one."""
        return self.search.level is not None and level != self.search.level

    def start(self, level: Level) -> None:
        """Begin with a level, for twice as long as a time that found nothing; what was found before is forgotten."""
        self.stop()
        longer = 2 * self.search.seconds if self.search.obstacles and self.search.level == level else self.seconds
        if not compiled_available():
            self.search = Search(end=f"Certifying needs Numba: {how_to_install('fast')}")
            return
        self.search, self._job.problem = Search(level, seconds=longer), ""
        self._job.ask(self.search)

    def stop(self) -> None:
        """End the search; what was found stays. Nobody waits: a solver that is being compiled ends when it is ready."""
        if self.busy:
            self.search.end = "Stopped"

    def forget(self) -> None:
        """Stop, and know of no level any more."""
        self.stop()
        self.search, self._job.problem = Search(), ""

    def close(self) -> None:
        self.stop()
        self._job.finish(CLOSING_SECONDS)

    def _work(self, search: Search) -> None:
        def report(progress: Progress) -> None:
            if search.end:
                raise _StoppedError
            search.progress = progress

        def better(run: Replay) -> None:
            if search.end or search.level is None:
                raise _StoppedError
            search.run, search.route = run, route_of(search.level, run.inputs)

        if search.end or search.level is None:
            return
        with suppress(_StoppedError):
            from ninja_game.search.solve import Task, solve
            from ninja_game.search.task import obstacle

            found = solve(Task(search.level, seconds=search.seconds), report=report, on_better=better)
            if not found and search.progress:
                search.obstacles = (obstacle(search.level, 0, search.progress),)
        nothing = f"No run in {search.seconds:.0f} s: the first problem says why. F7 looks twice as long"
        search.end = search.end or ("Done" if search.run else nothing)
