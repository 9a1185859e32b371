"""Copies: runs that repeat an earlier one of the level, exactly or with some keys changed."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from hashlib import sha256
from heapq import heappop, heappush, nlargest, nsmallest
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from ninja_game.board.memo import Memo, program, values_digest
from ninja_game.board.players import folded
from ninja_game.board.runs import OWN, Key, Rejected, Rows, Run
from ninja_game.runs.run import RunResult, run_level
from ninja_game.sim.inputs import KEYS_DOWN

MAX_COMPARED = 1000
"""Earlier runs of a level to compare a new one with: the fastest, the likeliest to be copied."""

CHANGED = 0.65
"""Most ticks changed, added or left out per stroke for the inputs of two runs to count as the same: people who do the
same move differ in most strokes by several ticks (the table in docs/board.md).
"""

ON_PATH = 0.75  # least share of a run's places on another's path for the paths to count as the same

MIN_STROKES = 8  # with fewer strokes all runs take the same path

SAME_PRESSES = 0.45
"""Least share of an earlier run's presses and releases at the same ticks for a copy. None of 865 honest pairs has it.
"""

MIN_PRESSES = 16  # least presses for a decision
SHIFTED = 10  # ticks by which all of them may be earlier or later

NAMED = ", who is named as its origin"
DOUBTFUL = ": doubtful, as its inputs are others, so it keeps its place"

ALIGNED = 4  # earlier runs whose inputs are aligned with a new one's: those with the most of its strokes


@dataclass(frozen=True)
class Course:
    """The features for comparing runs.

    ``keys``: those down in each tick; ``strokes``: spans of the same keys, each as its number among equal ones, 2^20
    times its keys and 2^24 times its ticks; ``presses``: keys pressed and keys released, each as a bit of eight, plus
    eight times its tick; ``places``: the ninja's places in whole pixels, x + 10^6 y.
    """

    keys: bytes
    strokes: frozenset[int]
    presses: frozenset[int]
    places: frozenset[float]

    def inputs_shared(self, other: Course) -> int:
        """The number of ticks with the other's inputs; 0 if too many differ."""
        changed = edit_distance(self.keys, other.keys)
        alike = changed <= CHANGED * max(len(self.strokes), len(other.strokes))
        return max(0, len(self.keys) - changed) if alike else 0


def course_of(inputs: bytes, run: RunResult) -> Course:
    keys = bytes(pressed & KEYS_DOWN for pressed in inputs)
    met: Counter[int] = Counter()
    strokes = []
    for down, ticks in groupby(keys):
        stroke = down + 16 * len(list(ticks)) << 20
        met[stroke] += 1
        strokes.append(stroke + met[stroke])
    changes = [down & ~before | (before & ~down) << 4 for before, down in pairwise(keys)]
    presses = frozenset(8 * tick + bit for tick, bits in enumerate(changes) for bit in range(8) if bits >> bit & 1)
    x, y = run.positions.round().T
    return Course(keys, frozenset(strokes), presses, frozenset((x + 1e6 * y).tolist()))


