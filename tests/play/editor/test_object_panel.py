"""The panel of an object's properties, and the list of objects."""

from queue import Queue

import pygame
import pytest

from ninja_game.editor.palette import object_of_type, placed
from ninja_game.editor.playtests import PathPoints
from ninja_game.editor.specs import BODY_PART, SWITCH_PART, points
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.editor.tools import EditorTools
from ninja_game.formats.ascii.places import place_text
from ninja_game.play.editor.object_list import ObjectList
from ninja_game.play.editor.pointer_searches import PointerSearches
from ninja_game.play.editor.view import LAYOUT
from ninja_game.sim.kinds import DRONE
from ninja_game.sim.level import Level
from ninja_game.simulation import Simulation
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.widgets import Label
from tests.support.layout import Layout, noted
from tests.support.level_maker import ROOM, Maker
from tests.support.waiting import LONGEST


def test_letters_typed_into_a_field_are_no_commands(room: Maker) -> None:
    tools = room.editor.session.tools
    room.press("v")
    room.drag((60, 542))
    place = next(widget for widget in room.editor.widgets if getattr(widget, "prompt", "") == "place")
    room.mouse(*place.centre)
    for _ in range(12):
        room.press("backspace")
    room.type("90,5")
    room.type("00px")
    room.frames()
    assert room.draft.objects[0].values == (90.0, 500.0)
    assert tools.tool == "select"
    room.press("return", "b")
    assert tools.tool == "brush"


def test_a_click_on_a_property_changes_the_selected_object(room: Maker) -> None:
    room.press("shift+o")
    room.drag((300, 300))
    room.press("v")
    room.drag((300, 300))
    choice = room.editor.properties.widgets[2]
    room.mouse(*choice.centre)
    assert room.draft.objects[-1].values[2] == 0.0
    room.chord("z", pygame.KMOD_LCTRL)
    assert room.draft.objects[-1].values[2] == 3.0


def test_a_property_of_several_objects_is_changed_by_one_click_and_undone_at_once(room: Maker) -> None:
    room.press("shift+o")
    for x in (204, 252, 300):
        room.drag((x, 300))
    room.press("v")
    room.drag((190, 280), (320, 320))
    before = room.draft
    choice = room.editor.properties.widgets[3]
    room.mouse(*choice.centre)
    changed = [spec.values[2] for spec in room.draft.objects[-3:]]
    assert len(set(changed)) == 1
    assert changed != [spec.values[2] for spec in before.objects[-3:]]
    room.chord("z", pygame.KMOD_LCTRL)
    assert room.draft == before
    room.drag((190, 280), (320, 320))
    room.press("a")
    assert {spec.values[2] for spec in room.draft.objects[-3:]} == {2.0}, "a key turns all of them too"


def test_the_list_of_objects_finds_selects_and_orders_them_by_clicks(room: Maker) -> None:
    room.press("shift+g")
    for x in (204, 252, 300):
        room.drag((x, 300))
    room.press("shift+i")
    room.drag((348, 300))
    listed, tools = room.editor.sides[1], room.editor.session.tools
    assert isinstance(listed, ObjectList)
    shown_before = room.app.surface.copy()
    room.press("f3")
    assert listed.shown == [0, 1, 2, 3, 4, 5]
    room.frames()
    assert pygame.transform.average_color(room.app.surface) != pygame.transform.average_color(shown_before)
    find, rows, earlier, later, every = (listed.widgets[k] for k in (0, 2, 3, 4, 5))
    left, top, _, _ = listed.list.row_area(3)
    room.mouse(left + 50, top + 5)
    assert tools.selection.parts == {(3, 0)}
    room.mouse(*earlier.centre)
    assert [spec.values[0] for spec in room.draft.objects[2:]] == [252, 204, 300, 348]
    assert tools.selection.parts == {(2, 0)}
    room.mouse(*later.centre)
    assert [spec.values[0] for spec in room.draft.objects[2:]] == [204, 252, 300, 348]
    room.mouse(*find.centre)
    room.type("gold 8")
    room.frames(2)
    assert listed.shown == [2], "gold 8,12"
    for _ in range(2):
        room.press("backspace")
    room.frames(2)
    assert listed.shown == [2, 3, 4]
    room.mouse(*every.centre)
    assert tools.selection.numbers == {2, 3, 4}
    room.drag((348, 300))
    assert tools.selection.numbers == {5}, "what is clicked in the level"
    assert rows is listed.list
    toggle = listed.widgets[1]
    room.mouse(*toggle.centre)
    assert not room.editor.view.listing
    there = room.editor.sides[0].widgets[1].centre
    for listing in (True, False):
        room.mouse(*there)
        assert room.editor.view.listing == listing, "a second click leads back"


def test_the_panel_follows_what_is_dragged(room: Maker) -> None:
    room.press("v")
    room.drag((120, 540), (264, 300))
    place = next(
        each for each in room.editor.properties.widgets if isinstance(each, TextEntry) and "switch" in each.hint
    )
    assert place.text == place_text(*points(room.draft.objects[1])[SWITCH_PART])
    assert [each.text for each in room.editor.properties.widgets if isinstance(each, Label)][1:3] == ["at", "switch at"]


