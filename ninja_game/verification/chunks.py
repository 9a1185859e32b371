"""Recordings cut into chunks that can be verified anywhere: some files, or some records of a large one.

A chunk carries its text, so that it can be sent to a machine that does not see the files. Only levels that a replay
of ours names by path are read where the chunk is verified; ``self_contained`` puts them inside first.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import SUFFIXES, read_text
from ninja_game.formats.ascii.reader import is_ascii_level
from ninja_game.formats.n14.level_file import LevelRecord, read_level_file
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.named_level import is_level_file, level_of_replay
from ninja_game.formats.recording import Recording, parse_replays, recording_of
from ninja_game.formats.replay.text import is_replay, parse_replay, write_replay
from ninja_game.runs.recording_reader import Unreadable, holds_only_levels
from ninja_game.runs.verify import Verdict, verify_recording
from ninja_game.sim.level import Level

RECORDS = 64
"""Records a chunk at most: enough that sending it is cheap beside running it."""

LEVELS_KEPT = 512
"""Levels that are kept read, some 10 MB: recordings of one level often stand near each other."""

Result = Verdict | Unreadable


@dataclass(frozen=True)
class Chunk:
    """A file, or records ``first`` … of one.

    ``text``: of the whole file, if ``records`` is empty; ``problem``: why the file cannot be read, '' if it can;
    ``named``: whether the caller named the file, or it was found in a folder; ``stamp``: size and time of change;
    ``done``: its key if the checkpoint log has its results.
    """

    file: str
    first: int = 0
    text: str = field(default="", repr=False)
    records: tuple[LevelRecord, ...] = field(default=(), repr=False)
    problem: str = ""
    named: bool = True
    stamp: tuple[int, int] = (0, 0)
    done: str = ""

    @property
    def key(self) -> str:
        """What tells it from all other chunks, and from this one after its file was changed."""
        return f"{self.file}:{self.first}+{len(self.records)}:{self.stamp[0]}:{self.stamp[1]}"

    @property
    def weight(self) -> int:
        """About how much work it is."""
        return len(self.records) or 1


def files_below(path: Path) -> Iterator[str]:
    """The files below a folder that may hold recordings, in order of their names; one folder is in memory at a time."""
    with os.scandir(path) as entries:
        found = sorted((entry.name, entry.is_dir()) for entry in entries)
    for name, is_folder in found:
        if is_folder:
            yield from files_below(path / name)
        elif name.lower().endswith(SUFFIXES):
            yield str(path / name)


def chunks_in(paths: Iterable[Path]) -> Iterator[Chunk]:
    """All chunks of files and folders, in order, each read when it is asked for."""
    for path in paths:
        if not path.is_dir():
            yield from _chunks_of(str(path), named=True)
            continue
        empty = True
        for file in files_below(path):
            yield from _chunks_of(file, named=False)
            empty = False
        if empty:
            yield Chunk(str(path), problem=f"{path}: no recordings here")


def _chunks_of(file: str, *, named: bool) -> Iterator[Chunk]:
    """The chunks of one file."""
    try:
        about = Path(file).stat()
        whole = Chunk(file, named=named, stamp=(about.st_size, about.st_mtime_ns))
        text = read_text(Path(file))
    except NinjaGameError as error:
        yield Chunk(file, problem=str(error))
        return
    except OSError as error:
        yield Chunk(file, problem=f"{file}: {error.strerror or error}")
        return
    records = _records(text, file)
    if len(records) < 2:
        yield replace(whole, text=text)
        return
    for first in range(0, len(records), RECORDS):
        yield replace(whole, first=first, records=tuple(records[first : first + RECORDS]))


def _records(text: str, file: str) -> list[LevelRecord]:
    """The records of a file of recordings of N; none for any other file, and for one that cannot be read."""
    if is_replay(text) or is_ascii_level(text) or not is_level_file(text):
        return []
    try:
        records = read_level_file(text, file=file)
    except NinjaGameError:
        return []
    return records if any(record.demo for record in records) else []


def self_contained(chunk: Chunk) -> Chunk:
    """The same chunk with the level inside, where a replay of ours names it by path; what is wrong stays as it is."""
    if not chunk.text or not is_replay(chunk.text):
        return chunk
    try:
        parsed = parse_replay(chunk.text, file=chunk.file)
        if parsed.level is not None:
            return chunk
        level = level_of_replay(parsed, chunk.file)
        return replace(chunk, text=write_replay(replace(parsed, level=level, level_path="")))
    except NinjaGameError as error:
        return replace(chunk, problem=str(error))


def verify_chunk(chunk: Chunk, memory: str = "auto") -> list[Result]:
    """A verdict on every recording of a chunk, in order; what cannot be read is said and stops nothing."""
    if chunk.problem:
        return [Unreadable(chunk.problem)]
    results: list[Result] = []
    for recording in _recordings(chunk):
        if isinstance(recording, Unreadable):
            results.append(recording)
            continue
        try:
            results.append(verify_recording(recording, memory))
        except NinjaGameError as error:
            results.append(Unreadable(str(error)))
    return results


def _recordings(chunk: Chunk) -> Iterator[Recording | Unreadable]:
    """The recordings of a chunk."""
    if not chunk.records:
        try:
            yield from parse_replays(chunk.text, file=chunk.file)
        except NinjaGameError as error:
            if chunk.named or not holds_only_levels(chunk.text, chunk.file):
                yield Unreadable(str(error))
        except OSError as error:
            yield Unreadable(f"{chunk.file}: {error.strerror or error}")
        return
    for record in chunk.records:
        try:
            level = _level(record.level) if record.level else None
            yield recording_of(record, chunk.file, level)
        except NinjaGameError as error:
            yield Unreadable(str(error))


@lru_cache(LEVELS_KEPT)
def _level(text: str) -> Level:
    """A level by its text."""
    return parse_level_string(text)
