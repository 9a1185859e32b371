"""The splits of a run: the ticks of its gold, switches, doors and end; and the table of several runs' splits."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_worlds
from ninja_game.backend.worlds import Worlds
from ninja_game.budget import RUN_BUDGET, affordable_ticks, over_budget
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.runs.deaths import death_text
from ninja_game.runs.recording_reader import named_errors
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.level import is_box
from ninja_game.sim.schema.world_fields import MAX_EVENTS
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT, OUTCOME_NAMES

_NAMES = {
    "gold-taken": "gold", "exit-opened": "switch of exit", "lock-opened": "locked door", "trap-closed": "trap door",
    "door-opened": "door", "won": "exit", "died": "death",
}  # fmt: skip
_BLOCK = 1024  # ticks that are looked ahead for events

SPLIT_EVENTS = tuple(_NAMES)  # the events that are splits (`ninja_game/sim/events.py`)


_Key = tuple[str, int | None, int]
"""Identifies a split in several runs: event, id of the object, and which occurrence of it, from 0."""


class Split(NamedTuple):
    """An event of a run: tick, event, id of its object (None: the ninja's own), place in px.

    ``number``: how often the same has happened before in this run; automatic doors open again and again.
    """

    tick: int
    event: str
    object_id: int | None
    number: int
    x: float
    y: float

    @property
    def key(self) -> _Key:
        return self.event, self.object_id, self.number

    @property
    def name(self) -> str:
        """The event in plain words.

        >>> Split(90, "door-opened", 3, 1, 60.0, 540.0).name, Split(120, "won", None, 0, 60.0, 540.0).name
        ('door 3, time 2', 'exit')
        """
        suffix = f", time {self.number + 1}" if self.number else ""
        return self.kind if self.object_id is None else f"{self.kind} {self.object_id}{suffix}"

    @property
    def kind(self) -> str:
        """The kind of event, without its object."""
        return _NAMES.get(self.event, self.event)


@dataclass(frozen=True)
class RunSplits:
    """The splits of a run in order, until its end as in ``verify``.

    ``positions``: float64 (ticks, 2), px, the ninja after each tick. ``death``: its killer, in words; "": none.
    """

    recording: Recording = field(repr=False)
    outcome: str
    gold: int
    splits: tuple[Split, ...]
    positions: NDArray[np.float64] = field(repr=False)
    death: str = ""

    @property
    def ticks(self) -> int:
        return len(self.positions)

    @cached_property
    def level_digest(self) -> str:
        """The digest of the level: only runs of one level have a table together."""
        return level_digest(self.recording.level)

    @property
    def by_key(self) -> dict[_Key, Split]:
        return {split.key: split for split in self.splits}


def run_splits(
    recording: Recording, events: Sequence[str] = SPLIT_EVENTS, budget: int = RUN_BUDGET, memory: str = "plain"
) -> RunSplits:
    """Run a recording and note its splits, of these events only.

    ``memory``: as in ``Simulation``; "auto" is the plain one while there is little work.
    Raises, naming file and record, LevelError for a level that cannot be played, BudgetError for a run that is not over
    when its ``budget`` of work is.
    """
    with named_errors(recording):
        world = open_worlds(memory, recording.level, box=is_box(recording.body), at_once=True, ticks=recording.ticks)
    inputs = recording.inputs[: affordable_ticks(recording.level, budget)]
    splits: list[Split] = []
    places: list[NDArray[np.float64]] = [np.empty(0)]
    counts: dict[tuple[str, int | None], int] = {}
    while world.tick() < len(inputs) and not world.outcome():
        for keys in _spans(world, inputs[world.tick() : world.tick() + _BLOCK], events):
            places.append(np.asarray(world.run(keys).places))
            for event in world.events():
                name, id_ = EVENT_NAMES[event.kind], event.slot - 1 if event.slot else None
                # A ninja that dies in the tick in which it touches the exit has passed.
                if name in events and not (name == "died" and world.outcome() == OUTCOME_EXIT):
                    number = counts.get((name, id_), 0)
                    counts[name, id_] = number + 1
                    # Only traces name the killer; runs that die share the split.
                    id_ = None if name == "died" else id_
                    splits.append(Split(world.tick() - 1, name, id_, number, event.x, event.y))
            if world.outcome():
                break
    if not world.outcome() and world.tick() < recording.ticks:
        with named_errors(recording):
            raise over_budget(recording.level, recording.ticks, budget)
    dead = world.outcome() == OUTCOME_DEAD
    death = death_text(world.events(), world.ninja(), world.objects()) if dead else ""
    positions = np.concatenate(places).reshape(-1, 2)
    return RunSplits(recording, OUTCOME_NAMES[world.outcome()], world.gold(), tuple(splits), positions, death)


def _spans(world: Worlds, keys: bytes, events: Sequence[str]) -> list[bytes]:
    """Inputs to run one after the other; each tick with one of these events is the last of its span.

    On the plain memory each tick is one, as it would take twice the time to look ahead.
    """
    ends = list(range(1, len(keys)))
    if world.name == "compiled":
        state = world.save()
        numbers = [number for number, name in enumerate(EVENT_NAMES, 1) if name in events]
        happened = np.frombuffer(world.trace(keys, (), events=True).events, np.uint8).reshape(-1, MAX_EVENTS)
        world.restore(state)
        ends = (np.flatnonzero(np.isin(happened[:-1], numbers).any(axis=1)) + 1).tolist()
    return [keys[first:last] for first, last in pairwise([0, *ends, len(keys)])]


class SplitRow(NamedTuple):
    """A row of a table: a split, its tick in each run (None: not reached), and the fastest segment to it in ticks.

    ``best_segment``: the fewest ticks that any run needs from the split of the row before, whatever else it reaches in
    between; None if no run goes from that one to this one.
    """

    split: Split
    ticks: tuple[int | None, ...]
    best_segment: int | None


def best_run(runs: Sequence[RunSplits]) -> RunSplits:
    """The run that the others are compared with: the shortest with an exit, else the longest."""
    passed = [run for run in runs if run.outcome == "exit"]
    return min(passed, key=lambda run: run.ticks) if passed else max(runs, key=lambda run: run.ticks)


def split_table(runs: Sequence[RunSplits], best: RunSplits) -> list[SplitRow]:
    """A row for each split of ``best``, in its order; then a row for each split that only other runs reach, by tick."""
    others = {split.key: split for run in runs for split in sorted(run.splits, reverse=True)}
    known = best.by_key
    order = [*best.splits, *sorted(split for key, split in others.items() if key not in known)]
    indexed = [run.by_key for run in runs]
    segments = _shortest_segments([best, *runs], known)
    before: _Key | None = None
    rows = []
    for split in order:
        ticks = tuple(splits[split.key].tick if split.key in splits else None for splits in indexed)
        rows.append(SplitRow(split, ticks, segments.get((before, split.key)) if split.key in known else None))
        before = split.key
    return rows


def sum_of_best(rows: Sequence[SplitRow]) -> int:
    """The end, in ticks, of a run with the fastest of all segments.

    A hint, not a lower bound: the speed at the end of a segment is part of the next one.
    """
    return sum(row.best_segment for row in rows if row.best_segment is not None)


def _shortest_segments(runs: Sequence[RunSplits], known: Container[_Key]) -> dict[tuple[_Key | None, _Key], int]:
    """The fewest ticks between each two known splits that follow one another in some run; from None: from the start."""
    shortest: dict[tuple[_Key | None, _Key], int] = {}
    for run in runs:
        points = [(None, 0), *((split.key, split.tick) for split in run.splits if split.key in known)]
        for (before, start), (key, end) in pairwise(points):
            assert key is not None  # noqa: S101 - only the start has none
            shortest[before, key] = min(end - start, shortest.get((before, key), end - start))
    return shortest
