"""The results of a search: which are listed, looked at, and put into the run."""

from dataclasses import replace

import numpy as np
import pytest

from ninja_game.search.formula.task import SpanResult
from ninja_game.sim.inputs import Input
from ninja_game.tas_editor.roll.facts import BEFORE, compared_run, different_keys
from ninja_game.tas_editor.span_results import NOTHING, NOTHING_YET
from ninja_game.tas_editor.tabs import search_tab as module
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from ninja_game.tas_editor.tabs.tab import SMALL
from tests.support.draw_log import noted_texts
from tests.support.searches import ended, is_in, results_of, row, searched, speed, stopped, wish
from tests.support.tas_driver import TasDriver


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


def test_results_of_one_way_are_one(at: TasDriver, tab: SearchTab) -> None:
    wish(at, "Greatest speed")
    results = searched(at, tab)
    best = tab.better[0]
    elsewhere = replace(best, score=best.score + 0.01, path=best.path + 99)
    results.search.results = best, replace(best, score=best.score + 0.01, path=best.path + 9), elsewhere
    at.frames(2)
    assert tab.better[:2] == (best, elsewhere)


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
    assert not at.session.tail_behind()
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


def test_what_is_not_a_better_than_the_run_is_not_listed(at: TasDriver, tab: SearchTab) -> None:
    at.write("tick >= 109")
    at.press("return")
    at.wait(lambda: bool(results_of(tab).search.results), "results")
    results = stopped(at, tab)
    assert not tab.better
    assert results.note == "Nothing better than the run's own keys: goal after tick 109. Try Whole run, in Presets."


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
    assert results.contributions(beside) == at.editor.others[0].made
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
    assert "Cy" in results.contributions(theirs).names
    assert "Cy" not in results.contributions(own).names


def test_a_speed_of_two_digits_has_room(at: TasDriver) -> None:
    assert at.editor.theme.width("10.345", SMALL) <= module._WIDTHS[-1]


def test_a_list_that_is_cleared_has_no_scroll_bar(at: TasDriver, tab: SearchTab) -> None:
    tab.list.fill(range(99))
    tab.close()
    assert tab.list.count == 0
