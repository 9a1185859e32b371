"""Runs in the little room of the scenes, for tests that read like the rules: until something happens, then look."""

from collections.abc import Callable

import pytest

from ninja_game.sim.level import ObjectSpec
from ninja_game.simulation import EventView, ObjectView, Simulation
from tests.support.own_scenes import ninja, room

FLOOR = 230.0  # where a ninja stands: y in px of its middle

Play = Callable[..., Simulation]
"""Starts a run: ``play(*objects, tiles={}, x=60.0, y=FLOOR)``. The ninja is object 0, the objects are 1, 2, …"""


def starter(memory: str) -> Play:
    """The function that starts runs in one memory."""

    def play(
        *objects: ObjectSpec, tiles: dict[tuple[int, int], int] | None = None, x: float = 60.0, y: float = FLOOR
    ) -> Simulation:
        return Simulation(room(tiles or {}, ninja(x, y), *objects), memory=memory)

    return play


def until(run: Simulation, event: str, *, limit: int = 300, left: bool = False, right: bool = False) -> EventView:
    """Step with these keys until an event happens; fail if it does not within ``limit`` ticks."""
    for _ in range(limit):
        run.step(left=left, right=right)
        for seen in run.events:
            if seen.name == event:
                return seen
    pytest.fail(f"no {event} within {limit} ticks")


def wait(run: Simulation, ticks: int, *, left: bool = False, right: bool = False) -> set[str]:
    """Step with these keys; the names of all that happened."""
    seen = set()
    for _ in range(ticks):
        run.step(left=left, right=right)
        seen |= {event.name for event in run.events}
    return seen


def the(run: Simulation, id_: int) -> ObjectView:
    """An object by its id, as it is now."""
    return next(o for o in run.objects if o.id == id_)
