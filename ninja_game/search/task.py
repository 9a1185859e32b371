"""The solver's task, the order of its searches, and the progress that its jobs share.

Coarse and greedy searches come first, then finer, patient and varied ones, then local searches. Work is counted in
ticks of a local search; a tick of a search counts more, because of its save-states and tables.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from threading import Event, Lock

from ninja_game.formats.replay.text import Replay
from ninja_game.levels.findings import Finding, level_finding
from ninja_game.levels.lint import object_name
from ninja_game.search.certificate import verified_run
from ninja_game.search.nodes import Resolution
from ninja_game.sim.kinds import EXIT, GOLD
from ninja_game.sim.level import Body, Level, makes_object

CANDIDATES = 4  # runs that are kept for local searches
_NAMED = 3  # objects that a finding of the solver names; it counts the others

Report = Callable[["Progress"], None]


@dataclass
class Progress:
    """The state of a solver. ``best``: end tick of the best run, -1: none yet.

    As long as there is no run, ``untouched`` holds the ids of exits and locked doors whose switch was never touched. If
    gold is wanted, ``gold`` is the most pieces collected at once, ``untaken`` the ids of pieces never collected, and
    ``last`` the ids of those that were the last of all: from there the search went on to the exit.
    """

    best: int = -1
    ticks: int = 0
    seconds: float = 0.0  #: since the start
    doing: str = ""  #: the present search, in words
    gold: int = 0
    untaken: tuple[int, ...] | None = None
    last: tuple[int, ...] = ()
    untouched: tuple[int, ...] | None = None


@dataclass(frozen=True)
class Task:
    """The solver's task: at least ``gold`` pieces (-1: all), within ``seconds`` or ``work`` ticks per job.

    ``first``: a run to shorten. ``others``: other runs of the level whose routes are shortened too. ``first_only``:
    stop at the first run found.
    """

    level: Level
    body: Body = "circle"
    gold: int = 0
    seconds: float = 60.0
    seed: int = 1
    jobs: int = 1  #: threads
    work: int = 0
    first: bytes = b""
    first_only: bool = False
    others: tuple[bytes, ...] = ()

    @property
    def gold_wanted(self) -> int:
        return self.level.gold if self.gold < 0 else self.gold

    @property
    def work_planned(self) -> float:
        """Ticks of work that a job plans with."""
        return self.work or self.seconds * WORK_PER_SECOND


def obstacle(level: Level, gold: int, progress: Progress) -> Finding:
    """Explain why a search found no run to the exit with this much gold, and where it failed."""
    numbers = [number for number, spec in enumerate(level.objects) if makes_object(spec)]

    def at(code: str, ids: Iterable[int]) -> Finding:
        names = [object_name(level.objects[numbers[id_]], id_) for id_ in ids]
        listed = ", ".join(names[:_NAMED]) + (f" and {len(names) - _NAMED} more" if len(names) > _NAMED else "")
        never = f"never {listed}" if names else "each piece now and then"
        records = tuple(numbers[id_] for id_ in ids) or tuple(n for n in numbers if level.objects[n].kind == GOLD)
        finding = level_finding(code, records, most=progress.gold, never=never)
        return finding if code == "gold-left" else finding._replace(names=listed)

    if gold > progress.gold and progress.untaken is not None:
        return at("gold-left", progress.untaken)
    if gold and progress.last:
        return at("gold-trap", progress.last)
    exits = [id_ for id_, number in enumerate(numbers) if level.objects[number].kind == EXIT]
    return at("untouched-switch", progress.untouched) if progress.untouched else at("unreached-exit", exits)


def _still_missing(earlier: tuple[int, ...] | None, ids: list[int]) -> tuple[int, ...]:
    return tuple(id_ for id_ in ids if earlier is None or id_ in earlier)


@dataclass
class SharedProgress:
    """The data that jobs share: the best runs, the work done, and the end."""

    task: Task
    report: Report | None  #: gets a copy of the progress after each part of the work
    began: float = field(default_factory=time.monotonic)  #: time.monotonic() at the start
    lock: Lock = field(default_factory=Lock)
    stop: Event = field(default_factory=Event)  #: set when the work ends for all jobs
    cancelled: Event = field(default_factory=Event)  #: set by the caller
    runs: list[bytes] = field(default_factory=list)
    best: Replay | None = None
    progress: Progress = field(default_factory=Progress)
    on_better: Callable[[Replay], None] | None = None  #: gets every new best run

    def submit(self, inputs: bytes) -> None:
        """Keep a run if it is among the best; a new best one is verified first."""
        with self.lock:
            if self.best is None or len(inputs) <= self.best.end_tick:
                task = self.task
                self.best = verified_run(task.level, inputs, body=task.body, gold=task.gold_wanted)
                self.progress.best = self.best.end_tick
                if self.on_better:
                    self.on_better(self.best)
            if inputs not in self.runs:
                self.runs = sorted([*self.runs, inputs], key=lambda run: (len(run), run))[:CANDIDATES]

    def note_unreached(
        self, untouched: list[int], most: int = 0, untaken: list[int] | None = None, last: Iterable[int] = ()
    ) -> None:
        """Record what a search never reached, and its gold, as ``Progress`` has them."""
        with self.lock:
            progress = self.progress
            progress.gold = max(progress.gold, most)
            progress.untouched = _still_missing(progress.untouched, untouched)
            progress.untaken = progress.untaken if untaken is None else _still_missing(progress.untaken, untaken)
            progress.last = tuple(sorted({*progress.last, *last}))
            if self.report:
                self.report(replace(progress))

    def count(self, ticks: int, doing: str) -> None:
        """Add work to the progress and show it."""
        with self.lock:
            self.progress.ticks += ticks
            self.progress.doing = doing
            self.progress.seconds = time.monotonic() - self.began
            if self.report:
                self.report(replace(self.progress))

    @property
    def is_over(self) -> bool:
        is_late = not self.task.work and time.monotonic() - self.began >= self.task.seconds
        return is_late or self.stop.is_set() or self.cancelled.is_set() or bool(self.task.first_only and self.best)


WORK_PER_SECOND = 6_000_000  # expected work of one thread; plans use this number, never the clock
SEARCH_COST = 2.0  # ticks of a local search that a tick of a search costs: its tables and save-states double the time

FIRST_RUN_SEARCHES = (
    (Resolution(), 8_000_000),
    (Resolution(enemy_cell=24.0), 12_000_000),
    (Resolution(cell=8.0, speed=0.5, macro=8, weight=1.5), 12_000_000),
    (Resolution(cell=12.0, speed=1.0, macro=6, weight=1.2, visits=20, patience=12, enemy_cell=24.0), 12_000_000),
    (Resolution(cell=12.0, speed=0.7, weight=2.0, visits=10), 16_000_000),
    (Resolution(cell=6.0, speed=0.5, macro=4, weight=2.0, enemy_cell=24.0, enemy_reach=150.0), 20_000_000),
    (Resolution(cell=9.0, speed=0.6, macro=6, weight=1.0, visits=4, patience=60, enemy_cell=24.0), 30_000_000),
    (Resolution(cell=5.0, speed=0.4, macro=4, weight=3.0, visits=2), 40_000_000),
    (Resolution(cell=10.0, speed=0.4, macro=7, jitter=4, weight=1.2, visits=6, patience=25), 40_000_000),
)
"""Searches for a first run, with their ticks; after the last one they repeat with other seeds.

