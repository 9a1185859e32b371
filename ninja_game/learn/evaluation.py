"""Evaluation: a table of how often an agent passes some levels.

A policy reacts to observations; it plays many episodes that differ by sticky actions and a random wait at the start. A
planner gives all actions for a level; the environment decides what they achieve.
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
    """An agent under evaluation. ``settings``: the keywords of its environment."""

    @property
    def settings(self) -> dict[str, Any]:
        """Keywords of ``NinjaEnv`` without level and body; the actions must be discrete."""


class Policy(Agent, Protocol):
    """An agent that reacts to observations."""

    def reset(self, count: int, seed: int) -> None:
        """Begin with ``count`` worlds."""

    def act(self, observations: Any) -> NDArray[np.integer]:
        """The actions of all worlds, (n,), by their observations."""


@runtime_checkable
class Planner(Agent, Protocol):
    """An agent that chooses all actions of a level before it plays."""

    def plan(self, level: Level, seed: int) -> NDArray[np.integer]:
        """The actions, one per step."""


@dataclass(frozen=True)
class LevelResult:
    """Episodes in one level: how many ended at the exit, by death or by the time limit; and their results.

    ``ticks``: median over the passed episodes, NaN without any; ``gold``, ``reward``: means over all episodes.
    """

    level: str
    episodes: int  #: number of episodes played
    passed: int
    dead: int
    late: int  #: number of episodes that ended at the time limit
    ticks: float
    gold: float
    reward: float

    @property
    def rate(self) -> float:
        """The share of episodes that were passed."""
        return self.passed / self.episodes


@dataclass(frozen=True)
class Evaluation:
    """The result of an agent. ``levels_sha256``: of the levels; evaluations are only comparable if it is equal."""

    agent: str  #: its name
    levels_sha256: str
    seed: int
    repeat: float  #: chance that a step repeats the keys of the previous one
    longest_wait: int  #: most steps without keys at the start of an episode
    time_limit: int  #: ticks
    results: list[LevelResult]

    def count_passed(self, rate: float = 0.9) -> int:
        """Count the levels that were passed in at least this share of their episodes."""
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
    """Evaluate an agent on levels.

    ``episodes``: of a policy in each level; a planner plays one. ``seed``: equal seeds give equal tables. A level's row
    does not depend on the other levels: its episode i is the first of an environment with these settings after
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
    """The ends of the episodes of all worlds, (n,): outcome (0: time limit), ticks, gold, reward."""

    outcomes: NDArray[np.int64]
    ticks: NDArray[np.int64]
    gold: NDArray[np.int64]
    rewards: NDArray[np.float64]


def play_episodes(worlds: EnvWorlds, actions: ActionStream) -> EpisodeEnds:
    """Play one episode in every world; an episode that runs when the actions end counts as out of time."""
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
    passed, dead = ends.outcomes == OUTCOME_EXIT, ends.outcomes == OUTCOME_DEAD
    return LevelResult(
        name,
        len(ends.ticks),
        int(passed.sum()),
        int(dead.sum()),
        int((~passed & ~dead).sum()),
        float(np.median(ends.ticks[passed])) if passed.any() else float("nan"),
        float(ends.gold.mean()),
        float(ends.rewards.mean()),
    )
