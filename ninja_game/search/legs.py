"""Parts of a run in legs: checkpoints, frontiers, a leg and its fields, and the order of the gold."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.search.heuristics import FARTHEST, DistanceField, Heuristics, point_at
from ninja_game.search.nodes import StateWords

UNBOUNDED = 1 << 30
"""More gold than any level has, so that a leg cannot end at the exit; also more ticks than any run has."""
ROLLOUTS = 16  # Random runs that test whether the end of a leg can be survived. Not tuned.
FIELDS_KEPT = 400  # fields to single pieces, 53 KB each, before all are discarded
MASKS_KEPT = 16  # sets of fields to all pieces

Spend = Callable[[int], bool]  # counts ticks that a search has just simulated; returns true if it must end
FieldOf = Callable[[int, float, float], DistanceField]  # the field of a switch state, for a ninja at (x, y)


@dataclass
class Checkpoint:
    """A save-state of a run."""

    words: StateWords  #: the save-state
    tick: int
    taken: int  #: collected gold, one bit per piece
    mask: int  #: open switches, one bit per switch
    place: tuple[float, float]  #: place of the ninja, px
    variety: bytes = b""  #: key of its variety: what the enemies do, for some searches also the velocity
    before: Checkpoint | None = None  #: the previous checkpoint
    inputs: bytes = b""  #: inputs from the previous checkpoint to this one

    def run(self) -> bytes:
        """The inputs from the start of the level to here."""
        parts = []
        checkpoint: Checkpoint | None = self
        while checkpoint:
            parts.append(checkpoint.inputs)
            checkpoint = checkpoint.before
        return b"".join(reversed(parts))


@dataclass
class Frontier:
    """Checkpoints with the same gold and switches, earliest first, and the searches from them."""

    taken: int  #: collected gold, one bit per piece
    mask: int  #: open switches, one bit per switch
    checkpoints: list[Checkpoint] = field(default_factory=list)
    tour: list[int] = field(default_factory=list)  #: numbers of the pieces to come
    tries: int = 0  #: searches from here
    spent: int = 0  #: their ticks
    failed: Counter[int] = field(default_factory=Counter)  #: failed searches, by piece

    def add(self, checkpoint: Checkpoint, width: int) -> None:
        """Keep a checkpoint if it is among the earliest; if possible, keep one of each variety."""
        ranks: Counter[bytes] = Counter()
        ranked = []
        for other in sorted([*self.checkpoints, checkpoint], key=lambda checkpoint: checkpoint.tick):
            ranked.append((ranks[other.variety], other))
            ranks[other.variety] += 1
        kept = sorted(ranked, key=lambda pair: pair[0])[:width]
        self.checkpoints = sorted((checkpoint for _, checkpoint in kept), key=lambda checkpoint: checkpoint.tick)

    @property
    def count(self) -> int:
        """Number of pieces collected."""
        return self.taken.bit_count()


def put_checkpoint(
    frontiers: dict[tuple[int, int], Frontier], gold: int, checkpoint: Checkpoint, tour: list[int], width: int
) -> Frontier:
    """Put a checkpoint into its frontier, a new one with the rest of the tour where there is none; gives it."""
    key = (gold, checkpoint.mask)
    if key not in frontiers:
        frontiers[key] = Frontier(*key, tour=[piece for piece in tour if not checkpoint.taken >> piece & 1])
    frontiers[key].add(checkpoint, width)
    return frontiers[key]


def piece_numbers(taken: int) -> Iterator[int]:
    """The numbers of the pieces in a set of bits."""
    return (k for k in range(taken.bit_length()) if taken >> k & 1)


class Leg(NamedTuple):
    """A search from some checkpoints to the next piece of gold or switch, or to the exit."""

    roots: Sequence[Checkpoint]  #: checkpoints at which it starts
    until: int  #: pieces at which it ends, as it does when the open switches differ from ``mask``; 0: only at the exit
    mask: int
    gold: int  #: pieces that a run must have at the exit
    ends: int  #: number of ends that are enough
    rollouts: int  #: random runs that must survive an end, 0: no test
    field: FieldOf  #: makes the distance fields
    wanted: int = 0  #: switches of which one must be touched at the end, except for a few ends; 0: any
    target: int = 0  #: slot of the only object that ends it, by being taken or opened; 0: any


class LegFields:
    """The distance fields of the legs of one level, made on demand. ``tours``: as ``Heuristics.tour_fields``."""

    def __init__(self, heuristics: Heuristics) -> None:
        self.heuristics = heuristics
        self.points = np.array([point_at(x, y) for x, y in heuristics.gold_places], np.int64)
        self.tours = lru_cache(MASKS_KEPT)(heuristics.tour_fields)
        self._pieces: dict[tuple[int, int], DistanceField] = {}

    def to_piece(self, piece: int, mask: int, x: float, y: float) -> DistanceField:
        """The field of a piece in a switch state."""
        if (piece, mask) not in self._pieces:
            if len(self._pieces) >= FIELDS_KEPT:
                self._pieces.clear()
            self._pieces[piece, mask] = self.heuristics.field_to(self.heuristics.gold_places[piece], mask, x, y)
        return self._pieces[piece, mask]


_Distances = NDArray[np.float64]  # ticks from a stop (row) to a stop (column)

MAX_SEGMENT = 4  # most stops that are moved together


def short_tour(start: _Distances, between: _Distances, end: _Distances, order: Sequence[int] = ()) -> list[int]:
    """Order all stops so that the way from the start over all of them to the end is short.

    ``start``: ticks from the start to the stops; ``end``: from the stops to the end; ``between``: from stop to stop.
    ``order``: a first order of some stops; the missing ones are inserted where they cost least.
    """
    tour = list(order)
    missing = set(range(len(start))) - set(tour)
    while missing:
        # Insert the nearest missing stop first, so that a far one can join the neighbours on its way.
        costs = {stop: _best_place(stop, stop, tour, start, between, end) for stop in sorted(missing)}
        stop = min(costs, key=lambda stop: (costs[stop][0], stop))
        tour.insert(costs[stop][1], stop)
        missing.remove(stop)
    while _move_a_segment(tour, start, between, end):
        pass
    return tour


def _best_place(
    first: int, last: int, tour: list[int], start: _Distances, between: _Distances, end: _Distances
) -> tuple[float, int]:
    """The least cost of inserting a segment (its first and last stop) into a tour, and the place for it."""
    if not tour:
        return float(start[first] + end[last]), 0
    stops = np.array(tour)
    into = np.append(start[first], between[stops, first])
    costs = np.append(between[last, stops], end[last])
    skipped = np.concatenate(([start[stops[0]]], between[stops[:-1], stops[1:]], [end[stops[-1]]]))
    added = into + costs - skipped
    place = int(np.argmin(added))
    return float(added[place]), place


def _move_a_segment(tour: list[int], start: _Distances, between: _Distances, end: _Distances) -> bool:
    """Move the first segment that is better elsewhere, also reversed; tells whether one was moved."""
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


_FAILED = 200.0  # least ticks for a way that a leg did not find
# Legs take longer than distance fields say, which know no run-ups; fitted to gold tours whose figures were not kept.
SLOWER = 1.4  # factor of the ticks
TURN = 10.0  # ticks added per piece


class PieceTicks:
    """Ticks between the pieces of a level, learned from the legs of its runs."""

    def __init__(self, fields: LegFields) -> None:
        self._fields = fields
        count = len(fields.points)
        # The last row holds the ticks from the start of the level.
        self._measured: _Distances = np.full((count + 1, count), np.nan)
        self._factors: _Distances = np.ones((count + 1, count))

    def change(self, random: np.random.Generator, noise: float) -> None:
        """Change all estimates at random, by up to half of ``noise`` (a share of them), to get other tours."""
        self._factors = 1.0 + noise * (random.random(self._factors.shape) - 0.5)

    def learn(self, before: Checkpoint, after: Checkpoint) -> None:
        """Learn from a leg the ticks from one piece to the next."""
        new = list(piece_numbers(after.taken & ~before.taken))
        if len(new) == 1 and before.mask == after.mask:
            row, ticks = _last_piece(before), max(1.0, float(after.tick - before.tick))
            self._measured[row, new[0]] = np.fmin(self._measured[row, new[0]], ticks)

    def note_failure(self, before: Checkpoint, piece: int) -> None:
        """Record that a leg did not reach a piece: the piece counts as farther from now on."""
        row = _last_piece(before)
        known = np.nan_to_num(self._measured[row, piece], nan=0.0)
        self._measured[row, piece] = min(FARTHEST, max(_FAILED, 1.5 * known))

    def estimate(self, checkpoint: Checkpoint) -> tuple[_Distances, _Distances, _Distances]:
        """Ticks from piece to piece, from a checkpoint to the pieces, and from the pieces to the exit."""
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
    """The last piece collected before a checkpoint, -1 if there is none."""
    while checkpoint.before and checkpoint.before.taken == checkpoint.taken:
        checkpoint = checkpoint.before
    return max(piece_numbers(checkpoint.taken & ~(checkpoint.before.taken if checkpoint.before else 0)), default=-1)
