"""Runs side by side: the ticks of gold, switches, doors and the end, and the lead of one over the other."""

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
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.notations import Marker
from ninja_game.runs.deaths import death_text
from ninja_game.runs.recording_reader import named_errors
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.level import is_box
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND
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

    ``memory``: as of ``Simulation``; "auto" is the plain one while there is little work.
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
    """The fewest ticks between each two known splits that follow one another in some run; None: the start, tick 0."""
    shortest: dict[tuple[_Key | None, _Key], int] = {}
    for run in runs:
        points = [(None, 0), *((split.key, split.tick) for split in run.splits if split.key in known)]
        for (before, start), (key, end) in pairwise(points):
            assert key is not None  # noqa: S101 - only the start has none
            shortest[before, key] = min(end - start, shortest.get((before, key), end - start))
    return shortest


NEAR_DISTANCE = CELL  # greatest distance of two runs at the same place, px: a cell

MAX_PAIRS = 100_000_000  # most pairs of ticks that are compared: two runs of four minutes

MAX_TOGETHER = 60_000  # most ticks of both: each costs some work by itself


class Lead(NamedTuple):
    """The lead of one run over the other at a place (px): their ticks there.

    ``at``: the split or the marker that both reach there, or "" if it is only a place.
    """

    at: str
    x: float
    y: float
    tick: int
    other: int  #: the other run's tick there

    @property
    def ahead(self) -> int:
        """Ticks by which the first run is earlier; negative: later."""
        return self.other - self.tick

    @property
    def name(self) -> str:
        """``at``; of a place the seconds of the first run."""
        return self.at or f"{self.tick // TICKS_PER_SECOND} s"


@dataclass(frozen=True)
class Comparison:
    """The common events and places of two runs of a level.

    ``first_keys``: the first tick with other keys; ``first_place``: the first tick after which the ninja is at another
    place, or the shorter run is over; None if there is no such tick. ``splits``: the lead at each split that both
    reach; ``places``: the lead wherever the second run passes within NEAR_DISTANCE px of the first, tick by tick of
    the first. ``positions``: of both, float64 (ticks, 2), px. ``deaths``: the killers, in words; "": none.
    """

    first_keys: int | None
    first_place: int | None
    splits: tuple[Lead, ...]
    places: tuple[Lead, ...] = field(repr=False)
    positions: tuple[NDArray[np.float64], NDArray[np.float64]] = field(repr=False)
    deaths: tuple[str, str] = ("", "")


def compare_runs(ours: Recording, theirs: Recording, budget: int = RUN_BUDGET) -> Comparison:
    """Compare two recordings of one level, each until its end as in ``verify``.

    Raises ArgumentError for recordings of different levels, and for runs that are too long to compare place by place;
    and as ``run_splits`` does.
    """
    if level_digest(ours.level) != level_digest(theirs.level):
        raise ArgumentError(f"{ours.file} and {theirs.file} are recordings of different levels")
    our_splits, their_splits = run_splits(ours, budget=budget), run_splits(theirs, budget=budget)
    positions = our_splits.positions, their_splits.positions
    first_keys = _first_unequal(*(np.frombuffer(run.inputs, np.uint8) for run in (ours, theirs)))
    first_place = _first_unequal(*positions)
    other_splits = their_splits.by_key
    splits = tuple(
        Lead(split.name, split.x, split.y, split.tick, other_splits[split.key].tick)
        for split in our_splits.splits
        if split.key in other_splits
    )
    partner = aligned(*positions)
    places = tuple(
        Lead("", x, y, tick, other)
        for tick, ((x, y), other) in enumerate(zip(our_splits.positions.tolist(), partner.tolist(), strict=True))
        if other >= 0
    )
    return Comparison(first_keys, first_place, splits, places, positions, (our_splits.death, their_splits.death))


def each_second(places: tuple[Lead, ...]) -> list[Lead]:
    """The leads at full seconds of the first run, chosen from leads tick by tick: those of tick 40 (1.000 s), 80 ..."""
    return [lead for lead in places if lead.tick and lead.tick % TICKS_PER_SECOND == 0]


