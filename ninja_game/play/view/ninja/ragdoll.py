"""The corpse: Verlet particles and sticks, stepped once a tick (presentation.md §4). It leaves the world alone."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import NamedTuple

from ninja_game.play.ui.canvas import Point
from ninja_game.play.view.ninja.box_contact import Box, tile_pushes
from ninja_game.play.view.ninja.corpse_contacts import thing_pushes
from ninja_game.play.view.ninja.pose import Pose
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.states import EXPLOSIVE, FALL

GRAVITY = 0.15
_LOSS_NORMAL, _LOSS_TANGENT = 1.4, 0.15
_FASTEST = 22.0
"""px/tick: faster limbs would pass through walls."""

PELVIS, SHOULDER, NEAR_HAND, FAR_HAND, NEAR_FOOT, FAR_FOOT = range(6)
_HALVES = (2.5, 2.5, 2.0, 2.0, 3.0, 3.0)
_DRAGS = (0.99, 0.995, 0.995, 0.99, 0.99, 0.995)


class Stick(NamedTuple):
    """Two particles between ``shortest`` and ``longest`` px apart; ``share``: the first's part of a correction."""

    first: int
    second: int
    longest: float
    shortest: float
    share: float


STICKS = (
    Stick(SHOULDER, FAR_HAND, 8.0, 4.8, 0.26),
    Stick(PELVIS, FAR_FOOT, 12.0, 7.2, 0.37),
    Stick(PELVIS, SHOULDER, 6.0, 4.8, 0.4),
    Stick(PELVIS, NEAR_FOOT, 12.0, 7.2, 0.32),
    Stick(SHOULDER, NEAR_HAND, 8.0, 4.8, 0.2),
)
TRUNK = 2


class VerletParticle(Box):
    """A joint of the corpse: a box with an old place (its velocity is the difference) and a drag."""

    __slots__ = ("drag", "ox", "oy", "sx", "sy")

    def __init__(self, x: float, y: float, vx: float, vy: float, half: float, drag: float) -> None:
        super().__init__(x, y, half)
        self.ox, self.oy = x - vx, y - vy
        self.sx, self.sy = x, y
        self.drag = drag


Hit = Callable[[float, float, float, float], None]
"""(x, y, speed into a surface, speed along it): the corpse touched something there."""


