"""The ninja's animation: follows the ticks and gives a pose for any moment (presentation.md §3)."""

from __future__ import annotations

from math import atan2, degrees, hypot
from random import Random

import pygame

from ninja_game.sim.events import LANDED
from ninja_game.sim.grid import Point
from ninja_game.sim.schema.world_fields import Ninja, World
from ninja_game.sim.states import CELEBRATING, DEAD, FALLING, JUMPING, RUNNING, SKIDDING, SLIDING
from ninja_game.ui.theme import mixed
from ninja_game.view.ninja import figure
from ninja_game.view.ninja.figure import DANCES, STAND, Pose, air_pose, arm, band_ends, leg, ninja_sprite
from ninja_game.view.ninja.ragdoll import PELVIS, SHOULDER, TRUNK, Ragdoll
from ninja_game.view.sprites.drawing import DrawTarget, is_near
from ninja_game.view.sprites.sketch import Sketch

_BLEND_TICKS = 3.0  # ticks of the transition to a new state's pose
SQUASH = 0.045  # compression by a landing, for each px/tick
MAX_SQUASH = 0.32
SQUASH_KEPT = 0.72  # share of it that is left a tick later
_BALANCE = 0.65  # share of a slope's angle by which a body on it stays upright
_UPRIGHT = 0.9  # share of its rotation that a body in the air keeps each tick


class NinjaAnimation:
    """The ninja's figure between ticks. ``rng``: chooses the dances, never read by the world.

    ``squashes``: whether a landing compresses it.
    """

    def __init__(self, world: World, rng: Random) -> None:
        self._rng = rng
        self.squashes = True
        self.reset(world)

    def reset(self, world: World) -> None:
        """A new run, or a jump in time."""
        n = world.ninja
        self.state = n.state
        self.facing = 1
        self.turn = self.turn_before = self._floor_turn(n) if not n.in_air else 0.0
        self.phase = self.phase_before = 0.0
        self.since = 100.0
        self.velocity = (0.0, 0.0)
        self.dance = -1
        self.squash = 0.0
        self._from = STAND
        self._face(n)

    @staticmethod
    def _floor_turn(n: Ninja) -> float:
        return degrees(atan2(n.floor_x, -n.floor_y)) if n.floor_x or n.floor_y else 0.0

    def _face(self, n: Ninja) -> None:
        """Face the wall while sliding, else the direction of motion."""
        if n.state == SLIDING:
            self.facing = -1 if n.wall_x > 0 else 1
        elif abs(n.x - n.prev_x) > 1e-9:
            self.facing = 1 if n.x > n.prev_x else -1

    def on_tick(self, world: World) -> None:
        n = world.ninja
        if n.state == DEAD:
            self.state = DEAD
            return
        if n.state != self.state or (n.state == CELEBRATING and not n.in_air and n.was_in_air):
            self._from = self.local_pose(1.0)
            if n.state == RUNNING and self.state != RUNNING:
                self.phase = 0.0
            self.state = n.state
            self.since = 0.0
            self.dance = self._rng.randrange(len(DANCES)) if n.state == CELEBRATING and not n.in_air else -1
        else:
            self.since += 1.0
        self._face(n)
        self.squash *= SQUASH_KEPT
        for event in world.events[: world.event_count] if self.squashes else ():
            if event.kind == LANDED:
                self.squash = min(MAX_SQUASH, SQUASH * hypot(event.dx, event.dy))
        self.velocity = n.x - n.prev_x, n.y - n.prev_y
        self.phase_before = self.phase
        if n.state == RUNNING:
            self.phase += self.speed(n) / figure.CYCLE
        self.turn_before = self.turn
        if n.state in {JUMPING, SLIDING} and self.since == 0.0:
            self.turn = self.turn_before = 0.0
        elif n.in_air:
            self.turn *= _UPRIGHT
        else:
            self.turn = self._floor_turn(n)

    @staticmethod
    def speed(n: Ninja) -> float:
        """Speed along the floor, px/tick."""
        vx, vy = n.x - n.prev_x, n.y - n.prev_y
        return abs(vx * -n.floor_y + vy * n.floor_x) if n.floor_x or n.floor_y else abs(vx)

    def local_pose(self, fraction: float) -> Pose:
        """The pose about the centre, facing right, not rotated."""
        target = self._target(fraction)
        share = min(1.0, (self.since + fraction) / _BLEND_TICKS)
        return target if share >= 1.0 else self._from.mixed(target, share * share * (3 - 2 * share))

    def _target(self, fraction: float) -> Pose:
        if self.state == RUNNING:
            phase = self.phase_before + (self.phase - self.phase_before) * fraction
            vx, vy = self.velocity
            return figure.run_pose(phase, (vx * vx + vy * vy) ** 0.5)
        if self.state in {JUMPING, FALLING}:
            return air_pose(self.velocity[1])
        if self.state == CELEBRATING:
            return air_pose(self.velocity[1]) if self.dance < 0 else DANCES[self.dance].at(self.since + fraction)[0]
        return {SKIDDING: figure.SKID, SLIDING: figure.SLIDE}.get(self.state, STAND)

    def pose(self, fraction: float) -> Pose:
        """The visible pose about the centre."""
        turn = floor = self.turn_before + (self.turn - self.turn_before) * fraction
        if self.state == CELEBRATING and self.dance >= 0:
            turn += DANCES[self.dance].at(self.since + fraction)[1] * self.facing
        pose = self.local_pose(fraction)
        if self.squash > 0.02:
            pose = pose.pressed(self.squash * SQUASH_KEPT**fraction)
        placed = pose.placed(self.facing, turn)
        if not floor:
            return placed
        # The feet follow a slope; the body above them stays nearly upright.
        upright = pose.placed(self.facing, turn - _BALANCE * floor)
        return upright._replace(near_foot=placed.near_foot, far_foot=placed.far_foot)


def draw_ninja(
    target: DrawTarget,
    animation: NinjaAnimation,
    at: Point,
    fraction: float,
    colour: pygame.Color,
    alpha: float = 1.0,
    *,
    ghost: bool = False,
) -> None:
    """The living ninja about a point; a ``ghost`` is transparent and has no headband."""
    if not is_near(*at):
        return
    px, py = target.canvas.exact(*at)
    offset = (0.0, 0.0) if ghost else (px - round(px), py - round(py))
    sprite = ninja_sprite(
        target.canvas.scale,
        target.palette,
        animation.pose(fraction),
        animation.facing,
        animation.velocity,
        colour=colour,
        offset=offset,
        alpha=0.45 if ghost else alpha,
        banded=not ghost,
    )
    target.picture(sprite, *at)


def draw_ragdoll(target: DrawTarget, doll: Ragdoll, fraction: float, colour: pygame.Color) -> None:
    """The corpse: each limb at its stick."""
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
    target: DrawTarget,
    doll: Ragdoll,
    joints: list[Point],
    head: Point,
    sticks: range | tuple[int, ...],
    at: Point,
    colour: pygame.Color,
) -> None:
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
            figure.paint_trunk(s, shade, (hx, hy), places[SHOULDER], places[PELVIS])
            s.stroke(target.palette.band, *band_ends((hx, hy), places[SHOULDER]), 1.1)
        elif k in {0, 4}:
            s.limb(shade, *arm(a, b, doll.facing))
        else:
            s.limb(shade, *leg(a, b, doll.facing))
    target.picture(s.finish(), *at)
