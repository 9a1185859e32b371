"""The compiled memory: worlds as NumPy records, in which compiled kernels run."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.level import Level
from ninja_game.sim.loader import grid_tiles, record_table
from ninja_game.sim.memory.declare import fields_of
from ninja_game.sim.memory.interface import TRACED_NUMBERS, TRACED_PLACES, MemoryName, RunRecord, TraceRecord
from ninja_game.sim.memory.kernels import kill_ninja, load_world, observe_object, run_world, step_world, trace_world
from ninja_game.sim.memory.layout import TILE_MAP, Records, new_worlds, plain_copy, state_view
from ninja_game.sim.memory.schema import MAX_EVENTS, Event, Ninja, TileMap, World

Compile = Callable[[Callable[..., Any]], Callable[..., Any]]
"""Gives the compiled twin of an entry point (``memories.compiled``)."""

SLICE = 400_000
"""Ticks times objects in one call of a kernel, some tens of milliseconds: between calls Python sees Ctrl-C."""

_NinjaRow: Any = namedtuple("_NinjaRow", [field.name for field in fields_of(Ninja)])  # type: ignore[misc]  # noqa: PYI024
_EventRow: Any = namedtuple("_EventRow", [field.name for field in fields_of(Event)])  # type: ignore[misc]  # noqa: PYI024


def load_worlds(compiled: Compile, levels: Sequence[Level], *, box: bool) -> tuple[NDArray[np.void], Records]:
    """Levels, and a new world in each, as arrays of records. Raises LevelError as ``record_table`` does."""
    tables = [record_table(level) for level in levels]
    maps = np.zeros(len(levels), TILE_MAP)
    worlds = new_worlds(len(levels), max(table.slots for table in tables))
    for number, (level, table) in enumerate(zip(levels, tables, strict=True)):
        here = slice(number, number + 1)
        maps[number]["tiles"] = grid_tiles(level)
        kinds, counts = np.array(table.kinds, np.int64), np.array(table.counts, np.int64)
        values = np.array(table.values, np.float64).reshape(-1, 9)
        compiled(load_world)(maps[here], worlds[here], 0, kinds, counts, values, int(box))
    return maps, worlds


class CompiledMemory:
    """A world of one NumPy record: fast for many ticks."""

    name: MemoryName = "compiled"

    def __init__(self, compiled: Compile, level: Level, *, box: bool) -> None:
        self._compiled = compiled
        self._step, self._observe = compiled(step_world), compiled(observe_object)
        self._levels, self._worlds = load_worlds(compiled, [level], box=box)
        self.tiles = TileMap()
        self.tiles.tiles = grid_tiles(level)
        worlds = self._worlds
        self._state = state_view(worlds, 0)
        self._fresh = self._state.copy()
        self._tick, self._outcome, self._gold = worlds["tick"], worlds["outcome"], worlds["gold"]
        self._ninja, self._events, self._event_count = worlds["ninja"], worlds["events"][0], worlds["event_count"]
        self._jump_held = worlds["ninja"]["jump_held"]
        self.id_count = int(worlds["id_count"][0])
        self._ticks_at_once = max(1, SLICE // int(worlds["slots_used"][0]))

    def load(self) -> None:
        """Start afresh from the level."""
        self.restore(self._fresh)

    @property
    def tick(self) -> int:
        """Ticks run."""
        return int(self._tick[0])

    @property
    def outcome(self) -> int:
        """The outcome, by number."""
        return int(self._outcome[0])

    @property
    def gold(self) -> int:
        """Pieces of gold collected."""
        return int(self._gold[0])

    @property
    def jump_held(self) -> int:
        """Whether the jump key was down in the last sampled tick."""
        return int(self._jump_held[0])

    def step(self, keys: int) -> None:
        """One tick."""
        self._step(self._levels, self._worlds, 0, keys)

    def kill(self, cause: int, dx: float, dy: float) -> None:
        """Kill the ninja where it is."""
        self._compiled(kill_ninja)(self._worlds, 0, cause, dx, dy)

    def run(self, inputs: bytes) -> RunRecord:
        """Run until the first exit contact or death, or to the end."""
        keys = np.frombuffer(inputs, np.uint8)
        places, states = np.empty(2 * len(keys)), np.empty(len(keys), np.uint8)
        kernel = self._compiled(run_world)
        ticks = 0
        for first, last in self._slices(len(keys)):
            here = places[2 * first : 2 * last], states[first:last]
            ticks += kernel(self._levels, self._worlds, 0, keys[first:last], *here)
            if ticks < last or self.outcome:
                break
        return RunRecord(places[: 2 * ticks], states[:ticks])

    def trace(self, inputs: bytes, slots: Sequence[int], *, events: bool) -> TraceRecord:
        """Run all of ``inputs`` and record everything."""
        keys, columns = np.frombuffer(inputs, np.uint8), np.array(slots, np.int64)
        ticks, width = len(keys), MAX_EVENTS if events else 0
        widths = (len(TRACED_PLACES), len(TRACED_NUMBERS), 2 * len(columns), len(columns), len(columns), width)
        kinds = (np.float64, np.int32, np.float64, np.int32, np.uint8, np.uint8)
        record = TraceRecord(*(np.zeros(ticks * wide, kind) for wide, kind in zip(widths, kinds, strict=True)))
        kernel = self._compiled(trace_world)
        for first, last in self._slices(ticks):
            here = [part[first * wide : last * wide] for part, wide in zip(record, widths, strict=True)]
            kernel(self._levels, self._worlds, 0, keys[first:last], columns, *here)
        return record

    def _slices(self, ticks: int) -> Iterator[tuple[int, int]]:
        """First and last tick of each call of a kernel."""
        for first in range(0, ticks, self._ticks_at_once):
            yield first, min(first + self._ticks_at_once, ticks)

    def save(self) -> NDArray[np.uint8]:
        """The state as bytes."""
        return self._state.copy()

    def restore(self, state: NDArray[np.uint8]) -> None:
        """Go back to a state of the same level."""
        self._state[:] = state
        self._event_count[0] = 0

    def ninja(self) -> Any:
        """The ninja's fields."""
        return _NinjaRow(*self._ninja[0].item())

    def events(self) -> list[Any]:
        """The events' fields."""
        return [_EventRow(*row) for row in self._events[: int(self._event_count[0])].tolist()]

    def observe(self, slot: int) -> tuple[int, float, float, int]:
        """Kind, x, y and status of the object in a slot."""
        seen: tuple[int, float, float, int] = self._observe(self._worlds, 0, slot)
        return seen

    def world(self) -> World:
        """A copy of the world as plain objects."""
        return plain_copy(self._worlds, 0)
