"""The objects nearest to the ninja."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box

from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.object_facts import face_of, is_there, moment_of, place_of, velocity_of
from ninja_game.learn.observations.part import Part, Ragged, Setting, clamp
from ninja_game.learn.observations.state_vector import MAX_SPEED
from ninja_game.sim.kinds import INERT, KINDS, NINJA
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.rules import WORLD_HEIGHT, WORLD_WIDTH

OBSERVED = tuple(kind for kind in KINDS if kind.number not in {NINJA, INERT})
KIND_NAMES = tuple(kind.name for kind in OBSERVED)
COLUMNS = (*KIND_NAMES, "dx", "dy", "vx", "vy", "face_x", "face_y", "moment")
"""Of each object: its kind, a flag each; the way from the ninja, px; its velocity, px/tick; see `object_facts.py`."""
DX = len(KIND_NAMES)
MOST = 64


@dataclass(frozen=True)
class NearObjects(Part):
    """The ``count`` objects nearest to the ninja, nearest first, float32 (count, 20): ``COLUMNS``, 0 where are less.

    What is gone is not seen: gold taken, mines exploded, the switch of an open exit. ``kinds``: which kinds are looked
    at, by name (of ``KIND_NAMES``); all of them without.
    """

    name: ClassVar[str] = "objects"

    count: int = 8
    kinds: tuple[str, ...] = KIND_NAMES

    def __post_init__(self) -> None:
        if self.count not in range(1, MOST + 1):
            raise ArgumentError(f"the count of near objects is {self.count!r}; expected 1 to {MOST}")
        if not self.kinds or not set(self.kinds) <= set(KIND_NAMES):
            raise ArgumentError(f"the kinds of near objects are {self.kinds!r:.60}; expected some of {KIND_NAMES}")

    @property
    def box(self) -> Box:
        """Float32 (count, 20)."""
        low, high, _ = self._range()
        return Box(np.tile(low, (self.count, 1)), np.tile(high, (self.count, 1)), dtype=np.float32)

    def _range(self) -> Any:
        """Lowest and highest value and divisor of each column."""
        ways, speeds = [WORLD_WIDTH, WORLD_HEIGHT], [MAX_SPEED] * 2
        highest = np.array([1.0] * DX + ways + speeds + [1.0] * 3)
        lowest = np.where(np.arange(len(COLUMNS)) < DX, 0.0, -highest)
        divisors = np.array([1.0] * DX + [WORLD_WIDTH] * 2 + speeds + [1.0] * 3)
        divisors = divisors if self.normalised else np.ones(len(COLUMNS))
        return (lowest / divisors).astype(np.float32), (highest / divisors).astype(np.float32), divisors

    @property
    def kernel(self) -> Callable[..., None]:
        """``observe_objects``."""
        return observe_objects

    def tables(self, setting: Setting) -> tuple[Any, ...]:
        """How many; factors and limits; each level's objects, their columns; room for the nearest of each world."""
        low, high, divisors = self._range()
        columns = {kind.number: place for place, kind in enumerate(OBSERVED) if kind.name in self.kinds}
        objects = [[(o.slot, columns[o.kind]) for _, o in found] for found in setting.objects(*columns)]
        room = [[0] * (setting.count * self.count)] * 2
        return (
            self.count,
            *(setting.table(values, np.float64) for values in (1.0 / divisors, low, high)),
            *Ragged(objects).columns(setting, 2),
            *(setting.table(values, np.float64) for values in room),
        )


@entry_point
def observe_objects(
    maps: Any, level_of: Any, worlds: Any, which: Any, first: int, last: int, out: Any, offset: int,
    count: int, factors: Any, lows: Any, highs: Any, starts: Any, slots: Any, columns: Any,
    nearest: Any, distances: Any,
) -> None:  # fmt: skip
    """Find the nearest objects of some worlds, by insertion, and write them."""
    for k in range(first, last):
        index = which[k]
        level = level_of[index]
        w = worlds[index]
        n = w.ninja
        base = index * count
        found = 0
        for object_ in range(starts[level], starts[level + 1]):
            o = w.objects[int(slots[object_])]
            if is_there(w, o):
                x, y = place_of(o)
                distance = (x - n.x) * (x - n.x) + (y - n.y) * (y - n.y)
                if found < count or distance < distances[base + count - 1]:
                    found = min(found + 1, count)
                    place = base + found - 1
                    while place > base and distance < distances[place - 1]:
                        distances[place] = distances[place - 1]
                        nearest[place] = nearest[place - 1]
                        place -= 1
                    distances[place] = distance
                    nearest[place] = object_
        width = len(factors)
        for j in range(offset, offset + count * width):
            out[index, j] = 0.0
        for rank in range(found):
            object_ = int(nearest[base + rank])
            o = w.objects[int(slots[object_])]
            at = offset + rank * width
            x, y = place_of(o)
            vx, vy = velocity_of(o)
            face_x, face_y = face_of(o)
            out[index, at + int(columns[object_])] = 1.0
            out[index, at + DX] = clamp((x - n.x) * factors[DX], lows[DX], highs[DX])
            out[index, at + DX + 1] = clamp((y - n.y) * factors[DX + 1], lows[DX + 1], highs[DX + 1])
            out[index, at + DX + 2] = clamp(vx * factors[DX + 2], lows[DX + 2], highs[DX + 2])
            out[index, at + DX + 3] = clamp(vy * factors[DX + 3], lows[DX + 3], highs[DX + 3])
            out[index, at + DX + 4] = clamp(face_x, -1.0, 1.0)
            out[index, at + DX + 5] = clamp(face_y, -1.0, 1.0)
            out[index, at + DX + 6] = moment_of(o)
