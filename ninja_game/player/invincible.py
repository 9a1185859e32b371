"""An invincible ninja: a tick that would kill is run again as if what kills were not there."""

from __future__ import annotations

from ninja_game.sim.events import DIED
from ninja_game.sim.kinds import INERT
from ninja_game.sim.states import OUTCOME_DEAD
from ninja_game.simulation import Simulation

_MOST_TRIES = 20
"""More than any place has killers: a ninja that is still crushed after so many tries is dead."""


def spared_tick(simulation: Simulation, keys: int) -> bool:
    """One tick of a run on the plain memory that goes on; whether a death was refused.

    An object that kills stands still for the tick and is not met; a landing that kills is met at half the speed.
    The rules of the world do not change: it is put back to the tick before, and told otherwise.
    """
    world, before = simulation.world, simulation.save()
    left_out: dict[int, int] = {}
    share = 1.0
    simulation.step_keys(keys)
    for _ in range(_MOST_TRIES):
        if world.outcome != OUTCOME_DEAD:
            break
        killer = next(event.slot for event in world.events[: world.event_count] if event.kind == DIED)
        simulation.restore(before)
        if killer:
            left_out[killer] = world.objects[killer].kind
        else:
            share /= 2
        for slot in left_out:
            world.objects[slot].kind = INERT
        if share < 1:
            ninja = world.ninja
            ninja.prev_x = ninja.x - share * (ninja.x - ninja.prev_x)
            ninja.prev_y = ninja.y - share * (ninja.y - ninja.prev_y)
        simulation.step_keys(keys)
    for slot, kind in left_out.items():
        world.objects[slot].kind = kind
    return bool(left_out) or share < 1
