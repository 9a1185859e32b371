"""Recordings (inputs and their level) from a text of any format."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from ninja_game.errors import DemoError, ReplayError
from ninja_game.files.shown_text import file_stem
from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.level_file import LevelRecord, read_level_file
from ninja_game.formats.n14.level_string import parse_level_string, write_level_string
from ninja_game.formats.named_level import TextFormat, format_of, is_level_string, level_of_replay
from ninja_game.formats.replay.input_text import include_reader, read_inputs
from ninja_game.formats.replay.notations import in_our_notation
from ninja_game.formats.replay.provenance import with_provenance, without_provenance
from ninja_game.formats.replay.text import Replay, episode_key, lifetimes, parse_episode, parse_replay
from ninja_game.sim.inputs import Demo, fit_demo
from ninja_game.sim.level import Body, Level
from ninja_game.sim.rules import LIFETIME

MAX_LEGACY_TICKS = 20_000_000
"""Most ticks in one file of demos of an older version, in which a character can mean 400 ticks."""


@dataclass(frozen=True)
class Recording:
    """A replay with its level, and its place in a file.

    ``replay``: the content of its text; demos of N and other tools' inputs are replays without claims. ``level``: the
    level inside the text, at its path, or given by the caller. ``record`` (from 0) and ``line`` (from 1): place in
    ``file``, '' if there is no file. ``episode``: the key of its episode, if any; ``lifetime``: ticks at its start.
    """

    level: Level
    replay: Replay = field(repr=False)
    comment: str = ""
    file: str = ""
    record: int = 0
    line: int = 1
    form: TextFormat = "replay"  #: the kind of text that it is from
    episode: str = ""
    lifetime: int = LIFETIME

    @property
    def of_n(self) -> bool:
        """Whether it is a record of N itself that contains its level."""
        return self.form == "file"

    @property
    def name(self) -> str:
        """The name in its text; for a replay without a name that of its file."""
        return self.replay.name or ("" if self.of_n else Path(self.file).stem)

    @property
    def author(self) -> str:
        """The author in its text; in a record of N the level and the run have the same one."""
        return self.replay.author

    @property
    def player(self) -> str:
        """The player, "" if unknown; the name in a record of N is that of its level's author.

        A replay that says how its run was made comes from this program, which writes the player's name.
        """
        return self.author if not self.of_n or self.replay.made.assisted is not None else ""

    @property
    def begun_by(self) -> str:
        """The author to name in a run that starts from this one; for a run found by commands, the one that it names."""
        made, file = self.replay.made, Path(self.file).name or self.name
        searched = made.searches and not (made.played or made.edits)
        return self.player or (made.begun_by if searched else f"unknown ({file_stem(file, 'no file')})")

    @property
    def level_author(self) -> str:
        """The level's author, "" if unknown."""
        return self.replay.level_author or ("" if self.player else self.author)

    @property
    def place(self) -> str:
        """The name of its file, with the record's number if the file has several."""
        name = Path(self.file).name.removesuffix(REPLAY_SUFFIX)
        return f"{name} {self.record}" if self.record > 0 else name

    @property
    def whose(self) -> str:
        """Its name in a list of runs: its player, or its file if the player is unknown."""
        return self.player or self.place or self.name

    @property
    def credit(self) -> str:
        """The player and how the run was made, as in ``Replay.credit``; for a record of N the level's author."""
        return replace(self.replay, author=self.player).credit

    @property
    def title(self) -> str:
        """The title above its picture, with the player, or the file if it comes from one."""
        credit = replace(self.replay, author=self.whose).credit if self.file else ""
        return " - ".join(dict.fromkeys(filter(None, (self.replay.name or self.place, credit)))) or "Replay"

    @property
    def body(self) -> Body:
        """The ninja's body."""
        return self.replay.body

    @property
    def ticks(self) -> int:
        """The most ticks that it runs; N + 1 for a demo of length N."""
        return self.replay.ticks

    @cached_property
    def inputs(self) -> bytes:
        """The inputs of its ticks, one byte per tick."""
        return self.replay.playback(self.ticks)

    @property
    def missing(self) -> int:
        """Number of inputs that its demo claims but its text lacks; no key is down in them."""
        inputs, length = self.replay.inputs, self.replay.demo_length
        return 0 if length is None else Demo(inputs, length).end - len(inputs)


