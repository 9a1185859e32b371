"""The piano roll under the mouse: painting, selecting, scrolling, columns."""

from __future__ import annotations

import pygame
import pytest

from ninja_game.formats.replay.input_runs import Marker
from ninja_game.play.menus.panels import Form, Menu
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.tas.take import Take
from tests.support.bench_driver import BenchDriver

CTRL, SHIFT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT


def wheel(at: BenchDriver, notches: int) -> None:
    pygame.event.post(pygame.Event(pygame.MOUSEWHEEL, x=0, y=notches, flipped=False))
    at.frames()


def test_a_drag_paints_a_key_and_is_undone_as_one(at: BenchDriver) -> None:
    before = at.bench.take
    at.bench.edit(lambda take: take.replaced(10, 30, bytes(20)))
    empty = at.bench.take
    at.drag(at.cell(12, "left"), at.cell(15, "left"), at.cell(20, "left"))
    assert at.keys_down(10, 30) == [0] * 2 + [KEY_LEFT] * 9 + [0] * 9
    assert at.bench.cursor == 0, "the level goes on showing the same tick"
    at.chord("z", CTRL)
    assert at.bench.take == empty
    assert at.bench.cursor == 12, "undo shows where it changes something"
    at.chord("z", CTRL)
    assert at.bench.take == before


def test_a_drag_from_a_key_that_is_down_lifts_it_and_so_does_the_right_button(at: BenchDriver) -> None:
    at.bench.edit(lambda take: take.replaced(10, 20, bytes([7] * 10)))
    at.drag(at.cell(10, "jump"), at.cell(12, "jump"))
    at.drag(at.cell(15, "right"), at.cell(13, "right"), button=3)
    lifted = [7 & ~JUMP_HELD] * 3 + [7 & ~KEY_RIGHT] * 3 + [7] * 4
    assert at.keys_down(10, 20) == lifted
    at.drag(at.cell(len(at.bench.take) + 5, "left"), button=3)
    assert len(at.bench.take) == len(at.session.saved), "lifting keys behind the end makes no ticks"


def test_painting_beyond_the_lower_edge_scrolls_on_and_makes_the_run_longer(at: BenchDriver) -> None:
    at.bench.edit(lambda take: Take(b""))
    at.frames()
    x, y = at.cell(30, "right")
    lower_edge = at.screen.roll.area[1] + at.screen.roll.area[3]
    for kind, where in ((pygame.MOUSEBUTTONDOWN, y), (pygame.MOUSEMOTION, lower_edge + 60)):
        at.event(kind, x, where, button=1, buttons=(1, 0, 0))
    at.frames(40)
    at.event(pygame.MOUSEBUTTONUP, x, where, button=1)
    length = len(at.bench.take)
    assert length > 100
    assert at.keys_down(0, length) == [0] * 30 + [KEY_RIGHT] * (length - 30)
    at.frames(40)
    assert len(at.bench.take) == length, "it ends with the button"
    at.chord("z", CTRL)
    assert at.bench.take == Take(b"")


def test_clicks_and_drags_select(at: BenchDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    at.mouse(*at.cell(12, "x"))
    assert at.bench.selection == (12, 13)
    at.drag(at.cell(20, "tick"), at.cell(14, "tick"))
    assert at.bench.selection == (14, 21)
    monkeypatch.setattr(pygame.key, "get_mods", lambda: SHIFT)
    at.mouse(*at.cell(30, "tick"))
    assert at.bench.selection == (20, 31)


def test_a_double_click_on_the_number_names_the_tick(at: BenchDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    for ms in (1000, 1500, 1600):
        assert at.top() is at.screen, "half a second between them: two clicks"
        monkeypatch.setattr(pygame.time, "get_ticks", lambda ms=ms: ms)
        at.mouse(*at.cell(9, "tick"))
    assert isinstance(at.top(), Form)
    at.write("first jump")
    at.press("return")
    assert Marker(9, "first-jump") in at.bench.take.markers
    assert "called first-jump" in at.app.notice
    at.press("m")
    at.write("land")
    at.press("return")
    assert at.bench.take.markers[0] == Marker(9, "land"), "what is typed replaces the name before"
    at.press("m", "end")
    at.write("ing")
    at.press("return")
    assert at.bench.take.markers[0] == Marker(9, "landing"), "or is added to it"
    at.press("m", "end")
    at.chord("a", CTRL)
    at.press("backspace", "return")
    assert at.bench.take.markers == ()


def test_the_wheel_scrolls_and_with_ctrl_moves_the_cursor(at: BenchDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    middle = at.screen.theme.canvas.point(*at.cell(20, "x"))
    monkeypatch.setattr(pygame.mouse, "get_pos", lambda: middle)
    wheel(at, -5)
    assert (at.screen.roll.top, at.bench.cursor) == (20, 0)
    monkeypatch.setattr(pygame.key, "get_mods", lambda: CTRL)
    wheel(at, -2)
    assert at.bench.cursor == 2
    assert at.screen.roll.top == 0, "the cursor is in sight again"


def test_the_scroll_bar_leads_anywhere(at: BenchDriver) -> None:
    bar = at.screen.roll.layout.bar
    x, y = at.screen.theme.canvas.logical((bar.centerx, bar.bottom - 2))
    at.drag((x, 300), (x, y))
    assert at.screen.roll.top == at.bench.last_tick + 1 - at.screen.roll.layout.rows
    assert at.bench.cursor == 0
    at.drag((x, 300), (x, 40))
    assert at.screen.roll.top == 0


def test_what_is_under_the_mouse_is_told_in_full(at: BenchDriver) -> None:
    at.mouse(*at.cell(20, "x"), click=False)
    x = float(at.session.timeline.column("x")[20])
    assert f"x {x!r}" in at.bench.hint
    at.bench.edit(lambda take: take.replaced(0, 20, bytes(20)))
    at.frames()
    assert f"x {float(at.session.timeline.column('x')[20])!r}" in at.bench.hint, "an edit changes it"
    at.mouse(*at.cell(20, "state"), click=False)
    assert "gold" in at.bench.hint
    at.mouse(100, 100, click=False)
    assert "gold" not in at.bench.hint


def test_columns_are_hidden_from_their_heads(at: BenchDriver) -> None:
    wide = at.cell(0, "events")[0]
    at.mouse(*at.cell(-1, "vx"))
    assert isinstance(at.top(), Menu)
    at.choose("Jump timer, ticks: shown")
    at.choose("Speed downwards, px a tick: shown")
    at.choose("Done")
    assert at.screen.roll.hidden == {"jump_timer", "vy"}
    assert at.cell(0, "events")[0] < wide
