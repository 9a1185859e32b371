"""What stays when another level is edited, and what ends with the level; what the buttons at the top lead to."""

import shutil
from pathlib import Path
from threading import current_thread
from typing import Any

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.files import Source, new_source, open_source
from ninja_game.editor.palette import object_of_type
from ninja_game.editor.solver import Certification, search_of
from ninja_game.editor.stamp import everything
from ninja_game.files.user_folder import short_path
from ninja_game.play.editor.commands import IN_MORE
from ninja_game.play.editor.object_list import ObjectList
from ninja_game.play.editor.panels import FilePart
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.menu_screen import Menu
from ninja_game.ui.widgets import Button, Choice
from tests.support.draw_log import drawn
from tests.support.level_maker import ROOM, Maker
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK


def find_field(room: Maker) -> tuple[float, float]:
    x, y, w, _ = room.editor.sides[1].area
    return x + w / 3, y + 12


def test_what_belongs_to_a_level_ends_with_it_and_slopes_stay(room: Maker) -> None:
    session = room.editor.session
    room.press("m", "y")
    room.chord("s", pygame.KMOD_LSHIFT)
    room.press("f3")
    room.mouse(*find_field(room))
    room.type("exit")
    listed = room.editor.sides[1]
    assert isinstance(listed, ObjectList)
    room.frames()
    assert len(listed.shown) == 1
    room.mouse(*find_field(room))
    room.type("ninja")
    room.frames()
    assert (listed.find.text, len(listed.shown)) == ("ninja", 1), "a click selects what was typed"
    brush = session.tools.brush
    assert (brush.symmetry, session.edited.at_pointer.start, brush.slopes) == ("left-right", "standing", True)
    room.press("escape")
    room.press("shift+z", "a", "r")
    session.begin(Source(ROOM))
    room.frames()
    assert (brush.symmetry, session.edited.at_pointer.start, brush.slopes) == ("off", "off", True)
    assert (session.tools.brush.draws_objects, session.tools.tool) == (False, Tool.BRUSH)
    assert session.tools.brush.spec == object_of_type("gold"), "nothing of the hand carries over"
    assert (listed.find.text, len(listed.shown)) == ("", 2)
    room.editor.focus = None
    room.choose_in_menu("Leave the editor")
    room.open("Editor")
    assert room.editor.session.tools.brush.slopes
    assert room.app.settings.slopes
    room.mouse(400, 60, click=False)
    assert "Slopes by themselves. " in drawn(room.app)
    room.mouse(*[widget for widget in room.editor.properties.widgets if isinstance(widget, Choice)][-1].centre)
    room.choose_in_menu("Leave the editor")
    room.open("Editor")
    assert not room.editor.session.tools.brush.slopes, "the button below the tiles is the same switch"


def test_the_editor_begins_with_a_room_without_problems(tmp_path: Path) -> None:
    driver = MenuDriver(tmp_path)
    editor = driver.opened("Editor", EditorScreen)
    assert editor.session.draft == new_source(room=True).draft
    assert (editor.session.examine(), editor.session.is_saved) == ([], True)
    editor.session.close()
    driver.close()


def test_file_opens_its_menu_also_where_something_is_selected(room: Maker) -> None:
    tools = room.editor.session.tools
    tools.tool, tools.selection = Tool.SELECT, everything(room.draft)
    room.choose("File")
    room.choose("New")
    room.choose("A room")
    assert room.draft != ROOM, "nothing is drawn over the level that was left"
    tools.selection = everything(room.draft)
    room.press("escape")
    assert (room.top(), bool(tools.selection)) == (room.editor, False), "the key cancels what is half done first"


def test_more_has_a_button_for_each_tool_of_tests_and_of_what_is_shown(room: Maker) -> None:
    room.choose("More")
    menu = room.shown(Menu)
    hints = [each.hint for each in menu.widgets if isinstance(each, Button)]
    keys = ["Y", "F9", "F8", "T", "F3", "Shift+S", "F4"]
    assert hints == ["Key at the pointer: F6", *(f"Key: {key}" for key in keys), ""]
    assert len(hints) == len(IN_MORE) + 2
    room.choose("What can be reached from the pointer")
    assert room.editor.session.edited.at_pointer.start == "standing"
    room.choose("More")
    room.choose("Test with the ninja at a click")
    room.drag((300, 400))
    ninja = room.shown(PlaytestScreen).attempt.simulation.world.ninja
    assert abs(ninja.x - 300) < 12


def test_the_certificate_of_the_same_level_counts_wherever_it_lies(
    room: Maker, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    levels, name = tmp_path / "levels", "00-0-run-and-hop"
    session, players = room.editor.session, []

    def played(*of: Any) -> Certification:
        players.append(current_thread())
        return search_of(*of)

    monkeypatch.setattr("ninja_game.play.editor.session.search_of", played)
    shutil.copy(PACK / f"{name}.txt", levels / "mine.txt")
    room.editor.commands.open_file(levels / "mine.txt")
    room.wait(lambda: session.certifier.text, "certificate")
    assert current_thread() not in players, "the window does not wait"
    assert session.certifier.text.startswith("Certified: "), "the game's own has one"
    text = (PACK / f"{name}.txt").read_text("utf-8").replace("@", ".", 1)
    (levels / "mine.txt").write_text(text, "utf-8")
    room.editor.commands.open_file(levels / "mine.txt")
    session.edited.known_runs.finish()
    room.frames()
    assert session.certifier.text == "", "of another level"


def test_a_save_says_the_name_and_the_panel_where_the_file_is(room: Maker, tmp_path: Path) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    assert room.app.notice == "Saved, and in the menu Levels: room.txt"
    path, session = tmp_path / "levels" / "room.txt", room.editor.session
    part = next(each for each in room.editor.parts if isinstance(each, FilePart))
    room.mouse(part.area[0] + 9, part.area[1] + 9, click=False)
    assert room.editor.view.hint == short_path(path)
    assert open_source(path).draft == session.draft


def test_a_path_is_said_short(tmp_path: Path) -> None:
    assert short_path(Path.home() / "a" / "b") == str(Path("~", "a", "b"))
    assert short_path(tmp_path).endswith(tmp_path.name)


def test_the_findings_follow_each_other_from_the_first_one(room: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []
    monkeypatch.setattr(room.editor.session, "examine", lambda: ["first", "second", "third"])
    monkeypatch.setattr(room.editor.commands, "show_finding", shown.append)
    for _ in range(4):
        room.editor.commands.run("next_finding")
    assert shown == ["first", "second", "third", "first"]
