"""Proximal policy optimisation on levels without end, in one file: what an agent sees of a level, and nothing more.

    python3 -m examples.ppo --steps 10000000 --seed 0 -o agent.npz
    python3 -m examples.ppo --level 00-0-first-steps --watch "" --steps 1000000 -o first.npz
    python3 -m examples.ppo --pixels --steps 1000000 -o pixels.npz

It learns in the environment that it is measured in, but for the time limit of an episode, 800 ticks instead of 2,000;
with no demonstrations and without the solver's field. To the reward it adds a share of the straight way to the switch
and then to the exit, which the observation tells. The same seed makes the same agent. What it has learned so far is
always in the output file, so that it may be stopped at any time (Ctrl-C). It needs the extra `train`; the agent in the
file needs NumPy alone.

Schulman, Wolski, Dhariwal, Radford, Klimov, "Proximal policy optimization algorithms", 2017; advantages by Schulman and
others, "High-dimensional continuous control using generalized advantage estimation", 2016.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, TypeAlias

import click
import gymnasium
import numpy as np
from numpy.typing import NDArray

from examples.agents import Floats, PolicyAgent, forward, normalised, tell_compiling
from examples.measure import BENCH, measure
from ninja_game.errors import MissingExtraError, NinjaGameError
from ninja_game.learn.actions import ACTION_NAMES
from ninja_game.learn.observations.objects import OBSERVED_KINDS, NearObjects
from ninja_game.learn.observations.part import Part
from ninja_game.learn.observations.pixels import Pixels
from ninja_game.learn.observations.surroundings import LocalTiles, Rays
from ninja_game.learn.observations.vectors import FIELDS, StateVector
from ninja_game.sim.states import OUTCOME_EXIT

Layers: TypeAlias = "list[tuple[Floats, Floats]]"
Networks: TypeAlias = "dict[str, Layers]"
"""``policy``: observations to the scores of the actions; ``value``: to the return that is expected."""

SEEN_KINDS = tuple(kind for kind in OBSERVED_KINDS if kind not in {"gold", "exit", "switch"})
OBSERVATION: tuple[Part, ...] = (StateVector(), LocalTiles(9), Rays(16), NearObjects(8, kinds=SEEN_KINDS))
"""Exit and switch are in the state vector; gold is nothing to this agent."""
SQUARES = ((6, 1, 16), (2, 16, 32))
"""Of a network that sees a picture: pixels across a square, channels, features of each of the first layers."""
MIN_DEVIATION = 0.02  # of an observation; what hardly ever changes would be blown up otherwise
LEARNED_IN = "bench:train:easy:0-98999"  # all easy levels to learn in but those of `bench:val`
POINTS = 20  # of the curve
OPEN, EXIT_X, EXIT_Y, SWITCH_X, SWITCH_Y = map(
    list(FIELDS).index, ("exit_open", "exit_dx", "exit_dy", "switch_dx", "switch_dy")
)


@dataclass(frozen=True)
class Settings:
    """Numbers of the method. ``learning_rate`` and ``entropy`` fall to ``last`` of themselves over the training.

    ``worlds`` play ``round`` steps between two improvements, each of ``passes`` over them. ``exit``, ``way``: what the
    exit and the way to it are worth; ``time_limit``: ticks of an episode in training. ``view``: the policy sees a
    picture, this many px wide, around the ninja, and nothing else; 0: the numbers that the value is estimated from.
    """

    hidden: int = 128
    learning_rate: float = 1e-3
    entropy: float = 0.01
    last: float = 0.1
    discount: float = 0.99
    trace: float = 0.95
    clip: float = 0.2
    value_weight: float = 0.1
    largest_gradient: float = 0.5
    passes: int = 3
    batch: int = 4096
    worlds: int = 512
    round: int = 32
    exit: float = 10.0
    way: float = 5.0
    time_limit: int = 800
    view: float = 0.0


PIXELS = Settings(view=504.0, learning_rate=5e-4, batch=1024, worlds=128)


class Player:
    """``count`` worlds in which an agent plays, and what training pays it; ``more``: arguments of the environment.

    ``observed``: what they show now, (count, n); ``begins``: whose next step only begins an episode.
    """

    def __init__(self, level: Any, count: int, settings: Settings, **more: Any) -> None:
        self.settings, self.count = settings, count
        self.pictures = [Pixels(view=settings.view, normalised=True)] if settings.view else []
        self.made_for: dict[str, Any] = {"observation": self.pictures or [*OBSERVATION], "flat": True, "frame_skip": 4}
        how = {**self.made_for, "level": level, "time_limit": settings.time_limit, "copy": False, **more}
        how["observation"] = [*OBSERVATION, *self.pictures]
        self.envs = gymnasium.make_vec(BENCH, num_envs=count, **how)
        self.episodes: list[NDArray[np.bool_]] = []

    def begin(self, seed: int) -> None:
        """Begin, world i with the seed ``seed`` + i."""
        self.observed: Floats = self.envs.reset(seed=seed)[0]
        self.begins = np.zeros(self.count, np.bool_)
        self._whole = way_left(self.observed)

    def step(self, actions: NDArray[Any]) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_]]:
        """Play one step: the rewards, which episodes terminated, and which ended so or by the time."""
        before = np.maximum(1.0 - way_left(self.observed) / self._whole, -1.0)
        self.observed, paid, terminated, truncated, infos = self.envs.step(actions)
        left = way_left(self.observed)
        begun = self.begins
        self._whole = np.where(begun, left, self._whole)
        after = np.where(terminated, 0.0, np.maximum(1.0 - left / self._whole, -1.0))
        settings = self.settings
        rewards = settings.exit * paid + settings.way * (settings.discount * after - before) * ~begun
        self.begins = terminated | truncated
        if self.begins.any():
            self.episodes.append(infos["outcome"][self.begins] == OUTCOME_EXIT)
        return rewards.astype(np.float32), terminated, self.begins


class Trainer:
    """Worlds that play, and networks that learn from them. Raises MissingExtraError without JAX and Optax."""

    def __init__(self, level: Any, steps: int, seed: int, settings: Settings) -> None:
        self.settings, self.seed, self.steps_planned, self.steps = settings, seed, steps, 0
        self.player = Player(level, settings.worlds, settings)
        self.player.begin(seed * settings.worlds)
        self._rng = np.random.default_rng([seed, 1])
        inputs, pixels = self.player.observed.shape[1], sum(part.length for part in self.player.pictures)
        self._sight = slice(inputs - pixels if pixels else 0, inputs)
        self.networks = new_networks(inputs - pixels, settings.hidden, self._rng, pixels)
        self._play, self._update, self._memory = compiled(self.networks, settings, self._sight, inputs - pixels)
        self._mean, self._scale = random_play(self._rng, self.player.step, lambda: self.player.observed, settings)

    def agent(self, training: dict[str, Any]) -> PolicyAgent:
        mean, scale = self._mean[self._sight], self._scale[self._sight]
        return PolicyAgent(self.networks["policy"], mean, scale, self.player.made_for, training)

    def improve(self) -> None:
        """Play a round and learn from it."""
        settings = self.settings
        shape = settings.round, settings.worlds
        seen = np.zeros((*shape, len(self._mean)), np.float32)
        actions = np.zeros(shape, np.int32)
        chances, rewards = np.zeros((2, *shape), np.float32)
        values = np.zeros((settings.round + 1, settings.worlds), np.float32)
        ended, terminated, counts = np.zeros((3, *shape), np.bool_)
        for step in range(settings.round):
            seen[step] = self._seen()
            scores, values[step] = map(np.asarray, self._play(self.networks, seen[step]))
            actions[step] = (scores + self._rng.gumbel(size=scores.shape)).argmax(axis=1)
            chances[step] = np.take_along_axis(scores, actions[step][:, np.newaxis], axis=1)[:, 0]
            # The step after an episode's last one only begins the next one: nothing is learnt from it.
            counts[step] = ~self.player.begins
            rewards[step], terminated[step], ended[step] = self.player.step(actions[step])
        values[-1] = np.asarray(self._play(self.networks, self._seen())[1])
        gains = advantages(rewards, values, terminated, ended, settings)
        returns = gains + values[:-1]
        columns = [seen, actions, chances, (gains - gains[counts].mean()) / (gains[counts].std() + 1e-8), returns]
        self.steps += actions.size
        self._learn([column[counts] for column in columns])

    def _learn(self, samples: list[NDArray[Any]]) -> None:
        """Improve the networks by some passes over the samples."""
        import jax

        settings = self.settings
        share = np.float32(1.0 - (1.0 - settings.last) * min(self.steps / self.steps_planned, 1.0))
        count = len(samples[0])
        size = min(settings.batch, settings.worlds * settings.round // 2)
        networks: Any = self.networks
        for _ in range(settings.passes):
            order = self._rng.permutation(count)
            for first in range(0, count - size + 1, size):
                rows = order[first : first + size]
                networks, self._memory = self._update(networks, self._memory, share, *(part[rows] for part in samples))
        self.networks = jax.tree_util.tree_map(np.asarray, networks)

    def _seen(self) -> Floats:
        return normalised(self.player.observed, self._mean, self._scale)


def random_play(
    rng: np.random.Generator, step: Callable[[NDArray[Any]], object], observed: Callable[[], Floats], settings: Settings
) -> tuple[Floats, Floats]:
    """Means of the observations (…, worlds, n), and what makes their deviations 1, (…, n): from random play."""
    rows = []
    action = rng.integers(len(ACTION_NAMES), size=observed().shape[:-1])
    for _ in range(2 * settings.round):
        drawn = rng.integers(len(ACTION_NAMES), size=action.shape)
        action = np.where(rng.random(action.shape) < 0.8, action, drawn)
        step(action)
        rows.append(observed().copy())
    every = np.concatenate(rows, axis=-2)
    return every.mean(axis=-2), 1.0 / np.maximum(every.std(axis=-2), np.float32(MIN_DEVIATION))


def way_left(observed: Floats) -> Floats:
    """The straight way to the exit, by its switch while it is closed, (n,); the unit is the world's width."""
    exit_x, exit_y, x, y = (observed[:, k] for k in (EXIT_X, EXIT_Y, SWITCH_X, SWITCH_Y))
    is_open = observed[:, OPEN] > 0.0
    way = np.where(is_open, np.hypot(exit_x, exit_y), np.hypot(x, y) + np.hypot(exit_x - x, exit_y - y))
    return np.maximum(way, np.float32(0.01))


