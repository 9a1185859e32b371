"""The compiled memory: the schema as NumPy records, so that a save-state is one copy of bytes.

Kinds overlap: an object's record has the common header, then the fields of all kinds in the same bytes. A field that
several kinds declare has one place. Offsets are explicit: NumPy would lose the alignment of nested records.
"""

from __future__ import annotations

import mmap
from collections.abc import Callable
from struct import Struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.kinds import KINDS
from ninja_game.sim.schema.declare import Field, fields_of, getter_of, scalars_of, setter_of
from ninja_game.sim.schema.object_fields import Header, Object
from ninja_game.sim.schema.world_fields import Event, Ninja, TileMap, World

_SIZES = {"f8": 8, "f4": 4, "i8": 8, "i4": 4, "i2": 2, "u1": 1}
_REFUSED = set(dir(np.recarray)) | set(dir(np.record))
"""Attributes of NumPy's record types: a field with such a name would silently give something else."""

HUGE_PAGE = 1 << 21  # bytes of a huge page

WorldArray = NDArray[np.void]


def dtype_of(cls: type) -> np.dtype[np.void]:
    """The record layout of a schema class. Raises TypeError for a field name that NumPy would hide."""
    fields = fields_of(cls)
    for field in fields:
        if field.name in _REFUSED:
            raise TypeError(f"{cls.__name__}.{field.name}: NumPy's records have an attribute of this name; rename it")
    if cls is Object:
        return _overlaid(fields)
    offset = 0
    offsets = []
    for field in fields:
        offset = _align(offset, 8 if isinstance(field.type, type) else _SIZES[field.type])
        offsets.append(offset)
        offset += _dtype(field).itemsize
    return _record(fields, offsets, _align(offset, 8))


def _overlaid(fields: list[Field]) -> np.dtype[np.void]:
    """Lay out ``Object``: put each field at the lowest place that is free in all kinds that have it."""
    kinds = [{field.name for field in fields_of(base)} for base in Object.__bases__]
    header = {field.name for field in fields_of(Header)}
    taken: list[set[int]] = [set() for _ in kinds]
    offsets = {}
    ordered = sorted(fields, key=lambda field: (field.name not in header, -_SIZES[str(field.type)]))
    for field in ordered:
        size = _SIZES[str(field.type)]
        owners = [used for used, names in zip(taken, kinds, strict=True) if field.name in names]
        offset = 0
        while any(used & set(range(offset, offset + size)) for used in owners):
            offset += size
        offsets[field.name] = offset
        for used in owners:
            used |= set(range(offset, offset + size))
    end = max(max(used) for used in taken) + 1
    return _record(fields, [offsets[field.name] for field in fields], _align(end, 8))


def _record(fields: list[Field], offsets: list[int], size: int) -> np.dtype[np.void]:
    """Make an aligned dtype with given offsets."""
    names = [field.name for field in fields]
    formats = [_dtype(field) for field in fields]
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": size}, align=True)


def _dtype(field: Field) -> np.dtype[np.void]:
    element = dtype_of(field.type) if isinstance(field.type, type) else np.dtype(field.type)
    return np.dtype((element, (field.length,))) if field.length else element


def _align(offset: int, size: int) -> int:
    return (offset + size - 1) // size * size


WORLD = dtype_of(World)
TILE_MAP = dtype_of(TileMap)
OBJECT_DTYPE = dtype_of(Object)
STATE_START = WORLD.fields["event_count"][1]  # type: ignore[index]
"""A save-state leaves out the events, which are first."""
OBJECTS_START = WORLD.fields["objects"][1]  # type: ignore[index]

_set_ninja, _set_event = (setter_of(fields_of(cls)) for cls in (Ninja, Event))
_SCALARS = [field.name for field in scalars_of(World)]
_get_ninja, _get_event = getter_of(fields_of(Ninja)), getter_of(fields_of(Event))
_KIND_FIELDS = {kind.number: [field.name for field in fields_of(kind.fields)] for kind in KINDS}
_GET_KIND = {kind.number: getter_of(fields_of(kind.fields)) for kind in KINDS}


