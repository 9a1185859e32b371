"""Drawings of objects that stay in place: exits, switches, doors, pads, one-ways, bases of weapons, gold, mines.

Parameters called ``step`` count from 0 (closed, resting) to 8 (open, done).
"""

from __future__ import annotations

from math import atan2, cos, degrees, radians, sin

from ninja_game.sim import kinds
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import AUTOMATIC, LAUNCHER_PREPARE, TRAP, TURRET_POST_FIRE, TURRET_PRE_FIRE
from ninja_game.ui.theme import Palette, mixed
from ninja_game.view.sprites.drawing import SpriteKey, drawn_within
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.sketch import Sketch, star


@drawn_within(5.5)
def gold(s: Sketch, p: Palette) -> None:
    """A small bevelled ingot seen from above, with a glint in its corner."""
    s.box(p.gold_dark, -4.3, -4.3, 8.6, 8.6)
    s.box(p.gold, -3.6, -3.6, 7.2, 7.2)
    s.polygon(p.gold_light, [(-3.6, -3.6), (3.6, -3.6), (1.8, -1.8), (-1.8, -1.8), (-1.8, 1.8), (-3.6, 3.6)])
    s.polygon(
        mixed(p.gold, p.gold_dark, 0.55), [(3.6, 3.6), (-3.6, 3.6), (-1.8, 1.8), (1.8, 1.8), (1.8, -1.8), (3.6, -3.6)]
    )
    s.polygon(p.spark, [(x - 2.6, y - 2.6) for x, y in star(4, 2.4, 0.6)])


@drawn_within(5.6)
def mine(s: Sketch, p: Palette) -> None:
    """A spiked disc."""
    s.polygon(p.mine, star(8, 5.2 if p.danger_by_shape else 4.6, 2.5))
    s.disc(p.mine, 0, 0, 2.9)
    s.disc(mixed(p.mine, p.outline, 0.55), 0, 0, 1.9)
    s.disc(p.bright, -0.6, -0.6, 0.6)


@drawn_within(13.5)
def exit_door(s: Sketch, p: Palette, step: int) -> None:
    """Two leaves before a lit doorway; they fold to its sides, within its frame, since rock may be beside it."""
    width = 12.1 - 8 * step / 8
    s.box(p.outline, -12.6, -12.6, 25.2, 25.2)
    s.box(p.exit if step else mixed(p.exit, p.outline, 0.35), -11.6, -11.6, 23.2, 23.2)
    if step:
        s.box(p.exit_light, -7.5 * step / 8, -11.6, 15 * step / 8, 23.2)
        arrow = p.exit if p.scenery else p.bright
        s.polygon(arrow, [(-4.2, -1), (0, -6.2), (4.2, -1), (1.6, -1), (1.6, 5), (-1.6, 5), (-1.6, -1)])
    for side in (-1, 1):
        x, folded = -12.1 if side < 0 else 12.1 - width, width / 12.1
        s.framed_box(p.light, p.outline, x, -12.1, width, 24.2)
        s.box(p.bright, x + 1.8 * folded, -10.2, 8.5 * folded, 1.2)
        s.framed_box(p.middle, p.dark, x + 2.6 * folded, -7.4, 6.9 * folded, 14.8, 0.7)
        s.box(p.exit, x + (8.9 if side < 0 else 1.5) * folded, -2.5, 1.7 * folded, 5)


@drawn_within(11)
def exit_switch(s: Sketch, p: Palette, pressed: int) -> None:
    """A plate in the exit's colour with a bright key; a dark one with a tick mark once it is pressed."""
    s.framed_box(mixed(p.exit, p.outline, 0.5) if pressed else p.exit, p.outline, -9, -5.8, 18, 11.6)
    s.framed_box(mixed(p.exit, p.outline, 0.75) if pressed else p.exit_light, p.outline, -6, -2.9, 12, 5.8, 0.7)
    if pressed:
        s.path(p.exit_light, [(-3, -0.3), (-0.8, 1.9), (3.6, -3.4)], 1.5)


