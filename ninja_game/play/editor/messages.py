"""The screen of a level's messages: a list of them, and the selected one's fields beside the level."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import astuple, replace
from functools import lru_cache, partial
from itertools import product
from math import dist

import pygame

from ninja_game.document import History
from ninja_game.editor.draft import Draft
from ninja_game.editor.message_rows import DETAILS, GRIP, TEXT, TIME, MessageRow, messages_of, moved_frame, sizing
from ninja_game.editor.stamp import CellArea, area_between
from ninja_game.errors import LevelError
from ninja_game.formats.messages import (
    FRAME_SIZE,
    IMPORTANT,
    KEYS,
    MAX_LETTERS,
    MAX_MESSAGE_LINES,
    MAX_MESSAGES,
    NO_CELL,
    SEPARATOR,
    WORDS,
    LevelMessage,
    Moment,
    arrow_targets,
    level_text,
    parse_messages,
)
from ninja_game.levels.episodes import Mood
from ninja_game.levels.findings import LEVEL_WORDINGS, Finding
from ninja_game.levels.lint import Ground, unseen_messages
from ninja_game.play.app import App
from ninja_game.play.editor.sheet import said_at, things_of
from ninja_game.play.level.hud_view import named_in
from ninja_game.play.level.level_play import things_at_start
from ninja_game.play.menu_screen import CANCEL, Action, Menu, MenuRow, MenuScreen, ask_to_keep
from ninja_game.runs.messages import Appearance, appearances, late_text, short_text, shown_ticks
from ninja_game.runtime import NewestJob
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside
from ninja_game.sim.level import COLUMNS, ROWS, Level
from ninja_game.sim.rules import CELL, LIFETIME, TICKS_PER_SECOND
from ninja_game.sim.schema.world_fields import World
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.list_view import BAR_WIDTH, ListView
from ninja_game.ui.text_entry import TextArea, TextEntry
from ninja_game.ui.theme import Area, Palette, Theme, contains_point, mixed
from ninja_game.ui.widgets import Button, Label, Widget
from ninja_game.view.hud import Hud, HudView, PlacedMessage, placed_message
from ninja_game.view.places import Things
from ninja_game.view.sprites.thumbnail import open_exit, thumbnail

_LEFT, _TOP, _LIST, _WIDE, _FIELDS = 36, 60, 294, 432, 400  # left, upper edges, widths of list and fields, px
_ROW = 17.5  # height of a message in the list, px: all have room
_PICTURE: Area = (342, _TOP, 422, 422 * HEIGHT / WIDTH)  # where the level is shown with the selected message
_ASIDE: Area = (484, 388, 280, 134)  # where what is wrong is said, and help

_WHEN = {
    Moment.START: ("At the start", "At each start, until the exit is open"),
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

_HELP = (
    "A place has its own bubble. An event (gold, a door) replaces the text that is shown; a time waits for it.",
    "Until an important message (!) was read, only another important one of its kind replaces it.",
    "In a level with messages the game gives no help of its own in play.",
    "Ctrl+Z undoes the last change here, a text word by word; Ctrl+Y redoes it.",
)

_HANDLE = 9.0  # side of the handles of the selected frame, px of the level

_IMPORTANT_HINT = "It comes at once, marked with !; until it was read, only another important one of its kind replaces it"

_LIST_HINT = "Enter or a second click: to its text; Del takes it away, Ctrl+Up and Ctrl+Down move it"

_WORDS_HINT = "For the text: a key becomes the player's, a number what it is then; switch and exit get arrows"

_TIME_HINT = "Seconds that it stays: from 0.1 to 99.9; empty: as its letters and those of its moment need"


@lru_cache(maxsize=4)
def _things_of_run(level: Level, inputs: bytes, *, tagged: bool) -> Things:
    return things_at_start(level, Simulation(level).world, ["{exit}"] * tagged, inputs)


_RunQuestion = tuple[tuple[LevelMessage, ...], Level, bytes, bool]
"""Messages, their level, the inputs of its known run, and whether texts name the switch or exit."""
_RunAnswer = tuple[_RunQuestion, list[Appearance | None], Things]
"""When each message comes in that run, and what texts should not cover."""


def _answer(question: _RunQuestion) -> _RunAnswer:
    messages, level, inputs, tagged = question
    return question, appearances(messages, level, inputs), _things_of_run(level, inputs, tagged=tagged)


def _same(a: Sequence[object], b: Sequence[object]) -> int:
    """How many items are the same from the beginning on."""
    return next((k for k, (one, other) in enumerate(zip(a, b, strict=False)) if one != other), min(len(a), len(b)))


class _Stage:
    """The level's picture and its world; ``opened``: with an open exit; ``shown``: the look in play."""

    def __init__(
        self, level: Level, palette: Palette, width: int, shown: Theme, text_size: int, *, opened: bool
    ) -> None:
        self.picture = thumbnail(level, palette, width, opened=opened)
        self.hud = Hud(Theme(palette, Canvas(self.picture.get_size()), text_size), shown)
        self.world: World | None = None
        with suppress(LevelError):
            self.world = Simulation(level).world
        if self.world and opened:
            open_exit(self.world)


