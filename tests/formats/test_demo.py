"""Demos, game.md §4.1 and §4.4."""

import math
import random
from itertools import pairwise

import pytest
from hypothesis import given

from ninja_game.errors import DemoError
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.sim.inputs import JUMP_HELD, MAX_DEMO_TICKS, Demo, with_press_bit, with_press_bits
from tests.support.strategies import demos


def test_jump_is_pressed_where_its_key_goes_down_and_nowhere_else() -> None:
    inputs = bytes(random.Random(3).choices(range(16), k=5000))
    expected = [with_press_bit(keys, before & JUMP_HELD) for before, keys in pairwise(b"\0" + inputs)]
    assert list(with_press_bits(inputs)) == list(with_press_bits(list(inputs))) == expected
    assert with_press_bits([]) == b""


def test_a_word_holds_seven_frames_the_first_in_the_lowest_bits() -> None:
    word = sum(keys << 4 * place for place, keys in enumerate([1, 2, 3, 4, 8, 15, 12]))
    assert parse_demo(f"9:{word}|2").inputs == bytes([1, 2, 3, 4, 8, 15, 12, 2, 0])


@pytest.mark.parametrize("text, missing", [("9:801|2", 0), ("15:801|2", 1), ("702:801", 695), ("0:", 0), ("3:", 0)])
def test_a_cut_demo_says_how_many_ticks_are_missing(text: str, missing: int) -> None:
    assert parse_demo(text).missing == missing


@pytest.mark.parametrize(
    "text, inputs",
    [
        ("3:801", [1, 2, 3]),
        ("3:801|5|6", [1, 2, 3]),  # superfluous words are never reached
        ("8:801", [1, 2, 3, 0, 0, 0, 0, 0]),  # missing words are 0
        ("3:", [0, 0, 0]),
        ("3", [0, 0, 0]),  # without a colon there are no words
        ("3:801:2|2", [1, 2, 3]),  # anything after a second colon is ignored
        ("2.5:801", [1, 2, 3]),  # inputs count while k < length
        ("3:abc", [0, 0, 0]),
        ("8:|1", [0, 0, 0, 0, 0, 0, 0, 1]),
        ("1:894-784", [0]),  # no number
        ("2:-1", [15, 15]),  # modulo 2^32
        ("2:4294967313", [1, 1]),
        ("7:268435456", [0] * 7),  # bits from 28 up are ignored
        ("1:NaN", [0]),
        ("1:1e999", [0]),
        ("2:0x11", [1, 1]),
        ("1:2.9", [2]),
        ("0:801", []),
        ("-5:801", []),
        ("NaN:801", []),
        (":801", []),
        ("", []),
        (" 3:801", [1, 2, 3]),
        ("3 :801", []),
    ],
)
def test_odd_texts_read_as_the_game_reads_them(text: str, inputs: list[int]) -> None:
    assert parse_demo(text).inputs == bytes(inputs)


def test_after_the_length_the_last_frame_is_used_once_more_then_no_key() -> None:
    demo = parse_demo("2:193")  # inputs 1 and 12: jump triggered
    assert demo.playback(6) == bytes([1, 12, 12, 0, 0, 0])
    assert demo.playback(2) == bytes([1, 12])
    assert demo.playback(0) == b""


@pytest.mark.parametrize("text", ["NaN:193", "x:193", "0:193", "-1:193"])
def test_without_a_length_playback_stops_at_once(text: str) -> None:
    demo = parse_demo(text)
    assert (demo.end, demo.playback(3)) == (0, bytes(3))


def test_a_length_with_a_fraction_counts_frames_below_it() -> None:
    assert parse_demo("1.5:193").playback(4) == bytes([1, 12, 12, 0])


@pytest.mark.parametrize("length", ["1e300", "1e999", "99999999999", "0x7fffffff"])
def test_an_absurd_length_costs_nothing(length: str) -> None:
    demo = parse_demo(f"{length}:193")
    assert demo.end == len(demo.inputs) == MAX_DEMO_TICKS
    assert demo.playback(4) == bytes([1, 12, 0, 0])


def test_frames_beyond_the_games_own_limit_are_kept_if_they_are_there() -> None:
    text = "30000:" + "|".join(["17"] * 5000)
    assert parse_demo(text).end == 30000


@pytest.mark.parametrize(
    "inputs, length, text",
    [
        (b"", 0, "0:0"),
        (b"\x01\x02\x03", 3, "3:801"),
        (bytes([1] * 7), 7, "7:17895697|0"),
        (bytes([1] * 8), 8, "8:17895697|1"),
        (bytes([1] * 8), 7, "7:17895697|1"),  # closed after a death
    ],
)
def test_the_writer_begins_a_word_as_soon_as_one_is_full(inputs: bytes, length: float, text: str) -> None:
    assert write_demo(Demo(inputs, length)) == text


@pytest.mark.parametrize("demo", [Demo(b"\x10", 1), Demo(b"", math.nan)])
def test_what_no_demo_can_say_is_refused(demo: Demo) -> None:
    with pytest.raises(DemoError):
        write_demo(demo)


@given(demos)
def test_demos_read_back_equal(demo: Demo) -> None:
    assert parse_demo(write_demo(demo)) == demo
