"""In-game level strings, game.md §5.1-§5.3."""

import math
import random

import pytest
from hypothesis import given

from ninja_game.errors import LevelError
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, tidy_level_string, write_level_string
from ninja_game.sim.kinds import DRONE, GOLD, NINJA
from ninja_game.sim.level import TILES, Level, ObjectSpec
from tests.support.strategies import odd_levels, proper_levels

EMPTY = "0" * TILES


def records(objects: str) -> tuple[ObjectSpec, ...]:
    return parse_level_string(f"{EMPTY}|{objects}").objects


def test_tiles_run_down_the_columns() -> None:
    level = parse_level_string("1" + "0" * 22 + "Q" + "0" * 689 + "|")
    assert (level.tile(1, 1), level.tile(2, 1), level.tile(1, 2)) == (1, 33, 0)


def test_every_tile_character_has_its_id() -> None:
    chars = "".join(chr(48 + tile) for tile in range(34))
    assert parse_level_string(chars.ljust(TILES, "0") + "|").tiles[:34] == tuple(range(34))


def test_records_keep_order_kinds_and_values() -> None:
    assert records("5^132,200!0^396,300!6^252,132,0,1,0,2") == (
        ObjectSpec(NINJA, (132.0, 200.0)),
        ObjectSpec(GOLD, (396.0, 300.0)),
        ObjectSpec(DRONE, (252.0, 132.0, 0.0, 1.0, 0.0, 2.0)),
    )


# --- The table of malformed input, row by row ---


def test_a_text_that_starts_with_a_dollar_is_split_at_the_hashes() -> None:
    assert parse_level_string(f"$name#author#comment#{EMPTY}|0^1,2#free text") == parse_level_string(f"{EMPTY}|0^1,2")


@pytest.mark.parametrize("text", ["$", "$a#b", "$a#b#c"])
def test_a_text_that_starts_with_a_dollar_needs_four_fields(text: str) -> None:
    with pytest.raises(
        LevelError, match=r"^levels\.txt:7: .*fourth field.*expected \$name#author#comment#level string#"
    ):
        parse_level_string(text, file="levels.txt", line=7)


def test_only_the_first_two_parts_count() -> None:
    assert records("0^1,2|0^3,4|5^5,6") == (ObjectSpec(GOLD, (1.0, 2.0)),)


@pytest.mark.parametrize("text", [EMPTY, EMPTY + "|", EMPTY + "||0^1,2"])
def test_nothing_after_the_bar_means_no_objects(text: str) -> None:
    assert parse_level_string(text) == Level((0,) * TILES, ())


def test_cells_that_a_short_tile_string_does_not_reach_are_missing() -> None:
    assert parse_level_string("012|5^36,36").tiles == (0, 1, 2) + (-1,) * 710


def test_the_rest_of_a_long_tile_string_is_ignored() -> None:
    assert parse_level_string(EMPTY + "111|").tiles == (0,) * TILES


def test_characters_outside_the_alphabet_give_odd_ids() -> None:
    level = parse_level_string("o/.é \n".ljust(TILES, "0") + "|")
    assert level.tiles[:6] == (63, -1, -2, 185, -16, -38)


def test_white_space_among_the_tiles_shifts_all_later_cells() -> None:
    assert parse_level_string("0 1" + "0" * 710 + "|").tiles[:3] == (0, -16, 1)


@pytest.mark.parametrize("text", ["13^1,2", "-1^1,2", "0.5^1,2", "abc^1,2", "^1,2", "99", "nonsense"])
def test_records_of_unknown_types_are_ignored_but_kept_as_text(text: str) -> None:
    assert records(f"{text}!0^3,4") == (ObjectSpec(-1, (), text), ObjectSpec(GOLD, (3.0, 4.0)))


def test_empty_records_are_ignored() -> None:
    assert records("!0^3,4!") == (ObjectSpec(-1, (), ""), ObjectSpec(GOLD, (3.0, 4.0)), ObjectSpec(-1, (), ""))


@pytest.mark.parametrize("text", [" 0", "+0", "0.0", "0x0", "00", "-0", "0e5"])
def test_types_are_numbers_like_any_other(text: str) -> None:
    assert records(f"{text}^3,4") == (ObjectSpec(GOLD, (3.0, 4.0)),)


def test_records_without_caret_or_with_wrong_counts_are_made_as_they_are() -> None:
    assert records("7!1^442!0^473,347,1!5^1^2,3") == (
        ObjectSpec(7, ()),
        ObjectSpec(1, (442.0,)),
        ObjectSpec(0, (473.0, 347.0, 1.0)),
        ObjectSpec(5, (1.0,)),
    )


