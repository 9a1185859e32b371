"""Messages as rows of fields, and frames under a drag, without a window."""

import pytest

from ninja_game.editor.message_rows import GRIP, MessageField, MessageRow, messages_of, moved_frame, sizing
from ninja_game.formats.messages import LevelMessage, Moment
from ninja_game.sim.rules import CELL

ALL = (
    "start: {jump} jumps | switch for 9 s: Now the exit | at 12,5: Jump: here | after 2.5 s: Slide"
    " | death 5 for 12 s: Go round | at 3,5 3x1 for 1 s: No | gold 2!: Yes | lock 4,5 for 2 s!: Open"
)


def test_every_message_comes_back_as_it_was() -> None:
    assert " | ".join(row.source for row in messages_of(ALL)) == ALL


@pytest.mark.parametrize(
    "row, problem",
    [
        (MessageRow(Moment.AT, "12,5", "x", "9,5"), (MessageField.TEXT, "")),
        (MessageRow(Moment.START, "", " "), (MessageField.TEXT, "Type what is said, or remove the message")),
        (MessageRow(Moment.START, "", "a | b"), (MessageField.TEXT, "A message has no |")),
        (MessageRow(Moment.START, "", "x", "0"), (MessageField.TIME, "Seconds: from 0.1 to 99.9, or empty")),
        (MessageRow(Moment.DEATH, "0", "x"), (MessageField.DETAIL, "How many deaths: a number from 1 to 99")),
        (
            MessageRow(Moment.DEATH, "3: x | start", "x"),
            (MessageField.DETAIL, "How many deaths: a number from 1 to 99"),
        ),
    ],
)
def test_the_field_that_is_wrong_is_named_with_its_problem(row: MessageRow, problem: tuple[MessageField, str]) -> None:
    assert row.problem == problem


def test_a_row_is_a_message_once_its_moment_is_right() -> None:
    row = MessageRow(Moment.AT, "40,1", "")
    assert (row.parsed, MessageRow(Moment.START, "", "x").parsed) == (None, None)
    row.put_at((12, 5), (2, 4))
    assert (row.detail, row.parsed) == ("12,5 2x4", LevelMessage(Moment.AT, "a text", cell=(12, 5), size=(2, 4)))


def test_a_drag_sizes_a_frame_by_its_edge_or_corner_and_moves_it_by_its_middle() -> None:
    message = LevelMessage(Moment.AT, "x", cell=(12, 5), size=(5, 3))
    left, top, columns, rows = message.frame
    corner, (x, y) = (CELL * left, CELL * top), message.middle
    for at, cell, becomes in (
        (corner, (left - 1, top + 1), (left - 1, top + 1, columns + 1, rows - 1)),
        ((corner[0], y), (left + 2, 20), (left + 2, top, columns - 2, rows)),
        ((x, CELL * (top + rows) + GRIP), (1, top + 4), (left, top, columns, 5)),
    ):
        sized = sizing(message, *at)
        assert sized
        assert sized(cell) == becomes
    assert sizing(message, x, y) is sizing(message, corner[0] - GRIP - 1, y) is None
    assert moved_frame(message.frame, (12, 5), (13, 3)) == (left + 1, top - 2, columns, rows)
