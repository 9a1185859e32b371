"""Find which variation of each number of the levels without end can be passed, and write the table.

    dev.py tool bench_levels

The run that is known is played in the varied level by the world itself; where it does not pass, the next variation of
the same number is tried. It takes some minutes. `--check 2000` plays a sample of the table's levels instead.
"""

import argparse
import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np

from ninja_game.backend.memories import open_worlds
from ninja_game.files.bundled import data_folder
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.learn.levels.bench import BENCH_TABLE, BENCH_TRIES, COUNTS, BenchLevel, bench_level
from ninja_game.sim.states import OUTCOME_EXIT

MIN_TICKS = 20  # ticks: what is passed sooner is no level


def passes(found: BenchLevel) -> bool:
    """Whether the known run passes, and not at once."""
    worlds = open_worlds("auto", found.level, box=False)
    worlds.run(found.inputs)
    return worlds.outcome() == OUTCOME_EXIT and worlds.tick() >= MIN_TICKS


def chosen(split: str, number: int) -> tuple[int, str]:
    """The first try that passes, and the digest of its level."""
    for attempt in range(BENCH_TRIES):
        found = bench_level(split, number, attempt)
        if passes(found):
            return attempt, level_digest(found.level)
    raise SystemExit(f"no variation of {split} {number} passes")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", type=int, metavar="N", help="play N levels, drawn at random, and write nothing")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    if options.check:
        rng = np.random.default_rng(0)
        passed = Counter[str]()
        for _ in range(options.check):
            split = "test" if rng.random() < 0.1 else "train"
            found = bench_level(split, int(rng.integers(COUNTS[split])))
            passed[f"{split}:{found.grade} {'passed' if passes(found) else 'FAILED'}"] += 1
        print(*sorted(passed.items()), sep="\n")
        sys.exit(any("FAILED" in key for key in passed))
    table, digests = bytearray(), dict[str, list[str]]()
    with ProcessPoolExecutor(options.jobs) as pool:
        for split, count in COUNTS.items():
            every = list(pool.map(partial(chosen, split), range(count), chunksize=500))
            table += bytes(attempt for attempt, _ in every)
            digests[split] = [digest for _, digest in every]
            tries = Counter(attempt for attempt, _ in every)
            print(split, count, "levels,", len(set(digests[split])), "different; tries:", sorted(tries.items()))
    both = set(digests["train"]) & set(digests["test"])
    print(len(both), "levels in both")
    (data_folder("assets") / BENCH_TABLE).write_bytes(table)


if __name__ == "__main__":
    main()
