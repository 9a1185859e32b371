"""Traces: the digests of everything a run shows, and the first difference of two runs.

One record a tick for the ninja and one for every object that is neither a ninja nor inert, in id order. What (x, y, s)
means for a kind is listed in ``docs/replay-format.md``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from hashlib import sha256
from itertools import chain
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ninja_game.budget import RUN_BUDGET, affordable_ticks, over_budget
from ninja_game.formats.recording import Recording
from ninja_game.runs.recording_reader import named_errors
from ninja_game.runs.run import run_level
from ninja_game.runs.run_trace import NINJA_RECORD, OBJECT_RECORD, RunTrace, trace_level

Records: TypeAlias = NDArray[np.void]
"""An array of NINJA_RECORD or OBJECT_RECORD."""

NINJA_NAME = "ninja"
"""Kind of the ninja's rows, beside the kinds of objects."""


def trace_recording(
    recording: Recording,
    *,
    ticks: int | None = None,
    after: int = 0,
    memory: str = "auto",
    objects: bool = True,
    events: bool = False,
    budget: int = RUN_BUDGET,
) -> RunTrace:
    """The trace of a recording: of exactly ``ticks`` ticks, else until its end as ``verify`` has it and ``after`` more.

    Raises, naming file and record, LevelError for a level that cannot be played, BudgetError for a run that costs more
    work than its ``budget``.
    """
    body = recording.body
    with named_errors(recording):
        if ticks is None:
            ticks = run_level(recording.level, recording.inputs, body=body, memory=memory, budget=budget).ticks + after
        inputs = recording.replay.playback(ticks)
        if ticks > affordable_ticks(recording.level, budget):
            raise over_budget(recording.level, ticks, budget)
        return trace_level(recording.level, inputs, body=body, memory=memory, with_objects=objects, events=events)


@dataclass(frozen=True)
class TraceDigests:
    """Digests of a run: of the ninja's records, of all records, and of each object by its id (8 hex digits)."""

    ticks: int
    ninja_sha256: str
    run_sha256: str
    objects: dict[int, str] = field(default_factory=dict)


def trace_digests(trace: RunTrace) -> TraceDigests:
    """The digests that tell whether two runs are the same in every bit."""
    ticks = len(trace.ninja)
    ninja = trace.ninja.tobytes()
    widths = NINJA_RECORD.itemsize, OBJECT_RECORD.itemsize * len(trace.ids)
    rows = np.empty((ticks, sum(widths)), np.uint8)
    rows[:, : widths[0]] = np.frombuffer(ninja, np.uint8).reshape(ticks, widths[0])
    rows[:, widths[0] :] = np.frombuffer(trace.objects.tobytes(), np.uint8).reshape(ticks, widths[1])
    objects = {
        id_: sha256(column.tobytes()).hexdigest()[:8] for id_, column in zip(trace.ids, trace.objects.T, strict=True)
    }
    return TraceDigests(ticks, sha256(ninja).hexdigest(), sha256(rows.tobytes()).hexdigest(), objects)


@dataclass(frozen=True)
class Difference:
    """Where two traces part: the first tick, and in it the first object and field."""

    tick: int
    subject: str
    field: str
    ours: object
    theirs: object
    section: str = ""

    def __str__(self) -> str:
        about = f" (specification: {self.section})" if self.section else ""
        return f"tick {self.tick}: {self.subject}: {self.field} is {self.ours}, expected {self.theirs}{about}"


def first_difference(ours: RunTrace, theirs: RunTrace, section: str = "") -> Difference | None:
    """The first tick, object and field that differ, None if nothing does.

    Objects are compared where both traces have objects at all; ``section`` of the specification is carried into the
    report.
    """
    with_objects = bool(ours.ids and theirs.ids)
    if with_objects and (ours.ids, ours.kinds) != (theirs.ids, theirs.kinds):
        mine, other = dict(zip(ours.ids, ours.kinds, strict=True)), dict(zip(theirs.ids, theirs.kinds, strict=True))
        id_ = min(key for key in mine.keys() | other.keys() if mine.get(key) != other.get(key))
        return Difference(0, f"object {id_}", "kind", mine.get(id_, "missing"), other.get(id_, "missing"), section)
    shared = min(len(ours.ninja), len(theirs.ninja))
    found = _first_unequal(ours.ninja[:shared, np.newaxis], theirs.ninja[:shared, np.newaxis], (NINJA_NAME,))
    if with_objects:
        names = tuple(f"object {id_} ({kind})" for id_, kind in zip(ours.ids, ours.kinds, strict=True))
        in_objects = _first_unequal(ours.objects[:shared], theirs.objects[:shared], names)
        found = in_objects if found is None or (in_objects and in_objects[0] < found[0]) else found
    if found:
        return Difference(*found, section)
    if len(ours.ninja) != len(theirs.ninja):
        return Difference(shared, "run", "number of ticks", len(ours.ninja), len(theirs.ninja), section)
    return None


def _first_unequal(
    ours: Records, theirs: Records, names: tuple[str, ...]
) -> tuple[int, str, str, object, object] | None:
    """Tick, name of the column, field and both values where two arrays of records (ticks, columns) first differ."""
    first: tuple[int, int, int] | None = None
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


def rows(trace: RunTrace) -> Iterator[dict[str, Any]]:
    """Every record of a trace as a row: the ninja of a tick with its velocity (px/tick), then that tick's objects."""
    names = NINJA_RECORD.names or ()
    # As Python's numbers a whole run would take ten times the memory.
    blocks = (trace.ninja[first : first + 4096].tolist() for first in range(0, len(trace.ninja), 4096))
    for tick, ninja in enumerate(chain.from_iterable(blocks)):
        row: dict[str, Any] = dict(zip(names, ninja, strict=True))
        row |= {"vx": row["x"] - row["prev_x"], "vy": row["y"] - row["prev_y"]}
        yield {"tick": tick, "kind": NINJA_NAME, **row, "events": trace.events[tick] if trace.events else ""}
        for id_, kind, (x, y, s) in zip(trace.ids, trace.kinds, trace.objects[tick].tolist(), strict=True):
            yield {"tick": tick, "id": id_, "kind": kind, "x": x, "y": y, "s": s}
