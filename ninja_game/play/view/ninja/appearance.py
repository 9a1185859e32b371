"""Drawing of the ninja alive or dead, and of ghosts."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.canvas import Point
from ninja_game.play.ui.palette import mixed
from ninja_game.play.view.ninja.figure import HEAD, band_ends, ninja_sprite, paint_arm, paint_leg
from ninja_game.play.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.play.view.ninja.ragdoll import PELVIS, SHOULDER, TRUNK, Ragdoll
from ninja_game.play.view.sprites.draw_target import DrawTarget, is_near
from ninja_game.play.view.sprites.sketch import Sketch


def draw_ninja(target: DrawTarget, animation: NinjaAnimation, at: Point, fraction: float, colour: pygame.Color) -> None:
    """The living ninja about a point."""
    if not is_near(*at):
        return
    px, py = target.canvas.exact(*at)
    offset = px - round(px), py - round(py)
    sprite = ninja_sprite(
        target.canvas.scale, target.palette, animation.pose(fraction), animation.facing, animation.velocity,
        colour=colour, offset=offset,
    )  # fmt: skip
    target.picture(sprite, *at)


def draw_ghost(target: DrawTarget, animation: NinjaAnimation, at: Point, fraction: float, colour: pygame.Color) -> None:
    """A figure that one can look through."""
    sprite = ninja_sprite(
        target.canvas.scale, target.palette, animation.pose(fraction), animation.facing, animation.velocity,
        colour=colour, alpha=0.45, banded=False,
    )  # fmt: skip
    target.picture(sprite, *at)


def draw_ragdoll(target: DrawTarget, doll: Ragdoll, fraction: float, colour: pygame.Color) -> None:
    """The corpse: each limb where its stick is."""
    joints = [doll.joint(k, fraction) for k in range(len(doll.particles))]
    head = doll.head(fraction)
    if not doll.dismembered:
        xs, ys = [x for x, _ in joints], [y for _, y in joints]
        x, y = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
        _draw_parts(target, doll, joints, head, range(5), (x, y), colour)
        return
    for k, stick in enumerate(doll.sticks):
        (ax, ay), (bx, by) = joints[stick.first], joints[stick.second]
        _draw_parts(target, doll, joints, head, (k,), ((ax + bx) / 2, (ay + by) / 2), colour)


def _draw_parts(
    target: DrawTarget, doll: Ragdoll, joints: list[Point], head: Point, sticks: range | tuple[int, ...],
    at: Point, colour: pygame.Color,
) -> None:  # fmt: skip
    """Some sticks of the corpse in one small drawing about a point."""
    if not is_near(*at):
        return
    reach = 8.0 + max(
        max(abs(joints[end][axis] - at[axis]) for end in doll.sticks[k][:2] for axis in (0, 1)) for k in sticks
    )
    s = Sketch(target.canvas.scale, (-reach, -reach, reach, reach), fine=3)
    places = [(x - at[0], y - at[1]) for x, y in joints]
    hx, hy = head[0] - at[0], head[1] - at[1]
    far = mixed(colour, target.palette.background, 0.22)
    for k in sticks:
        stick = doll.sticks[k]
        a, b = places[stick.first], places[stick.second]
        shade = far if k in {0, 1} else colour
        if k == TRUNK:
            s.stroke(shade, places[SHOULDER], places[PELVIS], 3.4, 2.5)
            s.stroke(shade, places[SHOULDER], (hx, hy), 1.6)
            s.disc(shade, hx, hy, HEAD)
            s.stroke(target.palette.band, *band_ends((hx, hy), places[SHOULDER]), 1.1)
        elif k in {0, 4}:
            paint_arm(s, shade, a, b, doll.facing)
        else:
            paint_leg(s, shade, a, b, doll.facing)
    target.picture(s.finish(), *at)
