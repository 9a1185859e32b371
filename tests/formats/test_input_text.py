"""Inputs as people write them: comments, blocks, markers, other files; unclaimed replays; other tools' notations."""

import re
import time
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from ninja_game import ReplayError, parse_level, parse_replay, write_replay
from ninja_game.formats.lines import numbered_lines
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.recording import parse_replays, record_of
from ninja_game.formats.replay.input_text import MAX_INCLUDES, read_inputs
from ninja_game.formats.replay.notations import Marker, in_our_notation, write_inputs
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import Replay
from ninja_game.runs.conversion import input_texts
from ninja_game.sim.inputs import with_press_bits
from tests.support import reference
from tests.support.samples import WALK, replay_of_walk, unclaimed_text

LOOSE = unclaimed_text(WALK)
LEVEL = parse_level(WALK)

keyboard_inputs = st.lists(st.integers(0, 7), max_size=80).map(with_press_bits)
names = st.text(st.sampled_from("abcXYZ019_.-é"), min_size=1, max_size=12)


def keys(*lines: str) -> bytes:
    return read_inputs(enumerate(lines, 1), file="a.txt").keys


# --- What the words mean ---


def test_comments_may_stand_anywhere() -> None:
    assert keys("; first", "R*3 ; then", "L;glued", "   ; only") == bytes([2, 2, 2, 1])


def test_blocks_are_repeated_with_a_new_press_in_each_pass() -> None:
    assert keys("(RJ*2 R)*3") == bytes([14, 6, 2] * 3)
    assert keys("( R", "(L .)*2 ) *1".replace(") *1", ")")) == bytes([2, 1, 0, 1, 0])
    assert keys("(RJ*2)*3") == bytes([14, 6, 6, 6, 6, 6]), "the key stays down"
    assert keys("()*9999999 R") == bytes([2])


def test_a_comment_is_a_marker_in_quotation_marks() -> None:
    read = read_inputs([(1, 'R*3 #"wait; (it) is 40% slower, ü" L ; gone')])
    assert read.markers == (Marker(3, "wait; (it) is 40% slower, ü"),)
    assert write_inputs(read.keys, read.markers) == ["R*3", '#"wait; (it) is 40% slower, ü" L']


def test_a_marker_names_the_next_tick_in_the_first_pass_of_a_block() -> None:
    read = read_inputs([(1, "#start R*3 (#turn L)*2 #end")], file="a.txt")
    assert read.markers == (Marker(0, "start"), Marker(3, "turn"), Marker(5, "end"))


@given(st.lists(st.integers(0, 15), max_size=60).map(bytes), st.data())
def test_inputs_with_markers_read_back_equal(inputs: bytes, data: st.DataObject) -> None:
    found = data.draw(st.dictionaries(names, st.integers(0, len(inputs)), max_size=5))
    markers = tuple(sorted(Marker(tick, name) for name, tick in found.items()))
    read = read_inputs(enumerate(write_inputs(inputs, markers), 1))
    assert read.keys == inputs
    assert sorted(read.markers) == list(markers)


@pytest.mark.parametrize(
    "line, message",
    [
        ("R*3 (L", "a.txt:1:5: a block that does not end; found '('; close it"),
        ("R)*3", "a.txt:1:2: the end of a block that has not begun"),
        ("(R)x", "a.txt:1:3: not the end of a block; found ')x'"),
        ("(R)*0", "a.txt:1:3: not the end of a block"),
        ("(((R)*999)*999)*999", "a.txt:1:15: the replay is too long"),
        ("(" * 20 + ")" * 20, "a.txt:1:9: too many blocks in blocks"),
        ("#a R #a", "a.txt:1:6: a marker given twice; found '#a'"),
        ("#", "a.txt:1:1: not a marker"),
        ("#a,b", "a.txt:1:1: not a marker; found '#a,b'"),
        ('#"a b R*3', "a.txt:1:1: not a marker"),
        ('R #""', "a.txt:1:3: not a marker"),
        ("include b.txt", "a.txt:1:1: a text that is in no folder takes in no file"),
    ],
)
def test_mistakes_are_named_with_their_place(line: str, message: str) -> None:
    with pytest.raises(ReplayError, match=re.escape(message)):
        keys(line)


# --- Other files ---


@pytest.fixture
def run(tmp_path: Path) -> Path:
    path = tmp_path / "run.inputs.txt"
    path.write_text(LOOSE + "  R*2\n  include parts/jump.txt ; a part\n  L\n")
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "jump.txt").write_text("; our jump\nRJ*2 .\n")
    return path


