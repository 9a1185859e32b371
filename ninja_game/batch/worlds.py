"""The worlds of a batch on either memory: loaded, run, saved and copied by number.

Both keep them in one block as records (sim/memory/layout.py): the compiled memory runs in it, the plain one copies
what it did into it, so that observations look the same.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import Any, Protocol, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import compiled
from ninja_game.batch.kernels import run_worlds
from ninja_game.batch.thread_pool import thread_pool
from ninja_game.sim.kinds import KINDS
from ninja_game.sim.level import Level
from ninja_game.sim.memory.compiled import SLICE, load_worlds
from ninja_game.sim.memory.declare import fields_of
from ninja_game.sim.memory.interface import MemoryName
from ninja_game.sim.memory.layout import OBJECT, OBJECTS_START, STATE_START, Records, new_worlds, plain_copy
from ninja_game.sim.memory.plain import WORLD_SCALARS, load_plain, restore_plain, save_plain
from ninja_game.sim.memory.schema import Ninja, World

Numbers = NDArray[np.intp]
"""Numbers of worlds or levels."""

R = TypeVar("R")
Kernel: TypeAlias = Callable[..., R]


class Worlds(Protocol):
    """What a batch asks of a memory.

    ``records``: the worlds as an array of records, in one block. ``states``: the same as a matrix of bytes, without
    the events. ``maps``, ``fresh`` and ``worlds``: the levels, a new world in each, which nobody changes, and the
    worlds, as kernels take them: arrays of records, or lists of plain objects.
    """

    records: Records
    states: NDArray[np.uint8]
    maps: Any
    fresh: Any
    worlds: Any

    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        """The form of an entry point that takes ``maps`` and ``worlds``: its compiled twin, or itself."""

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
    """The states in a block as a matrix of bytes, one row per world, without events; a view."""
    return np.ndarray((len(records), records.strides[0]), np.uint8, records.base)[:, STATE_START:]


class CompiledWorlds:
    """Worlds of the compiled memory. Every level is loaded once; a fresh world is a copy of bytes."""

    def __init__(self, levels: Sequence[Level], count: int, box: bool) -> None:
        self.maps, loaded = load_worlds(compiled, levels, box=box)
        slots = int(loaded["slots_used"].max())
        self.fresh, self.worlds = block_of(len(levels), slots), block_of(count, slots)
        self.records = self.worlds[:count]
        self.states, self._fresh_bytes = bytes_of(self.worlds), bytes_of(self.fresh)
        # A malformed exit has room for its switch, and does not use it.
        self._fresh_bytes[: len(levels)] = bytes_of(loaded)[:, : self.states.shape[1]]
        self._ticks_at_once = max(1, 8 * SLICE // (slots * count))

    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        """The compiled twin."""
        return compiled(entry)

    def load(self, worlds: Numbers, levels: Numbers) -> None:
        """Start worlds afresh, each in the level of that number."""
        for index, number in zip(worlds.tolist(), levels.tolist(), strict=True):
            self.states[index] = self._fresh_bytes[number]
        self.records["event_count"][worlds] = 0

    def run(self, inputs: NDArray[np.uint8], level_of: Numbers, stop: bool, threads: int) -> int:
        """Run all worlds for all rows of ``inputs``, on all threads."""
        kernel = compiled(run_worlds)
        ticks = 0
        for begin in range(0, len(inputs), self._ticks_at_once):
            rows = inputs[begin : begin + self._ticks_at_once]

            def work(first: int, last: int, rows: NDArray[np.uint8] = rows) -> int:
                return kernel(self.maps, level_of, self.worlds, rows, first, last, int(stop))

            ticks += thread_pool(threads).share(work, len(self.records), len(rows))
        return ticks

    def save(self, worlds: Numbers) -> NDArray[np.uint8]:
        """The states of worlds as a matrix of bytes."""
        return self.states[worlds]

    def restore(self, worlds: Numbers, states: Any, levels: Numbers) -> None:  # noqa: ARG002
        """Put worlds back to states that ``save`` gave for as many; a state holds its level's objects."""
        self.states[worlds] = states
        self.records["event_count"][worlds] = 0

    def world(self, index: int) -> World:
        """One world as plain objects: a copy."""
        return plain_copy(self.records, index)