@pytest.mark.parametrize("text", ["", "NaN", "text", "--5", "685 ", "Infinity"])
def test_values_that_are_no_numbers_are_nan(text: str) -> None:
    (record,) = records(f"0^396,{text}")
    assert record.values[0] == 396.0
    assert math.isnan(record.values[1])


def test_leading_blanks_before_a_number_are_harmless() -> None:
    assert records(" 0^ 685, 469") == (ObjectSpec(GOLD, (685.0, 469.0)),)


def test_the_number_forms_of_the_page() -> None:
    read = records("0^685.,+469!0^0x64,0x40!0^0150,070!12^1e2,2.5e2")
    assert [record.values for record in read] == [(685.0, 469.0), (100.0, 64.0), (104.0, 56.0), (100.0, 250.0)]


# --- Tidying, writing, digest ---


def test_tidying_joins_wrapped_lines_and_leaves_blanks_among_the_objects() -> None:
    text = "01\r\n2 3|5^1,\n 2!\n0^3,4 ! 0^5 ,6\n"
    assert tidy_level_string(text) == "0123|5^1,2!0^3,4 ! 0^5 ,6"


def test_writing_follows_the_page() -> None:
    text = EMPTY + "|5^60,564!2^60,564,0.707106781186547,-0.707106781186547!0^396,NaN!7!13^a!3^586.632097968693,.5"
    assert write_level_string(parse_level_string(text)) == text.replace(",.5", ",0.5")


def test_a_short_tile_string_is_written_in_full() -> None:
    level = parse_level_string("012|5^36,36")
    assert parse_level_string(write_level_string(level)) == level


def test_launch_pads_of_v2_exports_lose_their_superfluous_zeros() -> None:
    text = write_level_string(parse_level_string(EMPTY + "|2^60,564,0.0,-1.0"))
    assert text == EMPTY + "|2^60,564,0,-1"


@pytest.mark.parametrize(
    "level, message",
    [
        (Level((76, *[0] * 712)), "tile id 76 in column 1, row 1"),
        (Level((*[0] * 712, -49)), "tile id -49 in column 31, row 23"),
        (Level((0xD800, *[0] * 712)), "tile id 55296"),
        (Level((-12, *[0] * 712)), "cannot start with '\\$'"),
        (Level((0,) * 5), "wrong number of tiles; found 5"),
        (Level(objects=(ObjectSpec(-1, (), "a!b"),)), "'a!b'"),
    ],
)
def test_levels_that_no_string_can_say_are_refused(level: Level, message: str) -> None:
    with pytest.raises(LevelError, match=message):
        write_level_string(level)


@given(odd_levels)
def test_any_level_reads_back_equal(level: Level) -> None:
    for exact in (False, True):
        assert parse_level_string(write_level_string(level, exact=exact)) == level


@given(proper_levels)
def test_writing_is_stable(level: Level) -> None:
    text = write_level_string(level)
    assert write_level_string(parse_level_string(text)) == text


def test_exact_writing_keeps_what_15_digits_lose() -> None:
    level = Level(objects=(ObjectSpec(GOLD, (2 / 3, 0.1 + 0.2)),))
    assert parse_level_string(write_level_string(level, exact=True)) == level
    assert parse_level_string(write_level_string(level)) != level


def test_the_digest_sees_tiles_order_and_every_bit_of_values() -> None:
    level = parse_level_string(EMPTY + "|5^60,60!0^36,36!0^60.5,36")
    others = [
        Level((1, *level.tiles[1:]), level.objects),
        Level(level.tiles, level.objects[::-1]),
        Level(level.tiles, (*level.objects[:2], ObjectSpec(0, (math.nextafter(60.5, 61), 36.0)))),
        Level(level.tiles, level.objects[:2]),
    ]
    assert len({level_digest(one) for one in (level, *others)}) == 5


def test_the_digest_ignores_what_makes_no_difference() -> None:
    level = parse_level_string(EMPTY + "|5^60,60!2^36,36,0,-1")
    same = Level(level.tiles, (ObjectSpec(-1, (), "99"), level.objects[0], ObjectSpec(2, (36.0, 36.0, -0.0, -1.0))))
    assert level_digest(level) == level_digest(same)


def test_the_digest_does_not_change_between_versions() -> None:
    level = parse_level_string(EMPTY + "|5^60,60!0^36.5,NaN")
    assert level_digest(level) == "a05adbcdad773ccadd62e5c8364a788e751d52bb41fb20d7d405c092314b88f1"


def test_no_text_stops_the_reader() -> None:
    rng = random.Random(3)
    for _ in range(500):
        text = "".join(rng.choice("0019QR|!^,.-+eExN $#\n\t\x00é") for _ in range(rng.randrange(900)))
        if not text.startswith("$"):
            parse_level_string(text)
