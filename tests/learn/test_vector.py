"""The vector environment: Gymnasium's own vector environment is the rule for resets, masks and infos."""

from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.error import ClosedEnvironmentError, InvalidAction, ResetNeeded, UnsupportedMode
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.vector.utils import batch_space
from gymnasium.wrappers import vector as wrappers

from ninja_game.errors import ArgumentError
from ninja_game.learn.vector import NinjaVectorEnv
from tests.support.learning import LEVELS, random_actions, same
from tests.support.memories import BOTH

MODES = [mode.value for mode in AutoresetMode]


class Alone(gym.Env[Any, Any]):
    """One world of a vector of one, as a single environment: what Gymnasium's own vector environment drives."""

    def __init__(self, **settings: Any) -> None:
        self.envs = NinjaVectorEnv(1, autoreset_mode="Disabled", **settings)
        self.observation_space, self.action_space = self.envs.single_observation_space, self.envs.single_action_space

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        return self.alone(*self.envs.reset(seed=seed, options=options))

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        seen, rewards, terminated, truncated, infos = self.envs.step(np.asarray(action)[np.newaxis])
        seen, info = self.alone(seen, infos)
        return seen, float(rewards[0]), bool(terminated[0]), bool(truncated[0]), info

    def alone(self, seen: Any, infos: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
        info = {name: value[0] for name, value in infos.items() if not name.startswith("_")}
        return {name: part[0] for name, part in seen.items()} if isinstance(seen, dict) else seen[0], info


def equal(one: Any, other: Any) -> bool:
    """Whether two answers of environments are equal, infos too."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(equal(one[name], other[name]) for name in one)
    if isinstance(one, np.ndarray) and one.dtype == object:
        return all(equal(*pair) for pair in zip(one, other, strict=True))
    return bool(np.array_equal(one, other))


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize("actions", ["discrete", "buttons"])
def test_it_does_what_gymnasiums_vector_of_single_environments_does(mode: AutoresetMode, actions: str) -> None:
    settings: dict[str, Any] = {"level": LEVELS, "actions": actions, "time_limit": 150}
    theirs = SyncVectorEnv([lambda: Alone(**settings)] * 5, autoreset_mode=mode)
    ours = NinjaVectorEnv(5, autoreset_mode=mode, **settings)
    assert theirs.observation_space == ours.observation_space
    assert theirs.action_space == ours.action_space
    assert equal(theirs.reset(seed=3)[0], ours.reset(seed=3)[0])
    ours.action_space.seed(1)
    ends = 0
    for _ in range(120):
        action = ours.action_space.sample()
        expected, found = theirs.step(action), ours.step(action)
        assert all(equal(*pair) for pair in zip(expected, found, strict=True))
        assert found[0] in ours.observation_space
        ends += int(found[2].sum() + found[3].sum())
    assert ends > 5


def test_without_autoreset_ended_worlds_wait_for_a_reset() -> None:
    envs = NinjaVectorEnv(3, level=LEVELS[0], autoreset_mode="Disabled")
    envs.reset(seed=1)
    for _ in range(6):
        _, rewards, terminated, _, infos = envs.step([0, 2, 0])
    assert terminated.tolist() == [False, True, False]
    assert (rewards.tolist(), infos["outcome"].tolist(), infos["_outcome"].all()) == ([0, 1, 0], [0, 1, 0], True)
    with pytest.raises(ResetNeeded, match="have ended"):
        envs.step([0, 0, 0])
    _, infos = envs.reset(options={"reset_mask": np.array([False, True, False])})
    assert infos["_ticks"].tolist() == [False, True, False]
    assert envs.step([0, 0, 0])[4]["ticks"].tolist() == [28, 4, 28]


def test_each_world_plays_the_level_that_it_is_given() -> None:
    envs = NinjaVectorEnv(3, level=LEVELS)
    _, infos = envs.reset(seed=1, options={"level": [2, 0, 1]})
    assert infos["level"].tolist() == ["level#2", "level#0", "level#1"]
    starts = envs.worlds.observations
    assert isinstance(starts, np.ndarray)
    assert (starts[:, 0] * 792).round().tolist() == [700, 100, 100]


def test_seeds_decide_which_levels_are_played() -> None:
    def levels(seed: int | list[int]) -> list[list[str]]:
        envs = NinjaVectorEnv(40, level=LEVELS, time_limit=4)
        played = [envs.reset(seed=seed)[1]["level"].tolist()]
        return [*played, *(envs.step([1] * 40)[4]["level"].tolist() for _ in range(4))]

    assert levels(5) == levels(5) == levels(list(range(5, 45)))
    assert levels(5) != levels(6)
    assert {"level#0", "level#1", "level#2"} == {level for row in levels(5) for level in row}


def test_a_reused_memory_is_written_again_and_a_copy_is_not() -> None:
    shared, copied = NinjaVectorEnv(2, level=LEVELS[0], copy=False), NinjaVectorEnv(2, level=LEVELS[0])
    for envs in (shared, copied):
        first, _ = envs.reset(seed=0)
        second = envs.step([2, 2])[0]
        assert (first is second) == (envs is shared)
        assert same(first, second) == (envs is shared)


@pytest.mark.parametrize(
    "actions",
    [
        [1, 1],
        [[1], [1], [1]],
        [1, 1, 6],
        [1, 1, -1],
        [1.0, 1.0, 1.0],
        ["a", "b", "c"],
        None,
        [True] * 3,
        [1, [1], 1],
        [1, 1, np.nan],
    ],
)
def test_what_is_not_an_action_is_refused(actions: Any) -> None:
    envs = NinjaVectorEnv(3, level=LEVELS[0])
    envs.reset(seed=0)
    with pytest.raises(InvalidAction, match="expected"):
        envs.step(actions)


def test_calls_out_of_order_are_refused() -> None:
    envs = NinjaVectorEnv(3, level=LEVELS[0])
    with pytest.raises(ResetNeeded):
        envs.step([1, 1, 1])
    with pytest.raises(ResetNeeded):
        envs.reset(options={"reset_mask": np.array([True, False, True])})
    with pytest.raises(ArgumentError):
        envs.reset(options={"level": "unknown"})
    with pytest.raises(ResetNeeded):
        envs.step([1, 1, 1])
    envs.reset()
    envs.close()
    envs.close()
    with pytest.raises(ClosedEnvironmentError):
        envs.step([1, 1, 1])
    with pytest.raises(ClosedEnvironmentError):
        envs.reset()


@pytest.mark.parametrize(
    "call",
    [
        {"seed": [1, 2]},
        {"seed": [1, 2, None]},
        {"seed": [1, 2, -3]},
        {"seed": -1},
        {"seed": 2**64},
        {"seed": [0, 1, 2**64]},
        {"seed": True},
        {"seed": 1.5},
        {"seed": "abc"},
        {"options": {"levels": 0}},
        {"options": {"reset_mask": [True, True, True]}},
        {"options": {"reset_mask": np.array([1, 0, 1])}},
        {"options": {"reset_mask": np.array([True])}},
        {"options": {"level": 7}},
        {"options": {"level": [0, 0]}},
    ],
)
def test_a_reset_that_does_not_fit_is_refused(call: dict[str, Any]) -> None:
    envs = NinjaVectorEnv(3, level=LEVELS)
    envs.reset()
    with pytest.raises(ArgumentError):
        envs.reset(**call)


@pytest.mark.parametrize(
    "settings",
    [
        {"num_envs": 0}, {"level": "no such level"}, {"frame_skip": 0}, {"frame_skip": "4"},
        {"time_limit": 2.5}, {"observation": 3}, {"time_limit": 0}, {"body": "square"},
        {"memory": "fast"}, {"actions": "keys"}, {"observation": "sight"}, {"observation": ["state", "state"]},
        {"observation": []}, {"reward": "fame"}, {"reward": [1.0]},
        {"threads": 0}, {"threads": -1}, {"threads": 1.5}, {"levle": "set"}, {"render_size": (0, 5)},
    ],
)  # fmt: skip
def test_settings_that_do_not_exist_are_refused(settings: dict[str, Any]) -> None:
    with pytest.raises(ArgumentError):
        NinjaVectorEnv(**settings)


@pytest.mark.parametrize("mode", MODES)
def test_spaces_are_those_of_one_world_batched(mode: str) -> None:
    envs = NinjaVectorEnv(4, level=LEVELS, autoreset_mode=mode)
    assert envs.metadata["autoreset_mode"] == AutoresetMode(mode)
    assert envs.action_space == batch_space(envs.single_action_space, 4)
    assert envs.observation_space == batch_space(envs.single_observation_space, 4)
    assert envs.reset(seed=1)[0] in envs.observation_space
    assert random_actions(1, 4)[0] in envs.action_space


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_gymnasiums_vector_wrappers_take_it(mode: str) -> None:
    made = gym.make_vec("ninja_game.learn:Ninja-v0", num_envs=4, level=LEVELS, autoreset_mode=mode, time_limit=40)
    assert made.spec is not None
    envs: Any = wrappers.RecordEpisodeStatistics(made)
    if mode == "NextStep":  # those of observations refuse the other
        envs = wrappers.FlattenObservation(envs)
    envs = wrappers.DictInfoToList(wrappers.NormalizeReward(envs))
    envs.reset(seed=4)
    lengths = []
    for _ in range(30):
        *_, infos = envs.step(envs.action_space.sample())
        assert len(infos) == 4
        lengths += [info["episode"]["l"] for info in infos if "episode" in info]
    assert lengths
    assert max(lengths) == 10
    envs.close()
    assert made.closed


@pytest.mark.parametrize("memory", BOTH)
def test_a_picture_of_each_world_is_that_of_a_single_environment(memory: str) -> None:
    settings: dict[str, Any] = {"level": LEVELS, "memory": memory, "render_mode": "rgb_array"}
    settings["render_size"], seed = (132, 100), 1
    envs = gym.make_vec("ninja_game.learn:Ninja-v0", 3, **settings)
    with pytest.raises(ResetNeeded):
        envs.render()
    envs.reset(seed=seed)
    for _ in range(3):
        envs.step(np.array([0, 4, 3]))
    frames = envs.render()
    assert frames is not None
    assert [np.asarray(frame).shape for frame in frames] == [(100, 132, 3)] * 3
    for world, action in enumerate((0, 4, 3)):
        env = gym.make("ninja_game.learn:Ninja-v0", **settings)
        env.reset(seed=seed + world)
        for _ in range(3):
            env.step(action)
        # The single environment has seen all ticks, and draws what lingers of them too.
        difference = np.abs(np.asarray(env.render(), np.int64) - np.asarray(frames[world]))
        assert (difference > 0).mean() < 0.02


def test_another_render_mode_is_refused() -> None:
    with pytest.raises(UnsupportedMode, match="'rgb_array' or None"):
        NinjaVectorEnv(2, LEVELS, render_mode="human")
