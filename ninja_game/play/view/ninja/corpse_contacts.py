"""What the corpse bumps into among the objects. It only reads them: nothing is moved, sprung or set off by it."""

from __future__ import annotations

from collections.abc import Iterator

from ninja_game.play.view.ninja.box_contact import Box
from ninja_game.sim import kinds
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import BLOCK_HALF, THWUMP_HALF
from ninja_game.sim.states import WEAPON_ZAP

_PAD_KICK, _ZAP_KICK, _GUARD_KICK, _THWUMP_KICK = 6.0, 5.0, 6.0, 4.0


def thing_pushes(world: World, box: Box) -> Iterator[tuple[float, float, float]]:
    """Normals of the objects that a box touches, and how hard (px/tick) they kick it; it is pushed out as they come."""
    for slot in range(1, world.id_count + 1):
        o = world.objects[slot]
        if o.kind in CONTACTS and abs(o.x - box.x) < 26 and abs(o.y - box.y) < 26:
            half, kick = CONTACTS[o.kind]
            if o.kind == kinds.LAUNCH_PAD:
                yield from _pad(o, box)
            elif o.kind == kinds.ONE_WAY:
                yield from _one_way(o, box)
            elif o.kind != kinds.DRONE or o.weapon == WEAPON_ZAP:
                yield from _square(o, box, half, kick)


def _square(o: Object, box: Box, half: float, kick: float) -> Iterator[tuple[float, float, float]]:
    dx, dy = box.x - o.x, box.y - o.y
    ox, oy = half + box.half - abs(dx), half + box.half - abs(dy)
    if ox <= 0 or oy <= 0:
        return
    live = kick
    if oy < ox:
        sign = -1.0 if dy < 0 else 1.0
        box.y += sign * oy
        if o.kind == kinds.THWUMP:
            live = kick if sign == o.face_y else 0.0
        yield 0.0, sign, live
    else:
        sign = -1.0 if dx < 0 else 1.0
        box.x += sign * ox
        if o.kind == kinds.THWUMP:
            live = kick if sign == o.face_x else 0.0
        yield sign, 0.0, live


def _pad(o: Object, box: Box) -> Iterator[tuple[float, float, float]]:
    dx, dy = o.x - box.x, o.y - box.y
    if dx * dx + dy * dy < (6 + box.half) ** 2:
        length = (o.face_x * o.face_x + o.face_y * o.face_y) ** 0.5 or 1.0
        yield o.face_x / length, o.face_y / length, _PAD_KICK


def _one_way(o: Object, box: Box) -> Iterator[tuple[float, float, float]]:
    """Only from its face, and only near it."""
    dx, dy = box.x - o.x, box.y - o.y
    across = abs(dy) if o.face_x else abs(dx)
    depth = 12 + box.half - (dx * o.face_x + dy * o.face_y)
    if across < 12 + box.half and 0 < depth < 6:
        box.x += depth * o.face_x
        box.y += depth * o.face_y
        yield o.face_x, o.face_y, 0.0


CONTACTS = {
    kinds.BOUNCE_BLOCK: (BLOCK_HALF, 0.0),
    kinds.THWUMP: (THWUMP_HALF, _THWUMP_KICK),
    kinds.LAUNCH_PAD: (6.0, _PAD_KICK),
    kinds.ONE_WAY: (12.0, 0.0),
    kinds.FLOOR_GUARD: (6.0, _GUARD_KICK),
    kinds.DRONE: (9.0, _ZAP_KICK),
}
"""Half size (px) and kick of each kind that the corpse can touch."""
