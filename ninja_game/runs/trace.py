"""Everything a run shows, tick by tick, as NumPy arrays: traces, their digests, and the first difference of two.

One record a tick for the ninja and one for every object that is neither a ninja nor inert, in id order, on both
memories bit for bit. What (x, y, s) means for a kind is listed in ``docs/replay-format.md``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from hashlib import sha256
from itertools import chain
from typing import Any, SupportsIndex, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_worlds, switch_to_compiled
from ninja_game.backend.worlds import TRACED_FLOATS, TRACED_INTS, TraceArrays
from ninja_game.budget import NO_LIMIT, PLAIN_WORK, RUN_BUDGET, affordable_ticks, over_budget
from ninja_game.errors import ArgumentError
from ninja_game.formats.recording import Recording
from ninja_game.runs.recording_reader import named_errors
from ninja_game.runs.run import inputs_of
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import MAX_TICKS, check_inputs
from ninja_game.sim.kinds import KIND_NAMES, KIND_OF
from ninja_game.sim.level import Body, Level, is_box
from ninja_game.sim.schema.world_fields import MAX_EVENTS

_Records: TypeAlias = NDArray[np.void]  # an array of NINJA_RECORD or OBJECT_RECORD

NINJA_NAME = "ninja"  # kind of the ninja's rows, beside the kinds of objects

NINJA_RECORD = np.dtype(
    [("x", "<f8"), ("y", "<f8"), ("prev_x", "<f8"), ("prev_y", "<f8"), ("s", "<i4"), ("gold", "<i4")]
)
"""The ninja after a tick: position and the one before (px), state number, gold collected."""

OBJECT_RECORD = np.dtype([("x", "<f8"), ("y", "<f8"), ("s", "<i4")])
"""An object after a tick: position (px) and status number, both by kind."""

MAX_CELLS = 8_000_000  # most objects times ticks in a trace: some 330 MB while it is made

_BLOCK = 256  # ticks traced at a time if the end of the run is unknown


@dataclass(frozen=True)
class RunTrace:
    """Everything a run shows: ``ninja`` NINJA_RECORD (ticks,), ``objects`` OBJECT_RECORD (ticks, objects).

    ``ids`` and ``kinds`` name the columns of ``objects``, ids ascending; ninjas and inert objects are not among them.
    ``events``: per tick, names with blanks between, where asked for.
    """

    ninja: NDArray[np.void] = field(repr=False)
    objects: NDArray[np.void] = field(repr=False)
    ids: tuple[int, ...]
    kinds: tuple[str, ...]
    events: tuple[str, ...] = field(default=(), repr=False)

    def __eq__(self, other: object) -> bool:
        """Whether the traces are the same in every bit."""
        return isinstance(other, RunTrace) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def _key(self) -> tuple[object, ...]:
        return self.ninja.tobytes(), self.objects.tobytes(), self.ids, self.kinds, self.events


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
    """The trace of a recording: of exactly ``ticks`` ticks, else until its end as in ``verify`` and ``after`` more.

    Raises, naming file and record, LevelError for a level that cannot be played, BudgetError beyond ``budget``.
    """
    level, body = recording.level, recording.body
    with named_errors(recording):
        inputs = recording.replay.playback(min(recording.ticks + after, MAX_TICKS) if ticks is None else ticks)
        more = after if ticks is None else None
        return trace_level(
            level, inputs, body=body, memory=memory, with_objects=objects, events=events, after=more, budget=budget
        )


def trace_level(
    level: Level,
    inputs: Iterable[SupportsIndex],
    *,
    body: Body = "circle",
    memory: str = "auto",
    with_objects: bool = True,
    events: bool = False,
    after: int | None = None,
    budget: int = NO_LIMIT,
) -> RunTrace:
    """Run all of ``inputs``, past any end, and record the ninja after each tick (canonical numbers).

    ``with_objects``: record objects too. ``events``: record the names of events. ``after``: end that many ticks behind
    the first exit contact or death. Raises as ``run_level`` does.
    """
    inputs = inputs_of(inputs)
    check_inputs(inputs)
    end = len(inputs)
    most = affordable_ticks(level, budget)
    world = open_worlds(memory, level, box=is_box(body), at_once=True, ticks=min(end, most))
    kinds = [world.observe(id_ + 1)[0] for id_ in range(world.number("id_count"))] if with_objects else []
    ids = tuple(id_ for id_, kind in enumerate(kinds) if KIND_OF[kind].traced)
    at_once = _BLOCK if after is not None else MAX_TICKS
    if world.name == "plain":
        at_once = min(at_once, affordable_ticks(level, PLAIN_WORK))
    blocks: list[TraceArrays] = []
    over = after is None
    while world.tick() < end:
        if world.tick() == most or (over and end > most):
            raise over_budget(level, end, budget)
        world = switch_to_compiled(world, memory, end - world.tick())
        block = inputs[world.tick() : min(end, most, world.tick() + at_once)]
        if (world.tick() + len(block)) * len(ids) > MAX_CELLS:
            found = f"{world.tick() + len(block)} ticks of {len(ids)} objects"
            raise ArgumentError(f"the trace is too large: {found}; leave the objects out, or trace fewer ticks")
        blocks.append(world.trace(block, [id_ + 1 for id_ in ids], events=events))
        if not over and world.outcome():
            over = True
            last = int(np.argmax(ninja_columns(blocks[-1])["outcome"] != 0))
            end = min(end, world.tick() - len(block) + last + 1 + (after or 0))
    names = tuple(KIND_NAMES[kinds[id_]] for id_ in ids)
    ninja = [_ninja_rows(record) for record in blocks] or [np.empty(0, NINJA_RECORD)]
    objects = [object_rows(record, len(ids)) for record in blocks] or [np.empty((0, len(ids)), OBJECT_RECORD)]
    happened = [event_names(record) for record in blocks]
    return RunTrace(
        np.concatenate(ninja)[:end], np.concatenate(objects)[:end], ids, names, tuple(chain(*happened))[:end]
    )


def ninja_columns(record: TraceArrays) -> dict[str, NDArray[Any]]:
    """TRACED_FLOATS (float64) and TRACED_INTS (int32) by name, each (ticks,)."""
    places = np.frombuffer(record.ninja, np.float64).reshape(-1, len(TRACED_FLOATS))
    numbers = np.frombuffer(record.numbers, np.int32).reshape(-1, len(TRACED_INTS))
    return dict(zip((*TRACED_FLOATS, *TRACED_INTS), (*places.T, *numbers.T), strict=True))


def _ninja_rows(record: TraceArrays) -> NDArray[np.void]:
    seen = ninja_columns(record)
    rows = np.empty(len(seen["x"]), NINJA_RECORD)
    for name in NINJA_RECORD.names or ():
        rows[name] = seen["state" if name == "s" else name]
    return rows


def object_rows(record: TraceArrays, count: int) -> NDArray[np.void]:
    """The objects of each tick as OBJECT_RECORD."""
    shape = len(record.numbers) // len(TRACED_INTS), count
    places = np.frombuffer(record.places, np.float64).reshape(*shape, 2)
    rows = np.empty(shape, OBJECT_RECORD)
    rows["x"], rows["y"] = places[..., 0], places[..., 1]
    rows["s"] = np.frombuffer(record.statuses, np.int32).reshape(shape)
    return rows


def switched_doors(record: TraceArrays, count: int) -> NDArray[np.uint8]:
    """Whether each object is a door in its changed state: an automatic or locked one open, a trap closed."""
    return np.frombuffer(record.switched, np.uint8).reshape(len(record.numbers) // len(TRACED_INTS), count)


def event_names(record: TraceArrays) -> tuple[str, ...]:
    """The names of each tick's events, with blanks between."""
    ticks = np.frombuffer(record.events, np.uint8).reshape(-1, MAX_EVENTS)
    names = [""] * len(ticks)
    for tick in np.flatnonzero(ticks[:, 0]).tolist():
        names[tick] = " ".join(EVENT_NAMES[number - 1] for number in ticks[tick].tolist() if number)
    return tuple(names)


