"""What the interface of Gymnasium costs: ticks/s of environments against the bare kernel and a plain wrapper.

On one thread by the processor's time, in our own levels with random keys; environments and the bare kernel run the
same worlds through the same ticks, in turn. On two threads by the clock: leave the machine alone meanwhile.

    python3 -m benchmarks.measure_learning docs/pictures/learning

It takes some minutes, and writes the table; and the chart into the folder, if one is given.
"""

from __future__ import annotations

import argparse
import os
import platform
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import gymnasium
import numpy as np
from numpy.typing import NDArray

from benchmarks.charts import Chart
from benchmarks.measure_worlds import resident_bytes
from ninja_game.backend.kernels import run_worlds
from ninja_game.backend.memories import open_worlds
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.single import NinjaEnv
from ninja_game.learn.vector import NinjaVectorEnv
from ninja_game.runtime import cores
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED
from ninja_game.sim.level import Level
from ninja_game.simulation import Simulation

RESULTS = Path(__file__).parent / "results"
FRAME_SKIP = 4
OBSERVATIONS: dict[str, tuple[str, ...]] = {
    "state": ("state",),
    "state, 16 rays, 9 x 9 tiles": ("state", "rays", "tiles"),
    "8 nearest objects": ("objects",),
    "planes": ("planes",),
    "pixels 84 x 84": ("pixels",),
}
STEPS, ROUNDS = 120, 5
NUMBERS = (1, 4, 16, 64, 256, 1024, 4096)
MANY = 10_000


class Speed(NamedTuple):
    """Ticks/s of an environment and of the bare kernel in the same ticks, each the best of some rounds.

    ``share``: the environment's of the kernel's, the middle of the rounds; a round measures one right after the other.
    """

    environment: float
    kernel: float
    share: float


