"""Drawings of moving objects: bounce blocks, thwumps, guards, drones, rockets."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, degrees, radians, sin
from typing import NamedTuple

from ninja_game.sim import kinds, states
from ninja_game.sim.rules import AIM_FAR, AIM_NEAR, CHAINGUN_PREPARE, LASER_BEAM, LASER_PREPARE
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.ui.theme import Palette, mixed
from ninja_game.view.sprites.drawing import DrawTarget, drawn_within
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.sketch import Sketch, arc
from ninja_game.view.sprites.static_sprites import crosshair


@drawn_within(11)
def bounce_block(s: Sketch, p: Palette, awake: int) -> None:
    """A springy square, green like everything that springs."""
    s.framed_box(p.good, p.outline, -9.6, -9.6, 19.2, 19.2, 0.9)
    inner = mixed(p.light, p.bright, 0.3 + 0.3 * awake)
    s.framed_box(inner, p.outline, -6.2, -6.2, 12.4, 12.4, 0.8)
    for side in (-1, 1):
        s.path(p.good, [(-4, side * 4), (-2, side * 1.6), (0, side * 4), (2, side * 1.6), (4, side * 4)], 1.1)


@drawn_within(12)
def thwump(s: Sketch, p: Palette, mood: int, flicker: int) -> None:
    """A heavy square whose lower side is live. ``mood``: 0 at rest, 1 falling, 2 rising."""
    s.framed_box(mixed(p.dark, p.middle, 0.45), p.outline, -9, -9, 18, 18, 1.0)
    s.box(mixed(p.middle, p.light, 0.4), -7.6, -7.6, 15.2, 1.6)
    # The face: brows come down when it falls.
    lid = (2.0, 0.2, 2.6)[mood]
    for side in (-1, 1):
        s.box(p.bright, side * 3.9 - 2.2, -4.6, 4.4, 4.4)
        s.box(p.outline, side * 3.9 - 1.0, -2.6, 2.0, 2.4)
        upper, lower = (side * 1.2, -6.2 + 1.8 - 0.3 * mood), (side * 1.2, -4.6 + (2.2 - lid))
        s.polygon(mixed(p.dark, p.outline, 0.5), [(side * 6.8, -6.2), upper, lower, (side * 6.8, -4.8)])
    s.box(p.outline, -9, 5.2, 18, 3.8)
    s.box(p.electric, -8.3, 6.2, 16.6, 2.8)
    bump = 1.0 if flicker % 2 else -1.0
    s.path(p.spark, [(-8 + 4 * k, 7.6 + (0.9 * bump if k % 2 else -0.9 * bump)) for k in range(5)], 0.8)
    if p.danger_by_shape:
        for x in (-6, -2, 2, 6):
            s.polygon(p.electric, [(x - 2, 9), (x + 2, 9), (x, 11.4)])


@drawn_within(8)
def floor_guard(s: Sketch, p: Palette, active: int, flicker: int) -> None:
    """A dome that hugs the floor, 6 px below its point."""
    dome = [*arc(0, 0.2, 6, 180, 360), (6, 6), (-6, 6)]
    s.polygon(p.outline, dome)
    body = [*arc(0, 0.2, 5.1, 180, 360), (5.1, 5.3), (-5.1, 5.3)]
    s.polygon(p.electric if active else mixed(p.electric, p.dark, 0.45), body)
    s.polygon(
        mixed(p.electric, p.bright, 0.55 if active else 0.25),
        [*arc(0, 0.2, 4.2, 190, 270, 8), (-1.6, -2.2), (-3.2, -0.2)],
    )
    s.box(p.outline, -5.1, 1.2, 10.2, 2.2)
    s.box(p.bright if active else p.middle, -1.2 + (1.2 if flicker % 2 else -1.2) * active, 1.5, 2.6, 1.6)
    if p.danger_by_shape or active:
        for x in (-3.6, 0, 3.6):
            s.stroke(p.spark if active else p.outline, (x, -4.6 + abs(x) * 0.5), (x, -7.2 + abs(x) * 0.5), 0.9)


@drawn_within(-11, -17, 11, 11)
def drone(s: Sketch, p: Palette, weapon: int, seeker: int, chasing: int, heat: int) -> None:
    """A round shell without its eye. ``weapon``: 0 zap, 1 laser, 2 chaingun; ``heat`` 0…8: its charge."""
    if seeker:
        s.stroke(p.outline, (0, -8), (0, -12.6), 1.4)
        s.disc(p.outline, 0, -13.4, 2.1)
        s.disc(p.electric if chasing else p.middle, 0, -13.4, 1.3)
    s.disc(p.outline, 0, 0, 9.1)
    s.disc(p.drone, 0, 0, 8.2)
    if weapon == 0:
        rim = p.electric if chasing or not seeker else mixed(p.electric, p.drone, 0.25)
        for angle in range(0, 360, 45):
            s.polygon(
                rim, [*arc(0, 0, 7.7, angle + 8, angle + 37, 4), *reversed(arc(0, 0, 6.1, angle + 8, angle + 37, 4))]
            )
        if p.danger_by_shape or chasing:
            s.rays(p.electric, range(0, 360, 45), 8.4, 10, 1.0)
    elif weapon == 1:
        s.disc(p.weapon, 0, 0, 5.6 + 2.0 * heat / 8)
        s.disc(mixed(p.drone, p.weapon, 0.35), 0, 0, 4.6)
        s.disc(mixed(p.weapon, p.flame, heat / 8), 0, 0, 4.4 * heat / 8)
        s.rays(p.weapon, (45, 135, 225, 315), 6, 8, 1.2)
    elif weapon == 2:
        s.polygon(p.weapon, arc(0, 0, 7.6, 20, 160))
        s.polygon(p.weapon, arc(0, 0, 7.6, 200, 340))
        s.box(p.drone, -8, -2.6, 16, 5.2)
    else:
        s.ring(p.middle, 0, 0, 7.4, 1.2)


@drawn_within(-4, -5, 15, 5)
def barrel(s: Sketch, p: Palette, spin: int, heat: int) -> None:
    """The chaingun's barrels, along x."""
    s.box(p.outline, 1, -2.9, 11.4, 5.8)
    metal = mixed(p.middle, p.ember, heat / 8)
    for k in (-1, 0, 1):
        y, shade = k * 1.7, 0.35
        if k == 0:
            y, shade = 0.55 if spin % 2 else -0.55, 0.15
        s.box(mixed(metal, p.outline, shade), 1.6, y - 0.65, 10.2, 1.3)
    s.disc(p.outline, 0, 0, 3.6)


