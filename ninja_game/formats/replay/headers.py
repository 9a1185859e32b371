"""The ``key: value`` lines and sections of a replay text, read strictly (`docs/replay-format.md`)."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from difflib import get_close_matches
from functools import lru_cache
from typing import NamedTuple, TypeVar

from ninja_game.errors import LevelError, ReplayError
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.ascii.writer import LEVELS_KEPT
from ninja_game.formats.lines import MAX_NAME, Line, read_quoted
from ninja_game.formats.numbers import parse_flash_number
from ninja_game.formats.replay.provenance import Provenance, names_of_text, parse_provenance
from ninja_game.sim.level import Level
from ninja_game.sim.rules import NAN

W = TypeVar("W", bound=str)

REQUIRED = ("rules", "body", "final-tick", "outcome", "gold", "inputs")
CLAIMS = ("rules", "outcome", "gold", "digest", "waypoints")
"""The headers that make claims; a replay without them only needs its inputs."""
_HOW_TO_CLAIM = f"take {', '.join(CLAIMS)} out too: of inputs alone `ninja-game record` writes all of them again"
SECTIONS = ("inputs", "level-data", "waypoints")
REPLAY_KEYS = (
    *REQUIRED, "name", "author", "co-authors", "made", "level", "level-record", "level-digest", "digest", "demo-length",
    "level-data", "waypoints",
)  # fmt: skip

COUNT_LIMIT = 10**9

MAX_KEPT_LENGTH = 2**15  # characters of the text of a level that stays in memory

_HEADER_LINE = re.compile(r"([a-z-]+):(.*)", re.DOTALL)
_DIGEST = re.compile(r"[0-9a-f]{64}")
_COUNT = re.compile(r"0|[1-9][0-9]{0,8}")


class Headers:
    """The ``key: value`` lines and the sections of a replay, with their places for error messages."""

    def __init__(self, lines: Sequence[Line], file: str) -> None:
        self.file = file
        self.lines: dict[str, list[Line]] = {}
        key = ""
        for number, line in lines:
            if line[0] in " \t":
                if key not in SECTIONS:
                    hint = "indented lines belong below 'inputs:', 'waypoints:' or 'level-data:'"
                    raise ReplayError("an indented line", file, number, 1, repr(line.strip()[:40]), "key: value", hint)
                self.lines[key].append((number, line))
                continue
            match = _HEADER_LINE.fullmatch(line)
            if match is None:
                raise ReplayError("not a header line", file, number, 1, repr(line[:40]), "key: value")
            key = match[1]
            if key not in REPLAY_KEYS:
                near = get_close_matches(key, REPLAY_KEYS, 1)
                hint = f"did you mean '{near[0]}'?" if near else ""
                raise ReplayError("an unknown header", file, number, 1, repr(key[:40]), ", ".join(REPLAY_KEYS), hint)
            if key in self.lines:
                raise ReplayError("a header given twice", file, number, 1, repr(key), hint="keep one of them")
            # The value keeps its column, so that error messages can name it.
            self.lines[key] = [(number, " " * match.start(2) + match[2])]
        self.unclaimed = not any(key in self.lines for key in CLAIMS)
        missing = [repr(key) for key in (("inputs",) if self.unclaimed else REQUIRED) if key not in self.lines]
        if missing:
            hint = "" if self.unclaimed or "inputs" not in self.lines else _HOW_TO_CLAIM
            place, expected = lines[0][0] if lines else 1, f"a line with {', '.join(missing)}"
            raise ReplayError("an incomplete replay", file, place, expected=expected, hint=hint)

    def section(self, key: str) -> list[Line]:
        return [(number, line) for number, line in self.lines.get(key, []) if line.strip()]

    def line(self, key: str) -> int:
        """The line of a header; 0 if it is missing."""
        return self.lines[key][0][0] if key in self.lines else 0

    def error(self, key: str, what: str, expected: str, hint: str = "") -> ReplayError:
        number, line = self.lines[key][0]
        value = line.lstrip()
        return ReplayError(what, self.file, number, len(line) - len(value) + 1, repr(value[:40]), expected, hint)

    def raw(self, key: str) -> str:
        """A header's value, '' if it is missing."""
        return self.lines[key][0][1].strip() if key in self.lines else ""

    def text(self, key: str) -> str:
        """A header's text; JSON if it is in double quotes."""
        value = self.raw(key)
        if value.startswith('"'):
            quoted = read_quoted(value)
            if quoted is None:
                raise self.error(key, f"a broken text in '{key}'", "text, or a JSON string", "close the double quotes")
            value = quoted
        if len(value) > MAX_NAME:
            raise self.error(key, f"a text of {len(value):,} characters in '{key}'", f"at most {MAX_NAME:,}")
        return value

    def count(self, key: str) -> int:
        """A header's whole number; 0 if it is missing."""
        if key not in self.lines:
            return 0
        if not _COUNT.fullmatch(self.raw(key)):
            raise self.error(key, f"no number in '{key}'", "a whole number from 0")
        return int(self.raw(key))

    def number(self, key: str) -> float | None:
        """A header's number in N's notation; None if it is missing."""
        if key not in self.lines:
            return None
        value = parse_flash_number(self.raw(key))
        if math.isnan(value):
            raise self.error(key, f"no number in '{key}'", "a number, such as 902")
        return value

    def choice(self, key: str, choices: Sequence[W]) -> W:
        for word in choices:
            if word == self.raw(key):
                return word
        raise self.error(key, f"an unknown {key}", " or ".join(choices))

    def made(self) -> Provenance:
        try:
            return parse_provenance(self.text("made"))
        except ValueError:
            expected = "such as played (practice), edited 34, searched (improve, search)"
            hint = "leave the line out if you do not know"
            raise self.error("made", "not how a run is made", expected, hint) from None

    def co_authors(self) -> tuple[str, ...]:
        names = names_of_text(self.text("co-authors"))
        if (length := len(", ".join(names))) > MAX_NAME:
            what = f"{length:,} characters of names, with ', ' between them, in 'co-authors'"
            raise self.error("co-authors", what, f"at most {MAX_NAME:,}")
        return names

    def digest(self, key: str) -> str:
        """A header's 64 hex digits; '' if it is missing."""
        if key in self.lines and not _DIGEST.fullmatch(self.raw(key)):
            raise self.error(key, f"no digest in '{key}'", "64 digits 0-9, a-f", "leave the line out if you have none")
        return self.raw(key)


