"""The shapes with which things and the ninja touch each other (objects.md §8), for the overlay that shows them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ninja_game.sim import rules
from ninja_game.sim.level import (
    BOUNCE_BLOCK,
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    LAUNCH_PAD,
    LAUNCHER,
    MINE,
    ONE_WAY,
    THWUMP,
)
from ninja_game.sim.memory.schema import SWITCH, Object, World
from ninja_game.sim.states import AUTOMATIC


@dataclass(frozen=True)
class HitShape:
    """A circle (``round``) or square about a point, px; ``half``: its radius or half side."""

    x: float
    y: float
    half: float
    round: bool
    lethal: bool = False
    ninja: bool = False
    vx: float = 0.0
    vy: float = 0.0


_DISCS = {
    GOLD: rules.GOLD_RADIUS, MINE: rules.MINE_RADIUS, EXIT: rules.EXIT_RADIUS, SWITCH: rules.SWITCH_RADIUS,
    LAUNCH_PAD: rules.PAD_RADIUS, FLOOR_GUARD: rules.GUARD_RADIUS, DRONE: rules.DRONE_RADIUS, LAUNCHER: 1.0,
}  # fmt: skip
_BOXES = {BOUNCE_BLOCK: rules.BLOCK_HALF, ONE_WAY: rules.ONE_WAY_HALF, THWUMP: rules.THWUMP_HALF}
_LETHAL = {MINE, FLOOR_GUARD, DRONE, LAUNCHER, THWUMP}


def hit_shapes(world: World) -> Iterator[HitShape]:
    """Of everything that is filed in the grid, and so can be touched; the ninja's last."""
    for slot in range(1, world.slots_used):
        o = world.objects[slot]
        if o.in_grid or (o.kind == SWITCH and not world.objects[o.partner].spent):
            half = _half(o)
            if half:
                yield HitShape(o.x, o.y, half, o.kind not in _BOXES, o.kind in _LETHAL and not _unarmed(o))
    n = world.ninja
    yield HitShape(n.x, n.y, rules.RADIUS, not n.box, ninja=True, vx=n.x - n.prev_x, vy=n.y - n.prev_y)


def _half(o: Object) -> float:
    if o.kind == DOOR:
        return rules.AUTOMATIC_DOOR_RADIUS if o.mechanism == AUTOMATIC else rules.DOOR_SWITCH_RADIUS
    return _DISCS.get(o.kind) or _BOXES.get(o.kind, 0.0)


def _unarmed(o: Object) -> bool:
    """Drones with a weapon do not hurt by touch."""
    return o.kind == DRONE and o.weapon != 0
