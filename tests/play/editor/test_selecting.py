"""What is selected in the editor is moved, aligned, copied, stamped and deleted."""

from dataclasses import replace
from pathlib import Path

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.files import new_source
from ninja_game.editor.palette import object_of_type
from ninja_game.editor.specs import points
from ninja_game.editor.stamp import Selection, chosen_in, copied
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.editor.stamp_menu import StampMenu
from ninja_game.sim.grid import middle_of
from ninja_game.ui.widgets import Choice
from tests.support.draw_log import drawn
from tests.support.level_maker import Maker


def test_arrows_move_what_the_mouse_has_selected_and_a_key_says_what_select_takes(room: Maker) -> None:
    tools = room.editor.session.tools
    room.press("v")
    room.drag((20, 500), (80, 570))
    room.chord("v", pygame.KMOD_LSHIFT)
    assert (tools.takes, tools.selection.parts) == ("tiles", frozenset())
    pointer = tools.pointer
    room.press("up", "right")
    assert (tools.pointer, room.draft.tile((4, 22)), room.draft.tile((1, 23))) == (pointer, 1, 0)
    room.press("escape", "up")
    assert tools.pointer[1] == pytest.approx(pointer[1] - 24, abs=12), "nothing is selected"


def test_several_objects_are_aligned_spread_moved_and_changed_by_clicks_each_undone_at_once(room: Maker) -> None:
    room.press("shift+g", "z")
    for x, y in ((204, 300), (232, 330), (300, 312)):
        room.drag((x, y))
    room.press("v")
    drawn = room.draft

    def after(button: str, *more: str, by: str = "") -> list[tuple[float, ...]]:
        room.drag((190, 280), (320, 350))
        room.choose(button)
        if by:
            room.fill(by, "Move")
        for each in more:
            room.choose(each)
        made = [spec.values for spec in room.draft.objects[-3:]]
        room.chord("z", pygame.KMOD_LCTRL)
        assert room.draft == drawn, "one step"
        return made

    assert after("Left") == [(204.0, 300.0), (204.0, 330.0), (204.0, 312.0)]
    assert after("Centre") == [(252.0, 300.0), (252.0, 330.0), (252.0, 312.0)]
    assert after("Right") == [(300.0, 300.0), (300.0, 330.0), (300.0, 312.0)]
    assert after("Top") == [(204.0, 300.0), (232.0, 300.0), (300.0, 300.0)]
    assert after("Middle") == [(204.0, 315.0), (232.0, 315.0), (300.0, 315.0)]
    assert after("Bottom") == [(204.0, 330.0), (232.0, 330.0), (300.0, 330.0)]
    assert after("Across") == [(204.0, 300.0), (252.0, 330.0), (300.0, 312.0)]
    assert after("Down") == [(204.0, 300.0), (232.0, 330.0), (300.0, 315.0)]
    assert after("Move...", by="2, -1") == [(252.0, 276.0), (280.0, 306.0), (348.0, 288.0)]
    assert after("Move...", by="-6,0.5px") == [(198.0, 300.5), (226.0, 330.5), (294.0, 312.5)]
    assert after("Kind...", "Launch pad")[1][:2] == (232.0, 330.0)


@pytest.mark.parametrize("by", ["two", "40,0"])
def test_a_move_that_cannot_be_says_why(room: Maker, by: str) -> None:
    room.press("v")
    room.drag((30, 520), (190, 560))
    before = room.draft
    room.choose("Move...")
    room.fill(by, "Move")
    assert (room.draft, room.app.notice.startswith("Not moved: ")) == (before, True)


