"""Work in the background: one thread that does the newest job and forgets those before it; at once in a page."""

from __future__ import annotations

from collections.abc import Callable
from threading import Condition
from typing import Generic, TypeVar

from ninja_game.runtime import run_in_background

Job = TypeVar("Job")
Result = TypeVar("Result")


class NewestJob(Generic[Job, Result]):
    """Calls ``work`` with the newest job, in a thread that ends when there is none.

    ``result``: of the job that was finished last, None so far. ``problem``: why the last one failed, "" if it did not.
    """

    def __init__(self, work: Callable[[Job], Result]) -> None:
        self._work = work
        self._news = Condition()
        self._waiting: list[Job] = []
        self._busy = False
        self.result: Result | None = None
        self.problem = ""

    def ask(self, job: Job) -> None:
        """Do this job next, instead of any that still waits."""
        with self._news:
            self._waiting[:] = [job]
            if not self._busy:
                self._busy = True
                run_in_background(self._run, self._fail)

    @property
    def idle(self) -> bool:
        with self._news:
            return not self._busy

    def finish(self, seconds: float = 10.0) -> None:
        with self._news:
            self._news.wait_for(lambda: not self._busy, seconds)

    def _run(self) -> None:
        while job := self._next():
            self.result, self.problem = self._work(job[0]), ""

    def _fail(self, why: str) -> None:
        """Go on with a newer job, if there is one."""
        self.problem = why
        run_in_background(self._run, self._fail)

    def _next(self) -> list[Job]:
        """The job that waits, in a list; with an empty one the thread is over."""
        with self._news:
            job, self._waiting[:] = self._waiting[:], []
            if not job:
                self._busy = False
                self._news.notify_all()
            return job