@drawn_within(14)
def door(s: Sketch, p: Palette, mechanism: int, step: int) -> None:
    """A bar across x = 0 from y -12 to 12; ``step``: how far its halves have shrunk."""
    half = 12 - 9 * step / 8
    width, fill = ((1.5, p.dark), (2.4, p.lock), (3.2, p.trap))[mechanism]
    for side in (-1, 1):
        top = -12 if side < 0 else 12 - half
        s.framed_box(fill, p.outline, -width, top, 2 * width, half, 0.7)
        s.framed_box(p.light, p.outline, -width - 1.1, -12 if side < 0 else 9.6, 2 * width + 2.2, 2.4, 0.6)
    if mechanism == 0:
        for side in (-1, 1):
            edge = side * (12 - half)
            s.box(p.good, -0.6, edge - (0 if side > 0 else 2.6), 1.2, 2.6)
    elif mechanism == 1 and step == 0:
        s.disc(p.outline, 0, 0, 4.6)
        s.disc(p.lock, 0, 0, 3.8)
        s.disc(p.bright, 0, -0.9, 1.3)
        s.polygon(p.bright, [(-0.6, -0.5), (0.6, -0.5), (1.0, 2.4), (-1.0, 2.4)])
    elif mechanism == 2:
        for y in range(-8, 9, 4):
            s.polygon(
                p.bright if not p.danger_by_shape else p.outline,
                [(-2.4, y - 1.4), (2.4, y + 0.6), (2.4, y + 1.8), (-2.4, y - 0.2)],
            )


@drawn_within(6.5)
def door_switch(s: Sketch, p: Palette, mechanism: int, used: int) -> None:
    """A round plate with a key (locked doors: gold is square) or a snare (trap doors)."""
    if mechanism == 1:
        plate, sign = (p.middle, p.dark) if used else (p.lock, p.bright)
        s.disc(p.outline, 0, 0, 5.4)
        s.disc(plate, 0, 0, 4.6)
        s.ring(sign, -1.6, 0, 1.7, 0.9)
        s.stroke(sign, (-0.2, 0), (3.2, 0), 0.9)
        for x in (1.7, 3.1):
            s.stroke(sign, (x, 0), (x, 1.5), 0.9)
    else:
        s.framed_box(p.middle if used else p.trap, p.outline, -3, -3, 6, 6, 0.8)
        if not used:
            s.stroke(p.bright, (-1.2, -1.2), (1.2, 1.2), 0.8)
            s.stroke(p.bright, (-1.2, 1.2), (1.2, -1.2), 0.8)


@drawn_within(-9.5, -12, 9.5, 3)
def launch_pad(s: Sketch, p: Palette, step: int) -> None:
    """A spring plate on the surface at its point, from ``step`` 8 (just sprung) to 0. What springs is green."""
    top = -5.8 - 4.5 * step / 8
    flash = mixed(p.good, p.bright, 0.7 * step / 8)
    s.polygon(p.dark, [(-5.5, 0), (5.5, 0), (4, top + 2.4), (-4, top + 2.4)])
    s.stroke(p.outline, (-3.6, -0.4), (3.6, top + 3), 0.7)
    s.stroke(p.outline, (3.6, -0.4), (-3.6, top + 3), 0.7)
    s.framed_box(flash, p.outline, -8.4, top, 16.8, 4, 0.7)
    chevron = [(-2.6, 0.7), (0, -0.7), (2.6, 0.7), (2.6, 1.6), (0, 0.2), (-2.6, 1.6)]
    s.polygon(p.spark, [(x, y + top + 1.6) for x, y in chevron])
    s.box(p.outline, -7.6, -0.7, 15.2, 0.9)


