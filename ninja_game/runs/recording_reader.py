"""Recordings from files and folders, in order; unreadable ones are reported and do not stop the rest."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from ninja_game.errors import BudgetError, LevelError, NinjaGameError, reason
from ninja_game.files.reading import Skipped, files_below
from ninja_game.formats.ascii.writer import LEVELS_KEPT
from ninja_game.formats.links import is_link
from ninja_game.formats.load import texts_of
from ninja_game.formats.n14.level_file import LevelRecord, read_level_file
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.named_level import format_of, parse_levels
from ninja_game.formats.recording import Recording, demo_recording, parse_replays
from ninja_game.formats.replay.text import is_replay
from ninja_game.sim.level import Level

_MEANT_AS_DEMO = re.compile(r"[-+]?[0-9.]++\s*+:|(?=\S++\Z)([^|:]*+[|:]|A[A-Za-z]*+[^A-Za-z])")
"""A malformed demo in a demo's place: not the free text of level files."""


@dataclass(frozen=True)
class Unreadable:
    """A file, or a record of one, that cannot be used."""

    message: str  #: names it
    option: str = ""  #: as ``BudgetError.option``

    def __str__(self) -> str:
        return "; ".join(filter(None, (self.message, self.option)))


def texts_in(paths: Iterable[Path]) -> Iterator[tuple[str, str, bool] | Unreadable]:
    """Name and text of every file in files, folders and links, and whether the caller named it; one at a time."""
    for path in paths:
        if is_link(path) or not path.is_dir():
            yield from _texts_of(path, named=True)
            continue
        empty = True
        for file in files_below(path):
            empty = False
            yield from [Unreadable(str(file))] if isinstance(file, Skipped) else _texts_of(file, named=False)
        if empty:
            yield Unreadable(f"{path}: no recordings here")


def _texts_of(path: Path, *, named: bool) -> Iterator[tuple[str, str, bool] | Unreadable]:
    """As ``texts_in``, of one path."""
    try:
        yield from ((file, text, named) for file, text in texts_of(path, may_be_link=named))
    except NinjaGameError as error:
        yield Unreadable(str(error))
    except OSError as error:
        yield Unreadable(f"{path}: {reason(error)}")


def recordings_in(paths: Iterable[Path], level: Level | None = None) -> Iterator[Recording | Unreadable]:
    """Every recording of files and folders, in order. Files of levels alone are skipped in folders.

    ``level``: what recordings that do not hold their level are played on.
    """
    for filed in texts_in(paths):
        if isinstance(filed, Unreadable):
            yield filed
            continue
        file, text, named = filed
        records = records_of(text, file)
        yield from recordings_of(records, file, level) if records else recording_of_text(text, file, level, named=named)


def records_of(text: str, file: str = "") -> list[LevelRecord]:
    """The records of a file of recordings of N; none for any other file, and for one that cannot be read."""
    if format_of(text) != "file":
        return []
    try:
        records = read_level_file(text, file=file)
    except NinjaGameError:
        return []
    return records if any(record.demo or _MEANT_AS_DEMO.match(record.note) for record in records) else []


def recordings_of(
    records: Iterable[LevelRecord], file: str, level: Level | None = None
) -> Iterator[Recording | Unreadable]:
    for record in records:
        try:
            yield demo_recording(record, file, _level(record.level) if record.level else level)
        except NinjaGameError as error:
            yield Unreadable(str(error))


_level = lru_cache(LEVELS_KEPT)(parse_level_string)


def recording_of_text(
    text: str, file: str, level: Level | None = None, *, named: bool
) -> Iterator[Recording | Unreadable]:
    """The recordings of a text without records: our replay, a bare demo; none for levels that were not named."""
    try:
        yield from parse_replays(text, file=file, level=level)
    except NinjaGameError as error:
        if named or not _holds_levels(text, file):
            yield Unreadable(str(error))
    except OSError as error:
        yield Unreadable(f"{file}: {reason(error)}")


def _holds_levels(text: str, file: str) -> bool:
    try:
        return not is_replay(text) and bool(parse_levels(text, file=file))
    except (NinjaGameError, OSError):
        return False


@contextmanager
def named_errors(recording: Recording) -> Iterator[None]:
    """Levels that cannot be played, and runs that cost too much, name their file and record."""
    try:
        yield
    except (BudgetError, LevelError) as error:
        what = f"record {recording.record}: {error.what}"
        raise replace(error, file=recording.file, line=recording.line, what=what) from None
