"""A level's messages during play, and advice after the first death by each killer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import lru_cache
from math import hypot
from typing import NamedTuple

from ninja_game.formats.messages import LevelMessage, Moment, parse_messages
from ninja_game.levels.findings import Finding, level_finding
from ninja_game.sim.collision.rays import sees, solid_at
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, LOCK_OPENED, TRAP_CLOSED
from ninja_game.sim.grid import Point, cell_of
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import Level
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND
from ninja_game.sim.schema.world_fields import Event, TileMap, World
from ninja_game.sim.states import SLIDING
from ninja_game.simulation import Simulation

USUAL_TICKS = 240  # ticks for which a message is shown after its event
START_TICKS = 480  # the same in play for a single message of the start or the switch
_FADE_TICKS = 20  # ticks in which a message near a place fades at its end
_GLANCE = TICKS_PER_SECOND  # ticks in which nobody reads a message
_WAITS = {Moment.AT, Moment.AFTER}  # moments that wait for what is shown, and come again if they were not read

_STILL = 0.05  # slower than this the ninja is still, px/tick

AGAIN = "Stuck? {retry} starts the level over"
# AGAIN is for players who are stuck, not for those who wait because a text says so.
STILL_TICKS = 400  # ticks for which the ninja is still
QUIET_TICKS = 800  # ticks since the last text
_AWAY = 2 * CELL  # px from the start

CLIMB = (
    "Hold %s, and press {jump} each time you touch the wall\n"
    "{jump} alone: you fly to the other side\nDo not press %s first: you would let go of the wall"
)
SLIPS, CLIMBED = 2, 4 * CELL
"""CLIMB is shown after that many slips from a wall back to the jump, until the ninja is that many px higher."""

_Text = tuple[str, int, LevelMessage | None]
"""A text, its ticks on the screen, and its message; None for the game's advice."""

_NOTHING: _Text = "", 0, None

_MOMENT_OF_EVENT = {
    EXIT_OPENED: Moment.SWITCH,
    GOLD_TAKEN: Moment.GOLD,
    LOCK_OPENED: Moment.LOCK,
    TRAP_CLOSED: Moment.TRAP,
}

WHY = {
    "zap drone": "Its touch kills. Watch where it goes, and wait until it has passed.",
    "laser drone": "It stops, aims, then burns a straight line: get out of it in time.",
    "chaingun drone": "It shoots when it sees you: stay behind walls, or keep moving.",
    "gauss turret": "Its cross hunts you, then it fires: keep running, or get out of sight.",
    "floor guard": "It charges along its floor: jump over it.",
    "thwump": "It drops when you pass below, then climbs back slowly. Only its bright side kills.",
    "homing rocket": "It turns slowly: trick it into a wall.",
    "mine": "Mines never move: give them some room.",
}
"""Advice against each killer, shown after its first kill."""

FALL_HELP = "Slide down a wall to slow a fall, or land on a downhill slope."


class MessageQueue:
    """Messages of a level in play, of what happens or of places: the shown one, and those that wait for it.

    - ``tiles`` hide a place from the ninja; None: only full ones and doors do.
    - ``helps``: the game gives advice too: to try again, to climb; ``teaches``: the level does so itself.
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
        self,
        messages: Sequence[LevelMessage],
        tiles: TileMap | None = None,
        *,
        helps: bool = False,
        teaches: bool = False,
    ) -> None:
        self._messages, self._tiles = messages, tiles or TileMap()
        self.helps = helps
        self._again = self._advises = helps and not teaches
        self._shown: set[LevelMessage] = set()
        self._read = Counter[str]()  # ticks for which the texts were shown
        self.deaths = self._slips = 0
        self._climb, self._foot = "", 0.0
        self._began = 0.0, 0.0
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
        self._still = self._quiet = 0
        self._jumped_at = self._wall = 0.0

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
        if self._again and self._is_stuck(world, beside):
            self._again = False
            self._say((AGAIN, USUAL_TICKS, None))
        if self._advises and (wall := self._slipped(world)) and not self.is_unread:
            towards, away = ("{right}", "{left}") if wall < 0 else ("{left}", "{right}")
            self._climb, self._foot = CLIMB % (towards, away), world.ninja.y
            self._say_now((self._climb, START_TICKS, None))
        elif self.text == self._climb and self._foot - world.ninja.y > CLIMBED:
            self.text = ""
        return self.text != before

    def _is_at(self, world: World, message: LevelMessage) -> bool:
        """Whether the ninja is in the frame of a message, with no wall between; a place in a wall is always seen."""
        if not (_is_near(world, message) and (place := message.place)):
            return False
        ninja = world.ninja.x, world.ninja.y
        return place == ninja or solid_at(self._tiles, *place) or sees(self._tiles, world, *place, *ninja)[0]

    def _slipped(self, world: World) -> float:
        """At a landing that calls for advice on climbing, the x of the wall's normal; else 0."""
        ninja, wall = world.ninja, self._wall
        if ninja.in_air:
            self._wall = ninja.wall_x if ninja.state == SLIDING else wall
            return 0.0
        if wall:
            self._slips = self._slips % SLIPS + 1 if abs(ninja.y - self._jumped_at) < CELL else 0
        self._jumped_at = ninja.y
        self._wall = 0.0
        return wall if self._slips == SLIPS else 0.0

    def _is_stuck(self, world: World, beside: str) -> bool:
        """Whether the ninja has been still for long, away from its start, without a text."""
        ninja = world.ninja
        self._still = 0 if hypot(ninja.x - ninja.prev_x, ninja.y - ninja.prev_y) > _STILL else self._still + 1
        if world.tick == 1:
            self._began = ninja.x, ninja.y
        away = hypot(ninja.x - self._began[0], ninja.y - self._began[1]) > _AWAY
        self._quiet = 0 if self.text or beside else self._quiet + 1
        return away and self._still >= STILL_TICKS and self._quiet >= QUIET_TICKS


