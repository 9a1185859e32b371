"""The piano roll by keys: moving, changing ticks, markers, the clipboard."""

import pygame
import pytest

from ninja_game.formats.replay.notations import Marker
from ninja_game.tas.tracks import InputTrack
from ninja_game.ui.input.keys import SCANCODES
from tests.support.tas_driver import TasDriver

CTRL, SHIFT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT


@pytest.fixture(name="clipboard")
def clipboard_of_the_tests(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    texts: list[str] = [""]
    monkeypatch.setattr(pygame.scrap, "put_text", lambda text: texts.__setitem__(0, text))
    monkeypatch.setattr(pygame.scrap, "get_text", lambda: texts[0])
    return texts


def test_keys_move_and_select(at: TasDriver) -> None:
    rows, editor = at.screen.roll.layout.rows, at.editor
    at.press("down", "down", "up")
    assert editor.selection == (1, 2)
    at.chord("down", SHIFT)
    at.chord("pagedown", SHIFT)
    assert editor.selection == (1, rows + 2)
    at.press("pageup", "pageup")
    assert editor.selection == (0, 1)
    at.press("end")
    assert editor.cursor == at.session.timeline.end[0]
    at.press("end")
    assert editor.cursor == editor.last_tick
    assert at.screen.roll.top == editor.last_tick + 1 - rows
    at.press("home")
    assert at.screen.roll.top == editor.cursor == 0
    last = max(len(editor.track) - 1, at.session.timeline.end[0])
    for _ in range(2):
        at.chord("end", SHIFT)
        assert editor.selection == (0, last + 1), "not beyond the run, again and again"
    at.chord("a", CTRL)
    assert editor.selection == (0, len(editor.track))


def test_a_key_that_is_held_goes_on(at: TasDriver) -> None:
    event = {"key": 0, "scancode": SCANCODES["down"], "mod": 0, "unicode": ""}
    pygame.event.post(pygame.Event(pygame.KEYDOWN, event))
    at.frames(10)
    assert at.editor.cursor == 1
    at.frames(30)
    assert 25 <= at.editor.cursor <= 33, "a tick in 25 ms"
    pygame.event.post(pygame.Event(pygame.KEYUP, event))
    at.frames(1)
    stopped = at.editor.cursor
    at.frames(30)
    assert at.editor.cursor == stopped


def test_rows_scroll_with_the_cursor_before_it_reaches_the_edge(at: TasDriver) -> None:
    roll, editor = at.screen.roll, at.editor
    rows = roll.layout.rows
    at.mouse(*at.cell(rows - 2, "x"))
    assert roll.top == 0, "no row moves under the mouse"
    at.press("down", "down", "down")
    assert roll.top == 3, "what is near the edge stays as near"
    at.press("up", "up")
    assert roll.top == 3
    editor.go(200)
    at.frames()
    assert roll.top == 200 - rows // 2, "far away: into the middle"
    for _ in range(rows):
        at.press("down")
    assert editor.cursor - roll.top == rows - 1 - rows // 4, "a quarter of them stays below it"
    editor.go(0)
    at.frames()
    assert roll.top == 0


def test_keys_of_the_game_go_down_and_up_in_the_selected_ticks(at: TasDriver) -> None:
    at.editor.edit(lambda track: track.replaced(10, 20, bytes([0, 1] * 5)))
    at.editor.select(10, 20)
    at.press("left")
    assert at.keys_down(10, 20) == [1] * 10
    at.press("z")
    assert at.keys_down(10, 20) == [5] * 10
    at.press("left")
    assert at.keys_down(10, 20) == [4] * 10
    at.press("delete")
    assert at.keys_down(10, 20) == [0] * 10
    assert at.editor.selection == (10, 20)


def test_ticks_are_put_in_and_taken_out(at: TasDriver) -> None:
    before = at.editor.track
    at.editor.select(10, 13)
    at.press("insert")
    assert len(at.editor.track) == len(before) + 3
    assert at.keys_down(10, 13) == [0, 0, 0]
    at.press("backspace")
    assert at.editor.track == before
    assert at.editor.selection == (10, 11)
    at.editor.go(len(before) + 3)
    at.press("backspace")
    assert at.editor.track == before, "there is nothing to take out behind the end"
    assert "the run ends earlier" in at.app.notice


def test_what_is_behind_the_end_is_cut(at: TasDriver) -> None:
    end = at.session.timeline.end[0]
    at.editor.edit(lambda track: track.replaced(len(track), len(track), bytes([1] * 30)))
    at.chord("e", CTRL)
    assert len(at.editor.track) == end + 1
    assert at.session.timeline.end[0] == end
    at.editor.edit(lambda track: InputTrack(b""))
    at.chord("e", CTRL)
    assert "nothing behind" in at.app.notice


def test_markers_are_named_found_and_dropped(at: TasDriver) -> None:
    at.editor.go(15)
    at.press("m")
    at.write("corner")
    at.press("return")
    at.editor.edit(lambda track: track.named(40, "door"))
    at.press("n")
    assert at.editor.cursor == 40
    at.chord("n", SHIFT)
    assert at.editor.cursor == 15
    for text, tick in (("#Door", 40), ("7", 7), ("999999999999", at.editor.last_tick)):
        at.chord("g", CTRL)
        at.write(text)
        at.press("return")
        assert at.editor.cursor == tick
    at.screen.roll.edits.go_to("nowhere")
    assert "nowhere" in at.app.notice
    at.screen.roll.edits.put_name(15, "door")
    assert at.editor.track.markers == (Marker(15, "door"),)
    assert "moved here from tick 40" in at.app.notice
    at.chord("z", CTRL)
    at.screen.roll.edits.put_name(15, "a\tb")
    assert "not a marker" in at.app.notice
    at.screen.roll.edits.put_name(15, "")
    assert at.editor.track.markers == (Marker(40, "door"),)
    at.chord("z", CTRL)
    assert at.editor.cursor == 15, "undo shows the name that comes back"
    at.editor.edit(lambda track: track.named(30, "the 'way'"))
    at.screen.roll.edits.put_name(15, 'the "way"')
    assert "moved here from tick 30" in at.app.notice, "quotes are written as others"


def test_ticks_travel_as_text(at: TasDriver, clipboard: list[str]) -> None:
    at.editor.edit(lambda track: track.replaced(10, 16, bytes([2, 2, 2, 6, 6, 0])).named(13, "corner"))
    before = at.editor.track
    at.editor.select(10, 16)
    at.chord("c", CTRL)
    assert clipboard == ["R*3\n#corner RJ*2 ."]
    assert at.app.notice == "6 ticks copied"
    at.chord("x", CTRL)
    assert len(at.editor.track) == len(before) - 6
    at.chord("v", CTRL, SHIFT)
    assert at.editor.track == before, "name included"
    at.editor.go(30)
    at.chord("v", CTRL)
    assert len(at.editor.track) == len(before)
    assert at.keys_down(30, 36) == [2, 2, 2, 6, 6, 0]
    assert at.editor.selection == (30, 36)
    assert at.editor.track.markers == before.markers, "a name stays where it is"


@pytest.mark.parametrize(
    "text, made", [("(R J)*2 ; twice", [2, 4, 2, 4]), ("   3,R,J", [6, 6, 6]), ("\r\nL*2\r\n", [1, 1])]
)
def test_text_from_elsewhere_is_pasted(at: TasDriver, clipboard: list[str], text: str, made: list[int]) -> None:
    clipboard[0] = text
    at.editor.go(5)
    at.chord("v", CTRL, SHIFT)
    assert at.keys_down(5, 5 + len(made)) == made


def test_a_whole_replay_is_pasted(at: TasDriver, clipboard: list[str]) -> None:
    path = at.session.file.path
    assert path is not None
    clipboard[0] = path.read_text()
    saved = at.editor.track
    at.editor.edit(lambda track: InputTrack(b""))
    at.chord("v", CTRL)
    assert [key & 7 for key in at.editor.track.inputs] == [key & 7 for key in saved.inputs]


@pytest.mark.parametrize(
    "text, problem",
    [
        ("R*3\nRJ*2 Q*4", "clipboard:2:6: not an input run"),
        ("", "no text"),
        ("; nothing", "no inputs"),
        ("(R", "block"),
    ],
)
def test_broken_text_is_refused_in_words(at: TasDriver, clipboard: list[str], text: str, problem: str) -> None:
    clipboard[0] = text
    before = at.editor.track
    at.chord("v", CTRL)
    assert problem in at.app.notice
    assert at.editor.track == before


def test_undo_tells_the_tick_where_ticks_came_in_though_those_behind_are_the_same(at: TasDriver) -> None:
    at.session.change(InputTrack(bytes(14) + bytes([2] * 6)))
    at.editor.select(6, 9)
    at.screen.run("insert")
    at.screen.run("undo")
    assert at.app.notice == "Undone: keys from tick 6 on, 3 ticks fewer"
    at.screen.run("redo")
    assert at.app.notice == "Redone: keys from tick 6 on, 3 ticks more"


def test_a_selection_of_a_line_is_extended_from_its_first_tick_down_and_its_last_up(at: TasDriver) -> None:
    at.editor.select(10, 16)
    for _ in range(30):
        at.chord("down", pygame.KMOD_LSHIFT)
    assert at.editor.selection == (10, 41)
    at.editor.select(10, 16)
    at.chord("up", pygame.KMOD_LSHIFT)
    assert at.editor.selection == (9, 16)
    at.chord("down", pygame.KMOD_LSHIFT)
    assert at.editor.selection == (10, 16), "the way back"


def test_undo_says_what_it_undid(at: TasDriver) -> None:
    at.editor.edit(lambda track: track.replaced(40, 40, [7] * 3))
    at.screen.run("undo")
    assert at.app.notice == "Undone: keys from tick 40 on, 3 ticks fewer"
    at.screen.run("redo")
    assert at.app.notice == "Redone: keys from tick 40 on, 3 ticks more"
    at.editor.edit(lambda track: track.named(30, "here"))
    at.screen.run("undo")
    assert at.app.notice == "Undone: a marker in tick 30"
