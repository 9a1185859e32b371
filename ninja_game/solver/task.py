"""A solver's task, and what its jobs share: the best runs, the progress, the end."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from threading import Event, Lock

from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import Level
from ninja_game.simulation import Body
from ninja_game.solver.certificate import VerifiedRun, verified_run
from ninja_game.solver.plan import WORK_PER_SECOND

CANDIDATES = 4
"""Runs that are remembered for local searches."""

Report = Callable[["Progress"], None]


@dataclass
class Progress:
    """Where a solver stands. ``best``: end tick of the best run, -1: none yet."""

    best: int = -1
    worlds: int = 0
    ticks: int = 0
    seconds: float = 0.0
    doing: str = ""


@dataclass(frozen=True)
class Task:
    """What to solve: ``gold`` pieces at least (-1: all), for ``seconds``, or for so many ticks of ``work`` a job."""

    level: Level
    body: Body = "circle"
    gold: int = 0
    seconds: float = 60.0
    seed: int = 1
    jobs: int = 1
    work: int = 0
    first: bytes = b""

    @property
    def gold_wanted(self) -> int:
        """Pieces of gold that a run must collect."""
        return sum(record.kind == GOLD for record in self.level.objects) if self.gold < 0 else self.gold

    @property
    def work_planned(self) -> float:
        """Ticks of work that each job plans with."""
        return self.work or self.seconds * WORK_PER_SECOND


@dataclass
class SearchState:
    """What the jobs share: the best runs, the count of work, and the end."""

    task: Task
    report: Report | None
    began: float = field(default_factory=time.monotonic)
    lock: Lock = field(default_factory=Lock)
    stop: Event = field(default_factory=Event)
    runs: list[bytes] = field(default_factory=list)
    best: VerifiedRun | None = None
    progress: Progress = field(default_factory=Progress)
    on_better: Callable[[VerifiedRun], None] | None = None

    def submit(self, inputs: bytes) -> None:
        """Remember a run if it is among the best; a new best one is verified first."""
        with self.lock:
            if self.best is None or len(inputs) <= self.best.end_tick:
                task = self.task
                self.best = verified_run(task.level, inputs, body=task.body, gold=task.gold_wanted)
                self.progress.best = self.best.end_tick
                if self.on_better:
                    self.on_better(self.best)
            if inputs not in self.runs:
                self.runs = sorted([*self.runs, inputs], key=lambda run: (len(run), run))[:CANDIDATES]

    def count(self, ticks: int, worlds: int, doing: str) -> None:
        """Add to the progress and show it."""
        with self.lock:
            self.progress.ticks += ticks
            self.progress.worlds += worlds
            self.progress.doing = doing
            self.progress.seconds = time.monotonic() - self.began
            if self.report:
                self.report(replace(self.progress))

    @property
    def over(self) -> bool:
        """Whether time is up or the caller wants to stop."""
        late = not self.task.work and time.monotonic() - self.began >= self.task.seconds
        return late or self.stop.is_set()
