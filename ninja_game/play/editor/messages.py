"""What a level tells its player: a row for each message, with the moment at which it is said."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import pygame

from ninja_game.editor.draft import Cell
from ninja_game.errors import LevelError
from ninja_game.formats.sayings import BAR, KEYS, MOST_LETTERS, MOST_SAYINGS, THINGS, read_sayings
from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.widgets import Button, Choice, Widget

ROW, TOP = 78, 66

_WHEN = [
    ("At the start", "start"), ("The exit opens", "switch"), ("The first gold", "gold"), ("After deaths", "death"),
    ("Near a place", "at"),
]  # fmt: skip

_HELP = (
    "At the start: at each start, until the exit is open. The exit opens: as soon as its switch is touched.",
    "The first gold: when it is taken. After deaths: at the start after that many deaths.",
    "Near a place: the first time that the ninja comes near that cell; a bubble marks it in the editor.",
    f"In a text {', '.join(f'{{{key}}}' for key in KEYS)} become the key or button of whoever plays;",
    f"{' and '.join(f'{{{thing}}}' for thing in THINGS)} name what an arrow points at. At most {MOST_LETTERS} letters.",
)


@dataclass
class Message:
    """``when``: as of a Saying; ``detail``: of how many deaths, or at which cell, as it is typed."""

    when: str = "start"
    detail: str = ""
    text: str = ""

    @property
    def source(self) -> str:
        """As the header has it."""
        return f"{self.when} {self.detail.replace(' ', '')}".strip() + f": {self.text.strip()}"

    @property
    def problem(self) -> tuple[bool, str]:
        """Whether it is its detail that is wrong, and in words what; '' for none."""
        moment = f"{self.when} {self.detail.replace(' ', '')}"
        if self.when in ("death", "at") and (":" in moment or not _fits(f"{moment}: a text")):
            place = "column,row: 1,1 to 31,23, as in 12,5"
            return True, f"A place is {place}" if self.when == "at" else "How many deaths: a number from 1 to 99"
        if not self.text.strip():
            return False, "Type what is said, or remove the message"
        if BAR in self.text:
            return False, f"A message has no {BAR}"
        known = ", ".join(f"{{{name}}}" for name in KEYS + THINGS)
        return False, "" if _fits(f"start: {self.text}") else f"What stands in braces is one of {known}"


def _fits(source: str) -> bool:
    try:
        return bool(read_sayings(source))
    except LevelError:
        return False


def messages_of(says: str) -> list[Message]:
    """The messages of a header's value, which is sound."""
    details = {"death": "{0.deaths}", "at": "{0.cell[0]},{0.cell[1]}"}
    return [Message(each.when, details.get(each.when, "").format(each), each.text) for each in read_sayings(says)]


class MessagesScreen(MenuScreen):
    """``here``: the cell that a message near a place begins with. ``pick`` has the player point at a cell.

    ``put``: takes the header's value.
    """

    title = "Messages to the player"

    def __init__(
        self, app: App, says: str, here: Cell, pick: Callable[[Callable[[Cell | None], None]], object],
        put: Callable[[str], object],
    ) -> None:  # fmt: skip
        super().__init__(app)
        self.messages = messages_of(says)
        self._here, self._pick, self._put = here, pick, put
        self._details: list[Widget] = []
        self._texts: list[Widget] = []

    def build(self) -> Sequence[Widget]:
        self._details, self._texts = [], []
        rows = [widget for number in range(len(self.messages)) for widget in self._row(number)]
        y = TOP + ROW * len(self.messages)
        add = Button((36, y, 160, 28), "Add a message", self._add if len(self.messages) < MOST_SAYINGS else None)
        add.hint = f"A level has at most {MOST_SAYINGS}"
        end = [Button((480, y, 132, 28), "OK", self._accept), Button((624, y, 132, 28), "Cancel", self.close)]
        return [*rows, add, *end]

    def _row(self, number: int) -> list[Widget]:
        """The widgets of a message."""
        message, y = self.messages[number], TOP + ROW * number
        text = TextEntry(
            (36, y + 34, 720, 30), "What is said", message.text, partial(setattr, message, "text"),
            longest=MOST_LETTERS, hint="{jump} becomes the key or button of whoever plays",
        )  # fmt: skip
        moment = Choice((36, y, 220, 28), "", _WHEN, lambda: message.when, partial(self._choose, message))
        moment.hint = "When it is said: at the start, the exit opens, the first gold, after deaths, near a place"
        about: list[Widget] = []
        if message.when in ("death", "at"):
            hint = "Column and row of the cell" if message.when == "at" else "How many deaths"
            detail = partial(setattr, message, "detail")
            about.append(TextEntry((264, y, 80, 28), hint, message.detail, detail, longest=6, hint=hint))
        if message.when == "at":
            show = Button((352, y, 150, 28), "Show it in the level", partial(self._point, message), size=10)
            show.hint = "The next click in the level says where"
            about.append(show)
        self._details.append(about[0] if about else text)
        self._texts.append(text)
        remove = Button((656, y, 100, 28), "Remove", lambda: self._remove(message), size=10)
        return [moment, *about, remove, text]

    def _choose(self, message: Message, when: str) -> None:
        message.when = when
        message.detail = {"death": "3", "at": "{},{}".format(*self._here)}.get(when, "")
        self.enter()

    def _point(self, message: Message) -> None:
        def take(cell: Cell | None) -> None:
            if cell is not None:
                message.detail = "{},{}".format(*cell)
            self.app.push(self)

        self.close()
        self._pick(take)

    def _add(self) -> None:
        self.messages.append(Message())
        self.enter()
        self.focus = self._texts[-1]

    def _remove(self, message: Message) -> None:
        self.messages = [each for each in self.messages if each is not message]
        self.enter()

    def _accept(self) -> None:
        """Give back what is sound; else the focus goes to what is not."""
        for number, message in enumerate(self.messages):
            about_detail, problem = message.problem
            if problem:
                self.focus = (self._details if about_detail else self._texts)[number]
                self.app.notify(problem)
                self.redraw = True
                return
        self.close()
        self._put(f" {BAR} ".join(message.source for message in self.messages))

    def act(self, action: str, *, held: bool = False) -> None:
        """Enter in a field means OK."""
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self._accept()
        else:
            super().act(action, held=held)

    def draw_frame(self, surface: pygame.Surface) -> None:
        """What moments there are, and what a text may name."""
        super().draw_frame(surface)
        y = TOP + ROW * len(self.messages) + 44
        self.theme.paragraph(surface, _HELP, (36, y, 720, 560 - y), 11, 15, colour=self.theme.palette.faint)
