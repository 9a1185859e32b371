"""Everything a run shows, tick by tick, as NumPy arrays. On both memories, bit for bit."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_memory
from ninja_game.errors import ArgumentError
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import check_inputs
from ninja_game.sim.kinds import KIND_NAMES, KIND_OF
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import TRACED_NUMBERS, TRACED_PLACES, TraceRecord
from ninja_game.sim.memory.schema import MAX_EVENTS
from ninja_game.simulation import Body, is_box

NINJA_RECORD = np.dtype(
    [("x", "<f8"), ("y", "<f8"), ("prev_x", "<f8"), ("prev_y", "<f8"), ("s", "<i4"), ("gold", "<i4")]
)
"""The ninja after a tick: position and the one before (px), state number, gold collected."""

OBJECT_RECORD = np.dtype([("x", "<f8"), ("y", "<f8"), ("s", "<i4")])
"""An object after a tick: position (px) and status number, both by kind."""

MAX_CELLS = 8_000_000
"""Most objects times ticks in a trace: some 330 MB while it is made."""


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


def trace_level(
    level: Level,
    inputs: bytes,
    *,
    body: Body = "circle",
    memory: str = "auto",
    with_objects: bool = True,
    events: bool = False,
) -> RunTrace:
    """Run all of ``inputs``, whatever happens, and record ninja and objects after each tick (canonical numbers).

    ``with_objects``: record objects too. ``events``: record the names of what happens. Raises what ``run_level`` does.
    """
    check_inputs(inputs)
    world = open_memory(memory, level, box=is_box(body))
    kinds = [world.observe(id_ + 1)[0] for id_ in range(world.id_count)] if with_objects else []
    ids = tuple(id_ for id_, kind in enumerate(kinds) if KIND_OF[kind].traced)
    if len(inputs) * len(ids) > MAX_CELLS:
        found = f"{len(inputs)} ticks of {len(ids)} objects"
        raise ArgumentError(f"the trace is too large: {found}; leave the objects out, or trace fewer ticks")
    record = world.trace(inputs, [id_ + 1 for id_ in ids], events=events)
    names = tuple(KIND_NAMES[kinds[id_]] for id_ in ids)
    return RunTrace(_ninja_rows(record), object_rows(record, len(ids)), ids, names, event_names(record))


def ninja_columns(record: TraceRecord) -> dict[str, NDArray[Any]]:
    """TRACED_PLACES (float64) and TRACED_NUMBERS (int32) by name, each (ticks,)."""
    places = np.frombuffer(record.ninja, np.float64).reshape(-1, len(TRACED_PLACES))
    numbers = np.frombuffer(record.numbers, np.int32).reshape(-1, len(TRACED_NUMBERS))
    return dict(zip((*TRACED_PLACES, *TRACED_NUMBERS), (*places.T, *numbers.T), strict=True))


def _ninja_rows(record: TraceRecord) -> NDArray[np.void]:
    """The ninja of each tick as NINJA_RECORD."""
    seen = ninja_columns(record)
    rows = np.empty(len(seen["x"]), NINJA_RECORD)
    for name in NINJA_RECORD.names or ():
        rows[name] = seen["state" if name == "s" else name]
    return rows


def object_rows(record: TraceRecord, count: int) -> NDArray[np.void]:
    """The objects of each tick as OBJECT_RECORD."""
    shape = len(record.numbers) // len(TRACED_NUMBERS), count
    places = np.frombuffer(record.places, np.float64).reshape(*shape, 2)
    rows = np.empty(shape, OBJECT_RECORD)
    rows["x"], rows["y"] = places[..., 0], places[..., 1]
    rows["s"] = np.frombuffer(record.statuses, np.int32).reshape(shape)
    return rows


def switched_doors(record: TraceRecord, count: int) -> NDArray[np.uint8]:
    """Whether each object is a door that is not as it began: an automatic or locked one open, a trap closed."""
    return np.frombuffer(record.switched, np.uint8).reshape(len(record.numbers) // len(TRACED_NUMBERS), count)


def event_names(record: TraceRecord) -> tuple[str, ...]:
    """The names of each tick's events, with blanks between."""
    ticks = np.frombuffer(record.events, np.uint8).reshape(-1, MAX_EVENTS)
    names = [""] * len(ticks)
    for tick in np.flatnonzero(ticks[:, 0]).tolist():
        names[tick] = " ".join(EVENT_NAMES[number - 1] for number in ticks[tick].tolist() if number)
    return tuple(names)
