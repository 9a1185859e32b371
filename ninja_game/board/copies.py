"""Copies: runs that repeat an earlier one of the level, exactly or with some keys changed."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from hashlib import sha256
from heapq import heappop, heappush, nlargest, nsmallest
from itertools import groupby, pairwise
from typing import NamedTuple, get_type_hints

import numpy as np
from numpy.typing import NDArray

from ninja_game.board.memo import Memo, program, values_digest
from ninja_game.board.players import folded
from ninja_game.board.runs import OWN, RejectedRun, Run, RunKey, RunRows
from ninja_game.runs.run import RunResult, run_level
from ninja_game.sim.inputs import KEYS_DOWN

MAX_COMPARED = 1000  # earlier runs of a level to compare a new one with: the fastest, the likeliest to be copied

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
    """The features of a run by which it is compared with other runs of its level."""

    keys: bytes  #: the keys that are down in each tick
    strokes: frozenset[int]  #: spans of the same keys: number among equal spans + 2^20 times keys + 2^24 times ticks
    presses: frozenset[int]  #: presses and releases of keys: one of eight numbers + 8 times the tick
    places: frozenset[float]  #: the ninja's places in whole pixels: x + 10^6 y

    def inputs_shared(self, other: Course) -> int:
        """The number of ticks with the other's inputs; 0 if too many differ."""
        changed = edit_distance(self.keys, other.keys)
        alike = changed <= CHANGED * max(len(self.strokes), len(other.strokes))
        return max(0, len(self.keys) - changed) if alike else 0


def course_of(inputs: bytes, run: RunResult) -> Course:
    keys = bytes(pressed & KEYS_DOWN for pressed in inputs)
    equal: Counter[int] = Counter()
    strokes = []
    for down, ticks in groupby(keys):
        stroke = (down + 16 * len(list(ticks))) << 20
        equal[stroke] += 1
        strokes.append(stroke + equal[stroke])
    changes = [down & ~before | (before & ~down) << 4 for before, down in pairwise(keys)]
    presses = frozenset(8 * tick + bit for tick, bits in enumerate(changes) for bit in range(8) if bits >> bit & 1)
    x, y = run.positions.round().T
    return Course(keys, frozenset(strokes), presses, frozenset((x + 1e6 * y).tolist()))


class Near(NamedTuple):
    """The runs nearest to a course."""

    numbers: list[int]  #: their numbers, the nearest first
    shared: str  #: the features shared with the nearest run, as the beginning of a sentence; "" for none
    by_inputs: bool  #: whether inputs are shared: on a short level with one obvious route people share only the path


class Likeness(NamedTuple):
    """The likeness of a run to the nearest run by another player."""

    text: str  #: a sentence; "" if they share nothing
    player: str  #: the other run's player
    earlier: bool  #: whether the other run is of an earlier moment
    by_inputs: bool  #: as ``Near.by_inputs``
    file: str = ""  #: the other run's file
    record: int = 0


_LIKENESS_TYPES = get_type_hints(Likeness)


