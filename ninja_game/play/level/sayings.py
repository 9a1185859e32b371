"""What a level says while it is played, and why the ninja died when that happens for the first time."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot

from ninja_game.formats.messages import NEAR, LevelMessage, arrow_targets
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, LOCK_OPENED, TRAP_CLOSED
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import CELL
from ninja_game.sim.states import SLIDING
from ninja_game.ui.canvas import Point

SHOWN_TICKS = 240  # for which a text stays after its event
START_TICKS = 480  # likewise, in play those of the start and of the switch, which tell the way
READ_TICKS = 120  # after which it counts as read
FADE_TICKS = 20  # in which one near a place fades at its end

STILL = 0.05
"""px in a tick that are no motion."""

AGAIN = "Stuck? {retry} starts the level over"
# AGAIN is for players who are stuck; one who waits because a text says so is not.
STILL_TICKS = 400  # for which they stand or lie still
QUIET_TICKS = 800  # since any text
AWAY = 2 * CELL  # from the start, px

CLIMB = (
    "Hold %s, and press {jump} each time you touch the wall\n"
    "{jump} alone: you fly to the other side\nDo not press %s first: you would let go of the wall"
)
SLIPS, CLIMBED = 2, 4 * CELL
"""CLIMB is said after so many slips from a wall back to where the jump began, until the ninja is so many px higher."""

_Text = tuple[str, int, Point | None]
"""What is said, for how many ticks, and near which place, px."""

_NOTHING: _Text = "", 0, None

_WHEN = {EXIT_OPENED: "switch", GOLD_TAKEN: "gold", LOCK_OPENED: "lock", TRAP_CLOSED: "trap"}

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
"""What helps against each killer, said after its first kill."""

FALL_HELP = "Slide down a wall to slow a fall, or land on a downhill slope."


class Sayings:
    """The texts of one level. Each event's text is said once; those of the start at each start until the exit is open.

    Several of one moment are said one after the other; what happens meanwhile is said first, then what it interrupts
    goes on: the start's, and what nobody can have read. ``text``: what is to be read now, or "", ``place``: near which
    place, px, which ends it when the ninja is far from there. ``helps``: the game itself says what helps too: to try
    again, to climb. ``named``: the things with a name and an arrow (``arrow_targets``).
    """

    def __init__(self, sayings: Sequence[LevelMessage], *, helps: bool = False) -> None:
        self._sayings = sayings
        self.named = arrow_targets(saying.text for saying in sayings)
        self.helps = helps
        self._again = helps
        self._said: set[LevelMessage] = set()
        self._deaths = self._slips = 0
        self._climb, self._foot = "", 0.0
        self._began = 0.0, 0.0
        self.at_start()

    def at_start(self) -> None:
        """To be called when the level waits at its start."""
        due = [saying for saying in self._sayings if saying.when == "death" and saying.deaths == self._deaths]
        self._say(*_in_turn([*due, *self._starts()]))
        self._still = self._quiet = 0
        self._jumped_at = self._wall = 0.0

    def _say(self, *texts: _Text) -> None:
        (self.text, self._left, self.place), *self._next = texts or (_NOTHING,)
        self._unread = READ_TICKS

    def _say_first(self, *texts: _Text) -> None:
        """Show these texts first, then the interrupted and waiting ones; none of the start once the exit is open."""
        over = {saying.text for saying in self._said if saying.when == "start"}.union(text for text, *_ in texts)
        now = [(self.text, self._left, self.place)] if self.is_start or self._unread > 0 else []
        self._say(*texts, *(line for line in (*now, *self._next) if line[0] and line[0] not in over))

    def _starts(self) -> list[LevelMessage]:
        return [saying for saying in self._sayings if saying.when == "start" and saying not in self._said]

    @property
    def is_start(self) -> bool:
        """Whether the present text is one of the start, also when it is said no more."""
        return self.text in [saying.text for saying in self._sayings if saying.when == "start"]

    @property
    def seen(self) -> float:
        """How solid the present text is, 0…1."""
        return min(1.0, max(0.0, self._left / FADE_TICKS)) if self.place else 1.0

    def say_again(self) -> None:
        """All of it is said again, from the start on: another has shown how, which is not to have done it."""
        self._said.clear()
        self.at_start()

    def on_death(self) -> None:
        self._deaths += 1
        self.text = ""

    def on_tick(self, world: World) -> bool:
        """After a tick of play; whether there is something else to read."""
        before = self.text
        self._left -= 1
        self._unread -= 1
        if self.place and self._unread < 0 and not _is_near(world, self.place, 2 * NEAR):
            self._left = min(self._left, FADE_TICKS)
        if self._left <= 0:
            self._say(*self._next)
        happened = {_WHEN.get(event.kind) for event in world.events[: world.event_count]}
        if "switch" in happened:
            # The player has understood the goal: do not repeat the text of the start.
            self._said.update(saying for saying in self._sayings if saying.when == "start")
        new = [saying for saying in self._sayings if saying.when in happened or _is_near(world, saying.place)]
        if new := [saying for saying in new if saying not in self._said]:
            self._said.update(new)
            self._say_first(*_in_turn(new))
        if self._again and self._is_stuck(world):
            self._again = False
            self._say((AGAIN, SHOWN_TICKS, None))
        if self.helps and (wall := self._slipped(world)):
            towards, away = ("{right}", "{left}") if wall < 0 else ("{left}", "{right}")
            self._climb, self._foot = CLIMB % (towards, away), world.ninja.y
            self._say_first((self._climb, START_TICKS, None))
        elif self.text == self._climb and self._foot - world.ninja.y > CLIMBED:
            self.text = ""
        return self.text != before

    def _slipped(self, world: World) -> float:
        """At a landing after which it is said how to climb, the x of the wall's normal; else 0."""
        ninja, wall = world.ninja, self._wall
        if ninja.in_air:
            self._wall = ninja.wall_x if ninja.state == SLIDING else wall
            return 0.0
        height, self._jumped_at, self._wall = abs(ninja.y - self._jumped_at), ninja.y, 0.0
        if wall:
            self._slips = self._slips % SLIPS + 1 if height < CELL else 0
        return wall if self._slips == SLIPS else 0.0

    def _is_stuck(self, world: World) -> bool:
        """Whether the ninja has been still for long, away from its start, with nothing to read."""
        ninja = world.ninja
        self._still = 0 if hypot(ninja.x - ninja.prev_x, ninja.y - ninja.prev_y) > STILL else self._still + 1
        if world.tick == 1:
            self._began = ninja.x, ninja.y
        away = hypot(ninja.x - self._began[0], ninja.y - self._began[1]) > AWAY
        self._quiet = 0 if self.text else self._quiet + 1
        return away and self._still >= STILL_TICKS and self._quiet >= QUIET_TICKS


def shown_ticks(when: str, together: int) -> int:
    """Of a text of a moment with so many together: one alone that tells the way stays longer."""
    return START_TICKS if together == 1 and when in {"start", "switch"} else SHOWN_TICKS


def _in_turn(sayings: Sequence[LevelMessage]) -> list[_Text]:
    return [(saying.text, shown_ticks(saying.when, len(sayings)), saying.place) for saying in sayings]


def _is_near(world: World, place: Point | None, near: float = NEAR) -> bool:
    return place is not None and max(abs(world.ninja.x - place[0]), abs(world.ninja.y - place[1])) <= near
