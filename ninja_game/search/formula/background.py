"""A span search in the background: start it, look at its results at any time, cancel it."""

from __future__ import annotations

from threading import Event, Thread
from time import monotonic

import numpy as np

from ninja_game.batch.thread_pool import cores
from ninja_game.errors import ArgumentError
from ninja_game.formats.replay.text import Replay
from ninja_game.runs.run import run_level
from ninja_game.runtime import require_desktop, run_in_background
from ninja_game.search.formula.methods import METHODS, search_span
from ninja_game.search.formula.task import Found, SpanTask
from ninja_game.search.solve import Progress, Task, solve
from ninja_game.sim.inputs import KEYS_DOWN


class SpanSearch:
    """A search in a thread of its own, on ``jobs`` threads (one a core), for ``seconds`` (0: until it is cancelled).

    ``method``, ``every``, ``seed`` and ``memory`` are those of ``search_span``. ``found``: the best results so far,
    best first, each with the whole run; a better list takes the place of an old one. ``own``: what the run's own keys
    bring, None where they do not reach the goal. ``ticks_run``: ticks simulated; ``problem``: why the search could not
    go on, "" if it could.

    Compiled code runs without the interpreter's lock, so that a window stays alive. Raises FormulaError for a broken
    formula, ArgumentError for an unknown method, NinjaGameError in a page, which has no threads.
    """

    def __init__(
        self, task: SpanTask, method: str = "auto", jobs: int | None = None, *, seconds: float = 0.0, every: int = 1,
        seed: int = 1, memory: str = "auto",
    ) -> None:  # fmt: skip
        require_desktop()
        if method not in ("auto", *METHODS):
            raise ArgumentError(f"method is {method!r}; expected 'auto', {', '.join(map(repr, METHODS))}")
        task.formulas()
        self.task = task
        self.found: tuple[Found, ...] = ()
        self.own: Found | None = None
        self.ticks_run = 0
        self.problem = ""
        self._options = {"method": method, "every": every, "seed": seed, "memory": memory, "threads": jobs}
        self._limit = seconds
        self._cancelled = Event()
        self._thread: Thread | None = None
        self._began = self._ended = 0.0

    def start(self) -> None:
        """Begin; a second call does nothing."""
        if self._thread is None:
            self._thread = run_in_background(self._work, self._fail)

    def cancel(self) -> None:
        """End the search soon, within the time of one round of trials; what was found stays. Does not wait."""
        self._cancelled.set()

    def finish(self, seconds: float = 10.0) -> None:
        """Wait until the search is over, at most so long."""
        if self._thread is not None and not self.done:
            self._thread.join(seconds)

    @property
    def done(self) -> bool:
        """Whether the search was started and is over.

        One that is cancelled while kernels are compiled, which nothing can hold up, is over at once. They are finished
        beside, for the next search.
        """
        return bool(self._ended) or (self._thread is not None and self._cancelled.is_set() and not self._began)

    @property
    def seconds(self) -> float:
        """How long the search has run; 0 while it gets ready, which takes a while where kernels must be compiled."""
        return (self._ended or monotonic()) - self._began if self._began else 0.0

    def _work(self) -> None:
        search_span(self.task, self._report, **self._options)  # type: ignore[arg-type]
        self._ended = monotonic()

    def _fail(self, why: str) -> None:
        self.problem, self._ended = why, monotonic()

    def _report(self, ticks: int, found: tuple[Found, ...]) -> bool:
        if not self._began:
            if self._cancelled.is_set():
                return False
            # The run's own keys are tried first.
            self._began, self.own = monotonic(), found[0] if found else None
        self.ticks_run, self.found = ticks, found
        late = self._limit and self.seconds >= self._limit
        return not (late or self._cancelled.is_set())


LONGEST_SECONDS = 1e6
"""Of a search that goes on until it is cancelled."""
MOST_JOBS = 4
"""Of a search of a whole run, each of which may take a gigabyte."""


class RunSearch(SpanSearch):
    """The same for a whole run, ``task.inputs``, which is shortened as `ninja-game improve` does.

    ``gold``: pieces that it must still take; ``others``: runs of the level whose routes are shortened too. ``found``:
    what no other one beats in ticks and gold.
    """

    def __init__(
        self, task: SpanTask, jobs: int | None = None, *, seconds: float = 0.0, seed: int = 1, gold: int = 0,
        others: tuple[bytes, ...] = (),
    ) -> None:  # fmt: skip
        super().__init__(task, seconds=seconds)
        self._wanted = Task(
            task.level, task.body, gold, seconds or LONGEST_SECONDS, seed, min(jobs or cores(), MOST_JOBS),
            first=task.inputs.ljust(task.length, b"\0"), others=others,
        )  # fmt: skip

    def _work(self) -> None:
        solve(self._wanted, report=self._note_progress, on_better=self._note_run, stop=self._cancelled)
        self._ended = monotonic()

    def _note_progress(self, progress: Progress) -> None:
        self.ticks_run = progress.ticks

    def _note_run(self, run: Replay) -> None:
        places = run_level(self.task.level, run.inputs, body=self.task.body).positions[-2:]
        keys = np.frombuffer(run.inputs.ljust(self.task.length, b"\0"), np.uint8) & np.uint8(KEYS_DOWN)
        end = tuple(np.concatenate([places[-1], places[-1] - places[0]]).tolist())
        found = Found(float(run.ticks), run.ticks, keys, run.inputs, run.gold, end)
        if not self._began:
            self._began, self.own = monotonic(), found
        best: list[Found] = []
        for each in sorted([*self.found, found]):
            if not best or each.gold > best[-1].gold:
                best.append(each)
        self.found = tuple(best)
