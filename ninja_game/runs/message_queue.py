"""The messages of a level during play: which one is shown, and which ones wait for it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from enum import IntEnum

from ninja_game.formats.messages import LevelMessage, Moment
from ninja_game.runs.advice import Advice
from ninja_game.sim.collision.rays import sees, solid_at
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, LOCK_OPENED, TRAP_CLOSED
from ninja_game.sim.grid import Point
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.sim.schema.world_fields import Event, TileMap, World

USUAL_TICKS = 240  # ticks for which a message is shown after its event
START_TICKS = 480  # the same in play for a single message of the start or the switch
FADE_TICKS = 20  # ticks in which a message near a place fades at its end
_WAITS = {Moment.AT, Moment.AFTER}  # moments that wait for what is shown, and come again if they were not read

_Text = tuple[str, int, LevelMessage | None]
"""A text, its ticks on the screen, and its message; None for the game's advice."""

_NOTHING: _Text = "", 0, None

_MOMENT_OF_EVENT = {
    EXIT_OPENED: Moment.SWITCH, GOLD_TAKEN: Moment.GOLD, LOCK_OPENED: Moment.LOCK, TRAP_CLOSED: Moment.TRAP,
}  # fmt: skip


class _Column(IntEnum):
    """The shown text, as the columns of the table of MessageQueue."""

    READ, UNREAD, IMPORTANT = range(3)


class MessageQueue:
    """Messages of a level in play, of what happens or of places: the shown one, and those that wait for it.

    - ``tiles`` hide a place from the ninja; None: only full ones and doors do.
    - ``advice``: what the game itself says between them; None: nothing.
    - ``text`` is the present one or "", ``place`` its place, px.

    A message of the start comes at each start until the exit is open, any other once, and meets the shown text:

        what comes                          none, or it was read   unread          unread, important
        it just happened                    replaces               replaces        queues
        a place, just reached               replaces               replaces        waits
        a place not left yet, or a time     replaces [1]           waits           waits
        important: happened or reached      replaces               replaces        replaces
        important: not left yet, or a time  replaces               replaces        waits

    - "replaces": it is shown at once. A place or a time that it replaces unread comes again, another text does not.
    - "queues": it comes after the shown text, or after an important one of its own tick.
    - "waits": it is asked again in the next tick; a place only if the ninja is there still.
    - [1]: not in a tick in which something happened.

    A text is read after its ``read_ticks``, in one try or several. A place or a time comes again in the next try if it
    was not read in this one. The text of a place without a time of its own stays while the ninja is in its frame,
    unless another one is queued.
    """

    def __init__(
        self, messages: Sequence[LevelMessage], tiles: TileMap | None = None, advice: Advice | None = None
    ) -> None:
        self._messages, self._advice = messages, advice
        self._tiles = tiles or TileMap()
        self._shown: set[LevelMessage] = set()
        self.event_places: dict[LevelMessage, Point] = {}  #: where what messages are about has happened, px
        self._read = Counter[str]()  # ticks for which the texts were shown
        self.deaths = 0
        self._say()
        self.at_start()

    def at_start(self) -> None:
        """Called when the level waits at its start; messages that still waited count as not shown."""
        self._shown -= self._unread.union(message for _, _, message in self._next if message)
        due = [message for message in self._messages if message.when == Moment.DEATH and message.number == self.deaths]
        starts = [message for message in self._messages if message.when == Moment.START and message not in self._shown]
        self._say(*_in_turn([*due, *starts]))
        self._here: set[LevelMessage] = set()
        if self._advice:
            self._advice.at_start()

    def _say(self, *texts: _Text) -> None:
        (self.text, self.ticks_left, self.message), *self._next = texts or (_NOTHING,)

    @property
    def _unread(self) -> set[LevelMessage]:
        """Places and times, shown or waiting, that were not read."""
        messages = [message for _, _, message in self._next] + [self.message] * self.is_unread
        return {message for message in messages if message and message.when in _WAITS}

    def _say_now(self, *texts: _Text) -> None:
        """Show these texts at once, then what waits. A place or a time that was not read is waited for again."""
        again = self._unread
        self._shown -= again
        self._say(*texts, *(line for line in self._next if line[2] not in again))

    @property
    def place(self) -> Point | None:
        return self.message and self.message.place

    @property
    def is_start(self) -> bool:
        """Whether the present text belongs to the start, also when it is not shown any more."""
        return bool(self.message and self.message.when == Moment.START)

    @property
    def is_unread(self) -> bool:
        """Whether a text of a place or a time has to wait for the present one."""
        return self._read[self.text] < read_ticks(self.text) if self.text else False

    def say_again(self) -> None:
        """Forget which texts were shown: another run was watched, whose events the player has not passed yet."""
        self._shown.clear()
        self.at_start()

    def drop_start(self) -> None:
        """Stop the texts of the start: the player has understood the goal, or is far from the start."""
        starts = [message for message in self._messages if message.when == Moment.START]
        self._shown.update(starts)
        self._next = [line for line in self._next if line[2] not in starts]

    def on_death(self) -> None:
        self.deaths += 1

    def add_read(self, ticks: int) -> None:
        """Count ticks for which the present text was shown, in play or while the level waits at its start."""
        self._read[self.text] += ticks

    def on_tick(self, world: World, beside: str = "") -> bool:
        """Called after a tick of play; whether the text has changed. ``beside``: what another queue shows."""
        before = self.text
        self._pass_tick(world)
        events = world.events[: world.event_count]
        if any(event.kind == EXIT_OPENED for event in events):
            self.drop_start()
        self._receive(world, events)
        advice = self._advice and self._advice.on_tick(world, self.text, beside, is_unread=self.is_unread)
        if advice and advice[0]:
            self._say_now((*advice, None))
        elif advice:
            self.text = ""
        return self.text != before

    def _pass_tick(self, world: World) -> None:
        """Count a tick of the present text; at its end the next one follows."""
        self.ticks_left -= 1
        self.add_read(1)
        if self.message and self.place and not self.message.seconds:
            if _is_near(world, self.message):
                self.ticks_left = self.ticks_left if self._next else max(self.ticks_left, FADE_TICKS)
            elif not self.is_unread:
                self.ticks_left = min(self.ticks_left, FADE_TICKS)
        if self.ticks_left <= 0:
            self._say(*self._next)

    def _receive(self, world: World, events: Sequence[Event]) -> None:
        """Take what comes in a tick by the table of the class."""
        here = {message for message in self._messages if self._is_at(world, message)}
        reached, self._here = here - self._here, here
        ahead = [message for message in self._messages if message not in self._shown]
        happened = {m: (event.x, event.y) for m in ahead for event in events if _is_of(m, event, world)}
        self.event_places.update(happened)
        shown = self._column(anything_happened=bool(happened))

        def replaces(message: LevelMessage) -> bool:
            if message in reached:
                return message.important or shown < _Column.IMPORTANT
            if message in here or _is_due(world, message):  # a place not left yet, or a time
                return shown == _Column.READ or (message.important and shown == _Column.UNREAD)
            return False

        new = [*happened, *filter(replaces, ahead)]
        self._shown.update(new)
        if shown == _Column.IMPORTANT and not any(message.important for message in new):
            self._next += _in_turn(new)  # all of it just happened
        elif new:
            self._say_now(*_in_turn(new))

    def _column(self, *, anything_happened: bool) -> _Column:
        if self.is_unread and self.message and self.message.important:
            return _Column.IMPORTANT
        return _Column.UNREAD if self.is_unread or anything_happened else _Column.READ

    def _is_at(self, world: World, message: LevelMessage) -> bool:
        """Whether the ninja is in the frame of a message, with no wall between; a place in a wall is always seen."""
        if not (_is_near(world, message) and (place := message.place)):
            return False
        ninja = world.ninja.x, world.ninja.y
        return place == ninja or solid_at(self._tiles, *place) or sees(self._tiles, world, *place, *ninja)[0]


