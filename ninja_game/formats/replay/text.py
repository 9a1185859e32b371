"""Our replay text: what was played, the inputs, and what must come out of them (`docs/replay-format.md`)."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ninja_game.errors import ReplayError
from ninja_game.formats.ascii.reader import parse_ascii_level, write_ascii_level
from ninja_game.formats.lines import Line, numbered_lines
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.numbers import NAN
from ninja_game.formats.replay.headers import COUNT_LIMIT, Headers
from ninja_game.formats.replay.input_runs import read_inputs, write_inputs
from ninja_game.sim.inputs import MAX_TICKS, first_ticks
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import BODIES, Body
from ninja_game.sim.rules import TICKS_PER_SECOND

MAGIC = "ninja-game replay"
VERSION = 2
"""Version 1 had another digest: of the world's inner state."""
RULES_VERSION = 1
"""The rules that replays are recorded under; a change of the world that changes any replay raises it."""

OUTCOMES = ("exit", "dead", "running")


class Waypoint(NamedTuple):
    """Where the ninja is after a tick: px, and its state by name."""

    tick: int
    x: float
    y: float
    state: str


WAYPOINT_TICKS = TICKS_PER_SECOND
"""How far apart a recorder sets waypoints: a second."""


@dataclass(frozen=True)
class Replay:
    """A run of one level: inputs, and what they lead to.

    ``inputs``: one byte a tick, the sum of its ``Input`` flags; in ticks beyond them no key is down. ``final_tick``:
    the last tick that is run, counted from 0; ``outcome``, ``gold`` and ``digest`` (64 hex digits of what the world
    shows, or '') are as after it. The level is given by one or more of: its digest, a path from the replay's folder
    with the number of the record in that file, the level itself with its name and author. ``waypoints``: where the
    ninja passes, by tick, so that a run that goes another way is noticed where it does. ``practice``: it was made in
    practice, or with its tools.
    """

    inputs: bytes
    final_tick: int
    outcome: str
    gold: int = 0
    digest: str = ""
    name: str = ""
    author: str = ""
    body: Body = "circle"
    rules: int = RULES_VERSION
    level_digest: str = ""
    level_path: str = ""
    level_record: int = 0
    level: Level | None = None
    level_name: str = ""
    level_author: str = ""
    waypoints: tuple[Waypoint, ...] = ()
    practice: bool = False

    @property
    def ticks(self) -> int:
        """How many ticks are run."""
        return self.final_tick + 1

    def playback(self, ticks: int) -> bytes:
        """The input of each of the first ``ticks`` ticks."""
        return first_ticks(self.inputs, ticks)


_FIRST_LINE = re.compile(rf"{MAGIC} +([0-9]{{1,9}})[ \t]*")


def is_replay(text: str) -> bool:
    """Whether a text begins as a replay of ours does."""
    return text.lstrip("\ufeff \t\r\n").startswith(MAGIC)


def parse_replay(text: str, *, file: str = "") -> Replay:
    """The replay that a text describes.

    Raises ReplayError, naming line and column, for whatever is not as `docs/replay-format.md` says; LevelError for the
    level inside.
    """
    lines = [(number, line) for number, line in numbered_lines(text) if not line.startswith(";")]
    _check_first_line(lines, file)
    headers = Headers(lines[1:], file)
    level, level_name, level_author = _read_level(headers.section("level-data"), file)
    replay = Replay(
        inputs=read_inputs(headers.section("inputs"), file=file),
        final_tick=headers.count("final-tick"),
        outcome=headers.choice("outcome", OUTCOMES),
        gold=headers.count("gold"),
        digest=headers.digest("digest"),
        name=headers.text("name"),
        author=headers.text("author"),
        body=headers.choice("body", BODIES),
        rules=headers.count("rules"),
        level_digest=headers.digest("level-digest"),
        level_path=headers.text("level"),
        level_record=headers.count("level-record"),
        level=level,
        level_name=level_name,
        level_author=level_author,
        waypoints=read_waypoints(headers.section("waypoints"), file),
        practice="practice" in headers.lines and headers.choice("practice", ("yes", "no")) == "yes",
    )
    problem = _contradiction(replay)
    if problem:
        key, error = problem
        error.file, error.line = file, headers.line(key)
        raise error
    return replay


def _check_first_line(lines: Sequence[Line], file: str) -> None:
    """Raise ReplayError unless the first line says what this is."""
    number, first = lines[0] if lines else (1, "")
    match = _FIRST_LINE.fullmatch(first)
    expected = f"'{MAGIC} {VERSION}' in the first line"
    if match is None:
        raise ReplayError("not a replay of ninja-game", file, number, 1, repr(first[:40]), expected)
    if int(match[1]) != VERSION:
        what, hint = "unknown version of the replay format", "a replay from a newer ninja-game needs a newer ninja-game"
        if int(match[1]) == 1:
            what = "a replay written by an older version of ninja-game, with a digest that is no longer used"
            hint = f"write '{MAGIC} {VERSION}' in the first line and delete the line 'digest:'"
        raise ReplayError(what, file, number, 1, match[1], str(VERSION), hint)


