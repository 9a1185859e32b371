"""Two runs of a level compared: where they part, and which is ahead at each split and at each place."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.runs.splits import run_splits
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND

NEAR = CELL
"""How far apart two runs may be at the same place, px: a cell."""

MAX_PAIRS = 100_000_000
"""Most pairs of ticks that are looked at: two runs of four minutes."""

MAX_TOGETHER = 60_000
"""Most ticks of both: each costs some work by itself."""


class Lead(NamedTuple):
    """How far one run is ahead of the other at a place (px): their ticks there.

    ``at``: the split that both reach there, or "" where it is only a place.
    """

    at: str
    x: float
    y: float
    tick: int
    other: int

    @property
    def ahead(self) -> int:
        """Ticks by which the first run is there earlier; negative where it is later."""
        return self.other - self.tick


@dataclass(frozen=True)
class Comparison:
    """What two runs of a level have in common.

    ``first_keys``: the first tick with other keys; ``first_place``: the first tick after which the ninja is at another
    place, or the shorter run is over; None where there is no such tick. ``splits``: the lead at each split that both
    reach; ``places``: the lead wherever the second run passes within NEAR px of the first, tick by tick of the first.
    ``positions``: of both, float64 (ticks, 2), px.
    """

    first_keys: int | None
    first_place: int | None
    splits: tuple[Lead, ...]
    places: tuple[Lead, ...] = field(repr=False)
    positions: tuple[NDArray[np.float64], NDArray[np.float64]] = field(repr=False)


def compare_runs(ours: Recording, theirs: Recording, budget: int = RUN_BUDGET) -> Comparison:
    """Compare two recordings of one level, each until its end as ``verify`` has it.

    Raises ArgumentError for recordings of different levels, and for runs that are too long to be compared place by
    place; what ``run_splits`` raises.
    """
    if level_digest(ours.level) != level_digest(theirs.level):
        raise ArgumentError(f"{ours.file} and {theirs.file} are recordings of different levels")
    here, there = run_splits(ours, budget=budget), run_splits(theirs, budget=budget)
    first_keys = _first_unequal(*(np.frombuffer(each.inputs, np.uint8) for each in (ours, theirs)))
    first_place = _first_unequal(here.positions, there.positions)
    other_splits = there.by_key
    splits = tuple(
        Lead(str(split), split.x, split.y, split.tick, other_splits[split.key].tick)
        for split in here.splits
        if split.key in other_splits
    )
    partner = aligned(here.positions, there.positions)
    places = tuple(
        Lead("", x, y, tick, other)
        for tick, ((x, y), other) in enumerate(zip(here.positions.tolist(), partner.tolist(), strict=True))
        if other >= 0
    )
    return Comparison(first_keys, first_place, splits, places, (here.positions, there.positions))


def each_second(places: tuple[Lead, ...]) -> list[Lead]:
    """Of the leads tick by tick, those at the end of every second of the first run."""
    return [lead for lead in places if (lead.tick + 1) % TICKS_PER_SECOND == 0]


def aligned(ours: NDArray[np.float64], theirs: NDArray[np.float64]) -> NDArray[np.intp]:
    """For each position of one run, float64 (ticks, 2), the tick at which the other is at the same place; -1: nowhere.

    Dynamic time warping: of all ways to go through both runs in step, forwards only, the one whose sum of distances is
    smallest. Raises ArgumentError for more than MAX_PAIRS pairs of ticks, or MAX_TOGETHER ticks.
    """
    n, m = len(ours), len(theirs)
    if n * m > MAX_PAIRS or n + m > MAX_TOGETHER:
        raise ArgumentError(f"runs of {n} and {m} ticks are too long to be compared place by place")
    came_from = np.zeros((n, m), np.uint8)
    # Costs of the last two diagonals, by the tick of ours plus one; all paths begin in front of both first ticks.
    costs, last, before = (np.full(n + 1, np.inf) for _ in range(3))
    before[0] = 0.0
    for diagonal in range(n + m - 1):
        i = np.arange(max(0, diagonal - m + 1), min(n, diagonal + 1))
        j = diagonal - i
        ways = np.stack([before[i], last[i], last[i + 1]])
        came_from[i, j] = way = np.argmin(ways, axis=0)
        costs[i + 1] = ways[way, np.arange(len(i))] + np.hypot(*(ours[i] - theirs[j]).T)
        # What the oldest holds beyond the next diagonal is never read, but for the place in front of the first ticks.
        before[0] = np.inf
        costs, last, before = before, costs, last
    return _nearest_on_path(came_from, ours, theirs)


def _nearest_on_path(
    came_from: NDArray[np.uint8], ours: NDArray[np.float64], theirs: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Follow the cheapest path back; of each of our ticks the nearest of those that it is paired with."""
    i, j = (size - 1 for size in came_from.shape)
    partner = np.full(len(ours), -1)
    smallest = np.full(len(ours), NEAR)
    while i >= 0 and j >= 0:
        distance = float(np.hypot(*(ours[i] - theirs[j])))
        if distance <= smallest[i]:
            partner[i], smallest[i] = j, distance
        way = came_from[i, j]
        i, j = i - (way != 2), j - (way != 1)
    return partner


def _first_unequal(ours: NDArray[np.generic], theirs: NDArray[np.generic]) -> int | None:
    """The first index at which two arrays differ, or at which only one has an element; None for equal ones."""
    shared = min(len(ours), len(theirs))
    unequal = (ours[:shared] != theirs[:shared]).reshape(shared, -1).any(axis=1)
    if unequal.any():
        return int(np.argmax(unequal))
    return None if len(ours) == len(theirs) else shared
