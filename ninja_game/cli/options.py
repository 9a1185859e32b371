"""What commands have in common: options, types of arguments, progress, one result of a search."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from difflib import get_close_matches
from functools import reduce
from pathlib import Path
from threading import Event, Thread
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import click
from click.shell_completion import CompletionItem

from ninja_game.budget import RUN_BUDGET
from ninja_game.cli.terminal import print_error
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import own_levels
from ninja_game.files.writing import check_output
from ninja_game.formats.run_time import seconds_text
from ninja_game.runtime import cores

if TYPE_CHECKING:
    from ninja_game.formats.named_level import NamedLevel
    from ninja_game.formats.recording import Recording
    from ninja_game.formats.replay.text import Replay
    from ninja_game.runs.recording_reader import Unreadable
    from ninja_game.search.solve import Progress, Task
    from ninja_game.sim.level import Level

T = TypeVar("T")
F = TypeVar("F", bound=Callable[..., Any])
N = TypeVar("N", "NamedLevel", "Recording")

# When progress is shown.
PATIENCE = 1.0  # seconds until a terminal shows it
REFRESHES = 8  # times a second there
LONG = 5.0  # seconds until its first line in a file
EVERY = 15.0  # seconds between two lines

JOBS = click.IntRange(1, 1024)
SEED = click.IntRange(0, 10**9)
OLD_FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
NEW_FILE = click.Path(dir_okay=False, path_type=Path)
OLD_FOLDER = click.Path(exists=True, file_okay=False, path_type=Path)
NEW_FOLDER = click.Path(file_okay=False, path_type=Path)
OLD_PATH = click.Path(exists=True, path_type=Path)
"""A file, a folder, or either, that is there already; one that is to be written."""


class InputPath(click.Path):
    """A file or folder that is there; or a link, which is kept as a path as it stands."""

    def __init__(self, *, dir_okay: bool = True) -> None:
        super().__init__(exists=True, dir_okay=dir_okay, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        from ninja_game.formats.links import is_link

        return Path(value) if is_link(value) else super().convert(value, param, ctx)


class LevelPath(InputPath):
    """A file or link; or the name of one of the game's own levels, which stands for its file."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        from ninja_game.formats.links import is_link

        if not (is_link(value) or "\0" in str(value) or Path(value).exists()):
            own, name = own_levels(), str(value)
            if name not in own and not Path(name).suffix:
                near = get_close_matches(name, own, 3, 0.5) or list(own)[:3]
                self.fail(f"{value!r} does not exist; the game's own levels: {', '.join(near)}, ...", param, ctx)
            value = own.get(name, value)
        return super().convert(value, param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        names = [CompletionItem(name) for name in own_levels() if name.startswith(incomplete)]
        return super().shell_complete(ctx, param, incomplete) + names


memory_option = click.option(
    "--memory", type=click.Choice(["auto", "plain", "compiled"]), default="auto", show_default=True,
    help="Plain Python, or compiled by Numba; both give the same bits.",
)  # fmt: skip

jobs_option = click.option("--jobs", type=JOBS, help="How many workers run recordings. [default: one per core]")

level_option = click.option(
    "--level", "level_path", metavar="FILE", type=LevelPath(dir_okay=False), help="Level of recordings without one."
)

play_on_option = click.option(
    "--level", "level_path", metavar="FILE", type=LevelPath(dir_okay=False), help="Play the inputs on this level."
)


budget_option = click.option(
    "--budget", type=click.IntRange(1), default=RUN_BUDGET, show_default=True, help="Most ticks times objects of a run."
)


def _png_name(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """A name that cannot be that of a level or run; usage error for another."""
    if value and not value.lower().endswith(".png"):
        raise click.BadParameter("expected a name that ends in .png", ctx, param)
    return value


class Pixels(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """``WIDTHxHEIGHT`` as two numbers."""

    name = "WIDTHxHEIGHT"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        if isinstance(value, tuple):
            return value
        width, _, height = value.lower().partition("x")
        if not all(re.fullmatch("[1-9][0-9]{1,4}", part) and int(part) <= 16384 for part in (width, height)):
            raise click.UsageError(f"--size is {value!r}; expected WIDTHxHEIGHT in px, e.g. 1584x1200")
        return int(width), int(height)


def together(*options: Callable[[F], F]) -> Callable[[F], F]:
    """Several options as one, in this order."""
    return lambda command: reduce(lambda decorated, option: option(decorated), reversed(options), command)


window_options = together(
    click.option("--size", type=Pixels(), help="Size of the window in px, e.g. 1584x1200."),
    click.option("--frames", type=click.IntRange(1, 10**9), help="Exit after this many pictures."),
    click.option(
        "--screenshot",
        type=click.Path(dir_okay=False),
        callback=_png_name,
        help="Write the last picture to this PNG file.",
    ),
)


def choose_level(path: Path, record: int | None) -> NamedLevel:
    """The level of a file; of several the one with that record number. Usage error as in ``choose``."""
    from ninja_game.formats.load import load_levels

    return choose(load_levels(path), "levels", path, record)


def choose(found: Sequence[N], what: str, path: Path, record: int | None) -> N:
    """The only level or recording of those in a file, or that with a record number. Usage error if it is not there."""
    if record is not None:
        found = [item for item in found if item.record == record]
        if not found:
            raise click.UsageError(f"{path}: there is no record {record}")
    if len(found) > 1:
        raise click.UsageError(f"{path} holds {len(found)} {what}; choose one with --record")
    return found[0]


def load_level_option(path: Path | None) -> Level | None:
    """The level that ``level_option`` names."""
    return choose_level(path, None).level if path else None


class Readable(Generic[T]):
    """Items as they pass, without what cannot be read, which is reported on stderr; how many of each there were."""

    def __init__(self, items: Iterable[T | Unreadable]) -> None:
        self._items = items
        self.count = self.unreadable = 0

    def __iter__(self) -> Iterator[T]:
        from ninja_game.runs.recording_reader import Unreadable

        for item in self._items:
            if isinstance(item, Unreadable):
                self.unreadable += 1
                print_error(item.message)
            else:
                self.count += 1
                yield item


def with_progress(items: Iterable[T], label: str) -> Iterator[T]:
    """Items as they pass, counted on stderr if that takes long. ``label``: what one of them is."""
    done = 0
    with heartbeat(lambda: f"{counted(done, label)} done"):
        for done, item in enumerate(items, 1):  # noqa: B007 - the line tells it
            yield item


@contextmanager
def heartbeat(text: Callable[[], str]) -> Iterator[None]:
    """Report progress on stderr meanwhile: the present state in a terminal, in a file a line now and then."""
    over, start = Event(), time.monotonic()

    def report_to_file() -> None:
        pause = LONG
        while not over.wait(pause):
            click.echo(f"ninja-game: {time.monotonic() - start:,.0f} s: {text()}", err=True)
            pause = EVERY

    def report_to_terminal() -> None:
        if over.wait(PATIENCE):
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


class GoldCount(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """``all`` (-1) or a number of pieces."""

    name = "all|N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        if isinstance(value, int):
            return value
        if str(value).lower() == "all":
            return -1
        if not (str(value).isdecimal() and len(str(value)) < 10):
            self.fail(f"{value!r} is neither 'all' nor a whole number", param, ctx)
        return int(value)


class Seconds(click.FloatRange):
    """A time in seconds, not "not a number"."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        seconds: float = super().convert(value, param, ctx)
        if seconds != seconds:  # noqa: PLR0124 - NaN
            self.fail(f"{value!r} is not a number of seconds", param, ctx)
        return seconds


def seconds_option(default: float) -> Callable[[F], F]:
    return click.option(
        "--seconds", type=Seconds(min=0.1), default=default, show_default=True, help="Stop after this time."
    )


work_option = click.option(
    "--ticks", "work", type=click.IntRange(0, 10**15), default=0, metavar="N",
    help="Stop after about N simulated ticks per job instead: with one job, always the same result.",
)  # fmt: skip
smooth_option = click.option(
    "--smooth", type=click.IntRange(0, 10**6), metavar="N", help="Fewer key changes, for at most N ticks more."
)
seed_option = click.option(
    "--seed", type=SEED, default=1, show_default=True, help="With one job, the same seed does the same work."
)
search_jobs_option = click.option("--jobs", type=JOBS, default=cores, show_default="one per core", help="Threads.")
shortening_options = together(
    click.option("--gold", type=GoldCount(), default=0, show_default=True, help="Collect this much gold on the way."),
    seconds_option(60.0),
    work_option,
    seed_option,
    search_jobs_option,
    smooth_option,
)
body_option = click.option(
    "--body", type=click.Choice(["circle", "box"]), default="circle", show_default=True, help="The ninja's body."
)


def check_gold(task: Task) -> None:
    there = replace(task, gold=-1).gold_wanted
    if task.gold > there:
        raise click.UsageError(f"--gold {task.gold}: the level holds {there} pieces of gold")


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
    """Show how a search stands, as ``heartbeat`` does."""
    shown = ShownProgress()
    with heartbeat(lambda: shown.text):
        yield shown


def not_found_text(task: Task, progress: Progress | None) -> str:
    """The line for a search that found no run, with what it never reached."""
    from ninja_game.search.task import obstacle

    gold = f"with {task.gold_wanted} gold " if task.gold_wanted else ""
    why = f": {obstacle(task.level, task.gold_wanted, progress).sentence}" if progress else ""
    return f"no run {gold}to the exit found{why}; more time or another --seed may find one"


def progress_text(progress: Progress) -> str:
    """What is done, best run and speed in a line, which is shown beside a clock."""
    best = time_text(progress.best) if progress.best >= 0 else "none yet"
    speed = progress.ticks / progress.seconds / 1e6 if progress.seconds > 0 else 0.0
    return f"{progress.doing:<10} best {best}  {speed:.1f}M ticks/s"


def time_text(end_tick: int) -> str:
    return f"{end_tick} ticks ({seconds_text(end_tick)} s)"


def simplified_run(task: Task, run: Replay, price: int | None) -> Replay:
    """The run without keys that do nothing, verified.

    ``price``: also with fewer key changes, at most so many ticks longer and with no less gold.
    """
    from ninja_game.search.certificate import smooth_run, verified_run, without_idle_keys

    inputs = without_idle_keys(task.level, run.inputs, task.first, body=run.body)
    if price is not None:
        inputs = smooth_run(task.level, inputs, body=run.body, gold=run.gold, price=price)
    return verified_run(task.level, inputs, body=run.body, gold=run.gold)


def saver(path: Path, level: NamedLevel) -> Callable[[Replay], None]:
    """A function that writes each better run of a level to a file, which must not be the level's own."""
    from ninja_game.search.certificate import named_replay, save_replay

    check_output(path, keep=[Path(level.file)])
    about = {"name": level.name, "author": "ninja-game solve", "level_author": level.author}
    return lambda run: save_replay(path, named_replay(run, "solve", **about))


def saver_of_better(path: Path, recording: Recording, command: str) -> Callable[[Replay], None]:
    """A function that writes each better run that a command made of a recording, to a file that is not its own."""
    from ninja_game.search.certificate import improved_replay, save_replay

    check_output(path, keep=[Path(recording.file)])
    return lambda run: save_replay(path, improved_replay(run, recording, command))
