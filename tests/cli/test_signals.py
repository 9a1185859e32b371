"""Work that ends: Ctrl-C and SIGTERM stop every long command, its workers too, and leave nothing half written."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from ninja_game.compile_cache import compiled_available
from ninja_game.runs import benchmark
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records

if sys.platform == "win32":
    pytest.skip("signals are another thing there", allow_module_level=True)

LIMIT = 2.0
"""Seconds."""

FAR = "0" * 713 + "|5^100,566!11^700,30,700,60!0^115,566"
"""Nothing that the ninja can reach ends a run here."""

COMMANDS = {
    "verify on processes": "verify archive.txt --memory plain --jobs 2 -q --report out/report.json --resume out/log",
    "verify in one process": "verify archive.txt --memory plain --jobs 1 --workers threads -q",
    "verify by both memories": "verify archive.txt --memory both --jobs 2 -q",
    "verify on threads": "verify archive.txt --memory compiled --jobs 2 -q --report out/report.txt",
    "trace": "trace archive.txt --memory plain --jobs 2 -o out/trace.csv",
    "solve": "solve far.txt --seconds 100 --jobs 2 -o out/run.replay.txt",
    "improve": "improve walk.replay.txt --seconds 100 --jobs 1 -o out/run.replay.txt",
    "check": "check far.txt --seconds 100 --replays out",
    "bench": "bench walk.replay.txt",
    "play": "play --replay archive.txt --size 132x100",
    "export": "export archive.txt -o out/film.gif",
}


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of work for minutes."""
    folder = tmp_path_factory.mktemp("work")
    write_records(folder / "archive.txt", *((f"run {k}", FAR, running(20_000)) for k in range(500)))
    (folder / "far.txt").write_text(FAR)
    (folder / "walk.replay.txt").write_text(replay_of_walk())
    return folder


def ended(words: str, number: signal.Signals, after: float, folder: Path) -> tuple[int, float, list[str]]:
    """Exit code, seconds until the end, and what is left, of a command that gets a signal while it works."""
    (folder / "out").mkdir(exist_ok=True)
    for file in (folder / "out").iterdir():
        file.unlink()
    program = [sys.executable, "-m", "ninja_game", *words.split()]
    environment = {**os.environ, "TMPDIR": str(folder / "out"), "NINJA_GAME_HOME": str(folder / "home")}
    with subprocess.Popen(
        program, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True
    ) as running_program:
        time.sleep(after)
        assert running_program.poll() is None, "it was done before the signal came"
        start = time.monotonic()
        running_program.send_signal(number)
        _, errors = running_program.communicate(timeout=60)
        took = time.monotonic() - start
    assert b"Traceback" not in errors, errors.decode()
    left = [file.name for file in (folder / "out").iterdir() if file.name.startswith((".", "tmp"))]
    deadline = time.monotonic() + LIMIT
    while _group_lives(running_program.pid):
        if time.monotonic() > deadline:
            os.killpg(running_program.pid, signal.SIGKILL)
            left.append("a process")
            break
        time.sleep(0.02)
    return running_program.returncode, took, left


def _group_lives(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.parametrize("name", COMMANDS)
def test_sigterm_ends_a_command_with_all_its_processes(name: str, work: Path) -> None:
    if not compiled_available() and "memory plain" not in COMMANDS[name]:
        pytest.skip("Numba is not installed")
    code, took, left = ended(COMMANDS[name], signal.SIGTERM, 2.5, work)
    assert (code, left) == (143, [])
    assert took < LIMIT


@pytest.mark.parametrize("name", ["verify on processes", "verify in one process", "trace"])
def test_interrupt_ends_a_command_with_all_its_processes(name: str, work: Path) -> None:
    code, took, left = ended(COMMANDS[name], signal.SIGINT, 1.5, work)
    assert (code, left) == (130, [])
    assert took < LIMIT


def test_workers_do_not_outlive_a_killed_parent(work: Path) -> None:
    code, _, left = ended(COMMANDS["verify on processes"], signal.SIGKILL, 2.5, work)
    assert code == -signal.SIGKILL
    assert "a process" not in left


# --- nothing of the current folder runs ---

POISON = "import os, pathlib\npathlib.Path(os.environ['POISONED']).touch()\nos._exit(99)\n"
DOORS = {
    "python -m": "info walk.txt",
    "verify on processes": "verify walk.txt --memory plain --workers processes --jobs 2 -q",
    "trace on processes": "trace walk.txt --memory plain --jobs 2 --digests",
}


def poison(folder: Path, *more: str) -> None:
    """Put modules into a folder that leave a mark where they are imported."""
    for name in ("numpy", "socket", "click", "numba", "multiprocessing", "platformdirs", "rich", "struct", *more):
        (folder / f"{name}.py").write_text(POISON)


@pytest.mark.parametrize("door", DOORS)
def test_nothing_that_lies_in_the_current_folder_is_imported(door: str, tmp_path: Path) -> None:
    write_records(tmp_path / "walk.txt", *((f"run {k}", WALK, running(WALK_END)) for k in range(200)))
    if door == "python -m":
        poison(tmp_path)
        program = [sys.executable, "-m", "ninja_game"]
    else:
        poison(tmp_path, "ninja_game")
        program = [str(Path(sys.executable).with_name("ninja-game"))]
    environment = {name: value for name, value in os.environ.items() if name not in {"PYTHONSAFEPATH", "PYTHONPATH"}}
    done = subprocess.run(
        [*program, *DOORS[door].split()], cwd=tmp_path, env={**environment, "POISONED": str(tmp_path / "poisoned")},
        capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert not (tmp_path / "poisoned").exists(), done.stderr
    assert done.returncode == 0, done.stderr


def test_the_processes_that_bench_measures_import_nothing_of_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    poison(tmp_path, "ninja_game")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("POISONED", str(tmp_path / "poisoned"))
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    assert benchmark._first_tick("plain") > 0
    assert not (tmp_path / "poisoned").exists()
