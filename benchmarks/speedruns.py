"""What the searches make of people's speedruns of the reference: `benchmark speedruns deaths` and `... improve`.

`deaths`: twenty runs go astray by random keys 60 to 250 ticks before their exit, die, and are cut 20 ticks before the
death (`--cut` changes that); then `search --goal won` has 30 s of processor time to lead each to the exit, within 600
ticks. `improve`: thirty runs have a minute of processor time each; `--every 6` takes each sixth of them. Both on one
thread, in seconds of the processor, so that others may work beside. The levels: those with a person's and a
tool-assisted speedrun, in their order; thirty at equal distances, and twenty of the others. Each run has its line at
once; the figures of benchmarks/results/speedruns.md come last.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from functools import cache
from random import Random
from threading import Event

from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.runs.run import run_level
from ninja_game.search.formula.methods import WAY_TICKS, search_span
from ninja_game.search.formula.task import SpanResult, SpanTask
from ninja_game.search.solve import compile_solver, solve
from ninja_game.search.task import WORK_PER_SECOND, Progress, Task
from ninja_game.sim.level import Level
from tests.support.reference import RunRow, recordings

IMPROVED, DYING = 30, 20  # runs of each kind
ASTRAY = 60, 250  # ticks before the exit
LONGEST = 600  # ticks of random keys until the death


@cache
def shortest(source: str) -> dict[str, RunRow]:
    """The shortest speedrun of a source on each level, in the order of the levels."""
    best: dict[str, RunRow] = {}
    for run in sorted(recordings(), key=lambda run: run.label):
        if run.source == source and run.kind == "speedrun":
            best[run.label] = min(run, best.get(run.label, run), key=lambda run: run.end_tick)
    return best


def evenly(labels: list[str], count: int) -> list[str]:
    return [labels[k * len(labels) // count] for k in range(count)]


def both() -> list[str]:
    """The levels with a person's and a tool-assisted speedrun."""
    return [label for label in shortest("rta") if label in shortest("tas")]


def recording(row: RunRow) -> Recording:
    (run,) = parse_replays(f"$run###{row.data}#{row.demo}#")
    return run


def dying(run: Recording, rng: Random) -> tuple[bytes, int]:
    """The run gone astray, and the tick of its death."""
    exit_tick = run_level(run.level, run.inputs, body=run.body).ticks
    while True:
        first = max(0, exit_tick - rng.randint(*ASTRAY))
        keys = bytearray()
        while len(keys) < LONGEST:
            keys += bytes([rng.choice((0, 1, 2, 4, 5, 6))]) * rng.randint(3, 20)
        astray = run.inputs[:first] + bytes(keys)
        played = run_level(run.level, astray, body=run.body)
        if played.outcome == "dead" and played.ticks > first:
            return astray, played.ticks - 1


def seconds_to_exit(level: Level, inputs: bytes, first: int, seconds: float, body: str) -> float | None:
    """Processor time until the exit was reached from a tick of the run on, None without it."""
    began: list[float] = []
    reached: list[float] = []

    def report(_: int, results: tuple[SpanResult, ...]) -> bool:
        now = time.process_time()
        began.append(now)  # the first report comes when all is compiled
        reached.extend([now - began[0]] if results else [])
        return not results and now - began[0] < seconds

    task = SpanTask(level, inputs, first, first + WAY_TICKS, goal="won", body=body)  # type: ignore[arg-type]
    search_span(task, report, threads=1)
    return reached[0] if reached else None


def deaths(options: argparse.Namespace) -> None:
    left = [label for label in both() if label not in evenly(both(), IMPROVED)]
    spent = []
    for label in evenly(left, DYING)[:: options.every]:
        run = recording(shortest("rta")[label])
        inputs, death = dying(run, Random(f"{label} {options.seed}"))
        first = max(0, death - options.cut)
        seconds = seconds_to_exit(run.level, inputs, first, options.seconds or 30.0, run.body)
        spent.append(seconds)
        found = f"after {seconds:.1f} s" if seconds is not None else "no exit"
        print(f"{label}: died in tick {death}, searched from {first}: {found}", flush=True)
    known = sorted(seconds for seconds in spent if seconds is not None)
    times = f", in the middle after {statistics.median(known):.1f} s, at most {known[-1]:.1f} s" if known else ""
    print(f"{len(known)} of {len(spent)} reach the exit{times}")


def improve(options: argparse.Namespace) -> None:
    compile_solver()
    saved = []
    for label in evenly(both(), IMPROVED)[:: options.every]:
        row, stop = shortest("rta")[label], Event()
        run, seconds, began = recording(row), options.seconds or 60.0, time.process_time()

        def stop_when_late(_: Progress, began: float = began, seconds: float = seconds, stop: Event = stop) -> None:
            if time.process_time() > began + seconds:
                stop.set()

        # The time of the task is that of a clock, which counts what others do, too.
        task = Task(
            run.level, body=run.body, first=run.inputs, seconds=20 * seconds, jobs=1, seed=options.seed,
            work=int(seconds * WORK_PER_SECOND),
        )  # fmt: skip
        better = solve(task, report=stop_when_late, stop=stop)
        ticks = better.end_tick if better else row.end_tick
        saved.append(row.end_tick - ticks)
        tas = shortest("tas")[label].end_tick
        print(
            f"{label}: person {row.end_tick}, tool-assisted {tas}, improved to {ticks}, saved {saved[-1]}", flush=True
        )
    shorter = sum(ticks > 0 for ticks in saved)
    print(f"{shorter} of {len(saved)} got shorter, by {statistics.median(saved)} ticks in the median")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["deaths", "improve"])
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every Nth run")
    parser.add_argument("--seconds", type=float, help="of processor time a run [deaths: 30, improve: 60]")
    parser.add_argument("--cut", type=int, default=20, help="ticks before the death")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    {"deaths": deaths, "improve": improve}[options.what](options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
