"""The tab of the lead over another run."""

from unittest.mock import patch

import pytest

from ninja_game.tas_editor.roll.facts import row_facts
from ninja_game.tas_editor.tabs.lead_tab import PAUSE_MS, LeadTab
from tests.support.tas_driver import TasDriver


@pytest.fixture(name="tab")
def lead_tab(at: TasDriver) -> LeadTab:
    at.choose("Lead")
    tab = at.screen.tab
    assert isinstance(tab, LeadTab)
    return tab


def compared(at: TasDriver, tab: LeadTab) -> None:
    at.wait(lambda: tab.is_current, "a comparison")
    at.frames()


def test_the_lead_over_a_run_that_starts_earlier(at: TasDriver, tab: LeadTab) -> None:
    compared(at, tab)
    assert tab.table
    assert tab.summary == "the same keys"
    assert {row.ahead for row in tab.table.rows} == {0}
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3).named(100, "ledge"))
    assert not tab.is_current
    compared(at, tab)
    assert {row.ahead for row in tab.table.rows if row.at} == {-3}
    assert {"ledge", "exit"} <= {row.name for row in tab.table.rows}
    assert [row.tick for row in tab.table.rows] == sorted(row.tick for row in tab.table.rows)
    assert "3 ticks behind at exit" in tab.summary


def test_what_is_lost_since_the_row_above_stands_beside_the_sum(at: TasDriver, tab: LeadTab) -> None:
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    compared(at, tab)
    assert tab.table
    shown: list[str] = []
    with patch.object(type(at.editor.theme), "text", lambda _, __, text, *___, **____: shown.append(text)):
        for index in (0, 1):
            tab._draw_row(at.app.window.surface, at.editor.theme, index, (0, 0, 400, 16), False)
    sums = [row.ahead for row in tab.table.rows[:2]]
    assert shown[3::5] == [f"{each:+d}" if each else "0" for each in sums]
    assert shown[4::5] == [f"{each:+d}" if each else "0" for each in (sums[0], sums[1] - sums[0])]


def test_a_click_puts_the_cursor_there(at: TasDriver, tab: LeadTab) -> None:
    compared(at, tab)
    assert tab.table
    x, y, _, h = tab.list.row_area(2)
    at.mouse(x + 50, y + h / 2)
    assert at.editor.cursor == tab.table.rows[2].tick


def test_edits_are_compared_only_after_a_pause(at: TasDriver, tab: LeadTab) -> None:
    compared(at, tab)
    table = tab.table
    for _ in range(PAUSE_MS // 25 + 4):
        at.editor.edit(lambda track: track.replaced(0, 0, [0]))
        at.frames()
    assert tab.job.is_idle
    assert tab.table is table
    compared(at, tab)
    assert tab.table is not table


def test_the_other_run_is_chosen(at: TasDriver, tab: LeadTab) -> None:
    opened = at.editor.track
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    at.session.keep_branch("late")
    at.frames()
    names = [name for name, _ in tab.choice.options]
    assert names == ["the run as it was opened", "branch: late"], "what was saved is the same as what was opened"
    x, y = tab.choice.centre
    at.mouse(x, y)
    assert at.editor.against == at.editor.track
    at.session.change(opened)
    compared(at, tab)
    assert tab.table
    assert tab.table.rows[-1].ahead == 3
    at.session.drop_branch(1)
    at.frames()
    assert at.editor.against is None


def test_it_begins_with_the_run_beside(at: TasDriver, tab: LeadTab) -> None:
    late = at.editor.track.replaced(0, 0, [0] * 3)
    at.screen.level.others.open([at.session.recording(late, "late")])
    compared(at, tab)
    assert tab.table
    assert tab.table.rows[-1].ahead == 3
    tab._put(at.editor.track)
    compared(at, tab)
    assert tab.summary == "the same keys", "another one is compared to where it is chosen"


def test_a_run_that_cannot_be_compared_says_so(at: TasDriver, tab: LeadTab, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.runs.compare.MAX_PAIRS", 10)
    at.wait(lambda: tab.is_current, "an answer")
    assert "too long" in tab.summary
    assert tab.table is None


def test_seconds_without_a_row_are_reported(at: TasDriver, tab: LeadTab) -> None:
    at.editor.edit(lambda track: track.replaced(0, len(track), bytes(200)))
    compared(at, tab)
    assert tab.table
    there = sum(not row.at for row in tab.table.rows)
    seconds = (len(tab.table.comparison.positions[0]) - 1) // 40
    assert 0 < tab.table.apart == seconds - there
    assert tab.summary.endswith(f"{tab.table.apart} seconds not listed: over 24 px apart")


def test_the_lead_over_a_run_beside_stands_in_the_roll(at: TasDriver) -> None:
    late = at.editor.track.replaced(5, 5, [0] * 3)
    at.screen.level.others.open([at.session.recording(late, "late")])
    at.wait(lambda: bool(at.editor.leads), "the comparison")
    end = at.session.timeline.end[0]
    assert at.editor.leads[end] == 3
    assert row_facts(at.editor, end, end + 1)[0].lead == 3
    leads = at.editor.leads
    at.frames(2)
    assert at.editor.leads is leads, "not made again in each picture"
    at.editor.edit(lambda track: track.replaced(0, 0, [0]))
    at.frames(2)
    assert not at.editor.leads, "of the run as it was"
