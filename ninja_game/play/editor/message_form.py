"""The fields of the selected message."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pygame

from ninja_game.editor.message_rows import DETAILS, EditedMessages, MessageField, MessageRow
from ninja_game.formats.messages import MAX_LETTERS, MAX_MESSAGE_LINES, WORDS, Moment
from ninja_game.play.app import App
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow
from ninja_game.runs.message_queue import shown_ticks
from ninja_game.sim.grid import Cell
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.ui.list_view import BAR_WIDTH, ListView
from ninja_game.ui.text_entry import TextArea, TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Widget

_LEFT, _TOP, _WIDTH = 36, 400, 432  # px

MOMENT_TEXTS = {
    Moment.START: ("At the start", "At each start, for its seconds, while the exit is closed"),
    Moment.SWITCH: ("Exit opens", "Once, when the ninja opens the exit"),
    Moment.GOLD: ("Gold is taken", "Once, when the ninja takes the first gold"),
    Moment.ALL_GOLD: ("All gold taken", "Once, when the ninja has taken the last gold"),
    Moment.DEATH: ("After deaths", "At the start, after so many deaths"),
    Moment.LOCK: ("A door unlocks", "Once, when a locked door opens"),
    Moment.TRAP: ("A trap closes", "Once, when a trap door closes"),
    Moment.AFTER: ("After seconds", "Once, when a try has lasted so long"),
    Moment.AT: ("Near a place", "Beside it, when the ninja first comes into its frame, while it is there"),
}
"""The name of each moment, and when it is."""

_IMPORTANT_HINT = "It comes at once, marked !; until it was read, only another important one of its kind replaces it"

_WORDS_HINT = "For the text: a key becomes the player's, a number what it is then; switch and exit get arrows"

_TIME_HINT = "Seconds that it stays: from 0.1 to 99.9; empty: as its letters and those of its moment need"

_NEW_LINE_HINT = f"Enter begins a new line: {MAX_MESSAGE_LINES} at most; Ctrl+Enter is OK"


class MessageForm:
    """The fields of the selected message by their names, and the words that can be put into its text.

    ``new_place``: the default cell of a message near a place. ``changed``: called when its fields may be others.
    ``focus``: leads to a field. ``fields``: empty without a message.
    """

    def __init__(
        self,
        app: App,
        edited: EditedMessages,
        new_place: Cell,
        changed: Callable[[], object],
        focus: Callable[[MessageField], object],
    ) -> None:
        self.app = app
        self.fields: dict[str, Widget] = {}
        self.row: MessageRow | None = None  #: whose fields they are
        self.words = ListView((_LEFT, 516, _WIDTH + BAR_WIDTH + 8, 40), 20, self._draw_word, self._put_word)
        self.words.hint = _WORDS_HINT
        self.words.columns = 6
        self.words.fill(WORDS)
        self._edited = edited
        self._new_place = new_place
        self._changed = changed
        self._focus = focus

    def build(self) -> None:
        """Make the fields of the message that is selected now."""
        self.row = self._edited.selected
        self.fields = self._fields_of(self.row) if self.row else {}

    def _fields_of(self, row: MessageRow) -> dict[str, Widget]:
        fields: dict[str, Widget] = {}
        takes_detail = row.when in DETAILS

        area = _LEFT, _TOP, 114 if takes_detail else 254, 26
        ask = partial(self.ask_moment, partial(self.change_moment, row), row.when)
        fields[MessageField.MOMENT] = Button(area, f"{MOMENT_TEXTS[row.when][0]}...", ask)

        if takes_detail:
            prompt, hint, _ = DETAILS[row.when]
            put = partial(setattr, row, "detail")
            fields[MessageField.DETAIL] = TextEntry(
                (160, _TOP, 130, 26), prompt, row.detail, put, longest=11, hint=hint
            )

        usual = shown_ticks(row.when, len(self._edited.together(row)), row.text) // TICKS_PER_SECOND
        prompt = "while there" if row.when == Moment.AT else f"auto ({usual} s)"
        put = partial(setattr, row, "time")
        fields[MessageField.TIME] = TextEntry((300, _TOP, 92, 26), prompt, row.time, put, longest=6, hint=_TIME_HINT)

        mark = "Yes" if row.important else "No"
        fields[MessageField.IMPORTANT] = Button((402, _TOP, 66, 26), mark, self._turn_mark, hint=_IMPORTANT_HINT)

        area = _LEFT, _TOP + 31, _WIDTH, 72
        put = partial(self._put_text, row)
        fields[MessageField.TEXT] = text = TextArea(
            area, "What is said", row.text, put, longest=MAX_LETTERS, most_lines=MAX_MESSAGE_LINES
        )
        text.hint = _text_hint(row)
        fields["words"] = self.words
        return fields

    def _put_text(self, row: MessageRow, typed: str) -> None:
        row.text = typed
        self.fields[MessageField.TEXT].hint = _text_hint(row)

    def ask_moment(self, choose: Callable[[Moment], object], at: Moment) -> None:
        """Ask for a moment, beginning ``at`` one."""
        rows: list[MenuRow] = [(name, partial(choose, when), about) for when, (name, about) in MOMENT_TEXTS.items()]
        self.app.push(Menu(self.app, "When is it said?", [*rows, CANCEL], at=list(MOMENT_TEXTS).index(at)))

    def change_moment(self, row: MessageRow, when: Moment) -> None:
        if when != row.when:
            row.when = when
            details = {Moment.DEATH: "3", Moment.AFTER: "20", Moment.AT: "{},{}".format(*self._new_place)}
            row.detail = details.get(when, "")
            self._changed()

    def _turn_mark(self) -> None:
        if self.row:
            self.row.important = not self.row.important
            self._changed()

    def _put_word(self, number: int) -> None:
        """Put a word in braces into the text, at its cursor."""
        field = self.fields[MessageField.TEXT]
        word = f"{{{WORDS[number]}}}"
        if isinstance(field, TextEntry) and len(field.text + word) <= MAX_LETTERS:
            field.edited.go(field.edited.cursor)
            field.text_event(pygame.Event(pygame.TEXTINPUT, text=word))
            self._focus(MessageField.TEXT)
        else:
            self.app.notify(f"{word} does not fit: {MAX_LETTERS} letters are the most")

    def draw(self, surface: pygame.Surface, theme: Theme) -> None:
        """Draw what the fields are about, and below the text its letters and which of its moment it is."""
        row = self.row
        if not row:
            return
        faint = theme.palette.faint
        detail = DETAILS[row.when][2] if row.when in DETAILS else ""
        for x, width, about in (_LEFT, 114, "When"), (160, 130, detail), (300, 92, "Seconds"), (402, 66, "Important"):
            theme.text(surface, about, x, _TOP - 13, size=9, colour=faint, width=width)
        length = len(row.text)
        is_full = length >= MAX_LETTERS
        write = partial(theme.text, surface, y=_TOP + 104, size=8.5, colour=theme.palette.bad if is_full else faint)
        write(f"{length} of {MAX_LETTERS}", x=_LEFT + _WIDTH, align="right")
        note = "Full: what is typed beyond is left out" if is_full else self._turn_of(row)
        write(note, x=_LEFT, width=_WIDTH - 100)

    def _turn_of(self, row: MessageRow) -> str:
        """The number of a message among those of its moment; '' for an only one."""
        together = self._edited.together(row)
        return f"No. {together.index(row) + 1} of {len(together)}" if len(together) > 1 else ""

    def _draw_word(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x, y + 1, w - 4, h - 2), chosen=focused, focused=focused, radius=3)
        middle = x + w / 2 - 2
        theme.text(surface, f"{{{WORDS[index]}}}", middle, y + 5, size=9, align="centre", width=w - 8, height=h - 2)


def _text_hint(row: MessageRow) -> str:
    round_words = [word for word in WORDS if f"({word})" in row.text]
    if round_words and not row.unknown:
        return f"({round_words[0]}) stays as it is: in braces, {{{round_words[0]}}}, it is replaced in play"
    return row.problem[1] if row.unknown else _NEW_LINE_HINT
