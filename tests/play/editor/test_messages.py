"""What a level says to its player, made row by row in the editor."""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any
from unittest.mock import patch

import pygame
import pytest

from ninja_game.editor import packs
from ninja_game.editor.draft import Draft
from ninja_game.editor.message_rows import Field, MessageRow
from ninja_game.editor.playtests import lead_in, place_before
from ninja_game.editor.solver import search_of
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.messages import MAX_LETTERS, MAX_MESSAGES, WORDS, Moment, level_text, parse_messages
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.levels.episodes import Mood
from ninja_game.play.editor import message_checks, message_picture
from ninja_game.play.editor.message_form import MOMENT_TEXTS
from ninja_game.play.editor.message_picture import PICTURE
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.editor.sheet import message_places
from ninja_game.play.editor.view import LAYOUT
from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import LevelPlay, Phase
from ninja_game.play.menu_screen import Menu
from ninja_game.player.playthrough import Playthrough
from ninja_game.runs.message_queue import MessageQueue, read_ticks
from ninja_game.runtime import NewestJob
from ninja_game.search.certificate import verified_run
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.kinds import EXIT, GOLD, MINE
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.text_entry import TextArea, TextEntry
from ninja_game.ui.theme import TEXT_SIZES, Palette, Theme
from ninja_game.ui.widgets import PAD, TEXT_SIZE as TEXT_PX, Button
from ninja_game.view.hud import Box, Hud
from ninja_game.view.sprites.thumbnail import thumbnail
from tests.support.draw_log import DrawLog, drawn
from tests.support.level_maker import ROOM, Maker, examine

LONG = "to the right and take the gold before you leave and then look for"
"""Its lines are broken elsewhere if they are measured in small letters."""
ALL = (
    "start: {jump} jumps | switch for 9 s: Now the exit | death 3: Wait | at 12,5: Jump: here | after 20 s: Slide"
    " | death 5 for 12 s: Go round | at 3,5 for 1 s: No | gold: Yes"
)


def opened(maker: Maker, says: str | None = None) -> MessagesScreen:
    """The page of messages, in a level that says something first."""
    if says is not None:
        check_says(maker, says)
    maker.chord("m", pygame.KMOD_LSHIFT)
    maker.frames(2)
    return maker.shown(MessagesScreen)


def said(play: LevelPlay) -> list[str]:
    """What the level says now, and what a place says beside it."""
    return [queue.text for queue in play.queues]


def check_says(maker: Maker, says: str) -> None:
    maker.editor.session.tools.history.change(replace(maker.draft, says=says))
    maker.frames()


def add(maker: Maker, *texts: str) -> None:
    for text in texts:
        maker.choose("Add")
        maker.choose("At the start")
        maker.type(text)


def show(screen: MessagesScreen, *messages: MessageRow) -> None:
    """Other messages on the page."""
    screen.edited.rows = [*messages]
    screen.enter()


def texts_of(screen: MessagesScreen) -> str:
    return "".join(message.text for message in screen.edited.rows)


def select(maker: Maker, row: int, field: Field = Field.TEXT) -> None:
    """Click on a message in the list, then into a field of it."""
    screen = maker.shown(MessagesScreen)
    x, y, _, h = screen.list.row_area(row)
    maker.mouse(x + 60, y + h / 2)
    maker.mouse(*screen.form.fields[field].centre)
    maker.frames()


def words(maker: Maker) -> str:
    """All texts that are drawn now, one after the other."""
    return " ".join(re.findall(r"""^text ['"](.*)['"] at""", drawn(maker.app), re.MULTILINE))


def with_time_in_hand(maker: Maker) -> MessagesScreen:
    """The page with one message, whose time is still automatic, and has the focus."""
    screen = opened(maker)
    add(maker, "on")
    assert "text 'auto (12 s)'" in drawn(maker.app)
    select(maker, 0, Field.TIME)
    return screen


class AtOnce(NewestJob[Any, Any]):
    """Answers before the page goes on."""

    def ask(self, job: object) -> None:
        self.result = self._work(job)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(message_checks, "NewestJob", AtOnce)


