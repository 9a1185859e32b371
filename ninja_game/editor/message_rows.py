"""Messages of a level as rows of text fields, their edits, and what drags make of the frames of those near a place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, replace
from enum import StrEnum
from functools import lru_cache, partial
from typing import Any

from ninja_game.document import History, common_length
from ninja_game.editor.stamp import CellArea, area_between
from ninja_game.errors import LevelError
from ninja_game.formats.messages import (
    FRAME_SIZE,
    IMPORTANT,
    MAX_MESSAGES,
    NO_CELL,
    SEPARATOR,
    WORDS,
    LevelMessage,
    Moment,
    header_form,
    parse_messages,
    unknown_words,
)
from ninja_game.sim.grid import Cell

_ONE = "Which one: column and row of the gold or switch, or a click on it in the picture; empty: the first of any"

DETAILS = {
    **dict.fromkeys((Moment.SWITCH, Moment.LOCK, Moment.TRAP), ("any", _ONE, "Which one")),
    Moment.GOLD: ("any", f"{_ONE}; 3: after so many", "Which, how many"),
    Moment.DEATH: ("deaths", "How many deaths: a number from 1 to 99", "How many"),
    Moment.AFTER: ("seconds", "How many seconds: a number from 0.1 to 99.9", "How many"),
    Moment.AT: ("12,5", "Column and row, 1,1 to 31,23, then perhaps the frame's size: 12,5 or 12,5 3x3", "Cell, frame"),
}
"""What some moments may need besides: an example, a hint, and what the field is called."""


class MessageField(StrEnum):
    """The fields of a row, in the order of the page. Not every moment has a DETAIL."""

    MOMENT = "moment"
    DETAIL = "detail"
    TIME = "time"
    IMPORTANT = "important"
    TEXT = "text"


GRIP = 9.0  # px of the level from the edge of a frame within which a drag sizes it

_BAD_TIME = "Seconds: from 0.1 to 99.9, or empty"


def listed(words: Sequence[str]) -> str:
    return ", ".join(f"{{{word}}}" for word in words)


@dataclass(eq=False)
class MessageRow:
    """A message in the list. As typed: ``detail``, of DETAILS; ``time``, seconds."""

    when: Moment = Moment.START
    detail: str = ""
    text: str = ""
    time: str = ""
    important: bool = False

    @property
    def moment(self) -> str:
        detail = " ".join(self.detail.split())
        if self.when == Moment.AFTER:
            return f"{self.when} {detail.replace(',', '.')} s"
        return f"{self.when} {detail}".strip()

    @property
    def source(self) -> str:
        seconds = self.time.strip().replace(",", ".")
        shown_for = f" for {seconds} s" if seconds else ""
        return f"{self.moment}{shown_for}{IMPORTANT * self.important}: {header_form(self.text)}"

    @property
    def problem(self) -> tuple[MessageField, str]:
        """Which field of the row is wrong, and the problem in words; '' for none."""
        moment = self.moment
        if self.when in DETAILS and (":" in moment or not _fits(f"{moment}: a text")):
            return MessageField.DETAIL, DETAILS[self.when][1]
        if not _fits(replace(self, when=Moment.START, detail="", text="a text").source):
            return MessageField.TIME, _BAD_TIME
        if not self.text.strip():
            return MessageField.TEXT, "Type what is said, or remove the message"
        if SEPARATOR in self.text:
            return MessageField.TEXT, f"A message has no {SEPARATOR}"
        return MessageField.TEXT, self.unknown and f"{self.unknown} is not one of {listed(WORDS)}"

    @property
    def parsed(self) -> LevelMessage | None:
        """The message, with another text; None at the start, and for a moment that is wrong."""
        timeless = self.when == Moment.START or self.problem[0] == MessageField.DETAIL
        return None if timeless else parse_messages(f"{self.moment}: a text")[0]

    def put_at(self, cell: Cell, size: Cell) -> None:
        """Put the middle of its frame at a cell."""
        self.detail = _detail(LevelMessage(Moment.AT, "", cell=cell, size=size))

    @property
    def unknown(self) -> str:
        """The first unknown word in braces, with the braces; '' for none."""
        return next((f"{{{name}}}" for name in unknown_words(self.text)), "")


@lru_cache(maxsize=256)
def _fits(source: str) -> bool:
    try:
        return bool(parse_messages(source))
    except LevelError:
        return False


def messages_of(says: str) -> list[MessageRow]:
    return [
        MessageRow(m.when, _detail(m), m.text, f"{m.seconds:g}" if m.seconds else "", m.important)
        for m in parse_messages(says)
    ]


class EditedMessages:
    """The rows of a level's messages under edit, one of which is selected: the one with the number ``index``."""

    def __init__(self, says: str) -> None:
        self.rows = messages_of(says)
        self.index = 0
        self.history = History(self._values)
        self._step: object = None

    @property
    def source(self) -> str:
        return f" {SEPARATOR} ".join(row.source for row in self.rows)

    @property
    def selected(self) -> MessageRow | None:
        return self.rows[self.index] if self.index < len(self.rows) else None

    @property
    def is_full(self) -> bool:
        return len(self.rows) >= MAX_MESSAGES

    @property
    def valid(self) -> list[MessageRow]:
        return [row for row in self.rows if not row.problem[1]]

    def together(self, row: MessageRow) -> list[MessageRow]:
        """All messages of the moment of one."""
        return [other for other in self.rows if other.moment == row.moment]

    def add(self) -> MessageRow:
        row = MessageRow()
        self._put(len(self.rows), row, self.rows)
        return row

    def copy(self) -> None:
        if self.selected and not self.is_full:
            self._put(self.index + 1, replace(self.selected), self.rows)

    def move(self, by: int) -> None:
        """Move the selected message by so many places, at most to an end."""
        if selected := self.selected:
            others = [other for other in self.rows if other is not selected]
            self._put(self.index + by, selected, others)

    def remove(self) -> None:
        """Take the selected message away: the next one is selected, else the last."""
        del self.rows[self.index : self.index + 1]
        self.index = min(self.index, max(0, len(self.rows) - 1))

    def _put(self, number: int, row: MessageRow, others: list[MessageRow]) -> None:
        """Put a message at that place among others, and select it."""
        self.index = min(max(0, number), len(others))
        self.rows = [*others[: self.index], row, *others[self.index :]]

    @property
    def _values(self) -> tuple[tuple[Any, ...], ...]:
        return tuple(map(astuple, self.rows))

    def record(self, step: object) -> None:
        """Put what has changed into the history; changes one after the other with one ``step`` are undone together."""
        values = self._values
        if values == self.history.draft:
            return
        if step is None or step != self._step:
            self.history.begin()
        self.history.change(values)
        self._step = step

    def restore(self, step: Callable[[], bool]) -> bool:
        """Undo or redo in the history, and select the first message that changes; whether there was such a step."""
        before = self.history.draft
        if not step():
            return False
        values = self.history.draft
        self._step = None
        self.rows = [MessageRow(*row) for row in values]
        self.index = min(common_length(before, values), max(0, len(values) - 1))
        return True


