"""The picture of the level on the page of messages, and their places in the level."""

import re
from dataclasses import replace
from unittest.mock import patch

import pytest

from ninja_game.editor import packs
from ninja_game.editor.brush import Tool
from ninja_game.editor.message_rows import MessageField, MessageRow
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.formats.messages import MAX_LETTERS, Moment, level_text, parse_messages
from ninja_game.levels.episodes import Mood
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.sheet import message_places
from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import Phase
from ninja_game.runs.message_queue import MessageQueue
from ninja_game.sim.grid import middle_of
from ninja_game.sim.kinds import EXIT, GOLD
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL
from ninja_game.simulation import Simulation
from ninja_game.view.hud import Box, Hud
from tests.support.draw_log import drawn
from tests.support.level_maker import ROOM, Maker
from tests.support.message_page import (
    ALL,
    LONG,
    RIGHT,
    add,
    at_point,
    drag_in_picture,
    in_picture,
    opened,
    said,
    select,
    words,
)


def test_all_places_are_seen_and_a_click_on_one_selects_its_message(room: Maker) -> None:
    room.put_more(ObjectSpec(GOLD, (300.0, 300.0)))
    screen = opened(room, "start: a | at 5,5: b | at 20,12: c | gold: d | switch: e")
    shown = drawn(room.app)
    assert shown.count("circle accent") == 4
    assert len(re.findall(r"frame \S+ .* 120 x 120", shown)) == 2
    for point, selected in (((300.0, 300.0), 3), ((120.0, 540.0), 4), (middle_of((5, 5)), 1)):
        room.mouse(*at_point(*point))
        assert screen.list.index == selected


def test_a_place_begins_at_the_ninja_or_with_what_is_selected_and_is_shown_by_a_click(room: Maker) -> None:
    tools = room.editor.session.tools
    room.mouse(*room.at_cell(7, 9), click=False)
    screen = opened(room)
    add(room, "here")
    room.choose("At the start...")
    room.choose("Near a place")
    assert (screen.edited.rows[0].when, screen.edited.rows[0].detail) == ("at", "2,22")
    room.mouse(*in_picture(20, 4))
    assert screen.edited.rows[0].detail == "20,4"
    assert "text '20,4'" in drawn(room.app)
    room.mouse(*in_picture(0, 4))
    room.choose("OK")
    assert room.draft.says == "at 20,4: here"
    assert list(message_places(room.draft)) == [middle_of((20, 4))]
    both = replace(room.draft, says=f"{room.draft.says} | start: Go")
    assert list(message_places(both)) == [middle_of((20, 4)), (76.0, 524.0)], "beside the ninja"
    gold = with_stamp(both, Stamp({}, (ObjectSpec(GOLD, (60.0, 84.0)),)))
    of_things = replace(gold, says="gold: a | gold: b | switch: c | after 9 s: d")
    switch = next(spec.values[2:] for spec in both.objects if spec.kind == EXIT)
    assert list(message_places(of_things)) == [(76.0, 66.0), (switch[0] + 16, switch[1] - 18)], (
        "and beside gold and switch"
    )
    room.frames()
    assert ("message", (492.0, 108.0)) in room.editor.view.sheet.marks
    room.put_more(ObjectSpec(GOLD, (60.0, 60.0)))
    tools.choose(frozenset({(len(room.draft.objects) - 1, 0)}))
    opened(room)
    room.choose("Add")
    room.choose("Near a place")
    assert "text '2,2'" in drawn(room.app)


def test_a_click_in_the_picture_on_another_message_selects_it(room: Maker) -> None:
    screen = opened(room, "at 5,5: One | at 20,12: Two | start: Go")
    for cell, selected in (((20, 12), 1), ((6, 5), 0), ((10, 10), 0)):
        room.mouse(*in_picture(*cell))
        room.frames()
        assert (screen.list.index, screen.focus) == (selected, screen.form.fields[MessageField.TEXT])
    assert [each.detail for each in screen.edited.rows] == ["10,10", "20,12", ""]
    select(room, 2)
    room.mouse(*in_picture(25, 3))
    assert screen.edited.source == "at 10,10: One | at 20,12: Two | start: Go", "what is said at the start has no place"
    assert "choose Near a place" in room.app.notice


