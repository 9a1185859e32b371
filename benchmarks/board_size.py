"""What a board of many runs costs: time in all and with one run more, bytes, weight of the pages (docs/board.md).

    nice -n 19 python3 tools/dev.py benchmark board_size 1000 10000
    nice -n 19 python3 tools/dev.py benchmark board_size reference

Runs are certificates of the game's levels with up to ten light edits each, by as many players as there would be if each
had sent twenty; ``reference``: the recordings of people on the levels of the reference instead.
"""

from __future__ import annotations

import argparse
import itertools
import os
import random
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

from ninja_game.files.bundled import bundled_replays, data_folder
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.runs.conversion import replay_texts
from tests.support.near_copies import EDITS, surviving
from tests.support.reference import recordings, write_pack

MAX_EDITS, EACH = 10, 20  # edits of a certificate; runs that a player has sent


def edited(recording: Recording, rng: random.Random) -> Iterator[Replay]:
    """Runs to the exit, each with one edit more than the one before, for ever."""
    ways: set[str] = set()
    while True:
        runs = surviving(recording, lambda keys: rng.choice(list(EDITS.values()))(keys, rng))
        for inputs, run in itertools.islice(runs, MAX_EDITS):
            if run.xy_sha256 not in ways:
                ways.add(run.xy_sha256)
                yield Replay(inputs, run.end_tick, "exit", run.gold, level=recording.level)


def texts() -> Iterator[str]:
    """Replays, for ever, all certificates in turn."""
    rng = random.Random(1)
    turns = [edited(recording, rng) for path in bundled_replays() for recording in load_replays(path)]
    for number in itertools.count():
        replay = next(turns[number % len(turns)])
        yield write_replay(Replay(**vars(replay) | {"author": f"Player {rng.randrange(1 + number // EACH)}"}))


def command(*words: str) -> str:
    """Run `ninja-game board`: how long it took, in words."""
    began = time.monotonic()
    process = subprocess.Popen([sys.executable, "-m", "ninja_game", "board", *words], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    assert status == 0, f"exit code {status}"
    took = time.monotonic() - began
    return f"{used.ru_utime + used.ru_stime:.1f} s ({took:.1f} by the clock, {used.ru_maxrss >> 10} MiB)"


def weigh(site: Path) -> None:
    """Print how many files there are of each kind, and what they weigh."""
    kinds: dict[str, list[int]] = defaultdict(list)
    for path in site.rglob("*.*"):
        folder, stem = path.parent.relative_to(site), path.stem.partition("-")
        list_ = stem[2].rstrip("-0123456789") if folder.name in ("levels", "players") else ""
        name = f"{folder}/{list_}" if list_ or folder.name != "board" else f"board/{stem[0]}"
        kinds[name].append(path.stat().st_size)
    for name, sizes in [*sorted(kinds.items()), ("all", list(itertools.chain(*kinds.values())))]:
        print(f"  {name:24}{len(sizes):8}{sum(sizes) / 1e6:9.1f} MB   largest {max(sizes) / 1e3:7.1f} KB", flush=True)


def measure(folder: Path, found: Iterator[str], count: int, words: list[str]) -> None:
    """Put this many runs into the folder, make the board from nothing, then with one run more."""
    runs, site = folder / "runs", folder / f"site-{count}"
    there = sum(1 for _ in runs.glob("*/*"))
    for number in range(there, count):
        place = runs / f"{number // 1000:03d}" / f"{number:06d}.txt"
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(next(found), "utf-8")
    words = [str(runs), "--site", str(site), "--json", str(folder / f"{count}.json"), *words]
    load = os.getloadavg()[0]
    print(f"{count} runs (load {load:.1f}): all {command(*words, '--again')}", flush=True)
    (runs / "new.txt").write_text(next(found), "utf-8")
    print(f"one more {command(*words)}; none more {command(*words)}", flush=True)
    (runs / "new.txt").unlink()
    weigh(site)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("counts", nargs="+", help="how many runs, ascending, or reference")
    parser.add_argument("--folder", type=Path, help="where runs and pages stay; default: nowhere")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder, found = arguments.folder or Path(temporary), texts()
        if arguments.counts == ["reference"]:
            demos = [f"$run#{row.source}##{row.data}#{row.demo}#" for row in recordings()]
            found = iter([text for demo in demos for text in replay_texts(parse_replays(demo))])
            levels = write_pack(folder / "levels")
            measure(folder, found, len(demos) - 1, ["--levels", str(levels)])
        else:
            for count in map(int, arguments.counts):
                measure(folder, found, count, ["--levels", str(data_folder("levels"))])


if __name__ == "__main__":
    main()
