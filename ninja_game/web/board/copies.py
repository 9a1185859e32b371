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

    ``keys``: those down in each tick; ``strokes``: spans of the same keys with their ticks and their number among
    equal ones; ``presses``: each press and release, as 16 times its tick and what changed; ``places``: where the ninja
    was, in whole pixels, x + 10^6 y.
    """

    keys: bytes
    strokes: frozenset[tuple[int, int, int]]
    presses: frozenset[int]
    places: frozenset[float]

    def inputs_shared(self, other: Course) -> int:
        """How many ticks have the inputs of the other's; 0 where too many have not."""
        changed = edit_distance(self.keys, other.keys)
        alike = changed <= CHANGED * max(len(self.strokes), len(other.strokes))
        return max(0, len(self.keys) - changed) if alike else 0

    def presses_shared(self, other: Course) -> int:
        """How many presses and releases are at the ticks of the other's; 0 where too few are."""
        if len(self.presses) < FEWEST_PRESSES:
            return 0
        shifts = range(-16 * SHIFTED, 16 * SHIFTED + 1, 16)
        shared = max(len({each + shift for each in other.presses} & self.presses) for shift in shifts)
        return shared if shared >= max(FEWEST_PRESSES, SAME_PRESSES * len(other.presses)) else 0

    def places_shared(self, other: Course) -> int:
        """How many places are on the other's path; 0 where too few are."""
        shared = len(self.places & other.places)
        return shared if shared >= ON_PATH * len(self.places) and len(self.strokes) >= FEWEST_STROKES else 0


def course_of(inputs: bytes, run: RunResult) -> Course:
    """The course of a run with such inputs."""
    keys = bytes(each & KEYS_DOWN for each in inputs)
    met: Counter[tuple[int, int]] = Counter()
    strokes = []
    for down, ticks in groupby(keys):
        stroke = down, sum(1 for _ in ticks)
        met[stroke] += 1
        strokes.append((*stroke, met[stroke]))
    presses = {
        16 * tick + 2 * key + bool(down & key)
        for tick, (before, down) in enumerate(pairwise(keys))
        for key in (1, 2, 4)
        if (before ^ down) & key
    }
    x, y = run.positions.round().T
    return Course(keys, frozenset(strokes), frozenset(presses), frozenset((x + 1e6 * y).tolist()))


def nearest(course: Course, earlier: Sequence[Course]) -> tuple[int, str] | None:
    """Which earlier course shares most of this one, and what in words; None where none shares enough."""
    found: list[tuple[float, int, str]] = []
    for index, other in enumerate(earlier):
        if shared := course.places_shared(other):
            places = len(course.places)
            found.append((shared / places, -index, f"{shared} of the {places} places on its way are those of"))
        if shared := course.presses_shared(other):
            presses = len(other.presses)
            words = f"{shared} of {presses} presses and releases are at the ticks of"
            found.append((shared / presses, -index, words))
    for index in nlargest(ALIGNED, range(len(earlier)), key=lambda each: len(course.strokes & earlier[each].strokes)):
        if shared := course.inputs_shared(earlier[index]):
            ticks = len(course.keys)
            found.append((shared / ticks, -index, f"{shared} of its {ticks} ticks have the inputs of"))
    _, index, words = max(found, default=(0.0, 1, ""))
    return (-index, words) if words else None


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
