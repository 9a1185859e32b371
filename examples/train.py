"""Train an agent by proximal policy optimisation: a thousand worlds play, the networks learn from the results.

    python3 -m examples.train --levels 00-0-first-steps --seconds 240
    python3 -m examples.train --levels train --seconds 1800 -o everything.npz

The best agent so far is always in the output file, so that training may be stopped at any time (Ctrl-C). It needs the
extra `train`. docs/learning.md says how `examples/agent.npz` was trained.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from examples.agents import PolicyAgent, normalised
from examples.ppo import Floats, Learner, PPOSettings, Samples, advantages
from examples.starts import Starts
from ninja_game.errors import NinjaGameError
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.levels import LevelSource, level_source
from ninja_game.learn.observations.objects import OBSERVED_KINDS, NearObjects
from ninja_game.learn.observations.observation import Observation
from ninja_game.learn.observations.part import Part
from ninja_game.learn.observations.surroundings import LocalTiles, Rays
from ninja_game.learn.observations.vectors import Guide, StateVector
from ninja_game.learn.protocol import LONGEST_WAIT, REPEAT
from ninja_game.learn.rewards import DistanceShaping, ExitReward
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.states import OUTCOME_EXIT

ROUND = 32
"""Steps of each world between two improvements."""
STEPS_PER_SECOND = 25_000
"""Steps of all worlds together that are planned for a second, never measured: plans do not depend on the clock."""
SMALLEST_DEVIATION = 0.02
"""Of an observation; what hardly ever changes would be blown up otherwise."""
JUDGED_EVERY = 16
"""Rounds between two points of the curve; only there an agent may be the best."""

LEVELS = (
    "00-0-first-steps", "00-1-mind-the-gap", "00-3-rolling-hills", "01-1-seven-league-boots", "00-2-the-chimney",
    "10-2-fountain", "10-4-the-juggler", "11-2-kennel", "12-1-four-winds", "20-0-kite", "20-1-phases-of-the-moon",
    "31-1-downhill",
)  # fmt: skip
"""Those of examples/agent.npz: easy ones of several columns."""

OBSERVATION = (
    StateVector(),
    LocalTiles(9),
    Rays(16),
    NearObjects(6, kinds=tuple(kind for kind in OBSERVED_KINDS if kind not in {"gold", "exit", "switch"})),
    Guide(),
)
"""What an agent sees if nothing else is said. Exit and switch are in the state vector; gold is nothing to it."""


@dataclass(frozen=True)
class Task:
    """What to learn: the levels of ``source``, for ``seconds``, or for so many ``steps`` of all worlds together.

    With ``steps`` the same seed makes the same agent. ``searches``: runs through each level that are searched, for
    episodes to begin in their midst. ``observation``: what the agent sees.
    """

    source: LevelSource
    seconds: float = 600.0
    steps: int = 0
    seed: int = 0
    worlds: int = 1024
    searches: int = 2
    observation: tuple[Part, ...] = OBSERVATION
    method: PPOSettings = field(default_factory=PPOSettings)

    @property
    def steps_planned(self) -> float:
        """Steps with which the training plans."""
        return self.steps or self.seconds * STEPS_PER_SECOND


@dataclass(frozen=True)
class Progress:
    """How far the training is. ``rates``: the share of the last episodes from the start of each level that passed."""

    steps: int
    seconds: float
    rates: NDArray[np.float64]

    @property
    def passed(self) -> int:
        """Levels that at least nine episodes in ten pass."""
        return int((self.rates >= 0.9).sum())


def train(
    task: Task,
    *,
    report: Callable[[Progress], None] | None = None,
    on_better: Callable[[PolicyAgent], None] | None = None,
) -> PolicyAgent:
    """Train an agent; the best one by the mean rate. ``on_better`` is given each that is better than those before.

    Raises MissingExtraError without JAX and Optax (the extra `train`), MemoryUnavailableError without Numba.
    """
    began, used = time.monotonic(), time.process_time()
    trainer = Trainer(task)
    curve: list[list[float]] = []
    best, best_rate = trainer.agent({}), -1.0
    for number in range(1, 10**9):
        trainer.improve()
        over = trainer.steps >= task.steps if task.steps else time.monotonic() - began >= task.seconds
        rates = trainer.starts.rates[: len(task.source.names)]
        if report:
            report(Progress(trainer.steps, time.monotonic() - began, rates.copy()))
        if not over and number % JUDGED_EVERY:
            continue
        curve.append([trainer.steps, round(time.process_time() - used, 1), *np.round(rates, 2).tolist()])
        if rates.mean() > best_rate:
            best_rate = float(rates.mean())
            best = trainer.agent({"levels": task.source.names, "seed": task.seed, "curve": list(curve)})
            if on_better:
                on_better(best)
        if over:
            break
    return best


class Trainer:
    """The worlds that play, and the networks that learn."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.steps = 0
        parts = Observation(task.observation, flat=True).parts
        method = task.method
        self.settings: dict[str, Any] = {"observation": parts, "flat": True, "frame_skip": 4, "time_limit": 1600}
        shaping = DistanceShaping(5.0, method.discount)
        settings = {**self.settings, "reward": [ExitReward(10.0), shaping]}
        self.worlds = EnvWorlds(task.source, task.worlds, repeat=REPEAT, longest_wait=LONGEST_WAIT, **settings)
        self._observed = np.asarray(self.worlds.observations)
        self.starts = Starts(task.source, settings, task.seed, task.searches)
        self._rng = np.random.default_rng([task.seed, 2])
        self.worlds.reset(seeds=range(task.seed << 32, (task.seed << 32) + task.worlds))
        self._begun, self._limits = np.zeros((2, task.worlds), np.intp)
        self._begin(np.arange(task.worlds))
        inputs = self._observed.shape[1]
        self.learner = Learner(inputs, method, task.seed)
        self._mean, self._scale = np.zeros(inputs, np.float32), np.ones(inputs, np.float32)
        self._mean, self._scale = self._measure()

    def agent(self, training: dict[str, Any]) -> PolicyAgent:
        policy = self.learner.networks["policy"]
        return PolicyAgent(policy, self._mean, self._scale, self.settings, training)

    def improve(self) -> None:
        """Play a round and learn from it."""
        method = self.task.method
        shape = ROUND, self.task.worlds
        seen = np.zeros((*shape, len(self._mean)), np.float32)
        actions = np.zeros(shape, np.int32)
        chances, rewards = np.zeros((2, *shape), np.float32)
        values = np.zeros((ROUND + 1, self.task.worlds), np.float32)
        ended = np.zeros(shape, np.bool_)
        for step in range(ROUND):
            seen[step] = self._seen()
            scores, values[step] = self.learner.play(seen[step])
            actions[step] = (scores + self._rng.gumbel(size=scores.shape)).argmax(axis=1)
            chances[step] = np.take_along_axis(scores, actions[step][:, np.newaxis], axis=1)[:, 0]
            rewards[step], ended[step] = self._step(actions[step])
        _, values[ROUND] = self.learner.play(self._seen())
        gains = advantages(rewards, values, ended, method)
        returns = gains + values[:-1]
        gains = (gains - gains.mean()) / (gains.std() + 1e-8)
        self.steps += actions.size
        samples = Samples(
            seen.reshape(actions.size, -1), actions.ravel(), chances.ravel(), gains.ravel(), returns.ravel()
        )
        self.learner.learn(samples, self.steps / self.task.steps_planned)

    def _seen(self) -> Floats:
        return normalised(self._observed, self._mean, self._scale)

    def _step(self, actions: NDArray[Any]) -> tuple[Floats, NDArray[np.bool_]]:
        """Play one step; the rewards, and which episodes have ended: new ones have begun in their worlds."""
        worlds = self.worlds
        worlds.step(DISCRETE_KEYS[actions])
        rewards = worlds.rewards.astype(np.float32)
        late = (worlds.truncated | (worlds.ticks >= self._limits)) & ~worlds.terminated
        if late.any():
            # The time limit is not an end of the task: what would have come is expected to come.
            _, values = self.learner.play(self._seen())
            rewards[late] += self.task.method.discount * values[late]
        ended = worlds.terminated | late
        which = np.flatnonzero(ended)
        self.starts.note(self._begun[which], worlds.outcomes[which] == OUTCOME_EXIT)
        self._begin(which)
        return rewards, ended

    def _begin(self, which: NDArray[np.intp]) -> None:
        """New episodes; those that begin in the middle of a run do not wait."""
        self._begun[which] = starts = self.starts.choose(len(which), self._rng)
        own = starts < self.starts.levels
        self.worlds.reset(which[own], levels=starts[own])
        self.starts.put(self.worlds, which[~own], starts[~own])
        self._limits[which] = self.worlds.ticks[which] + self.starts.limits[starts]

    def _measure(self) -> tuple[Floats, Floats]:
        """Means of the observations, and what makes their deviations 1: from a round of random play."""
        rows = []
        for _ in range(ROUND):
            self._step(self._rng.integers(len(DISCRETE_KEYS), size=self.task.worlds))
            rows.append(self._observed.copy())
        every = np.concatenate(rows)
        return every.mean(axis=0), 1.0 / np.maximum(every.std(axis=0), np.float32(SMALLEST_DEVIATION))


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3"))
@click.option(
    "--levels", metavar="LEVELS", multiple=True, default=LEVELS, show_default="twelve easy ones",
    help="train, set, a level of the game, a file or folder, generated:3:1-8. May be given several times.",
)  # fmt: skip
@click.option("--seconds", type=click.FloatRange(1), default=600.0, show_default=True, help="Stop after so long.")
@click.option(
    "--steps", type=click.IntRange(0), default=0, metavar="N",
    help="Stop after N steps of all worlds together instead: with the same seed always the same agent.",
)  # fmt: skip
@click.option("--seed", type=click.IntRange(0, 999_999), default=0, show_default=True)
@click.option("--worlds", type=click.IntRange(1), default=1024, show_default=True, help="Worlds in parallel.")
@click.option("--output", "-o", default="agent.npz", show_default=True, type=click.Path(dir_okay=False, path_type=Path))
def main(levels: Sequence[str], seconds: float, steps: int, seed: int, worlds: int, output: Path) -> None:
    if output.exists():
        raise click.UsageError(f"{output} exists; name another file with -o, or remove it")
    try:
        task = Task(level_source(list(levels)), seconds=seconds, steps=steps, seed=seed, worlds=worlds)
        click.echo(f"{len(task.source.names)} levels; first come runs through them, then the training", err=True)
        agent = train(task, report=tell, on_better=lambda agent: agent.save(output))
    except KeyboardInterrupt:
        click.echo("\nstopped", err=True)
        sys.exit(130)
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    best, _, *rates = agent.training["curve"][-1]
    click.echo(f"\n{output}: the best agent, after {best / 1e6:.1f}M steps")
    for name, rate in zip(task.source.names, rates, strict=True):
        click.echo(f"  {rate:4.0%}  {name}")


def tell(progress: Progress) -> None:
    """Steps, speed, and how often the levels are passed, in a line that the next one replaces."""
    speed = progress.steps / max(progress.seconds, 1e-9)
    often = f"{progress.passed} of {len(progress.rates)} levels nine times in ten"
    passed = f"{progress.rates.mean():.0%} of episodes passed, {often}"
    click.echo(f"\r{progress.steps / 1e6:.1f}M steps, {speed / 1e3:.0f}k/s: {passed}", nl=False, err=True)


if __name__ == "__main__":
    main()
