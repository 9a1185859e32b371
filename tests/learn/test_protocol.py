"""The evaluated task: how often keys are played again, how long episodes wait; and what version 1 is."""

import hashlib
from typing import Any

import gymnasium
import numpy as np
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ArgumentError
from ninja_game.learn import ENVIRONMENTS, NinjaEnv, NinjaVectorEnv
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.evaluation import evaluate, first_seed
from ninja_game.learn.observations.vectors import Guide
from ninja_game.learn.rewards import DistanceShaping
from ninja_game.learn.worlds import EnvWorlds
from tests.support.learning import LEVELS

FAST = "compiled" if compiled_available() else "plain"
BENCH = {name: settings for name, settings in ENVIRONMENTS.items() if name.startswith("NinjaBench")}
KEYS = DISCRETE_KEYS.astype(np.int64)


def played(worlds: EnvWorlds, action: int) -> Any:
    """The keys of a step for which all worlds were given this action."""
    worlds.step(np.full(worlds.count, KEYS[action], np.uint8))
    return worlds.played.copy()


def test_a_quarter_of_the_steps_plays_the_keys_of_the_step_before() -> None:
    worlds = EnvWorlds(LEVELS, 1000, memory=FAST, repeat=0.25)
    played(worlds, 5)
    before, kept = worlds.played.copy(), []
    for action in (0, 2, 3, 4, 0, 5):
        now = played(worlds, action)
        assert set(now[now != KEYS[action]]) <= set(before)
        kept.append((now == before).mean())
        before = now
    assert 0.23 < np.mean(kept) < 0.27


def test_episodes_wait_from_0_to_7_steps() -> None:
    worlds = EnvWorlds(LEVELS[0], 4000, memory=FAST, longest_wait=7)
    waits = sum((played(worlds, 2) == 0).astype(int) for _ in range(10))
    assert np.bincount(waits, minlength=8).min() > 400
    assert waits.max() == 7


def test_the_seed_and_the_number_of_the_episode_decide() -> None:
    def keys(seed: int, episodes: int) -> list[int]:
        worlds = EnvWorlds(LEVELS[0], 1, memory="plain", repeat=0.25, longest_wait=7)
        worlds.reset(seeds=[seed])
        for _ in range(episodes):
            worlds.reset()
        return [int(played(worlds, action)[0]) for action in (2, 5, 0, 3) * 8]

    assert keys(3, 0) == keys(3, 0) != keys(4, 0)
    assert keys(3, 1) == keys(3, 1) != keys(3, 0)


def test_a_moment_is_restored_without_its_chance() -> None:
    env = NinjaEnv(LEVELS[0], memory="plain", repeat=0.9)
    env.reset(seed=1)
    moment, futures = env.save(), set()
    for _ in range(20):
        env.restore(moment)
        for _ in range(4):
            env.step(2)
        futures.add(env.inputs)
    assert len(futures) > 1


@pytest.mark.parametrize("wrong", [{"repeat": 1.0}, {"repeat": -0.1}, {"repeat": "often"}, {"longest_wait": -1}])
def test_chances_that_cannot_be_are_reported(wrong: dict[str, Any]) -> None:
    with pytest.raises(ArgumentError, match=rf"{next(iter(wrong))} is .*; expected"):
        NinjaEnv(LEVELS[0], memory="plain", **wrong)


def test_an_evaluation_is_of_episodes_that_anybody_can_play() -> None:
    """By a policy that runs to the right, in an environment of Gymnasium."""

    class Runner:
        settings: dict[str, Any] = {"memory": "plain"}  # noqa: RUF012

        def reset(self, count: int, _seed: int) -> None:
            self.count = count

        def act(self, _observations: Any) -> Any:
            return np.full(self.count, 2)

    (row,) = evaluate(Runner(), LEVELS[1], episodes=6, memory="plain").results
    env = gymnasium.make("ninja_game.learn:NinjaBench-v1", level=LEVELS[1], memory="plain")
    golds = []
    for number in range(6):
        _, info = env.reset(seed=first_seed(LEVELS[1]) + number)
        while info["outcome"] == "running" and info["ticks"] < 2000:
            *_, info = env.step(2)
        golds.append((info["outcome"], info["gold"]))
    assert (row.passed, row.dead) == tuple(sum(ended == outcome for ended, _ in golds) for outcome in ("exit", "dead"))
    assert row.gold == np.mean([gold for _, gold in golds])


@pytest.mark.parametrize("name", BENCH)
def test_no_environment_of_the_benchmark_shows_the_solvers_field(name: str) -> None:
    env: Any = gymnasium.make(f"ninja_game.learn:{name}", memory="plain", level=LEVELS[0]).unwrapped
    assert env.worlds.goal is None
    assert not any(isinstance(part, Guide) for part in env.worlds.observation.parts)
    assert not any(isinstance(term, DistanceShaping) for term in env.worlds.terms)


def test_version_1_is_what_it_was() -> None:
    task = {"repeat": 0.25, "longest_wait": 7, "time_limit": 2000, "level": "bench:train"}
    assert {
        "NinjaBench-v1": task,
        "NinjaBench-Gold-v1": {**task, "reward": ["exit", "gold"]},
        "NinjaBench-Pixels-v1": {**task, "observation": "image"},
        "NinjaBench-Rays-v1": {**task, "observation": ["state", "tiles", "rays"], "flat": True},
    } == BENCH


DIGESTS = {
    "NinjaBench-v1": "a249c4011da5348b",
    "NinjaBench-Gold-v1": "e5d72d0bfc9b6135",
    "NinjaBench-Pixels-v1": "3ac1890a40dd07de",
    "NinjaBench-Rays-v1": "b7d86f8f5161a75c",
}


@pytest.mark.parametrize("name", BENCH)
def test_what_the_benchmark_shows_is_frozen(name: str) -> None:
    """Observations, rewards and ends of random play: if this fails and the change is meant, it is another version."""
    digests = []
    ways: list[dict[str, Any]] = [{"memory": FAST}, {"memory": "plain", "vectorization_mode": "sync"}]
    for how in ways:
        envs: Any = gymnasium.make_vec(f"ninja_game.learn:{name}", 3, level=LEVELS, time_limit=300, **how)
        assert isinstance(envs, NinjaVectorEnv) == ("vectorization_mode" not in how)
        shown, actions = hashlib.sha256(), np.random.default_rng(0)
        answer: tuple[Any, ...] = envs.reset(seed=7)
        for _ in range(400):
            *arrays, infos = answer
            shown.update(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays))
            shown.update(np.array([infos["ticks"], infos["gold"]], np.int64).tobytes())
            answer = envs.step(actions.integers(6, size=3))
        digests.append(shown.hexdigest()[:16])
    assert digests == [DIGESTS[name]] * 2
