"""The piano roll under the mouse: painting, selecting, scrolling, columns."""

import pygame
import pytest

from ninja_game.formats.replay.notations import Marker
from ninja_game.play.menu_screen import FormPanel, Menu
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.tas.tracks import InputTrack
from tests.support.tas_driver import TasDriver

CTRL, SHIFT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT


def test_a_drag_paints_a_key_and_is_undone_as_one(at: TasDriver) -> None:
    before = at.editor.track
    at.editor.edit(lambda track: track.replaced(10, 30, bytes(20)))
    empty = at.editor.track
    at.drag(at.cell(12, "left"), at.cell(15, "left"), at.cell(20, "left"))
    assert at.keys_down(10, 30) == [0] * 2 + [KEY_LEFT] * 9 + [0] * 9
    assert at.editor.cursor == 0, "the level goes on showing the same tick"
    at.chord("z", CTRL)
    assert at.editor.track == empty
    assert at.editor.cursor == 12, "undo shows where it changes something"
    at.chord("z", CTRL)
    assert at.editor.track == before


def test_a_drag_from_a_key_that_is_down_lifts_it_and_so_does_the_right_button(at: TasDriver) -> None:
    at.editor.edit(lambda track: track.replaced(10, 20, bytes([7] * 10)))
    at.drag(at.cell(10, "jump"), at.cell(12, "jump"))
    at.drag(at.cell(15, "right"), at.cell(13, "right"), button=3)
    lifted = [7 & ~JUMP_HELD] * 3 + [7 & ~KEY_RIGHT] * 3 + [7] * 4
    assert at.keys_down(10, 20) == lifted
    at.drag(at.cell(len(at.editor.track) + 5, "left"), button=3)
    assert len(at.editor.track) == len(at.session.saved), "lifting keys behind the end makes no ticks"


def test_painting_beyond_the_lower_edge_scrolls_on_and_makes_the_run_longer(at: TasDriver) -> None:
    at.editor.edit(lambda track: InputTrack(b""))
    at.frames()
    x, y = at.cell(30, "right")
    lower_edge = at.screen.roll.area[1] + at.screen.roll.area[3]
    for kind, where in ((pygame.MOUSEBUTTONDOWN, y), (pygame.MOUSEMOTION, lower_edge + 60)):
        at.event(kind, x, where, button=1, buttons=(1, 0, 0))
    at.frames(40)
    at.event(pygame.MOUSEBUTTONUP, x, where, button=1)
    length = len(at.editor.track)
    assert length > 100
    assert at.keys_down(0, length) == [0] * 30 + [KEY_RIGHT] * (length - 30)
    at.frames(40)
    assert len(at.editor.track) == length, "it ends with the button"
    at.chord("z", CTRL)
    assert at.editor.track == InputTrack(b"")


def test_clicks_and_drags_select(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    at.mouse(*at.cell(12, "x"))
    assert at.editor.selection == (12, 13)
    at.drag(at.cell(20, "tick"), at.cell(14, "tick"))
    assert at.editor.selection == (14, 21)
    monkeypatch.setattr(pygame.key, "get_mods", lambda: SHIFT)
    at.mouse(*at.cell(30, "tick"))
    assert at.editor.selection == (20, 31)


def test_a_drag_is_no_click_of_a_double_click(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pygame.time, "get_ticks", lambda: 1000)
    at.mouse(*at.cell(9, "tick"))
    at.drag(at.cell(9, "tick"), at.cell(14, "tick"))
    assert (at.top(), at.editor.selection) == (at.screen, (9, 15))
    at.mouse(*at.cell(9, "tick"))
    assert (at.top(), at.editor.selection) == (at.screen, (9, 10)), "its first click was the drag"


def test_a_double_click_on_the_number_names_the_tick(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    for ms in (1000, 1500, 1600):
        assert at.top() is at.screen, "half a second between them: two clicks"
        monkeypatch.setattr(pygame.time, "get_ticks", lambda ms=ms: ms)
        at.mouse(*at.cell(9, "tick"))
    assert isinstance(at.top(), FormPanel)
    at.write("first jump")
    at.press("return")
    assert Marker(9, "first jump") in at.editor.track.markers
    at.press("m")
    at.write("land")
    at.press("return")
    assert at.editor.track.markers[0] == Marker(9, "land"), "what is typed replaces the name before"
    at.press("m", "end")
    at.write("ing")
    at.press("return")
    assert at.editor.track.markers[0] == Marker(9, "landing"), "or is added to it"
    at.press("m", "end")
    at.chord("a", CTRL)
    at.press("backspace", "return")
    assert at.editor.track.markers == ()


def test_the_wheel_scrolls_and_with_ctrl_moves_the_cursor(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    middle = at.cell(20, "x")
    at.wheel(-5, *middle)
    assert (at.screen.roll.top, at.editor.cursor) == (20, 0)
    monkeypatch.setattr(pygame.key, "get_mods", lambda: CTRL)
    at.wheel(-2, *middle)
    assert at.editor.cursor == 2
    assert at.screen.roll.top == 0, "the cursor is in sight again"


def test_the_scroll_bar_leads_anywhere(at: TasDriver) -> None:
    bar = at.screen.roll.layout.bar
    x, y = at.screen.theme.canvas.logical((bar.centerx, bar.bottom - 2))
    at.drag((x, 300), (x, y))
    assert at.screen.roll.top == at.editor.last_tick + 1 - at.screen.roll.layout.rows
    assert at.editor.cursor == 0
    at.frames()
    assert at.app.surface.get_at((bar.centerx, bar.top)) == at.screen.theme.palette.accent
    at.drag((x, 300), (x, 40))
    assert at.screen.roll.top == 0


def test_what_is_under_the_mouse_is_named_in_full(at: TasDriver) -> None:
    at.mouse(*at.cell(20, "x"), click=False)
    x = float(at.session.timeline.column("x")[20])
    assert f"x {x!r}" in at.editor.hint
    at.editor.edit(lambda track: track.replaced(0, 20, bytes(20)))
    at.frames()
    assert f"x {float(at.session.timeline.column('x')[20])!r}" in at.editor.hint, "an edit changes it"
    at.mouse(*at.cell(20, "state"), click=False)
    assert "gold" in at.editor.hint
    at.mouse(100, 100, click=False)
    at.frames()
    assert "gold" not in at.editor.hint, "the mouse has left the roll"


def test_columns_are_hidden_from_their_heads(at: TasDriver) -> None:
    wide = at.cell(0, "events")[0]
    at.mouse(*at.cell(-1, "vx"))
    assert isinstance(at.top(), Menu)
    at.choose("Jump timer, ticks: shown")
    at.choose("Speed downwards, px a tick: shown")
    at.choose("Done")
    assert at.screen.roll.hidden == {"jump_timer", "vy"}
    assert at.cell(0, "events")[0] < wide
