"""How often `search --goal won` finds the exit from runs that end before it: people's speedruns, their last ticks cut.

    python3 tools/dev.py tool measure.reach_exit --seconds 30

Of the reference levels with a person's speedrun, ``--runs`` at equal distances; of each the shortest, without its last
40 to 100 (``--cut``) ticks, and twice as many to be searched. ``--seconds``: processor time of each, on one thread.
"""

from __future__ import annotations

import argparse
import time

from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.search.formula.methods import search_span
from ninja_game.search.formula.task import Found, SpanTask


def tasks(count: int, fewest: int, most: int) -> list[tuple[str, int, SpanTask]]:
    """Label, the tick of the exit contact of the whole run, and the search."""
    from tests.support.reference import RunRow, recordings

    best: dict[str, RunRow] = {}
    for run in recordings():
        known = best.get(run.label)
        if (run.source, run.kind) == ("rta", "speedrun") and (known is None or run.end_tick < known.end_tick):
            best[run.label] = run
    labels = sorted(label for label in best if best[label].end_tick > 2 * most)
    found = []
    for number in range(count):
        run = best[labels[number * len(labels) // count]]
        cut = fewest + (most - fewest) * number // max(1, count - 1)
        first = run.end_tick - cut
        inputs = parse_demo(run.demo).inputs[:first]
        level = parse_level_string(run.data)
        found.append((run.label, run.end_tick, SpanTask(level, inputs, first, first + 2 * cut, goal="won")))
    return found


def reached(task: SpanTask, seconds: float) -> tuple[int, float, int]:
    """The tick of the exit contact (-1: none), the processor time until the first one, ticks simulated."""
    began: list[float] = []
    first: list[float] = []
    total = [0]

    def report(ticks: int, found: tuple[Found, ...]) -> bool:
        now = time.process_time()
        if not began:
            began.append(now)
        if found and not first:
            first.append(now - began[0])
        total[0] = ticks
        return not found and now - began[0] < seconds

    found = search_span(task, report, threads=1)
    return (task.first + found[0].ticks - 1 if found else -1), (first[0] if first else -1.0), total[0]


def main() -> None:
    """Read the command line and do it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--cut", type=int, nargs=2, default=(40, 100), metavar="TICKS")
    parser.add_argument("--only", default="", metavar="LABELS")
    arguments = parser.parse_args()
    heads = "level", "cut ticks", "exit of the person", "exit found", "first after, s", "million ticks"
    print(f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}")
    count = 0
    for label, end, task in tasks(arguments.runs, *arguments.cut):
        if arguments.only and label not in arguments.only.split(","):
            continue
        tick, after, ticks = reached(task, arguments.seconds)
        count += tick >= 0
        cells = label, end - task.first, end, tick if tick >= 0 else "-", f"{after:.1f}" if after >= 0 else "-"
        print(f"| {' | '.join(map(str, cells))} | {ticks / 1e6:.1f} |", flush=True)
    print(f"\n{count} of {arguments.runs} reach the exit")


if __name__ == "__main__":
    main()
