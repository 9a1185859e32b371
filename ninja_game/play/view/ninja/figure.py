"""The ninja's figure: eleven tapering parts between the joints of a pose, a headband, and nothing else."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.canvas import Point
from ninja_game.play.ui.theme import Palette, mixed
from ninja_game.play.view.ninja.pose import Pose
from ninja_game.play.view.sprites.sketch import Sketch, Sprite

THIGH, SHIN = 5.0, 5.2
UPPER_ARM, FOREARM = 4.0, 4.2
HEAD = 2.5
REACH = 17.0


def bend(a: Point, b: Point, first: float, second: float, side: float) -> Point:
    """The elbow or knee between two joints, for parts of those lengths; ``side`` 1 or -1: which way it bends."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    distance = (dx * dx + dy * dy) ** 0.5
    if distance < 1e-6:
        return a[0] + side * first, a[1]
    reach = min(distance, (first + second) * 0.999)
    along = (first * first - second * second + reach * reach) / (2 * reach)
    out = max(0.0, first * first - along * along) ** 0.5 * side
    ux, uy = dx / distance, dy / distance
    # A limb that is pulled longer than its parts (the ragdoll) is stretched.
    along *= distance / reach
    return a[0] + ux * along - uy * out, a[1] + uy * along + ux * out


def paint_limbs(s: Sketch, colour: pygame.Color, far: pygame.Color, pose: Pose, facing: int) -> None:
    """All parts of a figure, the far ones first. ``facing``: which way knees bend."""
    paint_leg(s, far, pose.pelvis, pose.far_foot, facing)
    paint_arm(s, far, pose.shoulder, pose.far_hand, facing)
    paint_trunk(s, colour, pose)
    paint_leg(s, colour, pose.pelvis, pose.near_foot, facing)
    paint_arm(s, colour, pose.shoulder, pose.near_hand, facing)


def paint_leg(s: Sketch, colour: pygame.Color, hip: Point, foot: Point, facing: int) -> None:
    """Thigh, shin and a hint of a foot."""
    knee = bend(hip, foot, THIGH, SHIN, -facing)
    s.stroke(colour, hip, knee, 2.7, 1.9)
    s.stroke(colour, knee, foot, 1.9, 1.3)
    s.stroke(colour, foot, (foot[0] + 1.7 * facing, foot[1] - 0.1), 1.3, 0.9)


def paint_arm(s: Sketch, colour: pygame.Color, shoulder: Point, hand: Point, facing: int) -> None:
    """Upper arm and forearm."""
    elbow = bend(shoulder, hand, UPPER_ARM, FOREARM, facing)
    s.stroke(colour, shoulder, elbow, 1.9, 1.5)
    s.stroke(colour, elbow, hand, 1.5, 1.1)


def paint_trunk(s: Sketch, colour: pygame.Color, pose: Pose) -> None:
    """Trunk, neck and head."""
    s.stroke(colour, pose.shoulder, pose.pelvis, 3.4, 2.5)
    s.stroke(colour, pose.shoulder, pose.head, 1.6)
    s.disc(colour, *pose.head, HEAD)


def band_ends(head: Point, shoulder: Point) -> tuple[Point, Point]:
    """Where a headband crosses the outline of a head that goes on where the neck ends: left and right of it."""
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
        fx = -facing * 2.6 - velocity[0] * 0.75
        fy = drop + 0.9 - velocity[1] * 0.6
        length = (fx * fx + fy * fy) ** 0.5
        scale = k * min(1.0, 6.0 / length)
        middle = knot[0] + fx * scale * 0.5, knot[1] + fy * scale * 0.5 - 0.6
        s.path(colour, [knot, middle, (knot[0] + fx * scale, knot[1] + fy * scale)], 0.9)


def ninja_sprite(
    scale: float, palette: Palette, pose: Pose, facing: int, velocity: Point, *,
    colour: pygame.Color, offset: Point = (0.0, 0.0), alpha: float = 1.0, banded: bool = True,
) -> Sprite:  # fmt: skip
    """The figure in a pose about its centre. ``offset``: fraction of a px by which it lies beside its point."""
    s = Sketch(scale, (-REACH, -REACH, REACH, REACH), fine=3)
    shown = pose.moved(offset[0] / scale, offset[1] / scale)
    paint_figure(s, palette, shown, facing, velocity, colour=colour, banded=banded)
    return s.finish(alpha)


def paint_figure(
    s: Sketch, palette: Palette, shown: Pose, facing: int, velocity: Point, *, colour: pygame.Color, banded: bool = True
) -> None:
    """Draw the figure into a sketch, ``REACH`` px to all sides."""
    far = mixed(colour, palette.background, 0.22)
    if banded:
        paint_tails(s, palette.band, shown, facing, velocity)
    paint_limbs(s, colour, far, shown, facing)
    if banded:
        s.stroke(palette.band, *band_ends(shown.head, shown.shoulder), 1.1)
