"""Routes through a level while it is edited: those of tests, and what the solver finds in its own thread."""

from __future__ import annotations

from struct import iter_unpack
from time import monotonic
from typing import TYPE_CHECKING

from ninja_game.backend.memories import compiled_available
from ninja_game.editor.background import NewestJob
from ninja_game.errors import BudgetError, LevelError
from ninja_game.files.user_folder import how_to_install
from ninja_game.runs.run import run_level
from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Body

if TYPE_CHECKING:
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.task import Progress

SECONDS = 20.0
"""How long the solver looks for better runs."""


Route = tuple[tuple[float, float], ...]
"""Where the ninja was after each tick, px."""


def route_of(level: Level, inputs: bytes, body: Body = "circle") -> Route:
    """The ninja's route to the end of the run or of the inputs; () where it cannot be played, or costs too much."""
    try:
        return tuple(iter_unpack("<2d", run_level(level, inputs, body=body, memory="plain").places))
    except (BudgetError, LevelError):
        return ()


class _StoppedError(Exception):
    """Ends the solver from within its report."""


class Certifier:
    """The solver at work: ``run``, the best one found for ``level``, and its ``route``; ``share`` of the work done."""

    def __init__(self, seconds: float = SECONDS) -> None:
        self.seconds = seconds
        self.level: Level | None = None
        self.run: Replay | None = None
        self.route: Route = ()
        self.share = 0.0
        self._said = ""
        self._began = 0.0
        self._job: NewestJob[Level, None] = NewestJob(self._work)
        self._stop = False

    @property
    def text(self) -> str:
        """How it stands, in a line, "" before the first start; while the solver is made ready, for how long."""
        if self.level is None or self._said or self._job.problem:
            return self._job.problem or self._said
        return f"Getting ready, {monotonic() - self._began:.0f} s: minutes the first time. Go on editing"

    @property
    def busy(self) -> bool:
        """Whether the solver is at work."""
        return not self._job.idle

    def is_stale(self, level: Level) -> bool:
        """Whether there is a result, but of another level than this one."""
        return self.level is not None and level != self.level

    def start(self, level: Level) -> None:
        """Begin with a level; what was found for another one is forgotten."""
        self.stop()
        if not compiled_available():
            self._said = f"Certifying needs Numba: {how_to_install('fast')}"
            return
        self.level, self.run, self.route, self.share = level, None, (), 0.0
        self._said, self._began = "", monotonic()
        self._stop = False
        self._job.ask(level)

    def stop(self) -> None:
        """End the search; what was found stays."""
        self._stop = True
        self._job.finish(5.0)

    def _work(self, level: Level) -> None:
        def report(progress: Progress) -> None:
            if self._stop or level is not self.level:
                raise _StoppedError
            self.share = min(1.0, progress.seconds / self.seconds)
            if self.run is None:
                self._said = f"Looking for a run: {progress.worlds // 1000} thousand moments tried"
            else:
                self._said = f"{self._found()}, shortening"

        def better(run: Replay) -> None:
            self.run, self.route = run, route_of(level, run.inputs)

        try:
            from ninja_game.search.solve import Task, solve

            solve(Task(level, seconds=self.seconds), report=report, on_better=better)
        except _StoppedError:
            pass
        self.share = 1.0
        self._said = self._found() if self.run else "No run found in the time; that proves nothing"

    def _found(self) -> str:
        assert self.run is not None  # noqa: S101 - asked only then
        gold = f", {self.run.gold} gold" if self.run.gold else ""
        return f"Certified: {self.run.end_tick / TICKS_PER_SECOND:.2f} s{gold}"
