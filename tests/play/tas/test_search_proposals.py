"""What the tab of searches proposes: pieces of a span, advice, and the whole run."""

from dataclasses import replace
from threading import Event, current_thread
from typing import Any
from unittest.mock import patch

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.runs.splits import RunSplits, run_splits
from ninja_game.search import solve as solve_module
from ninja_game.search.certificate import without_idle_keys
from ninja_game.search.formula import background
from ninja_game.search.formula.methods import fewest_ticks
from ninja_game.sim.kinds import EXIT
from ninja_game.tas.goals import IMPROVE
from ninja_game.tas_editor import span_pieces, span_results
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from ninja_game.ui.theme import Theme
from tests.support.searches import ended, is_in, results_of, row, searched, stopped, wish
from tests.support.tas_driver import TasDriver
from tests.support.waiting import LONGEST


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


@pytest.mark.skipif(not compiled_available(), reason="nothing is compiled")
def test_the_first_search_prepares_that_of_the_whole_run(
    at: TasDriver, tab: SearchTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    prepared = Event()
    monkeypatch.setattr(solve_module, "compile_solver", prepared.set)
    wish(at, "Greatest speed")
    at.wait(prepared.is_set, "the solver")
    assert results_of(tab).search.seconds > 0


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


def test_all_keys_are_tried_where_there_are_few_ways() -> None:
    assert fewest_ticks(8) == 1
    assert 6 ** -(-130 // fewest_ticks(130)) <= 2_000_000


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


def test_a_goal_that_is_typed_leaves_the_whole_run(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Whole run")
    assert (tab.span[0], tab.method) == (0, IMPROVE)
    at.mouse(*tab.goal.centre)
    at.press("end")
    at.write(" and x > 1")
    assert (tab.span, tab.method, tab.span_reason) == ((100, 130), "auto", "")
    assert tab.goal.text == "won and x > 1"
