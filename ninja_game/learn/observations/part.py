"""What every part of an observation is: a name, a space, and a kernel that writes one world's values into a row."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.interface import Kernel, R, Worlds
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import TileMap, World

Array = NDArray[Any]


@dataclass(frozen=True)
class Setting:
    """What a part may know of the worlds when it makes its tables.

    ``worlds``: they themselves, not loaded yet; ``fresh``: of each level its map and a new world, as plain objects.
    ``changed`` (worlds): whether gold or exits may be others than at the last observation. ``time_limit``: ticks of an
    episode. ``compiled``: whether kernels run compiled. ``goal``: their ``GoalDistance``, for parts that ask for one.
    """

    worlds: Worlds
    fresh: Sequence[tuple[TileMap, World]]
    changed: NDArray[np.bool_]
    time_limit: int
    compiled: bool
    goal: Any = None

    @property
    def maps(self) -> Any:
        """The levels as kernels take them."""
        return self.worlds.maps

    def kernel(self, entry: Kernel[R]) -> Kernel[R]:
        """An entry point as these worlds run it."""
        return self.worlds.kernel(entry)

    @property
    def count(self) -> int:
        return len(self.changed)

    def objects(self, *kinds: int) -> list[list[tuple[World, Object]]]:
        """Of each level its new world with each of the objects of these kinds, in the order of their slots."""
        return [[(w, o) for o in w.objects[1:] if o.kind in kinds] for _, w in self.fresh]

    def table(self, values: Any, dtype: Any) -> Any:
        """A table for kernels: an array, or for the plain memory, which reads those slowly, a list."""
        array = np.array(values, dtype)
        return array if self.compiled else array.tolist()


class Ragged:
    """Tuples of numbers, several for each level, in one table: level i has ``starts[i]`` to ``starts[i + 1]``."""

    def __init__(self, levels: Sequence[Sequence[tuple[float, ...]]]) -> None:
        self.starts = np.cumsum([0, *(len(rows) for rows in levels)])
        self.rows = [row for rows in levels for row in rows]

    def columns(self, setting: Setting, width: int) -> list[Any]:
        """The starts, and ``width`` columns of float64, as tables for kernels."""
        columns = np.array(self.rows, np.float64).reshape(-1, width).T
        return [setting.table(self.starts, np.int64), *(setting.table(column, np.float64) for column in columns)]


@dataclass(frozen=True)
class Part(ABC):
    """A part of an observation.

    ``normalised``: numbers of about -1 to 1 (flags 0 or 1); else px, px/tick, ticks. Either way they lie in ``box``:
    what is outside counts as its rim, NaN as 0.
    """

    name: ClassVar[str]
    """Its key in a Dict of several parts."""

    needs_goal: ClassVar[bool] = False
    """Whether it reads ``Setting.goal``."""

    normalised: bool = field(default=True, kw_only=True)

    @property
    @abstractmethod
    def box(self) -> Box:
        """Shape, dtype and range of its values."""

    @property
    @abstractmethod
    def kernel(self) -> Callable[..., None]:
        """The entry point that writes it: ``kernel(maps, level_of, worlds, which, first, last, out, offset, *tables)``.

        It writes the values of the worlds ``which[first:last]`` into their rows of ``out``, from column ``offset`` on.
        """

    @abstractmethod
    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """The rest of the kernel's arguments: what never changes during an episode."""

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
