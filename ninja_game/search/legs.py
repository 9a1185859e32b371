"""What runs in legs are made of: checkpoints, frontiers, a leg and its fields, and the order in which to fetch gold."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.search.heuristics import FARTHEST, DistanceField, Heuristics, point_at
from ninja_game.search.nodes import StateWords

UNBOUNDED = 1 << 30
"""More gold than there is: what a leg wants at the exit that is to end elsewhere. And more ticks than a run has."""
ROLLOUTS = 16
"""Random runs that try whether the end of a leg can be survived. Not tuned."""
FIELDS_KEPT = 400  # fields to single pieces, 53 KB each, before all are computed again
MASKS_KEPT = 16  # sets of fields to all pieces, likewise

Spend = Callable[[int], bool]
"""Counts the ticks that a search has just simulated; true: it is over."""

FieldOf = Callable[[int, float, float], DistanceField]
"""The field of a switch state, for a ninja at (x, y)."""


@dataclass
class Checkpoint:
    """A save-state on the way of a run."""

    words: StateWords
    tick: int
    taken: int  #: gold, a bit a piece
    mask: int  #: what is open, a bit a switch
    place: tuple[float, float]  #: of the ninja, px
    variety: bytes = b""  #: what sets it apart: what the enemies do, for some searches the velocity too
    before: Checkpoint | None = None  #: the checkpoint before it
    inputs: bytes = b""  #: from there to here

    def run(self) -> bytes:
        """The inputs from the start of the level."""
        parts = []
        checkpoint: Checkpoint | None = self
        while checkpoint:
            parts.append(checkpoint.inputs)
            checkpoint = checkpoint.before
        return b"".join(reversed(parts))


@dataclass
class Frontier:
    """Checkpoints with the same gold and switches, earliest first; the tour of the rest; tries, and their ticks."""

    taken: int
    mask: int
    checkpoints: list[Checkpoint] = field(default_factory=list)
    tour: list[int] = field(default_factory=list)
    tries: int = 0
    spent: int = 0
    failed: Counter[int] = field(default_factory=Counter)

    def add(self, checkpoint: Checkpoint, width: int) -> None:
        """Keep a checkpoint if it is among the earliest; of each state of the enemies at least one, if possible."""
        ranks: Counter[bytes] = Counter()
        ranked = []
        for other in sorted([*self.checkpoints, checkpoint], key=lambda checkpoint: checkpoint.tick):
            ranked.append((ranks[other.variety], other))
            ranks[other.variety] += 1
        kept = sorted(ranked, key=lambda pair: pair[0])[:width]
        self.checkpoints = sorted((checkpoint for _, checkpoint in kept), key=lambda checkpoint: checkpoint.tick)

    @property
    def count(self) -> int:
        """Pieces collected."""
        return self.taken.bit_count()


def pieces_of(taken: int) -> Iterator[int]:
    """The pieces of a set of bits."""
    return (k for k in range(taken.bit_length()) if taken >> k & 1)


class Leg(NamedTuple):
    """From some checkpoints to the next piece of gold or switch, or to the exit."""

    roots: Sequence[Checkpoint]
    until: int  #: gold at which it ends, as where what is open differs from ``mask``; 0: only at the exit
    mask: int
    gold: int  #: pieces that a run must have at the exit
    ends: int  #: how many ends are enough
    rollouts: int  #: tries to survive at an end, 0: it need not be survived
    field: FieldOf  #: makes the fields
    wanted: int = 0  #: switches of which one must have been touched at the end, but for a few ends; 0: any
    target: int = 0  #: slot of the only object where it ends, once that is taken or open; 0: any


class LegFields:
    """The distance fields of the legs of one level, made when they are first wanted."""

    def __init__(self, heuristics: Heuristics) -> None:
        self.heuristics = heuristics
        self.points = np.array([point_at(x, y) for x, y in heuristics.gold_places], np.int64)
        self._tours: dict[int, DistanceField] = {}
        self._pieces: dict[tuple[int, int], DistanceField] = {}

    def tours(self, mask: int) -> DistanceField:
        """The fields of all pieces and of the exit in a switch state (``Heuristics.tour_fields``)."""
        if mask not in self._tours:
            if len(self._tours) >= MASKS_KEPT:
                self._tours.clear()
            self._tours[mask] = self.heuristics.tour_fields(mask)
        return self._tours[mask]

    def to_piece(self, piece: int, mask: int, x: float, y: float) -> DistanceField:
        """The field of a piece in a switch state."""
        if (piece, mask) not in self._pieces:
            if len(self._pieces) >= FIELDS_KEPT:
                self._pieces.clear()
            self._pieces[piece, mask] = self.heuristics.field_to(self.heuristics.gold_places[piece], mask, x, y)
        return self._pieces[piece, mask]


Distances = NDArray[np.float64]  # ticks from each stop (row) to each stop (column)

MAX_SEGMENT = 4  # stops that are moved together


def short_tour(start: Distances, between: Distances, end: Distances, order: Sequence[int] = ()) -> list[int]:
    """All stops in an order with a short way from the start over all of them to the end.

    ``start``, ``end``: ticks from the start to each stop, from each stop to the end; ``between``: from stop to stop.
    ``order``: stops in an order to begin with; those that it lacks are inserted where they cost least.
    """
    tour = list(order)
    missing = set(range(len(start))) - set(tour)
    while missing:
        # The nearest to what is in the tour first, so that a far one joins the neighbours it passes.
        costs = {stop: _best_place(stop, stop, tour, start, between, end) for stop in sorted(missing)}
        stop = min(costs, key=lambda stop: (costs[stop][0], stop))
        tour.insert(costs[stop][1], stop)
        missing.remove(stop)
    while _move_a_segment(tour, start, between, end):
        pass
    return tour


def _best_place(
    first: int, last: int, tour: list[int], start: Distances, between: Distances, end: Distances
) -> tuple[float, int]:
    """The least cost of a segment (its first and last stop) within a tour, and before which stop that is."""
    if not tour:
        return float(start[first] + end[last]), 0
    stops = np.array(tour)
    into = np.append(start[first], between[stops, first])
    out = np.append(between[last, stops], end[last])
    skipped = np.concatenate(([start[stops[0]]], between[stops[:-1], stops[1:]], [end[stops[-1]]]))
    added = into + out - skipped
    place = int(np.argmin(added))
    return float(added[place]), place


def _move_a_segment(tour: list[int], start: Distances, between: Distances, end: Distances) -> bool:
    """Move the first segments that are better elsewhere, also turned round; whether any was moved."""
    moved = False
    for length in range(1, min(MAX_SEGMENT, len(tour) - 1) + 1):
        for index in range(len(tour) - length + 1):
            segment = tour[index : index + length]
            rest = tour[:index] + tour[index + length :]
            before = start[segment[0]] if index == 0 else between[rest[index - 1], segment[0]]
            after = end[segment[-1]] if index == len(rest) else between[segment[-1], rest[index]]
            if index == 0:
                direct = start[rest[0]]
            elif index == len(rest):
                direct = end[rest[-1]]
            else:
                direct = between[rest[index - 1], rest[index]]
            present = float(before + after - direct)
            added, place = _best_place(segment[0], segment[-1], rest, start, between, end)
            turned_added, turned_place = _best_place(segment[-1], segment[0], rest, start, between, end)
            if length > 1:
                inside = float(between[segment[:-1], segment[1:]].sum())
                turned_added += float(between[segment[1:], segment[:-1]].sum()) - inside
            if min(added, turned_added) > present - 1.0:
                continue
            if turned_added < added:
                segment.reverse()
                place = turned_place
            tour[:] = rest[:place] + segment + rest[place:]
            moved = True
    return moved


FAILED = 200.0
"""Ticks that a way counts at least which a leg did not find."""
# Legs against distance fields, which know no run-ups; set on tours of gold, whose figures were not kept.
SLOWER = 1.4  # times the ticks
TURN = 10.0  # ticks more for each piece


class PieceTicks:
    """Ticks between the pieces of a level, to be learned from the legs of its runs."""

    def __init__(self, fields: LegFields) -> None:
        self._fields = fields
        count = len(fields.points)
        # The last row: from the start of the level.
        self._measured: Distances = np.full((count + 1, count), np.nan)
        self._factors: Distances = np.ones((count + 1, count))

    def change(self, random: np.random.Generator, noise: float) -> None:
        """Change all estimates at random by up to half of ``noise`` (a part of them), for other tours."""
        self._factors = 1.0 + noise * (random.random(self._factors.shape) - 0.5)

    def learn(self, before: Checkpoint, after: Checkpoint) -> None:
        """Learn from a leg how many ticks it is from one piece to the next."""
        new = list(pieces_of(after.taken & ~before.taken))
        if len(new) == 1 and before.mask == after.mask:
            row, ticks = _last_piece(before), max(1.0, float(after.tick - before.tick))
            self._measured[row, new[0]] = np.fmin(self._measured[row, new[0]], ticks)

    def note_failure(self, before: Checkpoint, piece: int) -> None:
        """Note that a leg did not reach a piece: it counts as farther from now on."""
        row = _last_piece(before)
        known = np.nan_to_num(self._measured[row, piece], nan=0.0)
        self._measured[row, piece] = min(FARTHEST, max(FAILED, 1.5 * known))

    def estimate(self, checkpoint: Checkpoint) -> tuple[Distances, Distances, Distances]:
        """Ticks from piece to piece, from a checkpoint to each piece, and from each to the exit."""
        mask, here = checkpoint.mask, point_at(*checkpoint.place)
        fields, points = self._fields.tours(mask), self._fields.points
        by_fields = np.vstack([fields[:-1, points].T, fields[:-1, here]]).astype(float)
        by_fields = np.minimum(SLOWER * by_fields + TURN, FARTHEST)
        row = _last_piece(checkpoint)
        known = np.vstack([self._measured[:-1], self._measured[row]])
        factors = np.vstack([self._factors[:-1], self._factors[row]])
        ticks = np.where(np.isnan(known), by_fields, known) * factors
        home = SLOWER * np.append(fields[-1, points], fields[-1, here]).astype(float)
        return ticks[:-1], ticks[-1], np.minimum(home, FARTHEST)


def _last_piece(checkpoint: Checkpoint) -> int:
    """The piece collected last before a checkpoint, -1 if there is none."""
    while checkpoint.before and checkpoint.before.taken == checkpoint.taken:
        checkpoint = checkpoint.before
    return max(pieces_of(checkpoint.taken & ~(checkpoint.before.taken if checkpoint.before else 0)), default=-1)