def random_actions(steps: int, count: int) -> NDArray[np.int64]:
    """Actions (steps, count), each taken four times."""
    drawn = np.random.default_rng(5).integers(0, len(DISCRETE_KEYS), (steps // 4 + 1, count))
    return np.repeat(drawn, 4, axis=0)[:steps]


def vector_speed(
    count: int, parts: Sequence[str], *, level: str = "set", rounds: int = ROUNDS, threads: int = 1
) -> Speed:
    """The speed of a vector environment of ``count`` worlds that shows ``parts``; the kernel has one thread."""
    envs = NinjaVectorEnv(count, level, observation=parts, memory="compiled", threads=threads, copy=False)
    clock = time.process_time if threads == 1 else time.perf_counter
    actions = random_actions(max(STEPS, 4096 // count), count)
    speeds = []
    for _ in range(rounds + 1):
        envs.reset(seed=0)
        begun = envs.worlds.levels_now.copy()
        ended, levels, ticks, seconds = [], [], 0, 0.0
        for row in actions:
            ended.append(envs.worlds.ended())
            start = clock()
            envs.step(row)
            seconds += clock() - start
            levels.append(envs.worlds.levels_now[ended[-1]])
        kernel = Replay(envs.worlds.levels, begun)
        ticks = kernel.run(actions, ended, levels)
        speeds.append((ticks / seconds, ticks / kernel.seconds, kernel.seconds / seconds))
    # The first round compiles, and warms the caches.
    environments, kernels, shares = zip(*speeds[1:], strict=True)
    return Speed(max(environments), max(kernels), median(shares))


class Replay:
    """The same worlds through the same ticks by the bare kernel: all worlds, the ticks of one step a call."""

    def __init__(self, levels: Sequence[Level], begun: NDArray[np.intp]) -> None:
        self._worlds = open_worlds("compiled", levels, len(begun), box=False)
        self._kernel = self._worlds.kernel(run_worlds)
        self._worlds.load(np.arange(len(begun)), begun)
        self._held = np.zeros(len(begun), np.uint8)
        self.seconds = 0.0

    def run(self, actions: NDArray[np.int64], ended: Sequence[Any], levels: Sequence[Any]) -> int:
        """The number of ticks; worlds that ``ended`` stand still for a step, then begin in their next level."""
        ticks = 0
        for row, over, fresh in zip(actions, ended, levels, strict=True):
            down = DISCRETE_KEYS[row]
            rows = np.repeat(down[np.newaxis], FRAME_SKIP, axis=0)
            rows[0] |= np.where((down & JUMP_HELD).astype(bool) & (self._held == 0), JUMP_PRESSED, 0).astype(np.uint8)
            self._held = down & JUMP_HELD
            where = self._worlds.maps, self._worlds.level_of, self._worlds.worlds
            start = time.process_time()
            ticks += self._kernel(*where, rows, 0, len(down), 1)
            self.seconds += time.process_time() - start
            self._held[over] = 0
            self._worlds.load(over, fresh)
        return ticks


class PlainWrapper(gymnasium.Env[Any, Any]):
    """What one would write first: a ``Simulation``, a step of four ticks, four numbers."""

    def __init__(self, level: Level) -> None:
        self._run = Simulation(level, memory="compiled")
        self.observation_space = gymnasium.spaces.Box(-1000.0, 1000.0, (4,), np.float32)
        self.action_space = gymnasium.spaces.Discrete(6)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed, options=options)
        self._run.reset()
        return self._seen(), {}

    def step(self, action: int) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Four ticks."""
        side, jump = action % 3, action >= 3
        for _ in range(FRAME_SKIP):
            self._run.step(left=side == 0, right=side == 2, jump=jump)
            if self._run.outcome != "running":
                break
        outcome = self._run.outcome
        return self._seen(), float(outcome == "exit"), outcome != "running", False, {}

    def _seen(self) -> NDArray[np.float32]:
        n = self._run.ninja
        return np.array([n.x, n.y, n.vx, n.vy], np.float32)


def single_speed(make: Callable[[Level], gymnasium.Env[Any, Any]], levels: Sequence[Level], steps: int = 200) -> float:
    """Ticks/s of one single environment after the other."""
    actions = random_actions(steps, 1)[:, 0].tolist()
    ticks, seconds = 0, 0.0
    # The first level, played twice, compiles at first.
    for number, env in enumerate(map(make, [levels[0], *levels])):
        env.reset(seed=0)
        start = time.process_time()
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()
        if number:
            seconds += time.process_time() - start
            ticks += FRAME_SKIP * steps
        env.close()
    return ticks / seconds


def single_env(level: Level) -> NinjaEnv:
    """Our single environment in a level."""
    return NinjaEnv(level, memory="compiled")


def memory_of(count: int) -> int:
    """Bytes that a vector environment of ``count`` worlds in all our levels makes resident."""
    before = resident_bytes()
    envs = NinjaVectorEnv(count, "set", memory="compiled", copy=False)
    envs.reset(seed=0)
    for row in random_actions(8, count):
        envs.step(row)
    return resident_bytes() - before


def against_worlds(only: str = "") -> Chart:
    """Ticks/s of vector environments against the number of worlds."""
    chart = Chart("learning-speed-against-worlds", "Vector environments, one thread", "worlds", "ticks/s")
    for name in ("state", "state, 16 rays, 9 x 9 tiles", "pixels 84 x 84"):
        for count in NUMBERS if only in name else ():
            speed = vector_speed(count, OBSERVATIONS[name], rounds=2)
            if name == "state":
                chart.add("bare kernel", count, speed.kernel)
            chart.add(name, count, speed.environment)
    return chart


def _row(what: str, ticks: float, share: str = "", two_threads: float = 0.0) -> str:
    two = f"{two_threads / FRAME_SKIP:,.0f}" if two_threads else ""
    return f"| {what} | {ticks:,.0f} | {ticks / FRAME_SKIP:,.0f} | {share} | {two} |"


def table() -> str:
    """The table of all speeds, Markdown, with what it was measured on."""
    levels = level_source("set").levels[::5]
    single = {
        "a plain wrapper round `Simulation` (compiled), four numbers": PlainWrapper,
        "`NinjaEnv`, state": single_env,
    }
    lines = [_row(what, single_speed(make, levels)) for what, make in single.items()]
    for name, parts in OBSERVATIONS.items():
        one, two = (vector_speed(1024, parts, threads=threads) for threads in (1, 2))
        lines.append(_row(f"vector, {name}", one.environment, f"{one.share:.2f}", two.environment))
    load = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "unknown"
    rows = "\n".join(lines)
    return f"""# Speed of the environments

Written by `python3 -m benchmarks.measure_learning`; [learning.md](../../docs/learning.md#speed) says what it measures.
{platform.machine()}, {cores()} cores, load in the last minute {load}: below 1 the machine is quiet; a busy one lowers
the speeds, less so the shares. Two threads are measured by the clock, all else by the processor's time.

| what | ticks/s | steps/s | share of the bare kernel | steps/s, two threads |
|---|---|---|---|---|
{rows}

{MANY:,} worlds of our levels take {memory_of(MANY) / 2**20:,.0f} MiB.
"""


def main() -> None:
    """Write the table; save the chart."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, help="where the chart goes")
    parser.add_argument("--table", type=Path, default=RESULTS / "learning-speed.md", help="where the table goes")
    options = parser.parse_args()
    options.table.write_text(table(), "utf-8")
    print(options.table.read_text("utf-8"))
    if options.folder:
        against_worlds().save(options.folder)


if __name__ == "__main__":
    main()
