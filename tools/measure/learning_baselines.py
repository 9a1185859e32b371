"""Make the table of the baselines on all levels of the game, benchmarks/results/learning-baselines.md.

    python3 tools/dev.py tool measure.learning_baselines results.jsonl --agents random,search,learned
    python3 tools/dev.py tool measure.learning_baselines results.jsonl --doc

Results are appended to a JSON-lines file level by level; what is in it is not measured again, so that it may be
interrupted.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from examples.agents import LEARNED, load_agent, load_policy
from examples.search import SearchAgent
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.evaluation import EVALUATION_SEED, TIME_LIMIT, evaluate
from ninja_game.learn.levels import LevelSource, level_source
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.level import Level
from ninja_game.sim.states import OUTCOME_EXIT
from tools import ROOT

DOC = ROOT / "benchmarks" / "results" / "learning-baselines.md"
EPISODES = 100

HEAD = """# Baselines on all levels

What the agents of [learning.md](../../docs/learning.md#baselines) reach on each of the hundred levels of the game.
*Random*, *learned*: the share of {episodes} episodes that passed, with sticky actions and random waits at the start
(seed {seed:,}).
*Trained*: whether the learned agent was trained in the level; of the others those for testing were tried, which it has
never seen. *Search*: ticks of the run that the search agent found and the environment confirmed, and how many million
ticks all worlds of the search played for it, of {budget:g} at most.

{summary}

| level | random | learned | trained | search: run | search: effort |
|---|---|---|---|---|---|
"""


def searched(level: Level) -> dict[str, Any]:
    """What the search agent found, and what the environment says of it."""
    began = time.process_time()
    found = SearchAgent().search(level)
    worlds = EnvWorlds(level, 1, time_limit=TIME_LIMIT)
    for action in found.actions if found.actions is not None else ():
        worlds.step(DISCRETE_KEYS[np.array([action])])
    passed = bool(worlds.outcomes[0] == OUTCOME_EXIT)
    seconds = round(time.process_time() - began, 1)
    return {"passed": passed, "ticks": int(worlds.ticks[0]), "effort": found.ticks, "cpu_s": seconds}


def tried(agent: str, name: str, level: Level) -> dict[str, Any]:
    """How many episodes an agent that looks passes."""
    return {"passed": evaluate(load_agent(agent), LevelSource([name], [level]), episodes=EPISODES).results[0].passed}


def measure(file: Path, agents: Iterable[str]) -> None:
    """Measure what is not in the file yet."""
    done = {(row["agent"], row["level"]) for row in rows(file)}
    source = level_source("set")
    seen = {*load_policy(LEARNED).training["levels"], *level_source("test").names}
    for agent in agents:
        for name, level in zip(source.names, source.levels, strict=True):
            if (agent, name) in done or (agent == "learned" and name not in seen):
                continue
            facts = searched(level) if agent == "search" else tried(agent, name, level)
            with file.open("a", encoding="utf-8") as output:
                output.write(json.dumps({"agent": agent, "level": name, **facts}) + "\n")
            print(agent, name, facts, flush=True)


def rows(file: Path) -> list[dict[str, Any]]:
    """The results in a file."""
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


def write_doc(file: Path) -> None:
    """Write the page."""
    found = {(row["agent"], row["level"]): row for row in rows(file)}
    names = level_source("set").names
    trained = set(load_policy(LEARNED).training["levels"])
    lines = [_line(found, name, name in trained) for name in names]
    budget = SearchAgent().ticks / 1e6
    summary = _summary(found, names, trained)
    DOC.write_text(
        HEAD.format(episodes=EPISODES, seed=EVALUATION_SEED, budget=budget, summary=summary) + "\n".join(lines) + "\n"
    )
    print(summary)


def _line(found: Mapping[tuple[str, str], dict[str, Any]], name: str, trained: bool) -> str:
    search = found["search", name]
    run = str(search["ticks"]) if search["passed"] else "-"
    rows = [found.get((agent, name)) for agent in ("random", "learned")]
    shares = [f"{row['passed'] / EPISODES:.0%}" if row else "" for row in rows]
    cells = [name, *shares, "yes" if trained else "", run, f"{search['effort'] / 1e6:.2f}"]
    return f"| {' | '.join(cells)} |"


def _summary(found: Mapping[tuple[str, str], dict[str, Any]], names: list[str], trained: set[str]) -> str:
    """The table in sentences."""
    searched = [found["search", name] for name in names]
    passed = sum(row["passed"] for row in searched)
    effort = float(np.median([row["effort"] for row in searched])) / 1e6
    seconds = sum(row["cpu_s"] for row in searched)
    found_runs = f"The search agent passes {passed} of {len(names)} levels; median {effort:.2f} million ticks, "
    parts = [f"{found_runs}{seconds:,.0f} s of processor time for all."]
    for what, group in (("trained", trained), ("unseen", set(names) - trained)):
        shares = [found["learned", name]["passed"] / EPISODES for name in group if ("learned", name) in found]
        often = sum(share >= 0.9 for share in shares)
        passes = f"The learned agent passes {np.mean(shares):.0%} of the episodes in {len(shares)} {what} levels"
        parts.append(f"{passes}; {often} of these levels in at least 90 % of the episodes.")
    chance = np.mean([found["random", name]["passed"] / EPISODES for name in names])
    return "\n".join([*parts, f"The random agent passes {chance:.1%} of all episodes."])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path, help="JSON lines of results")
    parser.add_argument("--agents", default="", help="random, search, learned, with commas: measure these")
    parser.add_argument("--doc", action="store_true", help="write benchmarks/results/learning-baselines.md")
    arguments = parser.parse_args()
    measure(arguments.file, filter(None, arguments.agents.split(",")))
    if arguments.doc:
        write_doc(arguments.file)
