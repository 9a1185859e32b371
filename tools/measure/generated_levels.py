"""How many seeds give a level, and how fast: `python3 tools/dev.py tool measure.generated_levels --first 500`.

The difficulties 1 to 10 are asked for in turn. Prints one line per seed, then what docs/generator.md says; ``--out``
keeps the levels.
"""

from __future__ import annotations

import argparse
import statistics
import time
from functools import partial
from pathlib import Path
from threading import Event

from ninja_game.files.writing import write_atomically
from ninja_game.generator.generate import EASIEST, HARDEST, generate
from ninja_game.search.solve import compile_solver


def _stop_when_late(stop: Event, until: float, _: str) -> None:
    """End a seed that has had its CPU time."""
    if time.process_time() > until:
        stop.set()


def main() -> None:
    """Read the command line, generate, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--first", type=int, default=500, help="seed")
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--limit", type=float, default=30.0, help="seconds of CPU time a seed")
    parser.add_argument("--out", type=Path, help="folder for the levels")
    arguments = parser.parse_args()
    compile_solver()
    spent, measured = [], dict[int, list[float]]()
    for seed in range(arguments.first, arguments.first + arguments.count):
        wanted = EASIEST + (seed - arguments.first) % HARDEST
        began = time.process_time()
        stop = Event()
        made = generate(seed, wanted, report=partial(_stop_when_late, stop, began + arguments.limit), stop=stop)
        seconds = time.process_time() - began
        good = made is not None and seconds <= arguments.limit
        print(seed, wanted, f"{made.difficulty:.1f} {made.name}" if made else "none", f"{seconds:.1f} s", flush=True)
        if made and good:
            spent.append(seconds)
            measured.setdefault(wanted, []).append(made.difficulty)
            if arguments.out:
                write_atomically(arguments.out / f"{seed}.txt", made.text)
    print(f"{len(spent)} of {arguments.count} certified within {arguments.limit:.0f} s of CPU time; ", end="")
    print(f"{min(spent):.1f} to {max(spent):.1f} s, {statistics.median(spent):.1f} s in the median")
    for wanted, values in sorted(measured.items()):
        print(f"| {wanted} | {statistics.median(values):.1f} | {len(values)} |")


if __name__ == "__main__":
    main()
