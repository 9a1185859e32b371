"""What levels say: read from their header, refused with the reason where it cannot be."""

import pytest

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.messages import MAX_LETTERS, MAX_MESSAGES, NO_CELL, parse_messages

PICTURE = "\n".join(["|" + "." * 31 + "|"] * 22 + ["|@" + "." * 30 + "|"])


@pytest.mark.parametrize(
    "value, words",
    [
        ("jump!", "expected WHEN: text"),
        ("start:", "expected WHEN: text"),
        ("later: jump", "unknown moment in 'says'; found 'later'; expected start, switch, gold"),
        ("death 0: jump", "unknown moment"),
        ("at 32,5: jump", "unknown moment"),
        ("start: press {fly}", "unknown key in 'says'; found {fly}; expected left, right, jump"),
        ("lock 32,5: jump", "unknown moment"),
        ("lock 12,5 3x3: jump", "unknown moment"),
        ("start 12,5: jump", "unknown moment in 'says'; found 'start 12,5'; expected start, switch, gold"),
        ("after 0 s: jump", "unknown moment"),
        ("after 0.0 s: jump", "unknown moment"),
        ("after 2.55 s: jump", "unknown moment"),
        ("after 100 s: jump", "unknown moment"),
        ("after 20: jump", "unknown moment"),
        ("start for 100 s: jump", "unknown moment"),
        ("start for 0 s: jump", "unknown moment"),
        ("start for 0.0 s: jump", "unknown moment"),
        ("start for 1.25 s: jump", "unknown moment"),
        ("start: " + "x" * (MAX_LETTERS + 1), "at most 120 printable letters"),
        ("start: \x07", "printable"),
        (r"start: a\nb\nc\nd", "too many lines in a text in 'says'; found 'start: a"),
        (r"start: \n ", "expected WHEN: text"),
        ("gold 0: a", "unknown moment"),
        ("gold! for 9 s: a", "unknown moment"),
        ("gold all: a", "expected start, switch, gold, all gold"),
        (" | ".join(["start: a"] * 17), "too many messages in 'says'; found 17; expected at most 16"),
    ],
)
def test_what_cannot_be_said_is_refused_with_its_line(value: str, words: str) -> None:
    with pytest.raises(LevelError, match=r"^a\.txt:3: ") as caught:
        parse_ascii_level(f"ninja-game level 1\nname: A\nsays: {value}\n{PICTURE}", file="a.txt")
    assert words in str(caught.value)


def test_a_level_with_the_most_and_longest_messages_is_read_as_it_is_written() -> None:
    says = " | ".join(["at 12,10 15x15 for 99.9 s!: " + "x" * MAX_LETTERS] * MAX_MESSAGES)
    level = parse_ascii_level(f"ninja-game level 1\nname: A\nsays: {says}\n{PICTURE}")
    again = parse_ascii_level(write_ascii_level(level.level, name="A", says=level.says))
    assert (again.says, len(parse_messages(again.says))) == (says, MAX_MESSAGES)


def test_a_place_has_a_frame_of_five_cells_or_of_its_own_size() -> None:
    usual, own = parse_messages("at 12,5: a | at 3,4 31x1 for 9 s: b")
    assert (usual.size, usual.reach, own.size, own.cell, own.seconds) == ((5, 5), (60.0, 60.0), (31, 1), (3, 4), 9)
    for size in ("0x3", "3x0", "32x1", "1x24", "3", "3x3x3"):
        with pytest.raises(LevelError, match="unknown moment"):
            parse_messages(f"at 12,5 {size}: a")


def test_a_mark_behind_the_moment_makes_a_message_important() -> None:
    read = parse_messages("start: a! | death 3!: b | at 3,4 for 9 s !: c | gold!: d")
    assert [message.important for message in read] == [False, True, True, True]


def test_a_frame_of_an_even_size_lies_on_cells() -> None:
    (message,) = parse_messages("at 12,5 4x2 for 1.5 s: {gold left}")
    assert (message.frame, message.middle, message.seconds) == ((10, 4, 4, 2), (288.0, 120.0), 1.5)


def test_a_moment_may_be_about_one_switch_or_gold_by_its_cell() -> None:
    says = "lock 12,5: a | lock: b | gold 3,4 for 9 s: c | switch 1,23: d | trap 31,1: e"
    read = parse_messages(says)
    assert [(line.when, line.cell, line.place) for line in read] == [
        ("lock", (12, 5), None), ("lock", NO_CELL, None), ("gold", (3, 4), None), ("switch", (1, 23), None),
        ("trap", (31, 1), None),
    ]  # fmt: skip
    one, any_of_them = read[:2]
    assert [one.is_about(x, 132.0) for x in (287.9, 288.0, 311.9, 312.0, float("nan"))] == [0, 1, 1, 0, 0]
    assert any_of_them.is_about(-99.0, float("nan"))


def test_each_moment_is_read() -> None:
    says = (
        r"start: a | switch: b | death 12: c | at 31,23 for 9 s: d | after 20 s for 99 s: e | gold 3: f \n g"
        " | all gold for 5 s: h"
    )
    read = parse_ascii_level(f"ninja-game level 1\nsays: {says}\n{PICTURE}").says
    assert [(each.when, each.text, each.number, each.cell, each.seconds) for each in parse_messages(read)] == [
        ("start", "a", 0, (0, 0), 0),
        ("switch", "b", 0, (0, 0), 0),
        ("death", "c", 12, (0, 0), 0),
        ("at", "d", 0, (31, 23), 9),
        ("after", "e", 20, (0, 0), 99),
        ("gold", "f\ng", 3, (0, 0), 0),
        ("all gold", "h", 0, (0, 0), 5),
    ]
