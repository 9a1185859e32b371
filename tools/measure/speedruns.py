"""Shorten thirty people's speedruns and compare them with tool-assisted ones: the table of docs/speedruns.md.

    python3 tools/dev.py tool measure.speedruns new.jsonl
    python3 tools/dev.py tool measure.speedruns --table new.jsonl old.jsonl

The thirty: of the reference levels, in their order, that have both a person's and a tool-assisted speedrun to the exit,
30 at equal distances; of each level the person's shortest. A run gets ``--cpu`` seconds of CPU time (120: a minute
on two cores), however busy the machine is. Rows are appended to the file one by one, and what is in it is not done
again. Each row has the whole course: after how many CPU seconds the run had how many ticks.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any

from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.search.solve import Progress, Task, compile_solver, solve
from tests.support.reference import RunRow, recordings

COUNT = 30


def chosen() -> list[tuple[RunRow, RunRow]]:
    """A person's speedrun and the shortest tool-assisted one of the same level, thirty times."""
    best: dict[tuple[str, str, str], RunRow] = {}
    for run in recordings():
        key = (run.label, run.data, run.source)
        if run.kind == "speedrun" and (key not in best or run.end_tick < best[key].end_tick):
            best[key] = run
    pairs = [
        (run, best[label, data, "tas"])
        for (label, data, source), run in sorted(best.items())
        if source == "rta" and (label, data, "tas") in best
    ]
    return [pairs[index * len(pairs) // COUNT] for index in range(COUNT)]


def shorten_all(arguments: argparse.Namespace) -> None:
    """Shorten what is not in the file yet."""
    compile_solver()
    done = {row["level"] for row in rows(arguments.files[0])}
    for person, tas in chosen():
        if person.label in done or (arguments.only and person.label not in arguments.only.split(",")):
            continue
        first = parse_demo(person.demo).playback(person.ticks)
        seconds = arguments.cpu / arguments.jobs
        task = Task(parse_level_string(person.data), first=first, jobs=arguments.jobs, seconds=10 * seconds + 60)
        course: list[tuple[float, int]] = []
        stop = Event()
        start = time.process_time()
        run = solve(
            task, on_better=partial(_note, course, start), report=partial(_stop_when_late, stop, start + arguments.cpu),
            stop=stop,
        )  # fmt: skip
        assert run is not None
        row = {"level": person.label, "person": person.end_tick, "tas": tas.end_tick, "end_tick": run.end_tick}
        row |= {"cpu_s": round(time.process_time() - start, 1), "course": course}
        with arguments.files[0].open("a", encoding="utf-8") as file:
            file.write(json.dumps(row) + "\n")
        print(row, flush=True)


def _stop_when_late(stop: Event, until: float, _: Progress) -> None:
    """End a search that has had its CPU time."""
    if time.process_time() > until:
        stop.set()


def _note(course: list[tuple[float, int]], start: float, run: Replay) -> None:
    """Note after how much CPU time a better run was found."""
    course.append((round(time.process_time() - start, 1), run.end_tick))


def rows(file: Path) -> list[dict[str, Any]]:
    """The results in a file."""
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


def reached(row: dict[str, Any], seconds: float) -> int:
    """The end tick after so many CPU seconds."""
    return min(int(ticks) for cpu, ticks in row["course"] if cpu <= seconds or ticks == row["person"])


def print_table(files: list[Path], seconds: float) -> None:
    """The results as Markdown; those of a second file beside them."""
    tables = [{row["level"]: row for row in rows(file)} for file in files]
    names = [name for name in tables[0] if all(name in table for table in tables)]
    print("| level | person | tool-assisted | improved to | saved |" + " before | saved before |" * (len(files) - 1))
    print("|---|---|---|---|---|" + "---|---|" * (len(files) - 1))
    saved: list[list[int]] = [[] for _ in files]
    for name in names:
        row = tables[0][name]
        cells = [name, row["person"], row["tas"]]
        for table, list_ in zip(tables, saved, strict=True):
            ticks = reached(table[name], seconds)
            list_.append(row["person"] - ticks)
            cells += [ticks, list_[-1]]
        print(f"| {' | '.join(map(str, cells))} |")
    print()
    for file, list_ in zip(files, saved, strict=True):
        gaps = [tables[0][name]["person"] - tables[0][name]["tas"] for name in names]
        at_most = sum(saving >= gap for saving, gap in zip(list_, gaps, strict=True))
        print(
            f"{file.stem}: {sum(saving > 0 for saving in list_)} of {len(names)} shorter, median saving "
            f"{statistics.median(list_):g} ticks, mean {statistics.mean(list_):.1f}, "
            f"{at_most} at or below the tool-assisted length"
        )


def main() -> None:
    """Read the command line and do it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", type=Path, nargs="+", help="results, one JSON object a line")
    parser.add_argument("--cpu", type=float, default=120.0, metavar="SECONDS", help="CPU time a run")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="", metavar="NAMES", help="only these levels, with commas between")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    if arguments.table:
        print_table(arguments.files, arguments.cpu)
    else:
        shorten_all(arguments)


if __name__ == "__main__":
    main()