@drawn_within(4)
def eye(s: Sketch, p: Palette, mood: int) -> None:
    """A drone's eye, its pupil looking to the right. ``mood``: 0 calm, 1 hunting, 2 armed."""
    s.disc(p.outline, 0, 0, 3.0)
    s.disc((p.bright, p.spark, p.warning)[mood], 0, 0, 2.3)
    s.disc((p.outline, p.electric, p.weapon)[mood], 0.8, 0, 1.15)


@drawn_within(9)
def rocket(s: Sketch, p: Palette, flame_phase: int) -> None:
    """A dart with its tip at the point, flying to the right, and the root of its flame."""
    length = (3.2, 4.4, 3.7, 5.0)[flame_phase % 4]
    s.polygon(p.ember, [(-6.2, -1.5), (-6.2 - length, 0), (-6.2, 1.5)])
    s.polygon(p.flame, [(-6.2, -0.9), (-6.2 - length * 0.6, 0), (-6.2, 0.9)])
    s.polygon(
        p.outline,
        [(0.4, 0), (-2.4, -2.0), (-5.2, -2.0), (-7.4, -3.6), (-6.6, 0), (-7.4, 3.6), (-5.2, 2.0), (-2.4, 2.0)],
    )
    s.polygon(p.bright, [(-0.4, 0), (-2.6, -1.2), (-5.6, -1.2), (-5.6, 1.2), (-2.6, 1.2)])
    s.box(p.weapon, -4.4, -1.2, 1.2, 2.4)