def in_two(messages: Sequence[LevelMessage]) -> tuple[list[LevelMessage], list[LevelMessage]]:
    """Messages of what happens, and those of places: one of each can be on the screen."""
    return [m for m in messages if not m.place], [m for m in messages if m.place]


def read_ticks(text: str) -> int:
    """Ticks that a text needs to be read: 2 s, and 1 s for every 20 letters begun."""
    return TICKS_PER_SECOND * (2 - -len(text) // 20)


def shown_ticks(when: Moment, together: int, text: str) -> int:
    """Ticks for a text without a time of its own, of a moment with ``together`` texts.

    A single one of the start or the switch stays longer, and so does a text that needs it.
    """
    usual = START_TICKS if together == 1 and when in {Moment.START, Moment.SWITCH} else USUAL_TICKS
    return max(usual, read_ticks(text))


def _in_turn(messages: Sequence[LevelMessage]) -> list[_Text]:
    """Texts of one tick, the important ones first."""
    return [
        (m.text, round(m.seconds * TICKS_PER_SECOND) or shown_ticks(m.when, len(messages), m.text), m)
        for m in sorted(messages, key=lambda m: not m.important)
    ]


def _is_of(message: LevelMessage, event: Event, world: World) -> bool:
    if event.kind == GOLD_TAKEN and message.when == Moment.ALL_GOLD:
        return all(o.kind != GOLD or o.taken for o in world.objects[1:])
    is_moment = _MOMENT_OF_EVENT.get(event.kind) == message.when and message.is_about(event.x, event.y)
    return is_moment and not (message.when == Moment.GOLD and world.gold < message.number)


def _is_due(world: World, message: LevelMessage) -> bool:
    return message.when == Moment.AFTER and world.tick >= message.number * TICKS_PER_SECOND


def _is_near(world: World, message: LevelMessage) -> bool:
    """Whether the ninja is in the frame of a message's place."""
    if message.place is None:
        return False
    across, down = abs(world.ninja.x - message.middle[0]), abs(world.ninja.y - message.middle[1])
    return across <= message.reach[0] and down <= message.reach[1]
