"""Stop every long command at random moments, by Ctrl-C and by SIGTERM: it must end soon and leave nothing.

    python3 tools/dev.py tool soak.signals [--times 20] [--seed 1] [NAME ...]

Ended within two seconds, with exit code 130 or 143, without a process or a temporary file of its own left. Exit code 0:
it was so each time; 1: not, and what was seen is printed.
"""

from __future__ import annotations

import argparse
import random
import signal
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.support.stopping import COMMANDS, LIMIT, ended, make_work

CODES = {signal.SIGINT: (130, -signal.SIGINT), signal.SIGTERM: (143, -signal.SIGTERM)}
"""A negative code: the signal came before the program had begun. A shell shows the same number for both."""

EARLIEST, LATEST = 0.2, 4.0
"""Seconds after the start of a command."""


def wrong(name: str, times: int, rng: random.Random, folder: Path) -> Iterator[str]:
    """What was not as it must be, with the longest time as the last line."""
    longest = 0.0
    for number, codes in CODES.items():
        for _ in range(times):
            after = rng.uniform(EARLIEST, LATEST)
            place = f"{name}: {number.name} after {after:.2f} s"
            try:
                code, took, left = ended(COMMANDS[name], number, after, folder, settled=False)
            except AssertionError as error:
                yield f"{place}: {error}"
                continue
            longest = max(longest, took)
            if code not in codes or took > LIMIT or left:
                yield f"{place}: code {code}, {took:.2f} s, left {left}"
    print(f"{name}: {2 * times} times, ended after {longest:.2f} s at most", flush=True)


def main() -> int:
    """Stop the commands that are named, or all, and print what was found."""
    parser = argparse.ArgumentParser(description="Stop every long command at random moments.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(COMMANDS)} (default all)")
    parser.add_argument("--times", type=int, default=20, help="each command by each signal (default 20)")
    parser.add_argument("--seed", type=int, default=1, help="of the random moments (default 1)")
    options = parser.parse_args()
    # What a shell starts in the background ignores Ctrl-C, and so would all that it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    found = 0
    with tempfile.TemporaryDirectory() as folder:
        make_work(Path(folder), 1500)
        for name in options.names or COMMANDS:
            for report in wrong(name, options.times, random.Random(options.seed), Path(folder)):
                print(report, flush=True)
                found += 1
    print(f"{found} wrong")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
