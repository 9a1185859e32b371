"""Long commands that are stopped while they work: what they leave, and how soon they end."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from tests.support.samples import replay_of_walk, running, write_records

LIMIT = 2.0
"""Seconds in which a command ends, on a machine that is not busy with others."""

PATIENCE = 20.0
"""The same on any machine; the work would go on for minutes."""

COPIES = 50
"""Of the archive: what is compiled is quick."""

FAR = "0" * 713 + "|5^100,566!11^700,30,700,60!0^115,566"
"""Nothing that the ninja can reach ends a run here."""

COMMANDS = {
    "verify on processes": "verify archive.txt --memory plain --jobs 2 -q --report out/report.json --resume out/log",
    "verify in one process": "verify archive.txt --memory plain --jobs 1 --workers threads -q",
    "verify by both memories": "verify archive.txt --memory both --jobs 2 -q",
    "verify on threads": "verify many --memory compiled --jobs 2 -q --report out/report.txt",
    "trace": "trace archive.txt --memory plain --jobs 2 -o out/trace.csv",
    "solve": "solve far.txt --seconds 100 --jobs 2 -o out/run.replay.txt",
    "improve": "improve walk.replay.txt --seconds 100 --jobs 1 -o out/run.replay.txt",
    "search": "search walk.replay.txt --from 0 --to 20 --goal x>9999 --seconds 100 -o out/run.replay.txt",
    "check": "check far.txt --seconds 100 --replays out",
    "play": "play --replay archive.txt --size 132x100",
    "film": "film long.txt -o out/film.gif --to 300000",
    "convert": "convert archive.txt out/replays --to replay",
}

STARTED = COMMANDS | {
    "help": "--help",
    "bad usage": "fly",
    "edit": "edit far.txt --size 132x100",
    "lab": "lab rays --size 132x100",
    "tas": "tas walk.replay.txt --size 132x100",
    "player": "player export out/data.zip",
    "link": "link far.txt",
    "info": "info walk.replay.txt",
    "levels": "levels lint pack",
    "generate": "generate --seed 7 --difficulty 3 -o out/level.txt",
    "record": "record walk.replay.txt -o out/again.replay.txt",
    "splits": "splits walk.replay.txt",
    "compare": "compare walk.replay.txt walk.replay.txt",
    "site": "site out/site",
    "board": "board pack",
}
"""Every command of the program; the short ones may be done before anybody stops them."""


def make_work(folder: Path, runs: int = 500) -> Path:
    """A folder with work for minutes."""
    write_records(folder / "archive.txt", *((f"run {k}", FAR, running(20_000)) for k in range(runs)))
    write_records(folder / "long.txt", ("a long run", FAR, running(400_000)))
    (folder / "many").mkdir()
    for number in range(COPIES):
        (folder / "many" / f"{number}.txt").hardlink_to(folder / "archive.txt")
    (folder / "far.txt").write_text(FAR)
    (folder / "walk.replay.txt").write_text(replay_of_walk())
    (folder / "pack").mkdir()
    (folder / "pack" / "far.txt").write_text(FAR)
    return folder


def start(words: list[str], folder: Path) -> subprocess.Popen[bytes]:
    """A process that leads a group of its own; what it writes for a while goes into the folder ``out``."""
    shutil.rmtree(folder / "out", ignore_errors=True)
    (folder / "out").mkdir()
    environment = {**os.environ, "TMPDIR": str(folder / "out"), "NINJA_GAME_HOME": str(folder / "home")}
    return subprocess.Popen(
        words, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
    )


def ended(
    words: str, number: signal.Signals, after: float, folder: Path, *, settled: bool
) -> tuple[int, float, list[str]]:
    """Exit code, seconds until the end, and what is left, of a command that gets a signal while it works.

    It must end within PATIENCE. ``settled``: ``after`` counts from the moment from which it listens to signals, else
    from its birth.
    """
    with start([sys.executable, "-m", "ninja_game", *words.split()], folder) as running_program:
        while settled and not _listens(running_program.pid):
            assert running_program.poll() is None, "it ended at its start"
            time.sleep(0.02)
        time.sleep(after)
        assert running_program.poll() is None, "it was done before the signal came"
        sent = time.monotonic()
        running_program.send_signal(number)
        try:
            _, errors = running_program.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(running_program.pid, signal.SIGKILL)
            raise AssertionError("it did not end") from None
        took = time.monotonic() - sent
    # Python itself, stopped before the program has begun, leaves a traceback.
    assert b"Traceback" not in errors or (not settled and running_program.returncode < 0), errors.decode()
    return running_program.returncode, took, left_by(running_program.pid, folder)


def left_by(group: int, folder: Path) -> list[str]:
    """What a program has left: temporary files, a process of its group."""
    left = [file.name for file in (folder / "out").rglob("*") if file.name.startswith((".", "tmp"))]
    deadline = time.monotonic() + PATIENCE
    while _group_lives(group):
        if time.monotonic() > deadline:
            os.killpg(group, signal.SIGKILL)
            return [*left, "a process"]
        time.sleep(0.02)
    return left


def _listens(pid: int) -> bool:
    """Whether a program has got so far that it handles SIGTERM itself; where the system does not tell: yes."""
    try:
        about = Path(f"/proc/{pid}/status").read_text("ascii")
    except OSError:
        return True
    caught = next(line.split()[1] for line in about.splitlines() if line.startswith("SigCgt:"))
    return bool(int(caught, 16) >> (signal.SIGTERM - 1) & 1)


def _group_lives(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