def test_what_is_pasted_has_its_buttons_and_esc_leads_back_to_what_was_selected(room: Maker) -> None:
    tools = room.editor.session.tools
    room.press("v")
    room.drag((48, 530), (200, 550))
    before = tools.selection
    room.chord("c", pygame.KMOD_LCTRL)
    room.chord("v", pygame.KMOD_LCTRL)
    assert room.editor.properties.widgets[0].text == "A click pastes: 8 cells, 2 objects"  # type: ignore[attr-defined]
    empty = room.editor.properties.widgets[1]
    assert isinstance(empty, Choice)
    for pastes in (True, False):
        room.mouse(*empty.centre)
        assert tools.pastes_empty == pastes
    before_turn = tools.ghost
    room.choose("Mirror")
    assert tools.ghost not in (None, before_turn)
    room.press("escape")
    assert (bool(tools.ghost), tools.selection, tools.tool) == (False, before, "select")


def test_the_line_to_its_switch_is_drawn_for_what_is_selected_though_lines_are_hidden(room: Maker) -> None:
    room.press("t", "v")
    assert "are hidden" in room.editor.view.hint
    assert "beam accent" not in drawn(room.app)
    room.drag((180, 540))
    assert "beam accent" in drawn(room.app)


@pytest.mark.parametrize("how", ["key", "button"])
def test_a_turn_that_leaves_the_level_is_refused_in_words(room: Maker, how: str) -> None:
    tools = room.editor.session.tools
    tools.tool = Tool.SELECT
    tools.selection = Selection((1, 22, 6, 2))
    room.frames(2)
    before = room.draft
    if how == "key":
        room.press("u")
    else:
        room.editor.follow_parts()
        room.choose("Turn")
    assert room.draft is before
    assert "would leave the level" in room.app.notice
    room.press("h")
    assert tools.selection.area == (1, 22, 6, 2), "a mirror image fits"


def test_select_says_that_it_takes_only_tiles_and_takes_all_in_the_next_level(room: Maker) -> None:
    room.chord("v", pygame.KMOD_LSHIFT)
    assert "Takes only tiles: Shift+V" in drawn(room.app)
    room.editor.session.begin(new_source())
    assert room.editor.session.tools.takes == "both"


