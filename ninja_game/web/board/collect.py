"""The texts of a folder of runs, as chunks to verify. Nothing outside the folder is read, and nothing large."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from ninja_game.errors import NinjaGameError, ReplayError
from ninja_game.files.reading import LeftOut, decoded, files_below, read_bytes
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import is_replay, parse_replay, write_replay
from ninja_game.runs.recording_reader import Unreadable, recording_of_text, recordings_of, records_of
from ninja_game.sim.level import Level
from ninja_game.verification.chunks import Chunk

MOST_BYTES = 2**20
"""Of a file: a hundred times a long run."""

MOST_RECORDS = 200
"""Of one file with records of N."""


def chunks_below(folder: Path, levels: Mapping[str, Level]) -> Iterator[Chunk]:
    """A chunk for each file of the folder, by its path from there; one that is refused says why.

    ``levels``: those that count, by digest; replays that hold no level are given theirs; paths in them are not
    followed.
    """
    root = folder.resolve()
    for found in files_below(folder):
        path = found.path if isinstance(found, LeftOut) else found
        name = path.relative_to(folder).as_posix()
        if isinstance(found, LeftOut):
            yield Chunk(name, problem=found.why)
        elif path.resolve() != root / path.relative_to(folder):
            yield Chunk(name, problem="a link; put the file itself here")
        else:
            yield _chunk(path, name, levels)


def _chunk(path: Path, name: str, levels: Mapping[str, Level]) -> Chunk:
    try:
        text = decoded(read_bytes(path, MOST_BYTES), name)
        if is_replay(text):
            return Chunk(name, text=_whole(text, levels))
        records = records_of(text, name)
    except NinjaGameError as error:
        return Chunk(name, problem=str(error).removeprefix(f"{path}: "))
    except OSError as error:
        return Chunk(name, problem=error.strerror or str(error))
    if len(records) > MOST_RECORDS:
        return Chunk(name, problem=f"{len(records)} recordings in one file; at most {MOST_RECORDS}")
    return Chunk(name, records=tuple(records)) if records else Chunk(name, text=text)


def _whole(text: str, levels: Mapping[str, Level]) -> str:
    """The replay's text, with a level inside and everything in it that it takes in. Raises ReplayError, LevelError."""
    # Without the name of a file nothing in it leads to another one.
    parsed = parse_replay(text)
    level = parsed.level or levels.get(parsed.level_digest)
    if level is None:
        raise ReplayError("it holds no level, and its level-digest is of none that counts")
    return write_replay(replace(parsed, level=level, level_path="", level_record=0))


def recordings_in_chunk(chunk: Chunk) -> list[Recording | None]:
    """The recordings of a chunk, as many as it has results; None for what cannot be read."""
    if chunk.problem:
        return [None]
    if chunk.records:
        found = recordings_of(chunk.records, chunk.file)
    else:
        found = recording_of_text(chunk.text, chunk.file, named=True)
    return [None if isinstance(each, Unreadable) else each for each in found]
