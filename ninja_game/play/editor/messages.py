"""The screen of a level's messages: a row for each message and its moment."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache, partial
from itertools import product
from math import dist

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.editor.message_rows import (
    DETAILS,
    GRIP,
    TEXT,
    TIME,
    MessageRow,
    listed,
    messages_of,
    moved_frame,
    sizing,
)
from ninja_game.editor.stamp import CellArea, area_between
from ninja_game.errors import LevelError
from ninja_game.formats.messages import (
    ALL_GOLD,
    FRAME_SIZE,
    IMPORTANT,
    KEYS,
    MAX_LETTERS,
    MAX_MESSAGE_LINES,
    MAX_MESSAGES,
    NO_CELL,
    NUMBER_WORDS,
    SEPARATOR,
    TARGETS,
    WORDS,
    LevelMessage,
    arrow_targets,
    level_text,
    parse_messages,
)
from ninja_game.levels.episodes import Mood
from ninja_game.levels.findings import Finding
from ninja_game.levels.lint import Ground, unseen_messages
from ninja_game.play.app import App
from ninja_game.play.editor.sheet import said_at, things_of
from ninja_game.play.level.hud_view import named_in
from ninja_game.play.level.level_play import things_at_start
from ninja_game.play.menu_screen import CANCEL, Action, Menu, MenuRow, MenuScreen, ask_to_keep
from ninja_game.runs.messages import Heard, heard, late_text, short_text, shown_ticks
from ninja_game.runtime import NewestJob
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside
from ninja_game.sim.level import COLUMNS, ROWS, Level
from ninja_game.sim.rules import CELL, LIFETIME, TICKS_PER_SECOND
from ninja_game.sim.schema.world_fields import World
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.text_entry import TextArea, TextEntry
from ninja_game.ui.theme import Area, Palette, Theme, contains_point, mixed
from ninja_game.ui.widgets import Button, Widget
from ninja_game.view.hud import Hud, HudView, PlacedMessage, placed_message
from ninja_game.view.places import Things
from ninja_game.view.sprites.thumbnail import open_exit, thumbnail

_ROW, _TOP, _WIDE = 112, 60, 294
SHOWN = 4  # rows that are shown at once
END = _TOP + _ROW * SHOWN
_PICTURE: Area = (342, _TOP, 422, 422 * HEIGHT / WIDTH)  # where the level is shown with the selected message

_WHEN = {
    "start": ("At the start", "At each start, until the exit is open"),
    "switch": ("Exit opens", "Once, when the ninja opens the exit"),
    "gold": ("Gold is taken", "Once, when the ninja takes the first gold"),
    ALL_GOLD: ("All gold taken", "Once, when the ninja has taken the last gold"),
    "death": ("After deaths", "At the start, after so many deaths"),
    "lock": ("A door unlocks", "Once, when a locked door opens"),
    "trap": ("A trap closes", "Once, when a trap door closes"),
    "after": ("After seconds", "Once, when a try has lasted so long"),
    "at": ("Near a place", "Beside it, when the ninja first comes into its frame, while it is there"),
}
"""The name of each moment, and when it is."""

_HELP = (
    "What happens replaces the text before it, a place the bubble before it; a time waits.",
    "An important text (!) holds other texts back until it was read, a bubble other bubbles.",
    f"{listed(KEYS)} become the player's keys.",
    f"{listed(NUMBER_WORDS)} become the number: 'Deaths: {{deaths}}'.",
    f"{listed(TARGETS)} have an arrow while their message is shown.",
    "In a level with messages the game gives no help of its own in play.",
)

_HANDLE = 9.0  # side of the handles of the selected frame, px of the level

_IMPORTANT_HINT = "The selected message comes at once, and is not replaced before it was read: marked with !"

_TIME_HINT = "Seconds that it stays: from 0.1 to 99.9; empty: as its letters and those of its moment need"


@lru_cache(maxsize=4)
def _things_of_run(level: Level, inputs: bytes, *, tagged: bool) -> Things:
    return things_at_start(level, Simulation(level).world, ["{exit}"] * tagged, inputs)


_Question = tuple[tuple[LevelMessage, ...], Level, bytes, bool]
"""Messages, their level, the inputs of its known run, and whether texts name the switch or exit."""
_Answer = tuple[_Question, list[Heard | None], Things]
"""When each message comes in that run, and what texts should not cover."""


def _answer(question: _Question) -> _Answer:
    messages, level, inputs, tagged = question
    return question, heard(messages, level, inputs), _things_of_run(level, inputs, tagged=tagged)


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
        self.number = 0  #: of the selected message
        self._stages: dict[tuple[object, ...], _Stage] = {}
        self._known: NewestJob[_Question, _Answer] = NewestJob(_answer)
        self._asked: _Question | None = None
        self._answer_drawn = True
        self._ground = Ground(draft.level)
        self._look, self._certifying_inputs = mood, certifying_inputs
        self._before = self.source
        self._wanted = at
        self._here, self._put, self._test = here, put, test
        self.rows: list[list[Widget]] = []  #: by message its button, then its fields
        self._refused = False
        self._drag_begin: Cell = NO_CELL
        self._dragged_frame: Callable[[Cell], CellArea] | None = None  #: the frame for the pointer's cell

    @property
    def source(self) -> str:
        return f" {SEPARATOR} ".join(message.source for message in self.messages)

    def enter(self) -> None:
        super().enter()
        if (number := self._wanted) is not None:
            self._wanted = None
            self.select(number)

    def select(self, number: int, field: int = TEXT) -> None:
        """Show the row of a message, with the focus on a field of it."""
        self.number = number
        self.enter()
        self.focus, self.redraw = self.rows[number][field], True

    def build(self) -> Sequence[Widget]:
        self.rows = [self._row(number) for number in range(len(self.messages))]
        rows = [widget for row in self.rows[self.first : self.first + SHOWN] for widget in row]
        y, some, full = END + 14, bool(self.messages), len(self.messages) >= MAX_MESSAGES
        if len(self.messages) > SHOWN:
            pages, page = -(-len(self.messages) // SHOWN), self.first // SHOWN
            text, others = f"Page {page + 1} of {pages}", (page + 1) % pages * SHOWN
            rows.append(Button((600, 15, 98, 26), text, partial(self.select, others), hint="The others: the wheel"))
        most = f"{MAX_MESSAGES} is the most: remove one first" if full else ""
        up, down = (partial(self._reorder, by) if some else None for by in (-1, 1))
        buttons: list[tuple[float, float, str, Action | None, str]] = [
            (36, 48, "Add", None if full else self._add, most),
            (88, 54, "Copy", self._copy if some and not full else None, "The selected message once more: Ctrl+D"),
            (146, 44, "Up", up, "The selected message earlier: Ctrl+Up; with Shift the first"),
            (194, 56, "Down", down, "The selected message later: Ctrl+Down; with Shift the last"),
            (254, 76, "Remove", self._remove if some else None, "Take the selected message away"),
            (450, 98, "Test", self._try, "Play from just before the selected message; Esc comes back"),
            (558, 98, "OK", self._accept, "Ctrl+Enter"),
            (666, 98, "Cancel", self.close, ""),
        ]
        mark = self._mark if some else None
        self._important = Button((342, y, 98, 28), "Important: no", mark, hint=_IMPORTANT_HINT, size=10.5)
        fixed = [Button((x, y, w, 28), text, do, hint=hint, size=10.5) for x, w, text, do, hint in buttons]
        return [*rows, *fixed[:5], self._important, *fixed[5:]]

    @property
    def first(self) -> int:
        """The number of the first message that is shown."""
        return self.number // SHOWN * SHOWN

    def _row(self, number: int) -> list[Widget]:
        message, y = self.messages[number], _TOP + _ROW * (number % SHOWN)
        area = 36, y + 31, _WIDE, 60
        new_line = f"Enter begins a new line: {MAX_MESSAGE_LINES} at most; Ctrl+Enter is OK"
        text = TextArea(
            area, "What is said", message.text, lambda _: None, longest=MAX_LETTERS, most_lines=MAX_MESSAGE_LINES
        )

        def put(typed: str) -> None:
            message.text = typed
            known = f"Words: {listed(WORDS)}" if "{" in typed else new_line
            text.hint = message.problem[1] if message.unknown else known

        put(message.text)
        text.put = put
        change = partial(self._change_moment, message)
        moment = Button(
            (36, y, 118, 28), f"{_WHEN[message.when][0]}...", lambda: self._ask_moment(change, message.when)
        )
        details: list[Widget] = []
        if message.when in DETAILS:
            (prompt, hint), detail = DETAILS[message.when], partial(setattr, message, "detail")
            details.append(TextEntry((157, y, 86, 28), prompt, message.detail, detail, longest=11, hint=hint))
        usual = shown_ticks(message.when, len(self._together(message)), message.text) // TICKS_PER_SECOND
        put_time = partial(setattr, message, "time")
        auto = "while there" if message.when == "at" else f"auto ({usual} s)"
        time = TextEntry((246, y, 84, 28), auto, message.time, put_time, longest=6, hint=_TIME_HINT)
        return [moment, *details, time, text]

    def _ask_moment(self, choose: Callable[[str], object], at: str) -> None:
        rows: list[MenuRow] = [(name, partial(choose, when), about) for when, (name, about) in _WHEN.items()]
        self.app.push(Menu(self.app, "When is it said?", [*rows, CANCEL], at=list(_WHEN).index(at)))

    def _change_moment(self, message: MessageRow, when: str) -> None:
        if when != message.when:
            message.when = when
            message.detail = {"death": "3", "after": "20", "at": "{},{}".format(*self._here)}.get(when, "")
            self.enter()

    @property
    def selected(self) -> MessageRow | None:
        return self.messages[self.number] if self.number < len(self.messages) else None

    def _handle_mouse(self, event: pygame.Event) -> None:
        """A click in the picture selects what lies there, or puts the selected message there; a drag frames it.

        Beside the picture the wheel turns the page.
        """
        if event.type == pygame.MOUSEWHEEL:
            number = self.first + (SHOWN if event.y < 0 else -SHOWN)
            if self._level_point(pygame.mouse.get_pos()) is None and 0 <= number < len(self.messages):
                self.select(number)
            return
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
        elif away < near and number != self.number:
            self.select(number)
        elif parsed and all(abs(a - b) < half for a, b, half in zip(at, parsed.middle, parsed.reach, strict=True)):
            self._dragged_frame = partial(moved_frame, parsed.frame, cell)
        elif selected and selected.when == "at":
            if is_inside(cell_of(*at)):
                self._put_frame(LevelMessage("at", "", cell=cell, size=parsed.size if parsed else FRAME_SIZE).frame)
                self._dragged_frame = partial(area_between, cell)
        elif selected and not named and away >= near:
            self.app.notify(f"To put it there, choose {_WHEN['at'][0]} for it")

    def _put_frame(self, frame: CellArea) -> None:
        """Give the selected message a frame, if its middle is inside the level."""
        left, top, columns, rows = frame
        cell, size = (left + columns // 2, top + rows // 2), (min(columns, COLUMNS), min(rows, ROWS))
        if self.selected and is_inside(cell):
            self.selected.put_at(cell, size)
            self.enter()

    def _add(self) -> None:
        def choose(when: str) -> None:
            self.messages.append(MessageRow())
            self._change_moment(self.messages[-1], when)
            self.select(len(self.messages) - 1)

        self._ask_moment(choose, "start")

    def _put_at(self, number: int, message: MessageRow, others: list[MessageRow]) -> None:
        """Show the messages with one at that place among others, selected; a button keeps the focus."""
        number = min(max(0, number), len(others))
        behind = self.widgets.index(self.focus) - len(self.widgets) if self.focus else 0
        in_row = any(self.focus in row for row in self.rows)
        self.messages = [*others[:number], message, *others[number:]]
        self.select(number)
        self.focus = self.focus if in_row else self.widgets[behind]

    def _copy(self) -> None:
        if self.selected and len(self.messages) < MAX_MESSAGES:
            self._put_at(self.number + 1, replace(self.selected), self.messages)

    def _reorder(self, by: int) -> None:
        """Move the selected message by so many places, with Shift to the end."""
        if selected := self.selected:
            far = MAX_MESSAGES if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
            others = [other for other in self.messages if other is not selected]
            self._put_at(self.number + by * far, selected, others)

    def _mark(self) -> None:
        if self.selected:
            self.selected.important = not self.selected.important

    def _remove(self) -> None:
        del self.messages[self.number]
        self.number = min(self.number, max(0, len(self.messages) - 1))
        self.enter()

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
            self._test(self.number, self._eye(self.selected) if self.selected else None, self.source)

    def close(self) -> None:
        """Leave; ask first whether changes are kept."""
        if self.source == self._before:
            super().close()
        else:
            ask_to_keep(self.app, "The messages are changed", self._accept)

    def capture(self, event: InputEvent) -> bool:
        """Typed letters go to the text of the row with the focus; some keys do what the buttons do."""
        raw = event.raw
        keys = chord(raw).replace("shift+", "") if raw.type == pygame.KEYDOWN else ""
        by = {"ctrl+up": -1, "ctrl+down": 1}.get(keys, 0)
        if keys in {"ctrl+return", "ctrl+kp_enter"}:
            self._accept()
            return True
        if by or keys == "ctrl+d":
            self._reorder(by) if by else self._copy()
            return True
        names = {pygame.TEXTINPUT: "text", pygame.KEYDOWN: "unicode"}
        typed = getattr(raw, names.get(raw.type, ""), "")
        if typed.strip() and typed.isprintable() and not isinstance(self.focus, TextEntry):
            self.focus = next((row[-1] for row in self.rows if self.focus in row), self.focus)
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
        self.number = next((k for k, row in enumerate(self.rows) if self.focus in row), self.number)
        self._important.text = f"Important: {'yes' if self.selected and self.selected.important else 'no'}"
        self._ask_about_run()
        for number in range(self.first, min(self.first + SHOWN, len(self.messages))):
            self._draw_notes(surface, number)
        count = f"{len(self.messages)} of {MAX_MESSAGES}"
        theme.text(surface, count, 764, 24, size=11, colour=theme.palette.on_tile, align="right")
        self._draw_level(surface, self.selected)
        x, y, w, h = _PICTURE
        top = y + h + 10
        if self.selected and self.selected.problem[1] and (wrong := self._wrong(self.selected)):
            text = f"Message {self.number + 1} is wrong. {wrong}"
            theme.paragraph(surface, [text], (x, top, w, 34), 13, 17, colour=theme.palette.bad)
            top += 38
        below = x, top, w, END - top
        theme.paragraph(surface, self._help_texts(), below, 10, 13.5, colour=theme.palette.faint)

    def _draw_notes(self, surface: pygame.Surface, number: int) -> None:
        """Draw the number of a message, its problem, and the count of its letters around its fields."""
        theme, palette, message = self.theme, self.theme.palette, self.messages[number]
        row, length = _TOP + _ROW * (number % SHOWN), len(message.text)
        for place, mark in enumerate((str(number + 1), IMPORTANT * message.important)):
            theme.text(surface, mark, 32, row + 36 + 34 * place, size=9, bold=True, align="right")
        colour = palette.faint if length < MAX_LETTERS else palette.bad
        theme.text(surface, f"{length} of {MAX_LETTERS}", 36 + _WIDE, row + 95, size=8.5, colour=colour, align="right")
        wrong = self._wrong(message)
        if not wrong and number == self.number and length >= MAX_LETTERS:
            wrong = "Full: what is typed beyond is left out"
        text, colour = (
            (wrong, palette.bad) if wrong else (self._wait_of(message) or self._turn_of(message), palette.faint)
        )
        theme.text(surface, text, 36, row + 95, size=8.5, colour=colour, width=_WIDE - 56)
        if number == self.number:
            theme.canvas.fill_rect(surface, palette.accent, 32.5, row, 2, 91)

    def _wrong(self, message: MessageRow) -> str:
        """The problem of a message, "" if it has none. An empty field is one only after OK was refused."""
        field, problem = message.problem
        if message.unknown:
            return f"There is no {message.unknown}: the words are at the right"
        if problem:
            return problem if self._refused or field == TIME or (field != TEXT and message.detail) else ""
        for finding in self._unseen(message):
            return f"Never shown: {finding.text.rpartition(': ')[2]}"
        return self._wait_of(message, lost=True)

    def _help_texts(self) -> list[str]:
        texts, selected = [], self.selected
        if selected:
            name, when = _WHEN[selected.when]
            texts.append(f"{name}: {when[0].lower()}{when[1:]}.")
        if selected and selected.when == "at":
            texts.append("In the picture: a click puts it, a drag draws its frame, moves it or an edge.")
        if len(self._things_of(selected)) > 1:
            texts.append("A click in the picture on one of them: only when it is that one.")
        advice = [finding.advice for finding in self._unseen(selected)]
        return [*texts, *advice, *(_HELP[2:] if advice or (selected and selected.problem[1]) else _HELP)]

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

    def _heard(self, message: MessageRow) -> Heard | None:
        """When a message comes in the known run; None: never, without such a run, or not known yet."""
        answer, sound = self._known.result, self._sound()
        if not answer or answer[0] != self._asked or message not in sound:
            return None
        return answer[1][sound.index(message)]

    def _wait_of(self, message: MessageRow, *, lost: bool = False) -> str:
        """That a message is lost to others in the known run, or how late or short it is; '' if it is not."""
        sound = () if lost or message.problem[1] else parse_messages(message.source)
        moment = self._heard(message) if self._together(message)[0] is message else None
        is_so = moment and (moment.tick is None) is lost
        late = late_text(moment, len(self._certifying_inputs())) if moment and is_so else ""
        text = late or "".join(map(short_text, sound))
        return text[:1].upper() + text[1:]

    def _together(self, message: MessageRow) -> list[MessageRow]:
        return [other for other in self.messages if other.moment == message.moment]

    def _stage(self, message: MessageRow | None) -> _Stage:
        """The level's picture for a message, painted once for each look."""
        width, opened = self.theme.canvas.rect(*_PICTURE).width, bool(message and message.when == "switch")
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
        taken = {ALL_GOLD: all_gold, "gold": int(number) if number.isdecimal() else 1}.get(message.when, 0)
        deaths = int(number) if message.when == "death" and number.isdecimal() else 0

        def key(word: str) -> str:
            return controls.name(word) if word in KEYS else f"{{{word}}}"

        text = level_text(message.text.strip(), key, taken, all_gold, deaths)
        parsed, moment = self._parsed(message), self._heard(message)
        if moment and message.when != "start":
            spot: Point | None = moment.spot
        else:
            spot = None if parsed else self._eye(message)
        layout = self._draft.level.tiles, self._things(stage), parsed, spot
        return placed_message(text, *layout, of_start=message.when == "start") if text else None

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
        scale, palette = _PICTURE[2] / WIDTH, self.theme.palette
        x, y = _PICTURE[0] + at[0] * scale, _PICTURE[1] + at[1] * scale
        self.theme.canvas.circle(surface, palette.accent, (x, y), 6)
        self.theme.text(surface, str(number + 1), x, y - 4.5, size=9, align="centre", colour=palette.background)

    def _things_of(self, message: MessageRow | None) -> list[Point]:
        """The objects that a message can be about, px: the gold, or the switches of its moment."""
        return things_of(self._draft, message.when) if message and message.when in DETAILS else []

    def _parsed(self, message: MessageRow | None) -> LevelMessage | None:
        """A message near a place as the level will have it; None for others and without a valid place."""
        return message.parsed if message and message.when == "at" else None

    def _eye(self, message: MessageRow) -> Point | None:
        """Where the ninja is when a message appears, px; None at the start, or where that is unknown."""
        parsed = message.parsed
        return parsed and (parsed.place or said_at(self._draft, parsed))
