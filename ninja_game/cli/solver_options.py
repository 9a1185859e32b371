"""What the commands that search have in common: options, a line of progress, one result."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ninja_game.cli.run_options import ProgressLog
from ninja_game.files.shown_text import shown_text
from ninja_game.formats.run_time import seconds_text

if TYPE_CHECKING:
    from ninja_game.formats.load import NamedLevel, Recording
    from ninja_game.formats.replay.text import Replay
    from ninja_game.search.solve import Progress, Task
    from ninja_game.sim.level import Level

F = TypeVar("F", bound=Callable[..., Any])

NOT_FOUND = 1
"""Exit code of a search that found nothing."""


class GoldCount(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """``all`` (-1) or a number of pieces."""

    name = "all|N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """The number; usage error for anything else."""
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
        """The number; usage error for anything else."""
        seconds: float = super().convert(value, param, ctx)
        if seconds != seconds:  # noqa: PLR0124 - NaN
            self.fail(f"{value!r} is not a number of seconds", param, ctx)
        return seconds


gold_option = click.option(
    "--gold", type=GoldCount(), default=0, show_default=True, help="Collect this much gold on the way."
)


def seconds_option(default: float) -> Callable[[F], F]:
    """How long to search."""
    return click.option(
        "--seconds", type=Seconds(min=0.1), default=default, show_default=True, help="Stop after this time."
    )


work_option = click.option(
    "--ticks", "work", type=click.IntRange(0, 10**15), default=0, metavar="N",
    help="Stop after about N simulated ticks per job instead: with one job, always the same result.",
)  # fmt: skip
smooth_option = click.option(
    "--smooth", type=click.IntRange(0, 10**6), metavar="N",
    help="In the end make the run look played: few key changes, at most N ticks longer.",
)  # fmt: skip
seed_option = click.option(
    "--seed", type=click.IntRange(0, 10**9), default=1, show_default=True,
    help="With one job, the same seed does the same work in the same order.",
)  # fmt: skip
search_jobs_option = click.option("--jobs", type=click.IntRange(1, 1024), help="Threads. [default: one per core]")
body_option = click.option(
    "--body", type=click.Choice(["circle", "box"]), default="circle", show_default=True, help="The ninja's body."
)


def default_threads(jobs: int | None) -> int:
    """As many as asked for, else one a core."""
    from ninja_game.batch.thread_pool import cores

    return jobs or cores()


def check_gold(task: Task) -> None:
    """Usage error if more gold is asked for than there is."""
    from dataclasses import replace

    there = replace(task, gold=-1).gold_wanted
    if task.gold > there:
        raise click.UsageError(f"--gold {task.gold}: the level holds {there} pieces of gold")


class SearchLog:
    """The log of a long search: what it found after how many seconds, a line each, over all commands that went on.

    ``begun``: how many there were; ``spent``: seconds of them. Raises FileError for a file that is something else.
    """

    HEAD = "# seconds spent, and what improve found"

    def __init__(self, path: Path, keep: Sequence[Path]) -> None:
        from ninja_game.errors import FileError
        from ninja_game.files.reading import read_utf8
        from ninja_game.files.writing import check_output, write_atomically

        check_output(path, keep=keep)
        if not path.exists():
            write_atomically(path, f"{self.HEAD}\n")
        head, *lines = read_utf8(path, 2**20).splitlines() or [""]
        found = [re.match(r" *(\d{1,9}) s  ", line) for line in lines]
        if head != self.HEAD or None in found:
            raise FileError("not the log of a search", str(path), hint="name another file")
        self._path, self._began = path, time.monotonic()
        self.begun = sum(line.endswith("begins") for line in lines)
        self.spent = max((int(match[1]) for match in found if match), default=0)
        self.note("begins")

    def note(self, what: str) -> None:
        with self._path.open("a", encoding="utf-8") as out:
            out.write(f"{self.spent + time.monotonic() - self._began:8.0f} s  {what}\n")


class ShownProgress:
    """What a search is told to report to: shows how it stands, and knows that afterwards."""

    def __init__(self, show: Callable[[str], None]) -> None:
        self.last: Progress | None = None
        self._show = show

    def __call__(self, progress: Progress) -> None:
        self.last = progress
        self._show(progress_text(progress))

    def say(self, text: str) -> None:
        self._show(text)

    def of_level(self, name: str, progress: Progress) -> None:
        self._show(f"{shown_text(name)}: {progress_text(progress)}")


@contextmanager
def progress_line() -> Iterator[ShownProgress]:
    """A line on stderr that says how the search stands: always the present one, or one now and then in a file."""
    if not sys.stderr.isatty():
        yield ShownProgress(ProgressLog().say)
        return
    from rich.console import Console
    from rich.live import Live
    from rich.text import Text

    starting = Text("starting; the first time it compiles, which takes about a minute")
    began = time.monotonic()
    with Live(starting, console=Console(stderr=True), transient=True, refresh_per_second=8) as live:
        yield ShownProgress(lambda text: live.update(Text(f"{time.monotonic() - began:4.0f} s  {text}")))


def not_found_text(task: Task, progress: Progress | None) -> str:
    """What a search that found no run says: what it never came to."""
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
    """A run's length in ticks and seconds."""
    return f"{end_tick} ticks ({seconds_text(end_tick)} s)"


def smoothed_run(level: Level, run: Replay, price: int) -> Replay:
    """The run with fewer key changes, verified; at most ``price`` ticks longer and with no less gold."""
    from ninja_game.search.certificate import smoothed, verified_run

    inputs = smoothed(level, run.inputs, body=run.body, gold=run.gold, price=price)
    return verified_run(level, inputs, body=run.body, gold=run.gold)


def saver(path: Path, level: NamedLevel) -> Callable[[Replay], None]:
    """A function that writes each better run of a level to a file, which must not be the level's own."""
    from ninja_game.files.writing import check_output
    from ninja_game.search.certificate import named_run, save_replay

    check_output(path, keep=[Path(level.file)])
    about = {"name": level.name, "author": "ninja-game solve", "level_author": level.author}
    return lambda run: save_replay(path, named_run(run, "solve", **about))


def saver_of_better(path: Path, recording: Recording, command: str) -> Callable[[Replay], None]:
    """A function that writes each better run that a command made of a recording, to a file that is not its own."""
    from ninja_game.files.writing import check_output
    from ninja_game.search.certificate import better_run, save_replay

    check_output(path, keep=[Path(recording.file)])
    return lambda run: save_replay(path, better_run(run, recording, command))
