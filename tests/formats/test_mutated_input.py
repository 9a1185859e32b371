"""Broken input: whatever is done to a text, only our own errors come out of its reader."""

import contextlib
from collections.abc import Callable

from hypothesis import given, strategies as st

from ninja_game.errors import FormatError
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.level_file import read_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.formats.numbers import format_exact, format_number, parse_flash_number
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from tests.support.strategies import mutations_of

LEVEL = "1" * 23 + "0" * 690 + "|5^60,540!2^60,564,0.707106781186547,-1!6^60,60,0,1,0,2!0^396,NaN!11^708,540,396,540"
DEMO = "902:35791394|35791394|115483170|0"
FILE = f"free text\n&userdata=\n$a hill#us#x#{LEVEL}#\n$b%20#us##{LEVEL}#{DEMO}#\n-- ep01 --\n$###{LEVEL}#{DEMO}"
REPLAY = write_replay(
    Replay(
        bytes([2] * 30 + [14, 6, 6, 0, 12, 8]), 99, "dead", 3, "0f" * 32, level=parse_level_string(LEVEL), name="walk"
    )
)
LEGACY = 'A"2bQ\x96"\x70#,4'


def reads(reader: Callable[[str], object], text: str) -> None:
    with contextlib.suppress(FormatError):
        reader(text)


@given(mutations_of((LEVEL,)))
def test_levels(text: str) -> None:
    with contextlib.suppress(FormatError):
        level = parse_level_string(text)
        level_digest(level)
        assert parse_level_string(write_level_string(level, exact=True)) == level


@given(mutations_of((FILE, f"##{DEMO}#", LEVEL, REPLAY)))
def test_files(text: str) -> None:
    reads(read_level_file, text)
    reads(parse_levels, text)
    reads(parse_replays, text)


@given(mutations_of((DEMO, LEGACY)))
def test_demos(text: str) -> None:
    with contextlib.suppress(FormatError):
        demo = parse_demo(text)
        assert len(demo.playback(1000)) == 1000
        assert len(demo.inputs) == demo.end
        assert parse_demo(write_demo(demo)).playback(1000) == demo.playback(1000)


@given(mutations_of((REPLAY,)))
def test_replays(text: str) -> None:
    with contextlib.suppress(FormatError):
        replay = parse_replay(text)
        assert parse_replay(write_replay(replay)) == replay


@given(st.text("0123456789.+-eExX \n", max_size=12) | st.text(max_size=12))
def test_numbers(text: str) -> None:
    value = parse_flash_number(text)
    format_number(value)
    format_exact(value)