def test_a_frame_is_drawn_moved_and_sized_by_the_mouse_its_other_edges_stay(room: Maker) -> None:
    screen = opened(room, "at 12,12: One | at 3,3: Two")
    for begin, end, frame in (
        ((14.5, 12), (16, 20), (10, 10, 7, 5)), ((12, 9.5), (12, 12), (10, 12, 7, 3)),
        ((16.5, 14.5), (13, 13), (10, 12, 4, 2)), ((9.5, 11.5), (9, 9), (9, 9, 5, 5)),
        ((10, 10), (12, 11), (11, 10, 5, 5)), ((20, 20), (25, 16), (20, 16, 6, 5)),
        ((21, 17), (1, 20), (0, 19, 6, 5)), ((5.5, 21), (14, 15), (0, 19, 15, 5)),
    ):  # fmt: skip
        drag_in_picture(room, begin, end)
        (placed,) = parse_messages(screen.edited.rows[0].source)
        assert placed.frame == frame
        assert f"'{screen.edited.rows[0].detail}'" in drawn(room.app)
    drag_in_picture(room, (20, 10), (22, 11), (20, 10))
    assert screen.edited.rows[0].detail == "20,10 1x1", "a drag back ends where it began"
    room.mouse(*in_picture(25, 5))
    assert screen.edited.source == "at 25,5 1x1: One | at 3,3: Two", "a click puts it there"
    room.mouse(*in_picture(3, 3))
    assert screen.edited.selected is screen.edited.rows[1]