def _detail(message: LevelMessage) -> str:
    if message.cell == NO_CELL:
        return f"{message.number:g}" if message.number else ""
    return "{},{}".format(*message.cell) + (" {}x{}".format(*message.size) if message.size != FRAME_SIZE else "")


def sizing(message: LevelMessage, x: float, y: float) -> Callable[[Cell], CellArea] | None:
    """What a drag from a point, px, to a cell makes of a frame: it takes the edge or corner there; None for neither."""
    (wide, high), across, down = message.reach, x - message.middle[0], y - message.middle[1]
    if abs(across) > wide + GRIP or abs(down) > high + GRIP:
        return None
    on_upright, on_level = abs(abs(across) - wide) <= GRIP, abs(abs(down) - high) <= GRIP
    edges = on_upright * (1 if across > 0 else -1), on_level * (1 if down > 0 else -1)
    return partial(_with_edge_at, message.frame, edges) if any(edges) else None


def _with_edge_at(frame: CellArea, edges: tuple[int, int], cell: Cell) -> CellArea:
    """A frame with some of its edges at a cell: -1 left or above, 1 right or below, 0 neither; those opposite stay."""
    left, top, columns, rows = frame
    first, last = [left, top], [left + columns - 1, top + rows - 1]
    for axis, edge in enumerate(edges):
        if edge < 0:
            first[axis] = cell[axis]
        elif edge > 0:
            last[axis] = cell[axis]
    return area_between((first[0], first[1]), (last[0], last[1]))


def moved_frame(frame: CellArea, begin: Cell, cell: Cell) -> CellArea:
    return frame[0] + cell[0] - begin[0], frame[1] + cell[1] - begin[1], *frame[2:]
