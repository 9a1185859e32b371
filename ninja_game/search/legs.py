"""What runs in legs are made of: checkpoints on the way, frontiers of them, a leg between them, and their fields."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ninja_game.search.heuristics import Field, Heuristics, point_at
from ninja_game.search.nodes import StateWords

MORE_THAN_ANY = 1 << 30
"""More gold than there is: what a leg wants at the exit that is to end elsewhere. And more ticks than a run has."""
ROLLOUTS = 16
"""Random runs that try whether the end of a leg can be survived. Not tuned."""
FIELDS_KEPT, MASKS_KEPT = 400, 16
"""Fields to pieces (53 KB each), and sets of fields to all pieces, that are kept before all are computed again."""

Spend = Callable[[int], bool]
"""Counts the ticks that a search has just simulated; true: it is over."""

FieldOf = Callable[[int, float, float], Field]
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


class LegFields:
    """The distance fields of the legs of one level, made when they are first wanted."""

    def __init__(self, heuristics: Heuristics) -> None:
        self.heuristics = heuristics
        self.points = np.array([point_at(x, y) for x, y in heuristics.gold_places], np.int64)
        self._tours: dict[int, Field] = {}
        self._pieces: dict[tuple[int, int], Field] = {}

    def tours(self, mask: int) -> Field:
        """The fields of all pieces and of the exit in a switch state (``Heuristics.tour_fields``)."""
        if mask not in self._tours:
            if len(self._tours) >= MASKS_KEPT:
                self._tours.clear()
            self._tours[mask] = self.heuristics.tour_fields(mask)
        return self._tours[mask]

    def to_piece(self, piece: int, mask: int, x: float, y: float) -> Field:
        """The field of a piece in a switch state."""
        if (piece, mask) not in self._pieces:
            if len(self._pieces) >= FIELDS_KEPT:
                self._pieces.clear()
            self._pieces[piece, mask] = self.heuristics.field_to(self.heuristics.gold_places[piece], mask, x, y)
        return self._pieces[piece, mask]
