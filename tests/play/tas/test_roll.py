"""The piano roll: painting, selecting, moving, changing ticks, markers, the clipboard."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pygame
import pytest

from ninja_game.formats.replay.input_runs import Marker
from ninja_game.play.editor.panels import Form, Menu
from ninja_game.play.input.scancodes import SCANCODES
from ninja_game.play.tas.roll.columns import AREA, COLUMNS, layout_of
from ninja_game.play.tas.roll.facts import changed_ticks, in_words, row_facts
from ninja_game.play.tas.roll.rows import RowSheet
from ninja_game.play.ui.canvas import Canvas
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.tas.take import Take
from tests.support.bench_driver import BenchDriver

CTRL, SHIFT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT


@pytest.fixture(name="clipboard")
def clipboard_of_the_tests(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    texts: list[str] = [""]
    monkeypatch.setattr(pygame.scrap, "put_text", lambda text: texts.__setitem__(0, text))
    monkeypatch.setattr(pygame.scrap, "get_text", lambda: texts[0])
    return texts


def keys(at: BenchDriver, first: int, last: int) -> list[int]:
    return [at.bench.take.keys_at(tick) for tick in range(first, last)]


def wheel(at: BenchDriver, notches: int) -> None:
    pygame.event.post(pygame.Event(pygame.MOUSEWHEEL, x=0, y=notches, flipped=False))
    at.frames()


# --- the mouse ---


def test_a_drag_paints_a_key_and_is_undone_as_one(at: BenchDriver) -> None:
    before = at.bench.take
    at.bench.edit(lambda take: take.replaced(10, 30, bytes(20)))
    empty = at.bench.take
    at.drag(at.cell(12, "left"), at.cell(15, "left"), at.cell(20, "left"))
    assert keys(at, 10, 30) == [0] * 2 + [KEY_LEFT] * 9 + [0] * 9
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
    assert keys(at, 10, 20) == lifted
    at.drag(at.cell(len(at.bench.take) + 5, "left"), button=3)
    assert len(at.bench.take) == len(at.session.saved), "lifting keys behind the end makes no ticks"


def test_painting_beyond_the_lower_edge_scrolls_on_and_makes_the_run_longer(at: BenchDriver) -> None:
    at.bench.edit(lambda take: Take(b""))
    at.frames()
    x, y = at.cell(30, "right")
    for kind, where in ((pygame.MOUSEBUTTONDOWN, y), (pygame.MOUSEMOTION, AREA[1] + AREA[3] + 60)):
        at.event(kind, x, where, button=1, buttons=(1, 0, 0))
    at.frames(40)
    at.event(pygame.MOUSEBUTTONUP, x, where, button=1)
    length = len(at.bench.take)
    assert length > 100
    assert keys(at, 0, length) == [0] * 30 + [KEY_RIGHT] * (length - 30)
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


def test_a_double_click_on_the_number_names_the_tick(at: BenchDriver) -> None:
    at.mouse(*at.cell(9, "tick"))
    at.mouse(*at.cell(9, "tick"))
    assert isinstance(at.top(), Form)
    at.write("first jump")
    at.press("return")
    assert Marker(9, "first-jump") in at.bench.take.markers


def test_the_wheel_scrolls_and_with_ctrl_moves_the_cursor(at: BenchDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    middle = at.app.canvas.point(*at.cell(20, "x"))
    monkeypatch.setattr(pygame.mouse, "get_pos", lambda: middle)
    wheel(at, -5)
    assert (at.screen.roll.top, at.bench.cursor) == (20, 0)
    monkeypatch.setattr(pygame.key, "get_mods", lambda: CTRL)
    wheel(at, -2)
    assert at.bench.cursor == 2
    assert at.screen.roll.top == 0, "the cursor is in sight again"


def test_the_scroll_bar_leads_anywhere(at: BenchDriver) -> None:
    bar = at.screen.roll.layout.bar
    x, y = at.app.canvas.logical((bar.centerx, bar.bottom - 2))
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
    assert at.bench.hint == ""


def test_columns_are_hidden_from_their_heads(at: BenchDriver) -> None:
    wide = at.cell(0, "events")[0]
    at.mouse(*at.cell(-1, "vx"))
    assert isinstance(at.top(), Menu)
    at.choose("Jump timer, ticks: shown")
    at.choose("Speed downwards, px a tick: shown")
    at.choose("Done")
    assert at.screen.roll.hidden == {"jump_timer", "vy"}
    assert at.cell(0, "events")[0] < wide


# --- keys ---


def test_keys_move_and_select(at: BenchDriver) -> None:
    rows, bench = at.screen.roll.layout.rows, at.bench
    at.press("down", "down", "up")
    assert bench.selection == (1, 2)
    at.chord("down", SHIFT)
    at.chord("pagedown", SHIFT)
    assert bench.selection == (1, rows + 2)
    at.press("pageup", "pageup")
    assert bench.selection == (0, 1)
    at.press("end")
    assert bench.cursor == at.session.timeline.end[0]
    at.press("end")
    assert bench.cursor == bench.last_tick
    assert at.screen.roll.top == bench.last_tick + 1 - rows
    at.press("home")
    assert at.screen.roll.top == bench.cursor == 0
    at.chord("a", CTRL)
    assert bench.selection == (0, len(bench.take))


def test_a_key_that_is_held_goes_on(at: BenchDriver) -> None:
    event = {"key": 0, "scancode": SCANCODES["down"], "mod": 0, "unicode": ""}
    pygame.event.post(pygame.Event(pygame.KEYDOWN, event))
    at.frames(10)
    assert at.bench.cursor == 1
    at.frames(30)
    assert 25 <= at.bench.cursor <= 33, "a tick in 25 ms"
    pygame.event.post(pygame.Event(pygame.KEYUP, event))
    at.frames(1)
    stopped = at.bench.cursor
    at.frames(30)
    assert at.bench.cursor == stopped


def test_keys_of_the_game_go_down_and_up_in_the_selected_ticks(at: BenchDriver) -> None:
    at.bench.edit(lambda take: take.replaced(10, 20, bytes([0, 1] * 5)))
    at.bench.select(10, 20)
    at.press("left")
    assert keys(at, 10, 20) == [1] * 10
    at.press("z")
    assert keys(at, 10, 20) == [5] * 10
    at.press("left")
    assert keys(at, 10, 20) == [4] * 10
    at.press("delete")
    assert keys(at, 10, 20) == [0] * 10
    assert at.bench.selection == (10, 20)


def test_ticks_are_put_in_and_taken_out(at: BenchDriver) -> None:
    before = at.bench.take
    at.bench.select(10, 13)
    at.press("insert")
    assert len(at.bench.take) == len(before) + 3
    assert keys(at, 10, 13) == [0, 0, 0]
    at.press("backspace")
    assert at.bench.take == before
    assert at.bench.selection == (10, 11)
    at.bench.go(len(before) + 3)
    at.press("backspace")
    assert at.bench.take == before, "there is nothing to take out behind the end"


def test_what_is_behind_the_end_is_cut(at: BenchDriver) -> None:
    end = at.session.timeline.end[0]
    at.bench.edit(lambda take: take.replaced(len(take), len(take), bytes([1] * 30)))
    at.chord("e", CTRL)
    assert len(at.bench.take) == end + 1
    assert at.session.timeline.end[0] == end
    at.bench.edit(lambda take: Take(b""))
    at.chord("e", CTRL)
    assert "nothing behind" in at.app.notice


# --- markers ---


def test_markers_are_named_found_and_dropped(at: BenchDriver) -> None:
    at.bench.go(15)
    at.press("m")
    at.write("corner")
    at.press("return")
    at.bench.edit(lambda take: take.named(40, "door"))
    at.press("n")
    assert at.bench.cursor == 40
    at.chord("n", SHIFT)
    assert at.bench.cursor == 15
    for text, tick in (("#Door", 40), ("7", 7), ("999999999999", at.bench.last_tick)):
        at.chord("g", CTRL)
        at.write(text)
        at.press("return")
        assert at.bench.cursor == tick
    at.screen.roll.edits.go_to("nowhere")
    assert "nowhere" in at.app.notice
    at.screen.roll.edits._name(15, "a;b")
    assert "not a marker" in at.app.notice
    at.screen.roll.edits._name(15, "")
    assert at.bench.take.markers == (Marker(40, "door"),)
    at.chord("z", CTRL)
    assert at.bench.cursor == 15, "undo shows the name that comes back"


# --- clipboard ---


def test_ticks_travel_as_text(at: BenchDriver, clipboard: list[str]) -> None:
    at.bench.edit(lambda take: take.replaced(10, 16, bytes([2, 2, 2, 6, 6, 0])).named(13, "corner"))
    before = at.bench.take
    at.bench.select(10, 16)
    at.chord("c", CTRL)
    assert clipboard == ["R*3\n#corner RJ*2 ."]
    at.chord("x", CTRL)
    assert len(at.bench.take) == len(before) - 6
    at.chord("v", CTRL, SHIFT)
    assert at.bench.take == before, "name included"
    at.bench.go(30)
    at.chord("v", CTRL)
    assert len(at.bench.take) == len(before)
    assert keys(at, 30, 36) == [2, 2, 2, 6, 6, 0]
    assert at.bench.selection == (30, 36)
    assert at.bench.take.markers == before.markers, "a name stays where it is"


@pytest.mark.parametrize(
    "text, made",
    [("(R J)*2 ; twice", [2, 4, 2, 4]), ("   3,R,J", [6, 6, 6]), ("\r\nL*2\r\n", [1, 1])],
)
def test_text_from_elsewhere_is_pasted(at: BenchDriver, clipboard: list[str], text: str, made: list[int]) -> None:
    clipboard[0] = text
    at.bench.go(5)
    at.chord("v", CTRL, SHIFT)
    assert keys(at, 5, 5 + len(made)) == made


def test_a_whole_replay_is_pasted(at: BenchDriver, clipboard: list[str]) -> None:
    path = at.session.file.path
    assert path is not None
    clipboard[0] = path.read_text()
    saved = at.bench.take
    at.bench.edit(lambda take: Take(b""))
    at.chord("v", CTRL)
    assert [key & 7 for key in at.bench.take.inputs] == [key & 7 for key in saved.inputs]


@pytest.mark.parametrize(
    "text, told",
    [
        ("R*3\nRJ*2 Q*4", "clipboard:2:6: not an input run"),
        ("", "no text"),
        ("; nothing", "no inputs"),
        ("(R", "block"),
    ],
)
def test_broken_text_is_refused_in_words(at: BenchDriver, clipboard: list[str], text: str, told: str) -> None:
    clipboard[0] = text
    before = at.bench.take
    at.chord("v", CTRL)
    assert told in at.app.notice
    assert at.bench.take == before


# --- odd runs ---


def test_runs_of_no_tick_and_of_one(at: BenchDriver) -> None:
    at.bench.edit(lambda take: Take(b""))
    at.press("end", "end", "down", "home", "delete", "backspace", "m", "escape", "n")
    at.chord("c", CTRL)
    at.chord("a", CTRL)
    assert at.bench.selection == (0, 1)
    at.press("d")
    assert at.bench.take.inputs == bytes([KEY_RIGHT])
    at.press("end", "backspace", "home", "backspace")
    assert at.bench.take == Take(b"")


def test_a_very_long_run_scrolls_by_drawing_new_rows_only(at: BenchDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    at.bench.edit(lambda take: Take(bytes([1, 2] * 50_000)))
    at.session.timeline.work(200_000)
    at.bench.go(70_000)
    at.frames()
    drawn: list[int] = []
    draw = RowSheet.draw
    monkeypatch.setattr(RowSheet, "draw", lambda *args: drawn.append(draw(*args)))
    roll = at.screen.roll
    top = roll.top
    for step in (4, 4, -4):
        roll.scroll(roll.top + step)
        at.frames()
    assert roll.top == top + 4
    at.press("down")
    at.bench.edit(lambda take: take.named(70_003, "here"))
    at.frames()
    assert drawn == [4, 4, 4, 2, 1]
    at.press("end", "end")
    assert roll.top == at.bench.last_tick + 1 - roll.layout.rows


# --- what rows say ---


def test_rows_that_differ_from_the_saved_ones_are_marked(at: BenchDriver) -> None:
    at.bench.edit(lambda take: take.with_key(20, 22, KEY_LEFT, down=not take.keys_at(20) & KEY_LEFT))
    marked = [row.tick for row in row_facts(at.bench, 0, 60) if row.changed]
    assert 20 in marked
    assert set(marked) <= {20, 21}
    taken = Take(bytes([1, 2, 1, 2, 2]))
    assert changed_ticks(taken, Take(bytes([1, 2, 2]))) == range(2, 4)
    assert changed_ticks(taken, taken) == bytes(5)


def test_rows_know_what_is_simulated_and_where_the_run_ends(at: BenchDriver) -> None:
    timeline = at.session.timeline
    end, count = timeline.end[0], len(at.bench.take)
    rows = row_facts(at.bench, 0, len(timeline))
    assert [row.tick for row in rows if row.over] == list(range(end + 1, len(timeline)))
    assert [row.tick for row in rows if row.beyond] == list(range(count, len(timeline)))
    row = rows[end - 5]
    assert row.values is not None
    assert row.values.vx == float(timeline.column("x")[end - 5] - timeline.column("prev_x")[end - 5])
    timeline.valid = 30
    rows = row_facts(at.bench, 25, 35)
    assert [row.values is None for row in rows] == [False] * 5 + [True] * 5
    assert "not simulated" in in_words(rows[-1], numbers=True)


@pytest.mark.parametrize("size", [(792, 600), (1188, 900), (1584, 1200), (1000, 1000), (3000, 700), (200, 150)])
def test_columns_lie_side_by_side_in_any_window(size: tuple[int, int]) -> None:
    layout = layout_of(Canvas(size), ())
    assert [place.column.name for place in layout.places] == [column.name for column in COLUMNS]
    edges = np.array([[place.left, place.left + place.width] for place in layout.places])
    assert (edges[1:, 0] == edges[:-1, 1]).all()
    assert edges[0, 0] == layout.body.left
    assert edges[-1, 1] <= layout.body.right
    assert (edges[:, 1] > edges[:, 0]).all()
    assert layout.rows >= 20


def test_the_picture_of_rows_is_the_same_however_one_got_there(at: BenchDriver, tmp_path: Path) -> None:
    """Rows that are kept while scrolling look as rows that are drawn at once."""
    roll, area = at.screen.roll, at.app.canvas.rect(*AREA)
    for tick in (30, 90, 70, 75, 200, 60):
        at.bench.go(tick)
        at.frames()
    scrolled = at.app.surface.subsurface(area).copy()
    roll._sheet = None
    at.app.stack.redraw_all()
    at.frames()
    assert pygame.image.tobytes(scrolled, "RGB") == pygame.image.tobytes(at.app.surface.subsurface(area), "RGB")
