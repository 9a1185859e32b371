"""Our replay texts, `docs/replay-format.md`."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from ninja_game.errors import DemoError, ReplayError
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.formats.replay.notations import write_inputs
from ninja_game.formats.replay.text import Replay, is_replay, parse_replay, write_replay
from ninja_game.sim.level import Level, ObjectSpec
from tests.support.strategies import inputs, replays

LEVEL = parse_level_string("0" * 713 + "|5^60,540!11^708,540,396,540")
REPLAY = Replay(bytes([2, 2, 14, 6, 0]), 9, "exit", 3, name="A walk", level_path="../levels/hill.txt", digest="0f" * 32)
TEXT = """\
ninja-game replay 3
name: A walk
level: ../levels/hill.txt
rules: 1
body: circle
final-tick: 9
outcome: exit
gold: 3
digest: 0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f0f
inputs:
  R*2 RJ*2 .
end
"""


def test_a_replay_is_written_in_one_way() -> None:
    assert write_replay(REPLAY) == TEXT
    assert parse_replay(TEXT) == REPLAY


def test_headers_may_come_in_any_order_with_comments_and_blank_lines() -> None:
    first, *others = TEXT.replace("inputs:\n  R*2 RJ*2 .", "inputs: R*2\n\n;\n  RJ*2\n\t.").splitlines()
    head, body = others[:8], others[8:-1]
    assert parse_replay("\r\n".join(["", "; hello", first, *body, "", *reversed(head), "end"])) == REPLAY


def test_ticks_beyond_the_inputs_have_no_key() -> None:
    assert REPLAY.playback(7) == bytes([2, 2, 14, 6, 0, 0, 0])
    assert REPLAY.playback(1) == b"\2"
    assert REPLAY.ticks == 10


@given(replays())
def test_replays_read_back_equal(replay: Replay) -> None:
    assert parse_replay(write_replay(replay)) == replay


@given(st.floats(), st.floats())
def test_an_embedded_level_keeps_numbers_that_no_level_string_of_n_can_say(x: float, y: float) -> None:
    level = Level(objects=(ObjectSpec(2, (60.0, 60.0, x, y)),))
    read = parse_replay(write_replay(replace(REPLAY, level=level))).level
    assert read
    assert level_digest(read) == level_digest(level)


# --- Inputs ---


@pytest.mark.parametrize(
    "ticks, text",
    [
        ([0] * 5, ".*5"),
        ([1, 2, 3], "L R LR"),
        ([12, 4, 4, 0, 12], "J*3 . J"),  # a fresh press triggers
        ([8 | 6, 5, 4], "RJ LJ J"),  # held on, with other keys
        ([4, 4], "J- J"),
        ([12, 12, 12], "J J!*2"),  # the first one is what the keys say anyway
        ([8, 10], ".! R!"),
        ([4, 12], "J- J!"),
    ],
)
def test_the_trigger_is_written_only_where_the_keys_do_not_tell_it(ticks: list[int], text: str) -> None:
    assert write_inputs(bytes(ticks)) == [text]
    assert read_inputs([(1, text)]).keys == bytes(ticks)


def test_marked_runs_count_for_each_of_their_ticks() -> None:
    assert read_inputs([(1, "RJ!*3 RJ-*2 J*1")]).keys == bytes([14, 14, 14, 6, 6, 4])


def test_long_inputs_are_wrapped() -> None:
    lines = write_inputs(bytes([1, 2] * 200))
    assert max(map(len, lines)) <= 100
    assert read_inputs(enumerate(lines)).keys == bytes([1, 2] * 200)


@given(inputs)
def test_inputs_read_back_equal(ticks: bytes) -> None:
    assert read_inputs(enumerate(write_inputs(ticks))).keys == ticks


def test_a_byte_that_is_not_an_input_is_refused() -> None:
    with pytest.raises(DemoError, match="tick 1 has unknown keys; found 16"):
        write_inputs(b"\x00\x10")


# --- Errors: place, found, expected, hint ---


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("R*2", "r*2", "a.txt:11:3: not an input run; found 'r*2'; expected keys and a count, such as R*30; write R*2"),
        ("RJ*2", "JR*2", "a.txt:11:7: not an input run; found 'JR*2'; ~; write RJ*2"),
        ("RJ*2", "RJ*0", "a.txt:11:7: ~; a count is a whole number from 1"),
        ("RJ*2", "RJ *2", "a.txt:11:10: ~; a count stands next to its keys, without a blank: R*33"),
        ("RJ*2", "X", "a.txt:11:7: ~; L left, R right, J jump, . no key"),
        ("RJ*2", "RJ*", "a.txt:11:7: ~a count is"),
        ("RJ*2", "!", "a.txt:11:7: ~write .!"),
        ("RJ*2", ".*9999999", "a.txt:11:7: the replay is too long; found 10000001 ticks; expected at most 1000000"),
        ("replay 3", "replay 4", "a.txt:1:1: unknown version of the replay format; found 4; expected 3; ~newer"),
        ("end\n", "", "a.txt:11: the replay is truncated; its last line is 'end'"),
        ("ninja-game", "ninja", "a.txt:1:1: not a replay of ninja-game; found 'ninja replay 3'; expected 'ninja-game"),
        ("body: circle", "body: square", "a.txt:5:7: an unknown body; found 'square'; expected circle or box"),
        ("body: circle\n", "", "a.txt:2: an incomplete replay; expected a line with 'body'; ~record"),
        ("body: circle", "bodi: circle", "a.txt:5:1: an unknown header; found 'bodi'; ~; did you mean 'body'?"),
        ("body: circle", "body circle", "a.txt:5:1: not a header line; found 'body circle'; expected key: value"),
        ("body: circle", "body: circle\nbody: box", "a.txt:6:1: a header given twice; found 'body'"),
        ("gold: 3", "gold:   three", "a.txt:8:9: no number in 'gold'; found 'three'; expected a whole number from 0"),
        ("gold: 3", "gold: 03", "a.txt:8:7: no number"),
        ("gold: 3", "  gold: 3", "a.txt:8:1: an indented line; ~indented lines belong below"),
        ("digest: 0f", "digest: 0F", "a.txt:9:9: no digest in 'digest'"),
        ("name: A walk", 'name: "A walk', "a.txt:2:7: a broken text in 'name'~close the double quotes"),
        ("name: A walk", 'name: "A" walk', "a.txt:2:7: a broken text"),
        ("final-tick: 9", "final-tick: 3", "a.txt:6: inputs after the final tick; found 5 ticks of inputs; expected 4"),
        ("final-tick: 9", "final-tick: 1000000", "a.txt:6: the replay is too long"),
        ("level: ../levels/hill.txt\n", "", "a.txt:9: a replay without level"),
    ],
)
def test_mistakes_are_named_with_their_place_and_how_to_mend_them(old: str, new: str, message: str) -> None:
    assert old in TEXT
    with pytest.raises(ReplayError) as caught:
        parse_replay(TEXT.replace(old, new, 1), file="a.txt")
    assert re.match(re.escape(message).replace("\\~", ".*").replace("~", ".*"), str(caught.value)), str(caught.value)


def test_levels_that_are_equal_but_for_the_sign_of_a_zero_are_written_as_they_are() -> None:
    """What is written of a level is kept for the next replay of it, not for one that only equals it."""
    texts = []
    for zero in (0.0, -0.0):
        level = Level(objects=(ObjectSpec(12, (zero, 40.0)),))
        texts += [write_replay(Replay.of_inputs(b"\2", level)), write_replay(Replay.of_inputs(b"\2", level))]
        (record,) = (parse_replay(texts[-1]).level or level).objects
        assert str(record.values[0]) == str(zero)
    assert texts[0] == texts[1] != texts[2] == texts[3]


def test_an_embedded_level_must_have_the_digest_that_is_claimed() -> None:
    text = write_replay(replace(REPLAY, level=LEVEL, level_digest=level_digest(LEVEL)))
    assert parse_replay(text).level == LEVEL
    with pytest.raises(ReplayError, match=r"a\.txt:4: the digest is not that of level-data; .*the level was changed"):
        parse_replay(text.replace("|...", "|#..", 1), file="a.txt")


@pytest.mark.parametrize(
    "changes",
    [{"body": "square"}, {"outcome": ""}, {"gold": -1}, {"final_tick": -1}, {"final_tick": 2}, {"level_path": ""},
     {"rules": 10**9}, {"inputs": b"\xff"}],
)  # fmt: skip
def test_what_contradicts_itself_is_not_written(changes: dict[str, object]) -> None:
    with pytest.raises((ReplayError, DemoError)):
        write_replay(replace(REPLAY, **changes))  # type: ignore[arg-type]


def test_a_replay_that_says_no_level_takes_the_given_one() -> None:
    text = "ninja-game replay 3\ninputs:\n  R*20\n"
    assert parse_replay(text, level=LEVEL).level == LEVEL
    with pytest.raises(ReplayError, match="a replay without level"):
        parse_replay(text)
    assert parse_replay(TEXT, level=LEVEL).level is None


def test_a_replay_is_recognised_by_its_first_words() -> None:
    assert is_replay("\ufeff" + TEXT)
    assert not is_replay("ninja-game level 1")


# --- The page that teaches it ---


def test_the_example_of_the_page_is_a_replay(root: Path) -> None:
    page = (root / "docs" / "replay-format.md").read_text(encoding="utf-8")
    examples = re.findall(r"```text\n(ninja-game replay 3\n.*?)```", page, re.DOTALL)
    assert examples
    for example in examples:
        replay = parse_replay(example)
        assert parse_replay(write_replay(replay)) == replay
        assert len(replay.inputs) == replay.ticks


def test_the_page_names_every_header(root: Path) -> None:
    from ninja_game.formats.replay.headers import REPLAY_KEYS

    page = (root / "docs" / "replay-format.md").read_text(encoding="utf-8")
    assert [key for key in REPLAY_KEYS if f"`{key}`" not in page and f"`{key}:`" not in page] == []


@given(st.text())
def test_any_name_survives(name: str) -> None:
    assert parse_replay(write_replay(replace(REPLAY, name=name))).name == name
