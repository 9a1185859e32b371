"""A search of a span in the background: start it, read its results at any time, cancel it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from threading import Event, Lock, Thread
from time import monotonic
from typing import TYPE_CHECKING

import numpy as np

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ArgumentError
from ninja_game.formats.replay.text import Replay
from ninja_game.runs.run import run_level
from ninja_game.runtime import cores, require_desktop, run_in_background
from ninja_game.search.certificate import UnverifiedRunError, with_plain_triggers, without_idle_keys
from ninja_game.search.formula.methods import METHODS, search_span, to_exit
from ninja_game.search.formula.task import SpanResult, SpanTask, without_useless_keys
from ninja_game.sim.inputs import KEYS_DOWN, fit_inputs, with_press_bits

if TYPE_CHECKING:
    from ninja_game.search.task import Task


class SpanSearch:
    """A search in its own thread, on ``jobs`` threads (one per core), for ``seconds`` (0: until it is cancelled).

    ``method``, ``every`` and ``memory``: as in ``search_span``. ``results``: the best results so far, best first, each
    with the whole run; a better list replaces the old one. ``own``: the result of the run's own keys, None if they miss
    the goal. ``miss``: the nearest result as long as nothing has reached the goal, None if nothing comes near.
    ``ticks_run``: ticks simulated. ``problem``: why the search could not continue, "" if it could.

    Compiled code runs without the interpreter's lock, so a window still responds. Raises FormulaError for a broken
    formula, ArgumentError for an unknown method, NinjaGameError in a page, which has no threads.
    """

    def __init__(
        self,
        task: SpanTask,
        method: str = "auto",
        jobs: int | None = None,
        *,
        seconds: float = 0.0,
        every: int = 1,
        memory: str = "auto",
    ) -> None:
        require_desktop()
        if method not in ("auto", *METHODS):
            raise ArgumentError(f"method is {method!r}; expected 'auto', {', '.join(map(repr, METHODS))}")
        task.check()
        self.task = task
        self.results: tuple[SpanResult, ...] = ()
        self._tidy: dict[bytes, SpanResult] = {}
        self.own: SpanResult | None = None
        self.miss: SpanResult | None = None
        self.ticks_run = 0
        self.problem = ""
        self._options = {"method": method, "every": every, "memory": memory, "threads": jobs}
        self._limit = seconds
        self._cancelled = Event()
        self._thread: Thread | None = None
        self._began = self._ended = 0.0

    def start(self) -> None:
        """Begin; a second call does nothing."""
        if self._thread is None:
            self._thread = run_in_background(self._work, self._fail)

    def cancel(self) -> None:
        """End the search within the time of one round of trials, without waiting for it; its results stay."""
        self._cancelled.set()

    def finish(self, seconds: float = 10.0) -> None:
        """Wait until the search is over, at most this long."""
        if self._thread is not None and not self.done:
            self._thread.join(seconds)

    @property
    def done(self) -> bool:
        """Whether the search was started and is over.

        A search that is cancelled while kernels are compiled is over at once. Nothing can stop the compiler; it
        finishes in the background, for the next search.
        """
        return bool(self._ended) or (self._thread is not None and self._cancelled.is_set() and not self._began)

    @property
    def seconds(self) -> float:
        """The time the search has run, s; 0 during preparation, which takes a while if kernels must be compiled."""
        return (self._ended or monotonic()) - self._began if self._began else 0.0

    def _work(self) -> None:
        report_miss = partial(setattr, self, "miss")
        results = search_span(self.task, self._report, report_miss=report_miss, **self._options)  # type: ignore[arg-type]
        self.results = self._without_idle_keys(results, np.inf)
        self._ended = monotonic()

    def _fail(self, why: str) -> None:
        self.problem, self._ended = why, monotonic()

    def _report(self, ticks: int, results: tuple[SpanResult, ...]) -> bool:
        if not self._began:
            if self._cancelled.is_set():
                return False
            # The first results are those of the run's own keys.
            self._began = monotonic()
            self.own = results[0] if results else None
            if compiled_available() and self._options["memory"] != "plain":
                from ninja_game.search.solve import compile_solver  # few searches are of a whole run

                run_in_background(compile_solver, lambda _: None)
        self.ticks_run = ticks
        self.results = self._without_idle_keys(results, TIDYING_SECONDS)
        late = self._limit and self.seconds >= self._limit
        return not (late or self._cancelled.is_set())

    def _without_idle_keys(self, results: tuple[SpanResult, ...], seconds: float) -> tuple[SpanResult, ...]:
        """Remove keys that do nothing from results, from as many as there is time for; the others stay as they are."""
        late, known = monotonic() + seconds, self._tidy
        self._tidy = {result.inputs: known[result.inputs] for result in results if result.inputs in known}
        for result in results:
            if result.inputs not in self._tidy and monotonic() < late:
                self._tidy[result.inputs] = without_useless_keys(self.task, result)
        return tuple(self._tidy.get(result.inputs, result) for result in results)


TIDYING_SECONDS = 0.1  # seconds per report for the removal of idle keys
_MAX_SECONDS = 1e6  # the time limit, s, of a search that ends only when it is cancelled
MAX_JOBS = 4  # jobs of a search of a whole run; a job may take a gigabyte
WAY_SECONDS = 120.0  # most seconds of the search for a way to the exit, for a run that ends before it
NO_WAY = "No way to the exit was found from the end of this run: select ticks before, and take Reach the exit sooner."


class RunSearch(SpanSearch):
    """A search that shortens a whole run, ``task.inputs``, as `ninja-game improve` does.

    A run that ends before the exit is first continued to it. ``gold``: pieces that it must still take. The routes of
    ``task.others`` are shortened too. ``results``: the runs by its own route and by all routes that no other
    one beats in ticks and gold.
    """

    def __init__(self, task: SpanTask, jobs: int | None = None, *, gold: int = 0) -> None:
        from ninja_game.search.task import Task

        super().__init__(task)
        threads = min(jobs or cores(), MAX_JOBS)
        first = fit_inputs(task.inputs, task.length)
        self._wanted = Task(task.level, task.body, gold, _MAX_SECONDS, jobs=threads, first=first, others=task.others)
        self._reaches = False
        self._lock = Lock()
        self._ticks = {True: 0, False: 0}
        self._unbeaten: dict[bool, tuple[SpanResult, ...]] = {True: (), False: ()}

    def _work(self) -> None:
        """Shorten the run by its own route and, at the same time, by the routes of all runs."""
        task, mixed_job = self._wanted, None
        played = run_level(task.level, task.first, body=task.body)
        self._reaches = played.outcome == "exit"
        others = tuple(filter(self._counts, task.others))
        own = replace(task, others=(), jobs=max(1, task.jobs // 2) if others else task.jobs)
        if others:
            known = (own.first, *others) if self._reaches else others
            mixed = partial(self._shorten, replace(own, first=known[0], others=known[1:]), own_route=False)
            mixed_job = run_in_background(mixed, self._fail_beside)
        if not self._reaches:
            own = self._led_to_exit(own, played.ticks)
        if own.first:
            self._shorten(own, own_route=True)
        elif not others and not self._cancelled.is_set():
            self.problem = NO_WAY
        if mixed_job is not None:
            mixed_job.join()
        self._ended = monotonic()

    def _counts(self, inputs: bytes) -> bool:
        """Whether a run reaches the exit with the gold wanted, by keys that a keyboard can make."""
        with suppress(UnverifiedRunError):
            return bool(with_plain_triggers(self.task.level, inputs, body=self.task.body, gold=self._wanted.gold))
        return False

    def _led_to_exit(self, task: Task, ticks: int) -> Task:
        """The task with a run to the exit that begins like a run that ends before it, b"" if none is found."""
        first = task.first[:ticks]
        run = to_exit(task.level, first, WAY_SECONDS, body=task.body, threads=task.jobs, goes_on=self._goes_on)
        gold = run_level(task.level, run, body=task.body).gold if run else 0
        return replace(task, first=run or b"", gold=min(gold, task.gold))

    def _goes_on(self, ticks: int) -> bool:
        self._note_ticks(ticks, own_route=True)
        return not self._cancelled.is_set()

    def _shorten(self, task: Task, *, own_route: bool) -> None:
        from ninja_game.search.solve import solve

        solve(
            task,
            report=lambda progress: self._note_ticks(progress.ticks, own_route=own_route),
            on_better=partial(self._note_run, own_route=own_route),
            stop=self._cancelled,
        )

    def _fail_beside(self, why: str) -> None:
        self.problem = why
        self.cancel()

    def _note_ticks(self, ticks: int, *, own_route: bool) -> None:
        self._began = self._began or monotonic()
        self._ticks[own_route] = ticks
        self.ticks_run = sum(self._ticks.values())

    def _note_run(self, run: Replay, *, own_route: bool) -> None:
        task = self._wanted
        inputs = run.inputs
        if not any(with_press_bits(keys).startswith(inputs) for keys in task.others):
            inputs = without_idle_keys(task.level, inputs, with_press_bits(task.first), body=task.body)
        path = run_level(self.task.level, inputs, body=self.task.body).positions
        keys = np.frombuffer(inputs.ljust(self.task.length, b"\0"), np.uint8) & np.uint8(KEYS_DOWN)
        end = tuple(np.concatenate([path[-1], path[-1] - path[-2]]).tolist())
        result = SpanResult(float(run.ticks), run.ticks, keys, inputs, run.gold, end, own_route, path=path)
        with self._lock:
            self._began = self._began or monotonic()
            if self._reaches and self.own is None:
                self.own = result
            self._unbeaten[own_route] = _unbeaten([*self._unbeaten[own_route], result])
            own = self._unbeaten[True]
            others = (other for other in _unbeaten([*own, *self._unbeaten[False]]) if not other.own_route)
            self.results = tuple(sorted([*own, *others]))


def _unbeaten(results: list[SpanResult]) -> tuple[SpanResult, ...]:
    """Keep the results that no other one beats in ticks and gold, the fastest first."""
    best: list[SpanResult] = []
    for result in sorted(results):
        if not best or result.gold > best[-1].gold:
            best.append(result)
    return tuple(best)
