"""Our environments beside others in one run: EnvPool (CartPole, Pong), MiniGrid, the Arcade Learning Environment.

    python3 -m benchmarks.beside --packages FOLDER

They are none of the project's dependencies; FOLDER is where `pip install --target FOLDER envpool minigrid ale-py` put
them. What is not there is left out and named. One thread, random actions, episodes begin again by themselves; steps by
the processor's time, which counts all threads, the middle of some rounds in which each has its turn.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from statistics import median
from typing import Any

import gymnasium
import numpy as np

from benchmarks.measure_learning import RESULTS
from ninja_game.runtime import cores

SECONDS, ROUNDS = 0.5, 7
MANY = 256  # worlds of a vector


def ours(vector: bool, **settings: Any) -> Callable[[], Any]:
    """What makes an environment of ours."""
    if vector:
        return lambda: gymnasium.make_vec(
            "ninja_game.learn:Ninja-v0", MANY, level="set", threads=1, copy=False, **settings
        )
    return lambda: gymnasium.make("ninja_game.learn:Ninja-v0", disable_env_checker=True, **settings)


def atari() -> Any:
    """Pong of the Arcade Learning Environment, one world."""
    gymnasium.register_envs(import_module("ale_py"))
    return gymnasium.make("ALE/Pong-v5", disable_env_checker=True)


def atari_vector() -> Any:
    """Pong by the Arcade Learning Environment's own vector: 84 x 84, four pictures."""
    return import_module("ale_py.vector_env").AtariVectorEnv("pong", num_envs=MANY, num_threads=1)


def minigrid() -> Any:
    """The smallest usual task of MiniGrid."""
    import_module("minigrid")
    return gymnasium.make("MiniGrid-Empty-8x8-v0", disable_env_checker=True)


def envpool(task: str) -> Callable[[], Any]:
    """What makes a vector of EnvPool."""
    return lambda: import_module("envpool").make_gymnasium(task, num_envs=MANY, num_threads=1)


NINJA = "Ninja-v0: "
ROWS: dict[str, tuple[Callable[[], Any], int, int]] = {
    NINJA + "state": (ours(False), 1, 4),
    "Gymnasium CartPole-v1": (lambda: gymnasium.make("CartPole-v1", disable_env_checker=True), 1, 1),
    "MiniGrid Empty-8x8": (minigrid, 1, 1),
    "ALE Pong-v5, 210 x 160 x 3": (atari, 1, 4),
    NINJA + "vector, state": (ours(True), MANY, 4),
    NINJA + "vector, state, 16 rays, 9 x 9 tiles": (ours(True, observation=["state", "rays", "tiles"]), MANY, 4),
    NINJA + "vector, pixels 84 x 84": (ours(True, observation="pixels"), MANY, 4),
    "EnvPool CartPole-v1": (envpool("CartPole-v1"), MANY, 1),
    "EnvPool Pong-v5, 4 x 84 x 84": (envpool("Pong-v5"), MANY, 4),
    "ALE vector Pong, 4 x 84 x 84": (atari_vector, MANY, 4),
}
"""What makes each, how many worlds it is, and how many ticks or frames a step is."""


def steps_a_second(env: Any, worlds: int, seconds: float) -> float:
    """Steps of all worlds by the processor's time."""
    choices = int(getattr(env, "single_action_space", env.action_space).n)
    drawn = np.random.default_rng(0).integers(choices, size=(1000, worlds))
    actions: list[Any] = list(drawn) if worlds > 1 else drawn[:, 0].tolist()
    steps, start = 0, time.process_time()
    while time.process_time() - start < seconds:
        for action in actions[steps // worlds % 1000 :][:16]:
            _, _, terminated, truncated, _ = env.step(action)
            if worlds == 1 and (terminated or truncated):
                env.reset()
        steps += 16 * worlds
    return steps / (time.process_time() - start)


def table(seconds: float = SECONDS, rounds: int = ROUNDS) -> str:
    """Markdown: of each environment the steps and the ticks or frames a second; what could not be made."""
    envs, missing = {}, []
    for name, (make, worlds, _) in ROWS.items():
        try:
            envs[name] = make()
            envs[name].reset()
            steps_a_second(envs[name], worlds, seconds / 10)
        except Exception as error:  # noqa: BLE001 - whatever keeps another's package from working
            envs.pop(name, None)
            missing.append(f"{name}: not measured, {type(error).__name__}: {str(error)[:99]}")
    found: dict[str, list[float]] = {name: [] for name in envs}
    for _ in range(rounds):
        for name, env in envs.items():
            found[name].append(steps_a_second(env, ROWS[name][1], seconds))
    load = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"
    lines = [f"{platform.machine()}, {cores()} cores, load {load}; vectors of {MANY} worlds.\n"]
    lines += ["| environment | steps/s | ticks or frames/s |", "|---|---|---|"]
    for name, speeds in found.items():
        lines.append(f"| {name} | {median(speeds):,.0f} | {median(speeds) * ROWS[name][2]:,.0f} |")
    return "\n".join([*lines, "", *missing]).rstrip() + "\n"


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--packages", action="append", default=[], help="folder of the others; may be given again")
    parser.add_argument("--table", type=Path, default=RESULTS / "beside-others.md", help="where the table goes")
    options = parser.parse_args()
    sys.path += options.packages
    head = "# Beside other environments\n\nWritten by `python3 -m benchmarks.beside`, which says what it measures.\n"
    options.table.write_text(head + table(), "utf-8")
    print(options.table.read_text("utf-8"))


if __name__ == "__main__":
    main()
