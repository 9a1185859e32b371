"""The training of examples/ppo.py for several seeds at once: all networks on a GPU, the worlds in processes.

    python3 -m examples.ppo_seeds --count 10 --steps 100000000 -o runs

Where one training leaves a GPU waiting, ten do not: each step is one call for the networks of all seeds. All levels are
made once, before the first step (a minute and 4 GB for `bench:train:easy`), since making them would take longer than
playing. What is learned from what is that of examples/ppo.py, with the same settings; only what is drawn differs.
Several such commands side by side, of some seeds each, keep the processor busy while one of them waits for the GPU.

FOLDER gets an agent of each seed at each point of the curve: `ppo-SEED-POINT.npz`. It needs the extra `train`, and a
system that copies processes (Linux). On a processor alone it is slower than one examples/ppo.py after the other.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import time
from dataclasses import asdict
from functools import partial
from math import prod
from mmap import mmap
from multiprocessing import get_all_start_methods, get_context
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from examples.agents import MAX_OBSERVED, PolicyAgent
from examples.ppo import LEARNED_IN, POINTS, Networks, Player, Settings, advantages, compiled, new_networks, random_play
from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.levels.source import LevelSource

PATIENCE = 60.0  # seconds without a sign of the others after which a process ends
EPISODES, PASSED, SECONDS = range(3)  # what is counted of each process


def shared(shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
    """An array of zeros that processes made from this one share."""
    return np.frombuffer(mmap(-1, prod(shape) * np.dtype(kind).itemsize), kind).reshape(shape)


class Crew:
    """Processes that play the worlds of some seeds, ``each`` for one seed.

    What they see and earn lies in memory that all share: ``observed`` (seeds, worlds, n), ``actions`` (seeds, worlds);
    of each step of a round ``rewards``, ``terminated``, ``ended``, ``counts`` (round, seeds, worlds), as ``Player`` has
    them; ``counted`` (seeds, each, 3): EPISODES, PASSED, SECONDS of the processor.
    """

    def __init__(self, level: Any, seeds: list[int], settings: Settings, each: int) -> None:
        if settings.worlds % each or "fork" not in get_all_start_methods():
            raise ArgumentError(f"found {each} processes for {settings.worlds} worlds; expected a divisor, and Linux")
        source = level_source(level)
        held = LevelSource(source.names, list(source.levels))
        self._player = Player(held, settings.worlds // each, settings, threads=1)
        self.made_for = self._player.made_for
        shape = len(seeds), settings.worlds
        inputs = self._player.envs.single_observation_space.shape or ()
        self.observed = shared((*shape, *inputs), np.float32)
        self.actions = shared(shape, np.int32)
        self.rewards = shared((settings.round, *shape), np.float32)
        self.terminated, self.ended, self.counts = (shared(self.rewards.shape, np.bool_) for _ in range(3))
        self.counted = shared((len(seeds), each, 3), np.float64)
        # What the processes share stays shared: a collector that looks at it would copy it.
        gc.freeze()
        context = get_context("fork")
        self._turns = []
        for row, seed in enumerate(seeds):
            for part in range(each):
                turn = context.Semaphore(0), context.Semaphore(0)
                work = partial(self._work, row, seed * settings.worlds, part, *turn)
                process = context.Process(target=work, daemon=True)
                process.start()
                self._turns.append((*turn, process))
        self._wait()

    def step(self, actions: NDArray[Any]) -> None:
        """Play these."""
        self.actions[:] = actions
        for go, _, _ in self._turns:
            go.release()
        self._wait()

    def _wait(self) -> None:
        for _, done, process in self._turns:
            while not done.acquire(timeout=PATIENCE):
                if not process.is_alive():
                    raise RuntimeError("a process that plays worlds has ended")

    def _work(self, row: int, seed: int, part: int, go: Any, done: Any) -> None:
        """Play a part of a seed's worlds, as long as the process lives that this one was made from."""
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        player, parent = self._player, os.getppid()
        mine = row, slice(part * player.count, (part + 1) * player.count)
        player.begin(seed + part * player.count)
        step = 0
        while os.getppid() == parent:
            self.observed[mine] = player.observed
            self.counted[row, part, SECONDS] = time.process_time()
            for passed in player.episodes:
                self.counted[row, part, : PASSED + 1] += len(passed), passed.sum()
            player.episodes.clear()
            done.release()
            while not go.acquire(timeout=PATIENCE):
                if os.getppid() != parent:
                    return
            here = (step, *mine)
            self.counts[here] = ~player.begins
            self.rewards[here], self.terminated[here], self.ended[here] = player.step(self.actions[mine])
            step = (step + 1) % len(self.rewards)


