"""The tab of searches: what is wanted and of which ticks, by keys and mouse, and what ends a search."""

from threading import Event

import pygame
import pytest

from ninja_game.play.menu_screen import PANEL_WIDTH, Menu
from ninja_game.search.formula import background
from ninja_game.tas.goals import PRESETS
from ninja_game.tas_editor import span_results
from ninja_game.tas_editor.span_results import COMPILING_SEARCHES, NOT_BEGUN
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from ninja_game.ui.input.keys import SCANCODES
from ninja_game.ui.widgets import PAD, Button
from tests.support.draw_log import noted_texts
from tests.support.searches import ended, results_of, selected, wish
from tests.support.tas_driver import TasDriver
from tests.support.waiting import LONGEST


def test_the_key_takes_the_selection_and_the_next_ones_are_typed(at: TasDriver, tab: SearchTab) -> None:
    assert tab.span == (100, 130)
    at.press("escape")
    before = at.editor.track
    # A program that is slow to answer gets many keys at once.
    for key in ("f", "a", "d"):
        pygame.event.post(pygame.Event(pygame.KEYDOWN, key=0, scancode=SCANCODES[key], mod=0, unicode=key))
    at.write("x > 1")
    assert tab.goal.text == "x > 1"
    assert at.editor.track == before
    at.editor.go(50)
    at.choose("Use the selection")
    assert tab.span == (50, 90), "a second, where only one tick is selected"


def test_a_click_on_a_preset_starts_it_and_escape_ends_it(at: TasDriver, tab: SearchTab) -> None:
    """Every phase of the click in a picture of its own: its release comes when the menu is gone."""
    at.mouse(*tab.goal.centre)
    at.press("escape")
    at.choose("Presets")
    menu = at.shown(Menu)
    left, _, width, _ = at.screen.level.area
    assert menu._box[0] > left + width, "the run is seen beside it"
    place = at.button("Reach the exit sooner").centre
    at.event(pygame.MOUSEBUTTONDOWN, *place, button=1)
    at.event(pygame.MOUSEBUTTONUP, *place, button=1)
    at.frames(2)
    results = results_of(tab)
    assert (results.running, tab.goal.text, at.screen.focus) == (True, "won", None)
    at.press("escape")
    at.wait(lambda: not results.running, "the end")
    assert at.top() is at.screen
    assert tab.goal.text == "won", "it can be changed, and started again"


def test_a_release_elsewhere_leaves_a_field_its_focus(at: TasDriver, tab: SearchTab) -> None:
    at.mouse(*tab.goal.centre)
    at.event(pygame.MOUSEBUTTONUP, *at.cell(3, "left"), button=1)
    assert at.screen.focus is tab.goal


def test_a_click_into_a_field_starts_nothing(at: TasDriver, tab: SearchTab) -> None:
    at.write("x > 1")
    at.mouse(*tab.measure.centre)
    at.mouse(*tab.goal.centre)
    assert at.screen.focus is tab.goal
    assert tab.results is None


