"""The screen of a level's messages: a row for each message and its moment."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from math import dist

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.errors import LevelError
from ninja_game.formats.messages import (
    ALL_GOLD,
    ANY,
    BAR,
    KEYS,
    MAX_LETTERS,
    MAX_MESSAGE_LINES,
    MAX_MESSAGES,
    SIZE,
    TARGETS,
    LevelMessage,
    arrow_targets,
    in_a_header,
    named_keys,
    parse_messages,
    unknown_words,
)
from ninja_game.levels.episodes import Mood
from ninja_game.levels.findings import Finding
from ninja_game.levels.lint import Ground, unseen_messages
from ninja_game.play.app import App
from ninja_game.play.editor.sheet import said_at, things_of
from ninja_game.play.level.hud_view import named_in
from ninja_game.play.level.level_play import things_at_start
from ninja_game.play.menu_screen import CANCEL, Action, Menu, MenuRow, MenuScreen, ask_to_keep
from ninja_game.runs.messages import Heard, heard, late_text, shown_ticks
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside
from ninja_game.sim.level import COLUMNS, ROWS, Level
from ninja_game.sim.rules import CELL, LIFETIME, TICKS_PER_SECOND
from ninja_game.sim.schema.world_fields import World
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.text_entry import TextArea, TextEntry
from ninja_game.ui.theme import Area, Palette, Theme, inside, mixed
from ninja_game.ui.widgets import Button, Widget
from ninja_game.view.hud import Hud, HudView, placed_message
from ninja_game.view.places import Things
from ninja_game.view.sprites.thumbnail import open_exit, thumbnail

_ROW, _TOP, _WIDE = 112, 60, 294
SHOWN = 4
"""Rows that are shown at once."""
END = _TOP + _ROW * SHOWN
_PICTURE: Area = (342, _TOP, 422, 422 * HEIGHT / WIDTH)
"""Where the level is shown with the selected message."""

_WHEN = {
    "start": ("At the start", "At each start, until the exit is open"),
    "switch": ("Exit opens", "Once, when the ninja opens the exit"),
    "gold": ("Gold is taken", "Once, when the ninja takes the first gold"),
    ALL_GOLD: ("All gold taken", "Once, when the ninja has taken the last gold"),
    "death": ("After deaths", "At the start, after so many deaths"),
    "lock": ("A door unlocks", "Once, when a locked door opens"),
    "trap": ("A trap closes", "Once, when a trap door closes"),
    "after": ("After seconds", "Once, when a try has lasted so long"),
    "at": ("Near a place", "Beside it, when the ninja first comes into its frame"),
}
"""The name of each moment, and when it is."""

_ONE = "Which one: column and row of the gold or switch, or a click on it in the picture; empty: the first of any"

_DETAILS = {
    **dict.fromkeys(("switch", "lock", "trap"), ("any", _ONE)),
    "gold": ("any", f"{_ONE}; 3: after so many"),
    "death": ("deaths", "How many deaths: a number from 1 to 99"),
    "after": ("seconds", "How many seconds: a number from 1 to 99"),
    "at": ("12,5", "Column and row of the cell, 1,1 to 31,23, then perhaps the frame's: 12,5 or 12,5 3x3"),
}
"""What some moments may need besides: an example, and a hint."""

_HELP = (
    "{" + "}, {".join(KEYS) + "} become the key or button of whoever plays;",
    "{" + "} and {".join(TARGETS) + "} have an arrow while their message is shown.",
)

DETAIL, TIME, _TEXT = 1, -2, -1
"""Places of the fields in a row."""

GRIP = 9.0
"""px of the level from the edge of a frame within which a drag sizes it."""

_TIME_HINT = "Seconds that it stays: a number from 1 to 99; empty: as its letters and those of its moment need"

_WORDS = ", ".join(f"{{{name}}}" for name in KEYS + TARGETS)


@dataclass(eq=False)
class MessageRow:
    """``when``: as of a LevelMessage. As typed: ``detail``, of _DETAILS, and ``time``, the seconds that it is shown."""

    when: str = "start"
    detail: str = ""
    text: str = ""
    time: str = ""

    @property
    def moment(self) -> str:
        return f"{self.when} {' '.join(self.detail.split())}{' s' if self.when == 'after' else ''}".strip()

    @property
    def seconds(self) -> int:
        return int(self.time) if self.time.isdecimal() else 0

    @property
    def source(self) -> str:
        shown_for = f" for {self.seconds} s" if self.seconds else ""
        return f"{self.moment}{shown_for}: {in_a_header(self.text)}"

    @property
    def problem(self) -> tuple[int, str]:
        """Which field of the row is wrong, DETAIL, TIME or _TEXT, and the problem in words; '' for none."""
        moment = self.moment
        if self.when in _DETAILS and (":" in moment or not _fits(f"{moment}: a text")):
            return DETAIL, _DETAILS[self.when][1]
        if self.time and not self.seconds:
            return TIME, _TIME_HINT
        if not self.text.strip():
            return _TEXT, "Type what is said, or remove the message"
        if BAR in self.text:
            return _TEXT, f"A message has no {BAR}"
        return _TEXT, self.unknown and f"{self.unknown} is not one of {_WORDS}"

    @property
    def unknown(self) -> str:
        """The first unknown word in braces, with the braces; '' for none."""
        return next((f"{{{name}}}" for name in unknown_words(self.text)), "")


def _fits(source: str) -> bool:
    try:
        return bool(parse_messages(source))
    except LevelError:
        return False


def messages_of(says: str) -> list[MessageRow]:
    return [MessageRow(m.when, _detail(m), m.text, str(m.seconds or "")) for m in parse_messages(says)]


def _detail(message: LevelMessage) -> str:
    if message.cell == ANY:
        return str(message.number or "")
    return "{},{}".format(*message.cell) + (" {}x{}".format(*message.size) if message.size != SIZE else "")


def _edges_at(message: LevelMessage, x: float, y: float) -> tuple[bool, bool]:
    """Whether a point, px, is on an upright and on a level edge of a message's frame."""
    (px, py), (w, h) = message.place or (0.0, 0.0), message.reach
    across, down = abs(x - px), abs(y - py)
    return abs(across - w) <= GRIP and down <= h + GRIP, abs(down - h) <= GRIP and across <= w + GRIP


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
    """``here``: the default cell of a new message near a place. ``put``: gets the new value of the header.

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
        self._selected = 0
        self._stages: dict[tuple[object, ...], _Stage] = {}
        self._things: dict[tuple[bool, bytes], Things] = {}
        self._ground = Ground(draft.level)
        self._look, self._certifying_inputs = mood, certifying_inputs
        self._before = self.source
        self._wanted = at
        self._here, self._put, self._test = here, put, test
        self._row_widgets: list[list[Widget]] = []
        self._refused = False
        self._sizes = False, False  #: whether the drag sizes the frame, across and down

    @property
    def source(self) -> str:
        return f" {BAR} ".join(message.source for message in self.messages)

    def enter(self) -> None:
        super().enter()
        if (number := self._wanted) is not None:
            self._wanted = None
            self._select(number)

    def _select(self, number: int, field: int = _TEXT) -> None:
        """Show the row of a message, with the focus on a field of it."""
        self._selected = number
        self.enter()
        self.focus, self.redraw = self._row_widgets[number][field], True

    def build(self) -> Sequence[Widget]:
        self._row_widgets = [self._row(number) for number in range(len(self.messages))]
        rows = [widget for row in self._row_widgets[self._first : self._first + SHOWN] for widget in row]
        y, some, full = END + 14, bool(self.messages), len(self.messages) >= MAX_MESSAGES
        if len(self.messages) > SHOWN:
            text, others = f"Page {self._first // SHOWN + 1} of 2", (self._first + SHOWN) % MAX_MESSAGES
            rows.append(Button((342, y, 98, 28), text, partial(self._select, others), hint="The other messages"))
        most = f"{MAX_MESSAGES} is the most: remove one first" if full else ""
        up, down = (partial(self._reorder, by) if some else None for by in (-1, 1))
        buttons: list[tuple[float, float, str, Action | None, str]] = [
            (36, 48, "Add", None if full else self._add, most),
            (88, 54, "Copy", self._copy if some and not full else None, "The selected message once more: Ctrl+D"),
            (146, 44, "Up", up, "The selected message earlier: Ctrl+Up; with Shift the first"),
            (194, 56, "Down", down, "The selected message later: Ctrl+Down; with Shift the last"),
            (254, 76, "Remove", self._remove if some else None, "Take the selected message away"),
            (450, 98, "Test", self._try, "Play from just before the selected message; Esc comes back"),
            (558, 98, "OK", self._accept, ""),
            (666, 98, "Cancel", self.close, ""),
        ]
        return [*rows, *(Button((x, y, w, 28), text, do, hint=hint, size=10.5) for x, w, text, do, hint in buttons)]

    @property
    def _first(self) -> int:
        """The number of the first message that is shown."""
        return self._selected // SHOWN * SHOWN

    def _row(self, number: int) -> list[Widget]:
        message, y = self.messages[number], _TOP + _ROW * (number % SHOWN)
        area, new_line = (36, y + 31, _WIDE, 60), f"Shift+Enter begins a new line: {MAX_MESSAGE_LINES} at most"
        text = TextArea(
            area, "What is said", message.text, lambda _: None, longest=MAX_LETTERS, most_lines=MAX_MESSAGE_LINES
        )

        def put(typed: str) -> None:
            message.text = typed
            about_keys = "{jump} becomes the key or button of whoever plays" if "{" in typed else new_line
            text.hint = message.problem[1] if message.unknown else about_keys

        put(message.text)
        text.put = put
        moment = Button((36, y, 118, 28), f"{_WHEN[message.when][0]}...", lambda: self._ask_moment(message))
        details: list[Widget] = []
        if message.when in _DETAILS:
            (prompt, hint), detail = _DETAILS[message.when], partial(setattr, message, "detail")
            details.append(TextEntry((157, y, 86, 28), prompt, message.detail, detail, longest=11, hint=hint))
        usual = shown_ticks(message.when, len(self._together(message)), message.text) // TICKS_PER_SECOND
        put_time = partial(setattr, message, "time")
        time = TextEntry((246, y, 84, 28), f"auto ({usual} s)", message.time, put_time, longest=2, hint=_TIME_HINT)
        return [moment, *details, time, text]

    def _ask_moment(self, message: MessageRow) -> None:
        def choose(when: str) -> None:
            if when == message.when:
                return
            message.when = when
            message.detail = {"death": "3", "after": "20", "at": "{},{}".format(*self._here)}.get(when, "")
            self.enter()

        rows: list[MenuRow] = [(name, partial(choose, when), about) for when, (name, about) in _WHEN.items()]
        self.app.push(Menu(self.app, "When is it said?", [*rows, CANCEL], at=list(_WHEN).index(message.when)))

    @property
    def selected(self) -> MessageRow | None:
        return self.messages[self._selected] if self._selected < len(self.messages) else None

    def _handle_mouse(self, event: pygame.Event) -> None:
        """A click in the picture selects the message there, or moves the selected one; a drag moves or sizes it."""
        pressed = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT
        drags = event.type == pygame.MOUSEMOTION and event.buttons[0] and self._dragged is None
        x, y = self.theme.canvas.logical(event.pos) if pressed or drags else (0.0, 0.0)
        if not inside(_PICTURE, x, y):
            super()._handle_mouse(event)
            return
        x, y = ((at - start) * WIDTH / _PICTURE[2] for at, start in zip((x, y), _PICTURE, strict=False))
        column, row = cell_of(x, y)
        eyes = ((k, self._eye(message)) for k, message in enumerate(self.messages))
        there = {k: dist(eye, (x, y)) for k, eye in eyes if eye}
        parsed, selected = self._parsed(self.selected), self.selected
        things = {cell_of(*at): dist(at, (x, y)) for at in self._things_of(selected)} if pressed else {}
        named = "{},{}".format(*min(things, key=things.__getitem__, default=ANY))
        if pressed:
            self._sizes = _edges_at(parsed, x, y) if parsed and min(there.values()) > GRIP else (False, False)
        if selected and min(things.values(), default=WIDTH) < 1.5 * CELL and selected.detail != named:
            selected.detail = named
            self.enter()
        elif pressed and not any(self._sizes) and min(there.values(), default=WIDTH) < 1.5 * CELL:
            self._select(min(there, key=there.__getitem__))
        elif parsed and selected and any(self._sizes):
            wide = min(COLUMNS, 2 * abs(column - parsed.cell[0]) + 1) if self._sizes[0] else parsed.size[0]
            high = min(ROWS, 2 * abs(row - parsed.cell[1]) + 1) if self._sizes[1] else parsed.size[1]
            selected.detail = _detail(parsed._replace(size=(wide, high)))
            self.enter()
        elif selected and selected.when == "at" and is_inside((column, row)):
            size = parsed.size if parsed else SIZE
            selected.detail = _detail(LevelMessage("at", "", cell=(column, row), size=size))
            self.enter()
        elif pressed and self.selected:
            self.app.notify(f"To put it there, choose {_WHEN['at'][0]} for it")
        self.redraw = True

    def _add(self) -> None:
        self.messages.append(MessageRow())
        self._select(len(self.messages) - 1)

    def _put_at(self, number: int, message: MessageRow, others: list[MessageRow]) -> None:
        """Show the messages with one at that place among others, selected; a button keeps the focus."""
        number = min(max(0, number), len(others))
        behind = self.widgets.index(self.focus) - len(self.widgets) if self.focus else 0
        in_row = any(self.focus in row for row in self._row_widgets)
        self.messages = [*others[:number], message, *others[number:]]
        self._select(number)
        self.focus = self.focus if in_row else self.widgets[behind]

    def _copy(self) -> None:
        if self.selected and len(self.messages) < MAX_MESSAGES:
            self._put_at(self._selected + 1, replace(self.selected), self.messages)

    def _reorder(self, by: int) -> None:
        """Move the selected message by so many places, with Shift to the end."""
        if selected := self.selected:
            far = MAX_MESSAGES if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
            others = [other for other in self.messages if other is not selected]
            self._put_at(self._selected + by * far, selected, others)

    def _remove(self) -> None:
        del self.messages[self._selected]
        self._selected = min(self._selected, max(0, len(self.messages) - 1))
        self.enter()

    def _is_sound(self) -> bool:
        """Whether all messages are valid; else the first that is not gets the focus and shows the problem."""
        for number, message in enumerate(self.messages):
            field, problem = message.problem
            if problem:
                self._refused = True
                self._select(number, field)
                return False
        return True

    def _accept(self) -> None:
        if self._is_sound():
            self.app.pop()
            self._put(self.source)

    def _try(self) -> None:
        if self._is_sound():
            self._test(self._selected, self._eye(self.selected) if self.selected else None, self.source)

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
        if by or keys == "ctrl+d":
            self._reorder(by) if by else self._copy()
            return True
        names = {pygame.TEXTINPUT: "text", pygame.KEYDOWN: "unicode"}
        typed = getattr(raw, names.get(raw.type, ""), "")
        if typed.strip() and typed.isprintable() and not isinstance(self.focus, TextEntry):
            self.focus = next((row[-1] for row in self._row_widgets if self.focus in row), self.focus)
        return super().capture(event)

    def act(self, action: str, *, held: bool = False) -> None:
        """Enter in a field means OK."""
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self._accept()
        else:
            super().act(action, held=held)

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme = self.theme
        self._selected = next((k for k, row in enumerate(self._row_widgets) if self.focus in row), self._selected)
        for number, message in list(enumerate(self.messages))[self._first : self._first + SHOWN]:
            row, length = _TOP + _ROW * (number % SHOWN), len(message.text)
            theme.text(surface, str(number + 1), 32, row + 36, size=9, bold=True, align="right")
            colour = theme.palette.faint if length < MAX_LETTERS else theme.palette.bad
            count = f"{length} of {MAX_LETTERS}"
            theme.text(surface, count, 36 + _WIDE, row + 95, size=8.5, colour=colour, align="right")
            wrong = message.problem[1] if self._refused else ""
            if message.unknown:
                wrong = f"There is no {message.unknown}: the words are at the right"
            elif not message.problem[1]:
                unseen = self._unseen(message)
                wrong = next((f"Never shown: {finding.text.rpartition(': ')[2]}" for finding in unseen), "")
                wrong = wrong or self._wait_of(message)
            colour = theme.palette.bad if wrong else theme.palette.faint
            theme.text(
                surface, wrong or self._turn_of(message), 36, row + 95, size=8.5, colour=colour, width=_WIDE - 56
            )
            if message is self.selected:
                theme.canvas.fill_rect(surface, theme.palette.accent, 32.5, row, 2, 91)
        count = f"{len(self.messages)} of {MAX_MESSAGES}"
        theme.text(surface, count, 764, 24, size=11, colour=theme.palette.on_tile, align="right")
        selected = self.selected
        self._draw_level(surface, selected)
        name, when = _WHEN[selected.when] if selected else ("", "")
        help_texts = [f"{name}: {when[0].lower()}{when[1:]}."] if selected else []
        if selected and selected.when == "at":
            help_texts.append("A click in the picture moves it, a drag of its frame sizes it.")
        if len(self._things_of(selected)) > 1:
            help_texts.append("A click in the picture on one of them: only when it is that one.")
        advice = [finding.advice for finding in self._unseen(selected)]
        x, y, w, h = _PICTURE
        below = x, y + h + 10, w, END - y - h - 10
        lines = (*help_texts, *advice, *_HELP[bool(advice) :])
        theme.paragraph(surface, lines, below, 11, 15, colour=theme.palette.faint)

    def _unseen(self, message: MessageRow | None) -> list[Finding]:
        return [*unseen_messages(message.source, self._ground)] if message and not message.problem[1] else []

    def _turn_of(self, message: MessageRow) -> str:
        """The number of a message among those of its moment; '' for an only one."""
        together = self._together(message)
        place = next(k for k, other in enumerate(together, 1) if other is message)
        return f"No. {place} of {len(together)}" if len(together) > 1 else ""

    def _heard(self, message: MessageRow) -> Heard | None:
        """When a message comes in the known run; None: never, or without such a run."""
        sound, inputs = [other for other in self.messages if not other.problem[1]], self._certifying_inputs()
        if not inputs or message not in sound or message.when in {"start", "death"}:
            return None
        parsed = [message for other in sound for message in parse_messages(other.source)]
        return heard(parsed, self._draft.level, inputs)[sound.index(message)]

    def _wait_of(self, message: MessageRow) -> str:
        """How late a message comes in the known run because others are read first; '' if it is in time."""
        text = late_text(moment) if (moment := self._heard(message)) else ""
        return text[:1].upper() + text[1:]

    def _together(self, message: MessageRow) -> list[MessageRow]:
        return [other for other in self.messages if other.moment == message.moment]

    def _draw_level(self, surface: pygame.Surface, message: MessageRow | None) -> None:
        """The level with a message as in play. The level is drawn once, the message in each picture."""
        theme, draft, place = self.theme, self._draft, self.theme.canvas.rect(*_PICTURE)
        size, opened = (place.width, theme, self.app.settings.text_size), bool(message and message.when == "switch")
        palette = self.app.palette_in(self._look)
        key = palette.name, size, opened
        if key not in self._stages:
            stages = {old: stage for old, stage in self._stages.items() if old[:2] == key[:2]}
            self._stages = stages | {key: _Stage(draft.level, palette, *size, opened=opened)}
        stage, placed, texts = self._stages[key], None, [other.text for other in self.messages]
        picture, cast = stage.picture.copy(), (bool(arrow_targets(texts)), self._certifying_inputs())
        if stage.world and cast not in self._things:
            self._things[cast] = things_at_start(draft.level, stage.world, texts, cast[1])
        if message:
            controls, when = self.app.controls, message.when
            text = named_keys(message.text.strip(), lambda name: controls.name(name) if name in KEYS else f"{{{name}}}")
            parsed, moment, things = self._parsed(message), self._heard(message), self._things.get(cast, ())
            spot = moment.spot if moment else None if parsed else self._eye(message)
            layout = draft.level.tiles, things, parsed and parsed.place, spot
            placed = placed_message(text, *layout, of_start=when == "start") if text else None
        for other in self.messages:
            if (parsed := self._parsed(other)) and (eye := parsed.place):
                (w, h), chosen = parsed.reach, other is message
                frame = eye[0] - w, eye[1] - h, 2 * w, 2 * h
                colour = palette.accent if chosen else mixed(palette.background, palette.accent, 0.4)
                stage.hud.theme.canvas.frame_rect(picture, colour, *frame, 1 + chosen)
        for at in self._things_of(message):
            named = at == (message and self._eye(message))
            stage.hud.theme.canvas.circle(picture, palette.accent, at, 13, 3 if named else 1)
        foot = draft.name, f"gold 0 / {draft.level.gold}"
        labels = named_in(stage.world, arrow_targets([message.text])) if stage.world and message else ()
        stage.hud.draw(picture, HudView(LIFETIME, "", foot, name=draft.name, message=placed, named=labels))
        surface.blit(picture, place)
        for number, other in enumerate(self.messages, 1):
            if other is not message and (eye := self._eye(other)):
                x, y = (start + at * _PICTURE[2] / WIDTH for start, at in zip(_PICTURE, eye, strict=False))
                theme.canvas.circle(surface, theme.palette.accent, (x, y), 6)
                theme.text(surface, str(number), x, y - 4.5, size=9, align="centre", colour=theme.palette.background)

    def _things_of(self, message: MessageRow | None) -> list[Point]:
        """What a message can be about, px: the gold, or the switches of its moment."""
        return things_of(self._draft, message.when) if message and message.when in _DETAILS else []

    def _parsed(self, message: MessageRow | None) -> LevelMessage | None:
        """A message near a place as the level will have it; None for others and without a valid place."""
        if message and message.when == "at" and message.problem[0] != DETAIL:
            return parse_messages(f"{message.moment}: a text")[0]
        return None

    def _eye(self, message: MessageRow) -> Point | None:
        """Where the ninja is when a message appears, px; None at the start, or where that is unknown."""
        if parsed := self._parsed(message):
            return parsed.place
        timeless = message.when == "start" or message.problem[0] == DETAIL
        return None if timeless else said_at(self._draft, parse_messages(f"{message.moment}: a text")[0])
