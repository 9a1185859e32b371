"""Rewards: terms add up; shaping follows the distance to the exit and changes no policy's rank."""

from typing import Any

import numpy as np
import pytest

from ninja_game import parse_level
from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ArgumentError
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.rewards import DeathPenalty, DistanceShaping, ExitReward, terms_of
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.search.heuristics import FARTHEST, POINTS
from tests.support.learning import FLOOR, LEVELS, random_actions
from tests.support.memories import BOTH

LOCKED = parse_level(
    FLOOR[:345] + "1" * 22 + FLOOR[367:] + "|5^300,566!11^760,566,730,566!9^330,560,0,0,15,23,1,0,0!12^60,566"
)
"""A wall with a locked door at the floor, its switch, the exit behind it, a mine."""


@pytest.mark.parametrize("memory", BOTH)
def test_shaping_sums_up_to_the_same_whatever_is_done(memory: str) -> None:
    shaping = DistanceShaping(weight=2.0, discount=0.9)
    worlds = EnvWorlds(LEVELS[:2], 4, memory=memory, reward=[ExitReward(), shaping], time_limit=600)
    worlds.reset(levels=[0, 1, 0, 1])
    total, alive, factor = np.zeros(4), np.ones(4, np.bool_), 1.0
    for row in random_actions(150, 4, seed=8):
        worlds.step(DISCRETE_KEYS[row])
        total += np.where(alive, factor * (worlds.rewards - (worlds.outcomes == 1)), 0.0)
        alive &= ~worlds.terminated
        factor *= 0.9
    assert (~alive).sum() >= 2
    assert np.allclose(total[~alive], 0.0, atol=1e-9)


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_the_distance_goes_by_the_switches_and_is_the_same_on_both_memories() -> None:
    seen: list[Any] = []
    for memory in ("plain", "compiled"):
        worlds = EnvWorlds(LOCKED, 2, memory=memory, goal_distance=True, reward=[DistanceShaping()])
        assert worlds.goal is not None
        ticks, states = [worlds.goal.ticks.copy()], [worlds.goal.states.copy()]
        for _ in range(40):
            worlds.step(DISCRETE_KEYS[[2, 1]])
            ticks.append(worlds.goal.ticks.copy())
            states.append(worlds.goal.states.copy())
        seen.append((np.array(ticks), np.array(states), worlds.rewards.copy()))
    (ticks, states, _), _ = seen
    assert all(np.array_equal(*pair) for pair in zip(*seen, strict=True))
    assert states[:, 0].max() == 3
    assert not states[:, 1].any()
    assert (np.diff(ticks[states[:, 0] == 0, 0]) <= 0).all()
    assert ticks[-1, 0] < ticks[0, 0] == ticks[-1, 1] < FARTHEST


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_fields_are_the_same_bytes_without_numba(monkeypatch: pytest.MonkeyPatch) -> None:
    fields = []
    for available in (True, False):
        monkeypatch.setattr("ninja_game.backend.memories.compiled_available", lambda answer=available: answer)
        worlds = EnvWorlds(LOCKED, 1, memory="plain", goal_distance=True)
        assert worlds.goal is not None
        fields.append(worlds.goal.fields[worlds.goal.rows[0]].tobytes())
    assert fields[0] == fields[1]


@pytest.mark.parametrize("memory", BOTH)
def test_fields_that_no_world_needs_give_way(memory: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.learn.goal_distance.SPARE_FIELDS", 0)
    worlds = EnvWorlds(LEVELS[:2], 1, memory=memory, goal_distance=True)
    assert worlds.goal is not None
    assert worlds.goal.fields.shape == (1, POINTS)
    ticks = []
    for level in (0, 1, 0):
        worlds.reset(levels=level)
        ticks.append(worlds.goal.ticks.tolist())
    assert ticks[0] == ticks[2] != ticks[1]


def test_a_restored_world_is_shaped_as_it_would_have_been() -> None:
    worlds = EnvWorlds(LEVELS[0], 2, memory="plain", reward=[DistanceShaping(), DeathPenalty()])
    for _ in range(2):
        worlds.step(DISCRETE_KEYS[[2, 1]])
    worlds.restore(worlds.save([0]), [1])
    worlds.step(DISCRETE_KEYS[[2, 2]])
    assert worlds.rewards[0] == worlds.rewards[1] > 0


@pytest.mark.parametrize("reward", [3, "fame", [ExitReward(), None], [1.0]])
def test_what_is_not_a_reward_is_refused(reward: Any) -> None:
    with pytest.raises(ArgumentError, match="expected one of"):
        terms_of(reward)
