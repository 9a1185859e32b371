"""The tab of branches: kept, chosen, gone to, renamed, dropped."""

from unittest.mock import patch

import pygame
import pytest

from ninja_game.play.menu_screen import Question
from ninja_game.sim.inputs import Input
from ninja_game.tas_editor.tabs.branches_tab import BranchesTab
from ninja_game.ui.theme import Theme
from tests.support.tas_driver import TasDriver


@pytest.fixture(name="tab")
def branches_tab(at: TasDriver) -> BranchesTab:
    at.choose("Branches")
    tab = at.screen.tab
    assert isinstance(tab, BranchesTab)
    return tab


def keep(at: TasDriver, name: str) -> None:
    at.press("b")
    at.write(name)
    at.press("return")


def row(at: TasDriver, tab: BranchesTab, index: int) -> None:
    x, y, _, h = tab.list.row_area(index)
    at.mouse(x + 60, y + h / 2)


def test_the_name_that_is_proposed_is_the_outcome(at: TasDriver, tab: BranchesTab) -> None:
    at.press("b", "return")
    end, _ = at.session.timeline.end
    assert [branch.name for branch in tab.branches.all] == [f"exit in tick {end}"]


def test_branches_are_shown_as_a_tree(at: TasDriver, tab: BranchesTab) -> None:
    for name in ("one", "two"):
        keep(at, name)
    row(at, tab, 0)
    at.choose("Go to it")
    keep(at, "three")
    assert [(tab.branches.all[number].name, depth) for number, depth in tab.tree] == [
        ("one", 0), ("two", 1), ("three", 1)
    ]  # fmt: skip
    assert tab.chosen == 2, "the one that was kept last"


def test_going_to_a_branch_is_an_edit(at: TasDriver, tab: BranchesTab) -> None:
    first = at.editor.track
    keep(at, "")
    at.editor.edit(lambda track: track.with_key(5, 9, Input.LEFT, down=True))
    second = at.editor.track
    row(at, tab, 0)
    assert at.editor.track == second, "a click only chooses"
    at.choose("Go to it")
    assert at.editor.track == first
    at.session.undo()
    assert at.editor.track == second


def test_a_branch_is_looked_at_and_a_second_click_goes_to_it(at: TasDriver, tab: BranchesTab) -> None:
    first = at.editor.track
    keep(at, "start")
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    second = at.editor.track
    row(at, tab, 0)
    at.mouse(300, 100, click=False)
    at.frames()
    preview = at.editor.preview
    assert preview is not None
    assert (preview.name, preview.track) == ("start", first), "also when the mouse is elsewhere"
    at.choose("Values")
    assert at.editor.preview is None
    at.choose("Branches")
    row(at, tab, 0)
    row(at, tab, 0)
    at.frames()
    assert (at.editor.track, at.editor.preview) == (first, None)
    at.session.undo()
    assert at.editor.track == second


def test_an_edit_after_undo_keeps_what_was_better(at: TasDriver, tab: BranchesTab) -> None:
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    at.session.drop_branch(0)  # the run as it was opened, which is better
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 9))
    at.session.undo()
    at.session.begin()  # until it ends there is something to redo
    at.editor.edit(lambda track: track.replaced(0, 2, []))
    better, parent = at.editor.track, at.session.branches.current
    at.session.undo()
    at.editor.edit(lambda track: track.with_key(0, 1, Input.LEFT, down=True))
    (branch,) = at.session.branches.all
    assert (branch.name, branch.track.inputs) == ("undone", better.inputs)
    assert at.session.branches.current == parent, "the run does not come from it"
    for _ in range(2):
        at.session.undo()
        at.editor.edit(lambda track: track.replaced(0, 0, [0] * 9))
    assert at.session.branches.all == [branch], "what is no better is not kept"


def test_a_branch_is_renamed_and_dropped_after_a_question(at: TasDriver, tab: BranchesTab) -> None:
    keep(at, "")
    at.choose("Rename")
    at.write("again")
    at.press("return")
    assert tab.branches.all[0].name == "again", "what is typed replaces what is proposed"
    at.choose("Drop")
    assert isinstance(at.top(), Question)
    at.press("return")
    assert len(tab.branches) == 1, "stay is the first answer"
    at.choose("Drop")
    at.choose("Drop it")
    assert not tab.branches.all
    for text in ("Go to it", "Rename", "Drop", "Compare"):
        at.choose(text)
    assert at.top() is at.screen, "without a branch there is nothing to do"


def test_comparing_opens_the_lead_over_the_branch(at: TasDriver, tab: BranchesTab) -> None:
    keep(at, "")
    at.editor.edit(lambda track: track.with_key(5, 9, Input.LEFT, down=True))
    at.choose("Compare")
    assert at.screen.tab.name == "Lead"
    assert at.editor.against == tab.branches.all[0].track


def test_differences_are_reported_between_runs_to_the_exit(at: TasDriver, tab: BranchesTab) -> None:
    keep(at, "")
    assert tab.difference(tab.branches.all[0]) == ("the same", 0)
    at.editor.edit(lambda track: track.named(5, "hop"))
    with patch.object(Theme, "text") as drawn:
        row_area = 0.0, 0.0, 400.0, 18.0
        tab._draw_row(pygame.Surface((400, 40)), at.editor.theme, 0, row_area, False)
    assert drawn.call_args_list[0].args[1] == tab.branches.all[0].name, "not changed since: a marker is no key"
    at.editor.edit(lambda track: track.replaced(0, 0, [0] * 3))
    assert tab.difference(tab.branches.all[0]) == ("3 shorter", 3)
    at.editor.edit(lambda track: track.replaced(10, len(track), []))
    assert tab.difference(tab.branches.all[0]) == ("", 0)
