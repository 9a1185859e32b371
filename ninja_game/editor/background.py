"""Work beside the window: one thread that does the newest job and forgets those before it; at once in a page."""

from __future__ import annotations

from collections.abc import Callable
from threading import Condition, Thread
from typing import Generic, TypeVar

from ninja_game.runtime import IN_PAGE, beside

Job = TypeVar("Job")
Result = TypeVar("Result")


class NewestJob(Generic[Job, Result]):
    """Calls ``work`` with the newest job, in a thread that begins with the first one.

    ``result``: of the job that was finished last, None so far.
    """

    def __init__(self, work: Callable[[Job], Result]) -> None:
        self._work = work
        self._news = Condition()
        self._waiting: list[Job] = []
        self._busy = False
        self._thread: Thread | None = None
        self.result: Result | None = None

    def ask(self, job: Job) -> None:
        """Do this job next, instead of any that still waits."""
        if IN_PAGE:
            self.result = self._work(job)
            return
        with self._news:
            self._waiting[:] = [job]
            if self._thread is None:
                self._thread = beside(self._run)
            self._news.notify_all()

    @property
    def idle(self) -> bool:
        """Whether all is done."""
        with self._news:
            return not (self._waiting or self._busy)

    def finish(self, seconds: float = 10.0) -> None:
        """Wait until all is done."""
        with self._news:
            self._news.wait_for(lambda: not (self._waiting or self._busy), seconds)

    def _run(self) -> None:
        while True:
            with self._news:
                self._news.wait_for(lambda: bool(self._waiting))
                job = self._waiting.pop()
                self._busy = True
            try:
                self.result = self._work(job)
            finally:
                with self._news:
                    self._busy = False
                    self._news.notify_all()
