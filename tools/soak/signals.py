"""Stop every long command at random moments, by Ctrl-C and by SIGTERM: it must end soon and leave nothing.

    python3 tools/dev.py tool soak.signals [--times 20] [--seed 1] [NAME ...]
    python3 tools/dev.py tool soak.signals --starts 500 [--seed 1] [NAME ...]

Ended within two seconds, with exit code 130 or 143, without a process or a temporary file of its own left. --starts:
so many signals in the first second of all commands, however they are started, every tenth with nothing compiled; no
traceback and a line at most. Python's own start, before the first line of the program, is counted apart. Exit code 0:
it was so each time; 1: not, and what was seen is printed.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.support.stopping import COMMANDS, LIMIT, STARTED, ended, left_by, make_work, start
from tools import ROOT

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


PROGRAMS = (
    [str(Path(sys.executable).with_name("ninja-game"))],
    [sys.executable, "-m", "ninja_game"],
    [sys.executable, str(ROOT / "tools" / "dev.py"), "run"],
)
"""How people start it."""

OURS = re.compile(r"File .*(ninja_game/__main__\.py.*in main|ninja_game/(?!__init__|__main__|environments))")
"""A traceback without such a line comes of a time in which no line of ``main`` has run."""


STOPPED = ("ninja-game: interrupted", "ninja-game: terminated")


def is_leaving(pid: int) -> bool:
    """Whether the system takes a process apart already: no signal reaches it any more."""
    try:
        return bool(int(Path(f"/proc/{pid}/stat").read_text("ascii").rpartition(")")[2].split()[6]) & 4)
    except OSError:
        return False


def end_of_a_start(words: list[str], number: signal.Signals, after: float, folder: Path) -> tuple[str, str]:
    """How a program ends that gets a signal so soon, in a word, and what was seen."""
    with start(words, folder) as program:
        time.sleep(after)
        if program.poll() is not None or is_leaving(program.pid):
            program.communicate()
            return "done before", ""
        program.send_signal(number)
        told = program.communicate(timeout=60)[1].decode()
    code, left = program.returncode, left_by(program.pid, folder)
    seen = f"code {code}, left {left}, {told!r}"
    lines = told.splitlines()
    own = all(line.startswith(("ninja-game: ", "Try ")) for line in lines)
    quiet = own and sum(line in STOPPED for line in lines) <= 1
    if number == signal.SIGINT and code in (1, -number) and "Traceback" in told and not OURS.search(told):
        return "Python's own start", seen
    right = code in CODES[number] and not left and quiet
    return ("by the signal itself" if code < 0 else "by the program") if right else "WRONG", seen


def soak_starts(names: Sequence[str], times: int, seed: int, folder: Path) -> int:
    """Stop commands in their first second; how many ended wrongly."""
    rng = random.Random(seed)
    ends: Counter[tuple[str, str]] = Counter()
    for count in range(times):
        name, number, after = names[count % len(names)], rng.choice(list(CODES)), rng.uniform(0, 1)
        with tempfile.TemporaryDirectory() as empty:
            if count % 10 == 9:
                os.environ["NUMBA_CACHE_DIR"] = empty
            words = [*rng.choice(PROGRAMS), *STARTED[name].split()]
            end, seen = end_of_a_start(words, number, after, folder)
            os.environ.pop("NUMBA_CACHE_DIR", None)
        ends[number.name, end] += 1
        if end == "WRONG":
            print(f"{' '.join(words)}: {number.name} after {after:.3f} s: {seen}", flush=True)
    for (number_name, end), times_seen in sorted(ends.items()):
        print(f"{number_name}: {times_seen} {end}")
    return sum(seen for (_, end), seen in ends.items() if end == "WRONG")


def main() -> int:
    """Stop the commands that are named, or all, and print what was found."""
    parser = argparse.ArgumentParser(description="Stop every long command at random moments.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(STARTED)} (default all)")
    parser.add_argument("--starts", type=int, default=0, help="stop so many starts instead, in their first second")
    parser.add_argument("--times", type=int, default=20, help="each command by each signal (default 20)")
    parser.add_argument("--seed", type=int, default=1, help="of the random moments (default 1)")
    options = parser.parse_args()
    # What a shell starts in the background ignores Ctrl-C, and so would all that it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    found = 0
    with tempfile.TemporaryDirectory() as folder:
        make_work(Path(folder), 1500)
        if options.starts:
            found = soak_starts(options.names or list(STARTED), options.starts, options.seed, Path(folder))
        for name in () if options.starts else options.names or COMMANDS:
            for report in wrong(name, options.times, random.Random(options.seed), Path(folder)):
                print(report, flush=True)
                found += 1
    print(f"{found} wrong")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
