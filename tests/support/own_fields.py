"""Checked memories: reading or writing a field that an object's kind does not have raises AttributeError.

Compiled, kinds overlap: such a read gives the bytes of another field. Plain, it gives 0. Either is silent. Here kernels
run as plain Python, on views of the same records; so whatever is compiled otherwise is checked too, some hundred times
more slowly. The fixture ``own_fields`` does that for a test, OWN_FIELDS=1 in the environment for all that are run.
"""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any
from unittest.mock import patch

import numpy as np

from ninja_game.backend import memories, plain
from ninja_game.backend.layout import OBJECT_DTYPE, WORLD
from ninja_game.sim.kinds import KIND_OF, KINDS
from ninja_game.sim.schema.declare import fields_of
from ninja_game.sim.schema.object_fields import Object

FIELDS = [field.name for field in fields_of(Object)]
OWN = {kind.number: {field.name for field in fields_of(kind.fields)} for kind in KINDS}


def check(kind: int, name: str) -> None:
    """Raise AttributeError for a field that objects of a kind do not have."""
    if name not in OWN[kind] and name in FIELDS:
        raise AttributeError(f"{name} of an object of kind {kind} ({KIND_OF[kind].name}), which has no such field")


@contextmanager
def own_fields_only() -> Iterator[None]:
    """For a while a foreign field of any object, in either memory, raises AttributeError; save-states hold them all."""
    slots = [vars(Object)[name] for name in FIELDS]

    def read(o: object, name: str) -> Any:
        check(object.__getattribute__(o, "kind"), name)
        return object.__getattribute__(o, name)

    def write(o: object, name: str, value: Any) -> None:
        if value:  # a new object writes zeros
            check(object.__getattribute__(o, "kind"), name)
        object.__setattr__(o, name, value)

    def write_all(o: object, values: tuple[Any, ...]) -> None:
        for slot, value in zip(slots, values, strict=True):
            slot.__set__(o, value)

    with (
        patch.object(Object, "__getattribute__", read),
        patch.object(Object, "__setattr__", write),
        patch.object(plain, "_get_object", lambda o: tuple(slot.__get__(o) for slot in slots)),
        patch.object(plain, "_set_object", write_all),
        patch.object(memories.PROCESS, "kernels", Interpreted()),
    ):
        yield


class Interpreted(dict[Any, Any]):
    """In place of compiled twins: the kernels themselves, on views of what they are called with."""

    def get(self, key: tuple[Callable[..., Any], bool], default: Any = None) -> Any:  # noqa: ARG002
        return lambda *words: key[0](*map(seen, words))


def seen(value: Any) -> Any:
    """What plain Python sees of an argument of a kernel: records as objects, numbers as Python's own."""
    if isinstance(value, np.ndarray):
        return Records(value) if value.dtype.names else Numbers(value)
    if isinstance(value, tuple):
        parts = map(seen, value)
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value.item() if isinstance(value, np.generic) else value


class Numbers:
    """An array whose single values are Python's own numbers."""

    def __init__(self, array: Any) -> None:
        self._array = array
        self.shape = array.shape

    def __len__(self) -> int:
        return len(self._array)

    def __getitem__(self, index: Any) -> Any:
        found = self._array[index]
        return Numbers(found) if isinstance(found, np.ndarray) else found.item()

    def __setitem__(self, index: Any, value: Any) -> None:
        self._array[index] = value


class Records:
    """An array of records whose members are structures of C in the same memory."""

    def __init__(self, array: Any) -> None:
        self._array = array
        self._type = structure(array.dtype)

    def __len__(self) -> int:
        return len(self._array)

    def __getitem__(self, index: int) -> Any:
        if not 0 <= index < len(self._array):
            raise IndexError(f"record {index} of {len(self._array)}")
        return self._type.from_address(self._array.ctypes.data + index * self._array.strides[0])


@cache
def structure(dtype: np.dtype[Any]) -> Any:
    """The structure of C for a record; a world's objects are views that check each field."""
    members: list[tuple[str, Any]] = []
    end = 0
    for name, (kind, offset, *_) in sorted((dtype.fields or {}).items(), key=lambda item: item[1][1]):
        if kind.base == OBJECT_DTYPE:
            continue
        if offset > end:
            members.append((f"_gap_{offset}", ctypes.c_byte * (offset - end)))
        element = structure(kind.base) if kind.base.names else np.ctypeslib.as_ctypes_type(kind.base)
        members.append((name, element * kind.shape[0] if kind.shape else element))
        end = offset + kind.itemsize
    body: dict[str, Any] = {"_fields_": members, "__slots__": ()}
    if dtype == WORLD:
        start = dtype.fields["objects"][1]  # type: ignore[index]
        body["objects"] = property(lambda world: ObjectViews(ctypes.addressof(world) + start))
    return type("Structure", (ctypes.Structure,), body)


PLACES = {
    name: (np.ctypeslib.as_ctypes_type(kind), offset)
    for name, (kind, offset, *_) in (OBJECT_DTYPE.fields or {}).items()
}


class ObjectViews:
    """The objects of a world, by slot."""

    def __init__(self, address: int) -> None:
        self._address = address

    def __getitem__(self, slot: int) -> "ObjectView":
        return ObjectView(self._address + slot * OBJECT_DTYPE.itemsize)


class ObjectView:
    """An object in the memory of its record, with the fields of its kind."""

    __slots__ = ("_address",)

    def __init__(self, address: int) -> None:
        object.__setattr__(self, "_address", address)

    def _place(self, name: str) -> Any:
        kind, offset = PLACES[name]
        return kind.from_address(self._address + offset)

    def __getattr__(self, name: str) -> Any:
        check(self._place("kind").value, name)
        return self._place(name).value

    def __setattr__(self, name: str, value: Any) -> None:
        check(self._place("kind").value, name)
        self._place(name).value = value
