"""Sounds that depend on the ones before: variants that do not repeat, gold that climbs, steps at the pace of a run."""

from __future__ import annotations

from random import Random

from ninja_game.sim.memory.schema import Ninja
from ninja_game.sim.states import RUNNING
from ninja_game.ui.audio.table import Names

CHAIN_TICKS = 60
"""Gold within so many ticks after the piece before it climbs."""

STRIDE = 32.4
"""From one footstep to the next, px: half a cycle of the drawn legs (view/ninja/figure.py)."""


class Variants:
    """Chooses a variant of a sound, never the same twice in a row."""

    def __init__(self) -> None:
        self._rng = Random()  # noqa: S311 - which thud it is, is no secret
        self._last: dict[Names, str] = {}

    def choose(self, names: Names) -> str:
        """One of these names."""
        others = [name for name in names if name != self._last.get(names)]
        self._last[names] = self._rng.choice(others or names)
        return self._last[names]


class GoldLadder:
    """The rung of each piece of gold: one higher in a chain, to the top; the lowest one after a pause or a restart."""

    def __init__(self, rungs: int) -> None:
        self.top = rungs - 1
        self._rung, self._tick = -1, -1

    def climb(self, tick: int) -> int:
        """The rung of gold that is taken in this tick, 0 and up."""
        chained = self._rung >= 0 and 0 <= tick - self._tick <= CHAIN_TICKS
        self._rung = min(self._rung + 1, self.top) if chained else 0
        self._tick = tick
        return self._rung


class Footsteps:
    """Tells when a foot is put down. The first step of a run comes after half a stride."""

    def __init__(self) -> None:
        self._way = STRIDE / 2

    def loudness(self, ninja: Ninja) -> float:
        """How loud the step of this tick is, a share by speed; 0: there is none. To be called every tick."""
        if ninja.state != RUNNING:
            self._way = STRIDE / 2
            return 0.0
        speed = abs((ninja.x - ninja.prev_x) * -ninja.floor_y + (ninja.y - ninja.prev_y) * ninja.floor_x)
        self._way += speed
        if self._way < STRIDE:
            return 0.0
        self._way -= STRIDE
        return min(1.0, 0.4 + speed / 6)
