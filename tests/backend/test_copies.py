"""Copies and pickles of whatever holds worlds are worlds of their own: equal, and going on alike."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from ninja_game import Batch, Simulation, parse_level
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


def environment(kind: str, memory: str) -> Any:
    """One that has whatever may be shared by accident: a source that learns, potentials, a goal, several parts."""
    from ninja_game.learn.levels.origins import level_source
    from ninja_game.learn.levels.source import Curriculum
    from ninja_game.learn.rewards import DistanceShaping
    from ninja_game.learn.single import NinjaEnv
    from ninja_game.learn.vector import NinjaVectorEnv

    easy = [parse_level("0" * 713 + f"|5^100,566!11^{x},564,130,564!0^120,566!1^300,300") for x in (160, 400)]
    level = Curriculum(level_source(easy), difficulties=[1, 2], start=1, threshold=0.01)
    reward = DistanceShaping()
    settings: Any = {"observation": ["state", "rays"], "reward": reward, "time_limit": 90, "memory": memory}
    return NinjaEnv(level, **settings) if kind == "single" else NinjaVectorEnv(3, level, **settings)


@pytest.mark.parametrize("kind", ["single", "vector"])
def test_a_copied_environment_goes_on_alike_and_alone(kind: str, again: Again, memory: str) -> None:
    env = environment(kind, memory)
    env.reset(seed=7)

    def steps(of: Any, count: int) -> list[bytes]:
        """All results of some steps; a world that has ended begins a new episode."""
        returned: list[Any] = []
        for number in range(count):
            observed, *rest = of.step(2 if kind == "single" else [2, 2, number % 6])
            returned += [*observed.values(), *map(str, rest), of.worlds.events, of.worlds.levels_now]
            if kind == "single" and (rest[1] or rest[2]):
                returned += of.reset()[0].values()
        return [np.asarray(value).tobytes() for value in returned]

    steps(env, 15)
    other = again(env)
    here, there = ((each.worlds.ticks, each.worlds.rewards, each.worlds.events) for each in (env, other))
    assert np.array_equal(here, there)
    before = env.worlds.digest(0)
    found = steps(other, 40)
    assert env.worlds.digest(0) == before
    assert env.worlds.source.rates.tolist() != other.worlds.source.rates.tolist()
    assert steps(env, 40) == found
    assert env.worlds.source.rates.tolist() == other.worlds.source.rates.tolist()