@drawn_within(13)
def one_way(s: Sketch, p: Palette) -> None:
    """A bar on the solid side, here the upper one; chevrons below it show the open direction."""
    for top, width in ((-4.5, 2.0), (0.7, 1.2)):
        s.path(p.switch, [(-4, top + 3.4), (0, top), (4, top + 3.4)], width)
    s.framed_box(p.switch, p.outline, -12, -12, 24, 4.4, 0.9)
    s.box(mixed(p.switch, p.spark, 0.6), -12, -11.1, 24, 0.9)


@drawn_within(7)
def turret_base(s: Sketch, p: Palette, step: int) -> None:
    """A round base; its dot grows before the shot."""
    s.disc(p.outline, 0, 0, 6.3)
    s.disc(p.turret, 0, 0, 5.4)
    s.disc(mixed(p.turret, p.outline, 0.5), 0, 0, 3.7)
    s.disc(p.bright if step else p.warning, 0, 0, 1.1 + 2.2 * step / 8)
    if p.danger_by_shape:
        s.rays(p.outline, (45, 135, 225, 315), 4.2, 6.6, 1.4)


@drawn_within(7)
def launcher_base(s: Sketch, p: Palette, step: int) -> None:
    """A round base with a rocket's head in its tube; it glows while the rocket is prepared."""
    s.disc(p.outline, 0, 0, 6.3)
    s.disc(p.launcher, 0, 0, 5.4)
    s.disc(mixed(p.launcher, p.outline, 0.6), 0, 0, 3.6)
    glow = mixed(p.middle, p.flame, step / 8)
    s.polygon(glow, [(-1.9, 2.2), (-1.9, -0.6), (0, -3.1), (1.9, -0.6), (1.9, 2.2)])
    for angle in (30, 150, 270):
        a = radians(angle)
        s.disc(p.light, 4.6 * cos(a), 4.6 * sin(a), 0.7)


@drawn_within(9)
def crosshair(s: Sketch, p: Palette, look: int) -> None:
    """The crosshair of a turret. ``look``: 0 far, 1 mid, 2 near, 3 locked (before and after the shot)."""
    radius = (2.3, 4.5, 6.8, 6.8)[look]
    colour = mixed(p.outline, p.turret, 0.4) if look < 3 else p.laser
    s_width = 0.8 if look < 3 else 1.1
    if look == 0:
        s.stroke(colour, (-radius, 0), (radius, 0), s_width)
        s.stroke(colour, (0, -radius), (0, radius), s_width)
        return
    s.ring(colour, 0, 0, radius * 0.72, s_width)
    s.rays(colour, (0, 90, 180, 270), radius * 0.45, radius, s_width)
    if look == 3:
        s.disc(p.laser, 0, 0, 1.3)


@drawn_within(-5, -38, 5, 6)
def gold_streak(s: Sketch, p: Palette, step: int) -> None:
    """Collected gold: squeezed into a streak that shoots up."""
    t = step / 8
    width = max(0.35, 3.2 * (1 - t) ** 2)
    top, bottom = -34 * t**0.7, 3 - 33 * t
    s.polygon(p.gold, [(-width, bottom), (0, top - 3), (width, bottom), (0, bottom + 2)])
    s.polygon(p.gold_light, [(-width * 0.5, bottom), (0, top - 2), (width * 0.5, bottom)])


@drawn_within(-20, -8, 20, 8)
def lightning(s: Sketch, p: Palette, variant: int) -> None:
    """A jagged flash along x."""
    zigzag = ((0, 3, -4, 2, -2, 0), (0, -4, 3, -3, 4, 0), (0, 5, -1, 3, -5, 0))[variant]
    points = [(-18 + 7.2 * k, y * 1.0) for k, y in enumerate(zigzag)]
    s.path(p.electric, points, 2.2)
    s.path(p.spark, points, 1.0)


PlacedSprite = tuple[SpriteKey, float, float]  # a drawing and the place of its point, px

