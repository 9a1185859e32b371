"""The ninja's figure: poses of seven joints, px from the body's centre, facing right; nine dances; their drawing."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, radians, sin, tau
from typing import NamedTuple

import pygame

from ninja_game.sim.grid import Point
from ninja_game.ui.theme import PALETTES, Palette, mixed
from ninja_game.view.sprites.sketch import Sketch, Sprite

FEET = 9.7  # px from the centre down to the floor


class Pose(NamedTuple):
    """The places of the joints. ``near`` limbs are drawn over the trunk, ``far`` ones behind it."""

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

    def pressed(self, share: float) -> Pose:
        """Compressed towards the feet by a share of its height, and as much wider."""
        return Pose(*((x * (1 + 0.6 * share), FEET - (FEET - y) * (1 - share)) for x, y in self))

    def moved(self, dx: float, dy: float) -> Pose:
        return Pose(*((x + dx, y + dy) for x, y in self))


def _pose(
    shoulder: Point,
    pelvis: Point,
    near_hand: Point,
    far_hand: Point,
    near_foot: Point,
    far_foot: Point,
    head: Point | None = None,
) -> Pose:
    """A pose; by default the head continues the trunk."""
    if head is None:
        dx, dy = shoulder[0] - pelvis[0], shoulder[1] - pelvis[1]
        length = (dx * dx + dy * dy) ** 0.5 or 1.0
        head = shoulder[0] + dx / length * 3.4 + 0.5, shoulder[1] + dy / length * 3.4
    return Pose(head, shoulder, pelvis, near_hand, far_hand, near_foot, far_foot)


STAND = _pose((-1.0, -4.8), (-0.3, 0.8), (4.0, 0.2), (-5.0, 1.4), (3.8, 9.7), (-3.2, 9.7))
"""At ease, weight on the back foot."""

SKID = _pose((-4.8, -3.0), (-1.6, 2.2), (1.6, -5.8), (-10.0, -0.6), (7.4, 9.7), (3.0, 9.7), (-5.2, -6.6))
"""Leaning back against the motion."""

SLIDE = _pose((2.4, -4.0), (1.8, 1.7), (9.4, -8.4), (9.2, -3.0), (9.0, 5.8), (6.4, 9.6), (2.8, -7.4))
"""Hands and feet on a wall to the right."""

LEAP = _pose((1.6, -4.6), (-0.6, 0.8), (-5.2, -1.0), (5.4, -0.8), (2.6, 8.4), (-5.4, 10.2))
"""Taking off: arms swung back and forth, legs stretched."""

RISE = _pose((1.2, -4.4), (-0.4, 1.0), (8.6, -7.0), (-5.6, -1.6), (4.8, 5.2), (-4.6, 10.0))
"""Rising: one arm reaching ahead, one knee high, the other leg stretched."""

FLOAT = _pose((0.6, -4.0), (-0.4, 1.4), (7.2, -4.6), (-6.4, -3.6), (5.2, 6.4), (-4.6, 7.2))
"""At the top: knees drawn up, arms out."""

_FALL = _pose((-0.2, -4.0), (0.2, 1.4), (6.4, -9.4), (-6.6, -8.6), (4.6, 9.6), (-2.6, 10.2))
"""Falling fast: arms up, legs reaching down."""


_LEAP_SPEED = 3.0  # greatest upward speed at the start of a jump from the floor, px/tick


def air_pose(vy: float) -> Pose:
    """The pose in the air for a vertical velocity in px/tick: 19 steps in the original, continuous here."""
    if vy >= 0:
        return FLOAT.mixed(_FALL, min(1.0, (vy / 2.5) ** 0.5))
    k = min(1.0, -vy / _LEAP_SPEED) * 2
    return FLOAT.mixed(RISE, k) if k < 1 else RISE.mixed(LEAP, k - 1)


# --- running: one cycle is 64.8 px of travel ---

CYCLE = 64.8
_STANCE = 0.25  # share of a cycle in which a foot is on the ground; it then moves back as fast as the body moves on
_REACH = CYCLE * _STANCE / 2
_SWING = ((-_REACH, FEET), (-10.2, 5.0), (-6.6, 1.6), (0.6, 2.8), (6.4, 5.0), (9.0, 7.8), (_REACH, FEET))
"""The path of a foot through the air, from back to front."""


def _foot(phase: float) -> Point:
    phase %= 1.0
    if phase < _STANCE:
        return _REACH - CYCLE * phase, FEET
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
    swing = sin(tau * (phase + 0.12))
    bob = 0.7 * cos(2 * tau * (phase - 0.08)) * vigour
    near, far = _foot(phase), _foot(phase + 0.5)
    near = near[0] * vigour, FEET - (FEET - near[1]) * vigour
    far = far[0] * vigour, FEET - (FEET - far[1]) * vigour
    pelvis = -0.6, 1.4 + bob
    shoulder = 0.2 + 1.9 * lean, -4.0 + bob
    near_hand = shoulder[0] - 6.4 * swing * vigour, -0.2 + bob - 2.4 * abs(swing)
    far_hand = shoulder[0] + 6.4 * swing * vigour, -0.2 + bob - 2.4 * abs(swing)
    head = shoulder[0] + 0.9 + 0.7 * lean, -7.5 + bob
    return Pose(head, shoulder, pelvis, near_hand, far_hand, near, far)


CHEER = _pose((-0.2, -5.3), (0, 0.5), (5.4, -11.3), (-5.4, -11.3), (4.4, 9.7), (-4.4, 9.7))
CROUCH = _pose((0.6, 0.4), (-1.6, 5.4), (4.4, 6.4), (-4.6, 6.4), (4.2, 9.7), (-4, 9.7))
HOP = _pose((0, -6.4), (0, -0.8), (6.2, -12.4), (-6.2, -12.4), (5.4, 5), (-5.4, 5))
BOW = _pose((4.4, -1.1), (-1.6, 0.5), (1, 2.7), (-6, 0.9), (2.2, 9.7), (-2.4, 9.7), (7.6, 1.4))
POINT_UP = _pose((-0.6, -4.9), (0.8, 0.7), (5.4, -11.1), (-4.2, 0.3), (5, 9.7), (-3.6, 9.7))
POINT_DOWN = _pose((0.8, -4.7), (-0.8, 0.7), (-5.6, 1.9), (-4.8, -1.1), (5, 9.7), (-3.6, 9.7))
FLEX = _pose((0, -4.9), (0, 0.7), (5.2, -6.5), (-5.2, -6.5), (4.6, 9.7), (-4.6, 9.7))
FLEX_LOW = _pose((0, -4.5), (0, 0.9), (3.2, 1.1), (-3.2, 1.1), (4.6, 9.7), (-4.6, 9.7))
WAVE_OUT = _pose((-0.6, -4.9), (-0.2, 0.7), (7.2, -9.1), (-4.6, 1.3), (4.2, 9.7), (-3.6, 9.7))
WAVE_IN = _pose((-0.8, -4.9), (-0.2, 0.7), (3.6, -11.1), (-4.6, 1.3), (4.2, 9.7), (-3.6, 9.7))
KICK = _pose((-3, -4.3), (-0.8, 0.9), (3.6, -5.5), (-7.8, -5.3), (9.6, 1), (-1, 9.7))
KICK_BACK = _pose((2.4, -4.3), (0.4, 0.9), (6.8, -5.5), (-4.4, -5.9), (1, 9.7), (-8.6, 3.4))
SIT = _pose((-0.6, 0.6), (-1, 6.2), (4.4, 5.4), (-5, 5.4), (4.8, 9.6), (-4.6, 9.6))
HANDSTAND = _pose((0, 3.2), (0, -2.4), (2.4, 9.8), (-2.4, 9.8), (2.6, -12.2), (-2.2, -12.4), (0, 6.4))
TUCK = _pose((1.6, -3.1), (-1.6, 0.5), (4.6, 2.9), (3.4, 3.9), (3.6, 6), (2, 6.8), (3.4, -5.2))
ARMS_LEFT = _pose((-1.2, -4.7), (0.8, 0.7), (-7.2, -6.3), (-8, -3.1), (4.4, 9.7), (-3.8, 9.7))
ARMS_RIGHT = _pose((1.2, -4.7), (-0.8, 0.7), (8, -3.1), (7.2, -6.3), (4.4, 9.7), (-3.8, 9.7))
FOLDED = _pose((-0.2, -4.9), (0, 0.7), (2.6, -2.3), (-1.6, -1.9), (3.6, 9.7), (-3.6, 9.7))


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
"""All dances; one is drawn by lot at each landing."""


# --- painting: tapering parts between the joints, a headband, and nothing else ---

THIGH, SHIN = 5.0, 5.2
UPPER_ARM, FOREARM = 4.0, 4.2
_HEAD = 2.5
FIGURE_REACH = 17.0
_EDGE = 1.0  # width of the light or dark edge around the figure, px


def edge_of(colour: pygame.Color) -> pygame.Color:
    """The edge around a figure of a colour: light around a dark one, dark around a light one."""
    bright = 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b
    return pygame.Color("#fffdf6" if bright < 110 else "#0c0a12")


def bend(a: Point, b: Point, first: float, second: float, side: float) -> Point:
    """The elbow or knee between two joints, for parts of those lengths. ``side``: where it bends to, 1 or -1."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    distance = (dx * dx + dy * dy) ** 0.5
    if distance < 1e-6:
        return a[0] + side * first, a[1]
    reach = min(distance, (first + second) * 0.999)
    along = (first * first - second * second + reach * reach) / (2 * reach)
    out = max(0.0, first * first - along * along) ** 0.5 * side
    ux, uy = dx / distance, dy / distance
    # A limb stretched beyond the length of its parts (the ragdoll) is straight.
    along *= distance / reach
    return a[0] + ux * along - uy * out, a[1] + uy * along + ux * out