@drawn_within(-10, -4, 3, 4)
def flame(s: Sketch, p: Palette, step: int) -> None:
    """A puff of the flame behind a rocket; ``step`` 0 hot … 7 cold."""
    colours = (p.spark, p.flame, p.flame, p.ember, p.ember, p.smoke, p.smoke, p.smoke)
    radius = 2.4 - 0.24 * step
    s.disc(colours[step], 0, 0, radius)


@drawn_within(11)
def impact_burst(s: Sketch, p: Palette, step: int) -> None:
    """The burning end of a laser: a flickering star that grows over the shot."""
    reach = 2.6 + 6.4 * step / 8
    for k in range(9):
        a = radians(40 * k + 17 * step)
        far = reach * (1.0 if k % 2 else 0.62)
        s.stroke(p.laser, (0, 0), (far * cos(a), far * sin(a)), 1.3, 0.3)
    s.disc(p.flame, 0, 0, reach * 0.3)
    s.disc(p.bright, 0, 0, reach * 0.16)


_EYE_OUT = 4.5  # distance of a drone's eye from the centre, px
_TURN_STEP = 15  # barrels and eyes turn in steps of that many degrees
_COOL_FRAMES = 60


class MovingObject(NamedTuple):
    """A moving object: its slot, its drawn place (px), and the moment, ``fraction`` of a tick after the last."""

    o: Object
    slot: int
    x: float
    y: float
    animation: ObjectAnimation
    fraction: float

    def step(self, frames: float) -> int:
        """Progress of an animation of that many frames since the last change, 0…8."""
        return self.animation.step(self.slot, self.fraction, frames)


def draw_moving(target: DrawTarget, world: World, animation: ObjectAnimation, fraction: float) -> None:
    """All moving objects, beams first so that they come out of their drones."""
    shown = [
        MovingObject(world.objects[s], s, *animation.place(s, fraction), animation, fraction)
        for s in animation.moving_slots
    ]
    for m in shown:
        if m.o.kind == kinds.DRONE and m.o.weapon == states.WEAPON_LASER:
            _beam(target, m)
    for m in shown:
        # The place of a rocket that met its target point exactly is not a number.
        if m.x == m.x and m.y == m.y:
            PAINTERS[m.o.kind](target, m)


PULSE_TICKS = 60  # between two rings that leave a switch
PULSE_FROM = 13.0  # radius of a ring at first, px
PULSE_REACH = 12.0  # growth of a ring in half of PULSE_TICKS, px


def draw_pulses(target: DrawTarget, world: World, animation: ObjectAnimation, fraction: float) -> None:
    """Rings that leave the switches of exits until they are touched."""
    share = 2 * ((animation.tick + fraction) % PULSE_TICKS) / PULSE_TICKS
    for slot in animation.switch_slots if share < 1 else ():
        o = world.objects[slot]
        if not world.objects[o.partner].is_open:
            colour = mixed(target.palette.exit, target.palette.background, share)
            target.disc(colour, o.x, o.y, PULSE_FROM + PULSE_REACH * share, 1.6)


