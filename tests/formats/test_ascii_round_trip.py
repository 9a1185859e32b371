"""Any level to ASCII and back: the same tiles, records, order and float64 values, to the bit."""

import contextlib
import math
import time

import pytest
from hypothesis import example, given, settings, strategies as st

from ninja_game.errors import NinjaGameError
from ninja_game.formats.ascii.legend import SYMBOLS, TILE_CHARS, visible_glyphs
from ninja_game.formats.ascii.reader import is_ascii_level, parse_ascii_level
from ninja_game.formats.ascii.writer import same_spec, write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.kinds import GOLD, NINJA, VALUE_COUNTS
from ninja_game.sim.level import TILES, Level, ObjectSpec
from tests.support.reference import fuzz, levels, random_runs, scenes

EMPTY = "|" + "." * 31 + "|"
ODD_NUMBERS = (math.nan, math.inf, -math.inf, -0.0, 0.0, 1e300, 5e-324, 0.1, 0.7071067811865468, 408.15000000000003)


def same_level(a: Level, b: Level) -> bool:
    return a.tiles == b.tiles and len(a.objects) == len(b.objects) and all(map(same_spec, a.objects, b.objects))


def assert_round_trip(level: Level) -> str:
    text = write_ascii_level(level)
    read = parse_ascii_level(text, file="round trip").level
    assert same_level(read, level), text
    return text


cells = st.integers(1, 31).map(lambda i: 24.0 * i + 12.0)
coordinates = st.one_of(
    cells,
    st.integers(-2, 70).map(lambda i: 12.0 * i),
    st.integers(-10, 800).map(float),
    st.floats(),
    st.sampled_from(ODD_NUMBERS),
)
small = st.one_of(st.integers(-1, 6).map(float), st.sampled_from(ODD_NUMBERS))
proper = st.sampled_from((0.0, 1.0, 2.0, 3.0))


@st.composite
def records(draw: st.DrawFn) -> ObjectSpec:
    """Objects as real levels have them, and every odd thing beside."""
    kind = draw(st.integers(-1, 12))
    if kind == -1:
        return ObjectSpec(-1, tuple(draw(st.lists(coordinates, max_size=2))), draw(st.text(max_size=8)))
    drawable = [symbol for symbol in SYMBOLS if symbol.kind == kind and symbol.values is not None]
    if draw(st.booleans()) and drawable:
        symbol = draw(st.sampled_from(drawable))
        place = [draw(cells) + symbol.dx, draw(cells) + symbol.dy, *(symbol.values or ())]
        return ObjectSpec(kind, tuple(place + [draw(cells) for _ in range(VALUE_COUNTS[kind] - len(place))]))
    count = draw(st.one_of(st.just(VALUE_COUNTS[kind]), st.just(VALUE_COUNTS[kind]), st.integers(0, 10)))
    places = [draw(coordinates) for _ in range(min(2, count))]
    rest = [draw(st.one_of(proper, small, cells)) for _ in range(count - len(places))]
    return ObjectSpec(kind, tuple(places + rest), draw(st.sampled_from(("", "", "", "text"))))


tiles = st.one_of(
    st.just((0,) * TILES),
    st.lists(st.one_of(st.just(0), st.integers(0, 33)), min_size=TILES, max_size=TILES).map(tuple),
    st.lists(st.sampled_from((0, 1, 2, -1, 34, 1_000_000)), min_size=TILES, max_size=TILES).map(tuple),
)
few = st.sampled_from((36.0, 60.0))
random_levels = st.builds(Level, tiles, st.lists(records(), max_size=25).map(tuple))


@settings(max_examples=80)
@given(random_levels)
def test_random_levels_come_back_to_the_bit(level: Level) -> None:
    assert_round_trip(level)


@settings(max_examples=100)
@given(st.lists(st.tuples(records(), few, few), max_size=12))
def test_objects_that_crowd_few_cells_come_back_in_order(drawn: list[tuple[ObjectSpec, float, float]]) -> None:
    crowded = [
        ObjectSpec(record.kind, (x, y, *record.values[2:]), record.text)
        for record, x, y in drawn
        if len(record.values) >= 2
    ]
    assert_round_trip(Level(objects=tuple(crowded)))


any_text = st.text(st.characters())  # halves of surrogate pairs too, which JSON can hold


@given(any_text, any_text, any_text, any_text)
@example("\ud800", '"\udfff"', "", "\n")
def test_whatever_a_header_says_comes_back(name: str, author: str, comment: str, teaches: str) -> None:
    text = write_ascii_level(Level(), name=name, author=author, comment=comment, teaches=teaches)
    read = parse_ascii_level(text)
    assert (read.name, read.author, read.comment, read.teaches) == (name, author, comment, teaches)


def test_a_level_written_with_its_legend_reads_the_same() -> None:
    level = Level(objects=(ObjectSpec(NINJA, (36.0, 36.0)), ObjectSpec(GOLD, (60.0, 61.0))))
    assert parse_ascii_level(write_ascii_level(level, legend=True)).level == level


