"""The solver at work on levels under edit: its queue, and what it finds."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from threading import Event, Lock
from time import monotonic
from typing import TYPE_CHECKING

from ninja_game.backend.memories import compiled_available
from ninja_game.editor.playtests import PathPoints, route_of, run_of
from ninja_game.errors import reason
from ninja_game.formats.pack.pars import grade_of
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.findings import Finding
from ninja_game.runs.problems import passed_by
from ninja_game.runtime import NewestJob, install_hint
from ninja_game.sim.level import Level

if TYPE_CHECKING:
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.task import Progress

SECONDS = 20.0  # how long the solver looks for better runs


def preparing_text(*, compiles: bool) -> str:
    """What happens before the first search."""
    return "Compiling the solver, the first time on a machine a minute or more" if compiles else "Loading the solver"


@dataclass(eq=False)
class Certification:
    """The solver's work on a level, in its thread; the window's thread may add a run, or stop it."""

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
    grade: str = ""  #: the measured difficulty of the best run in a word, "" before the search is over
    known: tuple[bytes, ...] = ()  #: inputs of runs of the level as it was before, tried first
    stopping: Event = field(default_factory=Event)  #: set to end it
    lock: AbstractContextManager[object] = field(default_factory=Lock)  #: around changes by either thread

    def report(self, progress: Progress) -> None:
        self.progress = progress

    def take(self, run: Replay) -> None:
        """Keep a run of the level if it is the fastest, or the fastest with all gold."""
        assert self.level is not None  # noqa: S101 - for the type checker
        route = route_of(self.level, run.inputs)
        passed_by(self.level, [run])  # plays it, which is remembered, so that no thread waits for that at the lock
        with self.lock:
            if self.run is None or run.end_tick < self.run.end_tick:
                self.run, self.route = run, route
            if run.gold >= self.level.gold and (self.gold_run is None or run.end_tick < self.gold_run.end_tick):
                self.gold_run = run
            self.obstacles = passed_by(self.level, [known for known in (self.run, self.gold_run) if known])

    def finish(self, text: str, *, failed: bool = False, obstacles: tuple[Finding, ...] = ()) -> None:
        """End the work, unless it is over. ``obstacles``: why there is no run."""
        with self.lock:
            if not self.end:
                self.end, self.failed = text, failed
                self.obstacles = self.obstacles if self.run else obstacles

    @property
    def gold_text(self) -> str:
        """How much gold the best run takes, or the time of the best run with all; "" in a level without gold."""
        if not (self.run and self.level and self.level.gold):
            return ""
        if self.gold_run and self.gold_run.end_tick > self.run.end_tick:
            return f"all gold {seconds_text(self.gold_run.end_tick)} s"
        return "all gold" if self.gold_run else f"{self.run.gold} of {self.level.gold} gold"

    @property
    def share(self) -> float:
        return min(1.0, self.progress.seconds / self.seconds) if self.progress else 0.0


def search_of(level: Level, run: Replay) -> Certification:
    """A finished search with this run; without a run if it fails in the level."""
    certification = Certification(level, end="Done")
    played = run_of(level, run.inputs + bytes(1))  # the tick of the contact may read no input
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
        self.job: NewestJob[Certification, None] = NewestJob(self.work, every=True)

    def work(self, certification: Certification) -> None:
        if certification.end or certification.level is None:
            return
        self.at_work = certification
        try:
            from ninja_game.batch.difficulty import difficulty
            from ninja_game.search.solve import is_solver_compiled, solve
            from ninja_game.search.task import Task, obstacle

            self.compiles = not is_solver_compiled()
            task = Task(certification.level, seconds=certification.seconds, others=certification.known)
            result = solve(task, report=certification.report, on_better=certification.take, stop=certification.stopping)
            vain = certification.progress if not (result or certification.run or certification.end) else None
            obstacles = (obstacle(certification.level, 0, vain),) if vain else ()
            if run := certification.run:
                certification.grade = grade_of(difficulty(certification.level, run.inputs))
        except BaseException as error:
            certification.finish(reason(error), failed=True)
            raise
        nothing = f"No run in {certification.seconds:.0f} s: the first problem says why. F7 looks twice as long"
        certification.finish("Done" if certification.run else nothing, obstacles=obstacles)
        if certification.then and not certification.stopping.is_set():
            certification.then(certification)


class Certifier:
    """Certifies the level under edit. ``certification``: the newest one."""

    def __init__(self, solver: Solver) -> None:
        self.seconds, self.solver = SECONDS, solver
        self.certification = Certification()

    @property
    def text(self) -> str:
        """The state of the search in a line, "" before the first start; while kernels are compiled, for how long."""
        certification = self.certification
        if certification.run is not None and not certification.failed:
            more = [certification.gold_text, certification.grade, "shortening" * self.is_busy]
            return ", ".join(filter(None, (f"Certified: {seconds_text(certification.run.end_tick)} s", *more)))
        if certification.stopping.is_set() and certification.progress:
            return f"Stopped: no exit found in {certification.progress.seconds:.0f} s"
        if certification.end or certification.level is None:
            return certification.end
        if certification.progress is None:
            preparing = preparing_text(compiles=self.solver.compiles)
            why = preparing if self.is_compiling else "Another level's search comes first"
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
            certification.finish("Stopped")
            if certification.level and not certification.run:
                self.solver.stopped.add(certification.level)
            certification.stopping.set()

    def leave(self, then: Callable[[Certification], object] | None) -> None:
        """The level is closed. ``then``: called when its search, which goes on, has ended. None cancels it."""
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
