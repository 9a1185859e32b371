"""Fields for text: moving, selecting, the clipboard, the mouse, keys that are held."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pygame
import pytest

from ninja_game.play.menu_screen import FormPanel
from ninja_game.ui.input.keys import SCANCODES, key_name
from ninja_game.ui.text_entry import EditedText, TextEntry
from tests.support.menu_driver import MenuDriver

CTRL, SHIFT, ALT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT, pygame.KMOD_RALT


class Writer(MenuDriver):
    """Somebody with a field in a form."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        self.form = FormPanel(
            self.app, "Two fields", [("first", "one two-three", 40), ("second", "", 200)], "Yes", print
        )
        self.app.push(self.form)
        self.frames(2)
        self.key("end")  # the text is a proposal

    @property
    def field(self) -> TextEntry:
        """The one that has the focus."""
        assert isinstance(self.form.focus, TextEntry)
        return self.form.focus

    def key(self, name: str, mod: int = 0, *, release: bool = True) -> None:
        """Press a key."""
        for kind in (pygame.KEYDOWN, pygame.KEYUP)[: 1 + release]:
            pygame.event.post(pygame.Event(kind, key=0, scancode=SCANCODES[name], mod=mod, unicode=""))
        self.frames()

    def post_button(self, kind: int, at: tuple[float, float]) -> None:
        """A mouse event with the left button."""
        place = self.app.canvas.point(*at)
        more = {"buttons": (1, 0, 0), "rel": (0, 0)} if kind == pygame.MOUSEMOTION else {"button": 1}
        pygame.event.post(pygame.Event(kind, pos=place, touch=False, **more))
        self.frames()

    def place(self, index: int) -> tuple[float, float]:
        """Where a character begins, logical px."""
        return self.field.stops[index], self.field.centre[1]


@pytest.fixture(name="at")
def writer(tmp_path: Path) -> Iterator[Writer]:
    at = Writer(tmp_path)
    try:
        yield at
    finally:
        at.close()


def test_keys_move_and_select_by_characters_words_and_to_the_ends(at: Writer) -> None:
    steps: list[tuple[str, int, tuple[int, int]]] = [
        ("left", 0, (12, 12)), ("left", SHIFT, (11, 12)), ("left", SHIFT | CTRL, (8, 12)), ("right", SHIFT, (9, 12)),
        ("right", 0, (12, 12)), ("home", SHIFT, (0, 12)), ("left", 0, (0, 0)), ("right", CTRL, (3, 3)),
        ("right", CTRL, (7, 7)), ("end", SHIFT, (7, 13)), ("left", CTRL, (8, 8)), ("left", CTRL, (4, 4)),
        ("a", CTRL, (0, 13)), ("home", 0, (0, 0)), ("left", SHIFT, (0, 0)),
    ]  # fmt: skip
    for name, mod, span in steps:
        at.key(name, mod)
        assert at.field.edited.span == span, (name, mod)
    assert at.form.texts == ["one two-three", ""]


def test_what_is_selected_is_seen(at: Writer) -> None:
    def tinted(index: int) -> bool:
        x, y = at.place(index)
        return at.app.surface.get_at(at.app.canvas.point(x + 2, y + 8)) == at.app.theme.palette.bar_full

    at.key("home")
    assert not any(map(tinted, range(13)))
    at.key("right", CTRL | SHIFT)
    selected = len(at.field.edited.selected)
    assert 0 < selected < 12
    assert [tinted(index) for index in range(13)] == [index < selected for index in range(13)]


def test_what_is_selected_is_typed_over_erased_and_brought_back(at: Writer) -> None:
    at.key("left", SHIFT | CTRL)
    at.type("x")
    assert at.form.texts[0] == "one two-x"
    at.key("home")
    at.key("right", SHIFT | CTRL)
    at.key("delete")
    assert at.form.texts[0] == " two-x"
    at.key("delete", CTRL)
    assert at.form.texts[0] == "-x"
    at.key("end")
    at.key("backspace", CTRL)
    assert at.form.texts[0] == "-"
    for _ in range(4):
        at.key("z", CTRL)
    assert at.form.texts[0] == "one two-three"
    at.key("z", CTRL)
    at.key("w", CTRL | ALT)
    assert at.form.texts[0] == "one two-three"


def test_the_clipboard(at: Writer) -> None:
    at.key("left", SHIFT | CTRL)
    at.key("c", CTRL)
    assert (pygame.scrap.get_text(), at.field.edited.selected) == ("three", "three")
    at.key("a", CTRL)
    at.key("x", CTRL)
    assert (pygame.scrap.get_text(), at.form.texts[0]) == ("one two-three", "")
    at.key("v", CTRL)
    at.key("v", CTRL)
    assert at.form.texts[0] == "one two-three" * 2
    pygame.scrap.put_text("a\tb\r\nc\x01\n")
    at.key("a", CTRL)
    at.key("v", CTRL)
    assert at.form.texts[0] == "a b c"
    pygame.scrap.put_text("long " * 50)
    at.key("v", CTRL)
    assert len(at.form.texts[0]) == 40