@pytest.fixture
def painted(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Palettes of the pictures that previews have had painted."""
    names: list[str] = []

    def paint(level: Level, palette: Palette, width: int, *, opened: bool) -> pygame.Surface:
        names.append(palette.name)
        return thumbnail(level, palette, width, opened=opened)

    monkeypatch.setattr(message_picture, "thumbnail", paint)
    return names


@pytest.fixture
def boxes(monkeypatch: pytest.MonkeyPatch) -> list[Box]:
    """Where messages of the level are drawn from now on."""
    made: list[Box] = []

    def draw(_: Hud, __: pygame.Surface, box: Box, *___: object) -> pygame.Rect:
        made.append(box)
        return pygame.Rect(0, 0, 1, 1)

    monkeypatch.setattr(Hud, "draw_message", draw)
    return made


def in_picture(column: float, row: float) -> tuple[float, float]:
    """Where the preview shows the middle of a cell."""
    left, top, wide, _ = PICTURE
    return left + (24 * column + 12) * wide / 792, top + (24 * row + 12) * wide / 792


def test_messages_are_made_row_by_row_and_a_test_says_them(room: Maker) -> None:
    room.choose_in_menu("Messages...")
    room.shown(MessagesScreen)
    add(room, "run")
    add(room, "")
    select(room, 1, Field.MOMENT)
    room.choose("Exit opens")
    add(room, "on")
    select(room, 1)
    room.type("out")
    room.chord("return", pygame.KMOD_LCTRL)
    assert room.draft.says == "start: run | switch: out | start: on"
    assert isinstance(room.top(), EditorScreen)
    room.chord("z", pygame.KMOD_LCTRL)
    assert room.draft.says == ""
    room.chord("y", pygame.KMOD_LCTRL)
    room.press("f5")
    assert [each.text for each in room.shown(PlaytestScreen).play.playthrough.messages()] == ["run", "out", "on"]


def test_what_is_typed_goes_to_the_text_of_the_row_and_changes_no_moment(room: Maker) -> None:
    screen = opened(room)
    add(room, "")
    screen.focus = screen.list
    room.type("a b")
    assert (screen.edited.rows[0].when, screen.edited.rows[0].text) == ("start", "a b")


def test_all_moments_are_listed_and_one_is_taken(room: Maker) -> None:
    screen = opened(room)
    add(room, "a")
    for when, (name, _) in MOMENT_TEXTS.items():
        before = screen.edited.rows[0].when
        room.choose(f"{MOMENT_TEXTS[before][0]}...")
        listed = [getattr(each, "text", "") for each in room.shown(Menu).widgets]
        assert listed == [*(each for each, _ in MOMENT_TEXTS.values()), "Cancel"]
        room.choose("Cancel")
        assert screen.edited.rows[0].when == before
        room.choose(f"{MOMENT_TEXTS[before][0]}...")
        room.choose(name)
        assert (screen.edited.rows[0].when, screen.edited.rows[0].text) == (when, "a")


def test_those_of_one_moment_are_numbered_with_their_seconds(room: Maker) -> None:
    draft = with_stamp(room.draft, Stamp({}, (ObjectSpec(GOLD, (60.0, 60.0)),)))
    room.editor.session.tools.history.change(replace(draft, says="start: a | gold: b | start: c | switch: d"))
    opened(room)
    for row, texts in enumerate((("No. 1 of 2", "auto (6 s)"), ("auto (6 s)",), ("No. 2 of 2",), ("auto (12 s)",))):
        select(room, row)
        assert all(f"text '{text}'" in drawn(room.app) for text in texts)


def test_a_message_stays_as_long_as_it_says_and_without_a_number_as_long_as_usual(room: Maker) -> None:
    screen = with_time_in_hand(room)
    room.type("0")
    room.choose("OK")
    assert screen.checks.refused
    assert screen.focus is screen.form.fields[Field.TIME]
    room.press("backspace")
    room.type("25")
    room.press("return")
    assert room.draft.says == "start for 25 s: on"
    assert opened(room).edited.source == room.draft.says


def test_all_messages_are_seen_in_a_list_in_which_one_is_selected(room: Maker) -> None:
    screen = opened(room)
    add(room, *"abcdefghijklmnop")
    assert not room.button("Add").enabled
    assert (screen.list.index, screen.focus) == (15, screen.form.fields[Field.TEXT])
    assert all(re.search(rf"text '{letter}' at 170,.* size 9", drawn(room.app)) for letter in "abcdefghijklmnop")
    screen.edited.rows[5].text = ""
    x, y, _, h = screen.list.row_area(3)
    room.mouse(x + 60, y + h / 2)
    assert (screen.list.index, screen.focus) == (3, screen.list)
    room.press("down", "down", "up")
    assert (screen.list.index, getattr(screen.form.fields[Field.TEXT], "text", "")) == (4, "e")
    room.mouse(x + 60, y + h / 2, click=False)
    assert screen.list.index == 4, "the way of the mouse to the fields selects nothing"
    room.mouse(x + 60, y + h / 2)
    assert (screen.list.index, screen.focus) == (3, screen.list)
    room.mouse(x + 60, y + h / 2)
    assert (screen.list.index, screen.focus) == (3, screen.form.fields[Field.TEXT]), "a second click leads to the text"
    for notches, number in ((-1, 4), (1, 3), (2, 1), (9, 0)):
        room.wheel(notches, x + 9, 450)
        assert screen.list.index == number
    room.wheel(-1, *in_picture(9, 9))
    assert screen.list.index == 0
    room.choose("OK")
    assert (screen.list.index, screen.focus) == (5, screen.form.fields[Field.TEXT]), "what is wrong is shown"
    room.choose("Remove")
    assert texts_of(screen) == "abcdeghijklmnop"


def test_a_line_of_the_list_says_when_and_marks_what_is_wrong_or_late(
    room: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: bytes(400)))
    opened(room, "at 12,5 3x1!: Jump | death 2: No | trap: Shut | after 1 s: Go | after 2 s: On")
    shown = drawn(room.app)
    labels = "At 12,5 3x1", "Death 2", "Trap", "After 1 s", "After 2 s"
    assert [re.findall(rf"text '{label}' at 78,.* (\w+)$", shown, re.MULTILINE) for label in labels] == [
        ["text"], ["text"], ["bad"], ["text"], ["text"]
    ]  # fmt: skip
    assert len(re.findall("^text '!' at 71,", shown, re.MULTILINE)) == 1
    assert len(re.findall("^polygon bad", shown, re.MULTILINE)) == 1
    assert len(re.findall("^circle faint .* width 1.5", shown, re.MULTILINE)) == 1


def test_all_places_are_seen_and_a_click_on_one_selects_its_message(room: Maker) -> None:
    draft = with_stamp(room.draft, Stamp({}, (ObjectSpec(GOLD, (300.0, 300.0)),)))
    says = "start: a | at 5,5: b | at 20,12: c | gold: d | switch: e"
    room.editor.session.tools.history.change(replace(draft, says=says))
    screen = opened(room)
    shown = drawn(room.app)
    assert shown.count("circle accent") == 4
    assert len(re.findall(r"frame \S+ .* 120 x 120", shown)) == 2
    for point, selected in (((300.0, 300.0), 3), ((120.0, 540.0), 4), ((132.0, 132.0), 1)):
        left, top, wide, _ = PICTURE
        room.mouse(left + point[0] * wide / 792, top + point[1] * wide / 792)
        assert screen.list.index == selected


def test_a_word_that_is_not_known_is_named_at_its_field_while_it_is_typed(room: Maker) -> None:
    screen = opened(room)
    add(room, "")
    for text in ("{fl", "y}"):
        assert "There is no" not in drawn(room.app)
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=text))
        room.frames()
    assert "There is no {fly}: the words are below" in words(room)
    assert screen.focus
    assert screen.focus.hint.startswith("{fly} is not one of {left}, ")


def test_all_messages_fit_into_the_page_and_one_is_removed(room: Maker) -> None:
    twice = f"{ALL} | {ALL}"
    screen = opened(room, twice)
    assert len(screen.edited.rows) == MAX_MESSAGES
    assert not room.button("Add").enabled
    room.choose("OK")
    assert room.draft.says == twice
    opened(room)
    room.choose("Remove")
    room.choose("OK")
    assert room.draft.says == twice.partition(" | ")[2]
    opened(room)
    room.choose("Remove")
    room.choose("Cancel")
    room.choose("Discard changes")
    assert room.draft.says == twice.partition(" | ")[2]


@pytest.mark.parametrize(
    "message, in_detail, wanted",
    [
        (MessageRow(Moment.START, "", " "), False, "Type what is said"),
        (MessageRow(Moment.START, "", "{fly} flies"), False, "{fly} is not one of {left}"),
        (MessageRow(Moment.AT, "32,1", "x"), True, "31,23"),
        (MessageRow(Moment.AFTER, "0", "x"), True, "How many seconds"),
    ],
)
def test_what_is_wrong_keeps_the_focus_and_is_said(
    room: Maker, message: MessageRow, in_detail: bool, wanted: str
) -> None:
    screen = opened(room)
    show(screen, MessageRow(Moment.START, "", "fine"), message)
    room.choose("OK")
    assert room.top() is screen
    assert (wanted if message.unknown == "" else "There is no {fly}") in words(room)
    assert not room.app.notice, "nothing lies over the buttons"
    field = screen.focus
    assert isinstance(field, TextEntry)
    assert field.text == (message.detail if in_detail else message.text)
    assert not room.draft.says


def test_a_place_begins_at_the_ninja_or_with_what_is_selected_and_is_shown_by_a_click(room: Maker) -> None:
    tools = room.editor.session.tools
    room.mouse(*room.at(24 * 7 + 5, 24 * 9 + 5), click=False)
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
    assert list(message_places(room.draft)) == [(24 * 20 + 12, 24 * 4 + 12)]
    both = replace(room.draft, says=f"{room.draft.says} | start: Go")
    assert list(message_places(both)) == [(24 * 20 + 12, 24 * 4 + 12), (76.0, 524.0)], "beside the ninja"
    of_things = replace(
        with_stamp(both, Stamp({}, (ObjectSpec(GOLD, (60.0, 84.0)),))),
        says="gold: a | gold: b | switch: c | after 9 s: d",
    )
    switch = next(spec.values[2:] for spec in both.objects if spec.kind == EXIT)
    assert list(message_places(of_things)) == [(76.0, 66.0), (switch[0] + 16, switch[1] - 18)], (
        "and beside gold and switch"
    )
    room.frames()
    assert ("message", (492.0, 108.0)) in room.editor.view.sheet.marks
    tools.history.change(with_stamp(room.draft, Stamp({}, (ObjectSpec(GOLD, (60.0, 60.0)),))))
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
        assert (screen.list.index, screen.focus) == (selected, screen.form.fields[Field.TEXT])
    assert [each.detail for each in screen.edited.rows] == ["10,10", "20,12", ""]
    select(room, 2)
    room.mouse(*in_picture(25, 3))
    assert screen.edited.source == "at 10,10: One | at 20,12: Two | start: Go", "what is said at the start has no place"
    assert "choose Near a place" in room.app.notice


def drag_in_picture(maker: Maker, begin: tuple[float, float], *ends: tuple[float, float]) -> None:
    """Drag from the middle of a cell over others."""
    kinds = [pygame.MOUSEBUTTONDOWN, *[pygame.MOUSEMOTION] * len(ends), pygame.MOUSEBUTTONUP]
    for kind, cell in zip(kinds, (begin, *ends, ends[-1]), strict=True):
        more = {"rel": (0, 0), "buttons": (1, 0, 0)} if kind == pygame.MOUSEMOTION else {"button": 1}
        pygame.event.post(pygame.Event(kind, pos=maker.app.canvas.point(*in_picture(*cell)), touch=False, **more))
    maker.frames()


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
    check_says(room, "at 12,12 8x3: One")
    room.editor.session.tools.tool = "select"
    room.mouse(*room.at(12 * 24 + 12, 12 * 24 + 12), click=False)
    room.frames(2)
    accent = room.app.theme.palette.accent
    edges = [(8 * 24, 300), (16 * 24 - 1, 300), (300, 11 * 24), (300, 14 * 24 - 1)]
    for edge in edges:
        x, y = room.app.canvas.point(*room.at(*edge))
        near = [room.app.surface.get_at((x + i, y + j)) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        assert accent in near, edge


def test_a_message_is_tried_from_just_before_it_and_esc_comes_back(room: Maker) -> None:
    screen = opened(room, "start: Go | at 20,22: Here | switch: Out")
    places = []
    for row in range(3):
        select(room, row)
        room.choose("Test")
        trying = room.shown(PlaytestScreen)
        places.append((trying.attempt.simulation.ninja.x, len(trying.play.playthrough.messages())))
        room.press("escape")
        assert room.top() is screen
    assert places == [(60.0, 3), (17 * 24 + 12.0, 3), (2 * 24 + 12.0, 3)]
    screen.edited.rows[1].detail = "20,22 9x5"
    select(room, 1)
    room.choose("Test")
    assert room.shown(PlaytestScreen).attempt.simulation.ninja.x == 15 * 24 + 12.0, "before its wider frame"
    room.press("escape")
    screen.edited.rows[0].text = ""
    room.choose("Test")
    assert room.top() is screen
    assert "Type what is said" in words(room)


def test_a_test_of_a_message_begins_where_the_ninja_lives_on_the_way_to_it(room: Maker) -> None:
    mines = tuple(ObjectSpec(MINE, (24 * column + 12.0, 540.0)) for column in range(8, 12))
    block = Stamp(dict.fromkeys([(column, 19) for column in range(14, 26)], 1))
    draft = with_stamp(with_stamp(room.draft, block), Stamp({}, mines))
    # On a block: from the side of the start, though both sides are alike.
    assert place_before(draft, (19 * 24 + 12.0, 18 * 24 + 12.0)) == (16 * 24 + 12.0, 18 * 24 + 12.0)
    assert place_before(draft, (5 * 24 + 12.0, 540.0)) is None, "that near is the level's start"
    # Both sides of this one are deadly, so it is the level's start.
    assert place_before(draft, (14 * 24 + 12.0, 540.0)) == (17 * 24 + 12.0, 540.0)
    assert place_before(draft, (8 * 24 + 12.0, 540.0)) == (5 * 24 + 12.0, 540.0)
    wide, high = (18 * 24 + 12.0, 18 * 24 + 12.0), (19 * 24 + 12.0, 17 * 24 + 12.0)
    assert place_before(draft, wide, (7, 1)) == (14 * 24 + 12.0, 18 * 24 + 12.0), "outside its frame"
    assert place_before(draft, high, (1, 7)) == (17 * 24 + 12.0, 18 * 24 + 12.0), "on the floor beside its frame"
    shaft = with_stamp(
        Draft(DOORS), Stamp(dict.fromkeys([(column, row) for column in (6, 8) for row in range(12, 24)], 1))
    )
    floor = with_stamp(shaft, Stamp({(7, 16): 1}))
    assert place_before(floor, (7 * 24 + 12.0, 14 * 24 + 12.0)) == (7 * 24 + 12.0, 15 * 24 + 12.0), "between walls"
    tight = with_stamp(draft, Stamp({}, (ObjectSpec(MINE, (5 * 24 + 12.0, 540.0)),)))
    assert place_before(tight, (8 * 24 + 12.0, 540.0)) == (6 * 24 + 12.0, 540.0), "nearer, without room"


def test_a_test_in_a_known_run_begins_a_second_before_in_the_air_if_it_last_stood_long_before() -> None:
    level = parse_ascii_level(
        "\n".join(["ninja-game level 1", "|@" + "." * 30 + "|", *["|" + "." * 31 + "|"] * 22])
    ).level
    run, slides = Simulation(level), bytes([1]) * 600
    run.step_keys(1)
    while run.ninja.in_air:
        run.step_keys(1)
    landed = run.tick
    assert landed > 4 * TICKS_PER_SECOND, "down the wall"
    assert len(lead_in(level, slides, landed)) == landed - TICKS_PER_SECOND
    assert not lead_in(level, slides, 3 * TICKS_PER_SECOND), "the start is near"
    jumps = bytes([1]) * landed + with_press_bits(bytes([4]) * 20) + bytes(90)
    assert len(lead_in(level, jumps, landed + TICKS_PER_SECOND + 15)) == landed + 1, "where it stood"


def test_a_message_lies_where_it_will_in_play_wherever_its_test_begins(room: Maker) -> None:
    session = room.editor.session
    session.tools.history.change(replace(room.draft, says="at 21,19: A text that lies beside the place"))
    run = verified_run(ROOM.level, with_press_bits(bytes([2]) * 100))
    session.certifier.certification = search_of(room.draft.level, run)
    screen = opened(room)
    drawn(room.app)
    assert screen.checks._known_run.result
    shown = screen.checks._known_run.result[2]
    assert len(shown) > 3, "the run's way too"
    room.choose("Test")
    trying = room.shown(PlaytestScreen)
    assert trying.attempt.simulation.ninja.x > 300
    assert trying.play.things == shown
    room.press("escape")
    room.choose("Cancel")
    session.save(room.app.player.folder / "levels" / "said.txt")
    session.certify_file()
    entry = session.entry
    assert entry
    _, way = Playthrough(room.app.player, entry).beginning()
    assert way == session.certifying_inputs != b""


def test_for_a_level_without_a_file_no_packs_are_read(room: Maker) -> None:
    with patch.object(room.app.player.catalogue, "packs") as read:
        opened(room)
    assert not read.called


def test_a_level_about_which_something_is_said_keeps_its_messages(room: Maker) -> None:
    check_says(room, ALL)
    room.press("f2")
    room.fill("Other", "OK")
    assert (room.draft.name, room.draft.says) == ("Other", ALL)
    assert parse_messages(room.draft.says)


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


@pytest.mark.parametrize("button", [False, True])
def test_escape_and_cancel_ask_about_changed_messages(room: Maker, button: bool) -> None:
    def leave() -> None:
        if button:
            room.choose("Cancel")
        else:
            room.press("escape")

    for answer, says in (("Cancel", ""), ("Discard changes", ""), ("Keep the changes", "start: on")):
        screen = opened(room)
        leave()
        assert isinstance(room.top(), EditorScreen), "nothing is changed"
        screen = opened(room)
        add(room, "on")
        leave()
        room.choose(answer)
        if answer == "Cancel":
            assert room.top() is screen
            leave()
            room.choose("Discard changes")
        assert isinstance(room.top(), EditorScreen)
        assert room.draft.says == says


def test_two_clicks_on_a_bubble_open_its_message_and_draw_nothing(room: Maker) -> None:
    check_says(room, ALL)
    before = room.draft
    room.mouse(*room.at(24 * 12 + 12, 24 * 5 + 12), click=False)
    assert "Select drags it: Jump: here'" in drawn(room.app)
    room.drag((24 * 12 + 12, 24 * 5 + 12))
    room.drag((24 * 12 + 12, 24 * 5 + 12))
    screen = room.shown(MessagesScreen)
    assert (screen.list.index, screen.focus) == (3, screen.form.fields[Field.TEXT])
    assert room.draft == before


def test_two_clicks_on_the_bubble_beside_the_ninja_open_its_message(room: Maker) -> None:
    room.editor.session.tools.history.change(replace(room.draft, says="at 9,9: Here | switch: On | start: Go"))
    room.frames()
    (bubble,) = (at for at, number in message_places(room.draft).items() if number == 2)
    before = room.draft
    room.mouse(*room.at(*bubble), click=False)
    assert "Double click opens the message: Go'" in drawn(room.app)
    room.drag(bubble)
    room.drag(bubble)
    screen = room.shown(MessagesScreen)
    assert (screen.list.index, screen.focus) == (2, screen.form.fields[Field.TEXT])
    assert room.draft == before


def test_the_selected_message_lies_in_the_level_where_it_does_in_play(room: Maker, boxes: list[Box]) -> None:
    screen = opened(room, f"start: {LONG} | at 20,12: Here")
    room.frames()
    start = boxes[-1]
    assert screen.form.fields[Field.TEXT].hint == "Enter begins a new line: 3 at most; Ctrl+Enter is OK", (
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


DOORS = parse_ascii_level(
    "\n".join(
        ["ninja-game level 1", *["|" + "." * 31 + "|"] * 21, "|..@.o.x.&.&.!....o......X......|", "|" + "." * 31 + "|",
         "exit 25,22 switch 7,22", "locked door 31,9 top switch 9,22", "locked door 31,5 top switch 11,22",
         "trap door 31,7 top switch 13,22"]
    )
).level  # fmt: skip
"""Gold, the switches of the exit, of two locked doors and of a trap door, gold and the exit, right of the ninja."""

RIGHT = with_press_bits(bytes([2]) * 125)
"""Passes it: the exit opens in tick 36, the doors unlock in 46 and 56, the trap closes in 66."""


@pytest.fixture
def doors(room: Maker, monkeypatch: pytest.MonkeyPatch) -> Maker:
    """In the level DOORS with a floor; RIGHT is known to pass it."""
    floor = Stamp(dict.fromkeys([(column, 23) for column in range(1, 32)], 1))
    draft = with_stamp(Draft(DOORS, "Doors", "me"), floor)
    room.editor.session.tools.history.change(draft)
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: RIGHT))
    return room


@pytest.mark.parametrize(
    "says, x",
    [("lock: Now", 9), ("lock 11,22: Now", 11), ("trap: Now", 13), ("gold 18,22: Now", 18), ("at 20,22 1x1: Now", 20)],
)
def test_a_test_begins_in_the_known_run_a_second_before_the_message(
    doors: Maker, monkeypatch: pytest.MonkeyPatch, says: str, x: int
) -> None:
    monkeypatch.setattr(doors.app.controls, "poll", lambda: 2)
    opened(doors, f"death 1: Go | {says}")
    select(doors, 1)
    doors.choose("Test")
    trying = doors.shown(PlaytestScreen)
    play = trying.play
    for _ in range(2):
        began = play.attempt.simulation.tick
        assert play.phase is Phase.READY
        assert bytes(play.attempt.inputs) == RIGHT[:began]
        play.begin()
        while "Now" not in said(play) and play.attempt.outcome == "running":
            play.run_ticks(1)
        assert 40 <= play.attempt.simulation.tick - began + (began == 0) * 40 <= 60
        assert abs(play.attempt.simulation.ninja.x - 24 * x - 12) < 40
        play.retry()
    play.begin()
    while play.attempt.outcome != "exit":
        play.run_ticks(1)
    assert play.notices == ["It can be passed"], "its beginning was the solver's"


def test_a_test_of_what_is_said_after_deaths_or_seconds_begins_there(doors: Maker) -> None:
    opened(doors, "start: Go | death 3: Three | after 9 s: Nine")
    texts = []
    for row in (1, 2):
        select(doors, row)
        doors.choose("Test")
        trying = doors.shown(PlaytestScreen)
        texts.append((trying.play.messages.text, trying.attempt.simulation.tick))
        doors.press("escape")
    assert texts == [("Three", 0), ("Go", 8 * 40 - 1)], "the run is over by then: the ninja stands"


def test_without_a_known_run_a_test_goes_on_from_the_last_one(doors: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(doors.editor.session), "certifying_inputs", property(lambda _: b""))
    opened(doors, "trap: Now")
    doors.choose("Test")
    assert doors.shown(PlaytestScreen).attempt.simulation.ninja.x == 24 * 10 + 12.0, "beside the switch"
    doors.press("escape")
    doors.editor.session.add_playtest(doors.draft.level, RIGHT, over=True)
    doors.choose("Test")
    assert bytes(doors.shown(PlaytestScreen).attempt.inputs) == RIGHT[:26]


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
    assert list(message_places(doors.draft)) == [(11 * 24 + 28, 522.0), (18 * 24 + 28, 522.0), (100.0, 522.0)]
    run = Simulation(doors.draft.level)
    queue, heard_at = MessageQueue(parse_messages("lock 11,22: One | gold 18,22: Two")), dict[str, int]()
    for tick, keys in enumerate(RIGHT):
        run.step_keys(keys)
        queue.on_tick(run.world)
        heard_at.setdefault(queue.text, tick)
    assert heard_at["One"] == 56, "not with the first door"


def test_messages_are_copied_and_moved_by_buttons_and_keys(room: Maker) -> None:
    screen = opened(room, "start: a | switch: b | after 9 s for 4 s: c")
    select(room, 2)
    room.choose("Up")
    assert (texts_of(screen), screen.list.index) == ("acb", 1)
    room.choose("Copy")
    assert (texts_of(screen), screen.list.index) == ("accb", 2)
    assert screen.edited.source == "start: a | after 9 s for 4 s: c | after 9 s for 4 s: c | switch: b"
    select(room, 2)
    room.type("d")
    assert texts_of(screen) == "accdb", "a copy of its own"
    room.chord("down", pygame.KMOD_LCTRL)
    assert (texts_of(screen), screen.list.index, screen.focus) == ("acbcd", 3, screen.form.fields[Field.TEXT])
    room.chord("down", pygame.KMOD_LCTRL)
    assert texts_of(screen) == "acbcd", "it is the last"
    with patch.object(pygame.key, "get_mods", lambda: pygame.KMOD_SHIFT):
        room.chord("up", pygame.KMOD_LCTRL | pygame.KMOD_LSHIFT)
    assert (texts_of(screen), screen.list.index) == ("cdacb", 0)
    room.chord("d", pygame.KMOD_LCTRL)
    assert (texts_of(screen), screen.list.index) == ("cdcdacb", 1)
    screen.focus = next(widget for widget in screen.widgets if getattr(widget, "text", "") == "Down")
    room.press("return", "return")
    assert (texts_of(screen), screen.list.index) == ("cdaccdb", 3), "the button keeps the focus"
    for _ in range(MAX_MESSAGES):
        room.chord("d", pygame.KMOD_LCTRL)
    assert len(screen.edited.rows) == MAX_MESSAGES
    screen.edited.rows = []
    screen.enter()
    assert [room.button(text).enabled for text in ("Add", "Copy", "Up", "Down", "Remove")] == [True] + 4 * [False]
    room.chord("up", pygame.KMOD_LCTRL)


def test_seconds_are_called_automatic_until_they_are_set(room: Maker) -> None:
    screen = with_time_in_hand(room)
    room.type("7")
    screen.edited.rows[0].text = "long " * 24
    screen.enter()
    assert "auto" not in drawn(room.app)
    assert screen.edited.rows[0].time == "7"


@pytest.mark.parametrize("size", TEXT_SIZES.values())
@pytest.mark.parametrize("width", [792, 1584])
def test_names_of_moments_and_buttons_are_never_cut(room: Maker, size: int, width: int) -> None:
    screen = opened(room, "lock for 1 s: a | start: b | at 1,1: c | gold: d | switch: e")
    theme = Theme(room.app.theme.palette, Canvas((width, width * 600 // 792)), size)
    names = [f"{name}..." for name, _ in MOMENT_TEXTS.values()]
    moment = screen.form.fields[Field.MOMENT]
    buttons = [(text, moment) for text in names] + [(w.text, w) for w in screen.widgets if isinstance(w, Button)]
    for text, button in buttons:
        assert isinstance(button, Button)
        assert theme.fit(text, button.area[2] - 2 * PAD, button.size, bold=True) == text
    entries = [w for w in screen.widgets if isinstance(w, TextEntry) and not isinstance(w, TextArea)]
    assert all(theme.fit(w.prompt, w.area[2] - 2 * PAD, TEXT_PX) == w.prompt for w in entries)


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


RUN = f"in the known run ({len(RIGHT) / TICKS_PER_SECOND:.1f} s)"


def test_a_message_that_is_lost_to_another_is_a_problem_with_its_place(doors: Maker) -> None:
    session = doors.editor.session
    session.certifier.certification = search_of(doors.draft.level, verified_run(doors.draft.level, RIGHT))
    check_says(doors, "trap: Two | at 15,22!: Three | at 18,22: Four | at 9,22: Five | gold!: One | death 1: Six")
    late = [finding for finding in session.examine() if finding.code == "late-message"]
    assert [(finding.text, finding.cells) for finding in late] == [
        (f"the message '{text}' is not shown {RUN}: others are read then", (cell,))
        for text, cell in (("Two", (13, 22)), ("Four", (18, 22)))
    ]
    opened(doors)
    for row, text, colour in ((3, "Replaced after", "text"), (2, "Message 3 is wrong. Not shown", "bad")):
        select(doors, row)
        assert re.search(rf"text '{text}.*' at .* {colour}", drawn(doors.app))
        assert "others are read then" in words(doors) or row == 3
        assert "Shorten what is read before it" in words(doors)


BUTTONS = "Add", "Copy", "Up", "Down", "Remove", "Test", "OK", "Cancel"
WELCOME = "Welcome to this place: go to the right, and look at what I have built there"


def test_a_place_has_its_bubble_beside_the_welcome_and_each_is_drawn_when_it_comes(room: Maker) -> None:
    check_says(room, f"start: {WELCOME} | at 3,22: Wall ahead | after 2 s!: Go on")
    assert read_ticks(WELCOME) == 6 * TICKS_PER_SECOND
    room.press("f5")
    play = room.shown(PlaytestScreen).play
    room.frames(40, ms=25)
    assert not play.attempt.inputs, "it waits at its start"
    assert said(play) == [WELCOME, ""]
    room.app.controls.poll = lambda: 4  # type: ignore[method-assign]
    seen: list[list[str]] = []
    for _ in range(3 * TICKS_PER_SECOND):
        log = DrawLog()
        with log.installed(), log.recording(room.app.theme.palette) as lines:
            room.frames(ms=25)
        picture = "\n".join(lines)
        seen += [said(play)] * (not seen or said(play) != seen[-1])
        assert [words in picture for words in ("Welcome to", "Wall ahead", "Go on")] == [
            words in " ".join(said(play)) for words in ("Welcome to", "Wall ahead", "Go on")
        ]
    assert seen == [[WELCOME, ""], [WELCOME, "Wall ahead"], ["Go on", "Wall ahead"]]


def test_a_new_text_keeps_away_from_the_one_that_is_there_and_that_one_stays(doors: Maker) -> None:
    """The bubble comes beside a text of gold, and a text of a door beside the bubble."""
    hud, places = Hud(doors.app.theme), dict[str, list[pygame.Rect]]()
    check_says(doors, f"gold: {LONG} | at 9,22 9x5: {LONG[::-1]} | lock 11,22: Now {LONG}")
    doors.press("f5")
    play = doors.shown(PlaytestScreen).play
    play.begin()
    with patch.object(doors.app.controls, "poll", lambda: 2):
        for _ in range(100):
            play.run_ticks(1)
            view = hud_view(play)
            rects = []
            for message in filter(None, (view.message, view.bubble)):
                rects.append(pygame.Rect(*map(round, hud.box(message).area)))
                places.setdefault(message.text, []).append(rects[-1])
            assert len(rects) < 2 or not rects[0].colliderect(rects[1])
    assert len(places) == 3
    assert all(len(set(map(tuple, rects))) == 1 for rects in places.values()), "none moves"


def test_what_is_lost_because_of_a_place_is_a_problem_and_a_welcome_cut_short_is_none(doors: Maker) -> None:
    session = doors.editor.session
    session.certifier.certification = search_of(doors.draft.level, verified_run(doors.draft.level, RIGHT))
    for says, late in (
        (f"at 3,22!: {WELCOME} | at 9,22: Wall ahead", f"'Wall ahead' is not shown {RUN}: others are read then"),
        (f"start: {WELCOME} | at 3,22: Wall ahead", ""),
        (f"start: {WELCOME} | gold: Well", ""),
        (f"start: {WELCOME} | start: Two | trap: Late", ""),
    ):
        check_says(doors, says)
        texts = [finding.text for finding in session.examine() if finding.code == "late-message"]
        assert texts == [f"the message {late}"] * bool(late)
        opened(doors)
        doors.press("down")
        assert ("Not shown in the known run" in words(doors)) is bool(late), "beside the message, too"
        doors.choose("Cancel")


@pytest.mark.parametrize("time, is_short", [("", False), (" for 0.5 s", True), (" for 2 s", False)])
def test_a_time_too_short_for_its_letters_is_shown_below_the_message(room: Maker, time: str, is_short: bool) -> None:
    text = "Mind the mine behind the wall: it kills you"
    opened(room, f"start{time}: {text}")
    assert ("Too short to read: 43 letters need 5 s" in drawn(room.app)) is is_short
    assert not [finding for finding in room.editor.session.examine() if finding.code == "late-message"]


def test_an_important_message_comes_at_once_and_no_trifle_replaces_it(doors: Maker) -> None:
    """What is shown while the ninja runs to the gold and the doors, with and without the mark."""
    says = f"start: {WELCOME} | lock: Open | gold: Beware of the guard ahead"
    seen = []
    for marks in (0, 1):
        screen = opened(doors, says)
        select(doors, 2)
        if marks:
            doors.choose("No")
            assert "text '!'" in drawn(doors.app)
            assert doors.button("Yes") is screen.focus
            select(doors, 1)
            assert doors.button("No"), "of the one that is selected now"
        doors.choose("OK")
        doors.press("f5")
        play = doors.shown(PlaytestScreen).play
        doors.app.controls.poll = lambda: 2  # type: ignore[method-assign]
        play.begin()
        came = [play.messages.text]
        while play.messages.deaths == 0 and len(play.attempt.inputs) < 60:
            play.run_ticks(1)
            came += [play.messages.text] * (came[-1] != play.messages.text)
        seen.append([text[:6] for text in came])
        doors.press("escape")
    assert doors.draft.says == says.replace("gold:", "gold!:")
    assert seen == [["Welcom", "Beware", "Open"], ["Welcom", "Beware"]]


@pytest.mark.parametrize("says, helps", [("", True), ("after 99 s: Go", False)])
def test_in_a_level_with_messages_the_game_says_nothing_of_its_own(room: Maker, says: str, helps: bool) -> None:
    walls = Stamp({(column, row): 1 for row in range(10, 23) for column in (1, 5)}, ())
    room.editor.session.tools.history.change(replace(with_stamp(room.draft, walls), says=says))
    room.press("f5")
    play, runs = room.shown(PlaytestScreen).play, read_inputs([(1, ".*40 R*12 RJ*20 R*20 L*60 " * 2)]).keys
    room.app.controls.poll = iter(runs).__next__  # type: ignore[method-assign]
    play.begin()
    heard = set()
    for _ in runs:
        play.run_ticks(1)
        heard.add(play.messages.text.partition(",")[0])
    assert heard == ({"", "Hold {right}"} if helps else {""})


@pytest.mark.parametrize("count", [0, 1, MAX_MESSAGES])
def test_buttons_stay_in_their_place_and_nothing_lies_over_anything_else(room: Maker, count: int) -> None:
    screen = opened(room)
    fixed = [room.button(text).area for text in BUTTONS]
    show(screen, *[MessageRow(Moment.AT, "8,21", "x")] * count)
    assert [room.button(text).area for text in BUTTONS] == fixed
    seen = (widget.area for widget in screen.widgets)
    areas = [pygame.Rect(*map(round, area)) for area in (PICTURE, *seen)]
    assert all(area.collidelistall(areas) == [place] for place, area in enumerate(areas))
    assert not screen.offers_back, "OK and Cancel are the ways out"


def test_each_moment_is_explained_by_its_row(room: Maker) -> None:
    screen = opened(room)
    for when, (name, text) in MOMENT_TEXTS.items():
        show(screen, MessageRow(when, "", "x"))
        assert f"{name}: {text[0].lower()}{text[1:]}." in words(room)


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
    maker.editor.session.tools.history.change(replace(ROOM, says=maker.draft.says))
    maker.press("f5")
    assert maker.shown(PlaytestScreen).mood == Mood(1, 0), "and so has a test"


def test_enter_begins_a_new_line_in_the_field_the_file_and_the_level(room: Maker) -> None:
    screen = opened(room)
    add(room, "")
    for line in ("Run", "jump", "and see"):
        room.type(line)
        room.press("return")
    assert room.top() is screen
    assert screen.edited.rows[0].text == "Run\njump\nand see", "three lines are the most"
    field = screen.form.fields[Field.TEXT]
    assert isinstance(field, TextArea)
    shown = drawn(room.app)
    for line in ("Run", "jump", "and see"):
        assert shown.count(f"text '{line}'") == 2, "in its field and in the level"
    room.press("up")
    room.type("z")
    room.mouse(field.area[0] + 200, field.area[1] + 8)
    assert field.edited.cursor == 3, "a click behind a line leads to its end"
    room.chord("return", pygame.KMOD_LCTRL)
    assert room.draft.says == r"start: Run\njumpz\nand see"
    assert [message.text for message in opened(room).edited.rows] == ["Run\njumpz\nand see"]


def test_an_empty_last_line_has_the_cursor(room: Maker) -> None:
    screen = opened(room)
    add(room, "")
    room.type("Run")
    room.press("return")
    drawn(room.app)
    field = screen.form.fields[Field.TEXT]
    assert isinstance(field, TextArea)
    assert [first for first, _ in field._rows] == [0, 4]
    assert field._cursor_row == 1
    room.press("up")
    assert field.edited.cursor == 0
    room.chord("return", pygame.KMOD_LCTRL)
    assert room.draft.says == "start: Run"


def test_gold_is_counted_and_all_of_it_has_a_moment_of_its_own(room: Maker) -> None:
    room.editor.session.tools.history.change(with_stamp(room.draft, Stamp({}, (ObjectSpec(GOLD, (60.0, 60.0)),))))
    screen = opened(room)
    add(room, "")
    room.type("Well done")
    room.choose("At the start...")
    room.choose("All gold taken")
    assert screen.edited.source == "all gold: Well done"
    assert "Never shown" not in drawn(room.app)
    room.choose("All gold taken...")
    room.choose("Gold is taken")
    room.mouse(*screen.form.fields[Field.DETAIL].centre)
    room.type("3")
    assert screen.edited.source == "gold 3: Well done"
    assert "Never shown: the level has 1 piece of gold" in words(room)


def test_a_message_that_is_never_shown_is_said_to_be_so(room: Maker) -> None:
    screen = opened(room)
    for when, never in ((Moment.LOCK, True), (Moment.START, False), (Moment.GOLD, True)):
        show(screen, MessageRow(when, "", "x"))
        assert ("Message 1 is wrong. Never shown: there is no" in words(room)) is never
        assert ("Choose another moment or place for it" in words(room)) is never
    show(screen, MessageRow(Moment.START, "", "x"), MessageRow(Moment.TRAP, "", "y: z"))
    assert "Never shown" not in words(room)
    assert "text 'Trap' at 78,81.8 size 9 bad" in drawn(room.app), "also one that is not selected"


def test_a_message_that_waits_in_the_known_run_says_for_how_long(room: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: bytes(400)))
    screen = opened(room, "after 1 s: Go | after 2 s: On | after 9 s: No")
    assert " late in" not in words(room)
    select(room, 1)
    assert "2 s late in the known run (10.0 s): others are read first" in words(room)
    screen.edited.rows[0].text = "long " * 24
    assert "7 s late in" in words(room)
    select(room, 2)
    screen.edited.rows[2].when, screen.edited.rows[2].detail = Moment.AFTER, "3"
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: bytes(300)))
    assert "Not shown in the known run (7.5 s): others are read then" in words(room)


def test_a_long_text_is_seen_whole_and_up_and_down_go_through_its_lines(room: Maker) -> None:
    text = "This text has many words and all of them are seen, since the field has three lines for its 110 letters"
    screen = opened(room)
    show(screen, MessageRow(Moment.START, "", text), MessageRow(Moment.START, "", "y"))
    field = screen.form.fields[Field.TEXT]
    assert isinstance(field, TextArea)
    screen.redraw = True
    room.frames()
    room.mouse(*field.centre)
    lines = [text[first : first + len(stops) - 1] for first, stops in field._rows]
    assert "".join(lines) == text
    assert 2 <= len(lines) <= 3
    assert all(f"text '{line}'" in drawn(room.app) for line in lines)
    assert all(line.endswith(" ") for line in lines[:-1]), "broken between words"
    left, top, *_ = field.area
    room.mouse(left + field.area[2] - 4, top + 6)
    assert field.edited.cursor == len(lines[0]) - 1, "a click behind a line leads to its end"
    room.mouse(left + 60, top + 28)
    row_of_cursor = len(lines[0]) <= field.edited.cursor < len(lines[0] + lines[1])
    assert row_of_cursor, "a click leads to the line that it hits"
    room.press("home")
    assert field.edited.cursor == 0
    room.press(*["down"] * (len(lines) - 1))
    assert field.edited.cursor == len("".join(lines[:-1]))
    assert screen.focus is field
    room.press("down")
    assert screen.focus is not field


def test_add_lists_all_moments_and_cancel_adds_nothing(room: Maker) -> None:
    screen = opened(room)
    room.choose("Add")
    assert [getattr(row, "text", "") for row in room.shown(Menu).widgets][:-1] == [
        name for name, _ in MOMENT_TEXTS.values()
    ]
    room.choose("Cancel")
    assert not screen.edited.rows
    room.choose("Add")
    room.choose("After deaths")
    room.type("Wait")
    assert screen.edited.source == "death 3: Wait"


def test_seconds_may_have_a_part_and_a_wrong_number_is_named_at_once_and_typed_over(room: Maker) -> None:
    screen = with_time_in_hand(room)
    room.type("abc")
    assert "Message 1 is wrong. Seconds: from 0.1 to 99.9, or empty" in words(room)
    room.choose("OK")
    assert screen.focus is screen.form.fields[Field.TIME]
    for letter in "1,5":
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=letter))
    room.frames()
    room.choose("OK")
    assert room.draft.says == "start for 1.5 s: on"
    assert opened(room).edited.rows[0].time == "1.5"


def test_after_seconds_takes_a_part_and_a_wrong_number_is_said_where_one_looks(room: Maker) -> None:
    screen = opened(room, "start: a | start: b | start: c | start: d | after 20 s: e")
    for typed, problem in (("2.55", "How many seconds: a number from 0.1 to 99.9"), ("2,5", "")):
        select(room, 4, Field.DETAIL)
        room.chord("a", pygame.KMOD_LCTRL)
        for letter in typed:
            pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=letter))
        room.frames()
        assert (f"Message 5 is wrong. {problem}" in words(room)) == bool(problem)
        select(room, 0)
        room.choose("Test")
        if problem:
            assert (screen.list.index, screen.focus) == (4, screen.form.fields[Field.DETAIL])
            assert f"Message 5 is wrong. {problem}" in words(room)
    play = room.shown(PlaytestScreen).play
    room.press("escape")
    room.choose("OK")
    assert room.draft.says.endswith("after 2.5 s: e")
    assert [m.number for m in play.playthrough.messages()][4] == 2.5


def test_a_full_text_says_that_what_is_typed_beyond_is_left_out(room: Maker) -> None:
    screen = opened(room, f"start: {'x' * (MAX_LETTERS - 1)}")
    select(room, 0)
    note = "text 'Full: what is typed beyond is left out'"
    assert note not in drawn(room.app)
    room.type("yz")
    assert screen.edited.rows[0].text.replace("x", "") == "y"
    assert note in drawn(room.app)
    room.press("backspace")
    assert note not in drawn(room.app)


def test_undo_in_a_text_goes_back_word_by_word(room: Maker) -> None:
    screen = opened(room)
    add(room, "run and jump")
    room.press("backspace")
    room.type("ps now")
    texts = []
    for _ in range(6):
        room.chord("z", pygame.KMOD_LCTRL)
        texts.append(screen.edited.rows[0].text)
    assert texts == ["run and jumps", "run and jum", "run and jump", "run and", "run", ""]


def test_undo_and_redo_take_back_everything_on_the_page_one_step_at_a_time(room: Maker) -> None:
    screen = opened(room, "start: a | at 5,5: b | start: c")
    sources = [screen.edited.source]

    def done(change: Callable[[], object]) -> None:
        change()
        room.frames()
        assert screen.edited.source != sources[-1]
        sources.append(screen.edited.source)

    select(room, 1)
    done(partial(room.choose, "Remove"))
    assert (screen.list.index, screen.focus) == (1, room.button("Remove")), "the next message, and the same button"
    done(partial(room.chord, "up", pygame.KMOD_LCTRL))
    done(partial(room.choose, "Copy"))
    done(partial(room.choose, "No"))
    room.choose("At the start...")
    done(partial(room.choose, "Near a place"))
    done(partial(drag_in_picture, room, (10, 10), (12, 12), (14, 15)))
    done(partial(drag_in_picture, room, (12, 12), (13, 12), (15, 12)))
    select(room, 0)
    done(partial(room.type, "one"))
    done(partial(room.type, " two"))
    room.choose("Add")
    room.choose("Exit opens")
    done(partial(room.type, "Now"))
    select(room, 0, Field.TIME)
    done(partial(room.type, "5"))
    select(room, 0)
    done(partial(room.press, "backspace"))
    steps = [*sources[:10], sources[9] + " | switch: ", *sources[10:]]
    for source in reversed(steps[:-1]):
        room.chord("z", pygame.KMOD_LCTRL)
        assert screen.edited.source == source
    room.chord("z", pygame.KMOD_LCTRL)
    assert screen.edited.source == steps[0]
    for number, source in enumerate(steps[1:]):
        room.chord("z", pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT) if number % 2 else room.chord("y", pygame.KMOD_LCTRL)
        assert screen.edited.source == source
    room.chord("z", pygame.KMOD_LCTRL)
    room.type("x")
    room.chord("y", pygame.KMOD_LCTRL)
    assert screen.edited.source == sources[-2].replace("one two", "one twox"), (
        "a change after undo ends what could be redone"
    )


def test_undo_of_a_text_keeps_the_focus_and_puts_the_cursor_where_it_changes(room: Maker) -> None:
    screen = opened(room, "start: to the exit | start: b")
    select(room, 0)
    room.press("home", *["right"] * 6)
    room.type(" open")
    assert screen.edited.rows[0].text == "to the open exit"
    room.chord("z", pygame.KMOD_LCTRL)
    field = screen.form.fields[Field.TEXT]
    assert isinstance(field, TextEntry)
    assert (field.text, field.edited.cursor, screen.focus) == ("to the exit", 6, field)
    select(room, 1)
    room.chord("y", pygame.KMOD_LCTRL)
    assert (screen.list.index, screen.edited.rows[0].text) == (0, "to the open exit"), (
        "the message that changes is shown"
    )


def test_delete_in_the_list_removes_the_selected_message(room: Maker) -> None:
    screen = opened(room, "start: a | start: b")
    room.press("delete", "delete", "delete")
    assert (screen.edited.rows, screen.list.index, screen.focus) == ([], 0, room.button("Add"))
    assert "No messages yet: Add makes one" in words(room)
    room.chord("z", pygame.KMOD_LCTRL)
    assert texts_of(screen) == "b"
    select(room, 0)
    room.press("home", "delete")
    assert texts_of(screen) == "", "in a text it removes a letter"


def test_words_in_braces_are_put_into_the_text_at_its_cursor_by_mouse_and_keys(room: Maker) -> None:
    screen = opened(room, "start: Press  now")
    select(room, 0)
    room.press("home", *["right"] * 6)
    x, y, w, h = screen.form.words.row_area(WORDS.index("jump"))
    room.mouse(x + w / 2, y + h / 2)
    assert (screen.edited.rows[0].text, screen.focus) == ("Press {jump} now", screen.form.fields[Field.TEXT])
    room.press("shift+tab", "tab")
    field = screen.form.fields[Field.TEXT]
    assert isinstance(field, TextEntry)
    assert (field.edited.selected, screen.focus) == ("Press {jump} now", field)
    room.press("tab")
    assert screen.focus is screen.form.words
    room.press("down", "right")
    room.press("return")
    assert screen.edited.rows[0].text == "Press {jump} now{gold left}", "what was selected by Tab stays"
    room.chord("z", pygame.KMOD_LCTRL)
    assert screen.edited.rows[0].text == "Press {jump} now", "a step of its own"
    screen.edited.rows[0].text = "x" * (MAX_LETTERS - 5)
    screen.enter()
    room.mouse(x + w / 2, y + h / 2)
    assert screen.edited.rows[0].text == "x" * (MAX_LETTERS - 5), "no half of a word"
    assert room.app.notice.startswith("{jump} does not fit")


def test_tab_leads_from_the_list_through_the_fields_to_ok(room: Maker) -> None:
    screen = opened(room, "start: a | at 5,5: b")
    room.press("down")
    way: list[object] = []
    for _ in screen.widgets:
        way.append(screen.focus)
        room.press("tab")
    of_list, ends = [room.button(name) for name in BUTTONS[:5]], [room.button(name) for name in BUTTONS[5:]]
    assert [*screen.form.fields] == [*Field, "words"]
    assert way == [screen.list, *of_list, *screen.form.fields.values(), *ends]
    assert screen.focus is screen.list


ODD = (
    MessageRow(Moment.AT, "12,5 15x11", "x" * 20 + " {an-unknown-word-that-is-far-too-long}"),
    MessageRow(Moment.TRAP, "", "y"),
)


@pytest.mark.parametrize("size", TEXT_SIZES.values())
def test_nothing_beside_the_fields_is_cut_in_any_size_of_text(doors: Maker, size: int) -> None:
    doors.app.change_settings(text_size=size)
    screen = opened(doors)
    sound = [
        MessageRow(when, {Moment.DEATH: "1", Moment.AFTER: "2", Moment.AT: "5,5"}.get(when, ""), LONG)
        for when in MOMENT_TEXTS
    ]
    empty = [MessageRow(when) for when in MOMENT_TEXTS]
    lost = [MessageRow(Moment.AT, "20,20", "Four"), MessageRow(Moment.GOLD, "", "long " * 24)]
    wrong = [MessageRow(Moment.START, "", "x", "0.01"), MessageRow(Moment.AT, "99,99", "z")]
    for rows in (sound, empty, [*ODD, *lost, *wrong]):
        show(screen, *rows)
        room_for_empty = screen.checks.refused = rows is empty
        for number in range(len(rows)):
            screen.list.select(number)
            aside = [line for line in drawn(doors.app).splitlines() if re.match(r"text .* at 484,", line)]
            assert aside or room_for_empty
            assert not [line for line in aside if "..." in line]
            lowest = max(float(re.findall(r" at 484,([\d.]+)", line)[0]) for line in aside)
            assert lowest < 514, "above the buttons"
            field = screen.form.fields[Field.TEXT]
            assert isinstance(field, TextArea)
            assert len(field._rows) <= field._lay_out(doors.app.theme, field.area[0] + PAD, field.area[2] - 20)[1]


def test_a_problem_of_a_message_leads_to_it_on_the_page(room: Maker) -> None:
    check_says(room, "start: a | trap: b | start: c | at 5,5: d")
    examine(room.editor)
    room.frames(2)
    x, y, w, _ = LAYOUT.findings
    room.mouse(x + w / 3, y + 9)
    screen = room.shown(MessagesScreen)
    assert (screen.list.index, screen.focus) == (1, screen.form.fields[Field.TEXT])


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


def test_a_test_of_gold_in_the_air_begins_on_a_floor_from_which_it_is_taken(
    doors: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(type(doors.editor.session), "certifying_inputs", property(lambda _: b""))
    high = with_stamp(doors.draft, Stamp({}, (ObjectSpec(GOLD, (20 * 24 + 12.0, 19 * 24 + 12.0)),)))
    doors.editor.session.tools.history.change(high)
    opened(doors, "start: Welcome | gold 20,19: Now")
    select(doors, 1)
    doors.choose("Test")
    play = doors.shown(PlaytestScreen).play
    ninja = play.attempt.simulation.ninja
    assert (ninja.y, play.messages.text) == (22 * 24 + 12.0, ""), "on the floor, without what is said at the start"
    assert abs(ninja.x - 20 * 24 - 12) <= 3 * 24


def test_the_known_run_is_played_in_the_background(doors: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    monkeypatch.setattr(AtOnce, "ask", lambda _, question: asked.append(question))
    screen = opened(doors, "trap: One | lock: Two")
    drawn(doors.app)
    assert len(asked) == 1
    assert screen.checks._known_run.result is None
    screen.checks._known_run.result = screen.checks._known_run._work(asked[0])
    doors.press("down")
    doors.frames(2)
    assert "Replaced after" in words(doors)
