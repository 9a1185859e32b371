"""Measure the TAS editor with a run of 4,000 ticks: the time from an edit to its picture, and the memory of many edits.

    python3 tools/dev.py tool measure.tas_edits --edits 300
    python3 tools/dev.py tool measure.tas_edits --plain
    python3 tools/dev.py tool measure.tas_edits --memory 10000

The first two print, for windows of 792 x 600, 1920 x 1080 and 2560 x 1440, how long edits of each sort take, made by
keys and mouse at random places of a level of median size: from the event to the finished picture, without a display.
The third makes so many edits, one of ten in a window, takes all of them back, and prints the peak of the memory. Exit
code 1: above 16 ms median, 50 ms worst on the compiled memory, 200 ms worst on the plain one, 500 MiB.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from random import Random
from unittest.mock import patch

from ninja_game.files.user_folder import bundled_levels
from ninja_game.formats.load import load_level
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.level import Level

TICKS = 4000
SIZES = ((792, 600), (1920, 1080), (2560, 1440))
MOST_MEDIAN, MOST_WORST, MOST_PLAIN, MOST_MIB = 16.0, 50.0, 200.0, 500.0


def random_keys(seed: int) -> bytes:
    """Keys for 4,000 ticks, each for up to 24 ticks."""
    rng = Random(seed)
    keys: list[int] = []
    while len(keys) < TICKS:
        keys += [rng.choice((0, 1, 2, 1, 2, 5, 6))] * rng.randrange(1, 25)
    return with_press_bits(keys[:TICKS])


def long_run() -> tuple[Level, bytes]:
    """A run that lives for 4,000 ticks, or nearly, in one of our levels with about the median number of objects."""
    levels = sorted(map(load_level, bundled_levels()), key=lambda level: len(level.objects))
    middle = len(levels) // 2
    runs = [(level, random_keys(seed)) for level in levels[middle - 4 : middle + 5] for seed in range(12)]
    return max(runs, key=lambda run: run_level(*run).ticks)


def write_run(folder: Path) -> Path:
    level, inputs = long_run()
    path = folder / "long.replay.txt"
    path.write_text(write_replay(Replay(inputs, len(inputs) - 1, "", name="long", level=level)), "utf-8")
    ended = run_level(level, inputs)
    print(f"{len(level.objects)} objects, {len(inputs)} ticks, {ended.outcome} after {ended.ticks}")
    return path


def percentiles(times: list[float]) -> str:
    """Median, 99th percentile and maximum of some times in ms."""
    times = sorted(times)
    return f"median {times[len(times) // 2]:6.2f}   99 % {times[len(times) * 99 // 100]:6.2f}   max {times[-1]:6.2f} ms"


def edit_times(run: Path, size: tuple[int, int], edits: int, clock: Callable[[], float]) -> dict[str, list[float]]:
    """The longest turn of the program's loop during each of this many edits, ms, by the edit's name."""
    from tests.support.tas_driver import TasDriver
    from tests.support.tas_edits import EDITS, go_at_random

    class Timed(TasDriver):
        worst = 0.0

        def frames(self, count: int = 1, ms: int = 25) -> None:
            for _ in range(count):
                began = clock()
                super().frames(1, ms)
                self.worst = max(self.worst, 1000 * (clock() - began))

    rng = Random(1)
    at = Timed(run.parent / "player", run, size)
    at.frames(20)
    times: dict[str, list[float]] = {name: [] for name in EDITS}
    for number in range(edits):
        name = list(EDITS)[number % len(EDITS)]
        go_at_random(at, rng)
        at.frames(3)
        at.worst = 0.0
        EDITS[name](at, rng)
        times[name].append(at.worst)
    at.session.close()
    at.close()
    return times


def measure_times(run: Path, edits: int, clock: Callable[[], float], *, plain: bool) -> bool:
    """Print the table; whether anything is above its limit."""
    slow = False
    with patch("ninja_game.backend.memories.compiled_available", return_value=False) if plain else nullcontext():
        for size in SIZES:
            times = edit_times(run, size, edits, clock)
            print(f"{size[0]} x {size[1]}, {'plain' if plain else 'compiled'} memory")
            for name, each in times.items():
                print(f"  {name:24} {percentiles(each)}")
            together = sorted(time for each in times.values() for time in each)
            print(f"  {'all':24} {percentiles(together)}", flush=True)
            median, worst = together[len(together) // 2], together[-1]
            slow |= worst > MOST_PLAIN if plain else median > MOST_MEDIAN or worst > MOST_WORST
    return slow


def peak_mib() -> float:
    """The most memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)


def measure_memory(run: Path, edits: int) -> bool:
    """Print the peak of the memory; whether it is above its limit, or an edit could not be taken back."""
    from tests.support.tas_driver import TasDriver
    from tests.support.tas_edits import edit_at_random, use_at_random

    rng = Random(1)
    at = TasDriver(run.parent / "player", run)
    session, first = at.session, at.session.track
    print(f"{peak_mib():7.0f} MiB  opened")
    for number in range(edits):
        if number % 10:
            edit_at_random(session, rng)
        else:
            use_at_random(at, rng)
    print(f"{peak_mib():7.0f} MiB  after {edits} edits")
    undone = 0
    while session.undo():
        undone += 1
    print(f"{peak_mib():7.0f} MiB  after {undone} were taken back")
    back = session.track == first
    session.close()
    at.close()
    return not back or peak_mib() > MOST_MIB


def main() -> int:
    """Exit code 1 for more time, or more memory, than is allowed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--edits", type=int, default=300)
    parser.add_argument("--plain", action="store_true")
    parser.add_argument("--cpu", action="store_true", help="count processor time: the machine is busy")
    parser.add_argument("--memory", type=int, metavar="EDITS")
    options = parser.parse_args()
    os.environ |= {"PYGAME_HIDE_SUPPORT_PROMPT": "1", "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    with tempfile.TemporaryDirectory() as folder:
        run = write_run(Path(folder))
        if options.memory:
            return int(measure_memory(run, options.memory))
        return int(
            measure_times(
                run, options.edits, time.process_time if options.cpu else time.perf_counter, plain=options.plain
            )
        )


if __name__ == "__main__":
    sys.exit(main())