def test_a_message_under_the_mouse_shows_the_frame_that_it_has(room: Maker) -> None:
    room.put_says("at 12,12 8x3: One")
    room.editor.session.tools.tool = Tool.SELECT
    room.mouse(*room.at_cell(12, 12), click=False)
    room.frames(2)
    accent = room.app.theme.palette.accent
    edges = [(8 * CELL, 300), (16 * CELL - 1, 300), (300, 11 * CELL), (300, 14 * CELL - 1)]
    for edge in edges:
        x, y = room.app.canvas.point(*room.at(*edge))
        near = [room.app.surface.get_at((x + i, y + j)) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        assert accent in near, edge


def test_the_selected_message_is_shown_as_the_level_says_it_with_its_letters_counted(room: Maker) -> None:
    screen = opened(room, "start: {jump} jumps | switch: The exit")
    key = room.app.controls.name("jump")
    assert f"text '{key} jumps'" in drawn(room.app)
    assert "'12 of 120'" in drawn(room.app)
    select(room, 1)
    assert f"text '{key} jumps'" not in drawn(room.app)
    screen.edited.rows[1].text = "x" * MAX_LETTERS
    screen.enter()
    select(room, 1)
    room.type("y")
    assert "'120 of 120'" in drawn(room.app)
    assert not room.app.notice, "nothing lies over the buttons"


def test_two_clicks_on_a_bubble_open_its_message_and_draw_nothing(room: Maker) -> None:
    room.put_says(ALL)
    before = room.draft
    room.mouse(*room.at_cell(12, 5), click=False)
    assert "Select drags it: Jump: here'" in drawn(room.app)
    room.drag(middle_of((12, 5)))
    room.drag(middle_of((12, 5)))
    screen = room.shown(MessagesScreen)
    assert (screen.list.index, screen.focus) == (3, screen.form.fields[MessageField.TEXT])
    assert room.draft == before


def test_two_clicks_on_the_bubble_beside_the_ninja_open_its_message(room: Maker) -> None:
    room.put_says("at 9,9: Here | switch: On | start: Go")
    room.frames()
    (bubble,) = (at for at, number in message_places(room.draft).items() if number == 2)
    before = room.draft
    room.mouse(*room.at(*bubble), click=False)
    assert "Double click opens the message: Go'" in drawn(room.app)
    room.drag(bubble)
    room.drag(bubble)
    screen = room.shown(MessagesScreen)
    assert (screen.list.index, screen.focus) == (2, screen.form.fields[MessageField.TEXT])
    assert room.draft == before


def test_the_selected_message_lies_in_the_level_where_it_does_in_play(room: Maker, boxes: list[Box]) -> None:
    screen = opened(room, f"start: {LONG} | at 20,12: Here")
    room.frames()
    start = boxes[-1]
    assert screen.form.fields[MessageField.TEXT].hint == "Enter begins a new line: 3 at most; Ctrl+Enter is OK", (
        "no braces in it"
    )
    select(room, 1)
    screen.redraw = True
    room.frames()
    assert boxes[-1].lines == ["Here"]
    room.press("escape")
    boxes.clear()
    room.press("f5")
    room.frames(2)
    assert boxes[-1] == start, "broken into lines as in play, though the letters of the preview are others"


def test_a_click_in_the_picture_names_the_one_door_that_is_meant(doors: Maker) -> None:
    screen = opened(doors, "lock: One | gold: Two | start: Go")
    assert "A click in the picture on one of them: only when it is that one." in words(doors)
    doors.mouse(*in_picture(11, 22))
    assert screen.edited.rows[0].detail == "11,22"
    assert "text '11,22'" in drawn(doors.app)
    select(doors, 1)
    doors.mouse(*in_picture(18, 22))
    select(doors, 2)
    doors.mouse(*in_picture(13, 22))
    assert screen.edited.source == "lock 11,22: One | gold 18,22: Two | start: Go"
    doors.choose("OK")
    assert doors.draft.says == screen.edited.source

    def beside(column: int) -> tuple[float, float]:
        x, y = middle_of((column, 22))
        return x + 16, y - 18

    assert list(message_places(doors.draft)) == [beside(11), beside(18), beside(3)]
    run = Simulation(doors.draft.level)
    queue, heard_at = MessageQueue(parse_messages("lock 11,22: One | gold 18,22: Two")), dict[str, int]()
    for tick, keys in enumerate(RIGHT):
        run.step_keys(keys)
        queue.on_tick(run.world)
        heard_at.setdefault(queue.text, tick)
    assert heard_at["One"] == 56, "not with the first door"


MOMENTS = (
    "start", "switch", "gold", "death 1", "lock", "lock 11,22", "trap", "gold 18,22", "after 2 s", "at 9,22",
    "at 20,20",
)  # fmt: skip


@pytest.mark.parametrize("moment", MOMENTS)
def test_a_message_of_any_moment_lies_where_the_preview_shows_it(
    doors: Maker, boxes: list[Box], monkeypatch: pytest.MonkeyPatch, moment: str
) -> None:
    opened(doors, f"{moment}: {LONG}")
    doors.frames()
    box = boxes[-1]
    doors.choose("OK")
    doors.press("f5")
    play = doors.shown(PlaytestScreen).play
    if moment == "death 1":
        play.messages.on_death()
        play.messages.at_start()
    monkeypatch.setattr(doors.app.controls, "poll", lambda: 2)
    play.begin()
    while not any(said(play)) and play.phase is Phase.PLAY:
        play.run_ticks(1)
    view = hud_view(play)
    message = view.bubble if moment.startswith("at") else view.message
    assert message
    assert Hud(doors.app.theme).box(message) == box


def test_the_preview_is_the_games_picture_painted_once_with_its_labels(room: Maker, painted: list[str]) -> None:
    opened(room)
    add(room, "all of it")
    shown = drawn(room.app)
    assert "text 'switch'" not in shown, "only what a text names"
    assert shown.count("text 'all of it'") == 3, "in the list, its field and the level"
    assert "text '1 of 16'" in shown
    assert len(painted) == 1
    screen = room.shown(MessagesScreen)
    screen.edited.rows[0].text = "to the {switch} and the {exit}"
    shown = drawn(room.app)
    assert "text 'switch'" in shown
    assert "text 'exit'" in shown
    assert len(painted) == 1
    screen.edited.rows.append(MessageRow(Moment.START, "", "Now the {exit}"))
    screen.select(1)
    shown = drawn(room.app)
    assert "text 'switch'" not in shown, "only what the selected one names"
    assert "text 'exit'" in shown
    screen.select(0)
    screen.edited.rows[0].when = Moment.SWITCH
    shown = drawn(room.app)
    assert "text 'switch'" not in shown, "the exit is open by then"
    assert "text 'exit'" in shown
    assert len(painted) == 2


def test_the_preview_has_the_colours_of_the_levels_place_in_its_pack(maker: Maker, painted: list[str]) -> None:
    app = maker.app
    app.change_settings(palette="by-column")
    folder = packs.new_pack(app.player.folder / "levels", "Hills", "Ann")
    file = packs.new_level(folder, "Hill", "Ann")
    number = packs.new_episode(folder, "First", 1)
    packs.place(folder, [file], number)
    (path,) = folder.glob("*hill.txt")
    maker.open("Editor")
    maker.editor.commands.open_file(path)
    maker.frames(2)
    opened(maker)
    look = app.palette_in(Mood(1, 0)).name
    assert painted == [look]
    assert look != app.palette_in(Mood()).name
    maker.press("escape")
    maker.put(replace(ROOM, says=maker.draft.says))
    maker.press("f5")
    assert maker.shown(PlaytestScreen).mood == Mood(1, 0), "and so has a test"


def test_numbers_in_a_text_are_those_of_the_moment_in_preview_and_play(doors: Maker) -> None:
    opened(doors, "gold: {gold taken} taken and {gold left} left, {deaths} deaths")
    assert "text '1 taken and 1 left, 0 deaths'" in drawn(doors.app)
    assert level_text("{deaths} deaths", str, 0, 0, 1) == "1 death"
    doors.choose("OK")
    doors.press("f5")
    play = doors.shown(PlaytestScreen).play
    play.begin()
    with patch.object(doors.app.controls, "poll", lambda: 2):
        while not play.messages.text:
            play.run_ticks(1)
    message = hud_view(play).message
    assert message
    assert message.text == "1 taken and 1 left, 0 deaths"
