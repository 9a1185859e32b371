"""The page of a level's messages, as a maker uses it in tests."""

import re
from typing import Any, NamedTuple

import pygame

from ninja_game.editor.message_rows import MessageField, MessageRow
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.play.editor.message_picture import PICTURE
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.level.level_play import LevelPlay
from ninja_game.runtime import NewestJob
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.rules import CELL, HALF
from ninja_game.ui.canvas import WIDTH
from tests.support.draw_log import DrawLog, drawn
from tests.support.level_maker import Maker

LONG = "to the right and take the gold before you leave and then look for"
"""Its lines are broken elsewhere if they are measured in small letters."""

ALL = (
    "start: {jump} jumps | switch for 9 s: Now the exit | death 3: Wait | at 12,5: Jump: here | after 20 s: Slide"
    " | death 5 for 12 s: Go round | at 3,5 for 1 s: No | gold: Yes"
)


def opened(maker: Maker, says: str | None = None) -> MessagesScreen:
    """The page of messages, in a level that says something first."""
    if says is not None:
        maker.put_says(says)
    maker.chord("m", pygame.KMOD_LSHIFT)
    maker.frames(2)
    return maker.shown(MessagesScreen)


def said(play: LevelPlay) -> list[str]:
    """What the level says now, and what a place says beside it."""
    return [queue.text for queue in play.queues]


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


def select(maker: Maker, row: int, field: MessageField = MessageField.TEXT) -> None:
    """Click on a message in the list, then into a field of it."""
    screen = maker.shown(MessagesScreen)
    x, y, _, h = screen.list.row_area(row)
    maker.mouse(x + 60, y + h / 2)
    maker.mouse(*screen.form.fields[field].centre)
    maker.frames()


def words(maker: Maker) -> str:
    """All texts that are drawn now, one after the other."""
    return " ".join(re.findall(r"""^text ['"](.*)['"] at""", drawn(maker.app), re.MULTILINE))


class AtOnce(NewestJob[Any, Any]):
    """Answers before the page goes on."""

    def ask(self, job: object) -> None:
        self.result = self._work(job)


def at_point(x: float, y: float) -> tuple[float, float]:
    """Where the picture shows a point of the level."""
    left, top, width, _ = PICTURE
    return left + x * width / WIDTH, top + y * width / WIDTH


def in_picture(column: float, row: float) -> tuple[float, float]:
    """Where the picture shows the middle of a cell, or with a half an edge."""
    return at_point(CELL * column + HALF, CELL * row + HALF)


def drag_in_picture(maker: Maker, begin: tuple[float, float], *ends: tuple[float, float]) -> None:
    """Drag from the middle of a cell over others."""
    kinds = [pygame.MOUSEBUTTONDOWN, *[pygame.MOUSEMOTION] * len(ends), pygame.MOUSEBUTTONUP]
    for kind, cell in zip(kinds, (begin, *ends, ends[-1]), strict=True):
        more = {"rel": (0, 0), "buttons": (1, 0, 0)} if kind == pygame.MOUSEMOTION else {"button": 1}
        pygame.event.post(pygame.Event(kind, pos=maker.app.canvas.point(*in_picture(*cell)), touch=False, **more))
    maker.frames()


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


WELCOME = "Welcome to this place: go to the right, and look at what I have built there"


class ShownRow(NamedTuple):
    """A line of the list as it is drawn. ``mark``: "wrong", "late", or ""; ``colour``: the role of its moment's."""

    mark: str
    important: bool
    moment: str
    words: str
    colour: str


def rows_shown(screen: MessagesScreen) -> list[ShownRow]:
    """The lines of the list, each drawn alone."""
    app = screen.app
    rows = []
    for number in range(len(screen.edited.rows)):
        log = DrawLog()
        with log.installed(), log.recording(app.theme.palette) as lines:
            screen.list.draw_row(app.surface, app.theme, number, screen.list.row_area(number), False)
        texts = [match for line in lines if (match := re.match(r"text '(.*)' at .* (\w+)$", line))]
        mark = "wrong" if any(line.startswith("polygon bad") for line in lines) else ""
        mark = "late" if any(line.startswith("circle") for line in lines) else mark
        *before, moment, said = texts
        rows.append(ShownRow(mark, "!" in [text[1] for text in before], moment[1], said[1], moment[2]))
    return rows
