"""Imitation: a network learns to press the keys that the known runs of levels press (behaviour cloning).

    python3 -m examples.imitate --levels bench:train:0-5999 -o imitation.npz

It sees what the agent of examples/ppo.py sees, and never plays while it learns. It needs the extra `train`.
Pomerleau, "ALVINN: an autonomous land vehicle in a neural network", 1989.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from examples.agents import Floats, PolicyAgent, forward, normalised
from examples.ppo import MIN_DEVIATION, OBSERVATION, new_networks
from ninja_game.errors import MissingExtraError, NinjaGameError
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.levels.bench import bench_level
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.observations.observation import Observation
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.inputs import KEYS_DOWN

CHUNK_WORLDS = 500  # levels whose runs are played at once
ACTION_OF = np.zeros(KEYS_DOWN + 1, np.int32)
"""The action of each combination of keys; left and right together are as none."""
ACTION_OF[DISCRETE_KEYS] = np.arange(len(DISCRETE_KEYS))
ACTION_OF[KEYS_DOWN] = ACTION_OF[KEYS_DOWN & ~3]
FRAME_SKIP = 4


def known_steps(levels: str) -> tuple[Floats, NDArray[np.int32]]:
    """What is seen every fourth tick of the known runs of levels "bench:…", and the keys of that tick as actions."""
    names = level_source(levels).names
    seen, actions = [], []
    for first in range(0, len(names), CHUNK_WORLDS):
        found = [
            bench_level(name.split("-")[1], int(name.split("-")[2])) for name in names[first : first + CHUNK_WORLDS]
        ]
        worlds = EnvWorlds([each.level for each in found], len(found), observation=OBSERVATION, flat=True, frame_skip=1)
        keys = np.zeros((max(len(each.inputs) for each in found), len(found)), np.uint8)
        for column, each in enumerate(found):
            keys[: len(each.inputs), column] = np.frombuffer(each.inputs, np.uint8) & KEYS_DOWN
        running = np.ones(len(found), np.bool_)
        for tick, row in enumerate(keys):
            if tick % FRAME_SKIP == 0:
                seen.append(np.asarray(worlds.observations)[running])
                actions.append(ACTION_OF[row[running]])
            worlds.step(row)
            running &= ~worlds.terminated
    return np.concatenate(seen), np.concatenate(actions)


def imitate(levels: str, *, passes: int = 12, seed: int = 0, hidden: int = 128, batch: int = 1024) -> PolicyAgent:
    """An agent that has learned from all known runs of levels. Raises MissingExtraError without JAX and Optax."""
    try:
        import jax
        import jax.numpy as jnp
        import optax
    except ModuleNotFoundError as error:
        raise MissingExtraError("training needs JAX and Optax: python3 -m pip install jax optax") from error
    seen, actions = known_steps(levels)
    mean, scale = seen.mean(axis=0), 1.0 / np.maximum(seen.std(axis=0), np.float32(MIN_DEVIATION))
    seen = normalised(seen, mean, scale)
    rng = np.random.default_rng(seed)
    layers: Any = new_networks(seen.shape[1], hidden, rng)["policy"]
    steps = passes * (len(seen) // batch)
    optimiser = optax.adam(optax.cosine_decay_schedule(1e-3, steps))
    memory = optimiser.init(layers)

    def loss(layers: Any, values: Any, wanted: Any) -> Any:
        scores = forward(layers, values, jnp.tanh)
        return optax.softmax_cross_entropy_with_integer_labels(scores, wanted).mean()

    def update(layers: Any, memory: Any, values: Any, wanted: Any) -> Any:
        changes, memory = optimiser.update(jax.grad(loss)(layers, values, wanted), memory)
        return optax.apply_updates(layers, changes), memory

    update = jax.jit(update)
    for _ in range(passes):
        order = rng.permutation(len(seen))
        for first in range(0, len(seen) - batch + 1, batch):
            rows = order[first : first + batch]
            layers, memory = update(layers, memory, seen[rows], actions[rows])
    layers = jax.tree_util.tree_map(np.asarray, layers)
    settings = {"observation": Observation(OBSERVATION).parts, "flat": True, "frame_skip": FRAME_SKIP}
    training = {"level": levels, "seed": seed, "known_steps": len(seen), "passes": passes}
    return PolicyAgent(layers, mean, np.asarray(scale, np.float32), settings, training)


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.option("--levels", default="bench:train:0-5999", show_default=True, help="Levels of bench:… with known runs.")
@click.option("--passes", type=click.IntRange(1), default=12, show_default=True, help="Over all that is known.")
@click.option("--seed", type=click.IntRange(0, 999), default=0, show_default=True)
@click.option(
    "--output", "-o", default="imitation.npz", show_default=True, type=click.Path(dir_okay=False, path_type=Path)
)
def main(levels: str, passes: int, seed: int, output: Path) -> None:
    if output.exists():
        raise click.UsageError(f"{output} exists; name another file with -o, or remove it")
    try:
        agent = imitate(levels, passes=passes, seed=seed)
        agent.save(output)
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    click.echo(f"{output}: learned from {agent.training['known_steps']:,} steps")


if __name__ == "__main__":
    main()
