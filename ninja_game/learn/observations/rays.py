"""Rays from the ninja: how far it is to a wall or a closed door."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.part import Part, Setting, clamp
from ninja_game.sim.collision.rays import cast
from ninja_game.sim.kinds import DOOR
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.rules import WORLD_WIDTH

MOST = 360


@dataclass(frozen=True)
class Rays(Part):
    """``count`` rays, evenly round from the right by way of down: the distance to what stops each, px.

    They are the world's own rays: tiles and solid edges, such as closed doors, stop them, objects do not. ``reach``:
    px, the farthest that is seen.
    """

    name: ClassVar[str] = "rays"

    count: int = 16
    reach: float = WORLD_WIDTH / 2

    def __post_init__(self) -> None:
        if self.count not in range(1, MOST + 1) or not self.reach > 0.0:
            found = f"{self.count!r} rays of {self.reach!r} px"
            raise ArgumentError(f"found {found}; expected 1 to {MOST} rays of more than 0 px")

    @property
    def box(self) -> Box:
        """Float32 (count,)."""
        return Box(0.0, 1.0 if self.normalised else self.reach, (self.count,), np.float32)

    @property
    def kernel(self) -> Callable[..., None]:
        """``observe_rays``."""
        return observe_rays

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """The directions, to 12 digits, so that every machine has the same; the reach; the factor; where edges change.

        In a level without doors the edges never change: those of a new world lie nearer than those of each world.
        """
        angles = [2.0 * pi * k / self.count for k in range(self.count)]
        directions = [setting.table([round(f(angle), 12) for angle in angles], np.float64) for f in (cos, sin)]
        doors = [int(bool(found)) for found in setting.objects(DOOR)]
        factor = 1.0 / self.reach if self.normalised else 1.0
        return *directions, float(self.reach), factor, setting.worlds.fresh, setting.table(doors, np.int64)


@entry_point
def observe_rays(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    dx: Any, dy: Any, reach: float, factor: float, fresh: Any, doors: Any,
) -> None:  # fmt: skip
    """Follow the rays of some worlds."""
    for k in range(first, last):
        index = which[k]
        number = level_of[index]
        level = maps[number]
        w = worlds[index] if doors[number] else fresh[number]
        x = worlds[index].ninja.x
        y = worlds[index].ninja.y
        for j in range(len(dx)):
            stopped, hit_x, hit_y = cast(level, w, x, y, dx[j], dy[j])
            # A hit may lie behind the start, within a tile: that is no way at all.
            length = (hit_x - x) * dx[j] + (hit_y - y) * dy[j] if stopped else reach
            out[index, offset + j] = clamp(length, 0.0, reach) * factor
