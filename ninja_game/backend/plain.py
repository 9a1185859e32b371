"""The plain memory: worlds of ordinary Python objects. It starts at once, and any code can read its objects."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Sequence
from functools import cached_property, partial
from typing import Any

from ninja_game.backend.kernels import kill_ninja, load_world, observe_object, run_world, run_worlds, trace_world
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
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import Level
from ninja_game.sim.loader import object_table, tile_map
from ninja_game.sim.schema.declare import fields_of, getter_of, scalars_of, setter_of
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import MAX_EVENTS, Event, Ninja, TileMap, World
from ninja_game.sim.world import step

PlainState = tuple[tuple[Any, ...], tuple[Any, ...], list[int], list[int], list[tuple[Any, ...]]]
"""A save-state of a plain world: scalars, ninja, cell heads, edges, objects. It never changes."""


def load_plain(level: Level, box: bool) -> tuple[TileMap, World]:
    """Load a level and a new world in it. Raises LevelError as ``object_table`` does."""
    table = object_table(level)
    tiles = tile_map(level)
    w = World()
    w.objects += [Object() for _ in range(table.slots - 1)]
    load_world([tiles], [w], 0, table.kinds, table.counts, table.values, int(box))
    return tiles, w


_get_scalars, _set_scalars = getter_of(scalars_of(World)), setter_of(scalars_of(World))
_get_ninja, _set_ninja = getter_of(fields_of(Ninja)), setter_of(fields_of(Ninja))
_get_object, _set_object = getter_of(fields_of(Object)), setter_of(fields_of(Object))
_get_event, _set_event = getter_of(fields_of(Event)), setter_of(fields_of(Event))


def save_plain(w: World) -> PlainState:
    """Save everything that changes during a run, except the events of the last tick."""
    objects = [_get_object(o) for o in w.objects]
    return _get_scalars(w), _get_ninja(w.ninja), w.heads.copy(), w.edges.copy(), objects


def restore_plain(w: World, state: PlainState) -> None:
    """Restore a save-state of the same level."""
    scalars, ninja, heads, edges, objects = state
    _set_scalars(w, scalars)
    _set_ninja(w.ninja, ninja)
    w.heads[:] = heads
    w.edges[:] = edges
    for o, values in zip(w.objects, objects, strict=True):
        _set_object(o, values)
    w.event_count = 0


def _world_in(state: PlainState) -> World:
    """Make a world that is in a save-state."""
    w = World()
    w.objects += [Object() for _ in state[-1][1:]]
    restore_plain(w, state)
    return w


class PlainWorlds(Worlds):
    """Worlds of plain Python objects. Raises LevelError as ``object_table`` does."""

    name: MemoryName = "plain"

    def __init__(self, levels: Iterable[Level], count: int = 1, *, box: bool) -> None:
        self.levels = tuple(levels)
        self.count, self.box = count, box
        self._shown: Any = None
        loaded = [load_plain(level, box) for level in self.levels]
        self.maps = [tiles for tiles, _ in loaded]
        self.slots = max(len(w.objects) for _, w in loaded)
        self.level_of = array("q", [index % len(loaded) for index in range(count)])
        self.worlds: list[World] = [w for _, w in loaded[:count]]
        self.worlds += [load_plain(self.levels[number], box)[1] for number in self.level_of[len(loaded) :]]

    def __reduce__(self) -> tuple[Any, ...]:
        events = [[_get_event(event) for event in self.events(index)] for index in range(self.count)]
        state = self.save_many(range(self.count)), self.level_of.tolist(), events
        return partial(PlainWorlds, box=self.box), (self.levels, self.count), state

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        states, levels, events = state
        self.restore_many(states, range(self.count), levels)
        for w, happened in zip(self.worlds, events, strict=True):
            w.event_count = len(happened)
            for event, values in zip(w.events, happened, strict=False):
                _set_event(event, values)

    @cached_property
    def fresh(self) -> list[World]:
        return [load_plain(level, self.box)[1] for level in self.levels]

    @cached_property
    def _fresh_states(self) -> list[PlainState]:
        return [save_plain(w) for w in self.fresh]

    @cached_property
    def records(self) -> Any:
        from ninja_game.backend.layout import new_worlds

        self._shown = new_worlds(self.count, self.slots)
        for index in range(self.count):
            self._show(index)
        return self._shown

    @cached_property
    def states(self) -> Any:
        from ninja_game.backend.layout import world_bytes

        return world_bytes(self.records)

    def _show(self, index: int) -> None:
        """Copy a world into its record, if the records are in use."""
        if self._shown is not None:
            from ninja_game.backend.layout import write_plain

            write_plain(self.worlds[index], self._shown, index)

    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        return entry

    def number(self, field: str, index: int = 0) -> int:
        value: int = getattr(self.worlds[index], field)
        return value

    def jump_held(self, index: int = 0) -> int:
        return self.worlds[index].ninja.jump_held

    def step(self, keys: int, index: int = 0) -> None:
        step(self.maps[self.level_of[index]], self.worlds[index], keys)

    def kill(self, cause: int, dx: float, dy: float, index: int = 0) -> None:
        kill_ninja(self.worlds, index, cause, dx, dy)

    def run(self, inputs: bytes, index: int = 0) -> RunPath:
        places, states = _zeros("d", 2 * len(inputs)), bytearray(len(inputs))
        ticks = run_world(self.maps, self.level_of[index], self.worlds, index, inputs, places, states)
        return RunPath(places[: 2 * ticks], states[:ticks])

    def trace(self, inputs: bytes, slots: Sequence[int], *, events: bool, index: int = 0) -> TraceArrays:
        ticks, rows = len(inputs), len(inputs) * len(slots)
        happened = bytearray(MAX_EVENTS * ticks if events else 0)
        ninja, numbers = _zeros("d", len(TRACED_FLOATS) * ticks), _zeros("i", len(TRACED_INTS) * ticks)
        record = TraceArrays(ninja, numbers, _zeros("d", 2 * rows), _zeros("i", rows), bytearray(rows), happened)
        trace_world(self.maps, self.level_of[index], self.worlds, index, inputs, slots, *record)
        return record

    def save(self, index: int = 0) -> PlainState:
        return save_plain(self.worlds[index])

    def restore(self, state: PlainState, index: int = 0) -> None:
        restore_plain(self.worlds[index], state)

    def ninja(self, index: int = 0) -> Ninja:
        return self.worlds[index].ninja

    def events(self, index: int = 0) -> list[Event]:
        w = self.worlds[index]
        return w.events[: w.event_count]

    def objects(self, index: int = 0) -> list[Object]:
        return self.worlds[index].objects

    def observe(self, slot: int, index: int = 0) -> tuple[int, float, float, int]:
        return observe_object(self.worlds, index, slot)

    def world(self, index: int = 0) -> World:
        return self.worlds[index]

    def load(self, indices: Iterable[int], levels: Sequence[int]) -> None:
        self.restore_many([self._fresh_states[number] for number in levels], indices, levels)

    def initial_levels(self, numbers: Iterable[int]) -> list[InitialLevel]:
        levels = []
        for number in numbers:
            w = self.fresh[number]
            slots = enumerate(w.objects[: w.slots_used])
            objects = [InitialObject(k, o.kind, o.x, o.y, o.partner if o.kind == EXIT else 0) for k, o in slots]
            levels.append(InitialLevel(self.maps[number].ids, objects, (w.ninja.x, w.ninja.y)))
        return levels

    def put_levels(self, numbers: Any, levels: Sequence[Level]) -> None:
        for number, level in zip(numbers.tolist(), levels, strict=True):
            self.maps[number], self.fresh[number] = load_plain(level, self.box)
            self._fresh_states[number] = state = save_plain(self.fresh[number])
            self.worlds[number] = _world_in(state)
            self._show(number)

    def save_many(self, indices: Iterable[int]) -> list[PlainState]:
        return [save_plain(self.worlds[index]) for index in indices]

    def restore_many(self, states: Iterable[PlainState], indices: Iterable[int], levels: Iterable[int]) -> None:
        """Restore worlds. A world is rebuilt if its state is of another level."""
        for state, index, number in zip(states, indices, levels, strict=True):
            if self.level_of[index] != number:
                self.worlds[index], self.level_of[index] = _world_in(state), number
            else:
                restore_plain(self.worlds[index], state)
            self._show(index)

    def run_batch(self, inputs: Any, first: int, last: int, *, stop: bool) -> int:
        ticks = run_worlds(self.maps, self.level_of, self.worlds, inputs, first, last, int(stop))
        for index in range(first, last):
            self._show(index)
        return ticks


def _zeros(code: str, count: int) -> array[Any]:
    """Make a buffer of ``count`` zeros of a type."""
    return array(code, bytes(count * array(code).itemsize))
