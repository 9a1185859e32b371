"""What the commands that run recordings have in common: two options and a progress bar."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from typing import TypeVar

import click

T = TypeVar("T")

PATIENCE = 1.0
"""Seconds after which work is long enough for a progress bar."""

memory_option = click.option(
    "--memory", type=click.Choice(["auto", "plain", "compiled"]), default="auto", show_default=True,
    help="Plain Python, or compiled by Numba; both give the same bits.",
)  # fmt: skip

jobs_option = click.option(
    "--jobs", type=click.IntRange(1, 1024), help="How many workers run recordings. [default: one a core]"
)


def with_progress(items: Iterable[T], label: str) -> Iterator[T]:
    """The same items; if they take long and a person watches, with a bar on stderr that counts them."""
    if not sys.stderr.isatty():
        yield from items
        return
    start = time.monotonic()
    with ExitStack() as stack:
        advance: Callable[[], object] | None = None
        for number, item in enumerate(items, 1):
            yield item
            if advance is None and time.monotonic() - start > PATIENCE:
                advance = stack.enter_context(_Counter(label, number))
            elif advance:
                advance()


class _Counter:
    """A line on stderr that counts; called once an item."""

    def __init__(self, label: str, done: int) -> None:
        from rich.console import Console
        from rich.progress import MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

        columns = (SpinnerColumn(), TextColumn(label), MofNCompleteColumn(), TimeElapsedColumn())
        self.progress = Progress(
            *columns, console=Console(stderr=True), transient=True, redirect_stdout=sys.stdout.isatty()
        )
        self.task = self.progress.add_task(label, total=None, completed=done)

    def __enter__(self) -> Callable[[], object]:
        self.progress.start()
        return lambda: self.progress.advance(self.task)

    def __exit__(self, *_: object) -> None:
        self.progress.stop()