def test_what_is_selected_is_kept_as_a_stamp_for_every_level(room: Maker, tmp_path: Path) -> None:
    tools = room.editor.session.tools
    tools.history.change(room.draft.with_tiles({(5, 5): 1, (7, 6): 2}))
    room.press("v")
    room.drag((123, 123), (8 * 24 - 3, 7 * 24 - 3))
    before = copied(room.draft, tools.selection)
    room.mouse(*room.button("Stamps").centre)
    room.choose("Keep as a stamp...")
    room.fill("Stairs: 1", "Keep")
    assert [path.name for path in (tmp_path / "stamps").iterdir()] == ["stairs-1.txt"]
    room.editor.session.begin(new_source())
    tools.clipboard = None
    room.mouse(*room.button("Stamps").centre)
    menu = room.app.top
    assert isinstance(menu, StampMenu)
    drawn(room.app)
    assert [text for text, *_ in menu.rows()][:2] == ["stairs-1", "Keep as a stamp..."]
    (picture,) = menu._pictures
    assert picture
    wide, high = picture.get_size()
    assert wide * 2 == high * 3, "its cells alone"
    rock, empty = (picture.get_at((x, high // 4)) for x in (wide // 6, wide // 2))
    assert sum(rock[:3]) < sum(empty[:3])
    room.choose("stairs-1")
    assert tools.ghost == before
    (tmp_path / "stamps" / "stairs-1.txt").write_text("no level")
    room.press("escape")
    room.mouse(*room.button("Stamps").centre)
    assert drawn(room.app), "a broken one has no picture"
    room.choose("stairs-1")
    assert room.app.notice
    assert not tools.ghost


def test_stamps_are_renamed_and_deleted(room: Maker, tmp_path: Path) -> None:
    folder = tmp_path / "stamps"
    folder.mkdir()
    for name in ("hook", "step"):
        (folder / f"{name}.txt").write_text(name)

    def change(name: str, *choices: str) -> None:
        room.mouse(*room.button("Stamps").centre)
        for choice in ("Rename or delete...", name, *choices):
            room.choose(choice)

    change("hook", "Rename...")
    room.fill("Step", "Rename")
    change("step", "Rename...", "Rename")
    assert {path.name: path.read_text() for path in folder.iterdir()} == {"step.txt": "step", "step-2.txt": "hook"}
    change("step", "Delete...", "Cancel")
    assert len(list(folder.iterdir())) == 2
    change("step", "Delete...", "Delete it")
    assert [path.name for path in folder.iterdir()] == ["step-2.txt"]
    room.mouse(*room.button("Stamps").centre)
    (folder / "step-2.txt").unlink()
    for choice in ("Rename or delete...", "step-2", "Delete...", "Delete it"):
        room.choose(choice)
    assert not room.app.notice, "another program has been quicker"


def test_a_middle_click_puts_nothing_that_is_in_hand(room: Maker) -> None:
    tools, before = room.editor.session.tools, room.draft
    room.drag((60, 542))
    room.chord("z", pygame.KMOD_LCTRL)
    tools.tool = Tool.SELECT
    room.drag((40, 530), (70, 560))
    room.chord("c", pygame.KMOD_LCTRL)
    room.chord("v", pygame.KMOD_LCTRL)
    room.drag((300, 300), button=pygame.BUTTON_MIDDLE)
    assert (bool(tools.ghost), room.draft == before) == (True, True)
    room.drag((300, 300))
    assert (bool(tools.ghost), room.draft == before) == (False, False)


def test_without_a_selection_delete_takes_only_what_is_pointed_at(room: Maker) -> None:
    count = len(room.draft.objects)
    room.point(60 + 15, 542)
    room.press("delete")
    assert len(room.draft.objects) == count
    room.point(60 + 9, 542)
    room.press("delete")
    assert len(room.draft.objects) == count - 1


def test_a_frame_over_its_cell_takes_a_launch_pad(room: Maker) -> None:
    tools = room.editor.session.tools
    tools.pick_up(object_of_type("launch pad"))
    tools.brush.spec = tools.brush.spec._replace(values=(*tools.brush.spec.values[:2], 0.0, -1.0))
    room.drag(middle_of((12, 22)))
    pad = len(room.draft.objects) - 1
    assert pad in chosen_in(room.draft, (12, 22, 1, 1)).numbers


def test_grey_buttons_that_align_say_why(room: Maker) -> None:
    tools = room.editor.session.tools
    every = [(number, part) for number, spec in enumerate(room.draft.objects) for part in points(spec)]
    tools.tool = Tool.SELECT
    for text, why, enough in (("Left", "Align needs two", 2), ("Across", "Spread needs three", 3)):
        for count in (enough - 1, enough):
            tools.selection = Selection((2, 2, 3, 3), frozenset(every[:count]))
            room.editor.follow_parts()
            button = next(each for each in room.editor.properties.widgets if getattr(each, "text", "") == text)
            room.mouse(*button.centre, click=False)
            assert (why in drawn(room.app)) == (count < enough)


def test_a_clicked_bubble_is_shown_in_the_panel_from_which_it_opens(room: Maker) -> None:
    editor = room.editor
    editor.session.tools.history.change(replace(room.draft, says="start: Welcome | at 15,12 3x1: Mind the gap here"))
    room.frames()

    def labels() -> list[str]:
        return [getattr(widget, "text", "") for widget in editor.properties.widgets]

    def selected() -> bool:
        return "Selected: message" in labels()

    room.choose("Select")
    room.drag(middle_of((15, 12)))
    assert selected()
    assert "at: Mind the gap here" in labels()
    room.press("escape")
    assert not selected()
    room.drag((60 + 16, 542 - 18))
    assert selected()
    assert "start: Welcome" in labels()
    room.drag((500, 100))
    assert not selected()
    room.drag((60 + 16, 542 - 18))
    room.choose("Brush")
    room.frames()
    assert not selected()
    room.choose("Select")
    room.drag(middle_of((15, 12)))
    room.choose("Open...")
    assert room.shown(MessagesScreen).title == "Messages to the player"
