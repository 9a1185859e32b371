"""What the commands that run recordings have in common: options and a progress bar."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from difflib import get_close_matches
from functools import partial
from pathlib import Path
from threading import Event, Thread
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.shell_completion import CompletionItem

from ninja_game.budget import RUN_BUDGET
from ninja_game.files.shown_text import counted

if TYPE_CHECKING:
    from ninja_game.formats.named_level import NamedLevel
    from ninja_game.formats.recording import Recording
    from ninja_game.sim.level import Level

T = TypeVar("T")
N = TypeVar("N", "NamedLevel", "Recording")

PATIENCE = 1.0
"""Seconds after which work is long enough for a progress bar."""

LONG, EVERY = 5.0, 15.0
"""Seconds until the first line of progress, and between two of them, where no bar tells it."""


class InputPath(click.Path):
    """A file or folder that is there; or a link, which is kept as a path as it stands."""

    def __init__(self, *, dir_okay: bool = True) -> None:
        super().__init__(exists=True, dir_okay=dir_okay, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path; usage error for what is not there."""
        from ninja_game.formats.links import is_link

        return Path(value) if is_link(value) else super().convert(value, param, ctx)


class LevelPath(InputPath):
    """A file or link; or the name of one of the game's own levels, which stands for its file."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path; usage error for what is neither there nor a name."""
        from ninja_game.formats.links import is_link

        if is_link(value):
            return super().convert(value, param, ctx)
        own = _own_levels()
        there = Path(value).exists() or "\0" in str(value)
        if not there and str(value) not in own and not Path(value).suffix:
            near = get_close_matches(str(value), own, 3, 0.5) or list(own)[:3]
            self.fail(f"{value!r} does not exist; the game's own levels: {', '.join(near)}, ...", param, ctx)
        return super().convert(value if there else own.get(str(value), value), param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Files, and the names that begin so."""
        names = [CompletionItem(name) for name in _own_levels() if name.startswith(incomplete)]
        return super().shell_complete(ctx, param, incomplete) + names


def _own_levels() -> dict[str, Path]:
    from ninja_game.files.user_folder import bundled_levels

    return {path.stem: path for path in bundled_levels()}


memory_option = click.option(
    "--memory", type=click.Choice(["auto", "plain", "compiled"]), default="auto", show_default=True,
    help="Plain Python, or compiled by Numba; both give the same bits.",
)  # fmt: skip

jobs_option = click.option(
    "--jobs", type=click.IntRange(1, 1024), help="How many workers run recordings. [default: one per core]"
)

level_option = click.option(
    "--level", "level_path", metavar="FILE", type=LevelPath(dir_okay=False),
    help="The level of recordings that do not hold theirs.",
)  # fmt: skip

other_level_option = click.option(
    "--level", "level_path", metavar="FILE", type=LevelPath(dir_okay=False),
    help="Play the inputs on this level, also where they were recorded on another one.",
)  # fmt: skip


budget_option = click.option(
    "--budget", type=click.IntRange(1), default=RUN_BUDGET, show_default=True,
    help="Most work of one run: ticks times objects. A run that is not over by then is refused.",
)  # fmt: skip


def _png_name(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """A name that cannot be that of a level or run; usage error for another."""
    if value and not value.lower().endswith(".png"):
        raise click.BadParameter("expected a name that ends in .png", ctx, param)
    return value


class Pixels(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """``WIDTHxHEIGHT`` as two numbers."""

    name = "WIDTHxHEIGHT"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Width and height; usage error for anything else."""
        if isinstance(value, tuple):
            return value
        width, _, height = value.lower().partition("x")
        if not all(re.fullmatch("[1-9][0-9]{1,4}", part) and int(part) <= 16384 for part in (width, height)):
            raise click.UsageError(f"--size is {value!r}; expected WIDTHxHEIGHT in px, e.g. 1584x1200")
        return int(width), int(height)


def window_options(command: Callable[..., T]) -> Callable[..., T]:
    """The options of commands that open a window: its size in px, how many pictures, where the last one goes."""
    png = click.Path(dir_okay=False)
    for option in (
        click.option("--screenshot", type=png, callback=_png_name, help="Write the last picture to this PNG file."),
        click.option("--frames", type=click.IntRange(1, 10**9), help="Exit after this many pictures."),
        click.option("--size", type=Pixels(), help="Size of the window in px, e.g. 1584x1200."),
    ):
        command = option(command)
    return command


def choose_level(path: Path, record: int | None) -> NamedLevel:
    """The level of a file; of several the one with that record number. Usage error as in ``choose``."""
    from ninja_game.formats.load import load_levels

    return choose(load_levels(path), "levels", path, record)


def choose(found: Sequence[N], what: str, path: Path, record: int | None) -> N:
    """The only level or recording of those in a file, or that with a record number. Usage error if it is not there."""
    if record is not None:
        found = [each for each in found if each.record == record]
        if not found:
            raise click.UsageError(f"{path}: there is no record {record}")
    if len(found) > 1:
        raise click.UsageError(f"{path} holds {len(found)} {what}; choose one with --record")
    return found[0]


def level_given(path: Path | None) -> Level | None:
    """The level that ``level_option`` names."""
    return choose_level(path, None).level if path else None


def with_progress(items: Iterable[T], label: str) -> Iterator[T]:
    """Items as they pass, counted on stderr if that takes long: by a bar, or by lines where that is a file.

    ``label``: what one of them is.
    """
    if not sys.stderr.isatty():
        done = 0
        with heartbeat(lambda: f"{counted(done, label)} done"):
            for done, item in enumerate(items, 1):  # noqa: B007 - the line tells it
                yield item
        return
    start = time.monotonic()
    with ExitStack() as stack:
        advance: Callable[[], object] | None = None
        over = stack.enter_context(heartbeat(lambda: f"at work on {label}s"))
        for number, item in enumerate(items, 1):
            yield item
            if advance is None and time.monotonic() - start > PATIENCE:
                over.set()
                advance = stack.enter_context(_counter(f"{label}s", number))
            elif advance:
                advance()


@contextmanager
def heartbeat(text: Callable[[], str]) -> Iterator[Event]:
    """Say on stderr now and then what is done meanwhile, for work that may take long and shows nothing by itself.

    Gives what ends it early.
    """
    over = Event()
    start = time.monotonic()

    def beat() -> None:
        pause = LONG
        while not over.wait(pause):
            click.echo(f"ninja-game: {time.monotonic() - start:,.0f} s: {text()}", err=True)
            pause = EVERY

    Thread(target=beat, daemon=True).start()
    try:
        yield over
    finally:
        over.set()


class ProgressLog:
    """Lines on stderr that say how long work stands, one each EVERY seconds."""

    def __init__(self) -> None:
        self.start = self.last = time.monotonic()

    def say(self, text: str) -> None:
        """Write the line if it is time for one."""
        now = time.monotonic()
        if now - self.last >= EVERY:
            self.last = now
            click.echo(f"ninja-game: {now - self.start:,.0f} s: {text}", err=True)


@contextmanager
def _counter(label: str, done: int) -> Iterator[Callable[[], object]]:
    """A line on stderr that counts; gives what is called once an item."""
    from rich.console import Console
    from rich.progress import MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn(label), MofNCompleteColumn(), TimeElapsedColumn())
    stderr, shared = Console(stderr=True), sys.stdout.isatty()
    with Progress(*columns, console=stderr, transient=True, redirect_stdout=shared) as progress:
        yield partial(progress.advance, progress.add_task(label, total=None, completed=done))
