"""The worlds of a batch on either memory: loaded, run, saved and copied by number.

Both keep them in one block as records (sim/memory/layout.py): the compiled memory runs in it, the plain one copies
what it did into it, so that observations look the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import attrgetter
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.kernels import run_worlds
from ninja_game.batch.thread_pool import thread_pool
from ninja_game.compile_cache import compiled
from ninja_game.sim.kinds import KINDS
from ninja_game.sim.level import Level
from ninja_game.sim.loader import record_table
from ninja_game.sim.memory.compiled import SLICE, load_worlds
from ninja_game.sim.memory.declare import fields_of
from ninja_game.sim.memory.layout import OBJECT, OBJECTS_START, STATE_START, Records, new_worlds, plain_copy
from ninja_game.sim.memory.plain import WORLD_SCALARS, load_plain, restore_plain, save_plain
from ninja_game.sim.memory.schema import Ninja, World
from ninja_game.sim.world import step

Numbers = NDArray[np.intp]
"""Numbers of worlds or levels."""


class Worlds(Protocol):
    """What a batch asks of a memory. ``records``: the worlds as an array of records, in one block."""

    records: Records

    def load(self, worlds: Numbers, levels: Numbers) -> None:
        """Start worlds afresh, each in the level of that number."""

    def run(self, inputs: NDArray[np.uint8], level_of: Numbers, stop: bool, threads: int) -> int:
        """Run all worlds for all rows of ``inputs``; the number of ticks run, over all worlds."""

    def save(self, worlds: Numbers) -> Any:
        """The states of worlds, unchanged by what happens later."""

    def restore(self, worlds: Numbers, states: Any, levels: Numbers) -> None:
        """Put worlds back to states that ``save`` gave for as many, in the levels that those had."""

    def world(self, index: int) -> World:
        """One world as plain objects, for looking at it."""


def block_of(count: int, slots: int) -> Records:
    """Zeroed records for worlds with room for so many slots; two worlds at least.

    An array of one counts as contiguous, which is another type and another compile.
    """
    return new_worlds(max(count, 2), slots)


def bytes_of(records: Records) -> NDArray[np.uint8]:
    """The states in a block as a matrix of bytes, a row a world, without events; a view."""
    return np.ndarray((len(records), records.strides[0]), np.uint8, records.base)[:, STATE_START:]


class CompiledWorlds:
    """Worlds of the compiled memory. Every level is loaded once; a fresh world is a copy of bytes."""

    def __init__(self, levels: Sequence[Level], count: int, box: bool) -> None:
        self._levels, self._fresh = load_worlds(compiled, levels, box=box)
        slots = int(self._fresh["slots_used"].max())
        self._block = block_of(count, slots)
        self.records = self._block[:count]
        self._bytes, self._fresh_bytes = bytes_of(self._block), bytes_of(self._fresh)
        self._ticks_at_once = max(1, 8 * SLICE // (slots * count))

    def load(self, worlds: Numbers, levels: Numbers) -> None:
        """Start worlds afresh, each in the level of that number."""
        self._put(worlds, self._fresh_bytes[levels])

    def run(self, inputs: NDArray[np.uint8], level_of: Numbers, stop: bool, threads: int) -> int:
        """Run all worlds for all rows of ``inputs``, on all threads."""
        kernel = compiled(run_worlds)
        ticks = 0
        for begin in range(0, len(inputs), self._ticks_at_once):
            rows = inputs[begin : begin + self._ticks_at_once]

            def work(first: int, last: int, rows: NDArray[np.uint8] = rows) -> int:
                return kernel(self._levels, level_of, self._block, rows, first, last, int(stop))

            ticks += thread_pool(threads).share(work, len(self.records), len(rows))
        return ticks

    def save(self, worlds: Numbers) -> NDArray[np.uint8]:
        """The states of worlds as a matrix of bytes."""
        return self._bytes[worlds]

    def restore(self, worlds: Numbers, states: Any, levels: Numbers) -> None:  # noqa: ARG002
        """Put worlds back to states that ``save`` gave for as many; a state holds its level's objects."""
        self._put(worlds, states)

    def _put(self, worlds: Numbers, states: NDArray[np.uint8]) -> None:
        """Overwrite the states of worlds; nothing has happened in their last tick."""
        self._bytes[worlds] = states
        self.records["event_count"][worlds] = 0

    def world(self, index: int) -> World:
        """One world as plain objects: a copy."""
        return plain_copy(self.records, index)


_SCALARS = [(field.name, attrgetter(field.name)) for field in WORLD_SCALARS]
_NINJA = attrgetter(*(field.name for field in fields_of(Ninja)))
_KIND_FIELDS = {kind.number: [field.name for field in fields_of(kind.fields)] for kind in KINDS}
_KIND_VALUES = {number: attrgetter(*names) for number, names in _KIND_FIELDS.items()}


class PlainWorlds:
    """Worlds of the plain memory, for where Numba is missing. ``records`` shows them as they are after each call."""

    def __init__(self, levels: Sequence[Level], count: int, box: bool) -> None:
        self._data = levels
        self._box = box
        self._states = [load_plain(levels[0], box) for _ in range(count)]
        self._playing = [0] * count
        block = block_of(count, max(record_table(level).slots for level in levels))
        self.records = block[:count]
        self._shown = bytes_of(block)

    def load(self, worlds: Numbers, levels: Numbers) -> None:
        """Start worlds afresh, each in the level of that number."""
        for index, number in zip(worlds.tolist(), levels.tolist(), strict=True):
            self._states[index] = load_plain(self._data[number], self._box)
            self._playing[index] = number
            self._shown[index] = 0
            self._show(index)

    def run(self, inputs: NDArray[np.uint8], level_of: Numbers, stop: bool, threads: int) -> int:  # noqa: ARG002
        """Run all worlds for all rows of ``inputs``, one after the other: the interpreter has one lock."""
        ticks = 0
        for index, (level, w) in enumerate(self._states):
            for keys in inputs[:, index].tolist():
                if stop and w.outcome:
                    break
                step(level, w, keys)
                ticks += 1
            self._show(index)
        return ticks

    def save(self, worlds: Numbers) -> list[Any]:
        """The states of worlds as tuples."""
        return [save_plain(self._states[index][1]) for index in worlds.tolist()]

    def restore(self, worlds: Numbers, states: Any, levels: Numbers) -> None:
        """Put worlds back to states that ``save`` gave for as many; a world of another level is made anew."""
        for index, state, number in zip(worlds.tolist(), states, levels.tolist(), strict=True):
            if self._playing[index] != number:
                self.load(np.array([index]), np.array([number]))
            restore_plain(self._states[index][1], state)
            self._show(index)

    def world(self, index: int) -> World:
        """One world as plain objects: the world itself."""
        return self._states[index][1]

    def _show(self, index: int) -> None:
        """Copy a world into its record."""
        w = self._states[index][1]
        record = self.records[index]
        for name, value in _SCALARS:
            record[name] = value(w)
        record["ninja"] = _NINJA(w.ninja)
        record["heads"] = w.heads
        record["edges"] = w.edges
        objects = np.ndarray((w.slots_used,), OBJECT, self._shown[index], OBJECTS_START - STATE_START)
        for slot, o in enumerate(w.objects):
            if slot:
                objects[_KIND_FIELDS[o.kind]][slot] = _KIND_VALUES[o.kind](o)
