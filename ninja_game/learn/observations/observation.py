"""Parts of an observation combined: one space, arrays that are reused, one call for many worlds.

>>> from ninja_game.learn.observations.vectors import StateVector
>>> Observation(StateVector()).space.shape
(30,)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from gymnasium.spaces import Box, Dict, Space

from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.objects import LevelPlanes, NearObjects
from ninja_game.learn.observations.part import Array, Part, PartContext
from ninja_game.learn.observations.pixels import Image, Pixels
from ninja_game.learn.observations.surroundings import LocalTiles, Rays
from ninja_game.learn.observations.vectors import Guide, StateVector, TimeLeft

PARTS: dict[str, type[Part]] = {
    part.name: part
    for part in (StateVector, LocalTiles, Rays, NearObjects, LevelPlanes, Pixels, Image, TimeLeft, Guide)
}
"""The parts, by name."""

PartLike: TypeAlias = Part | str
Writer: TypeAlias = tuple[Callable[..., None], tuple[Any, ...]]
Observed: TypeAlias = Array | dict[str, Array]  # observations of several worlds: (worlds, …), or such an array per part


def parts_of(observation: PartLike | Sequence[PartLike]) -> list[Part]:
    """Resolve parts: a part, its name, or several of these.

    Raises ArgumentError for anything else, and for two parts with the same name.
    """
    several = isinstance(observation, Sequence) and not isinstance(observation, str)
    choices: Any = observation if several else [observation]
    parts = []
    for choice in choices:
        part = PARTS[choice]() if isinstance(choice, str) and choice in PARTS else choice
        if not isinstance(part, Part):
            raise ArgumentError(f"a part of the observation is {choice!r:.60}; expected a Part or one of {list(PARTS)}")
        parts.append(part)
    names = [part.name for part in parts]
    if not parts or len(set(names)) < len(names):
        raise ArgumentError(f"the parts of the observation are {names}; expected at least one, each once")
    return parts


class Observation:
    """The observation of a world.

    A single part gives its own Box, several parts give a Dict; with ``flat`` they give one float32 Box of one
    dimension, part after part in the given order. Raises ArgumentError as ``parts_of`` does.
    """

    def __init__(self, observation: PartLike | Sequence[PartLike], *, flat: bool = False) -> None:
        self.parts = parts_of(observation)
        self.flat = flat
        boxes: dict[str, Space[Any]] = {part.name: part.box for part in self.parts}
        self.space: Space[Any] = Dict(boxes)
        if flat:
            low, high = ([getattr(box, end).ravel() for box in boxes.values()] for end in ("low", "high"))
            self.space = Box(np.concatenate(low, dtype=np.float32), np.concatenate(high, dtype=np.float32))
        elif len(boxes) == 1:
            (self.space,) = boxes.values()

    def buffers(self, count: int) -> Observed:
        """Zeroed arrays for the observations of ``count`` worlds."""
        if isinstance(self.space, Dict):
            return {name: _zeros(box, count) for name, box in self.space.items()}
        return _zeros(self.space, count)

    def writers(self, buffers: Observed, context: PartContext) -> list[Writer]:
        """The writers of the parts to ``buffers``: the kernel of a part and its last arguments."""
        writers, offset = [], 0
        for part in self.parts:
            array = buffers[part.name] if isinstance(buffers, dict) else buffers
            kernel, *tables = part.tables(context)
            writers.append((context.worlds.kernel(kernel), (array.reshape(len(array), -1), offset, *tables)))
            offset += part.length if self.flat else 0
        return writers


def _zeros(space: Space[Any], count: int) -> Array:
    return np.zeros((count, *(space.shape or ())), space.dtype)
