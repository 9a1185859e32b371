"""The plain memory: load a level into ordinary Python objects, save and restore a world of them."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from typing import Any

from ninja_game.sim.collision.tiles import set_edges
from ninja_game.sim.level import Level
from ninja_game.sim.loader import grid_tiles, populate, record_table
from ninja_game.sim.memory.declare import fields_of, getter_of, setter_of
from ninja_game.sim.memory.interface import TRACED_NUMBERS, TRACED_PLACES, MemoryName, RunRecord, TraceRecord
from ninja_game.sim.memory.kernels import kill_ninja, observe_object, run_world, trace_world
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import MAX_EVENTS, Event, Ninja, TileMap, World
from ninja_game.sim.world import step

PlainState = tuple[tuple[Any, ...], tuple[Any, ...], list[int], list[int], list[tuple[Any, ...]]]
"""A save-state of a plain world: its scalars, the ninja, cell heads, edges, objects. Never changed once made."""


def load_plain(data: Level, box: bool) -> tuple[TileMap, World]:
    """A level and a new world in it. Raises LevelError as ``record_table`` does."""
    table = record_table(data)
    level = TileMap()
    level.tiles = grid_tiles(data)
    w = World()
    w.objects += [Object() for _ in range(table.slots - 1)]
    set_edges(level, w)
    populate(level, w, table.kinds, table.counts, table.values)
    w.ninja.box = int(box)
    return level, w


WORLD_SCALARS = [field for field in fields_of(World) if field.length == 0 and isinstance(field.type, str)]
_get_scalars, _set_scalars = getter_of(WORLD_SCALARS), setter_of(WORLD_SCALARS)
_get_ninja, _set_ninja = getter_of(fields_of(Ninja)), setter_of(fields_of(Ninja))
_get_object, _set_object = getter_of(fields_of(Object)), setter_of(fields_of(Object))


def save_plain(w: World) -> PlainState:
    """Everything that changes during a run, but the events of the last tick."""
    objects = [_get_object(o) for o in w.objects]
    return _get_scalars(w), _get_ninja(w.ninja), w.heads.copy(), w.edges.copy(), objects


def restore_plain(w: World, state: PlainState) -> None:
    """Put a world back to a save-state of the same level."""
    scalars, ninja, heads, edges, objects = state
    _set_scalars(w, scalars)
    _set_ninja(w.ninja, ninja)
    w.heads[:] = heads
    w.edges[:] = edges
    for o, values in zip(w.objects, objects, strict=True):
        _set_object(o, values)
    w.event_count = 0


class PlainMemory:
    """A world of plain Python objects: it starts at once, and anybody may look into it."""

    name: MemoryName = "plain"

    def __init__(self, level: Level, *, box: bool) -> None:
        self._level = level
        self._box = box
        self.load()

    def load(self) -> None:
        """Start afresh from the level."""
        self.tiles, self._world = load_plain(self._level, self._box)

    @property
    def tick(self) -> int:
        """Ticks run."""
        return self._world.tick

    @property
    def outcome(self) -> int:
        """The outcome, by number."""
        return self._world.outcome

    @property
    def gold(self) -> int:
        """Pieces of gold collected."""
        return self._world.gold

    @property
    def jump_held(self) -> int:
        """Whether the jump key was down in the last sampled tick."""
        return self._world.ninja.jump_held

    @property
    def id_count(self) -> int:
        """How many objects have an id."""
        return self._world.id_count

    def step(self, keys: int) -> None:
        """One tick."""
        step(self.tiles, self._world, keys)

    def kill(self, cause: int, dx: float, dy: float) -> None:
        """Kill the ninja where it is."""
        kill_ninja([self._world], 0, cause, dx, dy)

    def run(self, inputs: bytes) -> RunRecord:
        """Run until the first exit contact or death, or to the end."""
        places, states = _zeros("d", 2 * len(inputs)), bytearray(len(inputs))
        ticks = run_world([self.tiles], [self._world], 0, inputs, places, states)
        return RunRecord(places[: 2 * ticks], states[:ticks])

    def trace(self, inputs: bytes, slots: Sequence[int], *, events: bool) -> TraceRecord:
        """Run all of ``inputs`` and record everything."""
        ticks, rows = len(inputs), len(inputs) * len(slots)
        happened = bytearray(MAX_EVENTS * ticks if events else 0)
        ninja, numbers = _zeros("d", len(TRACED_PLACES) * ticks), _zeros("i", len(TRACED_NUMBERS) * ticks)
        record = TraceRecord(ninja, numbers, _zeros("d", 2 * rows), _zeros("i", rows), bytearray(rows), happened)
        trace_world([self.tiles], [self._world], 0, inputs, slots, *record)
        return record

    def save(self) -> PlainState:
        """The state as tuples."""
        return save_plain(self._world)

    def restore(self, state: PlainState) -> None:
        """Go back to a state of the same level."""
        restore_plain(self._world, state)

    def ninja(self) -> Ninja:
        """The ninja."""
        return self._world.ninja

    def events(self) -> list[Event]:
        """The events of the last tick."""
        return self._world.events[: self._world.event_count]

    def observe(self, slot: int) -> tuple[int, float, float, int]:
        """Kind, x, y and status of the object in a slot."""
        return observe_object([self._world], 0, slot)

    def world(self) -> World:
        """The world itself."""
        return self._world


def _zeros(code: str, count: int) -> array[Any]:
    """So many zeros of a type, in one buffer."""
    return array(code, bytes(count * array(code).itemsize))
