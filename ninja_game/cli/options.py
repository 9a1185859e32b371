"""Options and types of arguments that several commands share."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.shell_completion import CompletionItem

from ninja_game.budget import RUN_BUDGET
from ninja_game.files.bundled import own_levels
from ninja_game.runtime import cores

if TYPE_CHECKING:
    from ninja_game.formats.named_level import NamedLevel
    from ninja_game.formats.recording import Recording
    from ninja_game.sim.level import Level

F = TypeVar("F", bound=Callable[..., Any])
N = TypeVar("N", "NamedLevel", "Recording")

JOBS = click.IntRange(1, 1024)
SEED = click.IntRange(0, 10**9)


class OldPath(click.Path):
    """A path of something that exists."""

    def __init__(self, *, file_okay: bool = True, dir_okay: bool = True) -> None:
        super().__init__(exists=True, file_okay=file_okay, dir_okay=dir_okay, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if not Path(value).exists():
            raise click.UsageError(f"{value}: there is no such {'file' if self.file_okay else 'folder'}", ctx)
        return super().convert(value, param, ctx)


OLD_FILE = OldPath(dir_okay=False)  # must exist
NEW_FILE = click.Path(dir_okay=False, path_type=Path)  # may be missing
OLD_FOLDER = OldPath(file_okay=False)
NEW_FOLDER = click.Path(file_okay=False, path_type=Path)
OLD_PATH = OldPath()  # a file or a folder


class InputPath(OldPath):
    """An existing file or folder; or a link, which is kept unchanged as a path."""

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
                similar = get_close_matches(name, own, 3, 0.5) or list(own)[:3]
                self.fail(f"{value!r} does not exist; the game's own levels: {', '.join(similar)}, ...", param, ctx)
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

record_option = click.option("--record", type=click.IntRange(min=0), help="Only this one of a file, counted from 0.")

level_option = click.option(
    "--level", "level_path", metavar="FILE", type=LevelPath(dir_okay=False), help="Level of recordings without one."
)

play_on_option = click.option(
    "--level", "level_path", metavar="FILE", type=LevelPath(dir_okay=False), help="Play the inputs on this level."
)


def output_option(text: str, *, metavar: str | None = None, required: bool = False) -> Callable[[F], F]:
    """``-o``, the file that a command writes; ``text``: the help."""
    return click.option("-o", "--output", metavar=metavar, required=required, type=NEW_FILE, help=text)


budget_option = click.option(
    "--budget", type=click.IntRange(1), default=RUN_BUDGET, show_default=True, help="Most ticks times objects of a run."
)


def _png_name(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """A file name that ends in .png, so never a level or run; else a usage error."""
    if value and not value.lower().endswith(".png"):
        raise click.BadParameter("expected a name that ends in .png", ctx, param)
    return value


class PixelSize(click.ParamType):  # type: ignore[type-arg, unused-ignore]
    """``WIDTHxHEIGHT`` as two numbers."""

    name = "WIDTHxHEIGHT"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        if isinstance(value, tuple):
            return value
        width, _, height = value.lower().partition("x")
        if not all(re.fullmatch("[1-9][0-9]{1,4}", part) and int(part) <= 16384 for part in (width, height)):
            raise click.UsageError(f"--size is {value!r}; expected WIDTHxHEIGHT in px, e.g. 1584x1200")
        return int(width), int(height)


def combined(*options: Callable[[F], F]) -> Callable[[F], F]:
    """Several options as one, in this order."""

    def decorate(command: F) -> F:
        for option in reversed(options):
            command = option(command)
        return command

    return decorate


window_options = combined(
    click.option("--size", type=PixelSize(), help="Size of the window in px, e.g. 1584x1200."),
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


def choose(items: Sequence[N], what: str, path: Path, record: int | None) -> N:
    """The only level or recording of those in a file, or that with a record number. Usage error if it is not there."""
    if record is not None:
        items = [item for item in items if item.record == record]
        if not items:
            raise click.UsageError(f"{path}: there is no record {record}")
    if len(items) > 1:
        raise click.UsageError(f"{path} holds {len(items)} {what}; choose one with --record, 0 to {len(items) - 1}")
    return items[0]


def load_level_option(path: Path | None) -> Level | None:
    return choose_level(path, None).level if path else None


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
levels_jobs_option = click.option(
    "--jobs", type=JOBS, default=cores, show_default="one per core", help="Levels at the same time."
)
search_jobs_option = click.option("--jobs", type=JOBS, default=cores, show_default="one per core", help="Threads.")
shortening_options = combined(
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