def test_objects_in_reading_order_need_no_line() -> None:
    drawn = (ObjectSpec(NINJA, (300.0, 300.0)), ObjectSpec(GOLD, (36.0, 36.0)), ObjectSpec(GOLD, (60.0, 36.0)))
    text = write_ascii_level(Level(objects=drawn))
    assert "gold" not in text
    assert "\n\ngold 1,1\n" in assert_round_trip(Level(objects=(drawn[0], drawn[2], drawn[1])))


def test_the_picture_shows_tiles_and_objects() -> None:
    level = Level((1,) * 23 + (0,) * (TILES - 23), (ObjectSpec(GOLD, (60.0, 36.0)),))
    rows = [line.split("|")[1] for line in write_ascii_level(level).splitlines() if line.endswith("|")]
    assert len(rows) == 23
    assert rows[0] == "#o" + "." * 29


def test_written_levels_are_recognised() -> None:
    assert is_ascii_level(write_ascii_level(Level()))
    assert not is_ascii_level("")
    assert not is_ascii_level("$name#author##" + "0" * TILES + "|#")


UNPLEASANT = (
    "ninja-game level 1\n" + " " * 200_000 + "x",
    "ninja-game level 1\n" + "7" * 200_000,
    "ninja-game level 1\n" + "|" * 200_000 + " " * 200_000,
    "ninja-game level 1\n" + f"{EMPTY}\n" * 20_000,
    "ninja-game level 1\n" + f"{EMPTY}\n" * 23 + '"\\' * 100_000,
    "ninja-game level 1\n" + f"{EMPTY}\n" * 23 + "raw " + '\\"' * 100_000,
    "ninja-game level 1\n" + f"{EMPTY}\n" * 23 + "thwomp 1,1\n" * 20_000,
    "ninja-game level 1\n" + f"{EMPTY}\n" * 23 + "gold " + "9" * 200_000 + ",1",
    "ninja-game level 1\n" + "nmae: x\n" * 20_000,
    "ninja-game level 1\n" + f"{EMPTY}\n" * 23 + "gold " + "0" * 200_000 + "x,1px",
    "ninja-game level 1\n" + f"{EMPTY}\n" * 23 + "gold 1," + "." * 100_000 + "0e" * 100_000,
)


@pytest.mark.parametrize("number", range(len(UNPLEASANT)))
def test_long_rubbish_is_reported_shortly(number: int) -> None:
    started = time.process_time()
    with pytest.raises(NinjaGameError) as caught:
        parse_ascii_level(UNPLEASANT[number])
    assert len(str(caught.value)) < 5000
    assert time.process_time() - started < 2


@settings(max_examples=80)
@given(random_levels, st.lists(st.tuples(st.integers(0, 5000), st.integers(0, 40), st.text(max_size=6)), max_size=4))
def test_mutated_text_gives_a_level_or_one_of_our_errors(level: Level, edits: list[tuple[int, int, str]]) -> None:
    text = write_ascii_level(level, name="mutant")
    for place, length, new in edits:
        start = place % (len(text) + 1)
        text = text[:start] + new + text[start + length :]
    with contextlib.suppress(NinjaGameError):
        parse_ascii_level(text)


@given(st.text(alphabet=TILE_CHARS + ' |;:,"\n' + "".join(symbol.char for symbol in SYMBOLS) + "raw tile id px"))
def test_rubbish_gives_one_of_our_errors(text: str) -> None:
    for lead in ("", "ninja-game level 1\n"):
        with pytest.raises(NinjaGameError):
            parse_ascii_level(lead + text)


def reference_texts() -> list[str]:
    # The crowded ones are many and alike: every tenth keeps the suite fast.
    crowded = [row.data for row in fuzz()[::10]] + [row.data for row in random_runs()[::10]]
    return [row.data for row in levels()] + [row.data for row in scenes()] + crowded


@pytest.mark.slow
def test_reference_levels_come_back_to_the_bit() -> None:
    for text in reference_texts():
        level = parse_level_string(text)
        written = write_ascii_level(level)
        assert written.isascii()
        assert same_level(parse_ascii_level(written).level, level), text


def test_visible_parts_are_in_the_picture() -> None:
    record = ObjectSpec(GOLD, (36.0, 36.0))
    assert [tuple(part) for part in visible_glyphs(record)] == [("o", 1, 1)]
    assert visible_glyphs(ObjectSpec(GOLD, (37.0, 36.0))) == []


def test_a_record_is_the_same_to_the_last_bit_and_any_nan_is_one() -> None:
    values = (1.0, math.nan), (1.0, math.nan), (1.0, 2.0), (1.0, -0.0), (1.0, 0.0)
    gold = [ObjectSpec(GOLD, each) for each in values]
    assert same_spec(gold[0], gold[1])
    assert not any(same_spec(gold[0], each) for each in gold[2:])
    assert not same_spec(gold[3], gold[4])
