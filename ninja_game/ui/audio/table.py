"""The sounds of the game: the files and loudness of each event, and the loops of lasting states."""

from __future__ import annotations

from collections.abc import Iterable
from math import floor

from ninja_game.sim import events, states
from ninja_game.sim.events import DIED
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, LAUNCHER, TURRET
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import Event, Ninja, World

Names = tuple[str, ...]  # variants of a sound, chosen at random, never the same twice in a row


def variants(name: str, count: int) -> Names:
    return tuple(f"{name}-{number}" for number in range(1, count + 1))


PING = variants("gold", 12)  # gold, from low to high

STEPS = variants("step", 5)

LANDING = ((4.0, variants("land-hard", 3)), (2.0, variants("land-medium", 3)), (0.0, variants("land-soft", 3)))
CORPSE = ((3.0, variants("corpse-hard", 3)), (2.0, variants("corpse-medium", 2)), (1.2, variants("corpse-soft", 2)))
"""Least speed (px/tick) of each hardness, hardest first; for the ninja's feet, and for parts of a corpse."""

BY_EVENT: dict[int, Names] = {
    events.JUMPED: variants("jump", 4),
    events.WALL_JUMPED: variants("wall-jump", 4),
    events.LANDED: LANDING[-1][1],
    events.LAUNCHED: ("launch",),
    events.WON: ("passed",),
    events.GOLD_TAKEN: PING,
    events.MINE_EXPLODED: variants("mine", 2),
    events.EXIT_OPENED: ("exit-open",),
    events.DOOR_OPENED: ("door-open",),
    events.DOOR_CLOSED: ("door-close",),
    events.LOCK_OPENED: ("lock-open",),
    events.TRAP_CLOSED: ("trap-close",),
    events.CHASE_STARTED: ("chase",),
    events.ROCKET_LAUNCHED: ("rocket-launch",),
    events.ROCKET_EXPLODED: variants("rocket-explode", 2),
    events.TURRET_LOCKED: ("turret-lock",),
    events.TURRET_FIRED: variants("turret-fire", 2),
    events.LASER_CHARGING: ("laser-charge",),
    events.CHAINGUN_CHARGING: ("chaingun-charge",),
    events.CHAINGUN_SHOT: variants("chaingun-shot", 3),
    events.CHAINGUN_OFF: ("chaingun-off",),
}

BY_DEATH: dict[int, Names] = {
    states.EXPLOSIVE: variants("death-explosive", 2),
    states.FALL: ("death-fall",),
    states.LASER: ("death-laser",),
    states.ELECTRIC: ("death-electric",),
}
OTHER_DEATH = variants("death-bullet", 2)


def by_hardness(table: tuple[tuple[float, Names], ...], speed: float) -> Names:
    """The sounds of a hit at a speed, px/tick; none for a slower one."""
    return next((names for slowest, names in table if speed > slowest), ())


def event_sound(event: Event, ninja: Ninja) -> tuple[Names, float]:
    """The sounds of an event, and how loud it is, a share."""
    if event.kind == DIED:
        return BY_DEATH.get(event.cause, OTHER_DEATH), 1.0
    if event.kind == events.LANDED:
        speed = abs(event.dx * ninja.floor_x + event.dy * ninja.floor_y)
        return by_hardness(LANDING, speed) or BY_EVENT[events.LANDED], min(1.0, 0.5 + speed / 8)
    level = 1.0
    if event.kind in (events.JUMPED, events.WALL_JUMPED):
        level = min(1.0, 0.4 + 0.1 * (abs(ninja.x - ninja.prev_x) + abs(ninja.y - ninja.prev_y)))
    return BY_EVENT.get(event.kind, ()), level


LOOPS: dict[str, Names] = {
    "skid": variants("skid", 3),
    "slide": variants("slide", 3),
    "rocket-flight": ("rocket-flight",),
    "laser-beam": ("laser-beam",),
    "guard": ("guard",),
}
"""Looped sounds, with their variants. Each has its own channel."""

_LASTING = {
    LAUNCHER: (states.LAUNCHER_FLIGHT, "rocket-flight"),
    DRONE: (states.DRONE_FIRING, "laser-beam"),
    FLOOR_GUARD: (states.GUARD_CHASE, "guard"),
}
"""The lasting routine of a kind, and its loop, by kind."""


def has_loop(o: Object) -> bool:
    return o.kind in (LAUNCHER, FLOOR_GUARD) or (o.kind == DRONE and o.weapon == states.WEAPON_LASER)


def loop_levels(world: World, machines: Iterable[Object]) -> dict[str, float]:
    """Loudness of each loop, 0 to 1. ``machines``: the launchers, floor guards and laser drones of the world."""
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


def warning_of(o: Object) -> str:
    """The danger that an object's sounds announce: "rocket", "weapon", "chase", "turret"; "" for none."""
    kind, routine = o.kind, o.routine
    if kind == LAUNCHER and routine in (states.LAUNCHER_PREPARE, states.LAUNCHER_FLIGHT):
        return "rocket"
    if kind == DRONE and routine in (states.DRONE_PRE_FIRE, states.DRONE_FIRING):
        return "weapon"
    if (kind == DRONE and o.chasing) or (kind == FLOOR_GUARD and routine == states.GUARD_CHASE):
        return "chase"
    if kind == TURRET and (o.think == states.TURRET_TARGETING or routine == states.TURRET_PRE_FIRE):
        return "turret"
    return ""


def _percent(value: float) -> float:
    """A volume in whole per cent, as a share."""
    return min(100, floor(value)) / 100
