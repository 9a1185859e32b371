"""Near copies: runs that are an earlier one of the level with some keys changed."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from heapq import nlargest
from itertools import groupby, pairwise

from ninja_game.runs.run import RunResult
from ninja_game.sim.inputs import KEYS_DOWN

CHANGED = 0.65
"""Ticks changed, added or left out for each stroke, up to which the inputs of two runs are the same: people who do the
same move most strokes by several ticks (the table in docs/board.md)."""

ON_PATH, FEWEST_STROKES = 0.75, 8
"""Share of a run's places on another's path, from which the paths are the same; with fewer strokes all have one way."""

SAME_PRESSES, FEWEST_PRESSES, SHIFTED = 0.45, 16, 10
"""Share of an earlier run's presses and releases that a run has at the same ticks, from which it is a copy; how many
these must be; ticks that all of them may be earlier or later. Of 865 honest pairs none has so many."""

ALIGNED = 4
"""Earlier runs whose inputs are aligned with those of a new one: those with the most of its strokes."""


@dataclass(frozen=True)
class Course:
    """What is compared of a run.

    ``keys``: those down in each tick; ``strokes``: spans of the same keys, each as its number among equal ones, 2^20
    times its keys and 2^24 times its ticks; ``presses``: bits of the keys pressed and of those released, eight a tick;
    ``places``: where the ninja was, in whole pixels, x + 10^6 y.
    """

    keys: bytes
    strokes: frozenset[int]
    presses: int
    places: frozenset[float]

    def inputs_shared(self, other: Course) -> int:
        """How many ticks have the inputs of the other's; 0 where too many have not."""
        changed = edit_distance(self.keys, other.keys)
        alike = changed <= CHANGED * max(len(self.strokes), len(other.strokes))
        return max(0, len(self.keys) - changed) if alike else 0

    def presses_shared(self, other: Course) -> int:
        """How many presses and releases are at the ticks of the other's; 0 where too few are."""
        needed = max(FEWEST_PRESSES, SAME_PRESSES * other.presses.bit_count())
        if self.presses.bit_count() < needed:
            return 0
        later = self.presses << 8 * SHIFTED
        shared = max((other.presses << 8 * shift & later).bit_count() for shift in range(2 * SHIFTED + 1))
        return shared if shared >= needed else 0

    def places_shared(self, other: Course) -> int:
        """How many places are on the other's path; 0 where too few are."""
        needed = ON_PATH * len(self.places)
        if len(other.places) < needed or len(self.strokes) < FEWEST_STROKES:
            return 0
        shared = len(self.places & other.places)
        return shared if shared >= needed else 0


def course_of(inputs: bytes, run: RunResult) -> Course:
    """The course of a run with such inputs."""
    keys = bytes(each & KEYS_DOWN for each in inputs)
    met: Counter[int] = Counter()
    strokes = []
    for down, ticks in groupby(keys):
        stroke = down + 16 * len(list(ticks)) << 20
        met[stroke] += 1
        strokes.append(stroke + met[stroke])
    presses = bytes(down & ~before | (before & ~down) << 4 for before, down in pairwise(keys))
    x, y = run.positions.round().T
    return Course(keys, frozenset(strokes), int.from_bytes(presses, "little"), frozenset((x + 1e6 * y).tolist()))


def near_ones(course: Course, earlier: Sequence[Course]) -> list[tuple[int, str]]:
    """Which earlier courses share enough of this one, and what in words; the nearest first."""
    found: list[tuple[float, int, str]] = []
    for index, other in enumerate(earlier):
        if shared := course.places_shared(other):
            places = len(course.places)
            found.append((shared / places, -index, f"{shared} of the {places} places on its way are those of"))
        if shared := course.presses_shared(other):
            presses = other.presses.bit_count()
            words = f"{shared} of {presses} presses and releases are at the ticks of"
            found.append((shared / presses, -index, words))
    # Aligning is slow: only where nothing else tells.
    rest = () if found else range(len(earlier))
    for index in nlargest(ALIGNED, rest, key=lambda each: len(course.strokes & earlier[each].strokes)):
        if shared := course.inputs_shared(earlier[index]):
            ticks = len(course.keys)
            found.append((shared / ticks, -index, f"{shared} of its {ticks} ticks have the inputs of"))
    return [(-index, words) for _, index, words in sorted(found, reverse=True)]


def edit_distance(ours: bytes, theirs: bytes) -> int:
    """How many ticks must be changed, added or left out to make one from the other.

    A column of differences is the bits of two numbers (Myers 1999, Hyyrö 2003).

    >>> edit_distance(b"kitten", b"sitting"), edit_distance(b"", b"ab")
    (3, 2)
    """
    if not ours:
        return len(theirs)
    every, last = (1 << len(ours)) - 1, 1 << (len(ours) - 1)
    at: dict[int, int] = defaultdict(int)
    for place, keys in enumerate(ours):
        at[keys] |= 1 << place
    more, less, distance = every, 0, len(ours)
    for keys in theirs:
        same = at[keys]
        diagonal = (((same & more) + more) ^ more) | same | less
        right, left = (less | ~(diagonal | more)) & every, more & diagonal
        distance += bool(right & last) - bool(left & last)
        right = right << 1 | 1
        more, less = (left << 1 | ~(diagonal | right)) & every, right & diagonal & every
    return distance
