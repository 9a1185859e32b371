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
from copy import deepcopy
from dataclasses import dataclass, field
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninja_game.backend.compiled import WORK_SLICE
from ninja_game.backend.layout import WorldArray
from ninja_game.backend.memories import open_worlds
from ninja_game.batch.thread_pool import thread_count, thread_pool, whole_number
from ninja_game.errors import ArgumentError
from ninja_game.sim.digest import state_digest, world_digest
from ninja_game.sim.inputs import ALL_KEYS, JUMP_HELD, JUMP_PRESSED, KEYS_DOWN
from ninja_game.sim.kinds import KINDS
from ninja_game.sim.level import Body, Level, is_box
from ninja_game.sim.schema.declare import fields_of
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import OUTCOME_NAMES

Keys = NDArray[np.uint8]  # keys that are down, one byte per tick or choice: a sum of left, right and jump

__all__ = ["OBJECT_FIELDS", "OUTCOME_NAMES", "Batch", "BatchState"]

Indices = NDArray[np.intp]  # indices of worlds or levels

WorldChoice: TypeAlias = int | slice | Sequence[int] | Sequence[bool] | NDArray[np.intp] | NDArray[np.bool_] | None
"""Worlds: by number, a slice of numbers, or one truth value per world; None for all of them."""

OBJECT_FIELDS = {kind.name: tuple(member.name for member in fields_of(kind.fields)) for kind in KINDS}
"""The fields of ``Batch.objects`` that a kind has, by its name; the other fields hold data of other kinds."""


@dataclass(frozen=True, eq=False)
class BatchState:
    """Saved worlds, for batches of equal levels, body and memory. ``levels``: their levels."""

    levels: Indices
    states: Any = field(repr=False)
    owner: tuple[Any, ...] = field(repr=False)