def _level_text(level: Level, replay: Replay) -> str:
    return write_ascii_level(level, name=replay.level_name, author=replay.level_author)


def _read_level(lines: Sequence[Line], file: str) -> tuple[Level | None, str, str]:
    """The embedded ASCII level (None without one), its name and author. Raises LevelError with the replay's line."""
    if not lines:
        return None, "", ""
    text = [""] * lines[-1][0]
    for number, line in lines:
        text[number - 1] = line
    read = parse_ascii_level("\n".join(text), file=file)
    level = read.level
    # With one and the same NaN everywhere a replay equals the one that was written.
    one_nan = [tuple(NAN if math.isnan(value) else value for value in record.values) for record in level.objects]
    records = [record._replace(values=values) for record, values in zip(level.objects, one_nan, strict=True)]
    return Level(level.tiles, tuple(records)), read.name, read.author


def read_waypoints(lines: Sequence[Line], file: str) -> tuple[Waypoint, ...]:
    """The waypoints of a replay, a line each: tick, x, y, state. Raises ReplayError with the line."""
    waypoints: list[Waypoint] = []
    for number, line in lines:
        words = line.split()
        try:
            tick, x, y, state = words
            waypoint = Waypoint(int(tick), float(x), float(y), state)
        except ValueError:
            expected = "tick, x, y and state, such as 39 166.5 563.0 jumping"
            raise ReplayError("not a waypoint", file, number, 3, repr(line.strip()[:40]), expected) from None
        if waypoint.tick <= (waypoints[-1].tick if waypoints else -1):
            raise ReplayError("waypoints out of order", file, number, 3, words[0], "ticks that grow")
        waypoints.append(waypoint)
    return tuple(waypoints)


def _contradiction(replay: Replay) -> tuple[str, ReplayError] | None:
    """What cannot be in a replay, with the header that it concerns; None if all is well."""
    counts = {"rules": replay.rules, "final-tick": replay.final_tick, "gold": replay.gold}
    for key, count in (counts | {"level-record": replay.level_record}).items():
        if not 0 <= count < COUNT_LIMIT:
            return key, ReplayError(
                f"a number that '{key}' cannot have", found=str(count), expected="a whole number from 0"
            )
    for key, word, words in (("body", replay.body, BODIES), ("outcome", replay.outcome, OUTCOMES)):
        if word not in words:
            return key, ReplayError(f"an unknown {key}", found=repr(word), expected=" or ".join(words))
    if replay.ticks > MAX_TICKS:
        return "final-tick", ReplayError("the replay is too long", expected=f"at most {MAX_TICKS} ticks")
    if len(replay.inputs) > replay.ticks:
        found = f"{len(replay.inputs)} ticks of inputs"
        hint = "raise final-tick or shorten the inputs"
        return "final-tick", ReplayError(
            "inputs after the final tick", found=found, expected=str(replay.ticks), hint=hint
        )
    if not (replay.level_digest or replay.level_path or replay.level):
        return "inputs", ReplayError("a replay without level", expected="'level:', 'level-digest:' or 'level-data:'")
    if replay.level and replay.level_digest and replay.level_digest != level_digest(replay.level):
        found = level_digest(replay.level)
        hint = "the level was changed after the recording"
        return "level-digest", ReplayError("the digest is not that of level-data", found=found, hint=hint)
    return None


def write_replay(replay: Replay) -> str:
    """The replay as text; reading it gives an equal replay.

    Raises ReplayError for a replay that contradicts itself, DemoError for an input above 15.
    """
    problem = _contradiction(replay)
    if problem:
        raise problem[1]
    headers = {
        "name": _text(replay.name),
        "author": _text(replay.author),
        "level": _text(replay.level_path),
        "level-record": str(replay.level_record or ""),
        "level-digest": replay.level_digest,
        "rules": str(replay.rules),
        "body": replay.body,
        "final-tick": str(replay.final_tick),
        "outcome": replay.outcome,
        "gold": str(replay.gold),
        "digest": replay.digest,
        "practice": "yes" * replay.practice,
    }
    lines = [f"{MAGIC} {VERSION}", *(f"{key}: {value}" for key, value in headers.items() if value)]
    lines += ["inputs:", *(f"  {line}" for line in write_inputs(replay.inputs))]
    if replay.waypoints:
        lines += ["waypoints:", *(f"  {tick} {x!r} {y!r} {state}" for tick, x, y, state in replay.waypoints)]
    if replay.level is not None:
        lines += ["level-data:", *(f"  {line}".rstrip() for line in _level_text(replay.level, replay).splitlines())]
    return "\n".join(lines) + "\n"


def _text(value: str) -> str:
    """A header's text; as JSON where it would not read back as it is."""
    plain = value == value.strip() and value.isprintable() and not value.startswith('"')
    return value if plain else json.dumps(value)