Limb = tuple[Sequence[Point], Sequence[float]]  # joints, and the width at each


def limbs_of(pose: Pose, facing: int) -> tuple[Limb, Limb, Limb, Limb]:
    """The far leg and arm, the near leg and arm. ``facing``: the direction of bent knees."""
    shoulder, pelvis = pose.shoulder, pose.pelvis
    far = leg(pelvis, pose.far_foot, facing), arm(shoulder, pose.far_hand, facing)
    return *far, leg(pelvis, pose.near_foot, facing), arm(shoulder, pose.near_hand, facing)


def leg(hip: Point, foot: Point, facing: int) -> Limb:
    """Thigh, shin and a hint of a foot."""
    knee = bend(hip, foot, THIGH, SHIN, -facing)
    return (hip, knee, foot, (foot[0] + 1.7 * facing, foot[1] - 0.1)), (2.7, 1.9, 1.3, 0.9)


def arm(shoulder: Point, hand: Point, facing: int) -> Limb:
    """Upper arm and forearm."""
    return (shoulder, bend(shoulder, hand, UPPER_ARM, FOREARM, facing), hand), (1.9, 1.5, 1.1)


def paint_trunk(s: Sketch, colour: pygame.Color, head: Point, shoulder: Point, pelvis: Point) -> None:
    s.stroke(colour, shoulder, pelvis, 3.4, 2.5)
    s.stroke(colour, shoulder, head, 1.6)
    s.disc(colour, *head, _HEAD)


