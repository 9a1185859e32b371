"""Tiles and objects are drawn by mouse, keys and pad; what the palette and the line below say of it."""

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.palette import FAMILIES, OBJECT_TYPES, TILE_KEYS, object_of_type
from ninja_game.editor.specs import BODY_PART
from ninja_game.play.editor.commands import EDITOR_COMMANDS
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.editor.view import LAYOUT
from ninja_game.play.menu_screen import Menu
from ninja_game.sim.kinds import GOLD
from ninja_game.ui.input.keys import SCANCODES
from ninja_game.ui.theme import contains_point
from ninja_game.ui.widgets import Choice
from tests.support.draw_log import drawn, drawn_texts, noted_texts
from tests.support.level_maker import Maker


def test_from_the_menu_a_level_is_drawn_by_mouse(maker: Maker) -> None:
    assert isinstance(maker.open("Editor"), EditorScreen)
    maker.drag((36, 300), (300, 300))
    assert sum(maker.draft.level.tiles) == 12
    maker.drag((60, 300), (84, 300), button=3)
    assert sum(maker.draft.level.tiles) == 10
    drawn = maker.draft
    maker.wheel(1, *maker.at(500, 100))
    maker.wheel(-2, *maker.at(500, 100))
    maker.drag((500, 100), button=6)
    assert maker.draft == drawn, "a notch of the wheel is a button too, which draws nothing"
    maker.drag((36, 300), button=2)
    maker.take("gold")
    maker.drag((200, 200))
    assert maker.draft.objects[0].values == (204.0, 204.0)
    maker.chord("z", pygame.KMOD_LCTRL)
    assert not maker.draft.objects
    maker.chord("y", pygame.KMOD_LCTRL)
    assert maker.draft.objects


def test_keys_choose_draw_and_place(room: Maker) -> None:
    tools = room.editor.session.tools
    room.press("4", "s")
    assert tools.brush.tile == 7
    room.press("shift+n")
    assert tools.brush.draws_objects
    room.press("9", "right", "down")
    before = tools.cell
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=0, scancode=SCANCODES["space"], mod=0, unicode=" "))
    room.press("right", "right")
    pygame.event.post(pygame.Event(pygame.KEYUP, key=0, scancode=SCANCODES["space"], mod=0, unicode=" "))
    room.frames()
    assert tools.cell == (before[0] + 2, before[1])
    assert [room.draft.tile((before[0] + k, before[1])) for k in range(3)] == [1, 1, 1]
    room.press("shift+t", "a", "space")
    assert room.draft.objects[-1].values[2] == 2.0
    room.press("v", "space")
    room.chord("left", pygame.KMOD_LSHIFT)
    assert tools.selected.chosen
    x = tools.selected.chosen.values[0]
    room.press("w")
    assert tools.selected.chosen.values[2] == 3.0
    assert tools.selected.chosen.values[0] == x
    room.press("delete")
    assert len(room.draft.objects) == 2


def test_a_stray_enter_draws_nothing_where_the_mouse_is(room: Maker) -> None:
    before = room.draft
    room.point(300, 300)
    room.press("return")
    assert room.draft is before
    assert "Arrows move the pointer" in room.editor.view.hint
    room.press("right", "return")
    assert room.draft.tile((13, 12)) == 1, "the pointer is the keys' by now"
    drawn_by_keys = room.draft
    room.point(400, 300)
    room.press("space")
    assert room.draft is drawn_by_keys


def test_the_next_exit_does_not_cover_a_switch_that_was_just_placed(maker: Maker) -> None:
    maker.open("Editor")
    maker.press("shift+e")
    maker.drag((300, 300))
    maker.drag((372, 348))
    at_switch = maker.app.surface.copy()
    maker.point(500, 500)
    x, y = maker.app.canvas.point(*maker.at(372, 348))
    shown, seen = (each.subsurface(x - 16, y - 16, 32, 32) for each in (at_switch, maker.app.surface))
    same = pygame.mask.from_threshold(shown, (0, 0, 0), (8, 8, 8, 255), seen)
    assert same.count() > 32 * 32 - 40  # all but the cross of the pointer


def test_a_pad_draws_too(room: Maker) -> None:
    tools = room.editor.session.tools
    a, b, x, right, down = 0, 1, 2, 14, 12
    room.pad(right)
    room.pad(down)
    cell = tools.cell
    room.pad(a)
    assert room.draft.tile(cell) == 1
    room.pad(10)  # the next tile
    assert tools.brush.tile == 5
    room.pad(b)
    room.pad(b)
    assert isinstance(room.top(), Menu)
    room.pad(b)
    assert isinstance(room.top(), EditorScreen)
    room.pad(x)
    room.pad(6)  # the start button tries it out
    assert isinstance(room.top(), PlaytestScreen)


