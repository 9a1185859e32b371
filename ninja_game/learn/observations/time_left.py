"""How much of the episode is left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.learn.observations.part import Part, Setting, clamp
from ninja_game.sim.memory.declare import entry_point

LONGEST = 1_000_000.0
"""Ticks."""


@dataclass(frozen=True)
class TimeLeft(Part):
    """Ticks until the episode is truncated, float32 (1,); normalised: as a share of the time limit."""

    name: ClassVar[str] = "time"

    @property
    def box(self) -> Box:
        """Float32 (1,)."""
        return Box(0.0, 1.0 if self.normalised else LONGEST, (1,), np.float32)

    @property
    def kernel(self) -> Callable[..., None]:
        """``observe_time``."""
        return observe_time

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """The time limit, the factor, the highest value."""
        return setting.time_limit, 1.0 / setting.time_limit if self.normalised else 1.0, float(self.box.high[0])


@entry_point
def observe_time(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    time_limit: int, factor: float, highest: float,
) -> None:  # fmt: skip
    """Write the time left of some worlds."""
    for k in range(first, last):
        index = which[k]
        out[index, offset] = clamp((time_limit - worlds[index].tick) * factor, 0.0, highest)
