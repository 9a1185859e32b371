"""How much was played, and what killed the ninja how often."""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.player.store import Store
from ninja_game.sim.events import DIED
from ninja_game.sim.kinds import DRONE, KIND_OF, KINDS
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import NO_CAUSE, WEAPON_CHAINGUN, WEAPON_LASER, WEAPON_ZAP

SELF = "player"
"""Falls, being crushed, suicide, time."""

_DRONES = {WEAPON_ZAP: "zap drone", WEAPON_LASER: "laser drone", WEAPON_CHAINGUN: "chaingun drone"}
KILLERS = (*_DRONES.values(), *(kind.killer for kind in KINDS if kind.killer and kind.number != DRONE), SELF)


def cause_of(world: World) -> int:
    """The cause of the ninja's death in the world's last tick, as in ``sim.states``; NO_CAUSE where it did not die."""
    return next((event.cause for event in world.events[: world.event_count] if event.kind == DIED), NO_CAUSE)


def killer_of(world: World) -> str:
    """What killed the ninja in the world's last tick, one of KILLERS."""
    slot = next((event.slot for event in world.events[: world.event_count] if event.kind == DIED), 0)
    if not slot:
        return SELF
    killer = world.objects[slot]
    return _DRONES[killer.weapon] if killer.kind == DRONE else KIND_OF[killer.kind].killer


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