class Batch:
    """``count`` worlds, world i in level i modulo the number of levels.

    ``levels``: one level or several. ``memory``: "compiled", "plain" (slow, needs no Numba) or "auto". ``threads``:
    most threads at once, by default one per core; results never depend on it.

    Observations are read-only views, not copies: they show the worlds as they are now. Shapes, dtypes, units:

    ============  ==================  ======================================================================
    positions     (count, 2) float64  the ninja's centre x, y, px, y downwards
    previous      (count, 2) float64  the same a tick ago; the velocity is the difference, px/tick
    states        (count,) int32      the ninja's state number (`sim/states.py`)
    outcomes      (count,) int32      0 running, 1 exit, 2 dead: what came first
    gold, ticks   (count,) int32      pieces collected; ticks run
    levels_now    (count,) intp       which level each world plays
    objects       (count, slots)      all objects by slot; which fields a kind has: ``OBJECT_FIELDS``;
                                      slot 0 and slots from ``used`` on are nobody
    places        (count, slots, 2)   their x, y as float64, px
    used          (count,) int32      slots in use
    records       (count,)            everything: the worlds themselves
    ============  ==================  ======================================================================

    Raises LevelError for a level that cannot be played, ArgumentError for another body or memory, no level, world
    or thread, MemoryUnavailableError for "compiled" without Numba.
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
        # A text is a sequence too: report it as one wrong level, not letter by letter.
        self.levels = [levels] if isinstance(levels, (Level, str)) else list(levels)
        if not self.levels:
            raise ArgumentError("0 levels; expected at least one")
        self.count = whole_number("count", count)
        self.threads = thread_count(threads)
        self.body = body
        self._worlds = open_worlds(memory, self.levels, count, box=is_box(body))
        self.memory = self._worlds.name
        self._make_views()

    def __repr__(self) -> str:
        return f"<Batch of {self.count} worlds in {len(self.levels)} levels, {self.body}, {self.memory}>"

    def __getstate__(self) -> dict[str, Any]:
        return {name: vars(self)[name] for name in ("levels", "count", "body", "threads", "_worlds", "memory")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self._make_views()

    def __copy__(self) -> Batch:
        return deepcopy(self)

    def _make_views(self) -> None:
        self.records: WorldArray = self._worlds.records.view()
        self.levels_now: Indices = np.asarray(self._worlds.level_of).view()
        self.records.flags.writeable = self.levels_now.flags.writeable = False
        ninja = self.records["ninja"]
        self.positions = pairs(ninja["x"])
        self.previous = pairs(ninja["prev_x"])
        self.states: NDArray[np.int32] = ninja["state"]
        self.outcomes: NDArray[np.int32] = self.records["outcome"]
        self.gold: NDArray[np.int32] = self.records["gold"]
        self.ticks: NDArray[np.int32] = self.records["tick"]
        self.used: NDArray[np.int32] = self.records["slots_used"]
        objects = self.records["objects"]
        capacity = (self.records.strides[0] - (objects.ctypes.data - self.records.ctypes.data)) // objects.strides[1]
        self.objects: WorldArray = objects[:, :capacity]
        self.places = pairs(self.objects["x"])

    def velocities(self) -> NDArray[np.float64]:
        """Velocities of the ninjas, (count, 2), px/tick, as a new array."""
        return np.subtract(self.positions, self.previous)

    # --- time ---

    def step(self, inputs: ArrayLike, *, press: bool = False) -> None:
        """Run one tick of every world; ``inputs`` (count,): sums of ``Input`` flags (``press``: as in ``run``)."""
        row = np.asarray(inputs)
        if row.shape != (self.count,):
            raise ArgumentError(f"inputs are of shape {row.shape}; expected ({self.count},), the keys of each world")
        self.run(row[np.newaxis], press=press)

    def run(self, inputs: ArrayLike, *, stop: bool = False, press: bool = False) -> int:
        """Run many ticks of every world, ``inputs`` (ticks, count); gives the number of ticks run, over all worlds.

        ``stop``: a world stops after its exit contact or death; else it goes on, as single worlds do. ``press``: jump
        is pressed, as on a keyboard, in a tick in which it is held and was not held before; else a jump needs both
        ``Input.JUMP_HELD`` and ``Input.JUMP_PRESSED``. Raises ArgumentError for other shapes and other numbers.
        """
        rows = np.asarray(inputs)
        if (
            rows.ndim != 2
            or rows.shape[1] != self.count
            or not (np.issubdtype(rows.dtype, np.integer) or not rows.size)
        ):
            found = f"{rows.dtype} of shape {rows.shape}"
            raise ArgumentError(f"inputs are {found}; expected integers, {self.count} a tick")
        if rows.size and not 0 <= rows.min() <= rows.max() <= ALL_KEYS:
            raise ArgumentError(f"inputs are {rows.min()} to {rows.max()}; expected sums of Input, 0 to {ALL_KEYS}")
        # Writable, since Numba would compile a kernel again for read-only arrays.
        keys = np.require(rows, np.uint8, ["C", "W"])
        keys = self._with_presses(keys) if press else keys
        worlds, ticks = self._worlds, 0
        # Python threads share one lock, so the plain memory uses one; Ctrl-C is only handled between kernel calls.
        pool = thread_pool(self.threads if self.memory == "compiled" else 1)
        ticks_at_once = max(1, 8 * WORK_SLICE // (worlds.slots * self.count))
        for begin in range(0, len(keys), ticks_at_once):
            part = keys[begin : begin + ticks_at_once]
            work = partial(worlds.run_batch, part, stop=stop)
            ticks += pool.share(work, self.count, len(part))
        return ticks

    def _with_presses(self, keys: Keys) -> Keys:
        """Set JUMP_PRESSED in every tick in which the jump key goes down, and clear it in all others."""
        held = keys & JUMP_HELD
        before = np.vstack([self.records["ninja"]["jump_held"].astype(np.uint8) * JUMP_HELD, held[:-1]])
        pressed: NDArray[np.uint8] = np.where(held > before, np.uint8(JUMP_PRESSED), np.uint8(0))
        return keys & np.uint8(KEYS_DOWN) | pressed

    # --- single worlds ---

    def reset(self, worlds: WorldChoice = None, levels: WorldChoice = None) -> None:
        """Start worlds afresh, in their present levels or in the given ones."""
        numbers = numbers_of(worlds, self.count, "worlds")
        chosen = self.levels_now[numbers] if levels is None else numbers_of(levels, len(self.levels), "levels")
        if len(chosen) not in (1, len(numbers)):
            raise ArgumentError(f"{len(chosen)} levels for {len(numbers)} worlds; expected one, or one for each")
        self._worlds.load(numbers.tolist(), np.broadcast_to(chosen, numbers.shape).tolist())

    def save(self, worlds: WorldChoice = None) -> BatchState:
        """Save the states of worlds, for ``restore``."""
        numbers = numbers_of(worlds, self.count, "worlds")
        return BatchState(self.levels_now[numbers], self._worlds.save_many(numbers), self._owner())

    def restore(self, state: BatchState, worlds: WorldChoice = None) -> None:
        """Put as many saved states into worlds, the same or others. Raises ArgumentError if they do not fit."""
        numbers = numbers_of(worlds, self.count, "worlds")
        if state.owner != self._owner() or len(state.levels) != len(numbers):
            raise ArgumentError(f"{len(state.levels)} saved worlds do not fit {len(numbers)} of this batch")
        self._worlds.restore_many(state.states, numbers, state.levels)

    def copy(self, sources: WorldChoice, targets: WorldChoice) -> None:
        """Copy the states of worlds ``sources`` into as many worlds ``targets``."""
        self.restore(self.save(sources), targets)

    def world(self, index: int) -> World:
        """Copy one world to plain objects, to read its fields."""
        return self._worlds.world(index)

    def digest(self, index: int) -> str:
        """The sha256 (hex) of one world in canonical form, as ``Simulation.digest``."""
        return world_digest(self.world(index))

    def state_digests(self, worlds: WorldChoice = None) -> list[str]:
        """The sha256 (hex) of the worlds' states (``state_digest``), computed once for equal worlds."""
        known: dict[bytes, str] = {}
        digests = []
        for index in numbers_of(worlds, self.count, "worlds").tolist():
            key = self._worlds.states[index].tobytes()
            if key not in known:
                known[key] = state_digest(self.world(index))
            digests.append(known[key])
        return digests

    def _owner(self) -> tuple[Any, ...]:
        return self.levels, self.body, self.memory


