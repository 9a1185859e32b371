"""Measure an agent by the benchmark's protocol (docs/ninjabench.md), and write what it reached.

    python3 -m examples.measure agent.npz -o results/ppo-0.json --name ppo
    python3 -m examples.measure random -o results/random-0.json --seed 0

One episode in each of 1,000 levels of `bench:test` and in the first 1,000 of `bench:train`, fifty in each of the twenty
levels of `benchmarks/transfer`. AGENT is as for examples/evaluate.py. The file tells what was measured, by which levels
(their digests), which version and which machine. examples/bench_report.py reads a folder of such files.
"""

from __future__ import annotations

import json
import shlex
import sys
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

from benchmarks.__main__ import machine_kind
from examples.agents import PolicyAgent, load_agent, tell_compiling
from ninja_game import __version__
from ninja_game.backend.memories import open_worlds
from ninja_game.errors import NinjaGameError
from ninja_game.files.writing import write_atomically
from ninja_game.formats.load import load_replays
from ninja_game.learn.evaluation import Planner, Policy, play_episodes, policy_actions
from ninja_game.learn.levels.bench import BENCH_GRADES, bench_level
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.levels.source import LevelSource
from ninja_game.learn.protocol import EVALUATION_SEED, PROTOCOL
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT

BENCH = "ninja_game.learn:NinjaBench-v1"
TASKS = {"bench:test": 1, "bench:train:0-999": 1, "transfer": 50}
"""Sources of levels, and how many episodes each level has."""
DIGESTS = {
    "bench:test": "7d2091b4d97b90fc179649c607f1b253ed1d53dd332197bc9b0132c7d4c1ee5f",
    "bench:train:0-999": "05c0d000e404fcb74aa554b2c2cdab921cb9efa894ed1d52bccf9f4203724316",
    "bench:train": "035670e09de237d37303219a05e20ce6c9a1cb114fad1671494eb31d34142334",
    "bench:val": "9d151f72fc15ad33bb32c97e6ee2933f48410d8b1752a216c962c1fdf4476989",
    "transfer": "3aa98af1f134272072d3d3143de2f8b6785156b9c669775254ddb22f46088c35",
}
"""Sha256 of the levels of the protocol. They are fixed: a test compares them with the levels that there are."""
TRANSFER = Path(__file__).parents[1] / "benchmarks" / "transfer"
"""Known runs with their levels: `test` as it was on November 24, 2026. Levels of the game may be drawn anew."""
FORMAT = 2


def levels_of(levels: str) -> LevelSource:
    """The levels of one of ``TASKS``, or of any other origin."""
    return level_source(TRANSFER if levels == "transfer" else levels)


def measure(agent: Policy, levels: str, *, episodes: int = 1, seed: int = EVALUATION_SEED) -> dict[str, NDArray[Any]]:
    """Episodes in each level, all at once: of each (episodes x levels) ``passed``, ``dead`` (bool), and ``ticks``.

    Equal seeds give equal numbers. Episode k is the first one of an environment after ``reset(seed=seed + k)``.
    """
    source = levels_of(levels)
    count = len(source.levels) * episodes
    settings = {**agent.settings, **PROTOCOL}
    settings.pop("actions", None)
    worlds = EnvWorlds(source, count, **settings)
    worlds.reset(seeds=range(seed, seed + count), levels=np.arange(count) % len(source.levels))
    ends = play_episodes(worlds, policy_actions(agent, worlds, seed))
    outcomes, ticks = (numbers.reshape(episodes, -1) for numbers in (ends.outcomes, ends.ticks))
    return {"passed": outcomes == OUTCOME_EXIT, "dead": outcomes == OUTCOME_DEAD, "ticks": ticks}


def pars(levels: str) -> NDArray[np.int64]:
    """The ticks in which the known run passes each level of one of ``TASKS``."""
    if levels == "transfer":
        return np.array([run.ticks for run in load_replays(TRANSFER)])
    ticks = []
    for name in level_source(levels).names:
        _, split, number = name.split("-")
        found = bench_level(split, int(number))
        worlds = open_worlds("auto", found.level, box=False)
        worlds.run(found.inputs)
        ticks.append(worlds.tick())
    return np.array(ticks)


def scores(found: dict[str, NDArray[Any]], levels: str) -> dict[str, dict[str, float]]:
    """Of each grade of levels the shares of episodes ``passed`` and ``dead``, and ``par``, from ``with_par``."""
    grades = {"all": slice(None)}
    if levels.startswith("bench"):
        grades = {grade: slice(first, None, len(BENCH_GRADES)) for first, grade in enumerate(BENCH_GRADES)}
    shown = ("passed", "dead", "par")
    return {
        grade: {name: round(float(found[name][:, part].mean()), 4) for name in shown} for grade, part in grades.items()
    }


def with_par(found: dict[str, NDArray[Any]], levels: str) -> dict[str, NDArray[Any]]:
    """What was measured, with ``par``: the known run's ticks by those of the agent, at most 1; 0 if not passed."""
    return {**found, "par": found["passed"] * np.minimum(1.0, pars(levels) / np.maximum(found["ticks"], 1))}


def by_level(found: dict[str, NDArray[Any]]) -> dict[str, str]:
    """Of each level the episodes passed, and of ``par`` the mean, in percent, as numbers with spaces between."""
    rows = {"passed": found["passed"].sum(axis=0), "par": (100 * found["par"].mean(axis=0)).round().astype(int)}
    return {name: " ".join(map(str, row.tolist())) for name, row in rows.items()}


def tell_digests(context: click.Context, _option: click.Parameter, wanted: bool) -> None:
    """Print the digests of the levels that there are, if they are wanted, and end."""
    if wanted:
        for name in DIGESTS:
            click.echo(f"{levels_of(name).digest}  {name}")
        context.exit()


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.argument("agent_name", metavar="AGENT")
@click.option("--name", help="What it is called in tables; without, AGENT.")
@click.option("--track", type=click.Choice(["sight", "field"]), default="sight", show_default=True)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True, help="Of an agent that was not trained.")
@click.option("--output", "-o", required=True, type=click.Path(dir_okay=False, path_type=Path))
@click.option(
    "--digests", is_flag=True, is_eager=True, expose_value=False, help="Tell the sha256 of the levels.",
    callback=tell_digests,
)  # fmt: skip
def main(agent_name: str, name: str | None, track: str, seed: int, output: Path) -> None:
    try:
        agent = load_agent(agent_name)
        if isinstance(agent, Planner):
            raise click.UsageError("an agent that plans is measured by examples/evaluate.py")
        tell_compiling()
        training = agent.training if isinstance(agent, PolicyAgent) else {"seed": seed}
        first = EVALUATION_SEED + 10_000 * seed
        found = {
            task: with_par(measure(agent, task, episodes=episodes, seed=first), task)
            for task, episodes in TASKS.items()
        }
        reached = {task: scores(rows, task) for task, rows in found.items()}
        about = {
            "format": FORMAT, "agent": name or agent_name, "track": track, "package": __version__,
            "command": shlex.join(["python3", "-m", "examples.measure", *sys.argv[1:]]),
            "machine": machine_kind(),
            "digests": {task: levels_of(task).digest for task in TASKS},
            "training": training, "scores": reached, "levels": {task: by_level(rows) for task, rows in found.items()},
        }  # fmt: skip
        write_atomically(output, json.dumps(about, indent=1) + "\n")
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    for levels, grades in reached.items():
        shown = ", ".join(f"{grade} {values['passed']:.1%}" for grade, values in grades.items())
        click.echo(f"{levels}: passed {shown}")


if __name__ == "__main__":
    main()
