"""Copies and pickles of whatever holds worlds are worlds of their own: equal, and going on alike."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ninja_game import Batch, Simulation
from ninja_game.backend.memories import open_worlds
from tests.support.crowded import crowded_inputs, crowded_level
from tests.support.memories import BOTH

LEVELS = [crowded_level(seed) for seed in (3, 5)]
KEYS = crowded_inputs(3, 120)
WAYS = [copy.copy, copy.deepcopy, lambda value: pickle.loads(pickle.dumps(value))]

pytestmark = [
    pytest.mark.parametrize("memory", BOTH),
    pytest.mark.parametrize("again", WAYS, ids=["copy", "deepcopy", "pickle"]),
]
Again = Callable[[Any], Any]


def test_a_copied_container_has_the_same_worlds_events_and_levels(again: Again, memory: str) -> None:
    worlds = open_worlds(memory, LEVELS, 3, box=True)
    worlds.load([2], [1])
    for keys in KEYS[:60]:
        worlds.step(keys, 2)
    worlds.kill(3, 1.0, -1.0, 2)
    other = again(worlds)
    assert list(other.level_of) == [0, 1, 1]
    happened = [[(event.kind, event.x, event.cause) for event in each.events(2)] for each in (worlds, other)]
    assert happened[0] == happened[1] != []
    assert bytes(memoryview(other.run(KEYS, 2).places)) == bytes(memoryview(worlds.run(KEYS, 2).places))
    assert other.number("tick", 2) == worlds.number("tick", 2)
    assert other.states.tobytes() == worlds.states.tobytes()


def test_a_copied_run_goes_on_alike_and_alone(again: Again, memory: str) -> None:
    run = Simulation(LEVELS[0], memory=memory)
    for keys in KEYS[:80]:
        run.step_keys(keys)
    run.kill(2, 1.0, 0.0)
    other = again(run)
    assert (other.events, other.inputs, other.digest()) == (run.events, run.inputs, run.digest())
    assert other.save() == run.save()
    other.step_keys(2)
    assert (run.tick, other.tick, len(run.inputs)) == (80, 81, 80)
    run.step_keys(2)
    assert (other.events, other.digest()) == (run.events, run.digest())
    other.restore(run.save())
    other.reset()
    assert (other.tick, run.tick) == (0, 81)


def test_a_copied_batch_shows_and_runs_its_own_worlds(again: Again, memory: str) -> None:
    batch = Batch(LEVELS, 3, memory=memory)
    rows = np.frombuffer(KEYS, np.uint8).reshape(-1, 3)
    batch.reset(0, levels=1)
    batch.run(rows[:20])
    other = again(batch)
    assert other.state_digests() == batch.state_digests()
    assert other.levels_now.tolist() == [1, 1, 0]
    other.run(rows[20:])
    assert (batch.ticks.tolist(), other.ticks.tolist()) == ([20] * 3, [40] * 3)
    batch.run(rows[20:])
    assert np.array_equal(other.positions, batch.positions)
    assert other.state_digests() == batch.state_digests()
    other.restore(batch.save())
