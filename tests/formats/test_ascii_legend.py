"""The legend: one character for each thing, one thing for each character, and slopes that lie where their keys lie."""

import string
from collections import Counter

import pytest

from ninja_game.formats.ascii.legend import (
    ODD_TILE,
    PAD_DIGITS,
    PAD_NORMALS,
    SYMBOLS,
    TILE_CHARS,
    TILE_FAMILIES,
    TILE_OF_CHAR,
    Symbol,
    legend_text,
    visible_glyphs,
)
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.sim.collision.tiles import (
    CONCAVE,
    CONVEX,
    SHAPE,
    SIGN_X,
    SIGN_Y,
    SLOPE_45,
    THICK_22,
    THICK_67,
    THIN_22,
    THIN_67,
)
from ninja_game.sim.kinds import KIND_NAMES, LAUNCH_PAD, VALUE_COUNTS
from ninja_game.sim.level import ObjectSpec

CLASSES = (SLOPE_45, THIN_22, THICK_22, THIN_67, THICK_67, CONCAVE, CONVEX)
OPEN_SIDES = (
    (1.0, 1.0),
    (-1.0, 1.0),
    (1.0, -1.0),
    (-1.0, -1.0),
)  # solid corner top left, top right, bottom left, right
KEYBOARD = ("qwertyuiop", "asdfghjkl", "zxcvbnm")


def test_no_character_means_two_things() -> None:
    chars = TILE_CHARS + ODD_TILE + "".join(symbol.char for symbol in SYMBOLS)
    assert [char for char, count in Counter(chars).items() if count > 1] == []
    assert set(chars) <= set(string.printable) - set(string.whitespace) - set("|;,")


def test_all_34_shapes_have_a_character() -> None:
    assert len(TILE_CHARS) == 34
    assert {TILE_OF_CHAR[char] for char in TILE_CHARS} == set(range(34))


@pytest.mark.parametrize("family", range(7))
def test_a_slope_is_solid_in_the_corner_where_its_key_lies(family: int) -> None:
    name, chars = TILE_FAMILIES[family]
    tiles = [TILE_OF_CHAR[char] for char in chars]
    assert {SHAPE[tile] for tile in tiles} == {CLASSES[family]}, name
    assert [(SIGN_X[tile], SIGN_Y[tile]) for tile in tiles] == list(OPEN_SIDES)
    upper, lower = chars[:2].lower(), chars[2:].lower()
    assert KEYBOARD[0].index(upper) == KEYBOARD[1].index(lower), "a 2 x 2 block of keys"


def test_halves_look_like_their_characters() -> None:
    halves = {char: (SIGN_X[TILE_OF_CHAR[char]], SIGN_Y[TILE_OF_CHAR[char]]) for char in '_"[]'}
    assert halves == {"_": (0.0, -1.0), '"': (0.0, 1.0), "[": (1.0, 0.0), "]": (-1.0, 0.0)}


def test_every_kind_of_object_can_be_drawn() -> None:
    assert {symbol.kind for symbol in SYMBOLS} == set(range(len(KIND_NAMES)))


@pytest.mark.parametrize("drawn", [s for s in SYMBOLS if s.values is not None and s.char not in "Xx"])
def test_a_drawn_object_is_seen_where_it_is_drawn(drawn: Symbol) -> None:
    rows = ["|" + "." * 31 + "|"] * 22 + ["|" + "." * 6 + drawn.char + "." * 24 + "|"]
    (record,) = parse_ascii_level("ninja-game level 1\n" + "\n".join(rows)).level.objects
    assert record.kind == drawn.kind
    assert len(record.values) == VALUE_COUNTS[drawn.kind]
    assert record.values[:2] == (180.0 + drawn.dx, 564.0 + drawn.dy)
    assert [tuple(part) for part in visible_glyphs(record)] == [(drawn.char, 7, 23)]


def test_pads_are_drawn_as_the_key_of_the_numeric_keypad_in_their_direction() -> None:
    for word, (a, b) in PAD_NORMALS.items():
        digit = int(PAD_DIGITS[word]) - 1
        assert (digit % 3 - 1, 1 - digit // 3) == ((a > 0) - (a < 0), (b > 0) - (b < 0))
        assert visible_glyphs(ObjectSpec(LAUNCH_PAD, (180.0, 564.0, 0.5, b)))[0].char == "5"


def test_a_floor_pad_lies_on_the_floor_and_a_guard_stands_on_it() -> None:
    pad = next(symbol for symbol in SYMBOLS if symbol.char == "8")
    guard = next(symbol for symbol in SYMBOLS if symbol.char == "n")
    assert (pad.dx, pad.dy, guard.dx, guard.dy) == (0.0, 12.0, 0.0, 6.0)


def test_the_printed_legend_is_comments_and_names_every_character() -> None:
    text = legend_text()
    assert all(line.startswith(";") and len(line) <= 120 for line in text.splitlines())
    words = text.split()
    assert [char for char in TILE_CHARS if char not in words] == []
    assert [symbol.char for symbol in SYMBOLS if f"{symbol.char} {symbol.name}" not in text] == []
    needing = text.partition("Objects that also need a line")[2]
    assert all((f"{symbol.char} {symbol.name}" in needing) is (symbol.values is None) for symbol in SYMBOLS)


def test_the_columns_of_the_legend_stand_apart() -> None:
    for line in legend_text().splitlines():
        assert line.count("5 launch pad, other normal") == line.count("5 launch pad, other normal  ")