class Common:
    """The courses with a feature, such as a place: a bit for each of their columns."""

    def __init__(self) -> None:
        self._rows: dict[float, int] = {}
        self._bits = np.zeros((64, 1), np.uint8)

    def mark(self, features: Iterable[float], column: int, *, has: bool) -> None:
        """Add these features to the course in a column, or remove them."""
        rows = [self._rows.setdefault(feature, len(self._rows)) for feature in features]
        high, wide = self._bits.shape
        if len(self._rows) > high or column // 8 >= wide:
            more = max(0, 2 * len(self._rows) - high), max(0, column // 8 + column // 16 + 1 - wide)
            self._bits = np.pad(self._bits, ((0, more[0]), (0, more[1])))
        bit = 1 << column % 8
        if has:
            self._bits[rows, column // 8] |= bit
        else:
            self._bits[rows, column // 8] &= 255 - bit

    def counts(self, features: Iterable[float], columns: int) -> NDArray[np.int64]:
        """The number of these features in each of the first columns."""
        rows = np.array([self._rows[feature] for feature in features if feature in self._rows], np.intp)
        bits = np.unpackbits(self._bits[rows, : (columns + 7) // 8], axis=1, count=columns, bitorder="little")
        # The narrow sum takes a third of the time.
        counts: NDArray[np.int64] = bits.sum(0, np.uint16 if len(rows) < 2**16 else np.int64).astype(np.int64)
        return counts


class Courses:
    """The courses of the ``most`` fastest earlier runs of a level, each in a column, to compare a new one with all.

    ``numbers``: the number of each column's run.
    """

    def __init__(self, most: int) -> None:
        self.numbers = np.array([], np.int64)
        self._press_counts = np.array([], np.int64)
        self._most = most
        self._courses: dict[int, Course] = {}
        self._slowest: list[tuple[int, int, int]] = []
        self._strokes, self._presses, self._places = Common(), Common(), Common()

    def add(self, number: int, tick: int, course: Callable[[], Course]) -> None:
        """Add a run by its number, higher than those before, and its time, unless all columns have faster ones."""
        column = len(self._slowest)
        if column == self._most:
            if self._slowest[0] > (-tick, -number, 0):
                return
            column = heappop(self._slowest)[2]
            self._mark(self._courses[column], column, has=False)
        self._courses[column] = here = course()
        self._mark(here, column, has=True)
        if column == len(self.numbers):
            self.numbers, self._press_counts = np.append(self.numbers, 0), np.append(self._press_counts, 0)
        self.numbers[column], self._press_counts[column] = number, len(here.presses)
        heappush(self._slowest, (-tick, -number, column))

    def _mark(self, course: Course, column: int, *, has: bool) -> None:
        for common, features in ((self._strokes, course.strokes), (self._presses, course.presses)):
            common.mark(features, column, has=has)
        self._places.mark(course.places, column, has=has)

    def near(self, course: Course) -> Callable[[NDArray[np.bool_]], tuple[list[int], str, bool]]:
        """A function of columns: the numbers of the runs near a course, nearest first; what the first shares.

        And whether the inputs are what is shared: on a short level with one obvious route people share only the path.
        """
        columns = len(self.numbers)
        places, presses = self._places.counts(course.places, columns), np.zeros(columns, np.int64)
        of = self._press_counts
        for shift in range(-SHIFTED, SHIFTED + 1):
            moved = (press + 8 * shift for press in course.presses)
            presses = np.maximum(presses, self._presses.counts(moved, columns))
        on_path = (places >= ON_PATH * len(course.places)) & (len(course.strokes) >= MIN_STROKES)
        pressed = (presses >= SAME_PRESSES * of) & (presses >= MIN_PRESSES)

        of_path = places / max(1, len(course.places)) * on_path
        of_presses = presses / np.maximum(1, of) * pressed
        alike = np.maximum(of_path, of_presses)

        def nearest(chosen: NDArray[np.bool_]) -> tuple[list[int], str, bool]:
            near = np.flatnonzero(chosen & (on_path | pressed))
            near = near[np.lexsort((self.numbers[near], -alike[near], ~pressed[near]))]
            found, said = self.numbers[near].tolist(), ""
            if found:
                first = near[0]
                said = f"{places[first]} of the {len(course.places)} places on its way, and {presses[first]} of "
                said += f"{of[first]} presses and releases, are those of"
                if pressed[first]:
                    return found, said, True
            # Aligning is slow: only where the other tests do not decide.
            strokes, ticks = self._strokes.counts(course.strokes, columns), len(course.keys)
            most = nlargest(ALIGNED, np.flatnonzero(chosen).tolist(), key=strokes.__getitem__)
            shared = [(-course.inputs_shared(self._courses[column]), int(self.numbers[column])) for column in most]
            aligned = sorted(pair for pair in shared if pair[0])
            if aligned:
                found = [*(number for _, number in aligned), *found]
                said = f"{-aligned[0][0]} of its {ticks} ticks have the inputs of"
            return found, said, bool(aligned)

        return nearest


def edit_distance(ours: bytes, theirs: bytes) -> int:
    """The least number of ticks to change, add or leave out to make one from the other.

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


def without_copies(runs: list[Run], memo: Memo, owners: Rows) -> tuple[list[Run], list[Rejected]]:
    """The runs that are no copies, with near copies marked, and the copies.

    If several players sent the same run at one moment, nobody knows who was first: all stay, with a remark. ``owners``:
    as of Ledger.
    """
    on_level: dict[str, list[Run]] = defaultdict(list)
    copies: list[Rejected] = []
    ways: dict[tuple[str, str], list[Run]] = defaultdict(list)
    for run in runs:
        way = run.level, run.way
        owner = owners.get(way)
        if owner and way not in ways and owner["added"] < run.added:
            why = f"a copy of an earlier run by {owner['player']}, which was withdrawn or does not count any more"
            copies.append(Rejected(*run.key, "copy", why, run.player, run.entry.title, run.way, run.added))
            continue
        same = ways[way]
        if not same or (run.added == same[0].added != "" and run.player not in (copy.player for copy in same)):
            on_level[run.level].append(run)
            same.append(run)
        else:
            first = next((copy for copy in same if copy.player == run.player), same[0])
            stolen = first.player != run.player and first.added < run.added
            what = f"a copy of the run by {first.player} in" if stolen else "the same run as"
            why, kind = f"{what} {first.file}", OWN if run.episode and first.player == run.player else "copy"
            copies.append(Rejected(*run.key, kind, why, run.player, run.entry.title, run.way, run.added, first.key))
    together: dict[Key, str] = {}
    for same in ways.values():
        for run in same if len(same) > 1 else ():
            others = " and ".join(f"{copy.player} in {copy.file}" for copy in same if copy is not run)
            together[run.key] = f"the same run as that by {others}, which came in together with it: whose is not known"
    kept = [run for level in on_level.values() for run in _remarked(level, memo, together)]
    return sorted(kept, key=lambda run: run.order), copies


def _remarked(runs: list[Run], memo: Memo, together: Mapping[Key, str]) -> Iterator[Run]:
    """The runs of a level, in order, each with a remark if it is near to earlier ones by others alone.

    Of two of one moment nobody knows which was first: the second has the remark, and is no near copy. That is when the
    board took them in: dates of an older board make no near copy. Nor is an assisted run one that names whose it was.
    ``together``: what is said instead of those that are the same run.
    """
    if len({run.player for run in runs}) == 1:
        yield from runs
        return
    compared = _Compared(runs[0].level, memo)
    runs = sorted(runs, key=lambda run: run.taken or run.added)
    for _, moment in groupby(runs, key=lambda run: run.taken or run.added):
        compared.begin_moment()
        for run in moment:
            said, whose, earlier, sure = compared.near(run)
            compared.add(run)
            named = earlier and folded(whose) in run.origins
            near = said * (earlier and sure and not named)
            if earlier:
                said += NAMED if named else DOUBTFUL * (not sure)
            else:
                said = together.get(run.key, said + ", of the same moment" * bool(said and run.added))
            yield (
                replace(run, remark="; ".join(filter(None, (said, run.remark))), near=near, derived=named)
                if said
                else run
            )


class _Compared:
    """The runs of a level that were compared so far, with cached results."""

    def __init__(self, level: str, memo: Memo) -> None:
        self._memo = memo
        self._key = values_digest([program(), level])
        self._runs: list[Run] = []
        self._courses, self._known, self._earlier = Courses(MAX_COMPARED), 0, 0
        self._last: tuple[Key, Course] | None = None

    def _key_of(self, run: Run) -> str:
        """A remark depends only on the run, and on all earlier runs of the level and their moments."""
        return sha256(f"{self._key} {run.digest} {run.record} {run.player}".encode("utf-8", "replace")).hexdigest()

    def begin_moment(self) -> None:
        """All runs added so far are of earlier moments."""
        self._key, self._earlier = values_digest([self._key]), len(self._runs)

    def add(self, run: Run) -> None:
        self._key = self._key_of(run)
        self._runs.append(run)

    def near(self, run: Run) -> tuple[str, str, bool, bool]:
        """The run by another player that a run nearly copies, as a sentence, and that player; "" for none.

        And whether it is of an earlier moment, and whether the inputs are what is shared.
        """
        noted = self._memo.recall(key := self._key_of(run))
        if not (isinstance(noted, list) and [*map(type, noted)] == [str, str, bool, bool]):
            before = range(self._known, len(self._runs))
            for number in sorted(nsmallest(MAX_COMPARED, before, key=lambda number: self._runs[number].tick)):
                self._courses.add(number, self._runs[number].tick, partial(self._course, self._runs[number]))
            self._known = len(self._runs)
            course = self._course(run)
            players = [run.player for run in self._runs]
            near = _near_to_another(run.player, course, self._courses, players, self._earlier)
            whose = self._runs[near[0]].player if near else ""
            said = f"{near[1]} the run by {whose} in {self._runs[near[0]].file}" if near else ""
            earlier, sure = bool(near and near[0] < self._earlier), bool(near and near[2])
            self._memo.note(key, noted := [said, whose, earlier, sure])
        return noted[0], noted[1], noted[2], noted[3]

    def _course(self, run: Run) -> Course:
        if self._last is None or self._last[0] != run.key:
            inputs = run.inputs
            self._last = run.key, course_of(inputs, run_level(run.entry.named.level, inputs))
        return self._last[1]


def _near_to_another(
    player: str, course: Course, earlier: Courses, players: Sequence[str], until_moment: int
) -> tuple[int, str, bool] | None:
    """The nearest run by another player, what it shares, and whether that is the inputs.

    Only runs before the player's own first near one count. ``players``: of the earlier runs; the first ``until_moment``
    of these, of earlier moments, are preferred.
    """
    numbers = earlier.numbers
    own = np.array([players[number] == player for number in numbers.tolist()], bool)
    near, until = earlier.near(course), len(players)
    for _ in range(2):  # inputs are aligned only where nothing else is near
        until = min(near(own & (numbers < until))[0], default=until)
    for last in sorted({min(until, until_moment), until}):
        others, said, sure = near(~own & (numbers < last))
        if others:
            return others[0], said, sure
    return None
