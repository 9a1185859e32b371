"""The corpse: Verlet particles and sticks, stepped once per tick (presentation.md §4). It never changes the world."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from math import cos, hypot, pi, sin
from random import Random
from typing import NamedTuple

from ninja_game.sim import kinds
from ninja_game.sim.collision.rays import cast_ray, solid_at
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import Point, cell_at
from ninja_game.sim.rules import DOWN, HALF, LEFT, ONE_WAY_HALF, PAD_RADIUS, RIGHT, SOLID, STRIDE, UP
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import EXPLOSIVE, FALL, WEAPON_ZAP
from ninja_game.view.ninja.figure import Pose

GRAVITY = 0.15
_LOSS_NORMAL, _LOSS_TANGENT = 1.4, 0.15
_FASTEST = 22.0  # px/tick: faster limbs would pass through walls

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


class VerletParticle:
    """A joint of the corpse: a box with a centre, px, its earlier place (the difference is the velocity) and a drag."""

    __slots__ = ("drag", "half", "ox", "oy", "sx", "sy", "x", "y")

    def __init__(self, x: float, y: float, vx: float, vy: float, half: float, drag: float) -> None:
        self.x, self.y, self.half = x, y, half
        self.ox, self.oy = x - vx, y - vy
        self.sx, self.sy = x, y
        self.drag = drag


Hit = Callable[[float, float, float, float], None]
"""(x, y, speed into a surface, speed along it): the corpse touched a surface there."""


class Ragdoll:
    """A corpse. ``hit``: called at every touch, for sound, dust and blood."""

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

    def shove(self, cause: int, impulse: Point, hit_y: float, centre_y: float, *, whole: bool = False) -> None:
        """The impulse of the death: on all particles, most on those near the hit. Falls have none.

        ``whole``: it stays in one piece after any death (reduced gore).
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
        """Limbs come off: each gets its own particle at its joint."""
        if self.dismembered:
            return
        self.dismembered = True
        sticks = []
        for k, stick in enumerate(self.sticks):
            if k == TRUNK:
                sticks.append(stick)
                continue
            joint, end = self.particles[stick.first], self.particles[stick.second]
            vx, vy = self.rng.uniform(-4, 4), -self.rng.uniform(4, 8)
            end.ox -= vx
            end.oy -= vy
            loose = VerletParticle(joint.x, joint.y, joint.x - joint.ox + vx, joint.y - joint.oy + vy, 2.0, 0.99)
            self.particles.append(loose)
            sticks.append(stick._replace(first=len(self.particles) - 1, share=0.5))
        self.sticks = sticks

    def step(self, tiles: TileMap, world: World) -> None:
        """One tick: move, pull together, push out of solid shapes."""
        for particle in self.particles:
            particle.sx, particle.sy = particle.x, particle.y
            vx, vy = particle.drag * (particle.x - particle.ox), particle.drag * (particle.y - particle.oy) + GRAVITY
            speed = (vx * vx + vy * vy) ** 0.5
            if speed > _FASTEST:
                vx, vy = vx * _FASTEST / speed, vy * _FASTEST / speed
            particle.ox, particle.oy = particle.x, particle.y
            particle.x += vx
            particle.y += vy
        for stick in self.sticks:
            self._pull(stick)
        for particle in self.particles:
            self._collide(tiles, world, particle)

    def _pull(self, stick: Stick) -> None:
        a, b = self.particles[stick.first], self.particles[stick.second]
        dx, dy = b.x - a.x, b.y - a.y
        length = (dx * dx + dy * dy) ** 0.5
        target = min(stick.longest, max(stick.shortest, length))
        if length > 1e-6 and target != length:
            pull = (length - target) / length
            a.x += dx * pull * stick.share
            a.y += dy * pull * stick.share
            b.x -= dx * pull * (1 - stick.share)
            b.y -= dy * pull * (1 - stick.share)

    def _collide(self, tiles: TileMap, world: World, particle: VerletParticle) -> None:
        """At the end of the path, and for a fast particle at places before it."""
        vx, vy = particle.x - particle.sx, particle.y - particle.sy
        square = vx * vx + vy * vy
        stops = (1.0,) if square < 4 else (0.5, 1.0) if square < 36 else tuple(k / 6 for k in range(1, 7))
        for share in stops:
            particle.x, particle.y = particle.sx + vx * share, particle.sy + vy * share
            if solid_at(tiles, particle.x, particle.y):
                particle.x, particle.y = particle.sx, particle.sy
            touched = False
            for nx, ny, kick in (*tile_push(tiles, world, particle), *object_pushes(world, particle)):
                vx, vy = self._bounce(particle, vx, vy, nx, ny)
                vx, vy = vx + nx * kick, vy + ny * kick
                touched = True
            if touched:
                particle.ox, particle.oy = particle.x - vx, particle.y - vy
                particle.sx, particle.sy = particle.x, particle.y
                break

    def _bounce(self, particle: VerletParticle, vx: float, vy: float, nx: float, ny: float) -> Point:
        """The velocity into and along a surface after a bounce."""
        into, along = vx * nx + vy * ny, -ny * vx + nx * vy
        if into >= 0:
            return vx, vy
        self.hit(particle.x, particle.y, -into, along)
        into, along = into * (1 - _LOSS_NORMAL), along * (1 - _LOSS_TANGENT)
        return nx * into - ny * along, ny * into + nx * along

    def joint(self, k: int, fraction: float) -> Point:
        """The place of a particle, between its last two places."""
        particle = self.particles[k]
        return particle.sx + (particle.x - particle.sx) * fraction, particle.sy + (particle.y - particle.sy) * fraction

    def head(self, fraction: float) -> Point:
        """The head continues the trunk."""
        (px, py), (sx, sy) = self.joint(PELVIS, fraction), self.joint(SHOULDER, fraction)
        dx, dy = sx - px, sy - py
        length = (dx * dx + dy * dy) ** 0.5 or 1.0
        return sx + dx / length * 3.4, sy + dy / length * 3.4


