"""Drawing of the things that move, between two ticks."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, degrees, sin

from ninja_game.play.view.sprites.draw_target import Stage
from ninja_game.play.view.sprites.object_animation import ObjectAnimation
from ninja_game.sim.level import BOUNCE_BLOCK, DRONE, FLOOR_GUARD, LAUNCHER, THWUMP, TURRET
from ninja_game.sim.memory.schema import Object, World
from ninja_game.sim.states import (
    DRONE_FIRING,
    DRONE_MOVE,
    DRONE_POST_FIRE,
    DRONE_PRE_FIRE,
    LAUNCHER_FLIGHT,
    THWUMP_REST,
    TURRET_TARGET,
    WEAPON_CHAINGUN,
    WEAPON_LASER,
    WEAPON_ZAP,
)

_EYE_OUT = 4.5
"""How far a drone's eye is off the centre, px."""
_SHOWN_BY_SHAPE = 15
"""Turns of rockets and barrels are drawn in steps of so many degrees."""
_HEAT_FRAMES = {WEAPON_LASER: 90, WEAPON_CHAINGUN: 105}
_COOL_FRAMES = 60


def draw_movers(stage: Stage, world: World, animation: ObjectAnimation, fraction: float) -> None:
    """All things that move, beams first so that they come out of their drones."""
    for slot in animation.movers:
        o = world.objects[slot]
        if o.kind == DRONE and o.weapon == WEAPON_LASER:
            _beam(stage, o, slot, animation, fraction)
    for slot in animation.movers:
        o = world.objects[slot]
        x, y = animation.place(slot, fraction)
        # A rocket that met its target point exactly is nowhere (not a number).
        if x == x and y == y:  # noqa: PLR0124 - the test for NaN
            PAINTERS[o.kind](stage, o, slot, x, y, animation, fraction)


def _block(stage: Stage, o: Object, slot: int, x: float, y: float, animation: ObjectAnimation, fraction: float) -> None:
    stage.sprite(("block", 0, 8, o.updating), x, y)


def _thwump(
    stage: Stage, o: Object, slot: int, x: float, y: float, animation: ObjectAnimation, fraction: float
) -> None:
    mood = 0 if o.routine == THWUMP_REST else 1 if o.sign > 0 else 2
    # Its face looks where it falls: drawn for a fall downwards.
    turn = round(degrees(atan2(-o.face_x, o.face_y))) if o.face_x or o.face_y else 0
    stage.sprite(("thwump", turn, 8, mood, animation.tick // 3 % 2), x, y)


def _guard(stage: Stage, o: Object, slot: int, x: float, y: float, animation: ObjectAnimation, fraction: float) -> None:
    active = 1 if o.routine and o.updating else 0
    stage.sprite(("guard", 0, 8, active, animation.tick // 2 % 2 if active else 0), x, y)


def _crosshair(
    stage: Stage, o: Object, slot: int, x: float, y: float, animation: ObjectAnimation, fraction: float
) -> None:
    if not o.updating:
        return
    if o.routine != TURRET_TARGET:
        look = 3
    else:
        distance = o.aim_factor
        look = 0 if distance <= 0.03 else 1 if distance < 0.05 else 2
    stage.sprite(("crosshair", 0, 8, look), x, y)


def _rocket(
    stage: Stage, o: Object, slot: int, x: float, y: float, animation: ObjectAnimation, fraction: float
) -> None:
    trail = animation.trails.get(slot, [])
    for k, (tx, ty) in enumerate(trail[:-1]):
        step = min(7, len(trail) - 2 - k)
        stage.sprite(("flame", 0, max(2, 7 - step), step), tx, ty)
    if o.routine == LAUNCHER_FLIGHT:
        turn = round(degrees(atan2(o.heading_y, o.heading_x)) / 6) * 6
        stage.sprite(("rocket", turn, 8, animation.tick % 4), x, y)


def _drone(stage: Stage, o: Object, slot: int, x: float, y: float, animation: ObjectAnimation, fraction: float) -> None:
    seeker = 1 if o.seeker and o.weapon == WEAPON_ZAP else 0
    heat = _heat(o, slot, animation, fraction)
    stage.sprite(("drone", 0, 8, o.weapon, seeker, o.chasing, heat if o.weapon == WEAPON_LASER else 0), x, y)
    angle = animation.eyes[slot]
    if o.weapon == WEAPON_CHAINGUN:
        turn = round(degrees(angle) / _SHOWN_BY_SHAPE) * _SHOWN_BY_SHAPE
        spin = animation.tick // 2 % 2 if o.routine in {DRONE_PRE_FIRE, DRONE_FIRING} else 0
        stage.sprite(("barrel", turn, 8, spin, heat), x, y)
    mood = 1 if o.chasing else 2 if o.routine != DRONE_MOVE else 0
    turn = round(degrees(angle) / _SHOWN_BY_SHAPE) * _SHOWN_BY_SHAPE
    stage.sprite(("eye", turn, 8, mood), x + _EYE_OUT * cos(angle), y + _EYE_OUT * sin(angle))


def _heat(o: Object, slot: int, animation: ObjectAnimation, fraction: float) -> int:
    if o.routine == DRONE_PRE_FIRE:
        return animation.step(slot, fraction, _HEAT_FRAMES.get(o.weapon, 90))
    if o.routine == DRONE_FIRING:
        return 8
    return 8 - animation.step(slot, fraction, _COOL_FRAMES) if o.routine == DRONE_POST_FIRE else 0


def _beam(stage: Stage, o: Object, slot: int, animation: ObjectAnimation, fraction: float) -> None:
    palette = stage.palette
    if o.routine == DRONE_PRE_FIRE:
        stage.line(palette.warning, o.x, o.y, o.end_x, o.end_y)
    elif o.routine == DRONE_FIRING:
        flicker = (3.0, 2.4, 3.4, 2.7)[animation.tick % 4]
        stage.line(palette.laser, o.x, o.y, o.end_x, o.end_y, flicker)
        stage.line(palette.flame, o.x, o.y, o.end_x, o.end_y, 0.8)
        step = min(8, int(o.timer / 80 * 9))
        stage.sprite(("burst", animation.tick % 5 * 15, 8, step), o.end_x, o.end_y)


Painter = Callable[[Stage, Object, int, float, float, ObjectAnimation, float], None]
PAINTERS: dict[int, Painter] = {
    BOUNCE_BLOCK: _block,
    THWUMP: _thwump,
    FLOOR_GUARD: _guard,
    TURRET: _crosshair,
    LAUNCHER: _rocket,
    DRONE: _drone,
}
"""How each kind is drawn."""
