"""Measure an agent by the benchmark's protocol (docs/ninjabench.md), and write what it reached.

    python3 -m examples.measure agent.npz -o results/ppo-0.json --name ppo
    python3 -m examples.measure random -o results/random-0.json --seed 0

One episode in each of 1,000 levels of `bench:test` and in the first 1,000 of `bench:train`, fifty in each of the twenty
levels of `test`. AGENT is as for examples/evaluate.py. A folder of such files is what examples/bench_report.py reads.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from examples.agents import PolicyAgent, load_agent
from ninja_game.backend.memories import open_worlds
from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import bundled_replays
from ninja_game.files.writing import write_atomically
from ninja_game.formats.load import load_replays
from ninja_game.learn.evaluation import Planner, Policy, chosen, played
from ninja_game.learn.levels import level_source
from ninja_game.learn.levels.bench import GRADES, bench_level
from ninja_game.learn.protocol import EVALUATION_SEED, PROTOCOL
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT

BENCH = "ninja_game:NinjaBench-v1"
TASKS = {"bench:test": 1, "bench:train:0-999": 1, "test": 50}
"""Sources of levels, and how many episodes each level has."""
FORMAT = 1


def measure(agent: Policy, levels: str, *, episodes: int = 1, seed: int = EVALUATION_SEED) -> dict[str, NDArray[Any]]:
    """Episodes in each level, all at once: of each (episodes x levels) ``passed``, ``dead`` (bool), and ``ticks``.

    Equal seeds give equal numbers. Episode k is the first one of an environment after ``reset(seed=seed + k)``.
    """
    source = level_source(levels)
    count = len(source.levels) * episodes
    settings = {**agent.settings, **PROTOCOL}
    settings.pop("actions", None)
    worlds = EnvWorlds(source, count, **settings)
    worlds.reset(seeds=range(seed, seed + count), levels=np.arange(count) % len(source.levels))
    ends = played(worlds, chosen(agent, worlds, seed))
    outcomes, ticks = (numbers.reshape(episodes, -1) for numbers in (ends.outcomes, ends.ticks))
    return {"passed": outcomes == OUTCOME_EXIT, "dead": outcomes == OUTCOME_DEAD, "ticks": ticks}


def pars(levels: str) -> NDArray[np.int64]:
    """The ticks in which the known run passes each level of one of ``TASKS``."""
    if levels == "test":
        runs = {path.name.removesuffix(".exit.replay.txt"): path for path in bundled_replays()}
        return np.array([load_replays(runs[name])[0].ticks for name in level_source(levels).names])
    ticks = []
    for name in level_source(levels).names:
        _, split, number = name.split("-")
        found = bench_level(split, int(number))
        worlds = open_worlds("auto", found.level, box=False)
        worlds.run(found.inputs)
        ticks.append(worlds.tick())
    return np.array(ticks)


def scores(agent: Policy, levels: str, seed: int) -> dict[str, dict[str, float]]:
    """Of each grade of levels the shares of episodes ``passed`` and ``dead``, and ``par``.

    That is the mean of the known run's ticks by those of the agent, at most 1, and 0 where it does not pass.
    """
    found = measure(agent, levels, episodes=TASKS[levels], seed=seed)
    every = {**found, "par": found["passed"] * np.minimum(1.0, pars(levels) / np.maximum(found["ticks"], 1))}
    grades = {"all": slice(None)}
    if levels.startswith("bench"):
        grades = {grade: slice(first, None, len(GRADES)) for first, grade in enumerate(GRADES)}
    shown = ("passed", "dead", "par")
    return {
        grade: {name: round(float(every[name][:, part].mean()), 4) for name in shown} for grade, part in grades.items()
    }


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.argument("agent_name", metavar="AGENT")
@click.option("--name", help="What it is called in tables; without, AGENT.")
@click.option("--track", type=click.Choice(["sight", "field"]), default="sight", show_default=True)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of an agent that was not trained.")
@click.option("--output", "-o", required=True, type=click.Path(dir_okay=False, path_type=Path))
def main(agent_name: str, name: str | None, track: str, seed: int, output: Path) -> None:
    try:
        agent = load_agent(agent_name)
        if isinstance(agent, Planner):
            raise click.UsageError("an agent that plans is measured by examples/evaluate.py")
        training = agent.training if isinstance(agent, PolicyAgent) else {"seed": seed}
        found = {levels: scores(agent, levels, EVALUATION_SEED + 10_000 * seed) for levels in TASKS}
        about = {"format": FORMAT, "agent": name or agent_name, "track": track, "training": training, "scores": found}
        write_atomically(output, json.dumps(about, indent=1) + "\n")
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    for levels, grades in found.items():
        shown = ", ".join(f"{grade} {values['passed']:.1%}" for grade, values in grades.items())
        click.echo(f"{levels}: passed {shown}")


if __name__ == "__main__":
    main()
