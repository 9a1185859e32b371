"""The adapter for Stable-Baselines3, where that is installed: its vector is ours, and its agents learn in it."""

from typing import Any

import numpy as np
import pytest

from ninja_game.learn import ENVIRONMENTS, NinjaVectorEnv
from tests.support.learning import LEVELS

pytest.importorskip("stable_baselines3")
SETTINGS: dict[str, Any] = {"level": LEVELS, "memory": "plain", "time_limit": 40}


def test_it_shows_what_the_vector_shows() -> None:
    from examples.sb3 import SB3VecEnv

    ours, theirs = NinjaVectorEnv(3, autoreset_mode="SameStep", **SETTINGS), SB3VecEnv(3, **SETTINGS)
    theirs.seed(5)
    seen: Any = ours.reset(seed=5)[0]
    before: Any = theirs.reset()
    assert np.array_equal(before, seen)
    for row in np.random.default_rng(0).integers(6, size=(40, 3)):
        kept = seen
        seen, rewards, terminated, truncated, infos = ours.step(row)
        shown, paid, ended, step_infos = theirs.step(row)
        # SB3 stores the observations of the step before only now.
        assert np.array_equal(before, kept)
        assert np.array_equal(shown, seen)
        assert np.array_equal(paid, rewards)
        assert np.array_equal(ended, terminated | truncated)
        for world in np.flatnonzero(ended):
            assert np.array_equal(step_infos[world]["terminal_observation"], infos["final_obs"][world])
            assert step_infos[world]["TimeLimit.truncated"] == truncated[world]
            assert step_infos[world]["episode"]["l"] > 0
        before = shown


@pytest.mark.slow
@pytest.mark.filterwarnings("default::DeprecationWarning")
def test_an_agent_learns_in_it() -> None:
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecFrameStack

    from examples.sb3 import SB3VecEnv

    PPO("MlpPolicy", SB3VecEnv(4, **SETTINGS), n_steps=16, batch_size=32).learn(128)
    stacked = VecFrameStack(SB3VecEnv(2, observation="image", **SETTINGS), 4)
    assert stacked.observation_space.shape == (84, 84, 4)
    PPO("CnnPolicy", stacked, n_steps=8, batch_size=16).learn(16)


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_its_checker_takes_every_environment(name: str) -> None:
    """But version 0 of pixels, which have no channel."""
    import gymnasium
    from stable_baselines3.common.env_checker import check_env

    check_env(gymnasium.make(f"ninja_game.learn:{name}", memory="plain", time_limit=40).unwrapped)
