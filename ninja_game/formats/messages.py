"""Messages of a level to the player: the header `says` of the ASCII format (docs/level-format.md)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from enum import StrEnum
from functools import partial
from typing import NamedTuple

from ninja_game.errors import LevelError
from ninja_game.files.shown_text import counted
from ninja_game.sim.grid import Cell, cell_at, cell_index, is_inside, middle_of
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import CELL

MAX_MESSAGES, MAX_LETTERS, MAX_MESSAGE_LINES = 16, 120, 3
FRAME_SIZE = 5, 5  # columns and rows of the frame around the place of a message that has no size of its own
NO_CELL: Cell = 0, 0  # the cell of a message that is about none
SEPARATOR = "|"  # separates two messages
IMPORTANT = "!"  # ends the moment of a message that comes before others
_BREAK = r"\n"  # begins a new line of a text, in a file

KEYS = ("left", "right", "jump", "retry", "suicide", "pause", "replay")
"""Actions whose key a message may name: {jump} becomes the player's key or button."""

TARGETS = ("switch", "exit")  # objects that a message may name in the same way: arrows lead to them while it is shown
NUMBER_WORDS = ("gold left", "gold taken", "deaths")  # numbers that it may name: they change while it is shown
WORDS = KEYS + TARGETS + NUMBER_WORDS

_KEY = re.compile(r"\{([^{}]*)\}")
_COUNTED = re.compile(r"(?:death|gold) ([1-9][0-9]?)|after ((?:[1-9][0-9]?|0(?=\.[1-9]))(?:\.[0-9])?) s")
_PLACE = re.compile(r"(?:at|switch|gold|lock|trap) ([0-9]{1,2}),([0-9]{1,2})(?: ([1-9][0-9]?)x([1-9][0-9]?))?")
_TIME = re.compile(r"(.*) for ((?!0+(?:\.0)? )[0-9]{1,2}(?:\.[0-9])?) s")


class Moment(StrEnum):
    """When a message is said, in the words of a file."""

    START = "start"
    SWITCH = "switch"
    GOLD = "gold"
    ALL_GOLD = "all gold"
    DEATH = "death"
    LOCK = "lock"
    TRAP = "trap"
    AFTER = "after"
    AT = "at"


_EVENTS = Moment.START, Moment.SWITCH, Moment.GOLD, Moment.ALL_GOLD, Moment.LOCK, Moment.TRAP
_MOMENTS = (
    f"{', '.join(_EVENTS)}, 'lock 12,5' for one switch, 'gold 3', 'death 3', 'after 2.5 s', 'at 12,5' or 'at 12,5 3x3',"
    " then perhaps 'for 9 s' or 'for 1.5 s', and '!' if it is important"
)


class LevelMessage(NamedTuple):
    """A message of a level to its player.

    ``when``: what it waits for. ``number``: of deaths, of pieces of gold, or of seconds.
    ``text``: up to MAX_MESSAGE_LINES lines.
    ``cell``: column and row of the place, or of the one switch or gold. ``seconds``: how long it is shown; 0: the usual
    time. ``size``: of its frame, in cells: of an even number there is one more left of, or above, its cell.
    """

    when: Moment
    text: str
    number: float = 0
    cell: Cell = NO_CELL
    seconds: float = 0
    size: tuple[int, int] = FRAME_SIZE
    important: bool = False  #: comes at once, and stays until it was read or another important one happens

    @property
    def one_line(self) -> str:
        return self.text.replace("\n", " ")

    @property
    def place(self) -> tuple[float, float] | None:
        """The middle of the cell near which the message is shown, px; None for other moments than AT."""
        return middle_of(self.cell) if self.when == Moment.AT else None

    def is_about(self, x: float, y: float) -> bool:
        """Whether the message is about a switch or gold at a point, px."""
        return self.cell == NO_CELL or cell_at(x, y) == cell_index(*self.cell)

    @property
    def frame(self) -> tuple[int, int, int, int]:
        """The frame of cells in which the ninja is near the place: left column, upper row, columns, rows."""
        columns, rows = self.size
        return self.cell[0] - columns // 2, self.cell[1] - rows // 2, columns, rows

    @property
    def middle(self) -> tuple[float, float]:
        """The middle of the frame, px."""
        left, top, columns, rows = self.frame
        return CELL * (left + columns / 2), CELL * (top + rows / 2)

    @property
    def reach(self) -> tuple[float, float]:
        """Half the width and height of the frame, px."""
        return self.size[0] * CELL / 2, self.size[1] * CELL / 2


