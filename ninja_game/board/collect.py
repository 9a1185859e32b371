"""The runs of a folder, as chunks to verify. Only files in the folder are read, and no large ones."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from hashlib import sha256
from pathlib import Path

from ninja_game.errors import FileError, NinjaGameError, ReplayError, reason
from ninja_game.files.reading import Skipped, decoded, file_stamp, files_below, read_bytes
from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.recording import holds_recordings
from ninja_game.formats.replay.text import (
    InputsAfterError,
    Replay,
    is_episode,
    is_replay,
    parse_episode,
    parse_replay,
    write_episode,
    write_replay,
)
from ninja_game.runs.chunks import Chunk
from ninja_game.runs.recording_reader import records_of
from ninja_game.sim.level import Level

_MAX_BYTES = 2**20  # size of a file: a hundred times a long run

SETTLED = 2 * 10**9  # nanoseconds until a file's time is certain to show a change

MAX_RECORDS = 200  # recordings in one file with records of N


def is_in(path: Path, folder: Path) -> bool:
    """Whether a path, which need not exist yet, is a folder or leads into it; links are followed."""
    place = path.resolve()
    return folder.exists() and any(parent.exists() and parent.samefile(folder) for parent in (place, *place.parents))


@dataclass(frozen=True)
class SubmittedFile:
    """A file by its path in the folder: its content, or the reason for its refusal."""

    name: str
    data: bytes = field(default=b"", repr=False)
    problem: str = ""

    @cached_property
    def digest(self) -> str:
        """Sha256 (hex) of its name and content."""
        return sha256(f"{self.name}\0{self.problem}\0".encode("utf-8", "surrogateescape") + self.data).hexdigest()


@dataclass(frozen=True)
class Submission:
    """A recording as a chunk with one result. ``replay``: the parsed replay, if it is in our format.

    ``claimed``: the final tick that the replay claims, if inputs follow it; else -1. All inputs are run in both cases.
    """

    chunk: Chunk
    replay: Replay | None = None
    claimed: int = -1

    def inputs(self, ticks: int) -> bytes:
        """The inputs of its first ticks, if it is a run."""
        return (self.replay or parse_demo(self.chunk.records[0].demo)).playback(ticks)


def _parsed(text: str) -> tuple[Replay, int]:
    """A replay, and ``claimed`` as in Submission. Raises NinjaGameError."""
    try:
        return parse_replay(text), -1
    except InputsAfterError as error:
        return replace(error.replay, final_tick=len(error.replay.inputs)), error.replay.final_tick


class RunFolder:
    """A folder of runs. ``levels``: the board's, by digest; they are given to replays without a level inside."""

    def __init__(self, folder: Path, levels: Mapping[str, Level]) -> None:
        self.folder = folder
        self.levels = levels
        self._last: tuple[str, list[Submission]] = "", []
        self.known: dict[tuple[str, int], bytes] = {}
        """Inputs of recently judged runs, by file and record."""

    def forget(self, key: tuple[str, int]) -> None:
        """Drop the inputs of a run whose pages are written: all of them would take much memory."""
        self.known.pop(key, None)

    def files(self) -> Iterator[tuple[str, str]]:
        """The paths of all files in the folder, with the reason if one is left out; links are not followed."""
        above = len(self.folder.parts)
        for file in files_below(self.folder, follow_links=False):
            path, why = (file.path, file.why) if isinstance(file, Skipped) else (file, "")
            yield "/".join(path.parts[above:]), why

    def file(self, name: str) -> SubmittedFile:
        """Read a file by its path in the folder."""
        path = self.folder / name
        try:
            return SubmittedFile(name, read_bytes(path, _MAX_BYTES))
        except NinjaGameError as error:
            return SubmittedFile(name, problem=str(error).removeprefix(f"{path}: "))
        except OSError as error:
            return SubmittedFile(name, problem=reason(error))

    def stamp(self, name: str) -> list[int]:
        """``file_stamp`` of a file; [] for one so new that a further change might not show."""
        now = file_stamp(f"{self.folder}/{name}")
        return now if now and time.time_ns() - max(now[1:3]) > SETTLED else []

    def recordings(self, file: SubmittedFile) -> list[Submission]:
        """The recordings of a file, or the reason for its refusal. Paths in replays are not followed."""
        name = file.name
        if file.problem:
            return [Submission(Chunk(name, problem=file.problem))]
        try:
            text = decoded(file.data, name)
            if is_replay(text):
                # Without a file name no path in the file leads to another one.
                parsed, claimed = _parsed(text)
                whole = self._whole(parsed)
                is_as_sent = whole is parsed and claimed < 0
                return [Submission(Chunk(name, text=text if is_as_sent else write_replay(whole)), whole, claimed)]
            if is_episode(text):
                runs = [self._whole(run) for run in parse_episode(text)]
                text = write_episode(runs)
                return [Submission(Chunk(name, number, text), run) for number, run in enumerate(runs)]
            records = records_of(text, name)
            if not records and holds_recordings(text):
                raise ReplayError("inputs without a level", hint="send a replay, or a record of N")
        except NinjaGameError as error:
            return [Submission(Chunk(name, problem=str(error)))]
        if len(records) > MAX_RECORDS:
            return [Submission(Chunk(name, problem=f"{len(records)} recordings in one file; at most {MAX_RECORDS}"))]
        chunks = [Chunk(name, index, records=(record,)) for index, record in enumerate(records)]
        return [Submission(chunk) for chunk in chunks or [Chunk(name, text=text)]]

    def inputs(self, name: str, record: int, digest: str, ticks: int) -> bytes:
        """The inputs of a run, read again. Raises FileError if its file has changed since it was judged."""
        if (name, record) not in self.known:
            if self._last[0] != digest:
                file = self.file(name)
                if file.digest != digest:
                    raise FileError("the file was changed while the board was made", name, hint="start again")
                self._last = digest, self.recordings(file)  # a file may hold many: it is parsed once
            self.known[name, record] = self._last[1][record].inputs(ticks)
        return self.known[name, record]

    def _whole(self, parsed: Replay) -> Replay:
        """The replay with its level inside, without a path. Raises ReplayError."""
        if parsed.level is not None and not parsed.level_path:
            return parsed
        level = parsed.level or self.levels.get(parsed.level_digest)
        if level is None:
            raise ReplayError("it holds no level, and its level-digest matches no level that counts")
        return replace(parsed, level=level, level_path="", level_record=0)
