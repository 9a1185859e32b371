"""Poses of the ninja: seven joints in px from the body's centre, facing right, feet 10 px below it; and nine dances."""

from __future__ import annotations

from math import cos, radians, sin
from typing import NamedTuple

from ninja_game.play.ui.canvas import Point


class Pose(NamedTuple):
    """Where the joints are. ``near`` limbs are drawn over the trunk, ``far`` ones behind it."""

    head: Point
    shoulder: Point
    pelvis: Point
    near_hand: Point
    far_hand: Point
    near_foot: Point
    far_foot: Point

    def mixed(self, other: Pose, share: float) -> Pose:
        """A pose between this one (0) and another (1)."""
        return Pose(
            *((a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share) for a, b in zip(self, other, strict=True))
        )

    def placed(self, facing: int, turn: float) -> Pose:
        """Mirrored for ``facing`` -1, then turned by degrees clockwise about the centre."""
        if turn == 0:
            return Pose(*((x * facing, y) for x, y in self)) if facing < 0 else self
        c, s = cos(radians(turn)), sin(radians(turn))
        return Pose(*((x * facing * c - y * s, x * facing * s + y * c) for x, y in self))

    def moved(self, dx: float, dy: float) -> Pose:
        return Pose(*((x + dx, y + dy) for x, y in self))


def pose(
    shoulder: Point, pelvis: Point, near_hand: Point, far_hand: Point, near_foot: Point, far_foot: Point,
    head: Point | None = None,
) -> Pose:  # fmt: skip
    """A pose; without a place for it the head goes on where the trunk ends."""
    if head is None:
        dx, dy = shoulder[0] - pelvis[0], shoulder[1] - pelvis[1]
        length = (dx * dx + dy * dy) ** 0.5 or 1.0
        head = shoulder[0] + dx / length * 3.4 + 0.5, shoulder[1] + dy / length * 3.4
    return Pose(head, shoulder, pelvis, near_hand, far_hand, near_foot, far_foot)


STAND = pose((-1.0, -4.8), (-0.3, 0.8), (4.0, 0.2), (-5.0, 1.4), (3.8, 9.7), (-3.2, 9.7))
"""At ease, weight on the back foot."""

SKID = pose((-4.8, -3.0), (-1.6, 2.2), (1.6, -5.8), (-10.0, -0.6), (7.4, 9.7), (3.0, 9.7), (-5.2, -6.6))
"""Leaning back against the motion."""

SLIDE = pose((2.4, -4.0), (1.8, 1.7), (9.4, -8.4), (9.2, -3.0), (9.0, 5.8), (6.4, 9.6), (2.8, -7.4))
"""Hands and feet on a wall to the right."""

LEAP = pose((1.6, -4.6), (-0.6, 0.8), (-5.2, -1.0), (5.4, -0.8), (2.6, 8.4), (-5.4, 10.2))
"""Taking off: arms swung back and forth, legs stretched."""

RISE = pose((1.2, -4.4), (-0.4, 1.0), (8.6, -7.0), (-5.6, -1.6), (4.8, 5.2), (-4.6, 10.0))
"""Rising: one arm reaching ahead, one knee high, the other leg stretched."""

FLOAT = pose((0.6, -4.0), (-0.4, 1.4), (7.2, -4.6), (-6.4, -3.6), (5.2, 6.4), (-4.6, 7.2))
"""At the top: knees drawn up, arms out."""

FALL = pose((-0.2, -4.0), (0.2, 1.4), (6.4, -9.4), (-6.6, -8.6), (4.6, 9.6), (-2.6, 10.2))
"""Falling fast: arms up, legs reaching down."""


_LEAP_SPEED = 3.0
"""Speed upwards with which a jump from the floor begins at most, px/tick."""


def air_pose(vy: float) -> Pose:
    """The pose in the air for a vertical velocity in px/tick: 19 steps in the original, here without steps."""
    if vy >= 0:
        return FLOAT.mixed(FALL, min(1.0, (vy / 2.5) ** 0.5))
    k = min(1.0, -vy / _LEAP_SPEED) * 2
    return FLOAT.mixed(RISE, k) if k < 1 else RISE.mixed(LEAP, k - 1)


# --- running: one cycle is 64.8 px of travel ---

CYCLE = 64.8
_STANCE = 0.25
"""Share of a cycle in which a foot is on the ground; it then goes back as fast as the body goes on."""
_REACH = CYCLE * _STANCE / 2
_SWING = ((-_REACH, 9.7), (-10.2, 5.0), (-6.6, 1.6), (0.6, 2.8), (6.4, 5.0), (9.0, 7.8), (_REACH, 9.7))
"""The way of a foot through the air, from behind to the front."""


def _foot(phase: float) -> Point:
    phase %= 1.0
    if phase < _STANCE:
        return _REACH - CYCLE * phase, 9.7
    way = (phase - _STANCE) / (1 - _STANCE) * (len(_SWING) - 1)
    k = min(int(way), len(_SWING) - 2)
    return _spline(_SWING, k, way - k)


def _spline(points: tuple[Point, ...], k: int, t: float) -> Point:
    """Catmull-Rom between points k and k + 1."""
    a, b = points[max(k - 1, 0)], points[k]
    c, d = points[k + 1], points[min(k + 2, len(points) - 1)]
    return _cubic(a[0], b[0], c[0], d[0], t), _cubic(a[1], b[1], c[1], d[1], t)


def _cubic(a: float, b: float, c: float, d: float, t: float) -> float:
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))


def run_pose(phase: float, speed: float) -> Pose:
    """The pose at a phase (0…1) of the running cycle; slow steps are shorter. ``speed``: px/tick."""
    vigour = min(1.0, 0.4 + speed / 5.0)
    lean = min(1.0, speed / 4.0)
    swing = sin(2 * 3.141592653589793 * (phase + 0.12))
    bob = 0.7 * cos(4 * 3.141592653589793 * (phase - 0.08)) * vigour
    near, far = _foot(phase), _foot(phase + 0.5)
    near = near[0] * vigour, 9.7 - (9.7 - near[1]) * vigour
    far = far[0] * vigour, 9.7 - (9.7 - far[1]) * vigour
    pelvis = -0.6, 1.4 + bob
    shoulder = 0.2 + 1.9 * lean, -4.0 + bob
    near_hand = shoulder[0] - 6.4 * swing * vigour, -0.2 + bob - 2.4 * abs(swing)
    far_hand = shoulder[0] + 6.4 * swing * vigour, -0.2 + bob - 2.4 * abs(swing)
    head = shoulder[0] + 0.9 + 0.7 * lean, -7.5 + bob
    return Pose(head, shoulder, pelvis, near_hand, far_hand, near, far)


CHEER = pose((-0.2, -5.3), (0, 0.5), (5.4, -11.3), (-5.4, -11.3), (4.4, 9.7), (-4.4, 9.7))
CROUCH = pose((0.6, 0.4), (-1.6, 5.4), (4.4, 6.4), (-4.6, 6.4), (4.2, 9.7), (-4, 9.7))
HOP = pose((0, -6.4), (0, -0.8), (6.2, -12.4), (-6.2, -12.4), (5.4, 5), (-5.4, 5))
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
    Dance(((4, CROUCH, 0), (3, HOP, 0), (4, CROUCH, 0), (3, HOP, 0), (5, CHEER, 0))),
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
