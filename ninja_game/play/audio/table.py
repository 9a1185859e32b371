"""Which sound belongs to what (presentation.md §6): tables by event, kill type and speed, and the loops."""

from __future__ import annotations

from collections.abc import Iterable
from math import floor

from ninja_game.sim import events, states
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, LAUNCHER
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World

Names = tuple[str, ...]
"""Sounds of which one is chosen by chance."""

BY_EVENT: dict[int, Names] = {
    events.JUMPED: ("jump",),
    events.WALL_JUMPED: ("jump",),
    events.LANDED: ("land",),
    events.LAUNCHED: ("launch",),
    events.WON: ("passed",),
    events.GOLD_TAKEN: ("gold",),
    events.MINE_EXPLODED: ("mine",),
    events.EXIT_OPENED: ("exit-open",),
    events.DOOR_OPENED: ("door-open",),
    events.DOOR_CLOSED: ("door-close",),
    events.LOCK_OPENED: ("lock-open",),
    events.TRAP_CLOSED: ("trap-close",),
    events.CHASE_STARTED: ("chase",),
    events.ROCKET_LAUNCHED: ("rocket-launch",),
    events.ROCKET_EXPLODED: ("rocket-explode",),
    events.TURRET_LOCKED: ("turret-lock",),
    events.TURRET_FIRED: ("turret-fire",),
    events.LASER_CHARGING: ("laser-charge",),
    events.CHAINGUN_CHARGING: ("chaingun-charge",),
    events.CHAINGUN_SHOT: ("chaingun-shot",),
    events.CHAINGUN_OFF: ("chaingun-off",),
}

BY_DEATH: dict[int, Names] = {
    states.EXPLOSIVE: ("death-explosive-1", "death-explosive-2"),
    states.FALL: ("death-fall",),
    states.LASER: ("death-laser",),
    states.ELECTRIC: ("death-electric",),
}
OTHER_DEATH: Names = ("death-bullet-1", "death-bullet-2")

CORPSE: tuple[tuple[float, Names], ...] = (
    (3.0, ("corpse-hard-1", "corpse-hard-2", "corpse-hard-3")),
    (2.0, ("corpse-medium-1", "corpse-medium-2")),
    (1.2, ("corpse-soft-1", "corpse-soft-2")),
)
"""Slowest speed (px/tick) of each hardness, hardest first."""

LOOPS = ("skid", "slide", "rocket-flight", "laser-beam", "guard")

_LASTING = {
    LAUNCHER: (states.LAUNCHER_FLIGHT, "rocket-flight"),
    DRONE: (states.DRONE_FIRING, "laser-beam"),
    FLOOR_GUARD: (states.GUARD_CHASE, "guard"),
}
"""By kind: the routine that lasts, and its loop."""


def loop_levels(world: World, machines: Iterable[Object]) -> dict[str, float]:
    """How loud each loop is, 0 to 1. ``machines``: the launchers, floor guards and laser drones of the world."""
    levels = dict.fromkeys(LOOPS, 0.0)
    ninja = world.ninja
    vx, vy = ninja.x - ninja.prev_x, ninja.y - ninja.prev_y
    if ninja.state == states.SKIDDING:
        levels["skid"] = _percent(100 * abs(vx * -ninja.floor_y + vy * ninja.floor_x))
    elif ninja.state == states.SLIDING:
        levels["slide"] = _percent(70 * abs(vy))
    for machine in machines:
        routine, name = _LASTING[machine.kind]
        if machine.routine == routine:
            levels[name] = 1.0
    return levels


def _percent(value: float) -> float:
    """A volume in whole per cent, as a share."""
    return min(100, floor(value)) / 100
