"""The difficulty of a level, measured by playing noisy versions of a run through it (docs/making-levels.md)."""

from __future__ import annotations

from math import log2

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Batch
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.sim.level import Level
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_RUNNING

_SPACING = TICKS_PER_SECOND  # ticks between the save-states from which tries begin
LENGTH = 3 * TICKS_PER_SECOND // 2  # ticks of a try
SHIFT = 3  # most ticks by which a key comes early or late
TRIES = 256  # tries from each save-state
LOST = 3 * CELL  # px from the run beyond which a try counts as lost although the ninja lives
LOST_WEIGHT = 0.25
"""Weight of a try that has lost the run; a death has 1. Such a try mostly just takes longer. Not tuned: a guess."""


def difficulty(level: Level, inputs: bytes, *, seed: int = 0, tries: int = TRIES, memory: str = "auto") -> float:
    """Measure a level by a run to its exit, ``inputs`` one byte per tick; 0 if nothing can go wrong.

    Save-states are taken in every second of the run. From each, ``tries`` tries go on for a second and a half with the
    run's keys, but presses and releases come up to ``SHIFT`` ticks early or late. The chance to fail in a second is the
    share of deaths plus a quarter of the share that ends ``LOST`` px or more from the run. The difficulty is -log2 of
    the chance to fail in no second: 3 means that one try in eight gets through, if it begins every second on the run.
    The same seed gives the same number, on both memories.
    """
    rng = np.random.default_rng(seed)
    batch = Batch(level, 1 + tries, memory=memory)
    noisy = slice(1, None)
    total = 0.0
    for start in range(0, len(inputs), _SPACING):
        rows = _shifted(inputs, start, tries, rng)
        true = np.frombuffer(inputs[start : start + LENGTH].ljust(len(rows), b"\0"), np.uint8)[:, np.newaxis]
        batch.copy([0] * tries, noisy)
        keys = np.hstack([true, rows])
        batch.run(keys[:_SPACING], stop=True, press=True)
        following = batch.save([0])
        batch.run(keys[_SPACING:], stop=True, press=True)
        total -= log2(1 - _failing(batch, noisy))
        batch.restore(following, [0])
    return total


def _failing(batch: Batch, noisy: slice) -> float:
    """The share of tries that fail, always below 1."""
    dead = batch.outcomes[noisy] == OUTCOME_DEAD
    away = np.abs(batch.positions[noisy] - batch.positions[0]).max(axis=1) >= LOST
    lost = (batch.outcomes[noisy] == OUTCOME_RUNNING) & away
    share = (dead.sum() + LOST_WEIGHT * lost.sum()) / len(dead)
    return float(min(share, 1 - 0.5 / len(dead)))


def _shifted(inputs: bytes, start: int, tries: int, rng: np.random.Generator) -> NDArray[np.uint8]:
    """The keys of ``tries`` tries from a tick on, (LENGTH, tries), with every change of a key shifted."""
    ticks = np.arange(LENGTH)[:, np.newaxis]
    keys = np.zeros((LENGTH, tries), np.uint8)
    for key in (KEY_LEFT, KEY_RIGHT, JUMP_HELD):
        held = bool(inputs[start - 1] & key) if start else False
        down = np.full((LENGTH, tries), held)
        before = np.zeros(tries, np.int64)
        for tick in range(start, min(start + LENGTH + SHIFT, len(inputs))):
            if bool(inputs[tick] & key) != held:
                held = not held
                # Shifts never reorder the changes of a key.
                before = np.maximum(before, tick - start + rng.integers(-SHIFT, SHIFT, tries, endpoint=True))
                down = np.where(ticks >= before, held, down)
        keys |= np.where(down, np.uint8(key), np.uint8(0))
    return keys