def record_of(recording: Recording) -> LevelRecord:
    """Make the record of N, ``$name#author#comment#level#demo#``, of a recording and its level.

    Raises LevelError, DemoError or ReplayError for content that such a record cannot hold.
    """
    replay, inputs = recording.replay, recording.inputs
    if recording.body != "circle":
        raise ReplayError("a run with another body is not a demo of N", recording.file, found=recording.body)
    if replay.demo_length is not None:
        demo = fit_demo(replay.inputs, replay.demo_length)
    else:
        # A demo of length N runs N + 1 ticks, the last one without inputs of its own (game.md §4.4).
        short = Demo(inputs[:-1], float(len(inputs) - 1))
        demo = short if short.playback(len(inputs)) == inputs else Demo(inputs, float(len(inputs)))
    level = write_level_string(recording.level, exact=True)
    comment = with_provenance(recording.comment, replay.made, replay.co_authors)
    return LevelRecord(recording.name, recording.author or replay.level_author, comment, level, write_demo(demo))


def holds_recordings(text: str) -> bool:
    """Whether a text contains recordings, valid or not. Raises LevelError for a broken level file."""
    form = format_of(text)
    return any(record.demo for record in read_level_file(text)) if form == "file" else form not in {"ascii", "string"}


def parse_replays(text: str, *, file: str = "", level: Level | None = None, changed: bool = False) -> list[Recording]:
    """Read all recordings in a text of any format. ``changed``: accept replays whose level has changed since.

    Raises ReplayError, DemoError or LevelError.
    """
    match format_of(text):
        case "replay":
            replay = parse_replay(text, file=file, level=level)
            return [Recording(level_of_replay(replay, file, level, changed=changed), replay, file=file)]
        case "episode":
            replays = parse_episode(text, file=file)
            levels = [level_of_replay(replay, file, changed=changed) for replay in replays]
            key = episode_key(levels)
            rows = zip(levels, replays, lifetimes(replays), strict=False)
            return [
                Recording(on, run, "", file, number, 1, "episode", key, lifetime)
                for number, (on, run, lifetime) in enumerate(rows)
            ]
        case "file":
            return _read_recordings(read_level_file(text, file=file), file, level)
        case "demo":
            record = LevelRecord(Path(file).stem, "", "", "", "".join(text.split()), line=1)
            return _read_recordings([record], file, level)
        case "inputs":
            return [_recording_of_lines(text, file, level)]
    raise ReplayError(
        "no recording", file, 1, found=repr(text[:40]), expected="a replay of ours or $name#author#comment#level#demo#"
    )


def _recording_of_lines(text: str, file: str, level: Level | None) -> Recording:
    """Read inputs in the notation of another tool. Raises ReplayError."""
    if level is None:
        raise ReplayError("inputs without a level", file, hint="give it with --level")
    read = read_inputs(in_our_notation(text, file), file=file, include=include_reader(file))
    replay = Replay.of_inputs(read.keys, level, name=Path(file).stem, markers=read.markers)
    return Recording(level, replay, file=file, form="inputs")


def _read_recordings(records: Iterable[LevelRecord], file: str, level: Level | None) -> list[Recording]:
    """Read the recordings in the records of a text; a level that several records share is read once."""
    known: dict[str, Level] = {}
    recordings = []
    legacy_ticks = 0
    for record in records:
        if record.level and record.demo and record.level not in known:
            known[record.level] = parse_level_string(record.level, file=file, line=record.line)
        recordings.append(demo_recording(record, file, known.get(record.level, level)))
        legacy_ticks += recordings[-1].ticks if record.demo.startswith("A") else 0
        if legacy_ticks > MAX_LEGACY_TICKS:
            what = "the demos of older versions in this file are too long together"
            hint = "split the file, or `ninja-game verify` it, which reads one record after the other"
            raise ReplayError(what, file, record.line, found=f"more than {MAX_LEGACY_TICKS:,} ticks", hint=hint)
    return recordings


def demo_recording(record: LevelRecord, file: str, level: Level | None) -> Recording:
    """Read the demo of a record, on its level. Raises ReplayError or DemoError with ``file`` and the record."""
    if not record.demo:
        found = repr(record.note[:40]) if record.note else ""
        other = record.level and not is_level_string(record.level)
        what = "not a recording" if other else f"record {record.number} has no demo"
        expected = "$name#author#comment#level#demo#"
        raise ReplayError(what, file, record.line, 0, found, expected)
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
    comment, made, co_authors = without_provenance(record.comment)
    replay = replace(demo_replay(demo, level, record.name, record.author), made=made, co_authors=co_authors)
    return Recording(level, replay, comment, file, record.number, record.line, "file")


def demo_replay(demo: Demo, level: Level, name: str = "", author: str = "") -> Replay:
    """Make a replay without claims from a demo of N and its level; both get the same name."""
    held = demo.inputs[: len(demo.inputs) - demo.missing]
    return Replay(held, demo.end, "", name=name, author=author, level=level, level_name=name, demo_length=demo.length)
