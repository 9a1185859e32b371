"""Verify a folder of many replays; `verify` is killed on the way and resumes.

    python3 tools/dev.py tool soak.resumed_verify --count 100000

Makes the folder from the recordings of a file (by default the bundled replays) again and again, starts `ninja-game
verify` on it, kills that after some seconds, lets another one resume, and reports time, peak memory and whether every
recording was counted once.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tools import ROOT

FOLDER_SIZE = 1000


def make_archive(folder: Path, count: int, source: Path | None) -> None:
    """``count`` files of one recording each, a thousand a folder, every 997th broken."""
    from ninja_game.files.user_folder import bundled_replays
    from ninja_game.formats.load import load_replays
    from ninja_game.formats.n14.level_file import read_level_file
    from ninja_game.formats.replay.text import write_replay

    if source:
        records = read_level_file(source.read_text("utf-8"))
        texts = [f"${record.name}###{record.level}#{record.demo}#\n" for record in records]
    else:
        runs = [recording for file in bundled_replays() for recording in load_replays(file)]
        texts = [
            write_replay(type(run.replay)(**vars(run.replay) | {"level": run.level, "level_path": ""}))
            for run in runs
            if run.replay
        ]
    for number in range(count):
        path = folder / f"{number // FOLDER_SIZE:03}" / f"{number:06}.txt"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("$broken#" if number % 997 == 996 else texts[number % len(texts)], "utf-8")


def run(words: list[str], kill_after: float) -> tuple[int, float, float]:
    """Exit code, seconds and peak memory (MiB) of a program, killed after this many seconds if there are any."""
    start = time.monotonic()
    process = subprocess.Popen(words, cwd=ROOT, stderr=subprocess.DEVNULL)
    while kill_after and process.poll() is None:
        if time.monotonic() - start > kill_after:
            process.send_signal(signal.SIGKILL)
            break
        time.sleep(0.05)
    _, status, usage = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), time.monotonic() - start, usage.ru_maxrss / 1024


def main() -> int:
    """Exit code 0 if every recording was counted once, else 1."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--source", type=Path, help="a file of $name#author#comment#level#demo# records")
    parser.add_argument("--kill-after", type=float, default=10.0, metavar="SECONDS")
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="soak"))
    try:
        make_archive(folder / "archive", options.count, options.source)
        print(f"{options.count} files made", flush=True)
        report = folder / "report.json"
        words = [sys.executable, "-m", "ninja_game", "verify", str(folder / "archive"), "-q"]
        words += ["--resume", str(folder / "log"), "--report", str(report)]
        for kill_after in (options.kill_after, 0.0):
            code, seconds, memory = run(words, kill_after)
            print(f"exit code {code} after {seconds:.1f} s, at most {memory:.0f} MiB", flush=True)
        summary = json.loads(report.read_text("utf-8"))["summary"]
        print(json.dumps(summary))
        broken = options.count // 997
        good = summary["recordings"] == options.count - broken and summary["unreadable"] == broken
        print("every recording counted once" if good else "SOME ARE MISSING OR COUNTED TWICE")
        return 0 if good else 1
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    sys.exit(main())