_EXIT_FRAMES, _PAD_FRAMES, _LOCK_FRAMES = 30, 18, 18
_DOOR_OPENING, _DOOR_CLOSING, _AIM_FRAMES, _PREPARE_FRAMES = 15, 16, 15, 30
_MAX_FRAMES = 30
SETTLED_TICKS = _MAX_FRAMES / 3  # ticks without change after which a static sprite stays the same


def static_sprites_of(world: World, slot: int, animation: ObjectAnimation, fraction: float) -> list[PlacedSprite]:
    """The static drawings of one object; [] if it has none, or is gone."""
    o = world.objects[slot]
    kind = o.kind
    if kind == kinds.GOLD:
        return [] if o.taken else [(gold(), o.x, o.y)]
    if kind == kinds.MINE:
        return [] if o.exploded else [(mine(), o.x, o.y)]
    if kind == kinds.EXIT:
        step = animation.step(slot, fraction, _EXIT_FRAMES) if o.is_open else 0
        return [(exit_door(8 - step if slot == animation.closing else step), o.x, o.y)]
    if kind == kinds.SWITCH:
        return [(exit_switch(world.objects[o.partner].is_open), o.x, o.y)]
    if kind == kinds.DOOR:
        return _door_sprites(o, slot, animation, fraction)
    if kind == kinds.LAUNCH_PAD:
        step = 8 - animation.step(slot, fraction, _PAD_FRAMES)
        return [(launch_pad(step).turned(_upright(o.face_x, o.face_y)), o.x, o.y)]
    if kind == kinds.ONE_WAY:
        return [(one_way().turned(_upright(o.face_x, o.face_y)), o.x, o.y)]
    if kind == kinds.TURRET:
        return [(turret_base(_turret_step(o, slot, animation, fraction)), o.x, o.y)]
    if kind == kinds.LAUNCHER:
        step = animation.step(slot, fraction, _PREPARE_FRAMES) if o.routine == LAUNCHER_PREPARE else 0
        return [(launcher_base(step), o.base_x, o.base_y)]
    return []


def _upright(face_x: float, face_y: float) -> int:
    """Degrees, in steps of 45, to turn a drawing with its upper side in that direction."""
    sign_x, sign_y = (face_x > 0) - (face_x < 0), (face_y > 0) - (face_y < 0)
    return round(degrees(atan2(sign_x, -sign_y)))


def _turret_step(o: Object, slot: int, animation: ObjectAnimation, fraction: float) -> int:
    if not o.updating:
        return 0
    if o.routine == TURRET_PRE_FIRE:
        return animation.step(slot, fraction, _AIM_FRAMES)
    return 8 - animation.step(slot, fraction, 9) if o.routine == TURRET_POST_FIRE else 0


def door_place(o: Object) -> tuple[float, float, int] | None:
    """Middle of a door's bar, px, and its turn in degrees; None for a door without edges."""
    if not o.edge_1:
        return None
    cell, side = divmod(o.edge_1, 4)
    dx, dy = ((12, 0), (0, 12), (-12, 0), (0, -12))[side]
    return CENTRE_X[cell] + dx, CENTRE_Y[cell] + dy, 0 if dx else 90


def _door_sprites(o: Object, slot: int, animation: ObjectAnimation, fraction: float) -> list[PlacedSprite]:
    sprites: list[PlacedSprite] = []
    place = door_place(o)
    automatic = _DOOR_OPENING if o.switched else _DOOR_CLOSING
    step = animation.step(slot, fraction, automatic if o.mechanism == AUTOMATIC else _LOCK_FRAMES)
    closed = o.switched == (o.mechanism == TRAP)
    # A trap door is invisible until it is sprung.
    if place and not (o.mechanism == TRAP and not o.switched):
        x, y, turn = place
        sprites.append((door(o.mechanism, 8 - step if closed else step).turned(turn), x, y))
    if o.mechanism != AUTOMATIC:
        sprites.append((door_switch(o.mechanism, o.switched), o.x, o.y))
    return sprites