def test_the_panel_names_the_type_that_is_in_hand_or_selected(room: Maker) -> None:
    titles = []
    for key in ("a", "r", "k", "a"):
        room.press(f"shift+{key}")
        room.frames()
        titles.append(room.editor.properties.widgets[0].text)  # type: ignore[attr-defined]
    assert titles == ["Draw: automatic door", "Draw: trap door", "Draw: locked door", "Draw: automatic door"]
    room.press("shift+l")
    room.drag((300, 300))
    room.press("v")
    room.drag((500, 400))
    labels = []
    for at in ((310, 310), (500, 400)):
        room.drag(at)
        labels.append(room.editor.properties.widgets[0].text)  # type: ignore[attr-defined]
    assert labels == ["Selected: laser drone", "In hand: laser drone"], "a click in the corner of its cell takes it"


def test_find_has_the_keys_from_the_start_until_it_is_left(room: Maker) -> None:
    tools, view = room.editor.session.tools, room.editor.view
    find = room.editor.sides[1].widgets[0]
    room.press("f3", "x")
    assert (tools.brush.snap, view.listing) == ("half", True), "the list alone takes no keys"
    tools.brush.snap = "cell"
    room.press("f3")
    for leave in ("return", "escape"):
        room.chord("f", pygame.KMOD_LCTRL)
        room.mouse(500, 540, click=False)
        room.wheel(1, 100, 540)
        room.type("gol")
        assert isinstance(find, TextEntry)
        assert (find.text, tools.brush.snap, tools.brush.draws_objects) == ("gol", "cell", False)
        room.press(leave)
        room.type("x")
        assert (room.editor.focus, tools.brush.snap, view.listing) == (None, "half", True)
        tools.brush.snap = "cell"
        find.show("")
        room.press("f3")


def test_all_rows_about_several_drones_have_room_in_their_panel(room: Maker) -> None:
    tools, drone = room.editor.session.tools, object_of_type("zap drone")
    tools.history.change(
        with_stamp(room.draft, Stamp({}, tuple(placed(drone, 100.0 + 48 * k, 100.0, "cell") for k in range(3))))
    )
    tools.choose_all()
    room.frames()
    room.editor.follow_parts()
    _, y, _, h = LAYOUT.properties
    widgets = room.editor.properties.widgets
    assert any(getattr(each, "text", "") == "Kind..." for each in widgets)
    assert max(each.area[1] + each.area[3] for each in widgets) <= y + h - 7
    with noted() as layouts:
        layouts.append(Layout())
        room.app.lay_out()
        room.app.draw()
    assert not layouts[0].shortened


def test_a_drone_in_hand_or_selected_shows_its_round_as_it_will_be(room: Maker) -> None:
    session, drone = room.editor.session, object_of_type("zap drone")
    room.press("shift+z")
    room.point(300, 540)
    room.wait(lambda: session.edited.at_pointer.drone_round, "the round of the drone in hand")
    run = Simulation(with_stamp(room.draft, Stamp({}, (placed(drone, *session.tools.pointer, "cell"),))).level)
    thing = next(each for each in run.world.objects if each.kind == DRONE)
    for place in session.edited.at_pointer.drone_round[:300]:
        run.step_keys(0)
        assert (thing.x, thing.y) == place
    room.frames()
    assert any(isinstance(key, tuple) and key[0] == "route" for key in room.editor.view.sheet.marks)
    room.press("grave")
    room.frames()
    assert not session.edited.at_pointer.drone_round
    room.drag((300, 540))
    assert not session.edited.at_pointer.drone_round
    session.tools.history.change(with_stamp(ROOM, Stamp({}, (placed(drone, 300, 540, "cell"),))))
    session.tools.choose(frozenset({(len(room.draft.objects) - 1, BODY_PART)}))
    room.wait(lambda: session.edited.at_pointer.drone_round, "the round of the drone that is selected")


def test_the_round_of_a_drone_where_it_was_before_is_not_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    started, answers = Queue[tuple[float, ...]](), Queue[PathPoints]()

    def slow_round(level: Level) -> PathPoints:
        started.put(level.objects[1].values[:2])
        return answers.get(timeout=LONGEST)

    monkeypatch.setattr("ninja_game.play.editor.pointer_searches.round_of", slow_round)
    tools, searches = EditorTools(ROOM), PointerSearches()
    tools.pick_up(object_of_type("zap drone"))
    tools.move(204, 204)
    searches.follow(tools)
    assert started.get(timeout=LONGEST) == (204.0, 204.0)
    tools.move(252, 204)
    searches.follow(tools)
    answers.put(((1.0, 1.0),))
    assert started.get(timeout=LONGEST) == (252.0, 204.0)
    assert not searches.drone_round
    answers.put(((2.0, 2.0),))
    searches.rounds.finish(LONGEST)
    assert searches.drone_round == ((2.0, 2.0),)


def test_the_panel_tells_which_letters_change_what_is_in_hand(room: Maker) -> None:
    tools = room.editor.session.tools
    room.press("shift+z")
    before = tools.brush.spec
    room.press("e")
    assert tools.brush.draws_objects
    assert tools.brush.spec != before, "it has a movement"
    labels = [each.text for each in room.editor.properties.widgets if isinstance(each, Label)]
    assert labels[1:7] == ["Q E", "movement", "W A S D", "direction", "N", "seeker"]
