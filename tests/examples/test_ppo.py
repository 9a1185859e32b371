"""The method by itself: advantages by their definition, the way that it is paid for; the same seed, the same agent."""

import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from examples import agents, ppo
from examples.agents import PolicyAgent, forward, load_policy
from examples.imitate import imitate, known_steps
from examples.measure import measure
from examples.ppo import OBSERVATION, Settings, advantages, main, new_networks, train, way_left
from ninja_game.backend.memories import compiled_available
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.observations.observation import Observation
from ninja_game.learn.observations.pixels import Pixels
from ninja_game.learn.observations.vectors import FIELDS, Guide
from ninja_game.learn.worlds import EnvWorlds
from tests.support.waiting import LONGEST
from tools import ROOT

fast = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
SHORT = Settings(hidden=8, worlds=16, round=8, batch=64)


def test_advantages_are_discounted_sums_of_what_was_better_than_expected() -> None:
    rng = np.random.default_rng(1)
    rewards = rng.random((6, 2)).astype(np.float32)
    values = rng.random((7, 2)).astype(np.float32)
    terminated, ended = np.zeros((2, 6, 2), np.bool_)
    terminated[3, 1] = ended[3, 1] = True
    ended[2, 0] = True  # by the time
    found = advantages(rewards, values, terminated, ended, Settings(discount=0.9, trace=0.8))
    for world in range(2):
        for step in range(6):
            expected, factor = 0.0, 1.0
            for k in range(step, 6):
                follows = 0.0 if terminated[k, world] else 0.9 * values[k + 1, world]
                expected += factor * (rewards[k, world] + follows - values[k, world])
                factor *= 0.9 * 0.8
                if ended[k, world]:
                    break
            assert found[step, world] == pytest.approx(expected, abs=1e-5)


def test_new_networks_expect_nothing_and_prefer_nothing() -> None:
    networks = new_networks(10, 16, np.random.default_rng(0))
    seen = np.random.default_rng(1).standard_normal((50, 10)).astype(np.float32)
    assert np.ptp(forward(networks["policy"], seen)) < 0.2
    assert [weights.shape for weights, _ in networks["value"]] == [(10, 16), (16, 16), (16, 1)]


def test_a_network_sees_each_square_of_a_picture_alike() -> None:
    networks = new_networks(10, 16, np.random.default_rng(0), 84 * 84)
    assert [weights.shape for weights, _ in networks["policy"]] == [
        (6, 6, 1, 16), (2, 2, 16, 32), (1568, 16), (16, 16), (16, 6),
    ]  # fmt: skip
    assert networks["value"][0][0].shape == (10, 16)
    rng = np.random.default_rng(1)
    picture, weights, biases = rng.random((2, 12, 12, 3)), rng.random((4, 4, 3, 5)), rng.random(5)
    found = forward([(weights, biases)], picture.reshape(2, -1)).reshape(2, 3, 3, 5)
    for row, column in np.ndindex(3, 3):
        square = picture[:, 4 * row : 4 * row + 4, 4 * column : 4 * column + 4]
        assert np.allclose(found[:, row, column], np.tensordot(square, weights, 3) + biases)


def test_the_way_left_goes_by_the_switch_until_the_exit_is_open() -> None:
    worlds = EnvWorlds("0" * 713 + "|5^100,566!11^300,566,200,566", 1, observation="state", memory="plain")
    for ticks, left in ((0, 200), (16, None)):
        for _ in range(ticks):
            worlds.step(np.array([2], np.uint8))
        seen = np.asarray(worlds.observations)
        expected = left or 300 - seen[0, list(FIELDS).index("x")] * 792
        assert way_left(seen)[0] * 792 == pytest.approx(expected, abs=0.5)
    assert seen[0, list(FIELDS).index("exit_open")] == 1


def test_the_agent_sees_no_field_of_the_solver() -> None:
    assert not any(isinstance(part, Guide) or part.needs_goal for part in OBSERVATION)


def arrays(agent: PolicyAgent) -> bytes:
    """Everything that decides what an agent does."""
    parts = [array for layer in agent.layers for array in layer]
    return b"".join(array.tobytes() for array in (*parts, agent.mean, agent.scale))


@fast
@pytest.mark.slow
def test_the_same_seed_makes_the_same_agent() -> None:
    pytest.importorskip("jax")
    first, again, other = (train("bench:train:easy", 512, seed, settings=SHORT) for seed in (1, 1, 2))
    assert arrays(first) == arrays(again) != arrays(other)
    assert first.training["curve"][-1][0] == 512
    assert [len(point) for point in first.training["curve"]] == [5] * 4


@fast
@pytest.mark.slow
def test_an_agent_that_sees_a_picture_sees_nothing_else(tmp_path: Path) -> None:
    pytest.importorskip("jax")
    train("bench:train:easy", 128, settings=replace(SHORT, view=504.0)).save(tmp_path / "agent.npz")
    agent = load_policy(tmp_path / "agent.npz")
    assert agent.settings["observation"] == [Pixels(view=504.0, normalised=True)]
    assert agent.mean.shape == (84 * 84,)
    assert measure(agent, "bench:test:0-2")["ticks"].all()


@fast
@pytest.mark.slow
def test_a_training_that_is_stopped_leaves_what_it_has_learned(tmp_path: Path) -> None:
    pytest.importorskip("jax")
    output = tmp_path / "agent.npz"
    words = ["--level", "00-0-first-steps", "--steps", "330000", "-o", str(output)]
    program = [sys.executable, "-m", "examples.ppo", *words]
    with subprocess.Popen(program, stderr=subprocess.PIPE, cwd=ROOT) as training:
        while not output.exists():
            assert training.poll() is None
            time.sleep(0.2)
        training.send_signal(signal.SIGINT)
        _, errors = training.communicate(timeout=LONGEST)
    assert training.returncode == 130
    assert b"stopped" in errors
    assert load_policy(output).training["curve"]


def test_compiling_is_announced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    callbacks: list[Callable[[], None]] = []
    monkeypatch.setattr(agents, "before_compiling", callbacks)
    monkeypatch.setattr(ppo, "train", lambda *_, **__: [tell() for tell in callbacks])
    result = CliRunner().invoke(main, ["-o", str(tmp_path / "agent.npz")])
    assert "it takes a minute or two" in result.stderr, result.output


def test_an_agent_is_not_replaced(tmp_path: Path) -> None:
    (tmp_path / "agent.npz").touch()
    result = CliRunner().invoke(main, ["-o", str(tmp_path / "agent.npz")])
    assert (result.exit_code, "exists; name another file" in result.output) == (2, True)


@fast
def test_known_runs_are_seen_as_an_agent_would_see_them() -> None:
    seen, actions = known_steps("bench:train:0-2")
    assert seen.shape == (len(actions), *(Observation(OBSERVATION, flat=True).space.shape or ()))
    assert set(actions.tolist()) <= set(range(6))
    assert len(level_source("bench:train:0-2").names) == 3


@fast
@pytest.mark.slow
def test_imitation_learns_to_press_what_the_runs_press() -> None:
    pytest.importorskip("jax")
    agent = imitate("bench:train:0-29", passes=40, hidden=64, batch=64)
    seen, actions = known_steps("bench:train:0-29")
    from examples.agents import normalised

    right = forward(agent.layers, normalised(seen, agent.mean, agent.scale)).argmax(axis=1) == actions
    assert right.mean() > 0.6
