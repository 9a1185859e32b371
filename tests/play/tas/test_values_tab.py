"""The tab of watched values: formulas, their values at the cursor, their plots."""

from pathlib import Path
from time import thread_time

import numpy as np
import pygame
import pytest

from ninja_game.play.menu_screen import FormPanel
from ninja_game.sim.inputs import Input
from ninja_game.simulation import Simulation
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.tabs.values_tab import ObjectChoice, TickRange, ValuesTab, shown_value, watched_values
from tests.support.tas_driver import TasDriver


@pytest.fixture(name="tab")
def values_tab(at: TasDriver) -> ValuesTab:
    tab = at.screen.tab
    assert isinstance(tab, ValuesTab)
    return tab


def straight_speeds(at: TasDriver) -> list[float]:
    run = Simulation(at.session.origin.level)
    speeds = []
    for tick in range(len(at.session.timeline)):
        run.step_keys(at.editor.track.inputs[tick] if tick < len(at.editor.track) else 0)
        speeds.append(float(np.hypot(run.ninja.x - run.ninja.prev_x, run.ninja.y - run.ninja.prev_y)))
    return speeds


def test_values_are_those_of_a_straight_run_also_after_an_edit(at: TasDriver, tab: ValuesTab) -> None:
    np.testing.assert_allclose(tab.watched[0].values, straight_speeds(at), atol=1e-9)
    at.editor.edit(lambda track: track.with_key(20, 40, Input.RIGHT, down=not track.keys_at(20) & Input.RIGHT))
    at.frames()
    np.testing.assert_allclose(tab.watched[0].values, straight_speeds(at), atol=1e-9)


def test_a_formula_is_asked_for_and_its_value_shown(at: TasDriver, tab: ValuesTab) -> None:
    at.press("v")
    assert isinstance(at.top(), FormPanel)
    at.write("x > 200")
    at.press("return")
    assert at.top() is at.screen
    watched = tab.watched[-1]
    x = at.session.timeline.column("x")
    for tick in (0, len(x) - 1):
        assert shown_value(watched, tick) == ("yes" if x[tick] > 200 else "no")
    assert {shown_value(watched, tick) for tick in range(len(x))} == {"yes", "no"}
    assert shown_value(watched, 10**6) == "-"


def test_what_is_wrong_with_a_formula_is_reported_with_its_column_and_asked_again(
    at: TasDriver, tab: ValuesTab
) -> None:
    at.press("v")
    at.write("vx + colour")
    at.press("return")
    assert at.app.notice.startswith("Column 6")
    form = at.shown(FormPanel)
    assert form.texts == ["vx + colour"]
    at.write("(9999)")
    form.texts[0] = "object_x(9999)"
    at.press("return")
    assert "no object 9999" in at.app.notice
    at.press("escape")
    assert len(tab.watched) == 3


def test_an_object_is_found_by_its_id(at: TasDriver, tab: ValuesTab) -> None:
    at.choose("Objects")
    assert isinstance(at.top(), ObjectChoice)
    at.press("return")
    form = at.shown(FormPanel)
    at.press("return")
    assert [each.watch.text for each in tab.watched][3:] == form.texts
    assert at.session.timeline.watched
    assert len(tab.watched[-1].values) == at.session.timeline.simulated_until


def test_a_click_in_the_plot_puts_the_cursor_there_and_a_drag_moves(at: TasDriver, tab: ValuesTab) -> None:
    window = tab.window
    assert window.is_whole
    y = 450
    at.drag((window.x(60), y))
    assert at.editor.cursor == 60
    window.zoom(window.x(60), 5)
    at.frames()
    assert window.tick(window.x(60)) == pytest.approx(60)
    shown = window.last - window.first
    first = window.first
    at.drag((300, y), (290, y), (280, y))
    assert at.editor.cursor == 60, "a drag moves the picture, not the cursor"
    assert window.first == pytest.approx(first + shown * 20 / window.width)
    at.editor.go(at.editor.last_tick)
    at.frames()
    assert window.last == pytest.approx(window.length), "it follows the cursor"
    at.event(pygame.MOUSEBUTTONDOWN, 300, y, button=3)
    assert window.is_whole


def test_what_is_under_the_mouse_is_named(at: TasDriver, tab: ValuesTab) -> None:
    at.mouse(tab.window.x(60), 450, click=False)
    assert at.editor.hint.startswith(f"tick 60  speed: {shown_value(tab.watched[0], 60)}")
    at.mouse(*at.button("Objects").centre, click=False)
    assert at.editor.hint == "The objects of the level with their ids"
    at.mouse(200, 565, click=False)
    assert not at.editor.hint


def test_the_window_follows_the_cursor_and_the_length() -> None:
    window = TickRange(0, 100)
    window.fit(1000)
    assert (window.first, window.last) == (0, 1000)
    window.zoom(50, 20)
    assert window.last - window.first == pytest.approx(1000 * 0.8**20)
    window.follow(900)
    assert window.first <= 900 <= window.last
    window.fit(500)
    assert window.last <= 500
    window.zoom(50, 100)
    assert window.last - window.first == pytest.approx(10)


def test_values_are_plotted_chosen_and_removed(at: TasDriver, tab: ValuesTab) -> None:
    at.mouse(60, 378 + 8)
    assert [each.plotted for each in tab.watched] == [False, True, True]
    for text in ("x", "y", "tick"):
        tab.add(text)
    assert sum(each.plotted for each in tab.watched) == 4, "no more lanes than fit"
    at.choose("Remove")
    assert [each.watch.text for each in tab.watched] == ["speed", "vx", "vy", "x", "y"]
    for _ in range(6):
        at.choose("Remove")
    assert not tab.watched


def test_the_mouse_over_a_list_takes_no_keys_away(at: TasDriver) -> None:
    at.editor.go(10)
    at.mouse(60, 380, click=False)
    at.press("down")
    assert at.editor.cursor == 11
    at.mouse(60, 380)
    at.press("down")
    assert at.editor.cursor == 12


def test_four_formulas_over_four_thousand_ticks_are_quick(at: TasDriver, tab: ValuesTab) -> None:
    at.editor.edit(lambda track: InputTrack(bytes(4000)))
    for text in ("exit_distance", "hypot(vx, vy) * 2 + x", "x > 100 and vy < 0"):
        tab.add(text)
    tab.remove()
    times = []
    for key in range(20):
        at.session.change(at.editor.track.with_key(100 + key, 101 + key, Input.RIGHT, down=True))
        start = thread_time()
        tab.refresh()
        times.append(thread_time() - start)
    assert sorted(times)[10] < 0.01, "ten times less on a quiet machine"


def test_a_watched_value_is_not_the_run_that_is_not_saved(at: TasDriver) -> None:
    at.session.watch(["speed"])
    assert (at.session.is_run_saved, at.session.is_saved) == (True, False)


def test_watched_values_are_kept_with_the_run(at: TasDriver, tab: ValuesTab, tmp_path: Path) -> None:
    tab.remove()
    tab.add("hypot(vx, vy) * 10")
    at.chord("s", pygame.KMOD_LCTRL)
    again = TasDriver(tmp_path / "player", tmp_path / "run.replay.txt")
    other = again.screen.tab
    assert isinstance(other, ValuesTab)
    assert [each.watch.text for each in other.watched] == [each.watch.text for each in tab.watched]
    again.session.branches.watched = ("x >", "y")
    assert [each.watch.text for each in watched_values(again.session.branches.watched)] == ["y"]
    again.close()
