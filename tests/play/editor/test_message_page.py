"""The page of messages in the editor: its list, its fields, and undo."""

import re
from collections.abc import Callable
from functools import partial
from unittest.mock import patch

import pygame
import pytest

from ninja_game.editor.message_rows import MessageField, MessageRow
from ninja_game.formats.messages import MAX_LETTERS, MAX_MESSAGES, WORDS, Moment, parse_messages
from ninja_game.play.editor.message_form import MOMENT_TEXTS
from ninja_game.play.editor.message_picture import PICTURE
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.editor.view import LAYOUT
from ninja_game.play.menu_screen import Menu
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import ObjectSpec
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.text_entry import TextArea, TextEntry
from ninja_game.ui.theme import TEXT_SIZES, Theme
from ninja_game.ui.widgets import PAD, TEXT_SIZE as TEXT_PX, Button
from tests.support.draw_log import drawn
from tests.support.level_maker import Maker, examine
from tests.support.message_page import (
    ALL,
    LONG,
    add,
    drag_in_picture,
    in_picture,
    opened,
    rows_shown,
    select,
    show,
    texts_of,
    words,
)


def with_time_in_hand(maker: Maker) -> MessagesScreen:
    """The page with one message, whose time is still automatic, and has the focus."""
    screen = opened(maker)
    add(maker, "on")
    assert "text 'auto (12 s)'" in drawn(maker.app)
    select(maker, 0, MessageField.TIME)
    return screen


def test_messages_are_made_row_by_row_and_a_test_says_them(room: Maker) -> None:
    room.choose_in_menu("Messages...")
    room.shown(MessagesScreen)
    add(room, "run")
    add(room, "")
    select(room, 1, MessageField.MOMENT)
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
    room.put_more(ObjectSpec(GOLD, (60.0, 60.0)))
    opened(room, "start: a | gold: b | start: c | switch: d")
    for row, texts in enumerate((("No. 1 of 2", "auto (6 s)"), ("auto (6 s)",), ("No. 2 of 2",), ("auto (12 s)",))):
        select(room, row)
        assert all(f"text '{text}'" in drawn(room.app) for text in texts)


def test_a_message_stays_as_long_as_it_says_and_without_a_number_as_long_as_usual(room: Maker) -> None:
    screen = with_time_in_hand(room)
    room.type("0")
    room.choose("OK")
    assert screen.checks.refused
    assert screen.focus is screen.form.fields[MessageField.TIME]
    room.press("backspace")
    room.type("25")
    room.press("return")
    assert screen.focus is screen.form.fields[MessageField.TEXT], "it does not close the page"
    room.choose("OK")
    assert room.draft.says == "start for 25 s: on"
    assert opened(room).edited.source == room.draft.says


def test_a_known_word_in_round_brackets_is_told_to_want_braces(room: Maker) -> None:
    screen = opened(room, "start: (jump) now")
    screen.focus_on_field(MessageField.TEXT)
    room.frames(2)
    assert "(jump) stays as it is: in braces, {jump}, it is replaced in play" in words(room)


def test_all_messages_are_seen_in_a_list_in_which_one_is_selected(room: Maker) -> None:
    screen = opened(room)
    add(room, *"abcdefghijklmnop")
    assert not room.button("Add").enabled
    assert (screen.list.index, screen.focus) == (15, screen.form.fields[MessageField.TEXT])
    assert "".join(row.words for row in rows_shown(screen)) == "abcdefghijklmnop"
    assert screen.list.visible_lines >= MAX_MESSAGES
    screen.edited.rows[5].text = ""
    x, y, _, h = screen.list.row_area(3)
    room.mouse(x + 60, y + h / 2)
    assert (screen.list.index, screen.focus) == (3, screen.list)
    room.press("down", "down", "up")
    assert (screen.list.index, getattr(screen.form.fields[MessageField.TEXT], "text", "")) == (4, "e")
    room.mouse(x + 60, y + h / 2, click=False)
    assert screen.list.index == 4, "the way of the mouse to the fields selects nothing"
    room.mouse(x + 60, y + h / 2)
    assert (screen.list.index, screen.focus) == (3, screen.list)
    room.mouse(x + 60, y + h / 2)
    assert (screen.list.index, screen.focus) == (3, screen.form.fields[MessageField.TEXT]), (
        "a second click leads to the text"
    )
    for notches, number in ((-1, 4), (1, 3), (2, 1), (9, 0)):
        room.wheel(notches, x + 9, 450)
        assert screen.list.index == number
    room.wheel(-1, *in_picture(9, 9))
    assert screen.list.index == 0
    room.choose("OK")
    assert (screen.list.index, screen.focus) == (5, screen.form.fields[MessageField.TEXT]), "what is wrong is shown"
    room.choose("Remove")
    assert texts_of(screen) == "abcdeghijklmnop"