def test_without_a_clipboard_nothing_is_lost(at: Writer, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise pygame.error("no clipboard")

    monkeypatch.setattr(pygame.scrap, "put_text", fails)
    monkeypatch.setattr(pygame.scrap, "get_text", fails)
    at.key("a", CTRL)
    for letter in "cxv":
        at.key(letter, CTRL)
    assert at.form.texts[0] == "one two-three"


def test_the_mouse_puts_the_cursor_drags_and_selects_words(at: Writer, monkeypatch: pytest.MonkeyPatch) -> None:
    down, up, move = pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEMOTION
    now = [1000]
    monkeypatch.setattr(pygame.time, "get_ticks", lambda: now[0])
    at.post_button(down, at.place(4))
    assert at.field.edited.span == (4, 4)
    at.post_button(move, at.place(9))
    at.post_button(move, (at.place(7)[0] + 1, 500))
    at.post_button(up, at.place(7))
    assert at.field.edited.selected == "two"
    selected = []
    for _ in range(4):
        now[0] += 200
        at.post_button(down, (at.place(9)[0] + 1, at.place(9)[1]))
        at.post_button(move, at.place(12))
        at.post_button(up, at.place(12))
        selected.append(at.field.edited.selected)
    assert selected == ["hre", "three", "one two-three", "hre"]
    now[0] += 2000
    monkeypatch.setattr(pygame.key, "get_mods", lambda: SHIFT)
    at.post_button(down, at.place(2))
    assert at.field.edited.selected == "e two-t"
    at.key("end")
    pygame.event.post(pygame.Event(pygame.TEXTINPUT, text="!"))
    at.frames()
    for passed in (2000, 200):
        now[0] += passed
        at.post_button(down, at.place(14))
        at.post_button(up, at.place(14))
    assert at.field.edited.selected == "!", "two clicks behind the end take what is before it"


def test_a_key_that_is_held_repeats(at: Writer) -> None:
    at.key("backspace", release=False)
    at.frames(30)
    left = len(at.form.texts[0])
    assert 0 < left < 8
    pygame.event.post(pygame.Event(pygame.KEYUP, key=0, scancode=SCANCODES["backspace"], mod=0))
    at.frames(30)
    assert len(at.form.texts[0]) == left


def test_a_long_text_shows_the_part_with_the_cursor(at: Writer) -> None:
    at.press("down")
    field = at.field
    assert field.text == ""
    pygame.event.post(pygame.Event(pygame.TEXTINPUT, text="abcdefgh " * 15))
    at.frames(2)
    assert field.first_shown > 50
    for _ in range(40):
        at.key("backspace")
        assert field.first_shown + len(field.stops) - 1 == len(field.text), "the end is in sight"
    at.key("home")
    assert field.first_shown == 0
    right = at.place(-1)
    at.post_button(pygame.MOUSEBUTTONDOWN, at.place(0))
    at.post_button(pygame.MOUSEMOTION, (right[0] + 30, right[1]))
    at.post_button(pygame.MOUSEMOTION, (right[0] + 31, right[1]))
    assert field.first_shown > 0
    assert field.edited.span[0] == 0
    at.post_button(pygame.MOUSEBUTTONUP, right)


@pytest.mark.parametrize("text", ["", " ", "-", "é"])
def test_short_texts(text: str) -> None:
    edited = EditedText(text, 3)
    steps: list[Callable[[], object]] = [
        lambda: edited.select_word(0), edited.select_all, lambda: edited.step(1, word=True),
        lambda: edited.step(-1, word=True, select=True), lambda: edited.go(9), lambda: edited.go(-9, select=True),
        edited.undo,
    ]  # fmt: skip
    for step in steps:
        step()
        assert 0 <= edited.span[0] <= edited.span[1] <= len(text)
        assert edited.text == text
    edited.put("abcdef")
    assert len(edited.text) == 3


def test_tab_goes_to_the_next_field_and_never_hides_what_is_typed(at: Writer) -> None:
    first = at.field
    at.key("tab")
    assert at.app.top is at.form
    second = at.field
    assert second is not first
    at.key("tab", SHIFT)
    assert at.field is first
    assert first.text == first.edited.selected == "one two-three", "typing replaces it"


NO_TEXT = {"tab", "escape", "return", "kp_enter", "up", "down", "left", "right", "home", "end", "pageup", "pagedown",
           "insert", "backspace", "delete", *(f"f{number}" for number in range(1, 25))}  # fmt: skip


def test_a_field_takes_every_key_that_makes_text() -> None:
    """Also those of other keyboards, which have no name here; the letter itself comes as TEXTINPUT."""
    for shift in (0, SHIFT):
        for scancode in range(4, 120):
            name = key_name(scancode)
            field = TextEntry((0, 0, 100, 20), "prompt", "text", print)
            event = pygame.Event(pygame.KEYDOWN, key=0, scancode=scancode, mod=shift, unicode="")
            if name not in NO_TEXT:
                assert field.text_event(event), name
                assert field.text == "text"


def test_what_is_typed_replaces_the_first_field_of_a_form_and_goes_on_in_the_others(at: Writer) -> None:
    form = FormPanel(at.app, "Two fields", [("first", "old", 40), ("second", "kept", 40)], "Yes", print)
    at.app.push(form)
    at.frames(2)
    for key in ("", "down"):
        at.key(key) if key else None
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text="!"))
        at.frames()
    assert form.texts == ["!", "kept!"]


@pytest.mark.parametrize("answer", ["", "Cancel", "Discard changes", "Keep the changes"])
def test_a_changed_form_of_several_fields_asks_before_it_is_left(at: Writer, answer: str) -> None:
    below, kept = at.app.top, list[list[str]]()
    form = FormPanel(at.app, "Two fields", [("first", "old", 40), ("second", "", 40)], "Yes", kept.append)
    at.app.push(form)
    at.frames(2)
    at.key("down")
    if answer:
        pygame.event.post(pygame.Event(pygame.TEXTINPUT, text="new"))
        at.frames()
    at.key("escape")
    if answer:
        at.choose(answer)
    assert at.app.top is (form if answer == "Cancel" else below)
    assert kept == [["old", "new"]] * (answer == "Keep the changes")
    if answer == "Cancel":
        fields = [widget.text for widget in form.widgets if isinstance(widget, TextEntry)]
        assert fields == ["old", "new"], "it goes on as it was"