def test_what_has_a_switch_is_not_filled_in(room: Maker) -> None:
    tools = room.editor.session.tools
    tools.tool, tools.brush.draws_objects = Tool.FILL, False
    assert tools.effective_tool == "fill"
    before = len(room.draft.objects)
    tools.pick_up(object_of_type("locked door"))
    assert tools.effective_tool == "brush"
    room.drag((204, 204))
    room.drag((252, 204))
    assert len(room.draft.objects) == before + 1


def test_the_palette_says_what_is_in_hand_or_under_the_mouse(room: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    notices_seen = noted_texts(monkeypatch)
    room.press("4", "s")
    assert "Hollow curve lower right" in notices_seen
    room.take("gold", click=False)
    assert "Gold (Shift+G)" in notices_seen
    notices_seen.clear()
    room.point(300, 300)
    assert "Hollow curve lower right" in notices_seen


def test_slopes_and_spacing_are_set_in_the_panel_and_the_wheel_bends_a_line(room: Maker) -> None:
    tools = room.editor.session.tools
    slopes = [widget for widget in room.editor.properties.widgets if isinstance(widget, Choice)][-1]
    room.mouse(*slopes.centre)
    assert "by themselves" in slopes.options[slopes.index][0]
    room.chord("s", pygame.KMOD_LSHIFT)
    assert "by hand" in slopes.options[slopes.index][0]
    room.mouse(*slopes.centre)
    room.mouse(*room.button("Box").centre)
    room.point(300, 204)
    assert "No slopes: a box keeps its corners" in drawn(room.app)
    room.mouse(*room.button("Brush").centre)
    room.mouse(*slopes.centre)
    room.press("shift+g")
    room.press("i")
    spacing = [widget for widget in room.editor.properties.widgets if isinstance(widget, Choice)][-1]
    room.mouse(*spacing.centre)
    assert tools.brush.spacing == 36.0
    room.point(60, 204)
    tools.press()
    tools.move(276, 204)
    room.wheel(2, *room.at(276, 204))
    assert min(spec.values[1] for spec in room.draft.objects[2:]) == 180.0, "the wheel away from oneself bends it up"
    room.editor.view.release()
    assert tools.brush.spec == object_of_type("gold"), "the palette stayed where it was"


def test_a_fill_with_objects_is_seen_before_the_click(room: Maker) -> None:
    room.editor.session.tools.tool = Tool.RECTANGLE
    room.drag((200, 200), (300, 300))
    room.press("0")
    room.drag((225, 225), (275, 275))
    room.press("f", "shift+g")
    counts = []
    for place in ((250, 250), (210, 250)):
        room.point(*place)
        room.frames()
        counts.append(drawn(room.app).count("sprite gold"))
    room.drag((250, 250))
    assert counts == [9, 16], "in the wall, too"
    assert len([spec for spec in room.draft.objects if spec.kind == GOLD]) == 9


def test_the_wheel_changes_nothing_while_something_is_drawn(maker: Maker) -> None:
    maker.open("Editor")
    tools = maker.editor.session.tools
    maker.press("shift+g")
    tools.tool = Tool.ELLIPSE
    start = maker.app.canvas.point(*maker.at(200, 200))
    pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=start, rel=(0, 0), buttons=(0, 0, 0), touch=False))
    pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=start, button=1, touch=False))
    goal = maker.app.canvas.point(*maker.at(400, 300))
    pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=goal, rel=(0, 0), buttons=(1, 0, 0), touch=False))
    maker.frames()
    spec, drawn = tools.brush.spec, maker.draft
    assert drawn.objects
    maker.wheel(1, *maker.at(400, 300))
    assert (tools.brush.spec, maker.draft) == (spec, drawn)
    maker.press("escape")
    assert not maker.draft.objects, "it was still being drawn"
    assert maker.editor.view.camera.zoom == 1
    maker.wheel(1, *maker.at(400, 300))
    assert maker.editor.view.camera.zoom > 1


