"""The parts of an observation. A part has a name, a space, and a kernel that writes one world's values into a row.

A part reads the worlds and levels from ``PartContext`` to make its tables. If there are more levels than worlds can
hold, one level replaces another, and its tables are rewritten.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, get_type_hints

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from ninja_game.backend.worlds import InitialLevel, InitialObject, Worlds
from ninja_game.sim.schema.declare import fast

Array = NDArray[Any]
Lookup = Array | list[Any]
"""What kernels read: an array, of records where values belong together, or a list for the plain memory."""


@dataclass(frozen=True)
class PartContext:
    """The worlds and levels for which a part makes its tables.

    ``worlds``: the worlds, not loaded yet; ``fresh``: the first state of each level. ``changed`` (worlds): gold, mines
    or exits may have changed since the last observation. ``time_limit``: ticks of an episode. ``compiled``: kernels run
    compiled. ``goal``: their ``GoalDistance``, if a part needs it. ``max_objects``: most objects of a level that may
    replace another; 0: levels are never replaced. ``writers``: rewrite the tables of a level that was replaced.
    """

    worlds: Worlds
    fresh: list[InitialLevel]
    changed: NDArray[np.bool_]
    time_limit: int
    compiled: bool
    goal: Any = None
    max_objects: int = 0
    writers: list[Callable[[int], None]] = field(default_factory=list, repr=False)

    @property
    def count(self) -> int:
        return len(self.changed)

    def objects(self, number: int, *kinds: int) -> list[InitialObject]:
        """The objects of these kinds in a level, in the order of their slots."""
        return [o for o in self.fresh[number].objects[1:] if o.kind in kinds]

    def table(self, values: Any, dtype: Any) -> Any:
        """A table for kernels: an array, or a list for the plain memory, which reads arrays slowly."""
        array = np.array(values, dtype)
        return array if self.compiled else array.tolist()

    def values(self, make: Callable[[int], Any], dtype: Any) -> Any:
        """A table with the values of ``make`` for each level; every level has the same number of values."""
        every = np.array([make(number) for number in range(len(self.fresh))]).reshape(len(self.fresh), -1)
        size, table = every.shape[1], self.table(every.ravel(), dtype)

        def write(number: int) -> None:
            table[number * size : (number + 1) * size] = self.table(np.ravel(make(number)), dtype)

        self.writers.append(write)
        return table

    def records(self, rows: Iterable[Any], row: type) -> Any:
        """A table for kernels, which read the fields of its rows by name. ``row``: as in ``rows``."""
        return np.array(list(rows), _dtype(row)) if self.compiled else list(rows)

    def ranges(self, lowest: Array, highest: Array, divisors: Array) -> Any:
        """The records of ``Range`` for ``put_value``; the limits are those of the divided values."""
        limits = zip(1.0 / divisors, lowest, highest, strict=True)
        return self.records([Range(*map(float, numbers)) for numbers in limits], Range)

    def rows(self, make: Callable[[int], Sequence[Any]], row: type) -> tuple[Any, Any]:
        """The rows of ``make`` for each level, any number of them: a table of their bounds, and one of the rows.

        Level i has the rows from number 2 i to 2 i + 1 of the bounds. ``row``: int, or a NamedTuple of ints and floats.
        """
        sizes = [self.max_objects or len(make(number)) for number in range(len(self.fresh))]
        starts = np.cumsum([0, *sizes])
        bounds = self.table(np.repeat(starts[:-1], 2), np.int64)
        table: Any = np.zeros(starts[-1], _dtype(row)) if self.compiled else [None] * int(starts[-1])

        def write(number: int) -> None:
            rows, start = self.records(make(number), row), bounds[2 * number]
            bounds[2 * number + 1] = end = start + len(rows)
            table[start:end] = rows

        for number in range(len(sizes)):
            write(number)
        self.writers.append(write)
        return bounds, table


def _dtype(row: type) -> np.dtype[Any]:
    codes = {int: "i8", float: "f8"}
    return np.dtype([(name, codes[kind]) for name, kind in get_type_hints(row).items()] or codes[row])


@dataclass(frozen=True)
class Part(ABC):
    """A part of an observation.

    ``normalised``: numbers of about -1 to 1 (flags 0 or 1); else px, px/tick, ticks. Both lie in ``box``: values beyond
    are clamped, and NaN is 0.
    """

    name: ClassVar[str]  #: its key in a Dict of several parts
    needs_goal: ClassVar[bool] = False  #: whether it reads ``PartContext.goal``
    normalised: bool = field(default=True, kw_only=True)

    @property
    @abstractmethod
    def box(self) -> Box:
        """Shape, dtype and range of its values."""

    @abstractmethod
    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """The kernel of the part, then its last arguments, which never change during an episode.

        ``kernel(maps, level_of, worlds, indices, first, last, out, offset, *tables)`` writes the values of the worlds
        ``indices[first:last]`` into their rows of ``out``, from column ``offset`` on. Use numbers and arrays (also of
        records), no named tuples: passing these takes 3 µs per call, half a step of one world.
        """

    @property
    def length(self) -> int:
        return int(np.prod(self.box.shape))


@fast
def clamp(value: float, low: float, high: float) -> float:
    """Limit a value to a range; 0 for NaN."""
    if value < low:
        return low
    if value > high:
        return high
    if value != value:
        return 0.0
    return value


class Range(NamedTuple):
    """The scaling of a value: it is multiplied by a factor, then clamped."""

    factor: float
    lowest: float
    highest: float


@fast
def put_value(out: Any, index: int, offset: int, j: int, ranges: Any, value: float) -> None:
    """Write value j, multiplied by its factor and limited to its range."""
    out[index, offset + j] = clamp(value * ranges[j].factor, ranges[j].lowest, ranges[j].highest)


@fast
def copy_values(target: Any, source: Any, count: int) -> None:
    """Copy ``count`` values; for whole rows, the compiler makes this a copy of memory."""
    for k in range(count):
        target[k] = source[k]