def test_letters_are_typed_only_while_a_field_has_the_focus(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    on: list[bool] = []
    monkeypatch.setattr(pygame.key, "start_text_input", lambda: on.append(True))
    monkeypatch.setattr(pygame.key, "stop_text_input", lambda: on.append(False))
    at.press("f")
    assert on.pop()
    at.press("escape")
    assert not on.pop()
    at.mouse(200, 407)
    assert on.pop(), "a click into the goal"
    at.mouse(*at.cell(3, "left"))
    assert not on.pop(), "a click into the roll"
    at.press("b")
    assert on.pop(), "a form, and another tab behind it"


def test_other_ticks_make_the_goal_of_the_menu_again_and_end_old_results(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Be there sooner")
    goal = tab.goal.text
    results_of(tab).stop()
    ended(at, tab)
    at.editor.select(50, 90)
    tab.use_selection()
    assert tab.span == (50, 90)
    assert tab.goal.text != goal
    assert tab.results is None
    tab.goal.show("x > 400")
    at.editor.select(100, 130)
    tab.use_selection()
    assert tab.goal.text == "x > 400", "what a person has typed stays"


def test_an_edit_in_front_ends_the_search(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Stay alive")
    results = results_of(tab)
    at.wait(lambda: results.search.ticks_run, "a search")
    at.editor.edit(lambda track: track.replaced(0, 0, [0]))
    at.wait(lambda: not results.running, "the end")
    assert results.first_behind is None, "it did not end by itself"


def test_a_search_is_cancelled_by_hand_and_when_the_tas_editor_is_left(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert span_results.CLOSING_SECONDS <= 0.5, "nobody waits longer for a TAS editor to close"
    # On a slow machine a round of trials takes longer.
    monkeypatch.setattr(span_results, "CLOSING_SECONDS", LONGEST)
    wish(at, "Greatest speed")
    first = results_of(tab)
    at.wait(lambda: first.search.ticks_run, "a search")
    wish(at, "Greatest speed")
    second = results_of(tab)
    assert first is not second
    assert not first.running, "a new search ends the one before"
    at.wait(lambda: second.search.ticks_run, "a search")
    at.app.pop()
    assert not second.running


def test_the_button_stops_what_still_compiles(at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = Event()
    monkeypatch.setattr(background, "search_span", lambda *_, **__: (compiled.wait(60.0), ())[1])
    wish(at, "Greatest speed")
    assert results_of(tab).note == COMPILING_SEARCHES
    at.choose("Stop")
    assert not results_of(tab).running
    assert (results_of(tab).status, results_of(tab).note) == ("ended", NOT_BEGUN)
    at.choose("Start")
    assert results_of(tab).running
    compiled.set()


def test_what_is_wrong_is_reported(at: TasDriver, tab: SearchTab) -> None:
    at.press("return")
    assert at.app.notice.startswith("Say what for")
    at.write("x > colour")
    at.press("return")
    assert at.app.notice.startswith("Column 5")
    assert tab.results is None
    tab.goal.show("taken(9999)")
    at.press("return")
    assert at.app.notice.startswith("there is no object 9999")
    assert tab.results is None, "nothing is searched"
    tab.goal.show("x > 1")
    at.press("return")
    assert at.app.notice == "", "the search runs: no refusal is left"
    at.editor.select(len(at.editor.track) + 20, len(at.editor.track) + 30)
    at.choose("Use the selection")
    tab.start()
    assert "the run ends" in at.app.notice


def test_the_rest_of_the_run_and_a_measure_exclude_each_other(at: TasDriver, tab: SearchTab) -> None:
    tab.set_order("smallest")
    tab.set_rest(True)
    assert (tab.order, tab.task.measure) == ("earliest", "")
    tab.set_order("greatest")
    assert not tab.rest
    assert tab.task.measure == "speed"


@pytest.mark.parametrize("name", ["goal", "measure"])
def test_no_key_that_makes_text_is_a_command_while_a_field_has_the_focus(
    at: TasDriver, tab: SearchTab, name: str
) -> None:
    field = getattr(tab, name)
    tab.wants = field
    at.frames(2)
    before = at.editor.cursor, at.editor.selection, at.screen.level.playing.speed, at.editor.track, at.editor.tab
    for key in ("comma", "period", "equals", "minus", "slash", "semicolon", "leftbracket", "kp_plus", "kp_minus",
                "0", "a", "z", "space", "backslash", "grave", "apostrophe"):  # fmt: skip
        at.press(key)
        assert at.screen.focus is field, key
    assert before == (
        at.editor.cursor, at.editor.selection, at.screen.level.playing.speed, at.editor.track, at.editor.tab,
    )  # fmt: skip


def test_escape_ends_the_search_and_then_opens_the_menu(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    results = results_of(tab)
    at.mouse(*tab.goal.centre)
    at.press("escape")
    assert at.screen.focus is None
    assert results.running, "the field is left first"
    at.press("escape")
    at.wait(lambda: not results.running, "the end")
    assert at.top() is at.screen
    at.press("escape")
    assert isinstance(at.top(), Menu)


def test_ticks_that_are_not_the_selected_ones_say_why(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    end, texts = at.session.timeline.end[0], noted_texts(monkeypatch)
    wish(at, "Reach the exit sooner")
    at.frames(2)
    assert tab.span == (100, end)
    assert {f"Ticks 100 to {end - 1}", "up to the run's exit"} <= texts.keys()
    assert "not the selection" not in texts
    tab.goal.show("x > 1")
    at.editor.select(100, 131)
    tab.use_selection()
    assert tab.span_reason == "", "what a person has typed is for the selection"


@pytest.mark.parametrize("name", ["Whole run", "Reach the exit sooner"])
def test_a_selection_is_searched_whatever_ticks_a_goal_of_the_menu_had(
    at: TasDriver, tab: SearchTab, name: str
) -> None:
    for first in (60, 100):
        wish(at, name)
        assert tab.span_reason
        selected(at, first, 20)
        assert (tab.span, tab.span_reason, tab.method, tab.goal.text) == ((first, first + 20), "", "auto", "")
    at.write("x > 1")
    assert (tab.task.first, tab.task.last, tab.task.goal) == (100, 120, "x > 1")


def test_a_preset_takes_the_ticks_that_one_is_on(at: TasDriver, tab: SearchTab) -> None:
    end = at.session.timeline.end[0]
    at.press("escape")
    at.editor.go(60)
    at.choose("Presets")
    menu = at.shown(Menu)
    assert menu.title == "Presets for ticks 60 to 99"
    assert menu.rows()[0][2] == "From tick 60 on, in any way"
    at.choose("Reach the exit sooner")
    assert tab.span == (60, end)
    at.choose("Presets")
    at.choose("Be there sooner")
    assert tab.span[0] == 60, "of the same ticks as before"


def test_hints_of_goals_have_room_in_their_menu(at: TasDriver) -> None:
    at.press("f")
    at.press("escape")
    theme = at.app.menu_theme
    for _, hint, _ in PRESETS:
        hint = hint.format(999_000, 999_999)  # noqa: PLW2901
        assert theme.width(hint, 10.5) <= PANEL_WIDTH - 24 - 2 * PAD, hint
    at.choose("Presets")
    shown = {widget.text: widget.detail for widget in at.shown(Menu).widgets if isinstance(widget, Button)}
    assert shown == {name: hint.format(0, 39) for name, hint, _ in PRESETS}