def _reader_of(cls: type) -> tuple[Callable[..., tuple[Any, ...]], Callable[[Any, tuple[Any, ...]], None]]:
    """Functions that read the fields of a kind from the bytes of an object, and write them into an ``Object``."""
    ordered = sorted(fields_of(cls), key=lambda field: OBJECT_DTYPE.fields[field.name][1])  # type: ignore[index]
    text, end = "", 0
    for field in ordered:
        dtype, offset = OBJECT_DTYPE.fields[field.name][:2]  # type: ignore[index]
        text, end = f"{text}{offset - end}x{dtype.char}", offset + dtype.itemsize
    return Struct(text).unpack_from, setter_of(ordered)


_READERS = {kind.number: _reader_of(kind.fields) for kind in KINDS}


def used_bytes(objects: int) -> int:
    """Bytes of a world in use if ``objects`` slots are taken, slot 0 included."""
    return OBJECTS_START + objects * OBJECT_DTYPE.itemsize


def new_worlds(count: int, objects: int) -> WorldArray:
    """Make ``count`` zeroed worlds in one block, with room for ``objects`` slots each, as an array of records.

    The stride is that of the used bytes, smaller than the item, which has the full capacity. Unused capacity lies in
    untouched pages at the end of the block. Used bytes lie in huge pages if they fill some: a tick touches a handful of
    places of a world, and most would miss the address cache with small pages.
    """
    stride = _align(used_bytes(objects), 64)
    size = (count - 1) * stride + max(stride, WORLD.itemsize)
    # Private: a forked process must not write into its parent's worlds.
    block = mmap.mmap(-1, size, access=mmap.ACCESS_COPY if hasattr(mmap, "MAP_PRIVATE") else mmap.ACCESS_WRITE)
    if hasattr(mmap, "MADV_HUGEPAGE"):
        huge = count * stride // HUGE_PAGE * HUGE_PAGE
        block.madvise(mmap.MADV_NOHUGEPAGE, huge)
        if huge:
            block.madvise(mmap.MADV_HUGEPAGE, 0, huge)
    return np.ndarray((count,), WORLD, block, 0, (stride,))


def world_bytes(worlds: WorldArray) -> NDArray[np.uint8]:
    """View the states of worlds, without events, as a matrix of bytes, one row per world.

    Save-states and copies between worlds are copies of rows. ``worlds``: an array from ``new_worlds``, not a slice.
    """
    return np.ndarray((len(worlds), worlds.strides[0]), np.uint8, worlds.base)[:, STATE_START:]


def plain_copy(worlds: WorldArray, index: int) -> World:
    """Copy one world of an array, with its events, to plain objects; of each object only the fields of its kind."""
    record = worlds[index]
    w = World()
    for field in fields_of(World):
        if isinstance(field.type, str):
            value = record[field.name].tolist()
            setattr(w, field.name, value)
    _set_ninja(w.ninja, record["ninja"].item())
    for event, values in zip(w.events, record["events"][: w.event_count].tolist(), strict=False):
        _set_event(event, values)
    objects = record["objects"][1 : w.slots_used]
    states = objects.tobytes()
    for number, kind in enumerate(objects["kind"].tolist()):
        o, (read, write) = Object(), _READERS[kind]
        write(o, read(states, number * OBJECT_DTYPE.itemsize))
        w.objects.append(o)
    return w


def write_plain(w: World, worlds: WorldArray, index: int) -> None:
    """Write plain objects into one record of an array: of each object only the fields that its kind has."""
    record = worlds[index]
    for name in _SCALARS:
        record[name] = getattr(w, name)
    record["ninja"] = _get_ninja(w.ninja)
    record["heads"], record["edges"] = w.heads, w.edges
    for number in range(w.event_count):
        record["events"][number] = _get_event(w.events[number])
    objects = record["objects"]
    capacity = (worlds.strides[0] - OBJECTS_START) // OBJECT_DTYPE.itemsize
    objects[1:capacity] = np.zeros((), OBJECT_DTYPE)
    for slot in range(1, w.slots_used):
        o = w.objects[slot]
        objects[_KIND_FIELDS[o.kind]][slot] = _GET_KIND[o.kind](o)
