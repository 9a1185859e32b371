"""Make the solver's table: the reference levels of episodes 00, 10, ... 90 and our own, each for some seconds.

    python3 tools/dev.py tool measure.solver_table results.jsonl --seconds 60
    python3 tools/dev.py tool measure.solver_table results.jsonl --table

``--reference``: only the reference levels. ``--cpu``: the seconds are those of a core's work, for a machine that does
other things too: with two jobs a level gets twice as many seconds of CPU time. Results are appended to a file of JSON
lines after each level; levels that are in it are not solved again, so a long run can be interrupted. ``--table``
prints Markdown of a file.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.search.solve import Progress, Task, compile_solver, solve
from ninja_game.search.task import WORK_PER_SECOND
from tools import ROOT

EPISODES = ("00", "10", "20", "30", "40", "50", "60", "70", "80", "90")


def tasks(arguments: argparse.Namespace) -> Iterator[tuple[str, Task]]:
    """Name and task of everything in the table."""
    from tests.support.reference import levels

    work = int(arguments.seconds * WORK_PER_SECOND) if arguments.cpu else 0
    base = {"seconds": arguments.seconds, "jobs": arguments.jobs, "work": work}
    for path in sorted((ROOT / "levels").glob("*.txt")) if not arguments.reference else ():
        own = replace(Task(load_levels(path)[0].level), **base)
        yield path.stem, replace(own, seconds=min(30.0, arguments.seconds))
    for level in levels():
        if level.label.split("-")[0] in EPISODES:
            yield level.label, Task(parse_level_string(level.data), **base)


def people(source: str) -> dict[str, int]:
    """End tick of the shortest speedrun of a source on each level."""
    from tests.support.reference import recordings

    best: dict[str, int] = {}
    for run in recordings():
        if run.source == source and run.kind == "speedrun":
            best[run.label] = min(run.end_tick, best.get(run.label, run.end_tick))
    return best


def solve_all(arguments: argparse.Namespace) -> None:
    """Solve what is not in the file yet."""
    compile_solver()
    done = {row["level"] for row in rows(arguments.file)}
    for name, task in tasks(arguments):
        if name in done or (arguments.only and name not in arguments.only.split(",")):
            continue
        found: list[float] = []
        began, cpu = time.monotonic(), time.process_time()
        stop = Event()
        late = partial(_stop_when_late, stop, cpu + task.seconds * task.jobs) if arguments.cpu else None
        run = solve(task, on_better=partial(_note, found, began), report=late, stop=stop)
        row: dict[str, Any] = {"level": name, "end_tick": run.end_tick if run else -1, "seconds": task.seconds}
        row["cpu_s"] = round(time.process_time() - cpu, 1)
        row |= {"first_s": round(found[0], 2) if found else -1, "last_s": round(found[-1], 2) if found else -1}
        with arguments.file.open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        print(row, people("rta").get(name), flush=True)


def _stop_when_late(stop: Event, until: float, _: Progress) -> None:
    """End a search that has had its CPU time."""
    if time.process_time() > until:
        stop.set()


def _note(found: list[float], began: float, _: Replay) -> None:
    """Note after how many seconds a better run was found."""
    found.append(time.monotonic() - began)


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
    """Read the command line and do it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path, help="results, one JSON object a line")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--cpu", action="store_true", help="seconds of CPU time a job")
    parser.add_argument("--reference", action="store_true", help="only the reference levels, none of ours")
    parser.add_argument("--only", default="", metavar="NAMES", help="only these levels, with commas between")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    if arguments.table:
        print_table(arguments.file)
    else:
        solve_all(arguments)


if __name__ == "__main__":
    main()