def advantages(
    rewards: Any, values: Any, terminated: Any, ended: Any, settings: Settings, stack: Callable[..., Any] = np.stack
) -> Any:
    """By how much each step did better than expected, (steps, worlds).

    ``values``: what was expected, (steps + 1, worlds). Nothing is expected behind a step that ``terminated``; where the
    time was over, what the last observation promises. ``stack``: NumPy's, or JAX's for arrays of JAX.
    """
    found: list[Any] = []
    ahead = 0.0 * rewards[0]
    for step in reversed(range(len(rewards))):
        error = rewards[step] + settings.discount * values[step + 1] * ~terminated[step] - values[step]
        ahead = error + settings.discount * settings.trace * ~ended[step] * ahead
        found.append(ahead)
    return stack(found[::-1]).astype(np.float32)


def new_networks(inputs: int, hidden: int, rng: np.random.Generator, pixels: int = 0) -> Networks:
    """Two networks with orthogonal weights, small in the policy's last layer: it begins by playing anything.

    ``pixels``: of the square picture that the policy sees instead of the ``inputs``.
    """
    eyes: Layers = []
    for side, channels, features in SQUARES if pixels else ():
        weights = _orthogonal(side * side * channels, features, 2**0.5, rng)
        eyes.append((weights.reshape(side, side, channels, features), np.zeros(features, np.float32)))
        pixels = pixels // (side * side * channels) * features
    return {
        name: [
            *(eyes if name == "policy" else ()),
            (
                _orthogonal(pixels if name == "policy" and eyes else inputs, hidden, 2**0.5, rng),
                np.zeros(hidden, np.float32),
            ),
            (_orthogonal(hidden, hidden, 2**0.5, rng), np.zeros(hidden, np.float32)),
            (_orthogonal(hidden, outputs, gain, rng), np.zeros(outputs, np.float32)),
        ]
        for name, outputs, gain in (("policy", len(ACTION_NAMES), 0.01), ("value", 1, 1.0))
    }


