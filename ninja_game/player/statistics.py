"""What killed the player how often, and how much was played (game.md §8). Live play only, never replays."""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

from ninja_game.player.store import Store
from ninja_game.sim.events import DIED, MINE_EXPLODED
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, THWUMP
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import BULLET, ELECTRIC, EXPLOSIVE, HARD_BULLET, LASER, WEAK_BULLET, WEAPON_ZAP

SELF = "player"
"""Falls, being crushed, suicide, time."""

ZAP_DRONE, THWUMP_KILLER, GUARD = "zap drone", "thwump", "floor guard"
MINE_KILLER, ROCKET, TURRET = "mine", "homing rocket", "gauss turret"
LASER_DRONE, CHAINGUN_DRONE = "laser drone", "chaingun drone"
KILLERS = (ZAP_DRONE, LASER_DRONE, CHAINGUN_DRONE, THWUMP_KILLER, ROCKET, GUARD, TURRET, MINE_KILLER, SELF)

_BY_KILL_TYPE = {LASER: LASER_DRONE, BULLET: CHAINGUN_DRONE, HARD_BULLET: TURRET, WEAK_BULLET: TURRET}
_ELECTRIC_KINDS = {THWUMP: THWUMP_KILLER, FLOOR_GUARD: GUARD, DRONE: ZAP_DRONE}


def killer_of(world: World) -> str:
    """What killed the ninja in the world's last tick, one of KILLERS.

    The world says how, not who: an electric death is the nearest electric thing's.
    """
    events = world.events[: world.event_count]
    death = next((event for event in events if event.kind == DIED), None)
    if death is None:
        return SELF
    if death.slot == EXPLOSIVE:
        mine = any(e.kind == MINE_EXPLODED and (e.x, e.y) == (death.x, death.y) for e in events)
        return MINE_KILLER if mine else ROCKET
    if death.slot == ELECTRIC:
        return _nearest_electric(world, death.x, death.y)
    return _BY_KILL_TYPE.get(death.slot, SELF)


def _nearest_electric(world: World, x: float, y: float) -> str:
    electric = [
        thing
        for thing in world.objects[1:]
        if thing.kind in (THWUMP, FLOOR_GUARD) or (thing.kind == DRONE and thing.weapon == WEAPON_ZAP)
    ]
    if not electric:
        return SELF
    return _ELECTRIC_KINDS[min(electric, key=lambda thing: hypot(thing.x - x, thing.y - y)).kind]


class Played(NamedTuple):
    """How much was played, in all or of a level: attempts, passes, deaths, ticks in play, pieces of gold."""

    attempts: int = 0
    passes: int = 0
    deaths: int = 0
    ticks: int = 0
    gold: int = 0


class Statistics:
    """Counts in a store."""

    def __init__(self, store: Store) -> None:
        self.store = store

    def attempt_ended(self, level: str, *, killer: str | None, passed: bool, ticks: int, gold: int) -> None:
        """Count an attempt at a level (its digest) that ended: passed, killed by ``killer``, or given up.

        Raises sqlite3.Error.
        """
        with self.store.change() as db:
            db.execute(
                "INSERT INTO played (level, attempts, passes, deaths, ticks, gold) VALUES (?, 1, ?, ?, ?, ?)"
                " ON CONFLICT (level) DO UPDATE SET"
                " attempts = attempts + 1, passes = passes + excluded.passes, deaths = deaths + excluded.deaths,"
                " ticks = ticks + excluded.ticks, gold = gold + excluded.gold",
                (level, int(passed), int(killer is not None), ticks, gold),
            )
            if killer is not None:
                db.execute(
                    "INSERT INTO death (killer, times) VALUES (?, 1)"
                    " ON CONFLICT (killer) DO UPDATE SET times = times + 1",
                    (killer,),
                )

    def deaths(self) -> dict[str, int]:
        """Deaths by killer, every killer present, in the order of KILLERS."""
        found = dict(self.store.rows("SELECT killer, times FROM death", (), [str, int]))
        return {killer: found.get(killer, 0) for killer in KILLERS}

    def played(self, level: str | None = None) -> Played:
        """How much was played: of one level (its digest) or in all."""
        query = "SELECT attempts, passes, deaths, ticks, gold FROM played WHERE ?1 IS NULL OR level = ?1"
        return Played(*map(sum, zip(*self.store.rows(query, (level,), [int] * 5), strict=True)))