class MessagesScreen(MenuScreen):
    """The list of a level's messages, with the selected one in the level.

    ``here``: the default cell of a new message near a place. ``put``: gets the new value of the header.
    ``test``: plays the level with such a value from just before a message, by its number and its place, if known.
    ``at``: the number of the message that gets the focus. ``mood``: in which the level is played.
    ``certifying_inputs``: gives those of its author's run, if any.
    """

    title = "Messages to the player"
    offers_back = says_full = False

    def __init__(
        self,
        app: App,
        draft: Draft,
        here: Cell,
        put: Callable[[str], object],
        test: Callable[[int, Point | None, str], object],
        mood: Mood,
        certifying_inputs: Callable[[], bytes],
        at: int | None = None,
    ) -> None:
        super().__init__(app)
        self.messages = messages_of(draft.says)
        self._draft = draft
        area = _LEFT, _TOP, _LIST + BAR_WIDTH + 4, _ROW * MAX_MESSAGES
        self.list = ListView(area, _ROW, self._draw_row, self.select, selected=self._follow, opens=True)
        self.list.hint, self.list.empty = _LIST_HINT, "No messages yet: Add makes one"
        area = _LEFT, 516, _WIDE + BAR_WIDTH + 8, 40
        self.words = ListView(area, 20, self._draw_word, self._put_word, hint=_WORDS_HINT)
        self.words.columns = 6
        self.words.fill(WORDS)
        self.fields: list[Widget] = []  #: of the selected message: its moment, DETAIL, TIME, TEXT; none without one
        self._fields_of: MessageRow | None = None
        self._history = History(tuple(map(astuple, self.messages)))
        self._step: object = None  #: what the last change belongs to: a word that is being typed, a drag
        self._stages: dict[tuple[object, ...], _Stage] = {}
        self._known: NewestJob[_RunQuestion, _RunAnswer] = NewestJob(_answer)
        self._asked: _RunQuestion | None = None
        self._answer_drawn = True
        self._ground = Ground(draft.level)
        self._look, self._certifying_inputs = mood, certifying_inputs
        self._before = self.source
        self._here, self._put, self._test = here, put, test
        self._refused = False
        self._drag_begin: Cell = NO_CELL
        self._dragged_frame: Callable[[Cell], CellArea] | None = None  #: the frame for the pointer's cell
        if at is not None and at < len(self.messages):
            self.select(at)

    @property
    def source(self) -> str:
        return f" {SEPARATOR} ".join(message.source for message in self.messages)

    def select(self, number: int, field: int = TEXT) -> None:
        """Select a message, with the focus on a field of it."""
        self.list.index = number
        self.enter()
        self.focus, self.redraw = self.fields[field], True

    def _follow(self, _: int) -> None:
        """Another message may have been selected: show its fields."""
        if self.selected is not self._fields_of:
            self.enter()

    def build(self) -> Sequence[Widget]:
        self._fields_of = message = self.selected
        self.list.focusable = bool(message)
        self.list.fill([*self.messages])
        full = len(self.messages) >= MAX_MESSAGES
        most = f"{MAX_MESSAGES} is the most: remove one first" if full else ""
        up, down = (partial(self._reorder, by) if message else None for by in (-1, 1))
        copy, remove = (self._copy, self._remove) if message else (None, None)
        buttons: list[tuple[float, float, float, str, Action | None, str]] = [
            (36, 352, 48, "Add", None if full else self._add, most),
            (88, 352, 54, "Copy", None if full else copy, "The selected message once more: Ctrl+D"),
            (146, 352, 44, "Up", up, "The selected message earlier: Ctrl+Up; with Shift the first"),
            (194, 352, 56, "Down", down, "The selected message later: Ctrl+Down; with Shift the last"),
            (254, 352, 76, "Remove", remove, "Take it away; Ctrl+Z brings it back"),
            (484, 528, 88, "Test", self._try, "Play from just before the selected message; Esc comes back"),
            (580, 528, 88, "OK", self._accept, "Ctrl+Enter"),
            (676, 528, 88, "Cancel", self.close, ""),
        ]
        fixed = [Button((x, y, w, 28), text, do, hint=hint, size=10.5) for x, y, w, text, do, hint in buttons]
        self.fields = self._fields(message) if message else []
        important = "Yes" if message and message.important else "No"
        mark = Button((402, _FIELDS, 66, 26), important, self._mark, hint=_IMPORTANT_HINT)
        shown = [*self.fields[:TEXT], mark, self.fields[TEXT], self.words] if message else []
        return [self.list, *fixed[:5], *shown, *fixed[5:]]

    def _fields(self, message: MessageRow) -> list[Widget]:
        """Fields for a message: its moment, DETAIL, TIME, TEXT."""
        new_line = f"Enter begins a new line: {MAX_MESSAGE_LINES} at most; Ctrl+Enter is OK"
        area = _LEFT, _FIELDS + 31, _WIDE, 72
        text = TextArea(
            area, "What is said", message.text, lambda _: None, longest=MAX_LETTERS, most_lines=MAX_MESSAGE_LINES
        )

        def put(typed: str) -> None:
            message.text = typed
            text.hint = message.problem[1] if message.unknown else new_line

        put(message.text)
        text.put = put
        change = partial(self._change_moment, message)
        detail: Widget = Label((_LEFT, _FIELDS, 0, 0), "")  # in its place, so that the focus keeps its own
        name, width = f"{_WHEN[message.when][0]}...", 254
        if message.when in DETAILS:
            prompt, hint, _ = DETAILS[message.when]
            put_detail, width = partial(setattr, message, "detail"), 114
            detail = TextEntry((160, _FIELDS, 130, 26), prompt, message.detail, put_detail, longest=11, hint=hint)
        moment = Button((_LEFT, _FIELDS, width, 26), name, lambda: self._ask_moment(change, message.when))
        usual = shown_ticks(message.when, len(self._together(message)), message.text) // TICKS_PER_SECOND
        put_time = partial(setattr, message, "time")
        auto = "while there" if message.when == Moment.AT else f"auto ({usual} s)"
        time = TextEntry((300, _FIELDS, 92, 26), auto, message.time, put_time, longest=6, hint=_TIME_HINT)
        return [moment, detail, time, text]

    def _ask_moment(self, choose: Callable[[Moment], object], at: Moment) -> None:
        rows: list[MenuRow] = [(name, partial(choose, when), about) for when, (name, about) in _WHEN.items()]
        self.app.push(Menu(self.app, "When is it said?", [*rows, CANCEL], at=list(_WHEN).index(at)))

    def _change_moment(self, message: MessageRow, when: Moment) -> None:
        if when != message.when:
            message.when = when
            details = {Moment.DEATH: "3", Moment.AFTER: "20", Moment.AT: "{},{}".format(*self._here)}
            message.detail = details.get(when, "")
            self.enter()

    @property
    def selected(self) -> MessageRow | None:
        return self.messages[self.list.index] if self.list.index < len(self.messages) else None

    def _handle_mouse(self, event: pygame.Event) -> None:
        """A click in the picture selects what lies there, or puts the selected message there; a drag frames it.

        Beside the picture the wheel selects the next message.
        """
        if event.type == pygame.MOUSEWHEEL:
            if self._level_point(pygame.mouse.get_pos()) is None:
                self.list.select(self.list.index - event.y)
                self.redraw = True
            return
        if event.type == pygame.MOUSEBUTTONUP:
            self._dragged_frame = None
        pressed = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT
        drags = event.type == pygame.MOUSEMOTION and event.buttons[0] and self._dragged is None
        at = self._level_point(event.pos) if pressed or drags else None
        if at is None:
            super()._handle_mouse(event)
            return
        cell = min(max(1, int(at[0] // CELL)), COLUMNS), min(max(1, int(at[1] // CELL)), ROWS)
        if pressed:
            self._drag_begin, self._dragged_frame = cell, None
            self._press(at, cell)
        elif self._dragged_frame and cell != self._drag_begin:
            self._drag_begin = NO_CELL
            self._put_frame(self._dragged_frame(cell))
        self.redraw = True

    def _level_point(self, pos: tuple[int, int]) -> Point | None:
        """The point of the level, px, under one of the screen; None outside the picture."""
        x, y = self.theme.canvas.logical(pos)
        scale = WIDTH / _PICTURE[2]
        return ((x - _PICTURE[0]) * scale, (y - _PICTURE[1]) * scale) if contains_point(_PICTURE, x, y) else None

    def _press(self, at: Point, cell: Cell) -> None:
        """A thing under the pointer comes first, then an edge of the selected frame, a number, the place itself."""
        selected, parsed, near = self.selected, self._parsed(self.selected), 1.5 * CELL
        thing = min(self._things_of(selected), key=partial(dist, at), default=None)
        named = "{},{}".format(*cell_of(*thing)) if thing and dist(thing, at) < near else ""
        eyes = [(dist(eye, at), number) for number, row in enumerate(self.messages) if (eye := self._eye(row))]
        away, number = min(eyes, default=(near, 0))
        sized = sizing(parsed, *at) if parsed and away > GRIP else None
        if selected and named and selected.detail != named:
            selected.detail = named
            self.enter()
        elif sized:
            self._dragged_frame = sized
        elif away < near and number != self.list.index:
            self.select(number)
        elif parsed and all(abs(a - b) < half for a, b, half in zip(at, parsed.middle, parsed.reach, strict=True)):
            self._dragged_frame = partial(moved_frame, parsed.frame, cell)
        elif selected and selected.when == Moment.AT:
            if is_inside(cell_of(*at)):
                size = parsed.size if parsed else FRAME_SIZE
                self._put_frame(LevelMessage(Moment.AT, "", cell=cell, size=size).frame)
                self._dragged_frame = partial(area_between, cell)
        elif selected and not named and away >= near:
            self.app.notify(f"To put it there, choose {_WHEN[Moment.AT][0]} for it")

    def _put_frame(self, frame: CellArea) -> None:
        """Give the selected message a frame, if its middle is inside the level."""
        left, top, columns, rows = frame
        cell, size = (left + columns // 2, top + rows // 2), (min(columns, COLUMNS), min(rows, ROWS))
        if self.selected and is_inside(cell):
            self.selected.put_at(cell, size)
            self.enter()

    def _add(self) -> None:
        def choose(when: Moment) -> None:
            self.messages.append(MessageRow())
            self._change_moment(self.messages[-1], when)
            self.select(len(self.messages) - 1)

        self._ask_moment(choose, Moment.START)

    def _put_at(self, number: int, message: MessageRow, others: list[MessageRow]) -> None:
        """Show the messages with one at that place among others, selected."""
        self.list.index = min(max(0, number), len(others))
        self.messages = [*others[: self.list.index], message, *others[self.list.index :]]
        self.enter()

    def _copy(self) -> None:
        if self.selected and len(self.messages) < MAX_MESSAGES:
            self._put_at(self.list.index + 1, replace(self.selected), self.messages)

    def _reorder(self, by: int) -> None:
        """Move the selected message by so many places, with Shift to the end."""
        if selected := self.selected:
            far = MAX_MESSAGES if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
            others = [other for other in self.messages if other is not selected]
            self._put_at(self.list.index + by * far, selected, others)

    def _mark(self) -> None:
        if self.selected:
            self.selected.important = not self.selected.important
            self.enter()

    def _remove(self) -> None:
        """Take the selected message away: the next one is selected, else the last."""
        del self.messages[self.list.index : self.list.index + 1]
        self.list.index = min(self.list.index, max(0, len(self.messages) - 1))
        self.enter()

    def _note(self) -> None:
        """Put what has changed since the last event into the history; a typed word, and a drag, is one step."""
        edited, values = getattr(self.focus, "edited", None), tuple(map(astuple, self.messages))
        step = self._dragged_frame or (edited and (edited, len(edited.past)))
        if values != self._history.draft:
            if step is None or step != self._step:
                self._history.begin()
            self._history.change(values)
            self._step = step

    def _restore(self, step: Callable[[], bool]) -> None:
        """Undo or redo; the first message that it changes is selected, with the cursor behind what it changes."""
        before, field = self._history.draft, self.focus
        if step():
            self._step, rows = None, self._history.draft
            self.messages = [MessageRow(*values) for values in rows]
            self.list.index = min(_same(before, rows), max(0, len(rows) - 1))
            self.enter()
            if isinstance(field, TextEntry) and isinstance(self.focus, TextEntry) and field.text != self.focus.text:
                behind = _same(field.text[::-1], self.focus.text[::-1])
                self.focus.edited.go(len(self.focus.text) - behind)
            self.redraw = True

    def _put_word(self, number: int) -> None:
        """Put a word in braces into the text, at its cursor."""
        field, word = self.fields[TEXT], f"{{{WORDS[number]}}}"
        if isinstance(field, TextEntry) and len(field.text + word) <= MAX_LETTERS:
            field.edited.go(field.edited.cursor)
            field.text_event(pygame.Event(pygame.TEXTINPUT, text=word))
            self.focus = field
        else:
            self.app.notify(f"{word} does not fit: {MAX_LETTERS} letters are the most")

    def _is_sound(self) -> bool:
        """Whether all messages are valid; else the first that is not gets the focus and shows the problem."""
        for number, message in enumerate(self.messages):
            field, problem = message.problem
            if problem:
                self._refused = True
                self.select(number, field)
                if field != TEXT and isinstance(self.focus, TextEntry):
                    self.focus.edited.select_all()
                return False
        return True

    def _accept(self) -> None:
        if self._is_sound():
            self.app.pop()
            self._put(self.source)

    def _try(self) -> None:
        if self._is_sound():
            self._test(self.list.index, self._eye(self.selected) if self.selected else None, self.source)

    def close(self) -> None:
        """Leave; ask first whether changes are kept."""
        if self.source == self._before:
            super().close()
        else:
            ask_to_keep(self.app, "The messages are changed", self._accept)

    def capture(self, event: InputEvent) -> bool:
        """Typed letters go to the text unless another field has the focus; some keys do what the buttons do."""
        self._note()
        raw = event.raw
        keys = chord(raw) if raw.type == pygame.KEYDOWN else ""
        commands: dict[str, Action] = {
            "ctrl+z": partial(self._restore, self._history.undo),
            "ctrl+y": partial(self._restore, self._history.redo),
            "ctrl+d": self._copy,
            "ctrl+up": partial(self._reorder, -1),
            "ctrl+down": partial(self._reorder, 1),
            **dict.fromkeys(("ctrl+return", "ctrl+kp_enter"), self._accept),
        }
        if self.focus is self.list:
            commands["delete"] = self._remove
        if command := commands.get("ctrl+y" if keys == "ctrl+shift+z" else keys.replace("shift+", "")):
            command()
            self.redraw = True
            return True
        names = {pygame.TEXTINPUT: "text", pygame.KEYDOWN: "unicode"}
        typed = getattr(raw, names.get(raw.type, ""), "")
        if typed.strip() and typed.isprintable() and not isinstance(self.focus, TextEntry) and self.fields:
            self.focus = self.fields[TEXT]
        return super().capture(event)

    def act(self, action: str, *, held: bool = False) -> None:
        """Enter in a field of one line means OK."""
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self._accept()
        else:
            super().act(action, held=held)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        if not self._answer_drawn and self._known.is_idle:
            self._answer_drawn = self.redraw = True

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme = self.theme
        self._ask_about_run()
        count = f"{len(self.messages)} of {MAX_MESSAGES}"
        theme.text(surface, count, 764, 24, size=11, colour=theme.palette.on_tile, align="right")
        theme.panel(surface, _LEFT, _TOP, _LIST, _ROW * MAX_MESSAGES)
        message = self.selected
        self._draw_level(surface, message)
        x, y, w, h = _ASIDE
        texts = self._help_texts()
        if message:
            self._draw_notes(surface, message)
            odd, moment = self._unseen(message), self._appearance(message)
            wrong, remark = self._wrong(message), self._wait_of(message)
            if wrong or remark:
                text = f"Message {self.list.index + 1} is wrong. {wrong}" if wrong else remark
                late = LEVEL_WORDINGS["late-message"].hint if moment and late_text(moment, 1) else ""
                advice = odd[0].hint if odd else late
                colour = theme.palette.bad if wrong else theme.palette.text
                high = theme.paragraph(surface, [text, advice], (x, y, w, 70), 11, 14, colour=colour) + 6
                texts, y, h = texts[:1], y + high, h - high
        theme.paragraph(surface, texts, (x, y, w, h), 10, 13, colour=theme.palette.faint)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        """A line of the list: what is odd, the number, whether it is important, the moment, the first words."""
        (x, y, w, h), palette, message = area, theme.palette, self.messages[index]
        chosen, top = index == self.list.index, y + (h - 9) / 2
        if chosen:
            theme.row(surface, (x + 1, y, w - 2, h), chosen=True, focused=focused, radius=3)
        if wrong := self._wrong(message):
            theme.canvas.polygon(surface, palette.bad, [(x + 4, y + h - 5), (x + 12, y + h - 5), (x + 8, y + 4.5)])
        elif self._wait_of(message):
            theme.canvas.circle(surface, palette.faint, (x + 8, y + h / 2), 3.5, 1.5)
        write = partial(theme.text, surface, y=top, size=9, bold=chosen, height=h)
        colour = palette.bad if wrong else palette.text
        write(str(index + 1), x=x + 32, align="right", width=18)
        if message.important:
            write(IMPORTANT, x=x + 35)
        write(message.moment.capitalize(), x=x + 42, width=86, colour=colour)
        words, room = " ".join(message.text.split()) or "(empty)", w - 142
        write(theme.fit(words, room, 9 * theme.scales[0], bold=chosen), x=x + 134, width=room)

    def _draw_word(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x, y + 1, w - 4, h - 2), chosen=focused, focused=focused, radius=3)
        middle = x + w / 2 - 2
        theme.text(surface, f"{{{WORDS[index]}}}", middle, y + 5, size=9, align="centre", width=w - 8, height=h - 2)

    def _draw_notes(self, surface: pygame.Surface, message: MessageRow) -> None:
        """Draw what the fields are about, and below the text its letters and which of its moment it is."""
        theme, palette, length = self.theme, self.theme.palette, len(message.text)
        detail = DETAILS[message.when][2] if message.when in DETAILS else ""
        for x, w, text in (_LEFT, 114, "When"), (160, 130, detail), (300, 92, "Seconds"), (402, 66, "Important"):
            theme.text(surface, text, x, _FIELDS - 13, size=9, colour=palette.faint, width=w)
        full = length >= MAX_LETTERS
        colour, y, right = palette.bad if full else palette.faint, _FIELDS + 104, _LEFT + _WIDE
        theme.text(surface, f"{length} of {MAX_LETTERS}", right, y, size=8.5, colour=colour, align="right")
        note = "Full: what is typed beyond is left out" if full else self._turn_of(message)
        theme.text(surface, note, _LEFT, y, size=8.5, colour=colour, width=_WIDE - 100)

    def _wrong(self, message: MessageRow) -> str:
        """The problem of a message, "" if it has none. An empty field is one only after OK was refused."""
        field, problem = message.problem
        if message.unknown:
            return f"There is no {message.unknown[:20]}: the words are below"
        if problem:
            return problem if self._refused or field == TIME or (field != TEXT and message.detail) else ""
        for finding in self._unseen(message):
            return f"Never shown: {finding.text.rpartition(': ')[2]}"
        return self._wait_of(message, lost=True)

    def _help_texts(self) -> list[str]:
        """About the selected message, then about all."""
        texts, selected = [], self.selected
        if selected:
            name, when = _WHEN[selected.when]
            texts.append(f"{name}: {when[0].lower()}{when[1:]}.")
        if selected and selected.when == Moment.AT:
            texts.append("In the picture: a click puts it, a drag draws its frame, moves it or an edge.")
        if len(self._things_of(selected)) > 1:
            texts.append("A click in the picture on one of them: only when it is that one.")
        return [" ".join(texts), " ".join(_HELP)]

    def _unseen(self, message: MessageRow | None) -> list[Finding]:
        return [*unseen_messages(message.source, self._ground)] if message and not message.problem[1] else []

    def _turn_of(self, message: MessageRow) -> str:
        """The number of a message among those of its moment; '' for an only one."""
        together = self._together(message)
        place = next(k for k, other in enumerate(together, 1) if other is message)
        return f"No. {place} of {len(together)}" if len(together) > 1 else ""

    def _sound(self) -> list[MessageRow]:
        return [row for row in self.messages if not row.problem[1]]

    def _ask_about_run(self) -> None:
        """Have the level's known run played with the messages as they are, unless that is done or under way."""
        inputs = self._certifying_inputs()
        messages = tuple(message for row in self._sound() for message in parse_messages(row.source))
        tagged = bool(arrow_targets(row.text for row in self.messages))
        question = messages, self._draft.level, inputs, tagged
        if inputs and question != self._asked:
            self._asked, self._answer_drawn = question, False
            self._known.ask(question)

    def _appearance(self, message: MessageRow) -> Appearance | None:
        """When a message comes in the known run; None: never, without such a run, or not known yet."""
        answer, sound = self._known.result, self._sound()
        if not answer or answer[0] != self._asked or message not in sound:
            return None
        return answer[1][sound.index(message)]

    def _wait_of(self, message: MessageRow, *, lost: bool = False) -> str:
        """That a message is lost to others in the known run, or how late or short it is; '' if it is not."""
        sound = () if lost or message.problem[1] else parse_messages(message.source)
        moment = self._appearance(message) if self._together(message)[0] is message else None
        is_so = moment and (moment.tick is None) is lost
        late = late_text(moment, len(self._certifying_inputs())) if moment and is_so else ""
        text = late or "".join(map(short_text, sound))
        return text[:1].upper() + text[1:]

    def _together(self, message: MessageRow) -> list[MessageRow]:
        return [other for other in self.messages if other.moment == message.moment]

    def _stage(self, message: MessageRow | None) -> _Stage:
        """The level's picture for a message, painted once for each look."""
        width, opened = self.theme.canvas.rect(*_PICTURE).width, bool(message and message.when == Moment.SWITCH)
        palette, text_size = self.app.palette_in(self._look), self.app.settings.text_size
        look = palette.name, width, self.theme, text_size
        if (*look, opened) not in self._stages:
            self._stages = {key: stage for key, stage in self._stages.items() if key[:-1] == look}
            stage = _Stage(self._draft.level, palette, width, self.theme, text_size, opened=opened)
            self._stages[*look, opened] = stage
        return self._stages[*look, opened]

    def _things(self, stage: _Stage) -> Things:
        """Things that a text should not cover; the route of the known run too, as soon as it is there."""
        if answer := self._known.result:
            return answer[2]
        tagged = bool(arrow_targets(row.text for row in self.messages))
        return _things_of_run(self._draft.level, b"", tagged=tagged) if stage.world else ()

    def _placed(self, message: MessageRow, stage: _Stage) -> PlacedMessage | None:
        """A message as it lies in the level in play; None without a text."""
        controls, all_gold, number = self.app.controls, self._draft.level.gold, message.detail
        taken = {Moment.ALL_GOLD: all_gold, Moment.GOLD: int(number) if number.isdecimal() else 1}.get(message.when, 0)
        deaths = int(number) if message.when == Moment.DEATH and number.isdecimal() else 0

        def key(word: str) -> str:
            return controls.name(word) if word in KEYS else f"{{{word}}}"

        text = level_text(message.text.strip(), key, taken, all_gold, deaths)
        parsed, moment = self._parsed(message), self._appearance(message)
        if moment and message.when != Moment.START:
            spot: Point | None = moment.spot
        else:
            spot = None if parsed else self._eye(message)
        layout = self._draft.level.tiles, self._things(stage), parsed, spot
        return placed_message(text, *layout, of_start=message.when == Moment.START) if text else None

    def _draw_level(self, surface: pygame.Surface, message: MessageRow | None) -> None:
        """The level with a message as in play, and the places of all."""
        draft, stage = self._draft, self._stage(message)
        picture, hud = stage.picture.copy(), stage.hud
        for row in self.messages:
            if parsed := self._parsed(row):
                self._draw_place(picture, hud.theme, parsed, chosen=row is message)
        eye = self._eye(message) if message else None
        for at in self._things_of(message):
            hud.theme.canvas.circle(picture, hud.theme.palette.accent, at, 13, 3 if at == eye else 1)
        labels = named_in(stage.world, arrow_targets([message.text])) if stage.world and message else ()
        foot, placed = (draft.name, f"gold 0 / {draft.level.gold}"), self._placed(message, stage) if message else None
        hud.draw(picture, HudView(LIFETIME, "", foot, name=draft.name, message=placed, named=labels))
        surface.blit(picture, self.theme.canvas.rect(*_PICTURE))
        for number, row in enumerate(self.messages):
            if row is not message and (eye := self._eye(row)):
                self._draw_number(surface, number, eye)

    def _draw_place(self, picture: pygame.Surface, theme: Theme, parsed: LevelMessage, *, chosen: bool) -> None:
        """The frame of a message near a place; with handles if it is the selected one."""
        (x, y), (half_w, half_h), palette = parsed.middle, parsed.reach, theme.palette
        colour = palette.accent if chosen else mixed(palette.background, palette.accent, 0.4)
        frame = x - half_w, y - half_h, 2 * half_w, 2 * half_h
        theme.canvas.frame_rect(picture, colour, *frame, 2 if chosen else 1)
        for across, down in product((-1, 0, 1), repeat=2) if chosen else ():
            if across or down:
                left, top = x + across * half_w - _HANDLE / 2, y + down * half_h - _HANDLE / 2
                theme.canvas.fill_rect(picture, colour, left, top, _HANDLE, _HANDLE)

    def _draw_number(self, surface: pygame.Surface, number: int, at: Point) -> None:
        """The number of a message that is not selected, where it is said."""
        scale, palette, write = _PICTURE[2] / WIDTH, self.theme.palette, self.theme.text
        x, y = _PICTURE[0] + at[0] * scale, _PICTURE[1] + at[1] * scale
        self.theme.canvas.circle(surface, palette.accent, (x, y), 6)
        write(surface, str(number + 1), x, y - 4.5, size=9, align="centre", colour=palette.background, width=11)

    def _things_of(self, message: MessageRow | None) -> list[Point]:
        """The objects that a message can be about, px: the gold, or the switches of its moment."""
        return things_of(self._draft, message.when) if message and message.when in DETAILS else []

    def _parsed(self, message: MessageRow | None) -> LevelMessage | None:
        """A message near a place as the level will have it; None for others and without a valid place."""
        return message.parsed if message and message.when == Moment.AT else None

    def _eye(self, message: MessageRow) -> Point | None:
        """Where the ninja is when a message appears, px; None at the start, or where that is unknown."""
        parsed = message.parsed
        return parsed and (parsed.place or said_at(self._draft, parsed))
