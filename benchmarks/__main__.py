"""Measure how fast the world is on this machine.

    python3 tools/dev.py benchmark [FILE ...] [--quick] [--json]
    python3 tools/dev.py benchmark --record             # appends a row to benchmarks/history
    python3 tools/dev.py benchmark --scaling FOLDER     # how cost grows: every chart of docs/performance.md

Runs the replays of the game, or those in FILE, on both memories; the costs of loading and of save-states are for the
level of median size. Every figure is the median of several rounds on one thread. A row of the history also has batches
on all cores, and a signature of everything that the runs showed. Where the row before was of the same runs and had
another signature, a result has changed: this is reported, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import csv
import json
import platform
import re
import subprocess
import sys
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks import measure_grids, measure_worlds
from benchmarks.charts import Chart
from benchmarks.speed import run_benchmark
from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.runtime import cores

ROOT = Path(__file__).resolve().parent.parent
HISTORY = ROOT / "benchmarks" / "history"

COLUMNS = (
    "date", "commit", "python", "numba", "plain_ticks_per_s", "compiled_ticks_per_s", "batch_ticks_per_s",
    "batch_step_ticks_per_s", "load_us", "save_us", "restore_us", "state_bytes", "recordings", "corpus", "signature",
)  # fmt: skip

ROWS = (
    ("plain_ticks_per_s", "plain memory", "ticks/s"),
    ("compiled_ticks_per_s", "compiled memory", "ticks/s"),
    ("load_us", "load a level, plain", "us"),
    ("save_plain_us", "save a state, plain", "us"),
    ("restore_plain_us", "restore a state, plain", "us"),
    ("load_compiled_us", "load a level, compiled", "us"),
    ("save_us", "save a state, compiled", "us"),
    ("restore_us", "restore a state, compiled", "us"),
    ("state_bytes", "size of a state, compiled", "bytes"),
    ("start_plain_s", "first tick of a process, plain", "s"),
    ("start_compiled_s", "first tick of a process, compiled", "s"),
    ("compile_s", "the same, nothing compiled before", "s"),
)
"""The figures that people are shown: name, meaning, unit."""


def main(words: Sequence[str] | None = None) -> int:
    """Exit code 0, or 1 if a result has changed."""
    form = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser("benchmark", description=__doc__, formatter_class=form)
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help="recordings instead of the game's own")
    parser.add_argument("--quick", action="store_true", help="leave the compile time out, which takes half a minute")
    parser.add_argument("--json", action="store_true", help="one JSON object with all figures, for programs")
    parser.add_argument("--record", action="store_true", help="append a row to the history of machines of this kind")
    parser.add_argument("--history", type=Path, default=HISTORY, metavar="FOLDER", help="where the histories are")
    parser.add_argument("--scaling", type=Path, metavar="FOLDER", help="charts as CSV and pictures; takes minutes")
    parser.add_argument("--only", default="", metavar="WORD", help="only the charts with this in their name")
    options = parser.parse_args(words)
    recordings = [recording for file in options.files or bundled_replays() for recording in load_replays(file)]
    if options.scaling:
        scale(recordings, options.scaling, options.only)
        return 0
    figures = run_benchmark(recordings, compile_time=not (options.quick or options.record))
    if options.json:
        print(json.dumps(figures))
    else:
        show(figures)
    if options.record:
        path = options.history / f"{machine_kind()}.csv"
        unchanged = append(figures | batch_figures(recordings), path)
        print(f"appended to {path.name}", file=sys.stderr)
        if not unchanged:
            print(
                "THE SIGNATURE HAS CHANGED: the same runs show something else than in the row before", file=sys.stderr
            )
            return 1
    return 0


def show(figures: dict[str, Any]) -> None:
    """The figures for people."""
    print(f"{figures['recordings']} recordings, Python {figures['python']}, {figures['machine']}")
    print(f"costs for a level of {figures['objects']} objects")
    for name, meaning, unit in ROWS:
        if figures[name] is not None:
            print(f"  {meaning:<34} {figures[name]:>14,} {unit}")
    print(f"signature of all runs {figures['signature'][:16]}, of what was run {figures['corpus'][:16]}")


def machine_kind() -> str:
    """What figures may be compared: system, processor and number of cores, as a file name; no names of machines."""
    processor = platform.processor() or platform.machine()
    about = Path("/proc/cpuinfo")
    if about.exists():
        found = re.search(r"^model name\s*:\s*(.+)$", about.read_text("utf-8"), re.MULTILINE)
        processor = found[1] if found else processor
    words = f"{platform.system()} {platform.machine()} {processor} {cores()} cores".lower()
    return re.sub(r"[^a-z0-9.]+", "-", words).strip("-")


def commit() -> str:
    """The commit that is checked out, with a + if files differ from it; '' without git."""
    words = ["git", "-C", str(ROOT), "describe", "--always", "--dirty=+", "--exclude=*"]
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()


def batch_figures(recordings: Sequence[Recording]) -> dict[str, Any]:
    """What a row of the history has besides the figures of one thread."""
    found: dict[str, Any] = {"date": datetime.now(UTC).date().isoformat(), "commit": commit()}
    found["numba"] = version("numba")
    for name, alone in (("batch_ticks_per_s", False), ("batch_step_ticks_per_s", True)):
        rounds = [measure_worlds.batch_speed(recordings, measure_worlds.WORLDS, cores(), alone=alone) for _ in range(3)]
        found[name] = round(median(rounds))
    return found


def append(row: dict[str, Any], path: Path) -> bool:
    """Append a row to a history; whether its signature is that of the last row of the same corpus, if there is one."""
    row = {name: row[name] for name in COLUMNS}
    rows: list[dict[str, str]] = []
    if path.exists():
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows([*rows, row])
    same = [old["signature"] for old in rows if old["corpus"] == row["corpus"]]
    return not same or same[-1] == row["signature"]


def scale(recordings: Sequence[Recording], folder: Path, only: str = "") -> list[Chart]:
    """Measure and save the charts of docs/performance.md, or those whose name holds ``only``. Takes some minutes."""
    sources: dict[str, Callable[[], Chart]] = {
        "speed-against-threads": lambda: measure_worlds.threads(recordings),
        "speed-against-worlds": lambda: measure_worlds.worlds(recordings),
        "ninja-query-against-objects": measure_worlds.objects,
        "tick-against-objects": measure_worlds.whole_ticks,
        "memory-against-objects": measure_worlds.memory,
        "ray-against-length": measure_worlds.rays,
        "query-against-objects": measure_grids.queries,
        "pairs-against-objects": measure_grids.pairs,
        "moves-against-objects": measure_grids.moves,
    }
    charts = [source() for name, source in sources.items() if only in name]
    for chart in charts:
        chart.save(folder)
    return charts


if __name__ == "__main__":
    sys.exit(main())