def _orthogonal(rows: int, columns: int, gain: float, rng: np.random.Generator) -> Floats:
    square, _ = np.linalg.qr(rng.standard_normal((max(rows, columns), min(rows, columns))))
    return np.asarray(gain * (square if rows >= columns else square.T), np.float32)


def compiled(
    networks: Networks, settings: Settings, sight: slice, numbers: int
) -> tuple[Callable[..., Any], Callable[..., Any], Any]:
    """What plays, (networks, observations) -> (logarithms of the chances, values); what learns; the optimiser's memory.

    That is (networks, memory, share, batch) -> (networks, memory), one step of Adam. ``sight``: the columns that the
    policy sees; the value is estimated from the first ``numbers``.
    """
    try:
        import jax
        import jax.numpy as jnp
        import optax
    except ModuleNotFoundError as error:
        raise MissingExtraError("training needs JAX and Optax: python3 -m pip install jax optax") from error

    def play(nets: Any, observations: Any) -> Any:
        scores = jax.nn.log_softmax(forward(nets["policy"], observations[:, sight], jnp.tanh))
        return scores, forward(nets["value"], observations[:, :numbers], jnp.tanh)[:, 0]

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


def train(
    level: Any, steps: int, seed: int = 0, *, watch: str = "", settings: Settings = Settings(),
    report: Callable[[PolicyAgent], object] = bool,
) -> PolicyAgent:  # fmt: skip
    """Train an agent; ``report`` is given it at each point of the curve, the last one too.

    Its ``training`` tells ``level``, ``seed``, ``settings``, and of each point of the ``curve`` steps, seconds by the
    clock and of the processor, the share of its training episodes since the point before that passed, and that of the
    levels ``watch``, which it does not learn in (NaN without). Raises MissingExtraError without JAX and Optax.
    """
    trainer = Trainer(level, steps, seed, settings)
    curve: list[list[float]] = []
    began, used = time.monotonic(), time.process_time()
    about = {"level": str(level), "seed": seed, "settings": asdict(settings), "watch": watch, "curve": curve}
    while True:
        trainer.improve()
        if trainer.steps * POINTS < steps * (len(curve) + 1) and trainer.steps < steps:
            continue
        times = [round(time.monotonic() - began, 1), round(time.process_time() - used, 1)]
        episodes = np.concatenate(trainer.player.episodes or [np.zeros(1, np.bool_)])
        trainer.player.episodes.clear()
        agent = trainer.agent(about)
        seen = measure(agent, watch)["passed"].mean() if watch else float("nan")
        curve.append([trainer.steps, *times, round(float(episodes.mean()), 4), round(float(seen), 4)])
        report(agent)
        if trainer.steps >= steps:
            return agent


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.option("--level", default=LEARNED_IN, show_default=True, help="As of an environment: where it learns.")
@click.option(
    "--watch", default="bench:val:easy:0-299", show_default=True, metavar="LEVELS",
    help="Levels that the curve tells too; '': none.",
)  # fmt: skip
@click.option("--steps", type=click.IntRange(1), default=10_000_000, show_default=True, help="Of all worlds together.")
@click.option("--seed", type=click.IntRange(0, 999), default=0, show_default=True)
@click.option("--pixels", is_flag=True, help="See a picture, 84 x 84, and nothing else; some twenty times as slow.")
@click.option("--output", "-o", default="agent.npz", show_default=True, type=click.Path(dir_okay=False, path_type=Path))
def main(level: str, watch: str, steps: int, seed: int, pixels: bool, output: Path) -> None:
    if output.exists():
        raise click.UsageError(f"{output} exists; name another file with -o, or remove it")

    def report(agent: PolicyAgent) -> None:
        agent.save(output)
        done, seconds, _, passed, seen = agent.training["curve"][-1]
        others = f", {seen:.1%} of {watch}" if watch else ""
        click.echo(f"{done:,} steps, {seconds:.0f} s: {passed:.1%} of the episodes passed{others}", err=True)

    tell_compiling()
    try:
        train(level, steps, seed, watch=watch, settings=PIXELS if pixels else Settings(), report=report)
    except KeyboardInterrupt:
        click.echo("stopped", err=True)
        sys.exit(130)
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    click.echo(f"{output}: an agent, after {steps:,} steps")


if __name__ == "__main__":
    main()
