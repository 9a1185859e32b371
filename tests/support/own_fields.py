"""A checked plain memory: reading a field that an object's kind does not have raises.

Compiled, kinds overlap: such a read gives the bytes of another field. Plain, it gives 0. Either is silent.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.kinds import KINDS
from ninja_game.sim.memory.declare import fields_of
from ninja_game.sim.memory.object_fields import Object

FIELDS = [field.name for field in fields_of(Object)]
OWN = {kind.number: {field.name for field in fields_of(kind.fields)} for kind in KINDS}


@contextmanager
def own_fields_only() -> Iterator[None]:
    """For a while reading a foreign field of any plain object raises AttributeError; save-states read all of them."""

    def read(o: object, name: str) -> Any:
        kind = object.__getattribute__(o, "kind")
        if name in FIELDS and name not in OWN[kind]:
            raise AttributeError(f"a {name} of an object of kind {kind}")
        return object.__getattribute__(o, name)

    Object.__getattribute__ = read  # type: ignore[method-assign]
    try:
        yield
    finally:
        del Object.__getattribute__


def apart(objects: list[Object]) -> NDArray[np.void]:
    """Objects as records in which no two fields share bytes; what a kind lacks is -1."""
    codes = [(field.name, str(field.type)) for field in fields_of(Object)]
    records = np.full(len(objects), -1).astype(np.dtype(codes))
    for record, o in zip(records, objects, strict=True):
        for name in OWN[o.kind]:
            record[name] = getattr(o, name)
    return records