def numbers_of(choice: WorldChoice, count: int, what: str) -> Indices:
    """The chosen indices below ``count``, intp. Raises ArgumentError for an invalid choice."""
    all_indices = np.arange(count, dtype=np.intp)
    if choice is None:
        return all_indices
    if isinstance(choice, slice):
        return all_indices[choice]
    chosen = np.asarray(choice)
    if chosen.dtype == np.bool_:
        if chosen.shape != (count,):
            raise ArgumentError(f"{what} are chosen by {chosen.size} truth values; expected {count}, one for each")
        return np.flatnonzero(chosen)
    if chosen.ndim > 1 or not (np.issubdtype(chosen.dtype, np.integer) or not chosen.size):
        expected = "numbers, a slice, or a truth value for each"
        raise ArgumentError(f"{what} are chosen by {choice!r:.40}; expected {expected}")
    if chosen.size and not -count <= chosen.min() <= chosen.max() < count:
        raise ArgumentError(f"{what} are {chosen.min()} to {chosen.max()}; expected numbers below {count}")
    return np.atleast_1d(all_indices[chosen.astype(np.intp)])


def pairs(first: NDArray[np.float64]) -> NDArray[np.float64]:
    """View these numbers and those 8 bytes behind them in memory, as pairs: x and y."""
    return np.lib.stride_tricks.as_strided(first, (*first.shape, 2), (*first.strides, 8), writeable=False)
