"""The runs of a folder, as chunks to verify. Nothing outside the folder is read, and nothing large."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from ninja_game.errors import NinjaGameError, ReplayError, reason
from ninja_game.files.reading import LeftOut, decoded, files_below, read_bytes
from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.recording import holds_recordings
from ninja_game.formats.replay.text import Replay, is_replay, parse_replay, write_replay
from ninja_game.runs.chunks import Chunk
from ninja_game.runs.recording_reader import records_of
from ninja_game.sim.level import Level

MOST_BYTES = 2**20
"""Of a file: a hundred times a long run."""

MOST_RECORDS = 200
"""Of one file with records of N."""


@dataclass(frozen=True)
class Sent:
    """A run, or what cannot be one, as a chunk with one result. ``replay``: where it is one of ours."""

    chunk: Chunk
    replay: Replay | None = None

    def inputs(self, ticks: int) -> bytes:
        """The inputs of its first ticks, where it is a run."""
        return (self.replay or parse_demo(self.chunk.records[0].demo)).playback(ticks)


def sent_below(folder: Path, levels: Mapping[str, Level]) -> Iterator[Sent]:
    """What the files of the folder hold, by their paths from there; a file that is refused says why.

    ``levels``: those that count, by digest; replays that hold no level are given theirs; paths in them are not
    followed.
    """
    for found in files_below(folder, follow_links=False):
        path = found.path if isinstance(found, LeftOut) else found
        name = path.relative_to(folder).as_posix()
        if isinstance(found, LeftOut):
            yield Sent(Chunk(name, problem=found.why))
        else:
            yield from _sent(path, name, levels)


def _sent(path: Path, name: str, levels: Mapping[str, Level]) -> list[Sent]:
    try:
        text = decoded(read_bytes(path, MOST_BYTES), name)
        if is_replay(text):
            replay = _whole(text, levels)
            return [Sent(Chunk(name, text=write_replay(replay)), replay)]
        records = records_of(text, name)
        if not records and holds_recordings(text):
            raise ReplayError("inputs without a level", hint="send a replay, or a record of N")
    except NinjaGameError as error:
        return [Sent(Chunk(name, problem=str(error).removeprefix(f"{path}: ")))]
    except OSError as error:
        return [Sent(Chunk(name, problem=reason(error)))]
    if len(records) > MOST_RECORDS:
        return [Sent(Chunk(name, problem=f"{len(records)} recordings in one file; at most {MOST_RECORDS}"))]
    chunks = [Chunk(name, index, records=(record,)) for index, record in enumerate(records)]
    return [Sent(chunk) for chunk in chunks or [Chunk(name, text=text)]]


def _whole(text: str, levels: Mapping[str, Level]) -> Replay:
    """The replay, with a level inside and everything in it that it takes in. Raises ReplayError, LevelError."""
    # Without the name of a file nothing in it leads to another one.
    parsed = parse_replay(text)
    level = parsed.level or levels.get(parsed.level_digest)
    if level is None:
        raise ReplayError("it holds no level, and its level-digest matches no level that counts")
    return replace(parsed, level=level, level_path="", level_record=0)
