"""Level files and replay texts, game.md §5.4-§5.6: every family of published files, rebuilt with content of our own."""

from collections.abc import Callable

import pytest
from hypothesis import given, strategies as st

from ninja_game.errors import FormatError, LevelError
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.n14.level_file import LevelRecord, read_level_file, write_level_file
from ninja_game.formats.n14.level_string import parse_level_string, write_level_string
from ninja_game.formats.replay.text import parse_replay, write_replay
from ninja_game.runs.run import record_replay
from ninja_game.sim.kinds import FLOOR_GUARD, NINJA
from tests.support.strategies import demos, proper_levels, words

TILES = ("1" + "0" * 21 + "1") * 31
LEVEL = TILES + "|5^60,540!0^396,300!11^708,540,396,540"
OTHER = TILES.replace("0001", "00F1", 2) + "|5^84,540!12^300,561"
DEMO = "9:35791394|34"


def fields(text: str) -> list[tuple[str, str, str, str, str]]:
    return [(r.name, r.author, r.comment, r.level, r.demo) for r in read_level_file(text)]


# --- The families ---


def test_episode_levels_with_empty_or_numbered_comments() -> None:
    text = f"$00-0 a hill#us##{LEVEL}#\n$00-1 a hole#us#1.4#{OTHER}#\n"
    assert fields(text) == [("00-0 a hill", "us", "", LEVEL, ""), ("00-1 a hole", "us", "1.4", OTHER, "")]


def test_records_know_their_number_and_line() -> None:
    text = f"free text\n\n$a###{LEVEL}#\n\n$b###{LEVEL}# $c###{LEVEL}#"
    assert [(r.number, r.line) for r in read_level_file(text)] == [(0, 3), (1, 5), (2, 5)]


def test_free_text_and_separators_between_records() -> None:
    text = f"Levels by us, 2006\n\n-- ep01 --\n$a#us#x#{LEVEL}#\n-- ep02: 5 levels # best ones --\n$b#us#x#{OTHER}#bye"
    assert fields(text) == [("a", "us", "x", LEVEL, ""), ("b", "us", "x", OTHER, "")]
    assert [r.note for r in read_level_file(text)] == ["-- ep02: 5 levels", "bye"]


def test_a_dollar_in_free_text_is_no_record() -> None:
    assert len(fields(f"$a###{LEVEL}# worth $5, or $7 #1\n$b###{LEVEL}#")) == 2


def test_art_levels_without_ninja_with_odd_values_and_tiles() -> None:
    art = "o" + TILES[1:] + "|0^396,NaN!2^60,60,-3.51,4.9!8^60,84,7!5^1,2!5^3,4!5^5,6"
    (record,) = read_level_file(f"$art#us#art#{art}#")
    level = parse_level_string(record.level)
    assert (level.tiles[0], sum(r.kind == NINJA for r in level.objects)) == (63, 3)
    assert write_level_string(level) == art


def test_lines_wrapped_inside_the_data() -> None:
    wrapped = f"{TILES[:300]}\n{TILES[300:]}|5^60,540!\n 0^396,300!\r\n11^708,540,396,540"
    assert fields(f"$a#us##{wrapped}#\n") == [("a", "us", "", LEVEL, "")]


def test_blanks_before_type_numbers_do_no_harm() -> None:
    (record,) = read_level_file(f"$a#us##{LEVEL.replace('!', '! ')}#")
    assert parse_level_string(record.level) == parse_level_string(LEVEL)


def test_white_space_among_the_tiles_is_taken_out() -> None:
    assert fields(f"$a#us##{TILES[:99]} {TILES[99:]}|5^60,540#") == [("a", "us", "", TILES + "|5^60,540", "")]


def test_exports_of_v2_keep_what_v1_makes_of_them() -> None:
    text = TILES + "|5^60,540!2^60,564,0.0,-1.0!2^84,564,-0.7,-0.7!4^252,570!11^1,2,3,4!11^5,6,7,8"
    (record,) = read_level_file(f"$a#us#v2#{text}#")
    level = parse_level_string(record.level)
    assert [len(r.values) for r in level.objects if r.kind == FLOOR_GUARD] == [2]
    assert write_level_string(level) == text.replace("0.0,-1.0", "0,-1")