def _paint_limbs(s: Sketch, colour: pygame.Color, far: pygame.Color, pose: Pose, limbs: Sequence[Limb]) -> None:
    """All parts of a figure, the far ones first."""
    for limb in limbs[:2]:
        s.limb(far, *limb)
    paint_trunk(s, colour, pose.head, pose.shoulder, pose.pelvis)
    for limb in limbs[2:]:
        s.limb(colour, *limb)


def band_ends(head: Point, shoulder: Point) -> tuple[Point, Point]:
    """The two points where a headband crosses the outline of a head above a neck: left and right."""
    ux, uy = head[0] - shoulder[0], head[1] - shoulder[1]
    length = (ux * ux + uy * uy) ** 0.5 or 1.0
    ux, uy = ux / length, uy / length
    x, y = head[0] + 0.75 * ux, head[1] + 0.75 * uy
    return (x + 2.2 * uy, y - 2.2 * ux), (x - 2.2 * uy, y + 2.2 * ux)


def paint_tails(s: Sketch, colour: pygame.Color, pose: Pose, facing: int, velocity: Point) -> None:
    """The two ends of the headband, which trail behind the motion."""
    left, right = band_ends(pose.head, pose.shoulder)
    knot = left if facing > 0 else right
    for k, drop in ((1.0, 0.2), (0.75, 1.6)):
        fx = -facing * 4.0 - velocity[0] * 0.75
        fy = drop + 0.9 - velocity[1] * 0.6
        length = (fx * fx + fy * fy) ** 0.5
        scale = k * min(1.0, 8.0 / length)
        middle = knot[0] + fx * scale * 0.5, knot[1] + fy * scale * 0.5 - 0.6
        s.path(colour, [knot, middle, (knot[0] + fx * scale, knot[1] + fy * scale)], 1.4)


def ninja_sprite(
    scale: float, palette: Palette, pose: Pose, facing: int, velocity: Point, *,
    colour: pygame.Color, offset: Point = (0.0, 0.0), alpha: float = 1.0, banded: bool = True,
) -> Sprite:  # fmt: skip
    """The figure in a pose about its centre. ``offset``: fraction of a px between it and its point."""
    s = Sketch(scale, (-FIGURE_REACH, -FIGURE_REACH, FIGURE_REACH, FIGURE_REACH), fine=3)
    shown = pose.moved(offset[0] / scale, offset[1] / scale)
    paint_figure(s, palette, shown, facing, velocity, colour=colour, banded=banded)
    return s.finish(alpha)


def paint_figure(
    s: Sketch, palette: Palette, shown: Pose, facing: int, velocity: Point, *, colour: pygame.Color, banded: bool = True
) -> None:
    """Draw the figure into a sketch, ``FIGURE_REACH`` px to all sides, with a contrasting edge."""
    far = mixed(colour, palette.background, 0.12)
    edge = edge_of(colour)
    limbs = limbs_of(shown, facing)
    s.grown = _EDGE
    _paint_limbs(s, edge, edge, shown, limbs)
    s.grown = 0.0
    if banded:
        paint_tails(s, palette.band, shown, facing, velocity)
    _paint_limbs(s, colour, far, shown, limbs)
    if banded:
        s.stroke(palette.band, *band_ends(shown.head, shown.shoulder), 1.5)


def icon(size: int, *, corner: float = 1 / 6) -> pygame.Surface:
    """The game's icon, the running ninja. ``size``: px; ``corner``: radius of the corners, as a share of it."""
    palette = PALETTES["classic"]
    picture = pygame.Surface((size, size), pygame.SRCALPHA)
    pygame.draw.rect(picture, palette.background, picture.get_rect(), border_radius=int(size * corner))
    scale = size / 28 if corner else size / 40
    sprite = ninja_sprite(scale, palette, run_pose(0.1, 5.0), 1, (5, 0), colour=palette.ninja)
    sprite.blit(picture, (size // 2, size // 2))
    return picture
