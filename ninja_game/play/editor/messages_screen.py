"""The screen of a level's messages: a list of them, and the selected one's fields beside the level."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import pygame

from ninja_game.document import common_length
from ninja_game.editor.draft import Draft
from ninja_game.editor.message_rows import EditedMessages, MessageField
from ninja_game.formats.messages import IMPORTANT, MAX_MESSAGES, Moment
from ninja_game.levels.episodes import Mood
from ninja_game.play.app import App
from ninja_game.play.editor.message_checks import MessageChecks
from ninja_game.play.editor.message_form import MOMENT_TEXTS, MessageForm
from ninja_game.play.editor.message_picture import MessagePicture, ninja_place, things_about
from ninja_game.play.menu_screen import Action, MenuScreen, ask_to_keep
from ninja_game.sim.grid import Cell, Point
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.list_view import BAR_WIDTH, ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Widget

_LIST: Area = (36, 60, 294, 17.5 * MAX_MESSAGES)  # all messages have room
_ASIDE: Area = (484, 388, 280, 134)  # where what is wrong is said, and help

_HELP = (
    "A place has its own bubble. An event (gold, a door) replaces the text that is shown; a time waits for it.",
    "Until an important message (!) was read, only another important one of its kind replaces it.",
    "In a level with messages the game gives no help of its own in play.",
    "Ctrl+Z undoes the last change here, a text word by word; Ctrl+Y redoes it.",
)

_LIST_HINT = "Enter or a second click: to its text; Del takes it away, Ctrl+Up and Ctrl+Down move it"


class MessagesScreen(MenuScreen):
    """The list of a level's messages, with the selected one in the level.

    ``new_place``: the default cell of a new message near a place. ``put``: gets the new value of the header.
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
        new_place: Cell,
        put: Callable[[str], object],
        test: Callable[[int, Point | None, str], object],
        mood: Mood,
        certifying_inputs: Callable[[], bytes],
        at: int | None = None,
    ) -> None:
        super().__init__(app)
        self.edited = EditedMessages(draft.says)
        self.checks = MessageChecks(draft, self.edited, certifying_inputs)
        self.form = MessageForm(app, self.edited, new_place, self.enter, self.focus_on_field)
        self.picture = MessagePicture(app, draft, self.edited, self.checks, mood, self.select, self.enter)
        left, top, width, height = _LIST
        area = left, top, width + BAR_WIDTH + 4, height
        row_height = height / MAX_MESSAGES
        self.list = ListView(area, row_height, self._draw_row, self.select, selected=self._follow, opens=True)
        self.list.hint = _LIST_HINT
        self.list.empty = "No messages yet: Add makes one"
        self._named: dict[str, Widget] = {}  #: all widgets, by the names of fields and buttons
        self._draft = draft
        self._before = self.edited.source
        self._put = put
        self._test = test
        if at is not None and at < len(self.edited.rows):
            self.select(at)

    def select(self, number: int, field: MessageField = MessageField.TEXT) -> None:
        """Select a message, with the focus on a field of it."""
        self.edited.index = number
        self.enter()
        self.focus_on_field(field)

    def focus_on_field(self, field: MessageField) -> None:
        self.focus = self.form.fields[field]
        self.redraw = True

    def _follow(self, number: int) -> None:
        """Another message may be selected in the list: show its fields."""
        self.edited.index = number
        if self.edited.selected is not self.form.row:
            self.enter()

    def enter(self) -> None:
        """Build the widgets again. The focus keeps the field or button that it has; not all messages have the same."""
        name = next((name for name, widget in self._named.items() if widget is self.focus), "")
        self.focus = None
        super().enter()
        widget = self._named.get(name)
        if widget and widget.focusable:
            self.focus = widget

    def build(self) -> Sequence[Widget]:
        edited = self.edited
        self.form.build()
        self.list.focusable = bool(edited.selected)
        self.list.index = edited.index
        self.list.fill([*edited.rows])
        self._named = {"list": self.list, **self._list_buttons(), **self.form.fields, **self._end_buttons()}
        return [*self._named.values()]

    def _list_buttons(self) -> dict[str, Widget]:
        full = f"{MAX_MESSAGES} is the most: remove one first" if self.edited.is_full else ""
        copy = partial(self._edit, self.edited.copy)
        buttons: list[tuple[float, float, str, Action, str]] = [
            (36, 48, "Add", self._add, full),
            (88, 54, "Copy", copy, "The selected message once more: Ctrl+D"),
            (146, 44, "Up", partial(self._reorder, -1), "The selected message earlier: Ctrl+Up; with Shift the first"),
            (194, 56, "Down", partial(self._reorder, 1), "The selected message later: Ctrl+Down; with Shift the last"),
            (254, 76, "Remove", partial(self._edit, self.edited.remove), "Take it away; Ctrl+Z brings it back"),
        ]
        named: dict[str, Widget] = {}
        for x, width, text, action, hint in buttons:
            is_missing = not self.edited.selected and text != "Add"
            is_too_much = full and text in ("Add", "Copy")
            able = None if is_missing or is_too_much else action
            named[text] = Button((x, 352, width, 28), text, able, hint=hint, size=10.5)
        return named

    def _end_buttons(self) -> dict[str, Widget]:
        buttons: list[tuple[float, str, Action, str]] = [
            (484, "Test", self._play_test, "Play from just before the selected message; Esc comes back"),
            (580, "OK", self._accept, "Ctrl+Enter"),
            (676, "Cancel", self.close, ""),
        ]
        return {text: Button((x, 528, 88, 28), text, do, hint=hint, size=10.5) for x, text, do, hint in buttons}

    def _handle_mouse(self, event: pygame.Event) -> None:
        """The picture has its own clicks and drags; beside it the wheel selects the next message."""
        if event.type == pygame.MOUSEWHEEL:
            if self.picture.level_point(pygame.mouse.get_pos()) is None:
                self.list.select(self.list.index - event.y)
                self.redraw = True
            return
        if event.type == pygame.MOUSEBUTTONUP:
            self.picture.release()
        if self._dragged is None and self.picture.handle(event):
            self.redraw = True
        else:
            super()._handle_mouse(event)

    def _add(self) -> None:
        def choose(when: Moment) -> None:
            self.form.change_moment(self.edited.add(), when)
            self.select(self.edited.index)

        self.form.ask_moment(choose, Moment.START)

    def _edit(self, change: Callable[[], object]) -> None:
        change()
        self.enter()

    def _reorder(self, by: int) -> None:
        """Move the selected message by so many places, with Shift to the end."""
        far = MAX_MESSAGES if pygame.key.get_mods() & pygame.KMOD_SHIFT else 1
        self._edit(partial(self.edited.move, by * far))

    def _record(self) -> None:
        """Put what has changed since the last event into the history; a typed word, and a drag, is one step."""
        typed = self.focus.edited if isinstance(self.focus, TextEntry) else None
        self.edited.record(self.picture.frame_drag or (typed and (typed, len(typed.past))))

    def _restore(self, step: Callable[[], bool]) -> None:
        """Undo or redo, with the cursor behind what that changes in the text."""
        before = self.focus.text if isinstance(self.focus, TextEntry) else None
        if not self.edited.restore(step):
            return
        self.enter()
        field = self.focus
        if isinstance(field, TextEntry) and before not in (None, field.text):
            behind = common_length(before[::-1], field.text[::-1])
            field.edited.go(len(field.text) - behind)

    def _is_valid(self) -> bool:
        """Whether all messages are; else the first that is not gets the focus and shows the problem."""
        for number, row in enumerate(self.edited.rows):
            field, problem = row.problem
            if problem:
                self.checks.refused = True
                self.select(number, field)
                if field != MessageField.TEXT and isinstance(self.focus, TextEntry):
                    self.focus.edited.select_all()
                return False
        return True

    def _accept(self) -> None:
        if self._is_valid():
            self.app.pop()
            self._put(self.edited.source)

    def _play_test(self) -> None:
        if self._is_valid():
            row = self.edited.selected
            self._test(self.edited.index, ninja_place(self._draft, row) if row else None, self.edited.source)

    def close(self) -> None:
        """Leave; ask first whether changes are kept."""
        if self.edited.source == self._before:
            super().close()
        else:
            ask_to_keep(self.app, "The messages are changed", self._accept)

    def capture(self, event: InputEvent) -> bool:
        """Typed letters go to the text unless another field has the focus; some keys do what the buttons do."""
        self._record()
        raw = event.raw
        command = self._command_of(chord(raw)) if raw.type == pygame.KEYDOWN else None
        if command:
            command()
            self.redraw = True
            return True
        names = {pygame.TEXTINPUT: "text", pygame.KEYDOWN: "unicode"}
        typed = getattr(raw, names.get(raw.type, ""), "")
        is_text = typed.strip() and typed.isprintable()
        if is_text and self.edited.selected and not isinstance(self.focus, TextEntry):
            self.focus_on_field(MessageField.TEXT)
        return super().capture(event)

    def _command_of(self, keys: str) -> Action | None:
        commands: dict[str, Action] = {
            "ctrl+z": partial(self._restore, self.edited.history.undo),
            "ctrl+y": partial(self._restore, self.edited.history.redo),
            "ctrl+d": partial(self._edit, self.edited.copy),
            "ctrl+up": partial(self._reorder, -1),
            "ctrl+down": partial(self._reorder, 1),
            **dict.fromkeys(("ctrl+return", "ctrl+kp_enter"), self._accept),
        }
        if self.focus is self.list:
            commands["delete"] = partial(self._edit, self.edited.remove)
        return commands.get("ctrl+y" if keys == "ctrl+shift+z" else keys.replace("shift+", ""))

    def act(self, action: str, *, held: bool = False) -> None:
        """Enter in a field of one line leads to the text."""
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self.focus_on_field(MessageField.TEXT)
        else:
            super().act(action, held=held)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        if self.checks.has_new_answer():
            self.redraw = True

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme = self.theme
        self.checks.ask_about_run()
        count = f"{len(self.edited.rows)} of {MAX_MESSAGES}"
        theme.text(surface, count, 764, 24, size=11, colour=theme.palette.on_tile, align="right")
        theme.panel(surface, *_LIST)
        self.picture.draw(surface)
        self.form.draw(surface, theme)
        self._draw_aside(surface)

    def _draw_aside(self, surface: pygame.Surface) -> None:
        """What is wrong with the selected message and how to mend it, if anything; help."""
        theme, row = self.theme, self.edited.selected
        x, y, width, height = _ASIDE
        about = self._about_moment()
        problem = self.checks.problem(row) if row else ""
        remark = self.checks.remark(row) if row else ""
        texts = [about, " ".join(_HELP)]
        if row and (problem or remark):
            text = f"Message {self.edited.index + 1} is wrong. {problem}" if problem else remark
            colour = theme.palette.bad if problem else theme.palette.text
            lines = [text, self.checks.advice(row)]
            used = theme.paragraph(surface, lines, (x, y, width, 70), 11, 14, colour=colour) + 6
            texts = [about]
            y, height = y + used, height - used
        theme.paragraph(surface, texts, (x, y, width, height), 10, 13, colour=theme.palette.faint)

    def _about_moment(self) -> str:
        """Help about the selected message."""
        row = self.edited.selected
        if not row:
            return ""
        name, when = MOMENT_TEXTS[row.when]
        texts = [f"{name}: {when[0].lower()}{when[1:]}."]
        if row.when == Moment.AT:
            texts.append("In the picture: a click puts it, a drag draws its frame, moves it or an edge.")
        if len(things_about(self._draft, row)) > 1:
            texts.append("A click in the picture on one of them: only when it is that one.")
        return " ".join(texts)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        """A line of the list: what is odd, the number, whether it is important, the moment, the first words."""
        x, y, w, h = area
        palette = theme.palette
        row = self.edited.rows[index]
        chosen = index == self.edited.index
        if chosen:
            theme.row(surface, (x + 1, y, w - 2, h), chosen=True, focused=focused, radius=3)
        problem = self.checks.problem(row)
        if problem:
            theme.canvas.polygon(surface, palette.bad, [(x + 4, y + h - 5), (x + 12, y + h - 5), (x + 8, y + 4.5)])
        elif self.checks.remark(row):
            theme.canvas.circle(surface, palette.faint, (x + 8, y + h / 2), 3.5, 1.5)
        write = partial(theme.text, surface, y=y + (h - 9) / 2, size=9, bold=chosen, height=h)
        write(str(index + 1), x=x + 32, align="right", width=18)
        if row.important:
            write(IMPORTANT, x=x + 35)
        write(row.moment.capitalize(), x=x + 42, width=86, colour=palette.bad if problem else palette.text)
        words = " ".join(row.text.split()) or "(empty)"
        room = w - 142
        write(theme.fit(words, room, 9 * theme.scales[0], bold=chosen), x=x + 134, width=room)