def parse_messages(value: str) -> tuple[LevelMessage, ...]:
    """The messages in a header's value, separated by bars. Raises LevelError.

    >>> parse_messages("start: {jump} jumps | death 3 for 9 s: Wait for the drone")[1][1:5]
    ('Wait for the drone', 3, (0, 0), 9.0)
    """
    parts = value.split(SEPARATOR) if value.strip() else []
    if len(parts) > MAX_MESSAGES:
        raise LevelError("too many messages in 'says'", found=str(len(parts)), expected=f"at most {MAX_MESSAGES}")
    return tuple(map(_parse_message, parts))


def unknown_words(text: str) -> list[str]:
    """Words in braces that are not in WORDS."""
    return [name for name in _KEY.findall(text) if name not in WORDS]


def arrow_targets(texts: Iterable[str]) -> Sequence[str]:
    """The names of TARGETS in these texts.

    >>> arrow_targets(["Go", "Now the {exit} is open"]), arrow_targets(["Go"])
    (['exit'], [])
    """
    named = {name for text in texts for name in _KEY.findall(text)}
    return [target for target in TARGETS if target in named]


def header_form(text: str) -> str:
    r"""A text as one line of a file.

    >>> header_form("Run,\nthen jump")
    'Run,\\nthen jump'
    """
    return _BREAK.join(line.strip() for line in text.strip().split("\n"))


def messages_at(says: str, cell: tuple[int, int]) -> list[LevelMessage]:
    """The messages of a level with this cell as their place."""
    return [message for message in parse_messages(says) if message.place and message.cell == cell]


def with_message_moved(says: str, number: int, cell: tuple[int, int]) -> str:
    """A header's value with one of its messages, by number from 0, about another cell than before.

    >>> with_message_moved("start: Go | at 12,5 3x1 for 9 s: Jump: here", 1, (3, 4))
    'start: Go | at 3,4 3x1 for 9 s: Jump: here'
    """
    parts = [part.strip() for part in says.split(SEPARATOR)]
    before, _, rest = parts[number].partition(",")
    parts[number] = f"{before.split()[0]} {cell[0]},{cell[1]}" + rest.lstrip("0123456789")
    return f" {SEPARATOR} ".join(parts)


def _parse_message(part: str) -> LevelMessage:
    when, colon, text = (piece.strip() for piece in part.partition(":"))
    lines = text.split(_BREAK)
    text = "\n".join(stripped for line in lines if (stripped := line.strip()))
    found = repr(part.strip()[:40])
    if not colon or not text:
        raise LevelError("not a message in 'says'", found=found, expected="WHEN: text", hint=f"WHEN is {_MOMENTS}")
    if len(text) > MAX_LETTERS or not "".join(lines).isprintable():
        raise LevelError("a message in 'says'", found=found, expected=f"at most {MAX_LETTERS} printable letters")
    if len(lines) > MAX_MESSAGE_LINES:
        raise LevelError("too many lines in a text in 'says'", found=found, expected=f"at most {MAX_MESSAGE_LINES}")
    for name in unknown_words(text):
        raise LevelError("an unknown key in 'says'", found=f"{{{name[:40]}}}", expected=", ".join(WORDS))
    important, timed_moment = when.endswith(IMPORTANT), when.removesuffix(IMPORTANT).rstrip()
    timed = _TIME.fullmatch(timed_moment)
    moment, seconds = (timed[1], float(timed[2])) if timed else (timed_moment, 0.0)
    message = partial(LevelMessage, text=text, seconds=seconds, important=important)
    if moment in _EVENTS:
        return message(Moment(moment))
    kind = moment.partition(" ")[0]
    if match := _COUNTED.fullmatch(moment):
        return message(Moment(kind), number=int(match[1]) if match[1] else float(match[2]))
    if (match := _PLACE.fullmatch(moment)) and is_inside(cell := (int(match[1]), int(match[2]))):
        size = (int(match[3]), int(match[4])) if match[3] else FRAME_SIZE
        if size[0] <= COLUMNS and size[1] <= ROWS and (kind == Moment.AT or not match[3]):
            return message(Moment(kind), cell=cell, size=size)
    raise LevelError("an unknown moment in 'says'", found=repr(when[:40]), expected=_MOMENTS)


def named_keys(text: str, name: Callable[[str], str]) -> str:
    """Replace targets by their names, and actions and counts by what ``name`` gives: a player's key, a number.

    >>> named_keys("{jump} to the {exit}", {"jump": "Z"}.__getitem__)
    'Z to the exit'
    """
    return _KEY.sub(lambda match: match[1] if match[1] in TARGETS else name(match[1]), text)


def level_text(text: str, key: Callable[[str], str], gold: int, all_gold: int, deaths: int) -> str:
    """A level's text with the names of keys, and with its numbers as they are now; it says "1 death"."""
    text = text.replace("{deaths} deaths", counted(deaths, "death"))
    counts = {"gold left": all_gold - gold, "gold taken": gold, "deaths": deaths}
    return named_keys(text, lambda word: str(counts[word]) if word in counts else key(word))