def test_a_file_is_taken_in_where_it_is_named(run: Path) -> None:
    (recording,) = load_replays(run)
    assert recording.inputs == bytes([2, 2, 14, 6, 0, 1])


def test_a_file_of_another_tool_is_taken_in_too(run: Path) -> None:
    (run.parent / "parts" / "jump.txt").write_text("   2,R,J\n   1\n")
    assert load_replays(run)[0].replay.inputs == bytes([2, 2, 14, 6, 0, 1])


def test_what_is_wrong_in_a_file_is_named_there(run: Path) -> None:
    part = run.parent / "parts" / "jump.txt"
    part.write_text("R\nrj*2\n")
    with pytest.raises(ReplayError, match=re.escape(f"{part}:2:1: not an input run")):
        load_replays(run)


@pytest.mark.parametrize(
    "name, message",
    [
        ("../other.txt", "a file elsewhere"),
        ("/etc/hostname", "a file elsewhere"),
        ("", "a file elsewhere"),
        ("nothing.txt", "a file that cannot be included"),
        ("parts", "a file that cannot be included"),
        ("run.inputs.txt", "."),
        ("x" * 5000, "a file"),
    ],
)
def test_files_lie_beside_the_text_or_below_it(name: str, message: str, run: Path) -> None:
    run.write_text(LOOSE + f"  include {name}\n" if name else LOOSE + "  include ;\n")
    with pytest.raises(ReplayError, match=message):
        load_replays(run)


def test_files_that_take_in_each_other_end(run: Path) -> None:
    part = run.parent / "parts" / "jump.txt"
    part.write_text("include parts/jump.txt\n")
    with pytest.raises(ReplayError, match="takes in itself"):
        load_replays(run)
    part.write_text("R\n")
    run.write_text(LOOSE + "  include parts/jump.txt\n" * (MAX_INCLUDES + 1))
    with pytest.raises(ReplayError, match="too many files"):
        load_replays(run)


# --- Loose and strict ---


def test_a_loose_replay_needs_a_level_and_inputs_only() -> None:
    (recording,) = parse_replays(LOOSE + "  R*60\n", file="idea.txt")
    assert recording.replay is not None
    assert recording.replay.unclaimed
    assert (recording.name, recording.ticks, recording.body) == ("idea", 60, "circle")
    assert parse_replay(write_replay(recording.replay)) == recording.replay


def test_claims_come_all_or_not_at_all() -> None:
    with pytest.raises(ReplayError, match="an incomplete replay; expected a line with 'rules', 'body'"):
        parse_replay(LOOSE + "  R*60\ngold: 3\n")


def test_a_cut_replay_is_noticed() -> None:
    text = replay_of_walk()
    assert text.endswith("\nend\n")
    for end in range(text.index("inputs:") + 8, len(text) - 4, 7):
        with pytest.raises(ReplayError):
            parse_replay(text[:end])


@given(keyboard_inputs, st.booleans())
def test_loose_replays_read_back_equal(inputs: bytes, box: bool) -> None:
    final_tick = max(0, len(inputs) - 1)
    for last in (final_tick, final_tick + 5):
        replay = Replay(
            inputs, last, "", level=LEVEL, body="box" if box else "circle", name="x", made=Provenance(edits=int(box))
        )
        assert parse_replay(write_replay(replay)) == replay


@pytest.mark.slow
def test_every_reference_recording_comes_back_from_a_text_with_its_frames_and_length() -> None:
    count = 0
    for row in reference.recordings():
        demo = parse_demo(row.demo)
        record = record_of(parse_replays(f"$a#b##{row.data}#{row.demo}#")[0])
        (recording,) = parse_replays(f"$a#b##{record.level}#{row.demo}#")
        (text,) = input_texts([recording], "inputs")
        (back,) = parse_replays(text)
        assert parse_demo(record_of(back).demo) == demo
        assert record_of(back).demo == write_demo(demo)
        assert (back.name, back.author, back.level_author) == ("a", "", "b")
        assert back.replay.playback(back.ticks + 3) == recording.replay.playback(recording.ticks + 3)
        count += 1
    assert count == 1108


def test_a_long_line_takes_no_time() -> None:
    began = time.process_time()
    for line in ("Read,part" + " " * 100_000 + ",x", "include" + " " * 100_000, " " * 100_000 + "x"):
        with pytest.raises(ReplayError):
            read_inputs(in_our_notation(line))
        with pytest.raises(ReplayError):
            read_inputs(numbered_lines(line + "\nx"))
    assert time.process_time() - began < 5.0