def test_a_line_of_the_list_says_when_and_marks_what_is_wrong_or_late(
    room: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: bytes(400)))
    screen = opened(room, "at 12,5 3x1!: Jump | death 2: No | trap: Shut | after 1 s: Go | after 2 s: On")
    assert rows_shown(screen) == [
        ("", True, "At 12,5 3x1", "Jump", "text"),
        ("", False, "Death 2", "No", "text"),
        ("wrong", False, "Trap", "Shut", "bad"),
        ("", False, "After 1 s", "Go", "text"),
        ("late", False, "After 2 s", "On", "text"),
    ]


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


def test_for_a_level_without_a_file_no_packs_are_read(room: Maker) -> None:
    with patch.object(room.app.player.catalogue, "packs") as read:
        opened(room)
    assert not read.called


def test_a_level_about_which_something_is_said_keeps_its_messages(room: Maker) -> None:
    room.put_says(ALL)
    room.press("f2")
    room.fill("Other", "OK")
    assert (room.draft.name, room.draft.says) == ("Other", ALL)
    assert parse_messages(room.draft.says)


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
    assert (texts_of(screen), screen.list.index, screen.focus) == ("acbcd", 3, screen.form.fields[MessageField.TEXT])
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
    moment = screen.form.fields[MessageField.MOMENT]
    buttons = [(text, moment) for text in names] + [(w.text, w) for w in screen.widgets if isinstance(w, Button)]
    for text, button in buttons:
        assert isinstance(button, Button)
        assert theme.fit(text, button.area[2] - 2 * PAD, button.size, bold=True) == text
    entries = [w for w in screen.widgets if isinstance(w, TextEntry) and not isinstance(w, TextArea)]
    assert all(theme.fit(w.prompt, w.area[2] - 2 * PAD, TEXT_PX) == w.prompt for w in entries)


BUTTONS = "Add", "Copy", "Up", "Down", "Remove", "Test", "OK", "Cancel"


@pytest.mark.parametrize("time, is_short", [("", False), (" for 0.5 s", True), (" for 2 s", False)])
def test_a_time_too_short_for_its_letters_is_shown_below_the_message(room: Maker, time: str, is_short: bool) -> None:
    text = "Mind the mine behind the wall: it kills you"
    opened(room, f"start{time}: {text}")
    assert ("Too short to read: 43 letters need 5 s" in drawn(room.app)) is is_short
    assert not [finding for finding in room.editor.session.examine() if finding.code == "late-message"]


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


def test_enter_begins_a_new_line_in_the_field_the_file_and_the_level(room: Maker) -> None:
    screen = opened(room)
    add(room, "")
    for line in ("Run", "jump", "and see"):
        room.type(line)
        room.press("return")
    assert room.top() is screen
    assert screen.edited.rows[0].text == "Run\njump\nand see", "three lines are the most"
    field = screen.form.fields[MessageField.TEXT]
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
    field = screen.form.fields[MessageField.TEXT]
    assert isinstance(field, TextArea)
    assert [first for first, _ in field._rows] == [0, 4]
    assert field._cursor_row == 1
    room.press("up")
    assert field.edited.cursor == 0
    room.chord("return", pygame.KMOD_LCTRL)
    assert room.draft.says == "start: Run"


