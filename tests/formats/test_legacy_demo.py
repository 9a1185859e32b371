"""Legacy demos with the reader's two defects, game.md §4.2."""

import re

import pytest
from hypothesis import given, strategies as st

from ninja_game.errors import DemoError
from ninja_game.formats.n14.demo import parse_demo, parse_legacy_demo
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, Demo
from tests.support.legacy_demos import write_legacy_demo


def demo_of(keys: str) -> Demo:
    """A demo from one digit a tick."""
    return Demo(bytes(map(int, keys)), len(keys))


def keys_of(demo: Demo) -> str:
    return "".join(str(keys & 7) for keys in demo.inputs)


def char(pair: str) -> str:
    """The character of two octal digits."""
    code = 34 + int(pair, 8)
    return chr(code + (code > 91))


def test_frames_are_padded_to_whole_words() -> None:
    # Ten digits a word: 1245612456 and ten zeros, which are a run: 7 0 06.
    pairs = ["12", "45", "61", "24", "56", "70", "06"]
    assert write_legacy_demo(demo_of("1245612456")) == "A" + "".join(map(char, pairs))


def test_runs_of_digits_from_5_to_67_are_shortened() -> None:
    # 7 zeros of padding are 7 0 03, after a run of 63 ones: 7 1 73. Eight digits, even: no padding digit.
    assert write_legacy_demo(demo_of("1" * 63)) == "A" + "".join(map(char, ["71", "73", "70", "03"]))
    # 70 ones: a run of 67 and three copied; then ten zeros. Odd: the padding digit 3.
    assert write_legacy_demo(demo_of("1" * 70)) == "A" + "".join(map(char, ["71", "77", "11", "17", "00", "63"]))


def test_the_backslash_is_left_out() -> None:
    pairs = [f"{value:02o}" for value in range(64)]
    codes = [ord(char(pair)) for pair in pairs]
    assert codes == [*range(34, 92), *range(93, 99)]


def test_runs_of_characters_from_3_to_50_are_shortened() -> None:
    text = write_legacy_demo(demo_of("12" * 60))
    # 120 digits are 60 characters "12": 50 and 10 of them; ten zeros: 7 0 06.
    assert text == "A" + chr(150) + char("12") + chr(110) + char("12") + char("70") + char("06")


def test_left_and_right_together_are_written_as_neither() -> None:
    assert keys_of(parse_legacy_demo(write_legacy_demo(demo_of("1372")))) == "1042000000"


def test_triggers_are_recomputed() -> None:
    demo = parse_legacy_demo("A" + char("46") + char("04"))
    assert demo.inputs == bytes([4 | 8, 6, 0, 4 | 8])


def test_defect_a_the_character_behind_a_run_is_lost() -> None:
    text = "A" + chr(103) + char("12") + char("45") + char("66")
    assert keys_of(parse_legacy_demo(text)) == "121212" + "66"


def test_defect_b_a_last_3_is_dropped_and_with_it_an_unfinished_run() -> None:
    assert keys_of(parse_legacy_demo("A" + char("12") + char("63"))) == "126"
    assert keys_of(parse_legacy_demo("A" + char("12") + char("70") + char("03"))) == "12"
    assert keys_of(parse_legacy_demo("A" + char("12") + char("70") + char("04"))) == "12" + "0" * 8


def test_the_playback_length_stays_what_it_was_before() -> None:
    text = write_legacy_demo(demo_of("12"))
    assert parse_demo(text).length == 10
    assert parse_demo(text, length=2) == Demo(b"\1\2", 2)


@pytest.mark.parametrize(
    "text, column, found",
    [
        ("A!", 2, "'!'"),
        ('A"\\', 3, "'\\\\\\\\'"),
        ("Ac", 2, "'c'"),
        ("A" + chr(103), 3, "the end of the text"),
        ("A" + chr(103) + chr(104), 3, "'h'"),
        ("A" + chr(151), 2, "x97"),
        ("A\n", 2, "n'"),
        ("Aé", 2, "'é'"),
    ],
)
def test_characters_that_no_writer_made_are_named(text: str, column: int, found: str) -> None:
    with pytest.raises(DemoError, match=found) as caught:
        parse_demo(text)
    assert caught.value.column == column


def test_a_text_that_would_fill_the_memory_is_refused() -> None:
    run = chr(150) + char("71") + char("77")
    with pytest.raises(DemoError, match="too long"):
        parse_demo("A" + run * 100_000)
    with pytest.raises(DemoError, match="too long"):
        parse_demo("A" + (char("71") + char("77")) * 1000)
    with pytest.raises(DemoError, match="too long"):
        write_legacy_demo(Demo(bytes(50_000), 50_000))
    assert len(parse_demo(write_legacy_demo(Demo(bytes(49_999), 49_999))).inputs) == 50_000


@given(st.text("0124560000", max_size=200))
def test_what_the_defects_do_not_touch_reads_back(keys: str) -> None:
    text = write_legacy_demo(demo_of(keys))
    padded = keys.ljust(len(keys) // 10 * 10 + 10, "0")
    digits = re.sub(r"([0-7])\1{4,66}", lambda run: f"7{run[1]}{len(run[0]) - 4:02o}", padded)
    touched = any(ord(one) > 100 for one in text) or (digits.endswith("3") and len(digits) % 2 == 0)
    demo = parse_legacy_demo(text)
    assert (keys_of(demo) == padded) or touched
    held_before = False
    for tick_keys in demo.inputs:
        assert bool(tick_keys & JUMP_PRESSED) == (bool(tick_keys & JUMP_HELD) and not held_before)
        held_before = bool(tick_keys & JUMP_HELD)
