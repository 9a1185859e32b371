"""Which drawing shows an object that stays in its place, in its present state."""

from __future__ import annotations

from math import atan2, degrees

from ninja_game.play.view.sprites import static_sprites as drawings
from ninja_game.play.view.sprites.drawing import SpriteKey
from ninja_game.play.view.sprites.object_animation import ObjectAnimation
from ninja_game.sim import kinds
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import AUTOMATIC, LAUNCHER_PREPARE, TRAP, TURRET_POST_FIRE, TURRET_PRE_FIRE

PlacedSprite = tuple[SpriteKey, float, float]
"""A drawing and where its point lies, px."""

_EXIT_FRAMES, _PAD_FRAMES, _LOCK_FRAMES, _TRAP_FRAMES = 30, 18, 18, 18
_DOOR_OPENING, _DOOR_CLOSING, _AIM_FRAMES, _PREPARE_FRAMES = 15, 16, 15, 30
LONGEST_FRAMES = 30
SETTLED_TICKS = LONGEST_FRAMES / 3
"""After so many ticks without change a static sprite stays the same."""


def static_sprites_of(world: World, slot: int, animation: ObjectAnimation, fraction: float) -> list[PlacedSprite]:
    """The drawings of one object; [] if nothing of it is fixed to the walls, or it is gone."""
    o = world.objects[slot]
    kind = o.kind
    if kind == kinds.GOLD:
        return [] if o.taken else [(drawings.gold(), o.x, o.y)]
    if kind == kinds.MINE:
        return [] if o.exploded else [(drawings.mine(), o.x, o.y)]
    if kind == kinds.EXIT:
        step = animation.step(slot, fraction, _EXIT_FRAMES) if o.is_open else 0
        return [(drawings.exit_door(step), o.x, o.y)]
    if kind == kinds.SWITCH:
        return [(drawings.exit_switch(world.objects[o.partner].is_open), o.x, o.y)]
    if kind == kinds.DOOR:
        return _door_sprites(o, slot, animation, fraction)
    if kind == kinds.LAUNCH_PAD:
        step = 8 - animation.step(slot, fraction, _PAD_FRAMES)
        return [(drawings.launch_pad(step).turned(_upright(o.face_x, o.face_y)), o.x, o.y)]
    if kind == kinds.ONE_WAY:
        return [(drawings.one_way().turned(_upright(o.face_x, o.face_y)), o.x, o.y)]
    if kind == kinds.TURRET:
        return [(drawings.turret_base(_turret_step(o, slot, animation, fraction)), o.x, o.y)]
    if kind == kinds.LAUNCHER:
        step = animation.step(slot, fraction, _PREPARE_FRAMES) if o.routine == LAUNCHER_PREPARE else 0
        return [(drawings.launcher_base(step), o.base_x, o.base_y)]
    return []


def _upright(face_x: float, face_y: float) -> int:
    """Turn in degrees, by steps of 45, of a drawing whose upper side faces that way."""
    sign_x, sign_y = (face_x > 0) - (face_x < 0), (face_y > 0) - (face_y < 0)
    return round(degrees(atan2(sign_x, -sign_y)))


def _turret_step(o: Object, slot: int, animation: ObjectAnimation, fraction: float) -> int:
    if not o.updating:
        return 0
    if o.routine == TURRET_PRE_FIRE:
        return animation.step(slot, fraction, _AIM_FRAMES)
    return 8 - animation.step(slot, fraction, 9) if o.routine == TURRET_POST_FIRE else 0


def door_place(o: Object) -> tuple[float, float, int] | None:
    """Middle of a door's bar, px, and its turn in degrees; None for a door that is nowhere."""
    if not o.edge_1:
        return None
    cell, side = divmod(o.edge_1, 4)
    dx, dy = ((12, 0), (0, 12), (-12, 0), (0, -12))[side]
    return CENTRE_X[cell] + dx, CENTRE_Y[cell] + dy, 0 if dx else 90


def _door_sprites(o: Object, slot: int, animation: ObjectAnimation, fraction: float) -> list[PlacedSprite]:
    sprites: list[PlacedSprite] = []
    place = door_place(o)
    step = animation.step(slot, fraction, _door_frames(o))
    closed = o.switched == (o.mechanism == TRAP)
    # A trap door cannot be seen until it is sprung.
    if place and not (o.mechanism == TRAP and not o.switched):
        x, y, turn = place
        sprites.append((drawings.door(o.mechanism, 8 - step if closed else step).turned(turn), x, y))
    if o.mechanism != AUTOMATIC:
        sprites.append((drawings.door_switch(o.mechanism, o.switched), o.x, o.y))
    return sprites


def _door_frames(o: Object) -> int:
    if o.mechanism == AUTOMATIC:
        return _DOOR_OPENING if o.switched else _DOOR_CLOSING
    return _TRAP_FRAMES if o.mechanism == TRAP else _LOCK_FRAMES
