"""Progress of commands: items as they are processed, files that cannot be read, the state of a search."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from threading import Event, Thread
from typing import TYPE_CHECKING, Generic, TypeVar

import click

from ninja_game.cli.terminal import print_error
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.run_time import time_text

if TYPE_CHECKING:
    from ninja_game.runs.recording_reader import Unreadable
    from ninja_game.search.task import Progress

T = TypeVar("T")

_PATIENCE = 1.0  # seconds until a terminal shows it
REFRESHES = 8  # times a second there
LONG = 5.0  # seconds until its first line in a file
_EVERY = 15.0  # seconds between two lines


class Readable(Generic[T]):
    """Items in passing, without unreadable ones, which are reported on stderr; the number of each."""

    def __init__(self, items: Iterable[T | Unreadable]) -> None:
        self._items = items
        self.count = self.unreadable = 0

    def __iter__(self) -> Iterator[T]:
        from ninja_game.runs.recording_reader import Unreadable

        for item in self._items:
            if isinstance(item, Unreadable):
                self.unreadable += 1
                print_error(str(item))
            else:
                self.count += 1
                yield item


def with_progress(items: Iterable[T], label: str) -> Iterator[T]:
    """The items, counted on stderr if that takes long. ``label``: the word for one of them."""
    done = 0
    with heartbeat(lambda: f"{counted(done, label)} done"):
        for done, item in enumerate(items, 1):  # noqa: B007 - the line tells it
            yield item


@contextmanager
def heartbeat(text: Callable[[], str]) -> Iterator[None]:
    """Report progress on stderr during the block: the present state in a terminal, in a file a line now and then."""
    over, start = Event(), time.monotonic()

    def report_to_file() -> None:
        pause = LONG
        while not over.wait(pause):
            click.echo(f"ninja-game: {time.monotonic() - start:,.0f} s: {text()}", err=True)
            pause = _EVERY

    def report_to_terminal() -> None:
        if over.wait(_PATIENCE):
            return
        from rich.console import Console
        from rich.live import Live
        from rich.text import Text

        stderr, shared = Console(stderr=True), sys.stdout.isatty()
        with Live(console=stderr, transient=True, auto_refresh=False, redirect_stdout=shared) as live:
            while not over.wait(1 / REFRESHES):
                live.update(Text(f"{time.monotonic() - start:4.0f} s  {text()}"), refresh=True)

    reporter = Thread(target=report_to_terminal if sys.stderr.isatty() else report_to_file, daemon=True)
    reporter.start()
    try:
        yield
    finally:
        over.set()
        reporter.join()


class ShownProgress:
    """Receives the reports of a search: ``text``: the current line of progress; ``last``: the last report."""

    def __init__(self) -> None:
        self.text = "starting; the first time it compiles, which takes about a minute"
        self.last: Progress | None = None

    def __call__(self, progress: Progress) -> None:
        self.last = progress
        self.say(progress_text(progress))

    def say(self, text: str) -> None:
        self.text = text

    def of_level(self, name: str, progress: Progress) -> None:
        self.say(f"{shown_text(name)}: {progress_text(progress)}")


@contextmanager
def progress_line() -> Iterator[ShownProgress]:
    """Show the state of a search, as ``heartbeat`` does."""
    shown = ShownProgress()
    with heartbeat(lambda: shown.text):
        yield shown


def progress_text(progress: Progress) -> str:
    """Work done, best run and speed in a line, which is shown beside a clock."""
    best = time_text(progress.best) if progress.best >= 0 else "none yet"
    speed = progress.ticks / progress.seconds / 1e6 if progress.seconds > 0 else 0.0
    return f"{progress.doing:<10} best {best}  {speed:.1f}M ticks/s"
