"""The compiled memory: worlds as NumPy records, on which compiled kernels run."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.kernels import (
    kill_ninja,
    load_world,
    observe_object,
    run_world,
    run_worlds,
    step_world,
    trace_world,
)
from ninja_game.backend.layout import TILE_MAP, WorldArray, new_worlds, plain_copy, world_bytes, write_plain
from ninja_game.backend.worlds import (
    TRACED_FLOATS,
    TRACED_INTS,
    InitialLevel,
    InitialObject,
    Kernel,
    MemoryName,
    R,
    RunPath,
    TraceArrays,
    Worlds,
)
from ninja_game.sim.level import Level
from ninja_game.sim.loader import ObjectTable, grid_tiles, object_table
from ninja_game.sim.schema.declare import fields_of
from ninja_game.sim.schema.world_fields import MAX_EVENTS, Event, Ninja, World

Compile = Callable[[Callable[..., Any]], Callable[..., Any]]
"""Gives the compiled twin of a kernel (``memories.compiled``)."""

WORK_SLICE = 400_000
"""Ticks times objects per call of a kernel, some tens of milliseconds: Python sees Ctrl-C only between calls."""

_NinjaRow: Any = namedtuple("_NinjaRow", [field.name for field in fields_of(Ninja)])  # type: ignore[misc]  # noqa: PYI024
_EventRow: Any = namedtuple("_EventRow", [field.name for field in fields_of(Event)])  # type: ignore[misc]  # noqa: PYI024


def load_worlds(compiled: Compile, levels: Sequence[Level], *, box: bool) -> tuple[NDArray[np.void], WorldArray]:
    """Load levels, and a new world in each, as arrays of records. Raises LevelError as ``object_table`` does."""
    tables = [object_table(level) for level in levels]
    worlds = new_worlds(len(levels), max(table.slots for table in tables))
    return _loaded(compiled, levels, tables, worlds, 0, box), worlds


def _loaded(
    compiled: Compile, levels: Sequence[Level], tables: Sequence[ObjectTable], worlds: WorldArray, first: int, box: bool
) -> NDArray[np.void]:
    """Load one world per level into zeroed worlds from ``first`` on; gives the maps of the levels."""
    maps = np.zeros(len(levels), TILE_MAP)
    for number, (level, table) in enumerate(zip(levels, tables, strict=True)):
        map_, world = maps[number : number + 1], worlds[first + number : first + number + 1]
        map_[0]["ids"] = grid_tiles(level)
        kinds, counts = np.array(table.kinds, np.int64), np.array(table.counts, np.int64)
        values = np.array(table.values, np.float64).reshape(-1, 9)
        compiled(load_world)(map_, world, 0, kinds, counts, values, int(box))
    return maps


class CompiledWorlds(Worlds):
    """Worlds of NumPy records in one block: fast for many ticks. Raises LevelError as ``object_table`` does.

    Every level is loaded once; a fresh world is a copy of bytes.
    """

    name: MemoryName = "compiled"

    def __init__(self, compiled: Compile, levels: Iterable[Level], count: int = 1, *, box: bool) -> None:
        self.levels = tuple(levels)
        self.count, self.box = count, box
        self._compiled = compiled
        self._step, self._observe = compiled(step_world), compiled(observe_object)
        tables = [object_table(level) for level in self.levels]
        self.slots = max(table.slots for table in tables)
        # Behind the worlds lies a fresh one per level, and one more: an array of one record is always contiguous, which
        # is another type for Numba and would be compiled again.
        self.worlds: WorldArray = new_worlds(count + len(tables) + 1, self.slots)
        self.maps = _loaded(compiled, self.levels, tables, self.worlds, count, box)
        self.records, self.fresh = self.worlds[:count], self.worlds[count:]
        self._all_states = world_bytes(self.worlds)
        self.states: NDArray[np.uint8] = self._all_states[:count]
        self._numbers = {field: self.records[field] for field in ("tick", "outcome", "gold", "id_count")}
        self._ninja, self._events, self._event_count = (self.records[f] for f in ("ninja", "events", "event_count"))
        self._jump_held = self._ninja["jump_held"]
        self._ticks_at_once = max(1, WORK_SLICE // self.slots)
        self.level_of = np.zeros(count, np.intp)
        self._levels_played: list[int] = []
        self.load(range(count), np.arange(count) % len(tables))

    def __reduce__(self) -> tuple[Any, ...]:
        state = self.states.copy(), self.level_of.copy(), self._events.copy(), self._event_count.copy()
        return partial(CompiledWorlds, self._compiled, box=self.box), (self.levels, self.count), state

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.states[:], self.level_of[:], self._events[:], self._event_count[:] = state
        self._levels_played = []

    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        return self._compiled(entry)

    def number(self, field: str, index: int = 0) -> int:
        return int(self._numbers[field][index])

    def jump_held(self, index: int = 0) -> int:
        return int(self._jump_held[index])

    def step(self, keys: int, index: int = 0) -> None:
        levels = self._levels_played or self._played()
        self._step(self.maps, levels[index], self.worlds, index, keys)

    def _played(self) -> list[int]:
        """The level of each world, as Python ints: an int of NumPy costs a tenth of a tick."""
        self._levels_played = self.level_of.tolist()
        return self._levels_played

    def kill(self, cause: int, dx: float, dy: float, index: int = 0) -> None:
        self._compiled(kill_ninja)(self.worlds, index, cause, dx, dy)

    def run(self, inputs: bytes, index: int = 0) -> RunPath:
        keys = np.frombuffer(inputs, np.uint8)
        places, states = np.empty(2 * len(keys)), np.empty(len(keys), np.uint8)
        kernel, level = self._compiled(run_world), self._played()[index]
        ticks = 0
        for first, last in self._slices(len(keys)):
            here = places[2 * first : 2 * last], states[first:last]
            ticks += kernel(self.maps, level, self.worlds, index, keys[first:last], *here)
            if ticks < last or self.number("outcome", index):
                break
        return RunPath(places[: 2 * ticks], states[:ticks])

    def trace(self, inputs: bytes, slots: Sequence[int], *, events: bool, index: int = 0) -> TraceArrays:
        keys, slot_array = np.frombuffer(inputs, np.uint8), np.array(slots, np.int64)
        ticks, width = len(keys), MAX_EVENTS if events else 0
        widths = (len(TRACED_FLOATS), len(TRACED_INTS), 2 * len(slot_array), len(slot_array), len(slot_array), width)
        kinds = (np.float64, np.int32, np.float64, np.int32, np.uint8, np.uint8)
        record = TraceArrays(*(np.zeros(ticks * size, kind) for size, kind in zip(widths, kinds, strict=True)))
        kernel, level = self._compiled(trace_world), self._played()[index]
        for first, last in self._slices(ticks):
            here = [part[first * size : last * size] for part, size in zip(record, widths, strict=True)]
            kernel(self.maps, level, self.worlds, index, keys[first:last], slot_array, *here)
        return record

    def _slices(self, ticks: int) -> Iterator[tuple[int, int]]:
        """The first and last tick of each call of a kernel."""
        for first in range(0, ticks, self._ticks_at_once):
            yield first, min(first + self._ticks_at_once, ticks)

    def save(self, index: int = 0) -> NDArray[np.uint8]:
        state: NDArray[np.uint8] = self.states[index]
        return state.copy()

    def restore(self, state: NDArray[np.uint8], index: int = 0) -> None:
        self.states[index] = state
        self._event_count[index] = 0

    def ninja(self, index: int = 0) -> Any:
        return _NinjaRow(*self._ninja[index].item())

    def events(self, index: int = 0) -> list[Any]:
        return [_EventRow(*row) for row in self._events[index, : int(self._event_count[index])].tolist()]

    def objects(self, index: int = 0) -> Any:
        return self.records["objects"][index].view(np.recarray)

    def observe(self, slot: int, index: int = 0) -> tuple[int, float, float, int]:
        seen: tuple[int, float, float, int] = self._observe(self.worlds, index, slot)
        return seen

    def world(self, index: int = 0) -> World:
        return plain_copy(self.records, index)

    def load(self, indices: Iterable[int], levels: Iterable[int]) -> None:
        for index, number in zip(indices, levels, strict=True):
            self.restore(self._all_states[self.count + number], index)
            self.level_of[index] = number
        self._levels_played = []

    def initial_levels(self, numbers: Iterable[int]) -> list[InitialLevel]:
        objects, ids, ninja = self.fresh["objects"], self.maps["ids"], self.fresh["ninja"]
        levels = []
        for number in numbers:
            used = self.fresh["slots_used"][number]
            columns = [objects[name][number, :used].tolist() for name in ("kind", "x", "y", "partner")]
            start = float(ninja["x"][number]), float(ninja["y"][number])
            rows = list(map(InitialObject, range(used), *columns))
            levels.append(InitialLevel(ids[number].tolist(), rows, start))
        return levels

    def put_levels(self, numbers: NDArray[np.intp], levels: Sequence[Level]) -> None:
        self.maps[numbers], fresh = load_worlds(self._compiled, levels, box=self.box)
        states = world_bytes(fresh)
        for rows in (numbers, self.count + numbers):
            self._all_states[rows] = 0
            self._all_states[rows, : states.shape[1]] = states
        self._event_count[numbers] = 0

    def save_many(self, indices: Any) -> NDArray[np.uint8]:
        states: NDArray[np.uint8] = self.states[indices]
        return states

    def restore_many(self, states: Any, indices: Any, levels: Any) -> None:
        """Restore worlds. A state holds the objects of its level."""
        self.states[indices], self.level_of[indices], self._event_count[indices] = states, levels, 0
        self._levels_played = []

    def run_batch(self, inputs: Any, first: int, last: int, *, stop: bool) -> int:
        ticks: int = self._compiled(run_worlds)(self.maps, self.level_of, self.worlds, inputs, first, last, int(stop))
        return ticks


def compiled_copy(compiled: Compile, worlds: Worlds) -> CompiledWorlds:
    """Copy plain worlds with states, levels and events; the copies go on like the originals."""
    copies = CompiledWorlds(compiled, worlds.levels, worlds.count, box=worlds.box)
    copies.load(range(worlds.count), worlds.level_of)
    for index in range(worlds.count):
        write_plain(worlds.world(index), copies.worlds, index)
    return copies