class Ragdoll:
    """A corpse. ``hit``: told of every touch, for sound, dust and blood."""

    def __init__(self, pose: Pose, before: Pose, velocity: Point, facing: int, rng: Random, hit: Hit) -> None:
        self.facing = facing
        self.rng = rng
        self.hit = hit
        joints = (PELVIS, pose.pelvis, before.pelvis), (SHOULDER, pose.shoulder, before.shoulder)
        limbs = (
            (NEAR_HAND, pose.near_hand, before.near_hand), (FAR_HAND, pose.far_hand, before.far_hand),
            (NEAR_FOOT, pose.near_foot, before.near_foot), (FAR_FOOT, pose.far_foot, before.far_foot),
        )  # fmt: skip
        self.particles = [
            VerletParticle(x, y, (x - bx) * 0.5 + velocity[0], (y - by) * 0.5 + velocity[1], _HALVES[k], _DRAGS[k])
            for k, (x, y), (bx, by) in (*joints, *limbs)
        ]
        self.sticks = list(STICKS)
        self.dismembered = False

    # --- the moment of death ---

    def shove(self, cause: int, impulse: Point, hit_y: float, centre_y: float, *, whole: bool = False) -> None:
        """The blow: everything is thrown, most of all the end that was hit. Falls have none.

        ``whole``: it stays in one piece, whatever killed it (reduced gore).
        """
        if cause != FALL:
            h = (hit_y - centre_y) / 10
            u = min(1.0, abs(h))
            near, far = 0.4 * (1 - u) + 0.8 * u, 0.4 * (1 - u) + 0.2 * u
            upper, lower = (near, far) if h < 0 else (far, near)
            weights = (0.8 * (1 - u) + 0.4 * u, upper, upper, upper, lower, lower)
            for k, (particle, weight) in enumerate(zip(self.particles, weights, strict=True)):
                share = weight * (self.rng.uniform(0.8, 1) if k > SHOULDER else 1)
                particle.ox -= impulse[0] * (share + self.rng.random())
                particle.oy -= impulse[1] * (share + self.rng.random())
        if cause == EXPLOSIVE and not whole:
            self.dismember()

    def dismember(self) -> None:
        """Limbs come off: each gets a particle of its own where it was joined."""
        if self.dismembered:
            return
        self.dismembered = True
        sticks = []
        for k, stick in enumerate(self.sticks):
            if k == TRUNK:
                sticks.append(stick)
                continue
            joint = self.particles[stick.first]
            vx, vy = self.rng.uniform(-4, 4), -self.rng.uniform(4, 8)
            for end in (stick.second,):
                self.particles[end].ox -= vx
                self.particles[end].oy -= vy
            loose = VerletParticle(joint.x, joint.y, joint.x - joint.ox + vx, joint.y - joint.oy + vy, 2.0, 0.99)
            self.particles.append(loose)
            sticks.append(stick._replace(first=len(self.particles) - 1, share=0.5))
        self.sticks = sticks

    # --- every tick ---

    def step(self, level: TileMap, world: World) -> None:
        """One tick: move, pull together, push out of what is solid."""
        for p in self.particles:
            p.sx, p.sy = p.x, p.y
            vx, vy = p.drag * (p.x - p.ox), p.drag * (p.y - p.oy) + GRAVITY
            speed = (vx * vx + vy * vy) ** 0.5
            if speed > _FASTEST:
                vx, vy = vx * _FASTEST / speed, vy * _FASTEST / speed
            p.ox, p.oy = p.x, p.y
            p.x += vx
            p.y += vy
        for stick in self.sticks:
            self._pull(stick)
        for p in self.particles:
            self._collide(level, world, p)

    def _pull(self, stick: Stick) -> None:
        a, b = self.particles[stick.first], self.particles[stick.second]
        dx, dy = b.x - a.x, b.y - a.y
        length = (dx * dx + dy * dy) ** 0.5
        wanted = min(stick.longest, max(stick.shortest, length))
        if length > 1e-6 and wanted != length:
            pull = (length - wanted) / length
            a.x += dx * pull * stick.share
            a.y += dy * pull * stick.share
            b.x -= dx * pull * (1 - stick.share)
            b.y -= dy * pull * (1 - stick.share)

    def _collide(self, level: TileMap, world: World, p: VerletParticle) -> None:
        """At the end of the way, and for a fast particle at places before it."""
        vx, vy = p.x - p.sx, p.y - p.sy
        square = vx * vx + vy * vy
        stops = (1.0,) if square < 4 else (0.5, 1.0) if square < 36 else tuple(k / 6 for k in range(1, 7))
        for share in stops:
            p.x, p.y = p.sx + vx * share, p.sy + vy * share
            touched = False
            for _, _, nx, ny in tile_pushes(level, world, p):
                self._bounce(p, nx, ny)
                touched = True
            for nx, ny, kick in thing_pushes(world, p):
                self._bounce(p, nx, ny)
                p.ox -= nx * kick
                p.oy -= ny * kick
                touched = True
            if touched:
                break

    def _bounce(self, p: VerletParticle, nx: float, ny: float) -> None:
        """Lose part of the velocity into and along a surface."""
        vx, vy = p.x - p.ox, p.y - p.oy
        # The push itself is not a motion: the speed is that of before it.
        ux, uy = p.sx - p.ox, p.sy - p.oy
        into = ux * nx + uy * ny
        along = -ny * ux + nx * uy
        if into < 0:
            self.hit(p.x, p.y, -into, along)
        new_into = max(0.0, into) if into >= 0 else into - _LOSS_NORMAL * into
        new_along = along * (1 - _LOSS_TANGENT)
        vx, vy = nx * new_into - ny * new_along, ny * new_into + nx * new_along
        p.ox, p.oy = p.x - vx, p.y - vy
        p.sx, p.sy = p.x, p.y

    # --- drawing ---

    def joint(self, k: int, fraction: float) -> Point:
        """Where a particle is, between its last two places."""
        p = self.particles[k]
        return p.sx + (p.x - p.sx) * fraction, p.sy + (p.y - p.sy) * fraction

    def head(self, fraction: float) -> Point:
        """The head goes on where the trunk ends."""
        (px, py), (sx, sy) = self.joint(PELVIS, fraction), self.joint(SHOULDER, fraction)
        dx, dy = sx - px, sy - py
        length = (dx * dx + dy * dy) ** 0.5 or 1.0
        return sx + dx / length * 3.4, sy + dy / length * 3.4