def _thwump(target: DrawTarget, m: MovingObject) -> None:
    o = m.o
    mood = 0 if o.routine == states.THWUMP_REST else 1 if o.sign > 0 else 2
    # Its face looks in the direction of its fall: drawn for a fall downwards.
    turn = round(degrees(atan2(-o.face_x, o.face_y))) if o.face_x or o.face_y else 0
    target.sprite(thwump(mood, m.animation.tick // 3 % 2).turned(turn), m.x, m.y)


def _guard(target: DrawTarget, m: MovingObject) -> None:
    active = 1 if m.o.routine and m.o.updating else 0
    target.sprite(floor_guard(active, m.animation.tick // 2 % 2 if active else 0), m.x, m.y)


def _crosshair(target: DrawTarget, m: MovingObject) -> None:
    o = m.o
    if not o.updating:
        return
    if o.routine != states.TURRET_TARGET:
        look = 3
    else:
        look = 0 if o.aim_factor <= AIM_FAR else 1 if o.aim_factor < AIM_NEAR else 2
    target.sprite(crosshair(look), m.x, m.y)


def _rocket(target: DrawTarget, m: MovingObject) -> None:
    trail = m.animation.trails.get(m.slot, [])
    for k, (tx, ty) in enumerate(trail[:-1]):
        step = min(7, len(trail) - 2 - k)
        target.sprite(flame(step).faded(max(2, 7 - step)), tx, ty)
    if m.o.routine == states.LAUNCHER_FLIGHT:
        turn = round(degrees(atan2(m.o.heading_y, m.o.heading_x)) / 6) * 6
        target.sprite(rocket(m.animation.tick % 4).turned(turn), m.x, m.y)


def _drone(target: DrawTarget, m: MovingObject) -> None:
    o = m.o
    seeker = 1 if o.seeker and o.weapon == states.WEAPON_ZAP else 0
    heat = _heat(m)
    target.sprite(drone(o.weapon, seeker, o.chasing, heat if o.weapon == states.WEAPON_LASER else 0), m.x, m.y)
    angle = m.animation.eyes[m.slot]
    turn = round(degrees(angle) / _TURN_STEP) * _TURN_STEP
    if o.weapon == states.WEAPON_CHAINGUN:
        spin = m.animation.tick // 2 % 2 if o.routine in {states.DRONE_PRE_FIRE, states.DRONE_FIRING} else 0
        target.sprite(barrel(spin, heat).turned(turn), m.x, m.y)
    mood = 1 if o.chasing else 2 if o.routine != states.DRONE_MOVE else 0
    target.sprite(eye(mood).turned(turn), m.x + _EYE_OUT * cos(angle), m.y + _EYE_OUT * sin(angle))


def _heat(m: MovingObject) -> int:
    o = m.o
    if o.routine == states.DRONE_PRE_FIRE:
        return m.step(3 * (CHAINGUN_PREPARE if o.weapon == states.WEAPON_CHAINGUN else LASER_PREPARE))
    if o.routine == states.DRONE_FIRING:
        return 8
    return 8 - m.step(_COOL_FRAMES) if o.routine == states.DRONE_POST_FIRE else 0


def _beam(target: DrawTarget, m: MovingObject) -> None:
    o, palette, tick = m.o, target.palette, m.animation.tick
    if o.routine == states.DRONE_PRE_FIRE:
        target.line(palette.warning, o.x, o.y, o.end_x, o.end_y)
    elif o.routine == states.DRONE_FIRING:
        target.line(palette.laser, o.x, o.y, o.end_x, o.end_y, (3.0, 2.4, 3.4, 2.7)[tick % 4])
        target.line(palette.flame, o.x, o.y, o.end_x, o.end_y, 0.8)
        step = min(8, int(o.timer / LASER_BEAM * 9))
        target.sprite(impact_burst(step).turned(tick % 5 * 15), o.end_x, o.end_y)


PAINTERS: dict[int, Callable[[DrawTarget, MovingObject], None]] = {
    kinds.BOUNCE_BLOCK: lambda target, m: target.sprite(bounce_block(m.o.updating), m.x, m.y),
    kinds.THWUMP: _thwump,
    kinds.FLOOR_GUARD: _guard,
    kinds.TURRET: _crosshair,
    kinds.LAUNCHER: _rocket,
    kinds.DRONE: _drone,
}
"""The function that draws each kind."""
