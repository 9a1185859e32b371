"""Make the solver's table: the reference levels of episodes 00, 10, ... 90, each for some seconds of a core's work.

    python3 -m benchmarks.solver_table results.jsonl --seconds 60

With two jobs a level gets twice as many seconds. Results are appended to a file of JSON lines after each level; levels
that are in it are not solved again, so that a long run can be interrupted. In the end all of them are printed as
Markdown. What becomes of our own levels, `ninja-game check` tells.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from functools import cache
from pathlib import Path
from threading import Event
from typing import Any

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.search.solve import compile_solver, solve
from ninja_game.search.task import WORK_PER_SECOND, Progress, Task
from ninja_game.sim.level import Level
from tests.support.reference import levels, recordings

EPISODES = ("00", "10", "20", "30", "40", "50", "60", "70", "80", "90")


@cache
def people(source: str) -> dict[str, int]:
    """End tick of the shortest speedrun of a source on each level."""
    best: dict[str, int] = {}
    for run in recordings():
        if run.source == source and run.kind == "speedrun":
            best[run.label] = min(run.end_tick, best.get(run.label, run.end_tick))
    return best


def solved(level: Level, seconds: float, jobs: int) -> dict[str, Any]:
    """What comes of a level: end tick (-1: none), CPU time used, seconds after which the first run was found."""
    found: list[float] = []
    began, cpu, stop = time.monotonic(), time.process_time(), Event()

    def note(_: Replay) -> None:
        found.append(time.monotonic() - began)

    def stop_when_late(_: Progress) -> None:
        if time.process_time() > cpu + seconds * jobs:
            stop.set()

    task = Task(level, seconds=seconds, jobs=jobs, work=int(seconds * WORK_PER_SECOND))
    run = solve(task, on_better=note, report=stop_when_late, stop=stop)
    return {
        "end_tick": run.end_tick if run else -1,
        "cpu_s": round(time.process_time() - cpu, 1),
        "first_s": round(found[0], 2) if found else -1,
    }


def rows(file: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


def print_table(file: Path) -> None:
    fastest, tas = people("rta"), people("tas")
    print("| level | solver | people | ratio | tool-assisted | first run after, s | CPU used, s |")
    print("|---|---|---|---|---|---|---|")
    ratios = []
    for row in sorted(rows(file), key=lambda row: str(row["level"])):
        name, ticks = row["level"], row["end_tick"]
        ratio = ""
        if ticks >= 0 and name in fastest:
            ratios.append(ticks / fastest[name])
            ratio = f"{ratios[-1]:.3f}"
        shown = ticks if ticks >= 0 else "-"
        cells = (name, shown, fastest.get(name, ""), ratio, tas.get(name, ""), row["first_s"], row["cpu_s"])
        print(f"| {' | '.join(map(str, cells))} |")
    if ratios:
        solved = sum(row["end_tick"] >= 0 for row in rows(file))
        print(f"\nsolved {solved} of {len(rows(file))}; median ratio {statistics.median(ratios):.3f} of {len(ratios)};")
        print(f"below 1.0 on {sum(ratio < 1.0 for ratio in ratios)}, at most 1.0 on {sum(r <= 1.0 for r in ratios)}")


def main() -> None:
    """Solve what is not in the file yet, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path, help="results, one JSON object a line")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    compile_solver()
    done = {row["level"] for row in rows(options.file)}
    for level in levels():
        if level.label.split("-")[0] in EPISODES and level.label not in done:
            row = {"level": level.label} | solved(parse_level_string(level.data), options.seconds, options.jobs)
            with options.file.open("a", encoding="utf-8") as file:
                file.write(json.dumps(row) + "\n")
            print(row, people("rta").get(level.label), flush=True)
    print_table(options.file)


if __name__ == "__main__":
    main()
