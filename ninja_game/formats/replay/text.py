"""Our replay text: level, inputs and their result; and an episode as several of these texts.

An episode has the replays of up to five levels in a row; the time left carries over (`docs/replay-format.md`).
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from ninja_game.errors import ReplayError
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.lines import Line, header_text, numbered_lines
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.numbers import format_number
from ninja_game.formats.pack.index import LEVELS_PER_EPISODE
from ninja_game.formats.replay.headers import COUNT_LIMIT, Headers, Waypoint, read_level, read_waypoints
from ninja_game.formats.replay.input_text import include_reader, read_inputs
from ninja_game.formats.replay.notations import Marker, is_marker_name, write_inputs
from ninja_game.formats.replay.provenance import UNKNOWN, Provenance, can_be_written
from ninja_game.sim.inputs import MAX_TICKS, Demo, fit_inputs
from ninja_game.sim.level import BODIES, Body, Level
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME, RULES_VERSION, TICKS_PER_SECOND

REPLAY_MAGIC = "ninja-game replay"
REPLAY_VERSION = 3
LAST_LINE = "end"  # the end of a replay with claims, so that a truncated text is noticed

OUTCOMES = ("exit", "dead", "running")
INPUTS_AFTER = "inputs after the final tick"
"""The error of a replay whose final tick was set before the end of its inputs."""

WAYPOINT_TICKS = TICKS_PER_SECOND  # ticks between the waypoints of a recorder: a second


@dataclass(frozen=True)
class Replay:
    """A run of one level: inputs and their result. Its level is known by digest or path, or is in the replay."""

    inputs: bytes  #: one byte per tick, the sum of its ``Input`` flags; after their end no key is down
    final_tick: int  #: the last tick that is run, from 0
    outcome: str  #: the outcome after the final tick, one of OUTCOMES; "": not claimed
    gold: int = 0  #: pieces after the final tick
    digest: str = ""  #: ``replay_digest`` of the world after the final tick, 64 hex digits; '': not claimed
    name: str = ""
    author: str = ""
    body: Body = "circle"
    rules: int = RULES_VERSION  #: version of the rules
    level_digest: str = ""
    level_path: str = ""  #: path of the level from the replay's folder
    level_record: int = 0  #: number of the record in that file, from 0
    level: Level | None = None
    level_name: str = ""
    level_author: str = ""
    waypoints: tuple[Waypoint, ...] = ()  #: places of the ninja, by tick; they show where a run takes another way
    made: Provenance = UNKNOWN  #: the way it was made, as the tools wrote it
    markers: tuple[Marker, ...] = ()  #: names of ticks, in order
    demo_length: float | None = None  #: the length that N's demo claims, in frames; None: not a demo
    co_authors: tuple[str, ...] = ()  #: people who took part besides ``author``

    @classmethod
    def of_inputs(cls, inputs: bytes, level: Level, **fields: Any) -> Self:
        """Make a replay without claims. ``fields``: other fields by their names."""
        return cls(inputs, max(0, len(inputs) - 1), "", level=level, **fields)

    @property
    def unclaimed(self) -> bool:
        """Whether it claims nothing about the result of its inputs."""
        return not self.outcome

    @property
    def practice(self) -> bool:
        """Whether it was played with practice tools or other help."""
        return bool(self.made.assists)

    @property
    def credit(self) -> str:
        """Its people, and the tools if it was not only played: ``Ann, Bob (edited, searched)``."""
        return " ".join(filter(None, (", ".join(filter(None, (self.author, *self.co_authors))), self.how)))

    @property
    def how(self) -> str:
        """The tools if it was not only played: ``(edited, searched)``."""
        made = self.made
        ways = (("assisted", made.assists), ("edited", made.edits), ("searched", made.searches))
        how = [way for way, used in ways if used]
        return f"({', '.join(how)})" if how else ""

    @property
    def end_tick(self) -> int:
        """The tick of the exit contact or death that it claims; -1 if it claims neither."""
        return self.final_tick if self.outcome in ("exit", "dead") else -1

    @property
    def ticks(self) -> int:
        """The number of ticks that are run."""
        return self.final_tick + 1

    @property
    def length(self) -> int:
        """Its length and time in ticks: the tick of exit contact or death, else all ticks that are run."""
        return self.ticks if self.end_tick < 0 else self.end_tick

    def playback(self, ticks: int) -> bytes:
        """The inputs of the first ``ticks`` ticks."""
        if self.demo_length is not None:
            return Demo(self.inputs, self.demo_length).playback(ticks)
        return fit_inputs(self.inputs, ticks)


class InputsAfterError(ReplayError):
    """A replay has inputs after its final tick. ``replay``: the replay as read."""

    replay: Replay


_FIRST_LINE = re.compile(rf"{REPLAY_MAGIC} +([0-9]{{1,9}})[ \t]*")


def is_replay(text: str) -> bool:
    """Whether a text begins like a replay of this program."""
    return text.lstrip("\ufeff \t\r\n").startswith(REPLAY_MAGIC)


def parse_replay(text: str, *, file: str = "", level: Level | None = None) -> Replay:
    """Read a replay. ``level``: the level to use if the text names none.

    Raises ReplayError, with the place, for deviations from docs/replay-format.md; LevelError for the level inside.
    """
    lines = [(number, line) for number, line in numbered_lines(text) if not line.startswith(";")]
    _check_first_line(lines, file)
    ended = lines[-1][1].rstrip() == LAST_LINE
    headers = Headers(lines[1:-1] if ended else lines[1:], file)
    if not ended and not headers.unclaimed:
        hint = f"its last line is '{LAST_LINE}'; where you have changed it by hand, `ninja-game record` writes it again"
        raise ReplayError("the replay is truncated", file, lines[-1][0], hint=hint)
    embedded, level_name, level_author = read_level(headers.section("level-data"), file)
    if headers.lines.keys().isdisjoint(("level-digest", "level")):
        embedded = embedded or level
    inputs = read_inputs(headers.section("inputs"), file=file, include=include_reader(file))
    length = headers.number("demo-length")
    last = len(inputs.keys) - 1 if length is None else Demo(inputs.keys, length).end
    replay = Replay(
        inputs=inputs.keys,
        final_tick=headers.count("final-tick") if "final-tick" in headers.lines else max(0, last),
        outcome="" if headers.unclaimed else headers.choice("outcome", OUTCOMES),
        gold=headers.count("gold"),
        digest=headers.digest("digest"),
        name=headers.text("name"),
        author=headers.text("author"),
        body=headers.choice("body", BODIES) if "body" in headers.lines else BODIES[0],
        rules=RULES_VERSION if headers.unclaimed else headers.count("rules"),
        level_digest=headers.digest("level-digest"),
        level_path=headers.text("level"),
        level_record=headers.count("level-record"),
        level=embedded,
        level_name=level_name,
        level_author=level_author,
        waypoints=read_waypoints(headers.section("waypoints"), file),
        made=headers.made(),
        markers=inputs.markers,
        demo_length=length,
        co_authors=headers.co_authors(),
    )
    problem = _contradiction(replay)
    if problem:
        key, error = problem
        error.file, error.line = file, headers.line(key)
        raise error
    return replay


def _check_first_line(lines: Sequence[Line], file: str) -> None:
    """Raise ReplayError unless the first line has the right format and version."""
    number, first = lines[0] if lines else (1, "")
    match = _FIRST_LINE.fullmatch(first)
    expected = f"'{REPLAY_MAGIC} {REPLAY_VERSION}' in the first line"
    if match is None:
        raise ReplayError("not a replay of ninja-game", file, number, 1, repr(first[:40]), expected)
    if int(match[1]) != REPLAY_VERSION:
        hint = "a replay from a newer ninja-game needs a newer ninja-game"
        raise ReplayError("unknown version of the replay format", file, number, 1, match[1], str(REPLAY_VERSION), hint)


def _contradiction(replay: Replay) -> tuple[str, ReplayError] | None:
    """Find a contradiction: its header and the error; None without any."""
    counts = {"rules": replay.rules, "final-tick": replay.final_tick, "gold": replay.gold}
    for key, count in (counts | {"level-record": replay.level_record}).items():
        if not 0 <= count < COUNT_LIMIT:
            return key, ReplayError(
                f"a number that '{key}' cannot have", found=str(count), expected="a whole number from 0"
            )
    for key, word, words in (("body", replay.body, BODIES), ("outcome", replay.outcome, OUTCOMES)):
        if word not in words and (key, word) != ("outcome", ""):
            return key, ReplayError(f"an unknown {key}", found=repr(word), expected=" or ".join(words))
    if replay.unclaimed and (replay.gold or replay.digest or replay.waypoints):
        return "inputs", ReplayError("claims without an outcome", expected=" or ".join(OUTCOMES))
    if not can_be_written(replay.made, replay.co_authors):
        return "made", ReplayError("not how a run is made", found=f"{replay.made!s}, {replay.co_authors}"[:60])
    names = [marker.name for marker in replay.markers]
    if len(set(names)) < len(names) or not all(map(is_marker_name, names)):
        return "inputs", ReplayError("names of ticks that cannot be written", found=repr(names)[:60])
    if not all(0 <= marker.tick <= len(replay.inputs) for marker in replay.markers):
        return "inputs", ReplayError("a marker of a tick without an input", expected=f"0 to {len(replay.inputs)}")
    if replay.ticks > MAX_TICKS:
        return "final-tick", ReplayError("the replay is too long", expected=f"at most {MAX_TICKS} ticks")
    if len(replay.inputs) > (replay.ticks if replay.demo_length is None else replay.final_tick):
        found = f"{len(replay.inputs)} ticks of inputs"
        hint = "raise final-tick or shorten the inputs"
        after = InputsAfterError(INPUTS_AFTER, found=found, expected=str(replay.ticks), hint=hint)
        after.replay = replay
        return "final-tick", after
    if not (replay.level_digest or replay.level_path or replay.level):
        expected, hint = "'level:', 'level-digest:' or 'level-data:'", "or say with --level where it is played"
        return "inputs", ReplayError("a replay without level", expected=expected, hint=hint)
    if replay.level and replay.level_digest and replay.level_digest != level_digest(replay.level):
        found = level_digest(replay.level)
        hint = "the level was changed after the recording"
        return "level-digest", ReplayError("the digest is not that of level-data", found=found, hint=hint)
    return None


def write_replay(replay: Replay) -> str:
    """Write a replay as text; reading it gives an equal replay.

    Raises ReplayError for contradictory fields, DemoError for an input above 15.
    """
    problem = _contradiction(replay)
    if problem:
        raise problem[1]
    headers = {
        "name": header_text(replay.name),
        "author": header_text(replay.author),
        "co-authors": header_text(", ".join(replay.co_authors)),
        "made": header_text(str(replay.made)),
        "level": header_text(replay.level_path),
        "level-record": str(replay.level_record or ""),
        "level-digest": replay.level_digest,
        "rules": "" if replay.unclaimed else str(replay.rules),
        "body": replay.body,
        **_claims(replay),
    }
    lines = [f"{REPLAY_MAGIC} {REPLAY_VERSION}", *(f"{key}: {value}" for key, value in headers.items() if value)]
    lines += ["inputs:", *(f"  {line}" for line in write_inputs(replay.inputs, replay.markers))]
    if replay.waypoints:
        lines += ["waypoints:", *(f"  {tick} {x!r} {y!r} {state}" for tick, x, y, state in replay.waypoints)]
    if replay.level is not None:
        text = write_ascii_level(replay.level, name=replay.level_name, author=replay.level_author)
        lines += ["level-data:", *(f"  {line}".rstrip() for line in text.splitlines())]
    lines += [] if replay.unclaimed else [LAST_LINE]
    return "\n".join(lines) + "\n"


def shared_text(replay: Replay, level: Level) -> str:
    """A replay for the page: its level inside, no path, no waypoints, no unverified claims."""
    return write_replay(
        replace(replay, level=level, level_path="", level_record=0, level_digest="", digest="", waypoints=())
    )


def _claims(replay: Replay) -> dict[str, str]:
    """The headers with the length of a run and its result."""
    final_tick = {"final-tick": str(replay.final_tick)}
    if not replay.unclaimed:
        claimed = {"outcome": replay.outcome, "gold": str(replay.gold), "digest": replay.digest}
        return {**final_tick, **claimed}
    if replay.demo_length is not None:
        return {"demo-length": format_number(replay.demo_length)}
    return final_tick if replay.final_tick != max(0, len(replay.inputs) - 1) else {}


EPISODE_MAGIC = "ninja-game episode"
FIRST_LINE = f"{EPISODE_MAGIC} 1"

_HEAD = re.compile(rf"^{REPLAY_MAGIC}\b", re.MULTILINE)


def is_episode(text: str) -> bool:
    """Whether a text begins like an episode of this program."""
    return text.lstrip("\ufeff \t\r\n").startswith(EPISODE_MAGIC)


def episode_key(levels: Iterable[Level]) -> str:
    """The key of an episode: a digest of its levels in their order."""
    return hashlib.sha256(" ".join(level_digest(level) for level in levels).encode()).hexdigest()


def lifetimes(replays: Sequence[Replay]) -> list[int]:
    """The lifetime (ticks) at the start of each level and, last, after the end, which is the score (game.md §1.4).

    The replays must pass their levels with the gold and in the tick that they claim.
    """
    ticks_left = [LIFETIME]
    for replay in replays:
        ticks_left.append(ticks_left[-1] + GOLD_BONUS * replay.gold - replay.final_tick)
    return ticks_left


def parse_episode(text: str, *, file: str = "") -> list[Replay]:
    """Read the replays of an episode, in order. Each must claim that it passes its level in the time left.

    Raises ReplayError or LevelError with the line in the whole text.
    """
    heads = [match.start() for match in _HEAD.finditer(text)]
    above = [line for _, line in numbered_lines(text[: heads[0] if heads else len(text)]) if not line.startswith(";")]
    if [line.rstrip() for line in above] != [FIRST_LINE]:
        found = repr("".join(above[:1])[:40])
        raise ReplayError("not an episode", file, 1, found=found, expected=f"'{FIRST_LINE}', then replays")
    if not 1 <= len(heads) <= LEVELS_PER_EPISODE:
        found, expected = f"{len(heads)} replays", f"1 to {LEVELS_PER_EPISODE}, one for each level"
        raise ReplayError("not the replays of an episode", file, 1, 0, found, expected)
    replays: list[Replay] = []
    for start, end in zip(heads, [*heads[1:], len(text)], strict=True):
        line = text.count("\n", 0, start) + 1
        # Empty lines before the text make errors count lines of the whole text.
        replays.append(parse_replay("\n" * (line - 1) + text[start:end], file=file))
        if replays[-1].outcome != "exit":
            found, hint = replays[-1].outcome or "no claims", "write it with `ninja-game convert RUN… OUT.episode.txt`"
            raise ReplayError("a level of an episode that is not passed", file, line, 0, found, "outcome: exit", hint)
        if replays[-1].body != replays[0].body:
            raise ReplayError("an episode with two bodies", file, line, found=replays[-1].body)
        if (left := lifetimes(replays)[-1]) <= 0:
            what = f"the time of the episode has run out in level {len(replays)}"
            raise ReplayError(what, file, line, found=f"{left} ticks", expected="1 or more at its exit")
    return replays


def write_episode(replays: Sequence[Replay]) -> str:
    """Write the replays of an episode. Raises ReplayError for replays that ``parse_episode`` would refuse."""
    text = "\n".join([FIRST_LINE, *map(write_replay, replays)])
    try:
        parse_episode(text)
    except ReplayError as error:
        raise replace(error, line=0) from None
    return text
