"""Output to a terminal: control characters in it are escaped, wherever they come from."""

from __future__ import annotations

import io
import os
import re
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import click

from ninja_game.files.shown_text import shown_character, shown_text

if TYPE_CHECKING:
    from rich.console import Console

PIPE_WIDTH = 160  # width of a table in a pipe, characters

_COLOURS = r"\n|\t|\x1b\[[0-9;]*m"
_OWN_CONTROLS = {
    "stdout": re.compile(f"({_COLOURS})"),
    # Rich redraws progress lines in place.
    "stderr": re.compile(rf"({_COLOURS}|\r|\x1b\[(?:\?25[hl]|1A|2K))"),
}
"""Control sequences of our own output; names have passed ``shown_text`` and hold none."""

_DATA = re.compile(r"(\n|\t)")

_MAX_MESSAGE = 2000  # characters of a line about what is wrong
_LARGE = 5_000_000  # bytes of a GIF


class Terminal(io.TextIOWrapper):
    """A terminal that shows every other control character as its escape."""

    def __init__(self, stream: TextIO, ours: re.Pattern[str]) -> None:
        super().__init__(stream.buffer, stream.encoding, "backslashreplace", line_buffering=True)
        self.ours = ours

    def write(self, text: str) -> int:
        for place, part in enumerate(self.ours.split(text)):
            super().write(part if place % 2 or part.isprintable() else "".join(map(shown_character, part)))
        return len(text)


def data_output() -> TextIO:
    """Standard output for contents of files: from now on a terminal shows colours, too, as their escapes."""
    if isinstance(sys.stdout, Terminal):
        sys.stdout.ours = _DATA
    return sys.stdout


def guard_terminal() -> None:
    """Wrap stdout and stderr in ``Terminal`` if they are one; files and pipes get every byte."""
    for name, ours in _OWN_CONTROLS.items():
        stream = getattr(sys, name)
        # Names of levels may contain characters that the terminal's encoding lacks.
        getattr(stream, "reconfigure", lambda **_: None)(errors="backslashreplace")
        if stream and stream.isatty():
            setattr(sys, name, Terminal(stream, ours))


def table_console() -> Console:
    """A console for tables with any text. A pipe has no width, and a table cut to 80 characters is useless there."""
    from rich.console import Console

    width = None if sys.stdout.isatty() else PIPE_WIDTH
    return Console(highlight=False, markup=False, emoji=False, width=width)


def use_dummy_video() -> None:
    """Draw without a display from now on, unless the user has chosen a video driver."""
    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")


def print_error(message: str) -> None:
    """Write an error on stderr, each line with the program's name."""
    for line in message.split("\n"):
        say(f"ninja-game: {shown_text(line, _MAX_MESSAGE)}")


def say(text: str) -> None:
    """Write a line on stderr; if stderr is closed, only the exit code is left."""
    with suppress(OSError):
        click.echo(text, err=True)


def size_note(path: Path) -> str:
    """A note on a large GIF."""
    size = path.stat().st_size
    return f", {size / 1e6:.0f} MB; as .mp4 it would be smaller" if path.suffix == ".gif" and size > _LARGE else ""