def in_two(messages: Sequence[LevelMessage]) -> tuple[list[LevelMessage], list[LevelMessage]]:
    """Messages of what happens, and those of places: one of each can be on the screen."""
    return [m for m in messages if not m.place], [m for m in messages if m.place]


def read_ticks(text: str) -> int:
    """Ticks that a text needs to be read: 2 s, and 1 s for every 20 letters begun."""
    return TICKS_PER_SECOND * (2 - -len(text) // 20)


class Appearance(NamedTuple):
    """The tick in which a message comes in a run, and the ninja's place then, px."""

    due: int  #: the tick in which it comes as the only one, from 0
    tick: int | None  #: the tick in which it comes beside the other messages; None: they displace it
    spot: Point
    cut: int = 0  #: the ticks after which another replaces it before it was read; 0: none does


def appearances(messages: Sequence[LevelMessage], level: Level, inputs: bytes) -> list[Appearance | None]:
    """The moment of each message in a run; None if it never comes."""
    # Only the lengths of the texts matter, in steps of 20 letters: what is typed seldom runs the level again.
    texts = [str(number).ljust(-(-len(message.text) // 20) * 20) for number, message in enumerate(messages)]
    numbered = tuple(message._replace(text=text) for message, text in zip(messages, texts, strict=True))
    together, alone = _first_shown(numbered, level, inputs)
    comings: list[Appearance | None] = []
    for message, text in zip(messages, texts, strict=True):
        wanted, coming = alone.get(text), together.get(text)
        if wanted is None or coming is None:
            comings.append(wanted and Appearance(wanted.tick, None, wanted.spot))
        else:
            # A level waits at its start: its messages there can be read before the run.
            need = _GLANCE if message.when == Moment.START else read_ticks(text)
            is_cut = coming.ticks < min(wanted.ticks, need)
            comings.append(Appearance(wanted.tick, coming.tick, coming.spot, coming.ticks if is_cut else 0))
    return comings


def late_text(moment: Appearance, ticks: int) -> str:
    """The reason why a message cannot be read in time in a level's known run of ``ticks``; '' without one."""
    run = f"in the known run ({ticks / TICKS_PER_SECOND:.1f} s)"
    if moment.tick is None:
        return f"not shown {run}: others are read then"
    late = (moment.tick - moment.due) // TICKS_PER_SECOND
    if late:
        return f"{late} s late {run}: others are read first"
    return f"replaced after {moment.cut / TICKS_PER_SECOND:.1f} s {run}, too soon" if moment.cut else ""


def short_text(message: LevelMessage) -> str:
    """That a message's own time is far too short for its letters; '' if it is not."""
    letters, need = len(message.text), read_ticks(message.text) // TICKS_PER_SECOND
    return f"too short to read: {letters} letters need {need} s" if 0 < 3 * message.seconds < need else ""


def late_messages(level: Level, says: str, inputs: bytes) -> Iterator[Finding]:
    """Findings about messages that others displace in the known run, except those after another of their moment."""
    messages, past = parse_messages(says), set[tuple[object, ...]]()
    comings = appearances(messages, level, inputs) if inputs else []
    for number, (message, coming) in enumerate(zip(messages, comings, strict=False)):
        moment = message.when, message.number, message.cell
        if coming and coming.tick is None and moment not in past:
            cell, why = cell_of(*(message.place or coming.spot)), late_text(coming, len(inputs))
            yield level_finding("late-message", cells=(cell,), text=message.one_line, why=why)._replace(message=number)
        past.add(moment)


class _Coming(NamedTuple):
    """The tick in which a text first comes, the ninja's place then, px, and the ticks for which it is shown."""

    tick: int
    spot: Point
    ticks: int = 0


_Comings = dict[str, _Coming]


@lru_cache(maxsize=256)
def _first_shown(messages: tuple[LevelMessage, ...], level: Level, inputs: bytes) -> tuple[_Comings, _Comings]:
    """The moments of texts in a run: of all together, and of each as if it were the only one."""
    run = Simulation(level)
    together, alone = _Comings(), _Comings()
    queues = [(MessageQueue([message], run.tiles), alone) for message in messages]
    queues += [(MessageQueue(some, run.tiles), together) for some in in_two(messages)]
    for tick, keys in enumerate(inputs):
        run.step_keys(keys)
        for queue, comings in queues:
            queue.on_tick(run.world)
            coming = comings.get(queue.text) or _Coming(tick, (run.world.ninja.x, run.world.ninja.y))
            comings[queue.text] = coming._replace(ticks=coming.ticks + 1)
    return together, alone


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
