"""The ninja's killers: their names, and sentences about them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ninja_game.formats.ascii.legend import WEAPONS
from ninja_game.sim.events import DIED
from ninja_game.sim.kinds import DRONE, KIND_OF, KINDS
from ninja_game.sim.rules import FATAL_IMPACT, FLOOR_ALLOWANCE
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import CAUSE_NAMES, FALL, NO_CAUSE

SELF = "player"  # falls, being crushed, suicide, time

_DRONES = {int(weapon): name for name, weapon in WEAPONS.items()}
KILLERS = (*_DRONES.values(), *(kind.killer for kind in KINDS if kind.killer and kind.number != DRONE), SELF)


def _death(events: Sequence[Any]) -> tuple[int, int]:
    """Cause and killer's slot (0: nobody) of the ninja's death among a tick's events; NO_CAUSE without a death."""
    return next(((event.cause, event.slot) for event in events if event.kind == DIED), (NO_CAUSE, 0))


def cause_of(world: World) -> int:
    """The cause of the ninja's death in the world's last tick, as in ``sim.states``; NO_CAUSE without a death."""
    return _death(world.events[: world.event_count])[0]


def killer_of(world: World) -> str:
    """The ninja's killer in the world's last tick, one of KILLERS."""
    _, slot = _death(world.events[: world.event_count])
    return _name(world.objects[slot]) if slot else SELF


def _name(killer: Any) -> str:
    return _DRONES[killer.weapon] if killer.kind == DRONE else KIND_OF[killer.kind].killer


def death_text(events: Sequence[Any], ninja: Any, objects: Sequence[Any]) -> str:
    """The ninja's killer in a world's last tick, in words; "" without a death. All three arguments: that world's.

    A killer with its id; for a landing the speed against the floor, px/tick, and the greatest survivable one.
    """
    (cause, slot), n = _death(events), ninja
    if slot:
        return f"{_name(objects[slot])} {slot - 1}"
    if cause == FALL:
        speed = -(n.impact_x * n.floor_x + n.impact_y * n.floor_y)
        return f"floor at {speed:.3f} px/tick, over {FATAL_IMPACT - FLOOR_ALLOWANCE * abs(n.floor_y):.3f}"
    return CAUSE_NAMES[cause] if cause != NO_CAUSE else ""


def ending_text(outcome: str, tick: int, death: str = "") -> str:
    """The end of a run, in words. ``tick``: its last one.

    >>> ending_text("dead", 96, "mine 12"), ending_text("exit", 219), ending_text("running", 59)
    ('dead in tick 96: mine 12', 'exit in tick 219', 'still running after 60 ticks')
    """
    if outcome == "running":
        return f"still running after {tick + 1} ticks"
    return f"{outcome} in tick {tick}" + (f": {death}" if death else "")