class SeedsTrainer:
    """What ``examples.ppo.Trainer`` is, for several seeds: every array of its networks has one more axis, the seeds."""

    def __init__(self, level: Any, steps: int, seeds: list[int], settings: Settings, each: int) -> None:
        self.settings, self.seeds, self.steps_planned, self.steps = settings, seeds, steps, 0
        self.crew = crew = Crew(level, seeds, settings, each)
        rngs = [np.random.default_rng([seed, 1]) for seed in seeds]
        inputs = crew.observed.shape[-1]
        networks = [new_networks(inputs, settings.hidden, rng) for rng in rngs]
        # Not before: a process with JAX's threads cannot be copied.
        self._act, self._learn, memory = compiled_seeds(networks[0], settings, inputs)
        import jax

        self.networks, self._memory = (
            jax.tree_util.tree_map(lambda *parts: np.stack(parts), *every)
            for every in (networks, [memory] * len(seeds))
        )
        self._norms = random_play(rngs[0], crew.step, lambda: crew.observed, settings)
        self._keys = jax.vmap(jax.random.key)(np.array(seeds))
        self._put = partial(jax.device_put, may_alias=False)
        self._seen = self._put(crew.observed)

    def improve(self) -> None:
        """Play a round and learn from it."""
        settings, crew = self.settings, self.crew
        seen, actions = [self._seen], []
        first = self.steps // settings.worlds
        for step in range(settings.round):
            actions.append(self._act(self.networks, self._norms, self._keys, seen[-1], first + step))
            # Waits for the GPU, so that the worlds write nothing that it still reads.
            crew.step(np.asarray(actions[-1]))
            seen.append(self._put(crew.observed))
        self._seen = seen[-1]
        self.steps += settings.round * settings.worlds
        share = np.float32(1.0 - (1.0 - settings.last) * min(self.steps / self.steps_planned, 1.0))
        played = crew.rewards, crew.terminated, crew.ended, crew.counts
        self.networks, self._memory = self._learn(
            self.networks, self._memory, self._norms, self._keys, seen, actions, played, first, share
        )

    def agents(self, training: list[dict[str, Any]]) -> list[PolicyAgent]:
        """The agent of each seed, with the log of its training."""
        layers = [[np.asarray(part) for part in layer] for layer in self.networks["policy"]]
        return [
            PolicyAgent([(w[row], b[row]) for w, b in layers], mean, scale, self.crew.made_for, logged)
            for row, (mean, scale, logged) in enumerate(zip(*self._norms, training, strict=True))
        ]


