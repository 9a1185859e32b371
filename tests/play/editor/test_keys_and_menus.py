"""Commands, menus and notices of the editor: keys, lists below buttons, undo, saving, leaving."""

from dataclasses import replace
from pathlib import Path

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.files import new_source
from ninja_game.editor.motion import SYMMETRIES
from ninja_game.editor.palette import SNAPS
from ninja_game.play.editor.bars import Toolbar
from ninja_game.play.editor.commands import EDITOR_COMMANDS
from ninja_game.play.editor.part import ToolButton
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.editor.sheet import GRIDS
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import DropDown, FormPanel, Menu
from ninja_game.play.panels.help import HelpPage
from tests.support.level_maker import ROOM, Maker


@pytest.mark.parametrize("name, chosen", [("symmetry", "Both"), ("grid", "2 cells"), ("snap_next", "Quarter")])
def test_the_buttons_of_mirror_grid_and_snap_list_what_there_is(room: Maker, name: str, chosen: str) -> None:
    button = room.tool_button(name)
    room.mouse(*button.centre)
    texts = [each.text for each in room.top().widgets]  # type: ignore[attr-defined]
    chosen = next(text for text in texts if text.startswith(chosen))
    room.choose(chosen)
    tools, grid = room.editor.session.tools, room.editor.view.grid.name
    now = {"symmetry": tools.brush.symmetry, "grid": grid, "snap_next": tools.brush.snap}
    assert now[name] == chosen.lower().split(":")[0]
    room.mouse(*button.centre)
    assert getattr(room.shown(Menu).focus, "text", "") == chosen, "what there is now has the focus"


def test_every_command_runs_and_help_names_all_keys(room: Maker) -> None:
    for command in EDITOR_COMMANDS.commands:
        if command.name not in ("certify", "menu", "playtest", "playtest_here"):
            room.editor.commands.run(command.name)
            room.frames()
            while not isinstance(room.top(), EditorScreen):
                room.app.pop()
    room.press("f1")
    assert isinstance(room.top(), HelpPage)
    keys = [key for command in EDITOR_COMMANDS.commands for key in command.keys]
    assert len(keys) == len(set(keys))


def test_a_click_on_the_lower_edge_of_help_does_not_leave_the_editor(room: Maker) -> None:
    """Other screens have their button to go back there."""
    room.mouse(760, 22)
    assert isinstance(room.top(), HelpPage)


def test_undo_and_redo_say_what_changed_until_the_next_change(room: Maker) -> None:
    view = room.editor.view
    room.editor.session.tools.history.change(replace(room.draft, author="somebody", comment="Dark"))
    room.drag((300, 300))
    for key, hint in (("z", "Undone: 1 cell"), ("z", "Undone: author, comment"), ("y", "Redone: author, comment")):
        room.chord(key, pygame.KMOD_LCTRL)
        assert view.hint == hint
    room.editor.session.tools.history.change(room.draft.with_objects(room.draft.objects[::-1]))
    room.chord("z", pygame.KMOD_LCTRL)
    assert view.hint == "Undone: order of objects"
    room.drag((400, 300))
    assert view.hint == ""


def test_a_click_beside_a_list_below_its_button_closes_it(room: Maker) -> None:
    button = room.tool_button("symmetry")
    room.mouse(*button.centre)
    menu = room.shown(DropDown)
    assert all(each.area[1] > button.area[1] and abs(each.area[0] - button.area[0]) < 10 for each in menu.widgets)
    before = room.draft
    room.mouse(300, 400)
    assert isinstance(room.top(), EditorScreen)
    assert (room.draft, room.editor.session.tools.brush.symmetry) == (before, "off")


def test_a_level_with_a_name_is_saved_without_a_question(room: Maker, tmp_path: Path) -> None:
    room.editor.session.begin(new_source())
    room.press("f2")
    room.fill("Mine", "OK")
    room.chord("s", pygame.KMOD_LCTRL)
    assert isinstance(room.top(), EditorScreen)
    assert room.editor.session.edited.source.path == tmp_path / "levels" / "mine.txt"


def test_what_was_saved_is_said_in_the_editor_only(room: Maker) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    assert room.app.notice.startswith("Saved")
    room.press("f5")
    assert isinstance(room.top(), PlaytestScreen)
    assert not room.app.notice
    room.press("escape")
    room.drag((300, 300))
    room.chord("s", pygame.KMOD_LCTRL)
    assert room.app.notice.startswith("Saved")
    room.choose_in_menu("Leave the editor")
    assert isinstance(room.top(), MainMenu)
    assert not room.app.notice


def test_what_went_wrong_is_still_said_over_a_screen_that_opens_then(room: Maker) -> None:
    room.app.notify("What went wrong")
    room.press("f2")
    room.shown(FormPanel)
    assert room.app.notice == "What went wrong"


def test_texts_of_the_buttons_above_the_level_have_room_at_both_ends(room: Maker) -> None:
    texts = {
        "symmetry": [f"Mirror: {name}" for name in SYMMETRIES],
        "grid": [f"Grid: {grid.name}" for grid in GRIDS],
        "snap_next": [f"Snap: {name}" for name in SNAPS],
        "certify": ["Certify"],
    }
    bar = next(part for part in room.editor.parts if isinstance(part, Toolbar))
    buttons = [widget for widget in bar.widgets if isinstance(widget, ToolButton)]
    assert texts.keys() <= {button.name for button in buttons}
    for button in buttons:
        for text in texts.get(button.name, [button.text]):
            assert room.app.theme.width(text, 9, bold=True) <= button.area[2] - 8, text
        assert button.area[0] + button.area[2] <= 786


def test_escape_gives_up_step_by_step_and_says_that_the_next_opens_the_menu(room: Maker) -> None:
    tools, view = room.editor.session.tools, room.editor.view
    tools.tool = Tool.SELECT
    room.drag((60, 542))
    assert tools.selection
    for tool, kept in ((Tool.SELECT, Tool.SELECT), (Tool.RECTANGLE, Tool.BRUSH)):
        left, tools.tool, view.hint = [], tool, ""
        for _ in range(2):
            room.press("escape")
            assert room.top() is room.editor
            left.append((bool(tools.selection), tools.tool, "Esc again" in view.hint))
        assert left == [(False, kept, False), (False, kept, True)], tool
    room.point(300, 300)
    room.press("escape")
    assert room.top() is room.editor, "something lay between"
    room.press("escape")
    assert room.shown(Menu).title == "Level"
    room.press("escape", "escape")
    assert room.top() is room.editor, "the menu is left, and asked for once only"


def test_keys_of_the_file_menu_work_while_it_is_open(room: Maker) -> None:
    room.press("escape", "escape")
    room.chord("s", pygame.KMOD_LCTRL)
    assert room.editor.session.is_saved
    assert isinstance(room.top(), EditorScreen)
    room.press("escape", "escape")
    room.press("f2")
    form = room.shown(FormPanel)
    room.type("New")
    assert form.texts[0] == "New", "the name was selected"


def test_undo_does_not_take_back_the_name_that_a_file_has(room: Maker, tmp_path: Path) -> None:
    session = room.editor.session
    room.drag((300, 300))
    session.save(tmp_path / "levels" / "other.txt", name="Other")
    room.chord("z", pygame.KMOD_LCTRL)
    assert (room.draft.name, room.draft.level) == ("Other", ROOM.level)
