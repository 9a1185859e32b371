"""Measure this machine and append a row to the benchmark history of its kind.

    python3 tools/dev.py tool measure.record_benchmark

A row also has a signature of everything that the measured runs showed. Where the row before was of the same runs and
had another signature, a result has changed: this is said, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import csv
import platform
import re
import subprocess
import sys
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from tools import ROOT

HISTORY = ROOT / "benchmarks" / "history"

COLUMNS = (
    "date", "commit", "python", "numba", "plain_ticks_per_s", "compiled_ticks_per_s", "batch_ticks_per_s",
    "batch_step_ticks_per_s", "load_us", "save_us", "restore_us", "state_bytes", "recordings", "corpus", "signature",
)  # fmt: skip


def machine_kind() -> str:
    """What figures may be compared: system, processor and number of cores, as a file name; no names of machines."""
    from ninja_game.batch.thread_pool import cores

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


def figures() -> dict[str, Any]:
    """A row: what `ninja-game bench` measures, and batches on all cores."""
    from benchmarks.measure_worlds import WORLDS, batch_speed
    from ninja_game.batch.thread_pool import cores
    from ninja_game.files.resources import bundled_replays
    from ninja_game.formats.load import load_replays
    from ninja_game.runs.benchmark import run_benchmark

    recordings = [recording for file in bundled_replays() for recording in load_replays(file)]
    batch = [batch_speed(recordings, WORLDS, cores()) for _ in range(3)]
    steps = [batch_speed(recordings, WORLDS, cores(), alone=True) for _ in range(3)]
    return run_benchmark(recordings, compile_time=False) | {
        "date": datetime.now(UTC).date().isoformat(),
        "commit": commit(),
        "numba": version("numba"),
        "batch_ticks_per_s": round(median(batch)),
        "batch_step_ticks_per_s": round(median(steps)),
    }


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


def main() -> int:
    """Exit code 0, or 1 if a result has changed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, default=HISTORY, help="where the histories are")
    path = parser.parse_args().folder / f"{machine_kind()}.csv"
    start = perf_counter()
    row = figures()
    unchanged = append(row, path)
    for name in COLUMNS:
        print(f"{name:<24} {row[name]}")
    print(f"appended to {path.name} after {perf_counter() - start:.0f} s")
    if not unchanged:
        print("THE SIGNATURE HAS CHANGED: the same runs now show something else than when the last row was measured.")
    return 0 if unchanged else 1


if __name__ == "__main__":
    sys.exit(main())
