"""The platform: a desktop, or a page of a browser; background work on it, and optional parts that are missing.

The only module that knows.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from threading import Condition, Thread
from typing import Generic, TypeVar

from ninja_game.errors import NinjaGameError, reason

Value = TypeVar("Value")
Job = TypeVar("Job")
Result = TypeVar("Result")

IN_PAGE = sys.platform == "emscripten"
"""Whether this is a page, which has no threads, no compiler, no NumPy and no Pillow."""

FOLDER_HANDLES = os.open in os.supports_dir_fd and not IN_PAGE
"""Whether files can be opened below the handle of a folder."""

PACKAGE = Path(__file__).resolve().parent

ONLY_ON_A_DESKTOP = "only the program for the desktop can make that, not a page"


def in_page_or_not(page: Value, desktop: Value) -> Value:
    """One of two values: that for a page, or that for a desktop."""
    return page if IN_PAGE else desktop


def cores() -> int:
    """The number of the machine's cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def require_desktop() -> None:
    """Raises NinjaGameError in a page."""
    if IN_PAGE:
        raise NinjaGameError(ONLY_ON_A_DESKTOP)


def run_in_background(work: Callable[[], object], failed: Callable[[str], object]) -> Thread:
    """Do some work in a thread of its own. Without threads it is done when this returns.

    ``failed``: called there with a sentence for the user if the work raises anything at all; nobody waits for what has
    ended. The traceback of a fault of ours is on stderr.
    """

    def attempt() -> None:
        try:
            work()
        except BaseException as error:  # noqa: BLE001 - also what a library calls no Exception
            failed(reason(error))
            if not isinstance(error, (NinjaGameError, OSError, MemoryError)):
                traceback.print_exc()

    thread = Thread(target=attempt, daemon=True)
    if IN_PAGE:
        thread.run()
    else:
        thread.start()
    return thread


class NewestJob(Generic[Job, Result]):
    """Calls ``work`` with the newest job, in a thread that ends when there is none. ``every``: with each, in turn.

    ``result``: of the job that was finished last, None so far. ``problem``: why the last one failed, "" if it did not.
    """

    def __init__(self, work: Callable[[Job], Result], *, every: bool = False) -> None:
        self._work, self._every = work, every
        self._news = Condition()
        self._waiting: list[Job] = []
        self._busy = False
        self.result: Result | None = None
        self.problem = ""

    def ask(self, job: Job) -> None:
        """Do this job next: instead of any that still waits, or after those."""
        with self._news:
            if not self._every:
                self._waiting.clear()
            self._waiting.append(job)
            if not self._busy:
                self._busy = True
                run_in_background(self._run, self._fail)

    @property
    def is_idle(self) -> bool:
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
            job, self._waiting[:] = self._waiting[:1], self._waiting[1:]
            if not job:
                self._busy = False
                self._news.notify_all()
            return job


def install_hint(extra: str) -> str:
    """The command that installs an optional part of the program: a checkout's own tool, else pip of this Python.

    It names the packages of the part, not this one, which the user's index may not have.
    """
    if IN_PAGE:
        return ONLY_ON_A_DESKTOP
    # Their import takes as long as all the rest.
    import shlex
    from importlib.metadata import PackageNotFoundError, requires

    tool = PACKAGE.parent / "tools" / "dev.py"
    if tool.is_file():
        return f"start the command as 'python3 {tool} run ...', which installs what is missing"
    try:
        needed = [requirement.partition(";") for requirement in requires("ninja-game") or ()]
    except PackageNotFoundError:
        return "this copy of the program cannot be added to; use one that is installed in a Python"
    packages = [
        package.strip() for package, _, marker in needed if marker.replace('"', "'").strip() == f"extra == '{extra}'"
    ]
    return f"install it: {sys.executable} -m pip install {shlex.join(packages)}"
