"""Where a run's ninja is after each tick, and how: what is left to look at when the run is changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.memory.interface import TRACED_PLACES

FIGURE = (*TRACED_PLACES, "state", "in_air")
"""The fields of the ninja on which its figure depends."""


@dataclass(frozen=True, eq=False)
class Course:
    """``columns``: the fields FIGURE after each tick, of one length."""

    columns: Mapping[str, NDArray[Any]]

    def __len__(self) -> int:
        return len(self.columns["x"])

    @property
    def positions(self) -> NDArray[np.float64]:
        """The ninja after each tick: float64 (ticks, 2), px."""
        return np.column_stack([self.columns["x"], self.columns["y"]])

    def at(self, tick: int) -> dict[str, Any]:
        """The fields after a tick; behind the last one those of the last. Raises IndexError for a course without."""
        return {name: column[min(tick, len(column) - 1)].item() for name, column in self.columns.items()}


NOWHERE = Course({name: np.zeros(0) for name in FIGURE})
"""The course of a run without ticks."""
