"""Traces: everything a run shows, tick by tick; their digests, and the first difference of two of them.

One record a tick for the ninja and one for every object that is neither a ninja nor inert, in id order. What (x, y, s)
means for a kind is listed in ``docs/replay-format.md``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from hashlib import sha256
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Records: TypeAlias = NDArray[np.void]
"""An array of records of one of the two forms below."""

NINJA = np.dtype([("x", "<f8"), ("y", "<f8"), ("px", "<f8"), ("py", "<f8"), ("s", "<i4"), ("gold", "<i4")])
"""The ninja after a tick: position and the one before (px), state number, gold collected."""

THING = np.dtype([("x", "<f8"), ("y", "<f8"), ("s", "<i4")])
"""An object after a tick: a position (px) and a number, both by kind."""

NINJA_NAME = "ninja"


@dataclass(frozen=True)
class Trace:
    """A run, tick by tick.

    ``ninja``: NINJA records, shape (ticks,). ``things``: THING records, shape (ticks, objects); ``ids`` and ``kinds``
    name its columns, ids ascending. ``events``: what happened in each tick, as names with blanks between.
    """

    ninja: Records
    things: Records
    ids: tuple[int, ...]
    kinds: tuple[str, ...]
    events: tuple[str, ...] = ()
    name: str = ""

    @property
    def ticks(self) -> int:
        """How many ticks were run."""
        return len(self.ninja)


def empty_things(ticks: int) -> Records:
    """The ``things`` of a trace without objects."""
    return np.empty((ticks, 0), THING)


def canonical(records: Records) -> Records:
    """The same records with -0.0 written as 0.0 and every NaN as the one quiet NaN; a contiguous copy."""
    clean = np.array(records, copy=True, order="C")
    for name in clean.dtype.names or ():
        if clean.dtype[name].kind == "f":
            column = clean[name]
            column += 0.0
            column[np.isnan(column)] = np.nan
    return clean


@dataclass(frozen=True)
class TraceDigests:
    """Digests of a run: of the ninja's records, of all records, and of each object by its id (8 hex digits)."""

    ticks: int
    ninja_sha256: str
    run_sha256: str
    objects: dict[int, str] = field(default_factory=dict)


def trace_digests(trace: Trace) -> TraceDigests:
    """The digests that tell whether two runs are the same in every bit."""
    ninja = canonical(trace.ninja)
    things = canonical(trace.things)
    rows = np.empty((trace.ticks, NINJA.itemsize + THING.itemsize * len(trace.ids)), np.uint8)
    rows[:, : NINJA.itemsize] = ninja.view(np.uint8).reshape(trace.ticks, -1)
    if trace.ids and trace.ticks:
        rows[:, NINJA.itemsize :] = things.view(np.uint8).reshape(trace.ticks, -1)
    columns = np.ascontiguousarray(things.T)
    objects = {id_: sha256(column.tobytes()).hexdigest()[:8] for id_, column in zip(trace.ids, columns, strict=True)}
    return TraceDigests(trace.ticks, sha256(ninja.tobytes()).hexdigest(), sha256(rows.tobytes()).hexdigest(), objects)


@dataclass(frozen=True)
class Difference:
    """Where two traces part: the first tick, and in it the first thing and field."""

    tick: int
    thing: str
    field: str
    ours: object
    theirs: object
    section: str = ""

    def __str__(self) -> str:
        about = f" (specification: {self.section})" if self.section else ""
        return f"tick {self.tick}: {self.thing}: {self.field} is {self.ours}, expected {self.theirs}{about}"


def first_difference(ours: Trace, theirs: Trace, section: str = "") -> Difference | None:
    """The first tick, thing and field that differ, None if nothing does.

    Objects are compared where both traces have objects at all; ``section`` of the specification is carried into the
    report.
    """
    with_things = bool(ours.ids and theirs.ids)
    if with_things and (ours.ids, ours.kinds) != (theirs.ids, theirs.kinds):
        mine, other = dict(zip(ours.ids, ours.kinds, strict=True)), dict(zip(theirs.ids, theirs.kinds, strict=True))
        id_ = min(key for key in mine.keys() | other.keys() if mine.get(key) != other.get(key))
        return Difference(0, f"object {id_}", "kind", mine.get(id_, "missing"), other.get(id_, "missing"), section)
    shared = min(ours.ticks, theirs.ticks)
    found = _first_unequal(ours.ninja[:shared, np.newaxis], theirs.ninja[:shared, np.newaxis], (NINJA_NAME,))
    if with_things:
        names = tuple(f"object {id_} ({kind})" for id_, kind in zip(ours.ids, ours.kinds, strict=True))
        thing = _first_unequal(ours.things[:shared], theirs.things[:shared], names)
        found = thing if found is None or (thing and thing[0] < found[0]) else found
    if found:
        return Difference(*found, section)
    if ours.ticks != theirs.ticks:
        return Difference(shared, "run", "number of ticks", ours.ticks, theirs.ticks, section)
    return None


def _first_unequal(
    ours: Records, theirs: Records, names: tuple[str, ...]
) -> tuple[int, str, str, object, object] | None:
    """Tick, name of the column, field and both values where two arrays of records (ticks, columns) first differ."""
    first: tuple[int, int, int] | None = None
    ours, theirs = canonical(ours), canonical(theirs)
    fields = ours.dtype.names or ()
    for number, name in enumerate(fields):
        # Bits, not values: NaN equals NaN.
        bits = np.dtype(f"i{ours.dtype[name].itemsize}")
        unequal = np.ascontiguousarray(ours[name]).view(bits) != np.ascontiguousarray(theirs[name]).view(bits)
        if unequal.any():
            tick, column = divmod(int(np.argmax(unequal)), len(names))
            first = min(first or (tick, column, number), (tick, column, number))
    if first is None:
        return None
    tick, column, number = first
    value, other = (side[fields[number]][tick, column].item() for side in (ours, theirs))
    return tick, names[column], fields[number], value, other


def rows(trace: Trace) -> Iterator[dict[str, Any]]:
    """Every record of a trace as a row: the ninja of a tick, then that tick's objects."""
    ninja, things = canonical(trace.ninja), canonical(trace.things)
    names = NINJA.names or ()
    for tick in range(trace.ticks):
        row: dict[str, Any] = dict(zip(names, ninja[tick].item(), strict=True))
        row |= {"vx": row["x"] - row["px"], "vy": row["y"] - row["py"]}
        yield {"tick": tick, "kind": NINJA_NAME, **row, "events": trace.events[tick] if trace.events else ""}
        for id_, kind, (x, y, s) in zip(trace.ids, trace.kinds, things[tick].tolist(), strict=True):
            yield {"tick": tick, "id": id_, "kind": kind, "x": x, "y": y, "s": s}
