"""Evaluation: how often an agent passes each of some levels, as a table.

A policy looks at observations and is tried in many episodes that differ by sticky actions and a start that waits; a
planner gives the actions for a level, and is believed only what an environment says of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ninja_game.formats.n14.level_string import level_digest
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.levels.origins import Origin, level_source
from ninja_game.learn.protocol import EVALUATION_SEED, MAX_WAIT, REPEAT, TIME_LIMIT
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.level import Level
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT

ActionStream: TypeAlias = Iterator[NDArray[np.integer]]


class Agent(Protocol):
    """``settings``: the keywords of the environment that an agent is made for."""

    @property
    def settings(self) -> dict[str, Any]:
        """Keywords of ``NinjaEnv``, but level and body; the actions are discrete."""


class Policy(Agent, Protocol):
    """An agent that looks and acts."""

    def reset(self, count: int, seed: int) -> None:
        """Begin with this many worlds."""

    def act(self, observations: Any) -> NDArray[np.integer]:
        """The action of each world, (n,), by the observations of all."""


@runtime_checkable
class Planner(Agent, Protocol):
    """An agent that finds all actions for a level before it plays."""

    def plan(self, level: Level, seed: int) -> NDArray[np.integer]:
        """The actions, one a step."""


@dataclass(frozen=True)
class LevelResult:
    """Episodes in one level: how many were passed, ended by death, by the time; and what was reached.

    ``ticks``: the median of those that were passed, NaN without any; ``gold``, ``reward``: means of all.
    """

    level: str
    episodes: int
    passed: int
    dead: int
    late: int
    ticks: float
    gold: float
    reward: float

    @property
    def rate(self) -> float:
        """The share of episodes that were passed."""
        return self.passed / self.episodes


@dataclass(frozen=True)
class Evaluation:
    """What an agent reached. ``levels_sha256``: of the levels themselves; equal evaluations have equal ones."""

    agent: str
    levels_sha256: str
    seed: int
    repeat: float
    longest_wait: int
    time_limit: int
    results: list[LevelResult]

    def count_passed(self, rate: float = 0.9) -> int:
        """How many levels were passed in that share of their episodes or more."""
        return sum(result.rate >= rate for result in self.results)


def evaluate(
    agent: Policy | Planner,
    levels: Origin = "test",
    *,
    name: str = "agent",
    episodes: int = 20,
    seed: int = EVALUATION_SEED,
    repeat: float = REPEAT,
    longest_wait: int = MAX_WAIT,
    time_limit: int = TIME_LIMIT,
    memory: str = "auto",
) -> Evaluation:
    """The table of an agent on levels.

    ``episodes``: of a policy in each level; of a planner's one. ``seed``: equal seeds give equal tables; a level's row
    does not depend on the other levels: its episode i is the first of an environment of the same settings after
    ``reset(seed=first_seed(level, seed) + i)``. ``repeat``, ``longest_wait``: of ``EnvWorlds``, for policies.
    """
    source = level_source(levels)
    results = []
    settings = {**agent.settings, "time_limit": time_limit, "memory": memory}
    for fixed in ("actions", "repeat", "longest_wait"):
        settings.pop(fixed, None)
    for level_name, level in zip(source.names, source.levels, strict=True):
        if isinstance(agent, Planner):
            worlds = EnvWorlds(level, 1, **settings)
            actions: ActionStream = iter(np.asarray(agent.plan(level, seed)).reshape(-1, 1))
        else:
            worlds = EnvWorlds(level, episodes, repeat=repeat, longest_wait=longest_wait, **settings)
            first = first_seed(level, seed)
            worlds.reset(seeds=range(first, first + episodes))
            actions = policy_actions(agent, worlds, seed)
        results.append(_result(level_name, play_episodes(worlds, actions)))
    return Evaluation(name, source.digest, seed, repeat, longest_wait, time_limit, results)


def first_seed(level: Level, seed: int = EVALUATION_SEED) -> int:
    """The seed of the first episode of an evaluation in a level."""
    return seed + int(level_digest(level)[:12], 16)


def policy_actions(agent: Policy, worlds: EnvWorlds, seed: int) -> ActionStream:
    agent.reset(worlds.count, seed)
    while True:
        yield agent.act(worlds.observations)


class EpisodeEnds(NamedTuple):
    """How the episode of each world has ended, (n,): outcome, 0 for one that was late, ticks, gold, reward."""

    outcomes: NDArray[np.int64]
    ticks: NDArray[np.int64]
    gold: NDArray[np.int64]
    rewards: NDArray[np.float64]


def play_episodes(worlds: EnvWorlds, actions: ActionStream) -> EpisodeEnds:
    """One episode in every world; where the actions come to an end, what runs still is late."""
    outcomes, ticks, gold = np.zeros((3, worlds.count), np.int64)
    ends = EpisodeEnds(outcomes, ticks, gold, np.zeros(worlds.count))
    running = np.ones(worlds.count, np.bool_)
    for row in actions:
        worlds.step(DISCRETE_KEYS[row])
        ends.rewards[running] += worlds.rewards[running]
        for kept, now in zip(ends, (worlds.outcomes, worlds.ticks, worlds.gold), strict=False):
            kept[running] = now[running]
        running &= ~(worlds.terminated | worlds.truncated)
        if not running.any():
            break
    return ends


def _result(name: str, ends: EpisodeEnds) -> LevelResult:
    count, passed, dead = len(ends.ticks), ends.outcomes == OUTCOME_EXIT, ends.outcomes == OUTCOME_DEAD
    return LevelResult(
        name,
        count,
        int(passed.sum()),
        int(dead.sum()),
        int((~passed & ~dead).sum()),
        float(np.median(ends.ticks[passed])) if passed.any() else float("nan"),
        float(ends.gold.mean()),
        float(ends.rewards.mean()),
    )
