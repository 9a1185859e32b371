"""What people do with environments: wrappers, pictures, vectors of single ones, specs; and what version 0 is."""

import hashlib
import pickle
import re
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import InvalidAction
from gymnasium.vector import AutoresetMode
from gymnasium.wrappers import (
    FlattenObservation,
    FrameStackObservation,
    RecordEpisodeStatistics,
    RenderCollection,
    TimeLimit,
    vector as vector_wrappers,
)

from ninja_game.errors import ArgumentError
from ninja_game.learn import ENVIRONMENTS
from ninja_game.learn.single import NinjaEnv
from ninja_game.learn.vector import NinjaVectorEnv

NEAR = "0" * 713 + "|5^100,566!0^130,566!12^400,566!11^260,564,230,564"
RIGHT = 2


def made(**settings: Any) -> gymnasium.Env[Any, Any]:
    return gymnasium.make("ninja_game.learn:Ninja-v0", level=NEAR, memory="plain", **settings)


def test_wrappers_work() -> None:
    env = RecordEpisodeStatistics(TimeLimit(FrameStackObservation(FlattenObservation(made()), 3), 5))
    observation, _ = env.reset(seed=0)
    assert observation.shape == (3, 30)
    ends = [env.step(1)[2:] for _ in range(5)]
    assert [truncated for _, truncated, _ in ends] == [False] * 4 + [True]
    assert ends[-1][2]["episode"]["l"] == 5


def test_pictures_of_all_steps_are_collected() -> None:
    env = RenderCollection(made(render_mode="rgb_array", render_size=(132, 100)))
    env.reset(seed=0)
    for _ in range(3):
        env.step(RIGHT)
    frames = env.render()
    assert isinstance(frames, list)
    assert len(frames) == 4
    assert len({np.asarray(frame).tobytes() for frame in frames}) == 4


@pytest.mark.parametrize(
    "mode, more",
    # Other processes that begin afresh: a copy of this one would lack the threads that it has.
    [("sync", {}), ("async", {"context": "spawn"})],
)
def test_vectors_of_single_environments_are_the_vector_environment(mode: str, more: dict[str, str]) -> None:
    settings: dict[str, Any] = {"level": ["00-0-first-steps", NEAR], "memory": "plain"}
    single = gymnasium.make_vec(
        "ninja_game.learn:Ninja-v0", num_envs=2, vectorization_mode=mode, vector_kwargs=more, **settings
    )
    whole = gymnasium.make_vec("ninja_game.learn:Ninja-v0", num_envs=2, **settings)
    assert isinstance(whole, NinjaVectorEnv)
    assert whole.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    try:
        one: Any = single.reset(seed=4)
        other: Any = whole.reset(seed=4)
        for _ in range(40):
            assert all(np.array_equal(a, b) for a, b in zip(one[:-1], other[:-1], strict=True))
            one, other = (envs.step(np.array([RIGHT, 5])) for envs in (single, whole))
    finally:
        single.close()
        whole.close()


def test_vector_wrappers_work() -> None:
    envs = gymnasium.make_vec("ninja_game.learn:Ninja-v0", num_envs=3, level=NEAR, memory="plain")
    envs = vector_wrappers.RecordEpisodeStatistics(vector_wrappers.NormalizeObservation(envs))
    envs.reset(seed=0)
    done = None
    while done is None:
        *_, infos = envs.step(np.full(3, RIGHT))
        done = infos.get("episode")
    assert done["r"].tolist() == [1.0] * 3


def test_a_spec_makes_the_environment_again() -> None:
    spec = made(frame_skip=2).spec
    assert spec is not None
    again = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(spec.to_json())).unwrapped
    assert isinstance(again, NinjaEnv)
    assert again.worlds.frame_skip == 2
    assert gymnasium.make(pickle.loads(pickle.dumps(spec))).unwrapped.spec == again.spec


V0 = {
    "Ninja-v0": {},
    "NinjaCurriculum-v0": {"level": "curriculum"},
    "NinjaPixels-v0": {"observation": "image"},
    "NinjaSet-v0": {"level": "set"},
    "NinjaTest-v0": {"level": "test"},
    "NinjaTrain-v0": {"level": "train"},
}


def test_versions_are_what_they_were() -> None:
    """What docs/learning.md promises of a version: if this fails and the change is meant, it is another version."""
    assert {name: ENVIRONMENTS[name] for name in V0} == V0
    env = made()
    shown = hashlib.sha256()
    generator = np.random.default_rng(0)
    observation, _ = env.reset(seed=0)
    for _ in range(400):
        observation, reward, terminated, truncated, info = env.step(int(generator.integers(6)))
        shown.update(observation.tobytes() + repr((reward, terminated, truncated, info)).encode())
        if terminated or truncated:
            env.reset()
    assert env.unwrapped.metadata["render_fps"] == 10
    assert shown.hexdigest()[:16] == "ac3cd899a854ca79"
    several = NinjaEnv([NEAR] * 20, memory="plain")
    chosen = []
    for seed in (7, None, None, None, None):
        several.reset(seed=seed)
        chosen.append(several.worlds.levels_now.item())
    assert chosen == [5, 1, 14, 7, 5]


def wrong_words() -> dict[str, Any]:
    """As a user's program that no tool has checked."""
    return {"typo": 1}


@pytest.mark.parametrize(
    "wrong,problem",
    [
        (lambda env: env.reset(options=3), "options are 3; expected a dict of level"),
        (lambda env: env.reset(options={"lvl": 1}), "options are {'lvl': 1}; expected a dict of level"),
        (lambda env: env.step(6), "found the actions [6]; expected 0 to 5"),
        (lambda _: NinjaEnv([]), "level is []; expected a name"),
        (lambda _: NinjaEnv(**wrong_words()), "no argument 'typo'; expected one of actions, body, flat"),
    ],
)
def test_what_is_wrong_with_an_argument_is_reported(wrong: Any, problem: str) -> None:
    env = NinjaEnv(memory="plain")
    env.reset(seed=0)
    with pytest.raises((ArgumentError, InvalidAction), match=re.escape(problem)):
        wrong(env)
