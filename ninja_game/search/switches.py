"""What is open in a level, a bit a switch: the one place that reads switches for searches and for goal distances."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.kinds import EXIT
from ninja_game.sim.memory.declare import entry_point, fast
from ninja_game.sim.memory.schema import World
from ninja_game.sim.traces import is_open


@fast
def open_bits(w: World, slots: Any, first: int, last: int) -> int:
    """The switch state of a world: bit k is set if the exit or door ``slots[first + k]`` is not as it began."""
    mask = 0
    for k in range(first, last):
        if is_open(w, int(slots[k])):
            mask |= 1 << (k - first)
    return mask


@fast
def open_mask(w: World, slots: Any) -> int:
    """The switch state over all ``slots``."""
    return open_bits(w, slots, 0, len(slots))


@entry_point
def open_mask_at(worlds: Any, index: int, slots: Any) -> int:
    """The switch state over all ``slots`` of world ``index``."""
    return open_bits(worlds[index], slots, 0, len(slots))


def open_masks(objects: Any, slots: Any) -> NDArray[np.int64]:
    """The switch states of many worlds, by their objects: records (worlds, slots)."""
    masks = np.zeros(len(objects), np.int64)
    for bit, slot in enumerate(slots):
        record = objects[:, slot]
        opened = np.where(record["kind"] == EXIT, record["is_open"], record["switched"])
        masks |= (opened != 0).astype(np.int64) << bit
    return masks
