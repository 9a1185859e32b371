"""Proximal policy optimisation: the network and its updates, in JAX with Optax (the extra `train`).

Schulman, Wolski, Dhariwal, Radford, Klimov, "Proximal policy optimization algorithms", 2017. The advantages are
those of "High-dimensional continuous control using generalized advantage estimation" (Schulman and others, 2016).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import MissingExtraError
from ninja_game.learn.actions import ACTION_NAMES

Floats = NDArray[np.float32]
Layers: TypeAlias = "list[tuple[Floats, Floats]]"
Networks: TypeAlias = "dict[str, Layers]"
"""``policy``: observations to the scores of the actions; ``value``: to the return that is expected."""


@dataclass(frozen=True)
class PPOSettings:
    """Numbers of the method. ``learning_rate`` and ``entropy`` fall to ``last`` of themselves."""

    hidden: int = 128
    learning_rate: float = 7e-4
    entropy: float = 0.01
    last: float = 0.1
    discount: float = 0.99
    trace: float = 0.95
    clip: float = 0.2
    value_weight: float = 0.1
    largest_gradient: float = 0.5
    passes: int = 2
    batch: int = 4096


@dataclass(frozen=True)
class Samples:
    """What was played, row by row: observations, actions, the logarithms of their chances, advantages, returns."""

    observations: Floats
    actions: NDArray[np.int32]
    chances: Floats
    advantages: Floats
    returns: Floats


def new_networks(inputs: int, hidden: int, rng: np.random.Generator) -> Networks:
    """Two networks with orthogonal weights, small in the policy's last layer: it begins by playing anything."""
    return {
        name: [
            (_orthogonal(inputs, hidden, 2**0.5, rng), np.zeros(hidden, np.float32)),
            (_orthogonal(hidden, hidden, 2**0.5, rng), np.zeros(hidden, np.float32)),
            (_orthogonal(hidden, outputs, gain, rng), np.zeros(outputs, np.float32)),
        ]
        for name, outputs, gain in (("policy", len(ACTION_NAMES), 0.01), ("value", 1, 1.0))
    }


def _orthogonal(rows: int, columns: int, gain: float, rng: np.random.Generator) -> Floats:
    square, _ = np.linalg.qr(rng.standard_normal((max(rows, columns), min(rows, columns))))
    return np.asarray(gain * (square if rows >= columns else square.T), np.float32)


def advantages(rewards: Floats, values: Floats, ended: NDArray[np.bool_], settings: PPOSettings) -> Floats:
    """By how much each step did better than expected, (steps, worlds).

    ``values``: what was expected, (steps + 1, worlds); nothing is expected behind a step that ``ended`` an episode.
    """
    result = np.zeros_like(rewards)
    ahead = np.zeros(rewards.shape[1], np.float32)
    for step in reversed(range(len(rewards))):
        goes_on = ~ended[step]
        error = rewards[step] + settings.discount * values[step + 1] * goes_on - values[step]
        ahead = error + settings.discount * settings.trace * goes_on * ahead
        result[step] = ahead
    return result


class Learner:
    """Networks that are improved. Raises MissingExtraError without JAX and Optax."""

    def __init__(self, inputs: int, settings: PPOSettings, seed: int) -> None:
        self.settings = settings
        self._rng = np.random.default_rng([seed, 1])
        self.networks = new_networks(inputs, settings.hidden, self._rng)
        self._play, self._update, self._memory = _compiled(self.networks, settings)

    def play(self, observations: Floats) -> tuple[Floats, Floats]:
        """Logarithms of the chances of the actions, (n, 6), and the returns that are expected, (n,)."""
        scores, values = self._play(self.networks, observations)
        return np.asarray(scores), np.asarray(values)

    def learn(self, samples: Samples, progress: float) -> None:
        """Improve the networks by some passes over the samples; ``progress``: the part of the training that is over."""
        import jax

        settings = self.settings
        share = np.float32(1.0 - (1.0 - settings.last) * min(progress, 1.0))
        count = len(samples.actions)
        size = min(settings.batch, count)
        networks: Any = self.networks
        for _ in range(settings.passes):
            order = self._rng.permutation(count)
            for first in range(0, count - size + 1, size):
                rows = order[first : first + size]
                batch = [column[rows] for column in vars(samples).values()]
                networks, self._memory = self._update(networks, self._memory, share, *batch)
        self.networks = jax.tree_util.tree_map(np.asarray, networks)


def _compiled(networks: Networks, settings: PPOSettings) -> tuple[Callable[..., Any], Callable[..., Any], Any]:
    """``Learner.play`` of networks, and (networks, memory, share, batch) -> (networks, memory): one step of Adam.

    With the memory that it begins with.
    """
    try:
        import jax
        import jax.numpy as jnp
        import optax
    except ModuleNotFoundError as error:
        raise MissingExtraError("training needs JAX and Optax, the extra `train` (docs/learning.md)") from error

    def network(layers: Any, values: Any) -> Any:
        for weights, biases in layers[:-1]:
            values = jnp.tanh(values @ weights + biases)
        weights, biases = layers[-1]
        return values @ weights + biases

    def play(nets: Any, observations: Any) -> Any:
        scores = jax.nn.log_softmax(network(nets["policy"], observations))
        return scores, network(nets["value"], observations)[:, 0]

    def loss(nets: Any, share: Any, observations: Any, actions: Any, chances: Any, gains: Any, returns: Any) -> Any:
        scores, values = play(nets, observations)
        ratio = jnp.exp(jnp.take_along_axis(scores, actions[:, None], 1)[:, 0] - chances)
        near = jnp.clip(ratio, 1 - settings.clip, 1 + settings.clip)
        gain = jnp.minimum(ratio * gains, near * gains).mean()
        error = ((values - returns) ** 2).mean()
        entropy = -(jnp.exp(scores) * scores).sum(1).mean()
        return settings.value_weight * error - gain - settings.entropy * share * entropy

    optimiser = optax.chain(optax.clip_by_global_norm(settings.largest_gradient), optax.scale_by_adam(eps=1e-5))

    def update(nets: Any, memory: Any, share: Any, *batch: Any) -> Any:
        gradients = jax.grad(loss)(nets, share, *batch)
        changes, memory = optimiser.update(gradients, memory)
        rate = -settings.learning_rate * share
        return optax.apply_updates(nets, jax.tree_util.tree_map(lambda change: rate * change, changes)), memory

    return jax.jit(play), jax.jit(update), optimiser.init(networks)