def test_gold_is_counted_and_all_of_it_has_a_moment_of_its_own(room: Maker) -> None:
    room.put_more(ObjectSpec(GOLD, (60.0, 60.0)))
    screen = opened(room)
    add(room, "")
    room.type("Well done")
    room.choose("At the start...")
    room.choose("All gold taken")
    assert screen.edited.source == "all gold: Well done"
    assert "Never shown" not in drawn(room.app)
    room.choose("All gold taken...")
    room.choose("Gold is taken")
    room.mouse(*screen.form.fields[MessageField.DETAIL].centre)
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
    assert rows_shown(screen)[1][:3] == ("wrong", False, "Trap"), "also one that is not selected"


def test_a_long_text_is_seen_whole_and_up_and_down_go_through_its_lines(room: Maker) -> None:
    text = "This text has many words and all of them are seen, since the field has three lines for its 110 letters"
    screen = opened(room)
    show(screen, MessageRow(Moment.START, "", text), MessageRow(Moment.START, "", "y"))
    field = screen.form.fields[MessageField.TEXT]
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
    assert screen.focus is screen.form.fields[MessageField.TIME]
    for letter in "1,5":
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=letter))
    room.frames()
    room.choose("OK")
    assert room.draft.says == "start for 1.5 s: on"
    assert opened(room).edited.rows[0].time == "1.5"


def test_after_seconds_takes_a_part_and_a_wrong_number_is_said_where_one_looks(room: Maker) -> None:
    screen = opened(room, "start: a | start: b | start: c | start: d | after 20 s: e")
    for typed, problem in (("2.55", "How many seconds: a number from 0.1 to 99.9"), ("2,5", "")):
        select(room, 4, MessageField.DETAIL)
        room.chord("a", pygame.KMOD_LCTRL)
        for letter in typed:
            pygame.event.post(pygame.Event(pygame.TEXTINPUT, text=letter))
        room.frames()
        assert (f"Message 5 is wrong. {problem}" in words(room)) == bool(problem)
        select(room, 0)
        room.choose("Test")
        if problem:
            assert (screen.list.index, screen.focus) == (4, screen.form.fields[MessageField.DETAIL])
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
    select(room, 0, MessageField.TIME)
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
    field = screen.form.fields[MessageField.TEXT]
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
    assert (screen.edited.rows[0].text, screen.focus) == ("Press {jump} now", screen.form.fields[MessageField.TEXT])
    room.press("shift+tab", "tab")
    field = screen.form.fields[MessageField.TEXT]
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
    assert [*screen.form.fields] == [*MessageField, "words"]
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
            assert not [line for line in aside if re.search(r"\.\.\.['\"] at", line)]
            lowest = max(float(re.findall(r" at 484,([\d.]+)", line)[0]) for line in aside)
            assert lowest < 514, "above the buttons"
            field = screen.form.fields[MessageField.TEXT]
            assert isinstance(field, TextArea)
            assert len(field._rows) <= field._lay_out(doors.app.theme, field.area[0] + PAD, field.area[2] - 20)[1]


def test_a_problem_of_a_message_leads_to_it_on_the_page(room: Maker) -> None:
    room.put_says("start: a | trap: b | start: c | at 5,5: d")
    examine(room.editor)
    room.frames(2)
    x, y, w, _ = LAYOUT.findings
    room.mouse(x + w / 3, y + 9)
    screen = room.shown(MessagesScreen)
    assert (screen.list.index, screen.focus) == (1, screen.form.fields[MessageField.TEXT])


def test_the_focus_stays_in_the_field_of_its_name_when_another_message_has_fewer(room: Maker) -> None:
    screen = opened(room, "at 5,5: a | start: b")
    for field in (MessageField.MOMENT, MessageField.TIME, MessageField.TEXT):
        select(room, 0, field)
        if field == MessageField.MOMENT:
            room.choose("Cancel")
        room.wheel(-1, *screen.form.fields[MessageField.TEXT].centre)
        assert (screen.list.index, screen.focus) == (1, screen.form.fields[field])
        room.wheel(1, *screen.form.fields[MessageField.TEXT].centre)
        assert (screen.list.index, screen.focus) == (0, screen.form.fields[field])
    select(room, 0, MessageField.DETAIL)
    room.wheel(-1, *screen.form.fields[MessageField.TEXT].centre)
    assert screen.focus is screen.list, "there is none of that name"
