"""Moments on the way to all gold, and fronts of moments with the same gold and switches."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from ninja_game.search.nodes import StateWords


@dataclass
class Checkpoint:
    """A save-state on a run: its words, ticks, gold, open doors, place; the moment before it and the inputs since."""

    words: StateWords
    tick: int
    taken: int
    mask: int
    place: tuple[float, float]
    routines: bytes = b""
    before: Checkpoint | None = None
    inputs: bytes = b""

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
    """Moments with the same gold and switches, earliest first; in which order to fetch the rest; tries, their ticks."""

    taken: int
    mask: int
    checkpoints: list[Checkpoint] = field(default_factory=list)
    tour: list[int] = field(default_factory=list)
    tries: int = 0
    spent: int = 0
    failed: Counter[int] = field(default_factory=Counter)

    def add(self, checkpoint: Checkpoint, width: int) -> None:
        """Keep a moment if it is among the earliest; of each state of the enemies at least one, if possible."""
        ranks: Counter[bytes] = Counter()
        ranked = []
        for other in sorted([*self.checkpoints, checkpoint], key=lambda checkpoint: checkpoint.tick):
            ranked.append((ranks[other.routines], other))
            ranks[other.routines] += 1
        kept = sorted(ranked, key=lambda pair: pair[0])[:width]
        self.checkpoints = sorted((checkpoint for _, checkpoint in kept), key=lambda checkpoint: checkpoint.tick)

    @property
    def count(self) -> int:
        """Pieces collected."""
        return self.taken.bit_count()


def pieces_of(taken: int) -> Iterator[int]:
    """The pieces of a set of bits."""
    return (k for k in range(taken.bit_length()) if taken >> k & 1)