_SCALARS = [(field.name, attrgetter(field.name)) for field in WORLD_SCALARS]
_NINJA = attrgetter(*(field.name for field in fields_of(Ninja)))
_KIND_FIELDS = {kind.number: [field.name for field in fields_of(kind.fields)] for kind in KINDS}
_KIND_VALUES = {number: attrgetter(*names) for number, names in _KIND_FIELDS.items()}


class PlainWorlds:
    """Worlds of the plain memory, for where Numba is missing.

    ``records`` shows them as they were after the last call; what a kernel does by itself is not shown.
    """

    def __init__(self, levels: Sequence[Level], count: int, box: bool) -> None:
        self._levels = levels
        self._box = box
        fresh = [load_plain(level, box) for level in levels]
        self.maps = [tiles for tiles, _ in fresh]
        self.fresh = [w for _, w in fresh]
        self._fresh_states = [save_plain(w) for w in self.fresh]
        self.worlds = [load_plain(levels[0], box)[1] for _ in range(count)]
        self._playing = [0] * count
        block = block_of(count, max(w.slots_used for _, w in fresh))
        self.records = block[:count]
        self.states = bytes_of(block)

    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        """The entry point itself."""
        return entry

    def load(self, worlds: Numbers, levels: Numbers) -> None:
        """Start worlds afresh, each in the level of that number."""
        self.restore(worlds, [self._fresh_states[number] for number in levels.tolist()], levels)

    def run(self, inputs: NDArray[np.uint8], level_of: Numbers, stop: bool, threads: int) -> int:  # noqa: ARG002
        """Run all worlds for all rows of ``inputs``, one after the other: the interpreter has one lock."""
        ticks = run_worlds(self.maps, level_of, self.worlds, inputs, 0, len(self.worlds), int(stop))
        for index in range(len(self.worlds)):
            self._show(index)
        return ticks

    def save(self, worlds: Numbers) -> list[Any]:
        """The states of worlds as tuples."""
        return [save_plain(self.worlds[index]) for index in worlds.tolist()]

    def restore(self, worlds: Numbers, states: Any, levels: Numbers) -> None:
        """Put worlds back to states that ``save`` gave for as many; a world of another level is made again."""
        for index, state, number in zip(worlds.tolist(), states, levels.tolist(), strict=True):
            if self._playing[index] != number:
                self.worlds[index] = load_plain(self._levels[number], self._box)[1]
                self._playing[index] = number
                self.states[index] = 0
            restore_plain(self.worlds[index], state)
            self._show(index)

    def world(self, index: int) -> World:
        """One world as plain objects: the world itself."""
        return self.worlds[index]

    def _show(self, index: int) -> None:
        """Copy a world into its record."""
        w = self.worlds[index]
        record = self.records[index]
        for name, value in _SCALARS:
            record[name] = value(w)
        record["ninja"] = _NINJA(w.ninja)
        record["heads"] = w.heads
        record["edges"] = w.edges
        objects = np.ndarray((w.slots_used,), OBJECT, self.states[index], OBJECTS_START - STATE_START)
        for slot, o in enumerate(w.objects[: w.slots_used]):
            if slot:
                objects[_KIND_FIELDS[o.kind]][slot] = _KIND_VALUES[o.kind](o)


def make_worlds(memory: MemoryName, levels: Sequence[Level], count: int, *, box: bool) -> Worlds:
    """``count`` worlds of a memory, not loaded yet. Raises LevelError for a level that cannot be played."""
    return (CompiledWorlds if memory == "compiled" else PlainWorlds)(levels, count, box)