class Waypoint(NamedTuple):
    """The ninja after a tick: place in px, and name of its state."""

    tick: int
    x: float
    y: float
    state: str


def read_level(lines: Sequence[Line], file: str) -> tuple[Level | None, str, str]:
    """The embedded ASCII level (None without one), its name and author. Raises LevelError with the replay's line."""
    if not lines:
        return None, "", ""
    try:
        text = "\n".join(line for _, line in lines)
        return _level_of(text) if len(text) <= MAX_KEPT_LENGTH else _level_of.__wrapped__(text)
    except LevelError:
        placed = [""] * lines[-1][0]
        for number, line in lines:
            placed[number - 1] = line
        parse_ascii_level("\n".join(placed), file=file)  # raises the same error, with the replay's line
        raise


@lru_cache(LEVELS_KEPT)
def _level_of(text: str) -> tuple[Level, str, str]:
    """A level with its name and its author. Raises LevelError."""
    read = parse_ascii_level(text)
    level = read.level
    # Tuples with the same NaN object are equal, so a replay equals the one that was written.
    one_nan = [tuple(NAN if math.isnan(value) else value for value in record.values) for record in level.objects]
    records = [record._replace(values=values) for record, values in zip(level.objects, one_nan, strict=True)]
    return Level(level.tiles, tuple(records)), read.name, read.author


def read_waypoints(lines: Sequence[Line], file: str) -> tuple[Waypoint, ...]:
    """Read the waypoints of a replay, one per line: tick, x, y, state. Raises ReplayError with the line."""
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
