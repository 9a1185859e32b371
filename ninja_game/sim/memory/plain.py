"""The plain memory: load a level into ordinary Python objects, save and restore a world of them."""

from __future__ import annotations

from collections.abc import Callable
from operator import attrgetter
from typing import Any

from ninja_game.sim.collision.tiles import set_edges
from ninja_game.sim.level import Level
from ninja_game.sim.loader import grid_tiles, populate, record_table
from ninja_game.sim.memory.declare import Field, fields_of
from ninja_game.sim.memory.schema import Ninja, Object, TileMap, World

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


def _getter(fields: list[Field]) -> Callable[[Any], tuple[Any, ...]]:
    """A function that reads these fields of an object as a tuple."""
    return attrgetter(*(field.name for field in fields))


def _setter(fields: list[Field]) -> Callable[[Any, tuple[Any, ...]], None]:
    """A function that writes a tuple back into these fields of an object."""
    targets = ", ".join(f"o.{field.name}" for field in fields)
    names: dict[str, Any] = {}
    exec(f"def restore(o, values):\n    {targets}, = values", names)  # noqa: S102 - made from the schema, not from input
    setter: Callable[[Any, tuple[Any, ...]], None] = names["restore"]
    return setter


WORLD_SCALARS = [field for field in fields_of(World) if field.length == 0 and isinstance(field.type, str)]
_get_scalars, _set_scalars = _getter(WORLD_SCALARS), _setter(WORLD_SCALARS)
_get_ninja, _set_ninja = _getter(fields_of(Ninja)), _setter(fields_of(Ninja))
_get_thing, _set_thing = _getter(fields_of(Object)), _setter(fields_of(Object))


def save_plain(w: World) -> PlainState:
    """Everything that changes during a run, but the events of the last tick."""
    objects = [_get_thing(o) for o in w.objects]
    return _get_scalars(w), _get_ninja(w.ninja), w.heads.copy(), w.edges.copy(), objects


def restore_plain(w: World, state: PlainState) -> None:
    """Put a world back to a save-state of the same level."""
    scalars, ninja, heads, edges, objects = state
    _set_scalars(w, scalars)
    _set_ninja(w.ninja, ninja)
    w.heads[:] = heads
    w.edges[:] = edges
    for o, values in zip(w.objects, objects, strict=True):
        _set_thing(o, values)
    w.event_count = 0