def compiled_seeds(networks: Networks, settings: Settings, inputs: int) -> tuple[Any, Any, Any]:
    """What plays a step, what learns from a round, for networks of several seeds; the optimiser's memory of one.

    (networks, norms, keys, observed, number of the step) -> actions (seeds, worlds); (networks, memory, norms, keys,
    observed of each step and after the last, actions of each step, what the crew noted, number of the first step,
    share) -> (networks, memory).
    """
    play, update, memory = compiled(networks, settings, slice(0, inputs), inputs)
    import jax
    import jax.numpy as jnp

    # Products of 32 bits, as on a processor.
    jax.config.update("jax_default_matmul_precision", "highest")
    size = min(settings.batch, settings.worlds * settings.round // 2)
    # The few steps that only begin an episode come last, and so in no batch.
    batches = (settings.worlds * settings.round - 1) // size

    def seen_by(observed: Any, norms: Any) -> Any:
        return jnp.clip((observed - norms[0]) * norms[1], -MAX_OBSERVED, MAX_OBSERVED)

    def act(nets: Any, norms: Any, key: Any, observed: Any, number: Any) -> Any:
        scores, _ = play(nets, seen_by(observed, norms))
        return jax.random.categorical(jax.random.fold_in(key, number), scores)

    def learn(
        nets: Any, memory: Any, norms: Any, key: Any, observed: Any, actions: Any, played: Any, first: Any, share: Any
    ) -> Any:
        rewards, terminated, ended, counts = played
        seen, chosen = seen_by(jnp.stack(observed), norms), jnp.stack(actions)
        scores, values = (output.reshape(*seen.shape[:2], -1) for output in play(nets, seen.reshape(-1, inputs)))
        chances = jnp.take_along_axis(scores[:-1], chosen[:, :, None], 2)[:, :, 0]
        gains = advantages(rewards, values[:, :, 0], terminated, ended, settings, jnp.stack)
        fair = (gains - gains.mean(where=counts)) / (gains.std(where=counts) + 1e-8)
        parts = seen[:-1], chosen, chances, fair, gains + values[:-1, :, 0]
        columns = [part.reshape(counts.size, *part.shape[2:]) for part in parts]

        def one_batch(state: Any, rows: Any) -> Any:
            return update(*state, share, *(column[rows] for column in columns)), None

        def one_pass(state: Any, key: Any) -> Any:
            order = jnp.argsort(jnp.where(counts.ravel(), jax.random.uniform(key, (counts.size,)), 2.0))
            return jax.lax.scan(one_batch, state, order[: batches * size].reshape(batches, size))

        keys = jax.random.split(jax.random.fold_in(key, -1 - first), settings.passes)
        return jax.lax.scan(one_pass, (nets, memory), keys)[0]

    every = jax.vmap(learn, in_axes=(0, 0, 0, 0, 0, 0, 1, None, None))
    return jax.jit(jax.vmap(act, in_axes=(0, 0, 0, 0, None))), jax.jit(every), memory


def train(level: Any, steps: int, seeds: list[int], each: int, folder: Path, settings: Settings) -> None:
    """Train an agent of each seed; at each point of the curve write all of them, with the curve so far.

    A point of the curve is as of ``examples.ppo.train``, without levels that are watched; seconds of this process's
    processor are shared among the seeds. Raises MissingExtraError without JAX and Optax, ArgumentError for a number of
    processes that does not fit, OSError for files that cannot be written.
    """
    trainer = SeedsTrainer(level, steps, seeds, settings, each)
    logs: list[dict[str, Any]] = [
        {"level": str(level), "seed": seed, "settings": asdict(settings), "watch": "", "curve": []} for seed in seeds
    ]
    began, used, before = time.monotonic(), time.process_time(), trainer.crew.counted.sum(axis=1)
    while trainer.steps < steps:
        trainer.improve()
        point = len(logs[0]["curve"]) + 1
        if trainer.steps * POINTS < steps * point and trainer.steps < steps:
            continue
        agents, since = trainer.agents(logs), trainer.crew.counted.sum(axis=1)
        clock, own = time.monotonic() - began, (time.process_time() - used) / len(seeds)
        for about, (episodes, passed, _), row in zip(logs, since - before, since, strict=True):
            share = passed / max(episodes, 1)
            about["curve"].append(
                [trainer.steps, round(clock, 1), round(own + row[SECONDS], 1), round(share, 4), float("nan")]
            )
        before = since
        for agent, seed in zip(agents, seeds, strict=True):
            agent.save(folder / f"ppo-{seed}-{point:02}.npz")
        shares = " ".join(f"{about['curve'][-1][3]:.1%}" for about in logs)
        click.echo(f"{trainer.steps:,} steps, {clock:.0f} s: {shares} of the episodes passed", err=True)


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.option("--level", default=LEARNED_IN, show_default=True, help="As of an environment: where they learn.")
@click.option("--steps", type=click.IntRange(1), default=100_000_000, show_default=True, help="Of each seed.")
@click.option("--first", type=click.IntRange(0, 999), default=0, show_default=True, help="Seed.")
@click.option("--count", type=click.IntRange(1, 100), default=10, show_default=True, help="Seeds.")
@click.option(
    "--each", type=click.IntRange(1), default=2, show_default=True, help="Processes for the worlds of a seed."
)
@click.option("--output", "-o", required=True, metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path))
def main(level: str, steps: int, first: int, count: int, each: int, output: Path) -> None:
    if output.exists():
        raise click.UsageError(f"{output} exists; name another folder with -o, or remove it")
    output.mkdir(parents=True)
    try:
        train(level, steps, list(range(first, first + count)), each, output, Settings())
    except KeyboardInterrupt:
        click.echo("stopped", err=True)
        sys.exit(130)
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error


if __name__ == "__main__":
    main()
