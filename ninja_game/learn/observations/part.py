"""What every part of an observation is: a name, a space, and a kernel that writes one world's values into a row.

``PartContext`` is what a part reads when it makes its tables: the worlds and their levels. Where there are more levels
than worlds can hold, a level is put in the place of another, and the tables are rewritten for it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from ninja_game.backend.plain import PlainWorlds, load_plain
from ninja_game.backend.worlds import Worlds
from ninja_game.batch.batch import Indices
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import Level
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.schema import World

Array = NDArray[Any]


@dataclass(frozen=True)
class PartContext:
    """The worlds and levels for which a part makes its tables.

    ``worlds``: they themselves, not loaded yet; ``fresh``: each level as it begins.
    ``changed`` (worlds): whether gold, mines or exits may be others than last observed. ``time_limit``: ticks
    of an episode. ``compiled``: whether kernels run compiled. ``goal``: their ``GoalDistance``, if a part asks for one.
    ``max_objects``: of how many objects another level may be that is put in the place of one; 0: none ever is.
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
        """The objects of a level of these kinds, in the order of their slots."""
        return [o for o in self.fresh[number].objects[1:] if o.kind in kinds]

    def table(self, values: Any, dtype: Any) -> Any:
        """A table for kernels: an array, or for the plain memory, which reads those slowly, a list."""
        array = np.array(values, dtype)
        return array if self.compiled else array.tolist()

    def values(self, make: Callable[[int], Any], dtype: Any) -> Any:
        """A table of what ``make`` gives for each level, as many numbers for each."""
        every = np.array([make(number) for number in range(len(self.fresh))]).reshape(len(self.fresh), -1)
        size, table = every.shape[1], self.table(every.ravel(), dtype)

        def write(number: int) -> None:
            table[number * size : (number + 1) * size] = self.table(np.ravel(make(number)), dtype)

        self.writers.append(write)
        return table

    def rows(self, make: Callable[[int], Sequence[tuple[float, ...]]], width: int) -> list[Any]:
        """Tables of what ``make`` gives for each level, some rows of ``width`` numbers.

        First the bounds: level i has the rows from 2 i to 2 i + 1 of these; then a float64 column for each number.
        """
        sizes = [self.max_objects or len(make(number)) for number in range(len(self.fresh))]
        starts = np.cumsum([0, *sizes])
        bounds = self.table(np.repeat(starts[:-1], 2), np.int64)
        columns = [self.table(np.zeros(starts[-1]), np.float64) for _ in range(width)]

        def write(number: int) -> None:
            rows, start = make(number), bounds[2 * number]
            bounds[2 * number + 1] = end = start + len(rows)
            for column, numbers in zip(columns, zip(*rows, strict=True), strict=False):
                column[start:end] = numbers

        for number in range(len(sizes)):
            write(number)
        self.writers.append(write)
        return [bounds, *columns]

    def rewrite(self, number: int) -> None:
        """Rewrite the tables for the level with this number, which has been replaced."""
        for write in self.writers:
            write(number)


@dataclass(frozen=True)
class Part(ABC):
    """A part of an observation.

    ``normalised``: numbers of about -1 to 1 (flags 0 or 1); else px, px/tick, ticks. Either way they lie in ``box``:
    what is outside counts as its rim, NaN as 0.
    """

    name: ClassVar[str]
    """Its key in a Dict of several parts."""

    needs_goal: ClassVar[bool] = False
    """Whether it reads ``PartContext.goal``."""

    normalised: bool = field(default=True, kw_only=True)

    @property
    @abstractmethod
    def box(self) -> Box:
        """Shape, dtype and range of its values."""

    @abstractmethod
    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """The kernel that writes it, then the last of its arguments: what never changes during an episode.

        ``kernel(maps, level_of, worlds, indices, first, last, out, offset, *tables)`` writes the values of the worlds
        ``indices[first:last]`` into their rows of ``out``, from column ``offset`` on. Arrays and numbers, no named
        tuples: each call would spend 3 µs on them, half a step of one world.
        """

    @property
    def length(self) -> int:
        return int(np.prod(self.box.shape))


@fast
def clamp(value: float, low: float, high: float) -> float:
    """The value, or the end of the range that it lies beyond; 0 for NaN."""
    if value < low:
        return low
    if value > high:
        return high
    if value != value:
        return 0.0
    return value


@fast
def copy_values(target: Any, source: Any, count: int) -> None:
    """Copy so many values; compiled, from row to row, this is a copy of memory."""
    for k in range(count):
        target[k] = source[k]


class InitialObject(NamedTuple):
    """An object of a new world; ``partner``: of an exit the slot of its switch."""

    slot: int
    kind: int
    x: float
    y: float
    partner: int


class InitialLevel(NamedTuple):
    """A level as it begins: its grid of tiles; its objects by slot, of which 0 is nobody; where the ninja is, px."""

    tiles: Sequence[int]
    objects: Sequence[InitialObject]
    start: tuple[float, float]


def initial_levels(worlds: Worlds, places: Iterable[int]) -> list[InitialLevel]:
    """Levels of worlds by their numbers."""
    if isinstance(worlds, PlainWorlds):
        return [_initial_level(worlds.maps[place].tiles, worlds.fresh[place]) for place in places]
    fresh = worlds.fresh
    every = [fresh["objects"][name] for name in ("kind", "x", "y", "partner")]
    tiles, used, ninja = worlds.maps["tiles"], fresh["slots_used"], fresh["ninja"]
    levels = []
    for place in places:
        columns = [column[place, : used[place]].tolist() for column in every]
        objects = list(map(InitialObject, range(len(columns[0])), *columns))
        start = float(ninja["x"][place]), float(ninja["y"][place])
        levels.append(InitialLevel(tiles[place].tolist(), objects, start))
    return levels


def _initial_level(tiles: Sequence[int], w: World) -> InitialLevel:
    slots = enumerate(w.objects[: w.slots_used])
    objects = [InitialObject(k, o.kind, o.x, o.y, o.partner if o.kind == EXIT else 0) for k, o in slots]
    return InitialLevel(tiles, objects, (w.ninja.x, w.ninja.y))


def put_levels(worlds: Worlds, places: Indices, levels: Sequence[Level]) -> None:
    """Put levels in the places of these numbers, and start the worlds of the same numbers in them.

    A level must not have more objects than the levels that the worlds were opened with.
    """
    if isinstance(worlds, PlainWorlds):
        for place, level in zip(places.tolist(), levels, strict=True):
            worlds.maps[place], worlds.fresh[place] = load_plain(level, worlds.box)
            worlds.worlds[place] = load_plain(level, worlds.box)[1]
        return
    from ninja_game.backend.compiled import load_worlds
    from ninja_game.backend.layout import bytes_of

    worlds.maps[places], fresh = load_worlds(worlds.kernel, levels, box=worlds.box)
    states, every = bytes_of(fresh), bytes_of(worlds.worlds)
    for rows in (places, worlds.count + places):  # behind the worlds lies a new one in each level
        every[rows] = 0
        every[rows, : states.shape[1]] = states
    worlds.records["event_count"][places] = 0
