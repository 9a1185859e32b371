"""Long commands that are stopped while they work: what they leave, and how soon they end."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from tests.support.samples import replay_of_walk, running, write_records

PATIENCE = 20.0  # seconds in which a command ends, on any machine; the work would go on for minutes
COPIES = 50  # of the archive: what is compiled is quick
FAR = "0" * 713 + "|5^100,566!11^700,30,700,60!0^115,566"  # nothing that the ninja can reach ends a run here

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


def make_work(folder: Path) -> Path:
    """A folder with work for minutes."""
    write_records(folder / "archive.txt", *((f"run {k}", FAR, running(20_000)) for k in range(500)))
    write_records(folder / "long.txt", ("a long run", FAR, running(400_000)))
    (folder / "many").mkdir()
    for number in range(COPIES):
        (folder / "many" / f"{number}.txt").hardlink_to(folder / "archive.txt")
    (folder / "far.txt").write_text(FAR)
    (folder / "walk.replay.txt").write_text(replay_of_walk())
    return folder


def ended(words: str, number: signal.Signals, after: float, folder: Path) -> tuple[int, list[str]]:
    """Exit code, and what is left, of a command that gets a signal ``after`` seconds after it listens to signals.

    It must end within PATIENCE. What it writes for a while goes into the folder ``out``.
    """
    shutil.rmtree(folder / "out", ignore_errors=True)
    (folder / "out").mkdir()
    environment = {**os.environ, "TMPDIR": str(folder / "out"), "NINJA_GAME_HOME": str(folder / "home")}
    with subprocess.Popen(
        [sys.executable, "-m", "ninja_game", *words.split()], cwd=folder, env=environment, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, start_new_session=True,
    ) as running_program:  # fmt: skip
        while not _listens(running_program.pid):
            assert running_program.poll() is None, "it ended at its start"
            time.sleep(0.02)
        time.sleep(after)
        assert running_program.poll() is None, "it was done before the signal came"
        running_program.send_signal(number)
        try:
            _, errors = running_program.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(running_program.pid, signal.SIGKILL)
            raise AssertionError("it did not end") from None
    assert b"Traceback" not in errors, errors.decode()
    return running_program.returncode, _left_by(running_program.pid, folder)


def _left_by(group: int, folder: Path) -> list[str]:
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
