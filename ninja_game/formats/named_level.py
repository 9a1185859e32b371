"""Levels with the other contents of their file. The text decides its format, not the file's name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Literal

from ninja_game.errors import LevelError, ReplayError
from ninja_game.files.bundled import bundled_levels
from ninja_game.files.reading import read_included
from ninja_game.formats.ascii.places import quoted
from ninja_game.formats.ascii.reader import is_ascii_level, parse_ascii_level
from ninja_game.formats.lines import numbered_lines
from ninja_game.formats.n14.level_file import MARKER, is_demo, read_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, tidy_level_string
from ninja_game.formats.replay.notations import is_tas_text
from ninja_game.formats.replay.text import Replay, is_episode, is_replay, parse_episode, parse_replay
from ninja_game.sim.level import TILES, Level

TextFormat = Literal["replay", "episode", "ascii", "file", "demo", "inputs", "string"]
"""A replay, an episode of replays, an ASCII level, a file of N's records, a demo of N alone, inputs in another tool's
notation, in-game strings of levels or anything else."""


def format_of(text: str) -> TextFormat:
    """Recognise the format of a text, valid or not.

    >>> [format_of(text) for text in ("ninja-game level 1", "$hill#us##0|5^60,540#", "3:12|0|1", "0|5^60,540")]
    ['ascii', 'file', 'demo', 'string']
    """
    if is_replay(text):
        return "replay"
    if is_episode(text):
        return "episode"
    if is_ascii_level(text):
        return "ascii"
    if MARKER in text or ("#" in text and "$" in text):
        return "file"
    # Labels and comments of CelesteTAS begin with # too; only N's own texts contain |.
    if text.lstrip().startswith("#") and ("|" in text or not is_tas_text(text)):
        return "file"
    if is_demo("".join(text.split())):
        return "demo"
    return "inputs" if is_tas_text(text) else "string"


# The alphabet of the objects in an in-game string, with numbers that no object can have.
_OBJECTS = re.compile(r"[0-9.,^!+\-xeENa \t]+")
_TILE = re.compile(r"[0-Q]")


@dataclass(frozen=True)
class NamedLevel:
    """A level with the other contents of its file; only ASCII levels have ``teaches`` and ``says``.

    ``form``: the format of its file; ``record`` (from 0) and ``line`` (from 1): its place in ``file``.
    """

    name: str
    author: str
    comment: str
    level: Level
    file: str
    record: int = 0
    line: int = 1
    form: TextFormat = "file"
    teaches: str = ""
    says: str = ""

    @property
    def ascii(self) -> bool:
        """Whether the file is in the ASCII format."""
        return self.form == "ascii"


def parse_levels(text: str, *, file: str = "") -> list[NamedLevel]:
    """Read all levels in a text of any format. Raises LevelError or ReplayError."""
    form = format_of(text)
    if form in ("replay", "episode"):
        replays = [parse_replay(text, file=file)] if form == "replay" else parse_episode(text, file=file)
        levels = [level_of_replay(replay, file) for replay in replays]
        return [
            NamedLevel(replay.level_name or replay.name, replay.level_author, "", level, file, number, form=form)
            for number, (replay, level) in enumerate(zip(replays, levels, strict=True))
        ]
    if form == "ascii":
        read = parse_ascii_level(text, file=file)
        fields = read.name or Path(file).stem, read.author, read.comment, read.level, file
        return [NamedLevel(*fields, form=form, teaches=read.teaches, says=read.says)]
    if form == "file":
        named_levels = []
        for record in read_level_file(text, file=file):
            if record.level:
                level = parse_level_string(record.level, file=file, line=record.line)
                named = record.name, record.author, record.comment, level, file, record.number, record.line
                named_levels.append(NamedLevel(*named))
        if not named_levels:
            raise LevelError("recordings without their levels", file, hint="give the level file")
        return named_levels
    strings = [(line, parse_level_string(string, file=file, line=line)) for line, string in _level_strings(text, file)]
    stem = Path(file).stem
    return [NamedLevel(stem, "", "", level, file, k, line, "string") for k, (line, level) in enumerate(strings)]


def _level_strings(text: str, file: str) -> Iterator[tuple[int, str]]:
    """Line and text of the in-game strings in a text: one per line, or one wrapped over all lines."""
    lines = list(numbered_lines(text))
    if len(lines) > 1 and not all(len(line.partition("|")[0]) >= TILES for _, line in lines):
        lines = [(lines[0][0], tidy_level_string(text))]
    for number, line in lines:
        if not is_level_string(line):
            expected = "an ASCII level, a level file of N or an in-game string"
            hint = "'ninja-game convert 00-0-first-steps - --to ascii --legend' shows how to write a level"
            raise LevelError(
                "not a level in any format that is known here", file, number, 0, repr(line[:40]), expected, hint
            )
        yield number, line
    if not lines:
        raise LevelError("an empty file", file, expected="a level")


def is_level_string(text: str) -> bool:
    """Whether a line may be an in-game string: tiles make up most of its first half, objects its second half."""
    tiles, bar, objects = text.partition("|")
    if not bar or 2 * len(_TILE.findall(tiles[:TILES])) < min(len(tiles), TILES):
        return False
    return len(tiles) >= TILES or _OBJECTS.fullmatch(objects) is not None


def level_of_replay(replay: Replay, file: str, level: Level | None = None, *, changed: bool = False) -> Level:
    """The level on which a replay was recorded: its own, the one at its path, the given one, or one of the game's.

    Raises ReplayError if there is none, or if it differs from the recorded one, unless ``changed``.
    """
    if replay.level is not None:
        return replay.level
    source = "the given level"
    if replay.level_path:
        included = read_included(file, replay.level_path)
        source = included.path
        if included.problem:
            raise ReplayError("the replay's level cannot be read", file, found=source, hint=included.problem)
        if included.text is not None:
            level = _level_in(included.text, source, replay.level_record, file)
    if level is None and not replay.level_path:
        level = _levels_by_digest().get(replay.level_digest)
    if level is None:
        hint = "give it with --level, or record the replay with its level inside"
        named = quoted(replay.level_path) if replay.level_path else f"level-digest {replay.level_digest[:12]}…"
        if not source:
            hint = "'level:' leads to a file in the replay's folder or below it only"
        raise ReplayError("the replay's level is not here", file, found=named, hint=hint)
    if replay.level_digest and not changed and level_digest(level) != replay.level_digest:
        hint = "the level was changed after the recording; `ninja-game tas` opens the run on the changed level"
        raise ReplayError("not the level of this replay", file, found=source, expected=replay.level_digest, hint=hint)
    return level


@cache
def _levels_by_digest() -> dict[str, Level]:
    """The game's own levels."""
    own = (level for path in bundled_levels() for level in parse_levels(path.read_text("utf-8"), file=str(path)))
    return {level_digest(named.level): named.level for named in own}


def _level_in(text: str, place: str, record: int, file: str) -> Level:
    if is_replay(text) or is_episode(text):
        raise ReplayError("a replay as the level of a replay", file, found=place, expected="a level file")
    for level in parse_levels(text, file=place):
        if level.record == record:
            return level.level
    raise ReplayError("the replay's level is not in its file", file, found=place, expected=f"a record {record}")
