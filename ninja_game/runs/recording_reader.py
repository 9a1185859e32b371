"""Recordings out of files and folders, one after the other; what cannot be read is told and does not stop the rest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.reading import read_text, text_files
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_file import read_level_file
from ninja_game.formats.named_level import is_level_file, parse_levels
from ninja_game.formats.recording import Recording
from ninja_game.simulation import Body


@dataclass(frozen=True)
class Unreadable:
    """A file, or a record of one, that cannot be used; ``message`` names it."""

    message: str


def recordings_in(paths: Iterable[Path]) -> Iterator[Recording | Unreadable]:
    """Every recording of files and folders, in order. Levels among the recordings of a folder are passed by."""
    for path in paths:
        files = text_files(path)
        if not files:
            yield Unreadable(f"{path}: no recordings here")
        for file in files:
            try:
                yield from load_replays(file)
            except NinjaGameError as error:
                if not (path.is_dir() and _has_only_levels(file)):
                    yield Unreadable(str(error))
            except OSError as error:
                yield Unreadable(f"{file}: {error.strerror or error}")


@contextmanager
def named_errors(recording: Recording) -> Iterator[None]:
    """Levels that cannot be played name their file and record."""
    try:
        yield
    except LevelError as error:
        what = f"record {recording.record}: {error.what}"
        raise replace(error, file=recording.file, line=recording.line, what=what) from None


def body_of(recording: Recording) -> Body:
    """The ninja's body: as a replay of ours says, else the circle of the classic rules."""
    return "box" if recording.replay and recording.replay.body == "box" else "circle"


def _has_only_levels(file: Path) -> bool:
    """Whether a file can be read and holds levels and no recording."""
    try:
        return holds_only_levels(read_text(file), str(file))
    except (NinjaGameError, OSError):
        return False


def holds_only_levels(text: str, file: str = "") -> bool:
    """Whether a text holds levels and no recording."""
    try:
        parse_levels(text, file=file)
        return not is_level_file(text) or not any(record.demo for record in read_level_file(text))
    except (NinjaGameError, OSError):
        return False
