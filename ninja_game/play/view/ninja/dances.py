"""Nine victory dances: key poses with their times in ticks. After the last key a dance holds, or goes back."""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.play.view.ninja.pose import STAND, Pose, pose

CHEER = pose((-0.2, -5.3), (0, 0.5), (5.4, -11.3), (-5.4, -11.3), (4.4, 9.7), (-4.4, 9.7))
CROUCH = pose((0.6, 0.4), (-1.6, 5.4), (4.4, 6.4), (-4.6, 6.4), (4.2, 9.7), (-4, 9.7))
LEAP = pose((0, -6.4), (0, -0.8), (6.2, -12.4), (-6.2, -12.4), (5.4, 5), (-5.4, 5))
BOW = pose((4.4, -1.1), (-1.6, 0.5), (1, 2.7), (-6, 0.9), (2.2, 9.7), (-2.4, 9.7), (7.6, 1.4))
POINT_UP = pose((-0.6, -4.9), (0.8, 0.7), (5.4, -11.1), (-4.2, 0.3), (5, 9.7), (-3.6, 9.7))
POINT_DOWN = pose((0.8, -4.7), (-0.8, 0.7), (-5.6, 1.9), (-4.8, -1.1), (5, 9.7), (-3.6, 9.7))
FLEX = pose((0, -4.9), (0, 0.7), (5.2, -6.5), (-5.2, -6.5), (4.6, 9.7), (-4.6, 9.7))
FLEX_LOW = pose((0, -4.5), (0, 0.9), (3.2, 1.1), (-3.2, 1.1), (4.6, 9.7), (-4.6, 9.7))
WAVE_OUT = pose((-0.6, -4.9), (-0.2, 0.7), (7.2, -9.1), (-4.6, 1.3), (4.2, 9.7), (-3.6, 9.7))
WAVE_IN = pose((-0.8, -4.9), (-0.2, 0.7), (3.6, -11.1), (-4.6, 1.3), (4.2, 9.7), (-3.6, 9.7))
KICK = pose((-3, -4.3), (-0.8, 0.9), (3.6, -5.5), (-7.8, -5.3), (9.6, 1), (-1, 9.7))
KICK_BACK = pose((2.4, -4.3), (0.4, 0.9), (6.8, -5.5), (-4.4, -5.9), (1, 9.7), (-8.6, 3.4))
SIT = pose((-0.6, 0.6), (-1, 6.2), (4.4, 5.4), (-5, 5.4), (4.8, 9.6), (-4.6, 9.6))
HANDSTAND = pose((0, 3.2), (0, -2.4), (2.4, 9.8), (-2.4, 9.8), (2.6, -12.2), (-2.2, -12.4), (0, 6.4))
TUCK = pose((1.6, -3.1), (-1.6, 0.5), (4.6, 2.9), (3.4, 3.9), (3.6, 6), (2, 6.8), (3.4, -5.2))
ARMS_LEFT = pose((-1.2, -4.7), (0.8, 0.7), (-7.2, -6.3), (-8, -3.1), (4.4, 9.7), (-3.8, 9.7))
ARMS_RIGHT = pose((1.2, -4.7), (-0.8, 0.7), (8, -3.1), (7.2, -6.3), (4.4, 9.7), (-3.8, 9.7))
FOLDED = pose((-0.2, -4.9), (0, 0.7), (2.6, -2.3), (-1.6, -1.9), (3.6, 9.7), (-3.6, 9.7))


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
