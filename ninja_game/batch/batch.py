"""Many worlds in one block of memory, stepped together on all cores.

>>> from ninja_game import parse_level
>>> from ninja_game.batch.batch import Batch
>>> batch = Batch(parse_level("0" * 713 + "|5^100,566!11^160,564,130,564"), 4)
>>> for _ in range(10):
...     batch.step([0, 1, 2, 2])
>>> batch.positions[:, 0].round(2).tolist()
[100.0, 93.49, 106.51, 106.51]
>>> start = batch.save([2])
>>> batch.run([[2] * 4] * 30, stop=True), [OUTCOME_NAMES[number] for number in batch.outcomes]
(82, ['exit', 'running', 'exit', 'exit'])
>>> batch.restore(start, [3])
>>> batch.ticks.tolist()
[34, 40, 24, 10]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninja_game.batch.thread_pool import cores
from ninja_game.batch.worlds import CompiledWorlds, Numbers, PlainWorlds, Worlds
from ninja_game.compile_cache import choose_memory
from ninja_game.sim.digest import world_digest
from ninja_game.sim.level import Level
from ninja_game.sim.memory.layout import Records
from ninja_game.sim.memory.schema import World
from ninja_game.sim.states import OUTCOME_NAMES
from ninja_game.simulation import BODIES, Body

__all__ = ["OUTCOME_NAMES", "Batch", "BatchState"]

Which: TypeAlias = int | Sequence[int] | Numbers | None
"""Numbers of worlds; None: all of them."""


@dataclass(frozen=True)
class BatchState:
    """Saved worlds of a batch: only good for batches of the same levels, body and memory. ``levels``: their levels."""

    levels: Numbers
    states: Any
    owner: tuple[Any, ...]


class Batch:
    """``count`` worlds, world i in level i modulo the number of levels.

    ``levels``: what to play, one level or several. ``memory``: "compiled", "plain" (slow, needs no Numba) or "auto".
    ``threads``: how many may run at once, by default as many as there are cores; results never depend on it.

    Observations are views, not copies: they show the worlds as they are now, after every call. Shapes, dtypes, units:

    ============  ==================  ======================================================================
    positions     (count, 2) float64  the ninja's centre x, y, px, y downwards
    previous      (count, 2) float64  the same a tick ago; the velocity is the difference, px/tick
    states        (count,) int32      the ninja's state number (`sim/states.py`)
    outcomes      (count,) int32      0 running, 1 exit, 2 dead: what came first
    gold, ticks   (count,) int32      pieces collected; ticks run
    levels_now    (count,) intp       which level each world plays
    objects       (count, slots)      all objects by slot (sim/memory/schema.py): ``kind``, ``id``, ``x``, ``y`` …;
                                      slot 0 and slots from ``used`` on are nobody
    places        (count, slots, 2)   their x, y as float64, px
    used          (count,) int32      slots in use
    records       (count,)            everything: the worlds themselves
    ============  ==================  ======================================================================

    Raises LevelError for a level that cannot be played, MemoryUnavailableError for "compiled" without Numba.
    """

    def __init__(
        self,
        levels: Level | Sequence[Level],
        count: int,
        *,
        body: Body = "circle",
        memory: str = "auto",
        threads: int | None = None,
    ) -> None:
        self.levels = [levels] if isinstance(levels, Level) else list(levels)
        if count < 1 or not self.levels:
            raise ValueError(f"{count} worlds in {len(self.levels)} levels; expected at least one of each")
        if body not in BODIES:
            raise ValueError(f"body is {body!r}; expected 'circle' or 'box'")
        self.count = count
        self.body = body
        self.memory = choose_memory(memory)
        self.threads = threads or cores()
        make = CompiledWorlds if self.memory == "compiled" else PlainWorlds
        self._worlds: Worlds = make(self.levels, count, body == "box")
        self.records: Records = self._worlds.records
        self.levels_now: Numbers = np.arange(count, dtype=np.intp) % len(self.levels)
        self._look()
        self.reset()

    def _look(self) -> None:
        """Make the views."""
        ninja = self.records["ninja"]
        self.positions = pairs(ninja["x"])
        self.previous = pairs(ninja["prev_x"])
        self.states: NDArray[np.int32] = ninja["state"]
        self.outcomes: NDArray[np.int32] = self.records["outcome"]
        self.gold: NDArray[np.int32] = self.records["gold"]
        self.ticks: NDArray[np.int32] = self.records["tick"]
        self.used: NDArray[np.int32] = self.records["slots_used"]
        objects = self.records["objects"]
        room = (self.records.strides[0] - (objects.ctypes.data - self.records.ctypes.data)) // objects.strides[1]
        self.objects: Records = objects[:, :room]
        self.places = pairs(self.objects["x"])

    def velocities(self) -> NDArray[np.float64]:
        """Velocities of the ninjas, (count, 2), px/tick: a new array."""
        return np.subtract(self.positions, self.previous)

    # --- time ---

    def step(self, inputs: ArrayLike) -> None:
        """One tick of every world; ``inputs`` (count,): the keys of each, a sum of ``Input`` flags."""
        self.run(np.asarray(inputs)[np.newaxis])

    def run(self, inputs: ArrayLike, *, stop: bool = False) -> int:
        """Many ticks of every world, ``inputs`` (ticks, count); the number of ticks run, over all worlds.

        ``stop``: worlds whose exit contact or death has been stand still; else they go on, as single worlds do.
        """
        rows = np.asarray(inputs)
        if rows.ndim != 2 or rows.shape[1] != self.count or not np.issubdtype(rows.dtype, np.integer):
            raise ValueError(f"inputs are {rows.dtype} of shape {rows.shape}; expected integers, {self.count} a tick")
        return self._worlds.run(np.ascontiguousarray(rows, np.uint8), self.levels_now, stop, self.threads)

    # --- single worlds ---

    def reset(self, worlds: Which = None, levels: Which = None) -> None:
        """Start worlds afresh, in the levels that they have or in those given."""
        numbers = self._numbers(worlds)
        if levels is not None:
            self.levels_now[numbers] = np.arange(len(self.levels))[np.asarray(levels)]
        self._worlds.load(numbers, self.levels_now[numbers])

    def save(self, worlds: Which = None) -> BatchState:
        """The states of worlds, to come back to."""
        numbers = self._numbers(worlds)
        return BatchState(self.levels_now[numbers], self._worlds.save(numbers), self._owner())

    def restore(self, state: BatchState, worlds: Which = None) -> None:
        """Put saved states into worlds, the same or others, as many. Raises ValueError if they do not fit."""
        numbers = self._numbers(worlds)
        if state.owner != self._owner() or len(state.levels) != len(numbers):
            raise ValueError(f"{len(state.levels)} saved worlds do not fit {len(numbers)} of this batch")
        self.levels_now[numbers] = state.levels
        self._worlds.restore(numbers, state.states, state.levels)

    def copy(self, sources: Which, targets: Which) -> None:
        """Make worlds ``targets`` what worlds ``sources`` are, as many."""
        self.restore(self.save(sources), targets)

    def world(self, index: int) -> World:
        """One world as plain objects, for looking at it."""
        return self._worlds.world(index)

    def digest(self, index: int) -> str:
        """Sha256 (hex) of one world in canonical form, as ``Simulation.digest``."""
        return world_digest(self.world(index))

    def _numbers(self, which: Which) -> Numbers:
        """Numbers of worlds as an array. Raises IndexError for a world that is not there."""
        everyone = np.arange(self.count, dtype=np.intp)
        return everyone if which is None else np.atleast_1d(everyone[np.asarray(which, np.intp)])

    def _owner(self) -> tuple[Any, ...]:
        return self.levels, self.body, self.memory


def pairs(first: NDArray[np.float64]) -> NDArray[np.float64]:
    """A view of the numbers and of those that lie 8 bytes behind them in memory: x and y."""
    return np.lib.stride_tricks.as_strided(first, (*first.shape, 2), (*first.strides, 8))
