"""The messages of a level during play: which one is shown, and which ones wait for it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

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
_FADE_TICKS = 20  # ticks in which a message near a place fades at its end
_WAITS = {Moment.AT, Moment.AFTER}  # moments that wait for what is shown, and come again if they were not read

_Text = tuple[str, int, LevelMessage | None]
"""A text, its ticks on the screen, and its message; None for the game's advice."""

_NOTHING: _Text = "", 0, None

_MOMENT_OF_EVENT = {
    EXIT_OPENED: Moment.SWITCH,
    GOLD_TAKEN: Moment.GOLD,
    LOCK_OPENED: Moment.LOCK,
    TRAP_CLOSED: Moment.TRAP,
}


class MessageQueue:
    """Messages of a level in play, of what happens or of places: the shown one, and those that wait for it.

    - ``tiles`` hide a place from the ninja; None: only full ones and doors do.
    - ``advice``: what the game itself says between them; None: nothing.
    - ``text`` is the present one or "", ``place`` its place, px: it ends when the ninja is far from there.
    - ``spot`` is where the ninja was when it came, px, ``taken`` where the other queue's text was; others set them.

    A message of the start comes at each start until the exit is open, any other once. What just happened, or a place
    that the ninja just reached, replaces what is shown; a time, or a place where the ninja still is, waits until that
    was read, for its ``read_ticks``. A place or a time comes again if it was replaced, or the try ended, before it was
    read. What was read in an earlier try holds nothing back. An important message comes at once; until it was read only
    another such that just happened replaces it. The text of a place without a time of its own stays while the ninja is
    in its frame, unless another waits.
    """

    def __init__(
        self, messages: Sequence[LevelMessage], tiles: TileMap | None = None, advice: Advice | None = None
    ) -> None:
        self._messages, self._tiles, self._advice = messages, tiles or TileMap(), advice
        self._shown: set[LevelMessage] = set()
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
        self.spot: Point | None = None
        self.taken: tuple[float, float, float, float] | None = None
        self._here: set[LevelMessage] = set()
        if self._advice:
            self._advice.at_start()

    def _say(self, *texts: _Text) -> None:
        (self.text, self._left, self.message), *self._next = texts or (_NOTHING,)

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

    @property
    def opacity(self) -> float:
        """Opacity of the present text, 0…1."""
        return min(1.0, max(0.0, self._left / _FADE_TICKS)) if self.place else 1.0

    def say_again(self) -> None:
        """Forget which texts were shown: another run was watched, whose events the player has not passed yet."""
        self._shown.clear()
        self.at_start()

    def drop_start(self) -> None:
        """Stop the texts of the start: the player has understood the goal, or is far from the start."""
        starts = [message for message in self._messages if message.when == "start"]
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
        self._left -= 1
        self.add_read(1)
        if self.message and self.place and not self.message.seconds:
            if _is_near(world, self.message):
                self._left = self._left if self._next else max(self._left, _FADE_TICKS)
            elif not self.is_unread:
                self._left = min(self._left, _FADE_TICKS)
        if self._left <= 0:
            self._say(*self._next)
        events = world.events[: world.event_count]
        if any(event.kind == EXIT_OPENED for event in events):
            self.drop_start()
        held = bool(self.is_unread and self.message and self.message.important)
        here = {message for message in self._messages if self._is_at(world, message)}
        reached, self._here = here - self._here, here
        ahead = [message for message in self._messages if message not in self._shown]
        new = [message for message in ahead if any(_is_of(message, event, world) for event in events)]
        waits = bool(new) or self.is_unread

        def comes(message: LevelMessage) -> bool:
            if message in reached:
                return message.important or not held
            return not (held if message.important else waits) and (message in here or _is_due(world, message))

        new += list(filter(comes, ahead))
        self._shown.update(new)
        if held and not any(message.important for message in new):
            self._next += _in_turn(new)
        elif new:
            self._say_now(*_in_turn(new))
        advice = self._advice and self._advice.on_tick(world, self.text, beside, is_unread=self.is_unread)
        if advice and advice[0]:
            self._say_now((*advice, None))
        elif advice:
            self.text = ""
        return self.text != before

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
