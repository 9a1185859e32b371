"""The shapes with which objects and the ninja touch each other (objects.md §8), for the overlay that shows them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ninja_game.sim import rules
from ninja_game.sim.kinds import DOOR, DRONE, KIND_OF, SWITCH
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World
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


_SMALLEST = 1.0
"""Half size, px, at which a point is drawn: the tip of a rocket."""


def hit_shapes(world: World) -> Iterator[HitShape]:
    """Of every object in the grid, which is what can be touched; the ninja's last."""
    for slot in range(1, world.slots_used):
        o = world.objects[slot]
        if o.in_grid or (o.kind == SWITCH and not world.objects[o.partner].is_open):
            kind, half = KIND_OF[o.kind], _half(o)
            if half is not None:
                deadly = kind.by_touch and not _unarmed(o)
                yield HitShape(o.x, o.y, max(half, _SMALLEST), kind.disc is not None, deadly)
    n = world.ninja
    yield HitShape(n.x, n.y, rules.RADIUS, not n.box, ninja=True, vx=n.x - n.prev_x, vy=n.y - n.prev_y)


def _half(o: Object) -> float | None:
    if o.kind == DOOR and o.mechanism != AUTOMATIC:
        return rules.DOOR_SWITCH_RADIUS
    kind = KIND_OF[o.kind]
    return kind.box if kind.disc is None else kind.disc


def _unarmed(o: Object) -> bool:
    """Drones with a weapon do not hurt by touch."""
    return o.kind == DRONE and o.weapon != 0