class Common:
    """A table of bits: a row for each feature, such as a place; a column for each course, 1 if it has the feature."""

    def __init__(self) -> None:
        self._rows: dict[float, int] = {}
        self._bits = np.zeros((64, 1), np.uint8)

    def mark(self, features: Iterable[float], column: int, *, has: bool) -> None:
        """Add these features to the course in a column, or remove them."""
        rows = [self._rows.setdefault(feature, len(self._rows)) for feature in features]
        height, width = self._bits.shape
        if len(self._rows) > height or column // 8 >= width:
            more = max(0, 2 * len(self._rows) - height), max(0, column // 8 + column // 16 + 1 - width)
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
    """The courses of the ``most`` fastest earlier runs of a level, with which a new run is compared.

    ``numbers``: for each column of the tables (``Common``) the number of its run.
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
        self._courses[column] = new = course()
        self._mark(new, column, has=True)
        if column == len(self.numbers):
            self.numbers, self._press_counts = np.append(self.numbers, 0), np.append(self._press_counts, 0)
        self.numbers[column], self._press_counts[column] = number, len(new.presses)
        heappush(self._slowest, (-tick, -number, column))

    def _mark(self, course: Course, column: int, *, has: bool) -> None:
        for common, features in ((self._strokes, course.strokes), (self._presses, course.presses)):
            common.mark(features, column, has=has)
        self._places.mark(course.places, column, has=has)

    def near(self, course: Course) -> Callable[[NDArray[np.bool_]], Near]:
        """A function that gives the runs near to ``course`` among some columns, which truth values choose."""
        columns = len(self.numbers)
        places = self._places.counts(course.places, columns)
        presses = np.zeros(columns, np.int64)
        for shift in range(-SHIFTED, SHIFTED + 1):
            moved = (press + 8 * shift for press in course.presses)
            presses = np.maximum(presses, self._presses.counts(moved, columns))
        on_path = (places >= ON_PATH * len(course.places)) & (len(course.strokes) >= MIN_STROKES)
        pressed = (presses >= SAME_PRESSES * self._press_counts) & (presses >= MIN_PRESSES)
        path_share = places / max(1, len(course.places)) * on_path
        press_share = presses / np.maximum(1, self._press_counts) * pressed
        share = np.maximum(path_share, press_share)

        def nearest(chosen: NDArray[np.bool_]) -> Near:
            near = np.flatnonzero(chosen & (on_path | pressed))
            near = near[np.lexsort((self.numbers[near], -share[near], ~pressed[near]))]
            numbers, text = self.numbers[near].tolist(), ""
            if numbers:
                first = near[0]
                text = f"{places[first]} of the {len(course.places)} places on its way, and {presses[first]} of "
                text += f"{self._press_counts[first]} presses and releases, are those of"
                if pressed[first]:
                    return Near(numbers, text, by_inputs=True)
            # Aligning is slow: only where the other tests do not decide.
            strokes = self._strokes.counts(course.strokes, columns)
            ticks = len(course.keys)
            most = nlargest(ALIGNED, np.flatnonzero(chosen).tolist(), key=strokes.__getitem__)
            shared = [(-course.inputs_shared(self._courses[column]), int(self.numbers[column])) for column in most]
            aligned = sorted(pair for pair in shared if pair[0])
            if aligned:
                numbers = [*(number for _, number in aligned), *numbers]
                text = f"{-aligned[0][0]} of its {ticks} ticks have the inputs of"
            return Near(numbers, text, bool(aligned))

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
    ticks_with: dict[int, int] = defaultdict(int)
    for tick, keys in enumerate(ours):
        ticks_with[keys] |= 1 << tick
    more, less = every, 0
    distance = len(ours)
    for keys in theirs:
        same = ticks_with[keys]
        diagonal = (((same & more) + more) ^ more) | same | less
        right, left = (less | ~(diagonal | more)) & every, more & diagonal
        distance += bool(right & last) - bool(left & last)
        right = right << 1 | 1
        more, less = (left << 1 | ~(diagonal | right)) & every, right & diagonal & every
    return distance


def without_copies(runs: list[Run], memo: Memo, owners: RunRows) -> tuple[list[Run], list[RejectedRun]]:
    """The runs that are no copies, with near copies marked, and the copies.

    If several players sent the same run at one moment, all stay, with a remark. ``owners``: as ``Ledger.owners``.
    """
    on_level: dict[str, list[Run]] = defaultdict(list)
    copies: list[RejectedRun] = []
    ways: dict[tuple[str, str], list[Run]] = defaultdict(list)
    for run in runs:
        way = run.level, run.way
        owner = owners.get(way)
        if owner and way not in ways and owner["added"] < run.added:
            why = f"a copy of an earlier run by {owner['player']}, which was withdrawn or does not count any more"
            copies.append(run.rejected("copy", why))
            continue
        same = ways[way]
        if not same or (run.added == same[0].added != "" and run.player not in (copy.player for copy in same)):
            on_level[run.level].append(run)
            same.append(run)
        else:
            first = next((copy for copy in same if copy.player == run.player), same[0])
            stolen = first.player != run.player and first.added < run.added
            what = f"a copy of the run by {first.player} in" if stolen else "the same run as"
            why = f"{what} {first.file}"
            kind = OWN if run.episode and first.player == run.player else "copy"
            copies.append(run.rejected(kind, why, first.key))
    together: dict[RunKey, str] = {}
    for same in ways.values():
        for run in same if len(same) > 1 else ():
            others = " and ".join(f"{copy.player} in {copy.file}" for copy in same if copy is not run)
            together[run.key] = f"the same run as that by {others}, which came in together with it: whose is not known"
    unique = [run for level in on_level.values() for run in _marked(level, memo, together)]
    return sorted(unique, key=lambda run: run.order), copies


def _marked(runs: list[Run], memo: Memo, together: Mapping[RunKey, str]) -> Iterator[Run]:
    """The runs of a level, in order; a run that is near to earlier runs by other players alone gets a mark.

    A near copy is later than its origin by the moments at which this board took them in; dates of an older board do not
    count. Of two runs of one moment the second only gets a mark. An assisted run that names its origin is no near copy.
    ``together``: other marks, for runs that are equal to others of their moment.
    """
    if len({run.player for run in runs}) == 1:
        yield from runs
        return
    compared = _Compared(runs[0].level, memo)
    runs = sorted(runs, key=lambda run: run.moved_in)
    for _, moment in groupby(runs, key=lambda run: run.moved_in):
        compared.begin_moment()
        for run in moment:
            like = compared.likeness(run)
            compared.add(run)
            named = like.earlier and folded(like.player) in run.origins
            near = like.text if like.earlier and like.by_inputs and not named else ""
            if like.earlier:
                mark = like.text + (NAMED if named else "" if like.by_inputs else DOUBTFUL)
            else:
                mark = together.get(
                    run.key, f"{like.text}, of the same moment" if like.text and run.added else like.text
                )
            other = (like.file, like.record) if near else None
            yield replace(run.marked(mark), near=near, near_to=other, derived=named) if mark else run


class _Compared:
    """The runs of a level that were compared so far, with cached results."""

    def __init__(self, level: str, memo: Memo) -> None:
        self._memo = memo
        self._key = values_digest([program(), level])
        self._runs: list[Run] = []
        self._courses = Courses(MAX_COMPARED)
        self._known = self._earlier = 0
        self._last: tuple[RunKey, Course] | None = None

    def _key_of(self, run: Run) -> str:
        """The key of a run's likeness, which depends only on it, the level's earlier runs and their moments."""
        return sha256(f"{self._key} {run.digest} {run.record} {run.player}".encode("utf-8", "replace")).hexdigest()

    def begin_moment(self) -> None:
        """All runs added so far are of earlier moments."""
        self._key = values_digest([self._key])
        self._earlier = len(self._runs)

    def add(self, run: Run) -> None:
        self._key = self._key_of(run)
        self._runs.append(run)

    def likeness(self, run: Run) -> Likeness:
        """The likeness of a run to another player's that it nearly copies; its text is empty if there is none."""
        fields = self._memo.recall(key := self._key_of(run))
        if isinstance(fields, dict) and {name: type(value) for name, value in fields.items()} == _LIKENESS_TYPES:
            return Likeness(**fields)
        before = range(self._known, len(self._runs))
        for number in sorted(nsmallest(MAX_COMPARED, before, key=lambda number: self._runs[number].tick)):
            self._courses.add(number, self._runs[number].tick, partial(self._course, self._runs[number]))
        self._known = len(self._runs)
        course = self._course(run)
        near = near_to_another(run.player, course, self._courses, [run.player for run in self._runs], self._earlier)
        like = Likeness("", "", earlier=False, by_inputs=False)
        if near:
            number, other = near.numbers[0], self._runs[near.numbers[0]]
            text = f"{near.shared} the run by {other.player} in {other.file}"
            like = Likeness(text, other.player, number < self._earlier, near.by_inputs, *other.key)
        self._memo.note(key, like._asdict())
        return like

    def _course(self, run: Run) -> Course:
        if self._last is None or self._last[0] != run.key:
            inputs = run.inputs
            self._last = run.key, course_of(inputs, run_level(run.entry.named.level, inputs))
        return self._last[1]


def near_to_another(
    player: str, course: Course, earlier: Courses, players: Sequence[str], until_moment: int
) -> Near | None:
    """The nearest runs by other players, if there are some.

    Only runs before the player's own first near run count. ``players``: the players of the earlier runs, in order; the
    first ``until_moment`` of these runs, which are of earlier moments, are preferred.
    """
    numbers = earlier.numbers
    own = np.array([players[number] == player for number in numbers.tolist()], bool)
    nearest, until = earlier.near(course), len(players)
    for _ in range(2):  # inputs are aligned only where nothing else is near
        until = min(nearest(own & (numbers < until)).numbers, default=until)
    for last in sorted({min(until, until_moment), until}):
        others = nearest(~own & (numbers < last))
        if others.numbers:
            return others
    return None
