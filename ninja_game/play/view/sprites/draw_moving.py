"""Drawing of the objects that move, between two ticks."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, degrees, sin
from typing import NamedTuple

from ninja_game.play.view.sprites import moving_sprites as drawings
from ninja_game.play.view.sprites.draw_target import DrawTarget
from ninja_game.play.view.sprites.object_animation import ObjectAnimation
from ninja_game.play.view.sprites.static_sprites import crosshair
from ninja_game.sim import kinds, states
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World

_EYE_OUT = 4.5
"""How far a drone's eye is off the centre, px."""
_TURN_STEP = 15
"""Barrels and eyes turn in steps of so many degrees."""
_HEAT_FRAMES = {states.WEAPON_LASER: 90, states.WEAPON_CHAINGUN: 105}
_COOL_FRAMES = 60


class Moving(NamedTuple):
    """An object that moves: its slot, where it is drawn (px), and the moment, ``fraction`` of a tick after the last."""

    o: Object
    slot: int
    x: float
    y: float
    animation: ObjectAnimation
    fraction: float

    def step(self, frames: float) -> int:
        """How far an animation of so many frames has come since the last change, 0…8."""
        return self.animation.step(self.slot, self.fraction, frames)


def draw_moving(target: DrawTarget, world: World, animation: ObjectAnimation, fraction: float) -> None:
    """All objects that move, beams first so that they come out of their drones."""
    shown = [Moving(world.objects[s], s, *animation.place(s, fraction), animation, fraction)
             for s in animation.moving_slots]  # fmt: skip
    for m in shown:
        if m.o.kind == kinds.DRONE and m.o.weapon == states.WEAPON_LASER:
            _beam(target, m)
    for m in shown:
        # A rocket that met its target point exactly is nowhere (not a number).
        if m.x == m.x and m.y == m.y:
            PAINTERS[m.o.kind](target, m)


def _block(target: DrawTarget, m: Moving) -> None:
    target.sprite(drawings.bounce_block(m.o.updating), m.x, m.y)


def _thwump(target: DrawTarget, m: Moving) -> None:
    o = m.o
    mood = 0 if o.routine == states.THWUMP_REST else 1 if o.sign > 0 else 2
    # Its face looks where it falls: drawn for a fall downwards.
    turn = round(degrees(atan2(-o.face_x, o.face_y))) if o.face_x or o.face_y else 0
    target.sprite(drawings.thwump(mood, m.animation.tick // 3 % 2).turned(turn), m.x, m.y)


def _guard(target: DrawTarget, m: Moving) -> None:
    active = 1 if m.o.routine and m.o.updating else 0
    target.sprite(drawings.floor_guard(active, m.animation.tick // 2 % 2 if active else 0), m.x, m.y)


def _crosshair(target: DrawTarget, m: Moving) -> None:
    o = m.o
    if not o.updating:
        return
    if o.routine != states.TURRET_TARGET:
        look = 3
    else:
        distance = o.aim_factor
        look = 0 if distance <= 0.03 else 1 if distance < 0.05 else 2
    target.sprite(crosshair(look), m.x, m.y)


def _rocket(target: DrawTarget, m: Moving) -> None:
    trail = m.animation.trails.get(m.slot, [])
    for k, (tx, ty) in enumerate(trail[:-1]):
        step = min(7, len(trail) - 2 - k)
        target.sprite(drawings.flame(step).faded(max(2, 7 - step)), tx, ty)
    if m.o.routine == states.LAUNCHER_FLIGHT:
        turn = round(degrees(atan2(m.o.heading_y, m.o.heading_x)) / 6) * 6
        target.sprite(drawings.rocket(m.animation.tick % 4).turned(turn), m.x, m.y)


def _drone(target: DrawTarget, m: Moving) -> None:
    o = m.o
    seeker = 1 if o.seeker and o.weapon == states.WEAPON_ZAP else 0
    heat = _heat(m)
    target.sprite(drawings.drone(o.weapon, seeker, o.chasing, heat if o.weapon == states.WEAPON_LASER else 0), m.x, m.y)
    angle = m.animation.eyes[m.slot]
    turn = round(degrees(angle) / _TURN_STEP) * _TURN_STEP
    if o.weapon == states.WEAPON_CHAINGUN:
        spin = m.animation.tick // 2 % 2 if o.routine in {states.DRONE_PRE_FIRE, states.DRONE_FIRING} else 0
        target.sprite(drawings.barrel(spin, heat).turned(turn), m.x, m.y)
    mood = 1 if o.chasing else 2 if o.routine != states.DRONE_MOVE else 0
    target.sprite(drawings.eye(mood).turned(turn), m.x + _EYE_OUT * cos(angle), m.y + _EYE_OUT * sin(angle))


def _heat(m: Moving) -> int:
    o = m.o
    if o.routine == states.DRONE_PRE_FIRE:
        return m.step(_HEAT_FRAMES.get(o.weapon, 90))
    if o.routine == states.DRONE_FIRING:
        return 8
    return 8 - m.step(_COOL_FRAMES) if o.routine == states.DRONE_POST_FIRE else 0


def _beam(target: DrawTarget, m: Moving) -> None:
    o, palette, tick = m.o, target.palette, m.animation.tick
    if o.routine == states.DRONE_PRE_FIRE:
        target.line(palette.warning, o.x, o.y, o.end_x, o.end_y)
    elif o.routine == states.DRONE_FIRING:
        target.line(palette.laser, o.x, o.y, o.end_x, o.end_y, (3.0, 2.4, 3.4, 2.7)[tick % 4])
        target.line(palette.flame, o.x, o.y, o.end_x, o.end_y, 0.8)
        step = min(8, int(o.timer / 80 * 9))
        target.sprite(drawings.impact_burst(step).turned(tick % 5 * 15), o.end_x, o.end_y)


PAINTERS: dict[int, Callable[[DrawTarget, Moving], None]] = {
    kinds.BOUNCE_BLOCK: _block,
    kinds.THWUMP: _thwump,
    kinds.FLOOR_GUARD: _guard,
    kinds.TURRET: _crosshair,
    kinds.LAUNCHER: _rocket,
    kinds.DRONE: _drone,
}
"""How each kind is drawn."""
