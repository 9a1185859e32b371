"""The corpse: Verlet particles and sticks, stepped once a tick (presentation.md §4). It leaves the world alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random
from typing import NamedTuple

from ninja_game.sim import kinds
from ninja_game.sim.collision import tiles
from ninja_game.sim.grid import cell_at
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.sim.rules import DOWN, LEFT, OFF, ONE_WAY_HALF, PAD_RADIUS, RIGHT, SOLID, STRIDE, UP
from ninja_game.sim.states import EXPLOSIVE, FALL, WEAPON_ZAP
from ninja_game.ui.canvas import Point
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


class Box:
    """A box with a centre that moves when it is pushed, px."""

    __slots__ = ("half", "x", "y")

    def __init__(self, x: float, y: float, half: float) -> None:
        self.x = x
        self.y = y
        self.half = half


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
            joint, end = self.particles[stick.first], self.particles[stick.second]
            vx, vy = self.rng.uniform(-4, 4), -self.rng.uniform(4, 8)
            end.ox -= vx
            end.oy -= vy
            loose = VerletParticle(joint.x, joint.y, joint.x - joint.ox + vx, joint.y - joint.oy + vy, 2.0, 0.99)
            self.particles.append(loose)
            sticks.append(stick._replace(first=len(self.particles) - 1, share=0.5))
        self.sticks = sticks

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
            for nx, ny, kick in object_pushes(world, p):
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


def object_pushes(world: World, box: Box) -> Iterator[tuple[float, float, float]]:
    """Normals of the objects that a box touches, and how hard (px/tick) they kick it; it is pushed out as they come."""
    for slot in range(1, world.id_count + 1):
        o = world.objects[slot]
        if o.kind in KICKS and abs(o.x - box.x) < 26 and abs(o.y - box.y) < 26:
            if o.kind == kinds.LAUNCH_PAD:
                yield from _pad(o, box)
            elif o.kind == kinds.ONE_WAY:
                yield from _one_way(o, box)
            elif o.kind != kinds.DRONE or o.weapon == WEAPON_ZAP:
                yield from _square(o, box)


def _square(o: Object, box: Box) -> Iterator[tuple[float, float, float]]:
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
    # Of a thwump only the side on which it falls is live.
    yield nx, ny, KICKS[o.kind] if o.kind != kinds.THWUMP or (nx, ny) == (o.face_x, o.face_y) else 0.0


def _pad(o: Object, box: Box) -> Iterator[tuple[float, float, float]]:
    dx, dy = o.x - box.x, o.y - box.y
    if dx * dx + dy * dy < (PAD_RADIUS + box.half) ** 2:
        length = (o.face_x * o.face_x + o.face_y * o.face_y) ** 0.5 or 1.0
        yield o.face_x / length, o.face_y / length, KICKS[o.kind]


def _one_way(o: Object, box: Box) -> Iterator[tuple[float, float, float]]:
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
"""How hard (px/tick) each kind that the corpse can touch kicks it."""


Push = tuple[float, float, float, float]  # by how much a box is pushed (px), and the surface's normal


def tile_pushes(level: TileMap, world: World, box: Box) -> Iterator[Push]:
    """Push a box out of tiles and closed doors; each push is done when it is given."""
    cell = cell_at(box.x, box.y)
    if not cell:
        return
    cx, cy, half = tiles.CENTRE_X[cell], tiles.CENTRE_Y[cell], box.half
    if level.tiles[cell]:
        dx, dy = box.x - cx, box.y - cy
        ox, oy = 12 + half - abs(dx), 12 + half - abs(dy)
        a, b = (ox if dx >= 0 else -ox, 0.0) if ox < oy else (0.0, oy if dy >= 0 else -oy)
        yield from _narrow(level, box, cell, a, b)
    free = True
    dy = box.y - cy
    oy = abs(dy) + half - 12
    if oy > 0:
        side = UP if dy < 0 else DOWN
        sign = 1.0 if dy < 0 else -1.0
        for push in _side(level, world, box, cell, side, 0.0, oy * sign):
            free = False
            yield push
    dx = box.x - cx
    ox = abs(dx) + half - 12
    if ox > 0:
        side = LEFT if dx < 0 else RIGHT
        sign = 1.0 if dx < 0 else -1.0
        for push in _side(level, world, box, cell, side, ox * sign, 0.0):
            free = False
            yield push
    if free and ox > 0 and oy > 0:
        beside = cell + (1 if dx > 0 else -1)
        corner = beside + (STRIDE if dy > 0 else -STRIDE)
        a, b = (-ox if dx > 0 else ox, 0.0) if ox < oy else (0.0, -oy if dy > 0 else oy)
        yield from _narrow(level, box, corner, a, b)


def _side(level: TileMap, world: World, box: Box, cell: int, side: int, a: float, b: float) -> Iterator[Push]:
    """Over one edge of the own cell: a solid edge pushes back, an interesting one asks the tile behind it."""
    edge = world.edges[4 * cell + side]
    if edge == SOLID:
        yield _push(box, a, b, (a > 0) - (a < 0), (b > 0) - (b < 0))
    elif edge != OFF:
        yield from _narrow(level, box, cell + (1, STRIDE, -1, -STRIDE)[side], a, b)


def _push(box: Box, a: float, b: float, nx: float, ny: float) -> Push:
    box.x += a
    box.y += b
    return a, b, nx, ny


def _narrow(level: TileMap, box: Box, cell: int, a: float, b: float) -> Iterator[Push]:
    """One tile: out along its surface, or along the axis (a, b) if that is shorter."""
    tile = level.tiles[cell]
    shape = tiles.SHAPE[tile]
    if shape in {tiles.EMPTY, tiles.UNDEFINED}:
        return
    m = (a * a + b * b) ** 0.5
    axis = a, b, (a > 0) - (a < 0), (b > 0) - (b < 0)
    sx, sy = tiles.SIGN_X[tile], tiles.SIGN_Y[tile]
    kx, ky = box.x - sx * box.half, box.y - sy * box.half
    if shape == tiles.FULL:
        yield _push(box, *axis)
        return
    if shape in {tiles.CONCAVE, tiles.CONVEX}:
        out = _round_push(shape, kx, ky, tiles.CENTRE_X[cell], tiles.CENTRE_Y[cell], sx, sy)
    else:
        nx, ny = (sx, sy) if shape == tiles.HALF_TILE else (tiles.NORMAL_X[tile], tiles.NORMAL_Y[tile])
        dx, dy = kx - tiles.CENTRE_X[cell] - tiles.ANCHOR_X[tile], ky - tiles.CENTRE_Y[cell] - tiles.ANCHOR_Y[tile]
        depth = dx * nx + dy * ny
        out = (-depth, nx, ny) if depth < 0 else None
    if out is not None:
        depth, nx, ny = out
        yield _push(box, *(axis if m < depth else (nx * depth, ny * depth, nx, ny)))


def _round_push(
    shape: int, kx: float, ky: float, cx: float, cy: float, sx: float, sy: float
) -> tuple[float, float, float] | None:
    """Depth and normal in a quarter arc; a depth without end where only the axis will do."""
    sign = 1.0 if shape == tiles.CONCAVE else -1.0
    dx, dy = sign * (cx + sign * sx * 12 - kx), sign * (cy + sign * sy * 12 - ky)
    if shape == tiles.CONVEX and (sx * dx < 0 or sy * dy < 0):
        return float("inf"), 0.0, 0.0
    length = (dx * dx + dy * dy) ** 0.5
    depth = sign * (length - 24)
    return (depth, dx / length, dy / length) if depth > 0 and length > 0 else None
