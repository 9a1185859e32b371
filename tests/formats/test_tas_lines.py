"""The notations of other tools, CelesteTAS and libTAS: what we write, and what people's files hold."""

import re
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from ninja_game import ReplayError, parse_level
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.named_level import format_of
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.formats.replay.notations import Marker, in_our_notation, is_tas_text, write_celeste, write_libtas
from ninja_game.sim.inputs import with_press_bits
from tests.support.samples import WALK

LEVEL = parse_level(WALK)

keyboard_inputs = st.lists(st.integers(0, 7), max_size=80).map(with_press_bits)


def read_lines(text: str) -> bytes:
    return read_inputs(in_our_notation(text, "a.tas"), file="a.tas").keys


def test_celeste_lines_are_read() -> None:
    text = "#Start\n# a comment\n***S\n  30,R\n   2,R,J\nRepeat 2\n   1,L\n   1\nEndRepeat\n"
    assert is_tas_text(text)
    read = read_inputs(in_our_notation(text), file="a.tas")
    assert read.keys == bytes([2] * 30 + [14, 6, 1, 0, 1, 0])
    assert read.markers == (Marker(0, "Start"),)


def test_libtas_lines_are_read() -> None:
    text = "|Kff53:ffe1|M0:0:A:.....:0|\n|Kff53|\n|K|\n||\n"
    assert is_tas_text(text)
    assert read_lines(text) == bytes([14, 2, 0, 0])


@given(keyboard_inputs, st.data())
def test_other_notations_read_back_equal(inputs: bytes, data: st.DataObject) -> None:
    ticks = data.draw(st.lists(st.integers(0, max(0, len(inputs) - 1)), max_size=3, unique=True)) if inputs else []
    markers = tuple(Marker(tick, f"m{tick}") for tick in sorted(ticks))
    read = read_inputs(in_our_notation(write_celeste(inputs, markers)))
    assert read == (inputs, markers)
    assert read_lines(write_libtas(inputs)) == inputs


@pytest.mark.parametrize("form", [write_celeste, write_libtas])
def test_a_jump_that_no_keyboard_makes_is_refused(form: object) -> None:
    assert callable(form)
    with pytest.raises(ReplayError, match="no keyboard can make; found tick 1"):
        form(bytes([14, 14]))


@pytest.mark.parametrize(
    "text, message",
    [
        ("   3,X\n", "a.tas:1:1: a key that the ninja has not; found ',X'"),
        ("   3,R,K\n", "a second jump key would press again what is held: write J"),
        ("   3,R\nSet,Player.X,5\n", "a.tas:2:1: not a line of inputs; found 'Set,Player.X,5'"),
        ("   3,R\nPlay,Start\n", "other commands of CelesteTAS have no meaning here: take the line out"),
        ("   3,R\nRead,a.tas,Start,End\n", "a.tas:2:1: a part of another file"),
        ("|K41|\n", "a.tas:1:1: a key that the ninja has not; found '41'"),
        ("   1,R\nEndRepeat\n", "a.tas:2:1: EndRepeat without Repeat; begin with Repeat 4 before it"),
        ("Repeat 3\n   1,R\n", "a.tas:1:1: Repeat without EndRepeat; end what it repeats with EndRepeat"),
    ],
)
def test_what_the_ninja_cannot_do_is_refused(text: str, message: str) -> None:
    with pytest.raises(ReplayError, match=re.escape(message)):
        read_lines(text)


def test_inputs_of_other_tools_need_a_level() -> None:
    text = "  30,R\n"
    with pytest.raises(ReplayError, match="give it with --level"):
        parse_replays(text, file="a.tas")
    (recording,) = parse_replays(text, file="a.tas", level=LEVEL)
    assert recording.replay.playback(31) == bytes([2] * 30 + [0])


def test_celeste_lines_that_begin_with_a_label_are_no_record_of_n() -> None:
    level = parse_level_string(WALK)
    for text in ("#start\n  30,R,J\n", "# a comment\n#start\n\n  30,R\n#end\n   1,J", "##\n30\n"):
        (recording,) = parse_replays(text, level=level)
        assert len(recording.replay.inputs) >= 30
    for demo in ("##3:801#", "##902:35791394|\n35791394#"):
        assert format_of(demo) == "file"


CELESTE = """\ufeffconsole load 1
Unsafe
Author: somebody
FrameCount: 0

#Start
# a comment
***
   1

#Start
***S10
  02, r , j   # over the wall
 Repeat, 2
   1,LR,
\t1
   0,R
EndRepeat
#1:23.456 (last room)
####
Read,rest
ChapterTime: 0:00.085(5)
"""


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_a_file_of_celestetas_with_all_that_may_stand_in_it(end: str, tmp_path: Path) -> None:
    (tmp_path / "rest.tas").write_text("  3,J\n", "utf-8")
    path = tmp_path / "a.tas"
    path.write_bytes(CELESTE.replace("\n", end).encode())
    (recording,) = load_replays(path, level=LEVEL)
    assert recording.replay.inputs == with_press_bits([0, 6, 6, 3, 0, 3, 0, 4, 4, 4])
    assert recording.replay is not None
    assert recording.replay.markers == (Marker(0, "Start"), Marker(1, "Start-2"), Marker(7, "1-23.456-last-room"))


LIBTAS = """\ufeff|K0000FF53:ffe1|M-1:12:R:1....:0|C10:0:0:0:0:0:...............|F.|T60:1|
 |Kff53|M0:0:A:.....:0

|Kff51:7a:20
|
|K|M0:0:A:.....:0|
||
"""


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_of_libtas_with_other_devices(end: str) -> None:
    assert is_tas_text(LIBTAS)
    assert read_lines(LIBTAS.replace("\n", end)) == with_press_bits([6, 2, 5, 0, 0, 0])
    assert read_lines("|ff53:ffe1|0:0:.....|\n||0:0:.....|\n") == bytes([14, 0]), "without letters, as older movies"
    with pytest.raises(ReplayError, match="a key that the ninja has not; found 'ff52'"):
        read_lines("|ff52|")


def test_long_lines_of_celestetas_are_split() -> None:
    text = write_celeste(bytes([2] * 20_000))
    assert text == "9999,R\n9999,R\n   2,R\n"
    assert read_lines(text) == bytes([2] * 20_000)
    assert write_celeste(with_press_bits([4] * 10_001)) == "9999,J\n   2,J\n"


def test_labels_that_come_again_get_numbers() -> None:
    read = read_inputs(in_our_notation("#a\n#a-2\n#a\n1\n#a\n#a 3\n" + "#b\n" * 20_000 + "1\n"))
    assert [name for _, name in read.markers[:5]] == ["a", "a-2", "a-3", "a-4", "a-3-2"]
    assert len(read.markers) == 20_005


LINES = [*CELESTE.splitlines(), *LIBTAS.splitlines(), "(", "#\t", "#(", "0", "EndRepeat", "Repeat 3", ";", "R*3"]


@given(st.lists(st.sampled_from(LINES)).map("\n".join))
def test_odd_mixtures_give_inputs_or_an_error_with_its_line(text: str) -> None:
    try:
        names = [name for _, name in read_inputs(in_our_notation(text, "a.tas"), file="a.tas").markers]
    except ReplayError as error:
        names = []
        place = error.line
    else:
        place = 1
    assert len(set(names)) == len(names)
    assert place > 0
