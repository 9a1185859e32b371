"""Nine victory dances: key poses with their times in ticks. After the last key a dance holds, or goes back."""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.play.picture.pose import STAND, Pose, pose

CHEER = pose((-0.2, -4.2), (0, 1.6), (5.4, -10.6), (-5.4, -10.6), (4.4, 9.7), (-4.4, 9.7))
CROUCH = pose((0.6, 0.4), (-1.6, 5.4), (4.4, 6.4), (-4.6, 6.4), (4.2, 9.7), (-4.0, 9.7))
LEAP = pose((0, -6.4), (0, -0.8), (6.2, -12.4), (-6.2, -12.4), (5.4, 5.0), (-5.4, 5.0))
BOW = pose((4.4, 0.0), (-1.6, 1.6), (1.0, 3.4), (-6.0, 1.6), (2.2, 9.7), (-2.4, 9.7), (7.6, 2.2))
POINT_UP = pose((-0.6, -3.8), (0.8, 1.8), (5.4, -10.4), (-4.2, 1.0), (5.0, 9.7), (-3.6, 9.7))
POINT_DOWN = pose((0.8, -3.6), (-0.8, 1.8), (-5.6, 2.6), (-4.8, -0.4), (5.0, 9.7), (-3.6, 9.7))
FLEX = pose((0, -3.8), (0, 1.8), (5.2, -5.8), (-5.2, -5.8), (4.6, 9.7), (-4.6, 9.7))
FLEX_LOW = pose((0, -3.4), (0, 2.0), (3.2, 1.8), (-3.2, 1.8), (4.6, 9.7), (-4.6, 9.7))
WAVE_OUT = pose((-0.6, -3.8), (-0.2, 1.8), (7.2, -8.4), (-4.6, 2.0), (4.2, 9.7), (-3.6, 9.7))
WAVE_IN = pose((-0.8, -3.8), (-0.2, 1.8), (3.6, -10.4), (-4.6, 2.0), (4.2, 9.7), (-3.6, 9.7))
KICK = pose((-3.0, -3.2), (-0.8, 2.0), (3.6, -4.8), (-7.8, -4.6), (9.6, 1.0), (-1.0, 9.7))
KICK_BACK = pose((2.4, -3.2), (0.4, 2.0), (6.8, -4.8), (-4.4, -5.2), (1.0, 9.7), (-8.6, 3.4))
SIT = pose((-0.6, 0.6), (-1.0, 6.2), (4.4, 5.4), (-5.0, 5.4), (4.8, 9.6), (-4.6, 9.6))
HANDSTAND = pose((0, 3.2), (0, -2.4), (2.4, 9.8), (-2.4, 9.8), (2.6, -12.2), (-2.2, -12.4), (0, 6.4))
TUCK = pose((1.6, -2.0), (-1.6, 1.6), (4.6, 3.6), (3.4, 4.6), (3.6, 6.0), (2.0, 6.8), (3.4, -4.4))
ARMS_LEFT = pose((-1.2, -3.6), (0.8, 1.8), (-7.2, -5.6), (-8.0, -2.4), (4.4, 9.7), (-3.8, 9.7))
ARMS_RIGHT = pose((1.2, -3.6), (-0.8, 1.8), (8.0, -2.4), (7.2, -5.6), (4.4, 9.7), (-3.8, 9.7))
FOLDED = pose((-0.2, -3.8), (0, 1.8), (2.6, -1.6), (-1.6, -1.2), (3.6, 9.7), (-3.6, 9.7))


class Dance(NamedTuple):
    """Keys (ticks to reach the pose, pose, turn in degrees); ``loop``: key to go back to after the last, -1: hold."""

    keys: tuple[tuple[int, Pose, int], ...]
    loop: int = -1

    def at(self, time: float) -> tuple[Pose, float]:
        """Pose and turn at a time in ticks, from a standing start."""
        before, turn = STAND, 0
        rest, k = time, 0
        while True:
            ticks, key, to = self.keys[k]
            if rest < ticks:
                share = rest / ticks
                share = share * share * (3 - 2 * share)
                return before.mixed(key, share), turn + (to - turn) * share
            rest -= ticks
            before, turn = key, to % 360
            k += 1
            if k == len(self.keys):
                if self.loop < 0:
                    return before, turn
                k = self.loop


DANCES = (
    Dance(((4, CROUCH, 0), (3, LEAP, 0), (4, CROUCH, 0), (3, LEAP, 0), (5, CHEER, 0))),
    Dance(((6, CHEER, 0), (9, CHEER, 0), (7, BOW, 0), (10, BOW, 0), (8, STAND, 0))),
    Dance(((4, CROUCH, 0), (4, TUCK, 180), (4, TUCK, 360), (4, CROUCH, 0), (5, CHEER, 0))),
    Dance(((5, FLEX, 0), (6, FLEX, 0), (5, FLEX_LOW, 0), (6, FLEX_LOW, 0), (5, FLEX, 0)), 1),
    Dance(((5, WAVE_OUT, 0), (4, WAVE_IN, 0)), 0),
    Dance(((6, POINT_DOWN, 0), (5, POINT_UP, 0), (6, POINT_UP, 0)), 0),
    Dance(((5, KICK, 0), (4, STAND, 0), (5, KICK_BACK, 0), (4, STAND, 0)), 0),
    Dance(((6, CROUCH, 0), (7, HANDSTAND, 0), (12, HANDSTAND, 0), (7, CROUCH, 0), (8, SIT, 0))),
    Dance(((5, ARMS_LEFT, 0), (5, ARMS_RIGHT, 0), (5, ARMS_LEFT, 0), (5, ARMS_RIGHT, 0), (6, FOLDED, 0))),
)
"""All dances; one is drawn at each landing."""
