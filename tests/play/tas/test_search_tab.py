"""The tab of searches: what is wanted, results put into the run, what ends a search."""

from collections.abc import Iterator
from dataclasses import replace
from threading import Event, current_thread
from typing import Any
from unittest.mock import patch

import numpy as np
import pygame
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.play.menu_screen import PANEL_WIDTH, Menu
from ninja_game.runs.compare import RunSplits, run_splits
from ninja_game.search import solve as solve_module
from ninja_game.search.certificate import without_idle_keys
from ninja_game.search.formula import background
from ninja_game.search.formula.methods import fewest_ticks
from ninja_game.search.formula.task import SpanResult
from ninja_game.sim.inputs import Input
from ninja_game.sim.kinds import EXIT
from ninja_game.tas.goals import IMPROVE, PRESETS
from ninja_game.tas_editor import span_pieces, span_results
from ninja_game.tas_editor.roll.facts import BEFORE, compared_run, different_keys
from ninja_game.tas_editor.span_results import COMPILING_SEARCHES, NOT_BEGUN, NOTHING, NOTHING_YET, SpanResults
from ninja_game.tas_editor.tabs import search_tab as module
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from ninja_game.tas_editor.tabs.tab import SMALL
from ninja_game.ui.input.keys import SCANCODES
from ninja_game.ui.theme import Theme
from ninja_game.ui.widgets import PAD, Button
from tests.support.draw_log import noted_texts
from tests.support.tas_driver import TasDriver
from tests.support.waiting import LONGEST


@pytest.fixture(name="tab")
def search_tab(at: TasDriver) -> Iterator[SearchTab]:
    at.editor.select(100, 130)
    at.press("f")
    tab = at.screen.tab
    assert isinstance(tab, SearchTab)
    yield tab
    tab.close()


def wish(at: TasDriver, name: str) -> None:
    at.choose("Presets")
    at.choose(name)


def results_of(tab: SearchTab) -> SpanResults:
    assert tab.results is not None
    return tab.results


def is_in(at: TasDriver, results: SpanResults, found: SpanResult) -> bool:
    """Whether the run has the keys of a result up to its goal."""
    end = results.task.first + found.ticks
    return at.editor.track.inputs[:end] == found.inputs[:end]


def ended(at: TasDriver, tab: SearchTab) -> SpanResults:
    """Wait for the end of the search."""
    results = results_of(tab)
    at.wait(lambda: not results.running, "the end")
    at.frames(2)  # the list is that of the end
    return results


def stopped(at: TasDriver, tab: SearchTab) -> SpanResults:
    at.choose("Stop")
    return ended(at, tab)


def searched(at: TasDriver, tab: SearchTab) -> SpanResults:
    """Search until there is something better than the run, or a miss, then stop."""
    at.wait(lambda: bool(tab.better), "something better")
    return stopped(at, tab)