@dataclass(frozen=True)
class TraceDigests:
    """Digests of a run: of the ninja's records, of all records, and of each object by its id (8 hex digits)."""

    ticks: int
    ninja_sha256: str
    run_sha256: str
    objects: dict[int, str] = field(default_factory=dict)


def trace_digests(trace: RunTrace) -> TraceDigests:
    """The digests that identify a run to the last bit."""
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
    """The first difference of two traces: the tick, and in it the first object and field."""

    tick: int
    subject: str  #: the ninja, an object with its id, or the run
    field: str  #: its name in the trace
    ours: object
    theirs: object
    section: str = ""  #: section of the specification, for the report

    def __str__(self) -> str:
        about = f" (specification: {self.section})" if self.section else ""
        return f"tick {self.tick}: {self.subject}: {self.field} is {self.ours}, expected {self.theirs}{about}"


def first_difference(ours: RunTrace, theirs: RunTrace, section: str = "") -> Difference | None:
    """The first tick, object and field that differ, None if nothing does.

    Objects are compared if both traces have objects; ``section`` of the specification is copied into the report.
    """
    with_objects = bool(ours.ids and theirs.ids)
    if with_objects and (ours.ids, ours.kinds) != (theirs.ids, theirs.kinds):
        mine, other = dict(zip(ours.ids, ours.kinds, strict=True)), dict(zip(theirs.ids, theirs.kinds, strict=True))
        id_ = min(key for key in mine.keys() | other.keys() if mine.get(key) != other.get(key))
        return Difference(0, f"object {id_}", "kind", mine.get(id_, "missing"), other.get(id_, "missing"), section)
    shared = min(len(ours.ninja), len(theirs.ninja))
    first = _first_unequal(ours.ninja[:shared, np.newaxis], theirs.ninja[:shared, np.newaxis], (NINJA_NAME,))
    if with_objects:
        names = tuple(f"object {id_} ({kind})" for id_, kind in zip(ours.ids, ours.kinds, strict=True))
        in_objects = _first_unequal(ours.objects[:shared], theirs.objects[:shared], names)
        first = in_objects if first is None or (in_objects and in_objects[0] < first[0]) else first
    if first:
        return Difference(*first, section)
    if len(ours.ninja) != len(theirs.ninja):
        return Difference(shared, "run", "number of ticks", len(ours.ninja), len(theirs.ninja), section)
    return None


def _first_unequal(
    ours: _Records, theirs: _Records, names: tuple[str, ...]
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


def trace_rows(trace: RunTrace) -> Iterator[dict[str, Any]]:
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