def aligned(ours: NDArray[np.float64], theirs: NDArray[np.float64]) -> NDArray[np.intp]:
    """For each position of one run, float64 (ticks, 2), the tick at which the other is at the same place; -1: never.

    Dynamic time warping: of all ways to step forwards through both runs, the one with the least sum of distances.
    Raises ArgumentError for more than MAX_PAIRS pairs of ticks, or MAX_TOGETHER ticks.
    """
    n, m = len(ours), len(theirs)
    if n * m > MAX_PAIRS or n + m > MAX_TOGETHER:
        raise ArgumentError(f"runs of {n} and {m} ticks are too long to be compared place by place")
    came_from = np.zeros((n, m), np.uint8)
    # Each diagonal is a slice: of these cells in steps of m - 1, and of the other run backwards.
    cells = came_from.reshape(-1)
    (x, y), (other_x, other_y) = ours.T.copy(), theirs[::-1].T.copy()
    # Costs of the last two diagonals, by the tick of ours plus one; all paths begin in front of both first ticks.
    costs, last, before = (np.full(n + 1, np.inf) for _ in range(3))
    before[0] = 0.0
    for diagonal in range(n + m - 1):
        start, end, shift = max(0, diagonal - m + 1), min(n, diagonal + 1), m - 1 - diagonal
        here, there = slice(start, end), slice(start + shift, end + shift)
        both, left, right = before[start:end], last[start:end], last[start + 1 : end + 1]
        one = np.minimum(left, right)
        step = (both > one) * (1 + (left > right))  # 0: both step, 1: only ours, 2: only the other
        cells[start * (m - 1) + diagonal : (end - 1) * (m - 1) + diagonal + 1 : max(1, m - 1)] = step
        apart = np.hypot(x[here] - other_x[there], y[here] - other_y[there])
        costs[start + 1 : end + 1] = np.minimum(both, one) + apart
        # Entries of the oldest beyond the next diagonal are never read, except the place in front of the first ticks.
        before[0] = np.inf
        costs, last, before = before, costs, last
    return _nearest_on_path(came_from, ours, theirs)


SPEED_AHEAD = 10
"""Ticks for which two ninjas are extrapolated at their speeds, to tell how near their states are. Not tuned."""


def nearest_state(ours: NDArray[np.float64], tick: int, theirs: NDArray[np.float64]) -> int:
    """The tick of another run before which its ninja was nearest to ours before a tick, by place and speed; 0 for 0.

    Positions after each tick, float64 (ticks, 2), px; a difference of speed counts by SPEED_AHEAD ticks.
    """
    if not tick:
        return 0
    place = ours[tick - 1]
    speed = place - ours[max(tick - 2, 0)]
    speeds = np.diff(theirs, axis=0, prepend=theirs[:1])
    apart = np.hypot(*(theirs - place).T) + SPEED_AHEAD * np.hypot(*(speeds - speed).T)
    return int(np.argmin(apart)) + 1


def _nearest_on_path(
    came_from: NDArray[np.uint8], ours: NDArray[np.float64], theirs: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Follow the cheapest path back; for each of our ticks the nearest of its partners."""
    i, j = (size - 1 for size in came_from.shape)
    partner = np.full(len(ours), -1)
    smallest = np.full(len(ours), NEAR_DISTANCE)
    while i >= 0 and j >= 0:
        distance = float(np.hypot(*(ours[i] - theirs[j])))
        if distance <= smallest[i]:
            partner[i], smallest[i] = j, distance
        step = came_from[i, j]
        i, j = i - (step != 2), j - (step != 1)
    return partner


def _first_unequal(ours: NDArray[np.generic], theirs: NDArray[np.generic]) -> int | None:
    """The first index at which two arrays differ, or at which only one has an element; None for equal ones."""
    shared = min(len(ours), len(theirs))
    unequal = (ours[:shared] != theirs[:shared]).reshape(shared, -1).any(axis=1)
    if unequal.any():
        return int(np.argmax(unequal))
    return None if len(ours) == len(theirs) else shared


@dataclass(frozen=True)
class LeadTable:
    """The leads at splits, markers and seconds, by ticks of the first run, and the comparison.

    ``apart``: full seconds of the first run without a row, since the other one is not near there.
    """

    rows: tuple[Lead, ...]
    comparison: Comparison
    apart: int

    @cached_property
    def leads(self) -> dict[int, int]:
        """The leads at splits and markers, by the first run's ticks."""
        return {row.tick: row.ahead for row in self.rows if row.at}


def lead_table(ours: Recording, theirs: Recording, markers: Sequence[Marker]) -> LeadTable:
    """Compare a run, with its markers, to another one. Raises what ``compare_runs`` does."""
    comparison = compare_runs(ours, theirs)
    there = {lead.tick: lead for lead in comparison.places}
    marked = [there[tick]._replace(at=name) for tick, name in markers if tick in there]
    seconds = each_second(comparison.places)
    apart = (len(comparison.positions[0]) - 1) // TICKS_PER_SECOND - len(seconds)
    rows = sorted([*comparison.splits, *marked, *seconds], key=lambda lead: lead.tick)
    return LeadTable(tuple(rows), comparison, apart)