def object_pushes(world: World, box: VerletParticle) -> Iterator[tuple[float, float, float]]:
    """Normals of the objects that a box touches, and the speed (px/tick) of their kick; each pushes it out at once."""
    for slot in range(1, world.id_count + 1):
        o = world.objects[slot]
        if o.kind in KICKS and abs(o.x - box.x) < 26 and abs(o.y - box.y) < 26:
            if o.kind == kinds.LAUNCH_PAD:
                yield from _pad(o, box)
            elif o.kind == kinds.ONE_WAY:
                yield from _one_way(o, box)
            elif o.kind != kinds.DRONE or o.weapon == WEAPON_ZAP:
                yield from _square(o, box)


def _square(o: Object, box: VerletParticle) -> Iterator[tuple[float, float, float]]:
    """Push the box out of an object; gives the direction, a unit vector, and the kick along it, as ``_pad`` does."""
    half = kinds.KIND_OF[o.kind].box or kinds.KIND_OF[o.kind].disc or 0.0
    dx, dy = box.x - o.x, box.y - o.y
    ox, oy = half + box.half - abs(dx), half + box.half - abs(dy)
    if ox <= 0 or oy <= 0:
        return
    if oy < ox:
        nx, ny = 0.0, -1.0 if dy < 0 else 1.0
        box.y += ny * oy
    else:
        nx, ny = -1.0 if dx < 0 else 1.0, 0.0
        box.x += nx * ox
    # Only the side of a thwump's fall is live.
    yield nx, ny, KICKS[o.kind] if o.kind != kinds.THWUMP or (nx, ny) == (o.face_x, o.face_y) else 0.0


def _pad(o: Object, box: VerletParticle) -> Iterator[tuple[float, float, float]]:
    dx, dy = o.x - box.x, o.y - box.y
    if dx * dx + dy * dy < (PAD_RADIUS + box.half) ** 2:
        length = (o.face_x * o.face_x + o.face_y * o.face_y) ** 0.5 or 1.0
        yield o.face_x / length, o.face_y / length, KICKS[o.kind]


def _one_way(o: Object, box: VerletParticle) -> Iterator[tuple[float, float, float]]:
    """Only from its face, and only near it."""
    dx, dy = box.x - o.x, box.y - o.y
    across = abs(dy) if o.face_x else abs(dx)
    depth = ONE_WAY_HALF + box.half - (dx * o.face_x + dy * o.face_y)
    if across < ONE_WAY_HALF + box.half and 0 < depth < 6:
        box.x += depth * o.face_x
        box.y += depth * o.face_y
        yield o.face_x, o.face_y, 0.0


KICKS = {
    kinds.BOUNCE_BLOCK: 0.0, kinds.THWUMP: 4.0, kinds.LAUNCH_PAD: 6.0, kinds.ONE_WAY: 0.0, kinds.FLOOR_GUARD: 6.0,
    kinds.DRONE: 5.0,
}  # fmt: skip
"""Speed (px/tick) of the kick by each kind that the corpse can touch."""


_BEHIND = {RIGHT: 1, DOWN: STRIDE, LEFT: -1, UP: -STRIDE}
_WAYS = tuple((cos(k * pi / 8), sin(k * pi / 8)) for k in range(16))


def tile_push(tiles: TileMap, world: World, box: VerletParticle) -> list[tuple[float, float, float]]:
    """As ``object_pushes``, for tiles and closed doors, which a box touches as a disc."""
    x, y, half = box.x, box.y, box.half
    cell = cell_at(x, y)
    if not tiles.ids[cell] and max(abs(x - CENTRE_X[cell]), abs(y - CENTRE_Y[cell])) < HALF - half:
        return []
    if solid_at(tiles, x, y):
        # No ray leads out: a hand was in the wall when the ninja died, or an object has pushed a limb there.
        for reach, (wx, wy) in product(range(1, 25), _WAYS):
            box.x, box.y = x + reach * wx, y + reach * wy
            if cell_at(box.x, box.y) and not solid_at(tiles, box.x, box.y):
                return [(wx, wy, 0.0)]
        box.x, box.y = x, y
        return []
    shut = {cell + step for side, step in _BEHIND.items() if world.edges[4 * cell + side] == SOLID}
    points = [(x + wx * half, y + wy * half, wx, wy) for wx, wy in _WAYS]
    touched = [way for px, py, *way in points if solid_at(tiles, px, py) or cell_at(px, py) in shut]
    nx, ny = (-sum(axis) for axis in zip(*touched, strict=True)) if touched else (0.0, 0.0)
    length = hypot(nx, ny)
    if length < 1e-6:
        return []
    hits = [cast_ray(tiles, world, x, y, wx, wy) for wx, wy in touched]
    depth = max(0.0, half - min(hypot(hit_x - x, hit_y - y) for _, hit_x, hit_y in hits))
    box.x += depth * nx / length
    box.y += depth * ny / length
    return [(nx / length, ny / length, 0.0)]