def test_replay_collections() -> None:
    text = f"$a#us##{LEVEL}#{DEMO}#\n$###{LEVEL}#{DEMO}#\n$###{LEVEL}#{DEMO}"
    assert fields(text) == [("a", "us", "", LEVEL, DEMO), ("", "", "", LEVEL, DEMO), ("", "", "", LEVEL, DEMO)]


def test_demos_on_wrapped_lines() -> None:
    assert fields(f"$a#us##{LEVEL}#9:35791394|\n34#")[0][4] == DEMO
    assert fields(f"$a#us##{LEVEL}#9:35791394\n|34\n\nfound by us in 2007\n")[0][4] == DEMO


def test_replay_texts_that_leave_their_level_out() -> None:
    expected = [("", "", "", "", DEMO)]
    assert fields(f"##{DEMO}#") == expected
    assert fields(f"  ##{DEMO}") == expected
    assert fields(f"$##{DEMO}#") == expected
    assert fields(f"$###{DEMO}#") == expected
    assert fields(f"$####{DEMO}#") == expected
    assert fields(f"$a#us#x#{DEMO}#") == [("a", "us", "x", "", DEMO)]


def test_a_minus_sign_inside_a_demo_is_left_to_its_reader() -> None:
    assert fields(f"$###{LEVEL}#9:357-1394|34#")[0][4] == "9:357-1394|34"


def test_a_comment_that_looks_like_a_demo_is_a_comment() -> None:
    assert fields(f"$##10:30#{LEVEL}#") == [("", "", "10:30", LEVEL, "")]


def test_tiles_of_digits_and_colons_are_a_level() -> None:
    level = "0:" + "0" * 711 + "|"
    assert fields(f"$a#us##{level}#") == [("a", "us", "", level, "")]


def test_a_legacy_demo_needs_its_closing_hash() -> None:
    assert fields(f'$###{LEVEL}#A"2bQ#')[0][4] == 'A"2bQ'
    assert fields(f"$###{LEVEL}#AWESOME")[0][4] == ""


# --- No closing '#' ---


def test_without_its_last_hash_a_level_ends_at_the_first_white_space() -> None:
    text = f"$a#us##{LEVEL}\n\n12 levels by us follow, all new\n$b#us##{LEVEL} (old)\n$c#us##{LEVEL}"
    assert [r.level for r in read_level_file(text)] == [LEVEL] * 3


def test_without_its_last_hash_wrapped_data_still_holds_together() -> None:
    wrapped = f"{TILES[:300]}\n{TILES[300:]}|5^60,540!\n0^396,300!11^708,\n540,396,540\nfree text"
    assert fields(f"$a#us##{wrapped}")[0][3] == LEVEL


# --- URL encoding behind the marker, and only there ---


def test_behind_the_marker_the_data_is_url_encoded() -> None:
    text = f"How to: $not#a#real#record|#\n&userdata=\n$a+b%21#%C3%A9%E9#50%25#{LEVEL}#free+text&more=$x#y#z#{LEVEL}#"
    assert fields(text) == [("a b!", "Ã©é", "50%", LEVEL, "")]
    assert fields(f"&userdata=%24%C3%A9###{LEVEL}%23")[0][0] == "é"


def test_line_numbers_count_what_stands_before_the_marker() -> None:
    (record,) = read_level_file(f"one\ntwo\n&userdata=%0D%0A\n\n$a###{LEVEL}#")
    assert record.line == 5


def test_without_the_marker_nothing_is_decoded() -> None:
    assert fields(f"$a+b%21 & c#us##{LEVEL}#")[0][0] == "a+b%21 & c"


# --- Errors ---