def test_a_key_beside_an_entry_of_the_palette_takes_it_whatever_was_used_before(room: Maker) -> None:
    tools, palette = room.editor.session.tools, room.editor.palette
    commands = {key for command in EDITOR_COMMANDS.commands for key in command.keys}
    digits = {str(number): number for number in (*range(10), *range(1, 9))}
    letters = {f"shift+{each.key}": each for each in OBJECT_TYPES}
    assert (len(letters), (digits.keys() | letters.keys()) & commands) == (len(OBJECT_TYPES), set())
    before = (1, 6, object_of_type("gold"), object_of_type("zap drone"), object_of_type("locked door"), None)
    for key in (*digits, *letters):
        for used in before:
            if used is None:
                tools.choose(frozenset({(0, BODY_PART)}))
            else:
                tools.pick_up(used)
            room.press(key)
            assert not tools.selection
            if key in letters:
                assert palette._in_hand is letters[key]
            else:
                assert not tools.brush.draws_objects
                assert tools.brush.tile in TILE_KEYS or tools.brush.tile in FAMILIES[int(key) - 1].tiles
                assert TILE_KEYS.get(tools.brush.tile, key) == key
    lit = set()
    for _ in ("objects", "tiles"):
        texts = [shown for shown in drawn_texts(room.app) if contains_point(LAYOUT.palette, *shown.at)]
        assert sorted(shown.text for shown in texts if len(shown.text) == 1) == sorted(
            [*digits, *(each.key.upper() for each in OBJECT_TYPES)]
        )
        parts = {
            (shown.text, shown.bold, shown.colour)
            for shown in texts
            if shown.text.startswith(("Tiles", "Objects: Shift+"))
        }
        assert len(parts) == 2
        lit |= parts
        room.press("grave")
    assert len(lit) == 4, "the part in use is lit"


def test_the_tool_that_a_press_uses_is_lit(room: Maker) -> None:
    room.press("i")
    for key, lit in (("shift+k", "Brush"), ("shift+g", "Line"), ("shift+n", "Brush"), ("9", "Line")):
        room.press(key)
        bold = {shown.text for shown in drawn_texts(room.app) if shown.bold and shown.text in ("Brush", "Line")}
        assert bold == {lit}, "doors and the ninja are placed one at a time"


def test_the_line_below_says_which_clicks_a_door_takes_and_esc_puts_half_a_door_away(room: Maker) -> None:
    before = room.draft
    room.press("shift+a")
    assert "Click where the automatic door is: it has no switch" in drawn(room.app)
    room.press("shift+k")
    assert "Click where the locked door is, then where its switch is" in drawn(room.app)
    room.drag((300, 300))
    assert "Now the switch of the locked door: click where it is" in drawn(room.app)
    room.press("escape")
    assert "Click where the locked door is" in drawn(room.app)
    assert room.draft == before


def test_the_line_below_says_what_the_symmetry_does_that_m_takes(room: Maker) -> None:
    room.press("m")
    assert "Mirror: left-right: what you draw comes again on the other side" in drawn(room.app)


def test_a_second_exit_is_reported(room: Maker) -> None:
    room.press("shift+e")
    room.drag((300, 300))
    assert not room.app.notice, "its switch is still in hand"
    room.drag((350, 300))
    room.frames(20)
    assert room.app.notice.startswith("2 exits now: each has its own switch")
    room.app.notify("")
    room.drag((300, 400))
    room.press("escape")
    room.chord("z", pygame.KMOD_LCTRL)
    room.frames(20)
    assert not room.app.notice


@pytest.mark.parametrize("other", ["Box", "key", "palette", "test", "undo", "escape"])
def test_a_door_without_its_switch_is_removed_and_that_is_reported(room: Maker, other: str) -> None:
    before, view = room.draft, room.editor.view
    room.press("shift+k")
    room.drag((300, 300))
    assert room.editor.session.tools.placing_switch
    if other == "Box":
        room.choose(other)
    elif other == "palette":
        room.take("gold")
    elif other == "undo":
        room.chord("z", pygame.KMOD_LCTRL)
    else:
        room.press({"key": "9", "test": "f5", "escape": "escape"}[other])
    assert room.draft == before
    assert view.hint == ("Undone: placed 1 locked door" if other == "undo" else "")
    room.point(350, 330)
    assert room.app.notice == ("" if other == "escape" else "The locked door is removed: it had no switch yet")
    if other == "test":
        room.press("escape")
    room.press("shift+k")
    room.drag((300, 300))
    room.drag((400, 300))
    assert len(room.draft.objects) == len(before.objects) + 1


@pytest.mark.parametrize("symmetry", ["off", "left-right"])
def test_flat_ends_of_a_bent_line_with_slopes_are_square(room: Maker, symmetry: str) -> None:
    tools = room.editor.session.tools
    room.editor.session.set_slopes(True)
    tools.tool, tools.brush.symmetry = Tool.LINE, symmetry
    tools.move(60, 480)
    tools.press()
    tools.move(340, 400)
    tools.bend(4)
    tools.release()
    ends = [(2, row) for row in (20, 21)] + [(30, row) for row in (20, 21)] * (symmetry != "off")
    assert [room.draft.tile(cell) for cell in ends] == [1] * len(ends)
    assert any(tile > 1 for tile in room.draft.level.tiles), "slopes between them"
