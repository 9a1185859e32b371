"""Which way the solver's distance field goes down: privileged knowledge of the level, as a compass."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.learn.goal_distance import FARTHEST, point_within
from ninja_game.learn.observations.part import Part, Setting, clamp
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.rules import ROOT2

RADII = (24.0, 60.0)
"""px."""
_SIDES = ((1.0, 0.0), (1.0 / ROOT2, 1.0 / ROOT2), (0.0, 1.0), (-1.0 / ROOT2, 1.0 / ROOT2))
DIRECTIONS = [*_SIDES, *((-x, -y) for x, y in _SIDES)]
"""From the right by way of down."""
FAR_TICKS = 1000.0
"""Ticks to the exit that count as 1."""


@dataclass(frozen=True)
class Guide(Part):
    """The way by the solver's distance field of the present switch state, float32 (17,).

    For each of eight directions (from the right by way of down), 24 px off and then 60 px off: by how many ticks one is
    nearer to the exit there, a px of the way, -1 to 1. Last: ticks to the exit; normalised: in 1000 ticks, at most 1.
    """

    name: ClassVar[str] = "guide"
    needs_goal: ClassVar[bool] = True

    @property
    def box(self) -> Box:
        """Float32 (17,)."""
        slopes = len(RADII) * len(DIRECTIONS)
        low = np.array([-1.0] * slopes + [0.0], np.float32)
        return Box(low, np.array([1.0] * slopes + [1.0 if self.normalised else FARTHEST], np.float32), dtype=np.float32)

    @property
    def kernel(self) -> Callable[..., None]:
        """``observe_guide``."""
        return observe_guide

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """The ways to the points, px; the fields and each world's; the last value's factor and highest."""
        ways = [(radius * x, radius * y, 1.0 / radius) for radius in RADII for x, y in DIRECTIONS]
        columns = [setting.table(column, np.float64) for column in zip(*ways, strict=True)]
        highest = float(self.box.high[-1])
        return *columns, setting.goal.fields, setting.goal.rows, 1.0 / FAR_TICKS if self.normalised else 1.0, highest


@entry_point
def observe_guide(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    dx: Any, dy: Any, share: Any, fields: Any, rows: Any, factor: float, highest: float,
) -> None:  # fmt: skip
    """Look round in the fields of some worlds; those whose field is not known yet are looked at again."""
    for k in range(first, last):
        index = which[k]
        row = rows[index]
        x = worlds[index].ninja.x
        y = worlds[index].ninja.y
        # Compiled, `float` of a float32 stays one, and the difference below would be rounded to that.
        here = np.float64(fields[row, point_within(x, y)])
        for j in range(len(dx)):
            there = np.float64(fields[row, point_within(x + dx[j], y + dy[j])])
            out[index, offset + j] = clamp((here - there) * share[j], -1.0, 1.0)
        out[index, offset + len(dx)] = clamp(here * factor, 0.0, highest)