@pytest.fixture
def nothing_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches end at once without a result, and pieces of their spans are proposed then."""
    monkeypatch.setattr(span_results, "PATIENCE", 0.0)
    monkeypatch.setattr(background, "search_span", lambda task, report, **_: (report(1, ()), ())[1])


def row(at: TasDriver, tab: SearchTab, index: int, *, click: bool = True) -> None:
    x, y, _, h = tab.list.row_area(index)
    at.mouse(x + 60, y + h / 2, click=click)


def speed(at: TasDriver, tick: int) -> float:
    column = at.session.timeline.column
    return float(np.hypot(column("x")[tick] - column("prev_x")[tick], column("y")[tick] - column("prev_y")[tick]))


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


def test_a_better_end_is_found_and_put_in_as_one_edit(at: TasDriver, tab: SearchTab) -> None:
    before, slow = at.editor.track, speed(at, 129)
    wish(at, "Greatest speed")
    results = searched(at, tab)
    best = tab.better[0]
    row(at, tab, 0)
    assert at.editor.track != before
    assert speed(at, 129) == pytest.approx(-best.score)
    assert speed(at, 129) > slow
    assert is_in(at, results, best)
    columns = [float(at.session.timeline.column(name)[129]) for name in ("x", "y")]
    assert best.end[:2] == pytest.approx(columns)
    assert float(np.hypot(best.end[2], best.end[3])) == pytest.approx(speed(at, 129))
    assert at.editor.selection == (100, 130)
    assert at.editor.track.inputs[130:] == before.inputs[130:]
    other = replace(best, keys=np.ones(best.ticks, np.uint8), inputs=before.inputs[:100] + bytes([1]) * best.ticks)
    results.better = best, other
    at.frames(2)
    row(at, tab, 1)
    assert is_in(at, results, other), "another one takes its place"
    at.session.undo()
    at.session.undo()
    assert at.editor.track == before


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


def test_results_of_one_way_are_one(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    results = searched(at, tab)
    best = tab.better[0]
    elsewhere = replace(best, score=best.score + 0.01, path=best.path + 99)
    results.search.results = best, replace(best, score=best.score + 0.01, path=best.path + 9), elsewhere
    at.frames(2)
    assert tab.better[:2] == (best, elsewhere)


def test_pieces_of_a_span_in_which_nothing_better_is_found_are_searched_by_a_click(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(span_results, "PATIENCE", 0.0)
    end = at.session.timeline.end[0]
    at.editor.select(0, end + 1)
    at.choose("Use the selection")
    tab.goal.show(f"won and tick < {end // 2}")
    tab.start()
    at.wait(lambda: bool(tab.pieces), "pieces")
    assert all(found.missed_by for found in tab.better)
    reached = {"gold-taken", "exit-opened"}
    splits = [tick for tick, names in at.session.timeline.event_ticks if reached & {*names.split()}]
    whole, *legs = tab.pieces
    assert {piece.last - 1 for piece in legs} <= {*splits, end}
    assert [piece.first for piece in legs] == [0, *(piece.last for piece in legs[:-1])]
    assert all(piece.last - piece.first >= 10 for piece in legs)
    assert (whole.name, whole.wanted.method) == ("Whole run", IMPROVE)
    assert (legs[-1].name, legs[-1].wanted.goal) == ("To exit", "won")
    proposed = tab.pieces
    row(at, tab, len(tab.better) + 1)
    assert tab.span == (0, proposed[1].last)
    assert (tab.goal.text, tab.rest) == (proposed[1].wanted.goal, True)
    assert results_of(tab).running
    at.frames(2)
    assert tab.pieces == proposed, "for the next click"
    results_of(tab).stop()
    ended(at, tab)
    at.choose("Use the selection")
    assert not tab.pieces


def test_a_search_that_has_stalled_proposes_the_whole_run(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    at.editor.edit(lambda track: track.replaced(110, 110, bytes(40)))
    for name in ("PATIENCE", "STALLED"):
        monkeypatch.setattr(span_results, name, LONGEST)
    wish(at, "Reach the exit sooner")
    at.wait(lambda: bool(tab.better) and tab.better[0].missed_by is None, "a result")
    at.frames(2)
    assert tab.proposed is None
    monkeypatch.setattr(span_results, "STALLED", 0.01)
    at.wait(lambda: bool(tab.pieces), "pieces")
    stopped(at, tab)
    row(at, tab, len(tab.better))
    assert (tab.method, results_of(tab).running) == (IMPROVE, True)


@pytest.mark.usefixtures("nothing_found")
@pytest.mark.parametrize("dies", [False, True])
def test_the_way_to_the_exit_is_proposed_as_the_whole_run_too(at: TasDriver, tab: SearchTab, dies: bool) -> None:
    end = at.session.timeline.end[0]
    if dies:
        at.editor.edit(lambda track: track.replaced(30, len(track), b""))
    at.editor.select(0, 20)
    at.choose("Use the selection")
    wish(at, "Reach the exit sooner")
    at.wait(lambda: bool(tab.pieces), "pieces")
    names = [piece.name for piece in tab.pieces]
    assert names == ["Whole run"] if dies else (names[0], names[-1]) == ("Whole run", "To exit")
    at.frames()
    row(at, tab, 0)
    assert (tab.method, tab.span) == (IMPROVE, (0, len(at.editor.track) if dies else end + 1))
    assert isinstance(results_of(tab).search, background.RunSearch)


@pytest.mark.usefixtures("nothing_found")
def test_a_span_with_nothing_to_reach_is_proposed_in_halves(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The run is played in a thread, so that the window stays alive."""
    threads: list[object] = []

    def watched(*args: Any) -> RunSplits:
        threads.append(current_thread())
        return run_splits(*args)

    monkeypatch.setattr(span_pieces, "run_splits", watched)
    wish(at, "Same end, sooner")
    at.wait(lambda: bool(tab.pieces), "pieces")
    expected = [(100, 115, "To tick 114"), (115, 130, "To tick 129")]
    assert [piece[:3] for piece in tab.pieces[2:]] == expected
    assert all(piece.wanted.rest for piece in tab.pieces[2:])
    assert current_thread() not in threads
    goal = tab.goal.text
    at.frames()
    row(at, tab, len(tab.better) + 1)
    task = results_of(tab).task
    assert (task.first, task.last, task.goal, task.rest) == (100, 130, goal, False)
    assert [piece.name for piece in tab.pieces[:2]] == ["Whole run", span_pieces.WITHOUT_REST]
    at.editor.edit(lambda track: track.replaced(len(track), len(track), bytes(3)))
    at.frames(2)
    at.wait(lambda: bool(tab.pieces), "those of the run as it is")
    assert tab.pieces[1].wanted.goal == goal, "of the span, not of the piece that is searched"


