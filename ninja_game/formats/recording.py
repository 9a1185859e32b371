"""Recordings, inputs with the level they were made on, from a text of any format."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from ninja_game.errors import DemoError, ReplayError
from ninja_game.formats.ascii.reader import is_ascii_level
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.level_file import LevelRecord, is_demo, read_level_file
from ninja_game.formats.n14.level_string import parse_level_string, write_level_string
from ninja_game.formats.named_level import is_level_file, level_of_replay
from ninja_game.formats.replay.includes import included_beside
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.formats.replay.text import Replay, is_replay, parse_replay
from ninja_game.formats.tas_lines import in_our_notation, is_tas_text
from ninja_game.sim.inputs import Demo, fitted_demo
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import Body


@dataclass(frozen=True)
class Recording:
    """Inputs together with the level they were recorded on.

    ``replay``: the whole replay if it is one of ours, else None; ``record`` (from 0) and ``line`` (from 1): where in
    ``file``.
    """

    name: str
    author: str
    comment: str
    level: Level
    demo: Demo
    file: str
    record: int = 0
    line: int = 1
    replay: Replay | None = field(default=None, repr=False)

    @property
    def ticks(self) -> int:
        """How many ticks to run it at most: those of our replay; N + 1 for a demo of length N."""
        return self.replay.ticks if self.replay else self.demo.end + 1

    @property
    def body(self) -> Body:
        """The ninja's body: as a replay of ours says, else the circle of the classic rules."""
        return self.replay.body if self.replay else "circle"

    def playback(self, ticks: int) -> bytes:
        """The input of each of the first ``ticks`` ticks."""
        return self.replay.playback(ticks) if self.replay else self.demo.playback(ticks)


def record_of(recording: Recording) -> LevelRecord:
    """The record of N, ``$name#author#comment#level#demo#``, that holds a recording and its level.

    Raises LevelError, DemoError or ReplayError for what such a record cannot hold.
    """
    demo = recording.demo
    if recording.body != "circle":
        raise ReplayError("a run with another body is no demo of N", recording.file, found=recording.body)
    if recording.replay and recording.replay.demo_length is None:
        # A demo of length N runs N + 1 ticks, the last one without inputs of its own (game.md §4.4).
        inputs = recording.playback(recording.ticks)
        short = Demo(inputs[:-1], float(len(inputs) - 1))
        demo = short if short.playback(len(inputs)) == inputs else Demo(inputs, float(len(inputs)))
    level = write_level_string(recording.level, exact=True)
    return LevelRecord(recording.name, recording.author, recording.comment, level, write_demo(demo))


def holds_recordings(text: str) -> bool:
    """Whether there are recordings in a text, readable or not. Raises LevelError for a broken level file."""
    if is_replay(text):
        return True
    if is_ascii_level(text):
        return False
    if is_level_file(text):
        return any(record.demo for record in read_level_file(text))
    return is_demo("".join(text.split())) or is_tas_text(text)


def parse_replays(
    text: str, *, file: str = "", level: Level | None = None, changed: bool = False
) -> list[Recording]:  # fmt: skip
    """All recordings in a text of any format. ``changed``: also a replay whose level is not as it was recorded.

    Raises ReplayError, DemoError or LevelError.
    """
    if is_replay(text):
        replay = parse_replay(text, file=file, level=level)
        length = float(len(replay.inputs)) if replay.demo_length is None else replay.demo_length
        demo = fitted_demo(replay.inputs, length)
        found = level_of_replay(replay, file, level, changed=changed)
        return [Recording(replay.name or Path(file).stem, replay.author, "", found, demo, file, replay=replay)]
    if not is_ascii_level(text) and is_level_file(text):
        return _read_recordings(read_level_file(text, file=file), file, level)
    if is_demo("".join(text.split())):
        record = LevelRecord(Path(file).stem, "", "", "", "".join(text.split()), line=1)
        return _read_recordings([record], file, level)
    if is_tas_text(text):
        return [_recording_of_lines(text, file, level)]
    raise ReplayError(
        "no recording",
        file,
        1,
        found=repr(text[:40]),
        expected="a replay of ours or $name#author#comment#level#demo#",
    )


def _recording_of_lines(text: str, file: str, level: Level | None) -> Recording:
    """Inputs in the notation of another tool, as an unclaimed replay. Raises ReplayError."""
    if level is None:
        raise ReplayError("inputs without a level", file, hint="give it with --level")
    read = read_inputs(in_our_notation(text, file), file=file, include=included_beside(file))
    last = max(0, len(read.keys) - 1)
    replay = Replay(read.keys, last, "", name=Path(file).stem, level=level, markers=read.markers)
    return Recording(replay.name, "", "", level, Demo(read.keys, float(len(read.keys))), file, replay=replay)


def _read_recordings(records: Iterable[LevelRecord], file: str, level: Level | None) -> list[Recording]:
    """The recordings in the records of a text; a level that several share is read once."""
    known: dict[str, Level] = {}
    recordings = []
    for record in records:
        if record.level and record.demo and record.level not in known:
            known[record.level] = parse_level_string(record.level, file=file, line=record.line)
        recordings.append(recording_of(record, file, known.get(record.level, level)))
    return recordings


def recording_of(record: LevelRecord, file: str, level: Level | None) -> Recording:
    """A record with its demo read, on its level. Raises ReplayError or DemoError naming ``file`` and the record."""
    if not record.demo:
        raise ReplayError(
            f"record {record.number} has no demo",
            file,
            record.line,
            found=repr(record.note[:40]) if record.note else "",
            expected="$name#author#comment#level#demo#",
        )
    if level is None:
        raise ReplayError(
            f"record {record.number} leaves its level out", file, record.line, hint="give it with --level"
        )
    try:
        demo = parse_demo(record.demo)
    except DemoError as error:
        error.what += f" (character {error.column} of the demo)"
        error.file, error.line, error.column = file, record.line, 0
        raise
    return Recording(record.name, record.author, record.comment, level, demo, file, record.number, record.line)