Before each of them except the first, a run from switch to switch is searched for as long. The list was judged as a
whole on the reference levels (docs/solver.md); the numbers of a row were not tuned.
"""

OTHER_ROUTES = (
    Resolution(cell=8.0, speed=0.5, macro=8, weight=1.0),
    Resolution(cell=8.0, speed=0.4, macro=6, jitter=3, weight=1.1),
    Resolution(cell=6.0, speed=0.35, macro=6, weight=1.0, slack=0.2, off_table=0.3),
    Resolution(cell=12.0, speed=0.4, macro=7, weight=1.0),
    Resolution(cell=10.0, speed=0.35, macro=9, weight=1.2),
    Resolution(cell=6.0, speed=0.5, macro=10, weight=1.1),
)
"""Searches for other routes. The search before guides those with ``slack`` (share of the best run's ticks).

The list was judged as a whole on the reference levels (docs/solver.md); the numbers of a row were not tuned.
"""
OTHER_ROUTE_TICKS = 12_000_000
FOUND_BOUND = 0.05  # share by which a run found here may be longer than the best
GIVEN_BOUND = 0.15  # the same for a given run
OTHER_ROUTE_TURNS, GIVEN_ROUTE_TURNS = 4, 8
"""Once runs are shortened, one turn in this many searches another route: for found runs, and for a given one.

The second was tuned on twelve speedruns, 60 s each, 4 against 8: 7 and 2 ticks more on two, 1 less on one.
"""

GOLD_BEAM_TICKS = 12_000_000  # Ticks of beam search before a run with gold gets a local search. Not tuned.

SLICE = 1_000_000  # ticks between two looks at the clock
SHORT_LOCAL_TICKS = 3_000_000  # ticks of the local search from a run that the search of a span gave
COOLING = (6.0, 4.0, 2.5, 1.2, 0.4)  # Temperatures of a local search, ticks, in turn. Not tuned.


@dataclass(frozen=True)
class WorkPlan:
    """The division of a solver's work. Judged as a whole on the reference levels (docs/solver.md)."""

    routes_until: float = 0.25  #: share of the work that only searches other routes
    spans: int = 20_000_000  #: ticks of span searches per turn
    spans_with_gold: int = 6_000_000  #: ticks of span searches per turn if gold is wanted
    first_local: int = 20_000_000  #: ticks of the first local search of ``improve``
    local: int = 8_000_000  #: ticks of each later local search


def plan_first_run(job: int) -> Iterator[tuple[Resolution, int, int]]:
    """Resolution, ticks and seed number of the searches for a first run, in turn; each job starts elsewhere."""
    turn = job
    while True:
        resolution, ticks = FIRST_RUN_SEARCHES[turn % len(FIRST_RUN_SEARCHES)]
        yield resolution, ticks, turn
        turn += 1 if job == 0 else 4
