"""What the game itself says to a player: against each killer, how to climb, and to start over."""

from __future__ import annotations

from math import hypot

from ninja_game.sim.rules import CELL
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import SLIDING

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

AGAIN, AGAIN_TICKS = "Stuck? {retry} starts the level over", 240
# AGAIN is for players who are stuck, not for those who wait because a text says so.
STILL_TICKS = 400  # ticks for which the ninja is still
QUIET_TICKS = 800  # ticks since the last text
_STILL = 0.05  # slower than this the ninja is still, px/tick
_AWAY = 2 * CELL  # px from the start

CLIMB = (
    "Hold %s, and press {jump} each time you touch the wall\n"
    "{jump} alone: you fly to the other side\nDo not press %s first: you would let go of the wall"
)
CLIMB_TICKS = 480
SLIPS, CLIMBED = 2, 4 * CELL
"""CLIMB is shown after that many slips from a wall back to the jump, until the ninja is that many px higher."""


class Advice:
    """Advice during the tries of a level: CLIMB whenever the ninja slips from walls, AGAIN once."""

    def __init__(self) -> None:
        self._says_again = True
        self._slips = 0
        self._climb, self._foot = "", 0.0
        self._began = 0.0, 0.0
        self.at_start()

    def at_start(self) -> None:
        self._still = self._quiet = 0
        self._jumped_at = self._wall = 0.0

    def on_tick(self, world: World, shown: str, beside: str, *, is_unread: bool) -> tuple[str, int] | None:
        """A text to show after a tick, and for how many; "" to take the shown one away; None to leave it.

        ``shown``: the present text, which perhaps is to be read first; ``beside``: another on the screen.
        """
        is_stuck, wall = self._is_stuck(world, silent=not (shown or beside)), self._slipped(world)
        if is_stuck and self._says_again:
            self._says_again = False
            return AGAIN, AGAIN_TICKS
        if wall and not is_unread:
            towards, away = ("{right}", "{left}") if wall < 0 else ("{left}", "{right}")
            self._climb, self._foot = CLIMB % (towards, away), world.ninja.y
            return self._climb, CLIMB_TICKS
        return ("", 0) if shown == self._climb and self._foot - world.ninja.y > CLIMBED else None

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

    def _is_stuck(self, world: World, *, silent: bool) -> bool:
        """Whether the ninja has been still for long, away from its start, without a text."""
        ninja = world.ninja
        self._still = 0 if hypot(ninja.x - ninja.prev_x, ninja.y - ninja.prev_y) > _STILL else self._still + 1
        if world.tick == 1:
            self._began = ninja.x, ninja.y
        away = hypot(ninja.x - self._began[0], ninja.y - self._began[1]) > _AWAY
        self._quiet = self._quiet + 1 if silent else 0
        return away and self._still >= STILL_TICKS and self._quiet >= QUIET_TICKS