def test_a_taken_result_leaves_the_cursor_in_its_place_and_undo_too(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    results = searched(at, tab)
    results.stop()
    shorter = replace(tab.better[0], ticks=25, inputs=tab.better[0].inputs[:125])
    results.better = (shorter,)
    for cursor, expected in ((50, 50), (110, 110), (128, 124), (135, 130)):
        at.editor.go(cursor)
        at.frames(2)
        top = at.screen.roll.top
        assert results.put_into_run(shorter)
        at.frames(2)
        assert (at.editor.selection, at.screen.roll.top) == ((expected, expected + 1), top), cursor
        at.screen.run("undo")
        assert at.editor.cursor == (cursor if cursor > 60 else 100), "back, where the change is seen from there"
    at.editor.select(100, 130)
    assert results.put_into_run(shorter)
    assert at.editor.selection == (100, 125), "a selected span is that of the result"


def test_the_change_is_marked_while_the_mouse_rests_on_the_result_that_was_taken(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    searched(at, tab)
    row(at, tab, 0)
    at.frames(2)
    assert tab.list.over == 0
    other = compared_run(at.editor)
    assert other is not None
    assert (at.editor.preview, other.number) == (None, BEFORE)
    assert different_keys(at.editor.track.inputs, other.track.inputs)[100:130].any()


def test_the_result_under_the_mouse_is_looked_at(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    searched(at, tab)
    row(at, tab, 0, click=False)
    at.frames()
    preview = at.editor.preview
    assert preview is not None
    assert preview.track.inputs == tab.better[0].inputs
    assert len(preview.trajectory.positions) >= 130
    at.mouse(300, 100, click=False)
    at.frames()
    assert at.editor.preview is None


def test_a_result_that_does_not_fit_any_more_brings_its_run_back(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    results = searched(at, tab)
    down = not at.editor.track.keys_at(50) & Input.LEFT
    at.editor.edit(lambda track: track.with_key(50, 51, Input.LEFT, down=down))
    changed, found = at.editor.track, tab.better[0]
    at.frames(2)
    row(at, tab, 0)
    assert is_in(at, results, found), "the run as it was searched, with the result"
    assert "as it was searched" in at.app.notice
    assert changed.inputs in [branch.track.inputs for branch in at.session.branches.all], "nothing is lost"
    at.session.undo()
    assert at.editor.track == changed
    at.session.undo()
    assert results.first_behind == 130
    at.editor.edit(lambda track: track.with_key(200, 210, Input.LEFT, down=True))
    row(at, tab, 0)
    assert is_in(at, results, tab.better[0]), "what is behind the span does not matter"


def test_earlier_results_stay_until_forgotten(at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch) -> None:
    wish(at, "Greatest speed")
    results = searched(at, tab)
    best, before = tab.better[0], at.editor.track
    at.editor.select(50, 90)
    tab.use_selection()
    at.frames(2)
    assert tab.results is None
    assert tab.list.count == len(tab.earlier) > 0
    tab.goal.show("x > 400")
    tab.start()
    results_of(tab).stop()
    places = noted_texts(monkeypatch)
    note = ended(at, tab).note
    at.frames(2)
    assert at.app.canvas.logical(places[note].topleft)[1] > tab.area[1] + 80
    first = len(tab.better)
    row(at, tab, first, click=False)
    at.frames()
    assert at.editor.preview is not None
    assert at.editor.preview.track.inputs == best.inputs
    row(at, tab, first)
    assert is_in(at, results, best)
    names = [(branch.name, branch.track.inputs) for branch in at.session.branches.all]
    title = "100-129 Greatest speed"
    assert names == [(f"before {title}", before.inputs), (title, at.editor.track.inputs)]
    row(at, tab, first + 1)
    at.session.undo()
    row(at, tab, first)
    kept = [branch.track.inputs for branch in at.session.branches.all]
    assert len(kept) == len({*kept}), "none is kept twice"
    at.choose("Forget earlier")
    at.frames(2)
    assert tab.list.count == len(tab.better)


@pytest.mark.usefixtures("nothing_found")
def test_old_pieces_are_no_rows_after_an_edit(at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch) -> None:
    wish(at, "Same end, sooner")
    at.wait(lambda: bool(tab.pieces), "pieces")
    held = Event()
    monkeypatch.setattr(span_pieces, "run_splits", lambda *run: held.wait(LONGEST) and run_splits(*run))
    at.editor.edit(lambda track: track.up_to(110))
    at.frames(2)
    assert not tab.pieces
    held.set()
    at.wait(lambda: bool(tab.pieces), "the pieces of the run as it is")
    assert [piece[:3] for piece in tab.pieces] == [(0, 110, "Whole run")], "it ends before the span"


@pytest.mark.usefixtures("nothing_found")
def test_pieces_are_of_the_searched_span_whatever_is_selected_meanwhile(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    held = Event()
    monkeypatch.setattr(background, "search_span", lambda task, report, **_: (held.wait(LONGEST), report(1, ()), ())[2])
    wish(at, "Same end, sooner")
    at.editor.select(40, 70)
    at.choose("Use the selection")
    assert (tab.span, results_of(tab).running) == ((40, 70), True)
    held.set()
    at.wait(lambda: bool(tab.pieces), "pieces")
    expected = [(100, 130, span_pieces.WITHOUT_REST), (100, 115, "To tick 114"), (115, 130, "To tick 129")]
    assert [piece[:3] for piece in tab.pieces[1:]] == expected


@pytest.mark.usefixtures("nothing_found")
def test_no_pieces_are_proposed_for_what_is_not_to_be_sooner(at: TasDriver, tab: SearchTab) -> None:
    for goal in ("taken(3)", "speed > 90"):
        tab.goal.show(goal)
        tab.start()
        ended(at, tab)
        assert tab.proposed is None, goal


def test_an_edit_in_front_ends_the_search(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Stay alive")
    results = results_of(tab)
    at.wait(lambda: results.search.ticks_run, "a search")
    at.editor.edit(lambda track: track.replaced(0, 0, [0]))
    at.wait(lambda: not results.running, "the end")
    assert results.first_behind is None, "it did not end by itself"


def test_the_same_end_is_found_sooner_and_the_rest_follows(at: TasDriver, tab: SearchTab) -> None:
    end = at.session.timeline.end[0]
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    assert at.session.timeline.end == (end + 3, "exit")
    at.editor.select(0, 24)
    at.choose("Use the selection")
    wish(at, "Same end, sooner")
    assert tab.rest
    results = searched(at, tab)
    words, other, *_, gain = results.words(tab.better[0])
    assert words == f"exit in tick {tab.better[0].score - 1:.0f}"
    assert 0 <= int(other) < 24
    assert gain in ("1 tick sooner", "2 ticks sooner", "3 ticks sooner")
    at.editor.edit(lambda track: track.named(end + 3, "last"))
    row(at, tab, 0)
    assert at.session.timeline.end == (int(tab.better[0].score) - 1, "exit")
    assert len(at.editor.track) == int(tab.better[0].score), "it ends at the exit"
    assert not at.session.tail_behind
    assert at.session.timeline.end[0] < end + 3
    assert tab.better[0].gold == at.session.timeline.column("gold")[at.session.timeline.end[0]]
    own = results.search.own
    assert own is not None
    fewer = replace(tab.better[0], gold=own.gold - 2)
    assert results.words(fewer)[0].endswith(", 2 gold fewer")


@pytest.mark.parametrize("name", ["Reach the exit sooner", "Whole run"])
@pytest.mark.parametrize("passed", [True, False])
def test_gold_is_said_also_where_the_own_keys_do_not_reach_the_goal(
    at: TasDriver, tab: SearchTab, name: str, passed: bool
) -> None:
    if not passed:
        at.editor.edit(lambda track: track.replaced(130, len(track), b""))
    at.editor.select(100, 130)
    wish(at, name)
    results, timeline = results_of(tab), at.session.timeline
    gold = int(timeline.column("gold")[timeline.end[0]])
    found = SpanResult(1.0, 1, np.zeros(1, np.uint8), b"\0", gold)
    assert "gold" not in results.words(found)[0]
    assert results.words(replace(found, gold=gold - 1))[0].endswith(", 1 gold fewer")
    assert results.words(replace(found, gold=gold + 2))[0].endswith(", 2 gold more")


@pytest.mark.parametrize("name", ["Be there sooner", "Go beyond sooner"])
def test_a_run_gets_shorter_by_what_the_list_says(at: TasDriver, tab: SearchTab, name: str) -> None:
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 9))
    at.editor.select(0, 40)
    at.choose("Use the selection")
    before = len(at.editor.track)
    wish(at, name)
    results = searched(at, tab)
    for index in (0, len(tab.better) - 1, 0):
        gain = results.words(tab.better[index])[-1]
        row(at, tab, index)
        assert is_in(at, results, tab.better[index])
        assert gain.split(" tick")[0] == str(before - len(at.editor.track))


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


@pytest.mark.skipif(not compiled_available(), reason="nothing is compiled")
def test_the_first_search_prepares_that_of_the_whole_run(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    prepared = Event()
    monkeypatch.setattr(solve_module, "compile_solver", prepared.set)
    wish(at, "Greatest speed")
    at.wait(prepared.is_set, "the solver")
    assert results_of(tab).search.seconds > 0


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


def test_what_is_not_a_better_than_the_run_is_not_listed(at: TasDriver, tab: SearchTab) -> None:
    at.write("tick >= 109")
    at.press("return")
    at.wait(lambda: bool(results_of(tab).search.results), "results")
    results = stopped(at, tab)
    assert not tab.better
    assert results.note == "Nothing better than the run's own keys: goal after tick 109. Try Whole run, in Presets."


def test_a_goal_out_of_reach_is_not_reached(at: TasDriver, tab: SearchTab) -> None:
    at.write("y < -10000")
    at.press("return")
    results = searched(at, tab)
    (miss,) = tab.better
    words, *_, gain = results.words(miss)
    assert words == f"closest: {10000 + miss.end[1]:.3g} short after tick {miss.inputs and len(miss.inputs) - 1}"
    assert gain == "a miss"
    row(at, tab, 0)
    assert is_in(at, results, miss)


def test_a_goal_out_of_reach_gets_advice(at: TasDriver, tab: SearchTab) -> None:
    at.write("x > 0 and y < -10000")
    at.press("return")
    results = searched(at, tab)
    (miss,) = results.better
    last, short = 99 + miss.ticks, f"y < -10000: {10000 + miss.end[1]:.3g} short"
    where = "a longer span, it is nearest at its end" if miss.ticks > 27 else "an earlier first tick"
    assert results.advice == f"Missing after tick {last}: {short}. Try: {where}; or a part of the goal alone."
    with patch.object(Theme, "text", autospec=True, side_effect=Theme.text) as text:
        tab.paint(at.app.surface, at.screen.theme)
    shown = " ".join(call.args[2] for call in text.call_args_list)
    assert results.advice in shown, "below the row"
    assert results._preview is None, "no run is played for a goal that does not ask how it ends"
    rest = replace(miss, missed_by=0.0, inputs=miss.inputs[:1])
    results.better = (rest,)
    (id_,) = (id_ for id_, kind, _, _ in at.session.timeline.objects if kind == EXIT)
    goes_on = f"it goes on, the switch of exit {id_} untouched"
    assert results.words(rest)[0] == f"goal after tick {last}, but not the exit: {goes_on}"
    assert results.advice.startswith(f"With what follows the goal, {goes_on}. Try: end at the goal")
    results.better = (replace(miss, missed_by=None),)
    assert not results.advice


def test_what_is_near_to_nothing_says_so(at: TasDriver, tab: SearchTab) -> None:
    at.write("dead and won")
    at.press("return")
    at.wait(lambda: results_of(tab).search.ticks_run, "a search")
    assert results_of(tab).note == NOTHING_YET
    assert stopped(at, tab).note == NOTHING


def test_what_is_found_takes_the_place_of_the_nearest_miss(at: TasDriver, tab: SearchTab) -> None:
    at.write("y < -10000")
    at.press("return")
    results = results_of(tab)
    at.wait(lambda: bool(tab.better), "a miss")
    results.search.results = (replace(tab.better[0], missed_by=None),)
    results.refresh()
    assert results.better == results.search.results


def test_the_rest_of_the_run_and_a_measure_exclude_each_other(at: TasDriver, tab: SearchTab) -> None:
    tab._set_order("smallest")
    tab._set_rest(True)
    assert (tab.order, tab.task.measure) == ("earliest", "")
    tab._set_order("greatest")
    assert not tab.rest
    assert tab.task.measure == "speed"


def test_all_keys_are_tried_where_there_are_few_ways() -> None:
    assert fewest_ticks(8) == 1
    assert 6 ** -(-130 // fewest_ticks(130)) <= 2_000_000


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


def test_the_whole_run_is_shortened_in_the_background_and_keeps_its_markers(at: TasDriver, tab: SearchTab) -> None:
    end = at.session.timeline.end[0]
    # A second in which nothing is done, that any search finds.
    at.editor.edit(lambda track: track.replaced(0, 0, bytes(40)).named(40, "begins"))
    wish(at, "Whole run")
    assert tab.span == (0, end + 41)
    results = results_of(tab)
    at.wait(lambda: not results.running or (tab.better and tab.better[0].ticks < end + 20), "a shorter run")
    assert results.running, results.search.problem
    stopped(at, tab)
    found = tab.better[0]
    assert results.words(found)[0].startswith(f"exit in tick {found.ticks - 1}")
    at.editor.go(30)
    row(at, tab, 0)
    assert at.editor.selection == (30, 31), "one stays where one is"
    assert at.editor.track.inputs == found.inputs
    assert without_idle_keys(results.task.level, found.inputs, results.task.inputs) == found.inputs
    assert at.session.timeline.end == (found.ticks - 1, "exit")
    (marker,) = at.editor.track.markers
    assert (marker.name, marker.tick < 40) == ("begins", True)
    assert at.session.origin.replay.made.searches == ("improve",)
    assert at.session.origin.replay.made.edits == 1, "that by hand: to take a result is none"


def test_a_run_that_ends_before_the_exit_is_led_there_and_shortened(at: TasDriver, tab: SearchTab) -> None:
    end = at.session.timeline.end[0]
    at.editor.edit(lambda track: track.replaced(end - 30, len(track), b""))
    wish(at, "Whole run")
    assert tab.span == (0, end - 30)
    results = searched(at, tab)
    assert results.words(tab.better[0])[-1] == "new"
    row(at, tab, 0)
    assert at.session.timeline.end[1] == "exit"


def test_of_a_run_without_a_way_to_the_exit_it_says_so(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(background, "to_exit", lambda *_, **__: None)
    at.editor.edit(lambda track: track.replaced(20, len(track), b""))
    tab.method = IMPROVE
    tab.start()
    assert ended(at, tab).note == background.NO_WAY


def test_beside_a_faster_run_the_own_route_stays_in_the_list(at: TasDriver, tab: SearchTab) -> None:
    """Rows say whose run they are, and who made it is named only where its keys are taken."""
    fast = at.editor.track
    at.editor.edit(lambda track: track.replaced(0, 0, bytes(40)))
    slow, about = at.editor.track, at.session.recording(fast, "theirs")
    theirs = replace(about, file="theirs.replay.txt", replay=replace(about.replay, author="Cy"))
    at.screen.level.others.open([theirs])
    at.frames(2)
    wish(at, "Whole run")
    results = results_of(tab)

    at.wait(lambda: any(each.own_route for each in tab.better), "a result of the own route")
    stopped(at, tab)
    own = next(each for each in tab.better if each.own_route)
    assert results.words(own)[0] == f"tick {own.ticks - 1}, own route"
    assert results.words(replace(own, gold=own.gold - 1))[0].endswith(", 1 gold fewer, own route")
    assert results.put_into_run(own)
    assert "Cy" not in at.session.origin.replay.co_authors
    at.session.undo()
    assert at.editor.track == slow
    beside = replace(own, inputs=fast.inputs[: own.ticks], own_route=False)
    assert results.words(beside)[0].endswith(", this is Cy")
    assert results._contributions(beside) == at.editor.others[0].made
    results.search.results = replace(beside, score=own.score - 1, path=own.path + 99), own
    at.frames(2)
    assert [each.own_route for each in tab.better] == [True, False], "what is known already comes last"
    other = replace(own, own_route=False, path=at.editor.others[0].trajectory.positions[: own.ticks])
    cy = at.editor.others[0]
    results._others = (replace(cy, name="Dee", trajectory=at.session.timeline.trajectory()), cy)
    assert results.words(other)[0].endswith(", like Cy")
    assert results.put_into_run(other)
    assert "Cy" in at.session.origin.replay.co_authors


@pytest.mark.usefixtures("nothing_found")
def test_a_span_is_searched_along_runs_beside_and_names_their_players_where_they_help(
    at: TasDriver, tab: SearchTab
) -> None:
    fast = at.editor.track
    at.editor.edit(lambda track: track.replaced(110, 110, bytes(40)))
    about = at.session.recording(fast, "theirs")
    at.screen.level.others.open([replace(about, file="theirs.txt", replay=replace(about.replay, author="Cy"))])
    wish(at, "Reach the exit sooner")
    results = results_of(tab)
    assert results.task.others == (fast.inputs,)
    path = at.editor.others[0].trajectory.positions[100:110]
    own = SpanResult(1.0, 10, np.zeros(10, np.uint8), bytes(110), path=path)
    theirs = replace(own, own_route=False)
    assert "route" not in results.words(own)[0]
    assert results.words(theirs)[0].endswith(", like Cy")
    assert "Cy" in results._contributions(theirs).names
    assert "Cy" not in results._contributions(own).names


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


def test_a_speed_of_two_digits_has_room(at: TasDriver) -> None:
    assert at.editor.theme.width("10.345", SMALL) <= module._WIDTHS[-1]


def selected(at: TasDriver, first: int, ticks: int) -> None:
    """By keys: go to a tick, select this many, ask for a search of them."""
    at.press("escape")
    at.editor.go(first)
    for _ in range(ticks - 1):
        at.chord("down", pygame.KMOD_LSHIFT)
    at.press("f")


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


def test_a_goal_that_is_typed_leaves_the_whole_run(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Whole run")
    assert (tab.span[0], tab.method) == (0, IMPROVE)
    at.mouse(*tab.goal.centre)
    at.press("end")
    at.write(" and x > 1")
    assert (tab.span, tab.method, tab.span_reason) == ((100, 130), "auto", "")
    assert tab.goal.text == "won and x > 1"


def test_a_list_that_is_cleared_has_no_scroll_bar(at: TasDriver, tab: SearchTab) -> None:
    tab.list.fill(range(99))
    tab.close()
    assert tab.list.count == 0


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
