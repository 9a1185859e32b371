"""Two runs side by side: the lead of one over the other at splits and places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.notations import Marker
from ninja_game.runs.splits import run_splits
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND

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
    """For each position of one run, float64 (ticks, 2), the tick at which the other is at the same place, or -1.

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
        start, end = max(0, diagonal - m + 1), min(n, diagonal + 1)
        shift = m - 1 - diagonal
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
