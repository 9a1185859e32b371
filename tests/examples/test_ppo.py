"""The method by itself: advantages by their definition, and a network that learns what pays."""

from __future__ import annotations

import numpy as np
import pytest

from examples.agents import forward
from examples.ppo import Learner, Method, Samples, advantages, new_networks


def test_advantages_are_discounted_sums_of_what_was_better_than_expected() -> None:
    rng = np.random.default_rng(1)
    rewards = rng.random((6, 2)).astype(np.float32)
    values = rng.random((7, 2)).astype(np.float32)
    ended = np.zeros((6, 2), np.bool_)
    ended[3, 1] = True
    method = Method(discount=0.9, trace=0.8)
    found = advantages(rewards, values, ended, method)
    for world in range(2):
        for step in range(6):
            expected, factor = 0.0, 1.0
            for k in range(step, 6):
                over = ended[k, world]
                follows = 0.0 if over else 0.9 * values[k + 1, world]
                expected += factor * (rewards[k, world] + follows - values[k, world])
                factor *= 0.9 * 0.8
                if over:
                    break
            assert found[step, world] == pytest.approx(expected, abs=1e-5)


def test_new_networks_expect_nothing_and_prefer_nothing() -> None:
    networks = new_networks(10, 16, np.random.default_rng(0))
    seen = np.random.default_rng(1).standard_normal((50, 10)).astype(np.float32)
    assert np.ptp(forward(networks["policy"], seen)) < 0.2
    assert [weights.shape for weights, _ in networks["value"]] == [(10, 16), (16, 16), (16, 1)]


@pytest.mark.slow
def test_the_policy_learns_which_action_pays_by_what_it_sees() -> None:
    pytest.importorskip("jax")
    learner = Learner(2, Method(hidden=16, batch=256, learning_rate=0.01), seed=1)
    rng = np.random.default_rng(2)
    for _ in range(40):
        seen = rng.choice([-1.0, 1.0], (512, 2)).astype(np.float32)
        scores, values = learner.play(seen)
        actions = (scores + rng.gumbel(size=scores.shape)).argmax(axis=1).astype(np.int32)
        # Where the first number is positive action 5 pays, else action 0.
        rewards = (actions == np.where(seen[:, 0] > 0, 5, 0)).astype(np.float32)
        chances = np.take_along_axis(scores, actions[:, np.newaxis], axis=1)[:, 0]
        learner.learn(Samples(seen, actions, chances, rewards - values, rewards), 0.0)
    seen = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]], np.float32)
    assert forward(learner.networks["policy"], seen).argmax(axis=1).tolist() == [5, 5, 0, 0]
    assert np.allclose(learner.play(seen)[1], 1.0, atol=0.2)