@pytest.mark.parametrize("text", ["", "hello", "a # b", "$", "$$$", "&userdata=", f"{LEVEL}"])
def test_a_text_without_records_is_an_error(text: str) -> None:
    with pytest.raises(
        LevelError, match=r"^levels\.txt: no level record.*expected \$name#author#comment#level string#"
    ):
        read_level_file(text, file="levels.txt")


def test_a_record_with_fields_missing_is_named() -> None:
    with pytest.raises(
        LevelError, match=r"^levels\.txt:3: record 1 has only 3 fields.*an empty field still needs its '#'"
    ):
        read_level_file(f"$a###{LEVEL}#\n\n$b#us#{LEVEL}", file="levels.txt")


def test_a_record_without_level_is_named() -> None:
    with pytest.raises(LevelError, match=r"^levels\.txt:2: record 0 has no level string"):
        read_level_file("\n$a#b#c##", file="levels.txt")


# --- Writing ---


def test_records_are_written_one_a_line() -> None:
    records = [LevelRecord("a", "us", "", LEVEL), LevelRecord("b", "us", "x", LEVEL, DEMO)]
    assert write_level_file(records) == f"$a#us##{LEVEL}#\n$b#us#x#{LEVEL}#{DEMO}#\n"


def test_the_games_own_form_is_url_encoded() -> None:
    text = write_level_file([LevelRecord("a + b & 5%", "us", "", LEVEL)], userdata=True)
    assert text == f"&userdata=$a %2B b %26 5%25#us##{LEVEL}#\n"
    assert fields(text) == [("a + b & 5%", "us", "", LEVEL, "")]


@pytest.mark.parametrize(
    "record, message",
    [
        (LevelRecord("a#b", "", "", LEVEL), "the name of record 0 does not fit.*take '#' out of the name"),
        (LevelRecord("a", "$", "", LEVEL), "the author"),
        (LevelRecord("a", "", "x\ny", LEVEL), "the comment"),
        (LevelRecord("a", "", "", "0#" + LEVEL), "the level"),
        (LevelRecord("a", "", "", "0 " + LEVEL), "white space"),
        (LevelRecord("a", "", "", ""), "no level string"),
        (LevelRecord("a", "", "", LEVEL, "1:2#"), "the demo"),
        (LevelRecord("a", "", "", LEVEL, "hello"), "the demo of record 0 is not a demo"),
        (LevelRecord("&userdata=", "", "", LEVEL), "&userdata="),
    ],
)
def test_what_a_level_file_cannot_hold_is_refused(record: LevelRecord, message: str) -> None:
    with pytest.raises(LevelError, match=message):
        write_level_file([record])


records = st.builds(
    LevelRecord,
    words,
    words,
    words,
    proper_levels.map(write_level_string),
    st.one_of(st.just(""), demos.map(lambda demo: f"{len(demo.inputs)}:{len(demo.inputs)}|0")),
    st.just(0),
    st.just(0),
    st.just(""),
)


@given(st.lists(records, min_size=1, max_size=3), st.booleans())
def test_level_files_read_back_equal(written: list[LevelRecord], userdata: bool) -> None:
    read = read_level_file(write_level_file(written, userdata=userdata))
    assert [(r.name, r.author, r.comment, r.level, r.demo) for r in read] == [
        (r.name, r.author, r.comment, r.level, r.demo) for r in written
    ]


LONG = "n" * 1001
LONG_NAMES: dict[str, Callable[[], object]] = {
    "record": lambda: read_level_file(f"${LONG}#a#c#{LEVEL}#"),
    "replay": lambda: parse_replay(write_replay(record_replay(parse_level_string(LEVEL), b"\2", name=LONG))),
    "ascii": lambda: parse_ascii_level(f"ninja-game level 1\nname: {LONG}\n|@" + "." * 30 + "|"),
}


@pytest.mark.parametrize("kind", LONG_NAMES)
def test_a_name_that_tables_would_repeat_for_ever_is_refused(kind: str) -> None:
    with pytest.raises(FormatError, match=r"1,001 characters"):
        LONG_NAMES[kind]()
