"""Work that ends: Ctrl-C and SIGTERM stop every long command, its workers too, and leave nothing half written."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.signals import GRACE, signals_deferred
from tests.support.samples import WALK, WALK_END, running, write_records
from tests.support.slow import the_rest_is_slow
from tests.support.stopping import COMMANDS, ended, make_work

if sys.platform == "win32":
    pytest.skip("signals are another thing there", allow_module_level=True)


@pytest.fixture(scope="module")
def work(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of work for minutes."""
    return make_work(tmp_path_factory.mktemp("work"))


@pytest.mark.parametrize("name", the_rest_is_slow([*COMMANDS], 2))
def test_sigterm_ends_a_command_with_all_its_processes(name: str, work: Path) -> None:
    if not compiled_available() and "memory plain" not in COMMANDS[name]:
        pytest.skip("Numba is not installed")
    code, left = ended(COMMANDS[name], signal.SIGTERM, 1.5, work)
    assert (code, left) == (143, [])


@pytest.mark.parametrize("name", the_rest_is_slow(["verify on processes", "verify in one process", "trace"], 1))
def test_interrupt_ends_a_command_with_all_its_processes(name: str, work: Path) -> None:
    code, left = ended(COMMANDS[name], signal.SIGINT, 1.0, work)
    assert (code, left) == (130, [])


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@pytest.mark.parametrize("name", the_rest_is_slow(["search", "solve", "improve"], 1))
def test_a_command_that_still_compiles_ends_too(
    name: str, work: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    code, left = ended(COMMANDS[name], signal.SIGINT, 1.5, work)
    assert (code, left) == (130, [])


def test_a_command_has_less_than_two_seconds_to_end_by_itself() -> None:
    assert GRACE < 1.5


def test_workers_do_not_outlive_a_killed_parent(work: Path) -> None:
    code, left = ended(COMMANDS["verify on processes"], signal.SIGKILL, 1.5, work)
    assert code == -signal.SIGKILL
    assert "a process" not in left


DEEP = """
import os, signal, sys, time
class Deep:
    def __del__(self): os.kill(os.getpid(), number)
"""
COMPILING = "from ninja_game.signals import end_on_signals; end_on_signals(); number = signal.SIGTERM; Deep()"
SHARING = COMPILING.replace("Deep", "import multiprocessing; lock = multiprocessing.get_context('spawn').Lock(); Deep")
LOADING = """
class Finder:
    def find_spec(name, *_):
        if name == "click": Deep(); time.sleep(300)
number = signal.SIGINT; sys.meta_path.insert(0, Finder)
from ninja_game.__main__ import main
main()
"""
FAILING = """
import ninja_game.cli.main as program
from ninja_game.signals import end_on_signals
def compile_without_a_callback(*_): Deep(); raise RuntimeError("no compiled object yet")
number = signal.SIGTERM; end_on_signals()
program.CommandGroup.invoke = compile_without_a_callback
program.cli.main(["info"])
"""


@pytest.mark.parametrize(
    "code, end",
    [(COMPILING, (143, "terminated")), (SHARING, (143, "terminated")), (LOADING, (130, "interrupted")),
     (FAILING, (143, "terminated"))],
)  # fmt: skip
def test_a_signal_in_the_depths_of_python_is_neither_lost_nor_a_traceback(code: str, end: tuple[int, str]) -> None:
    """As while Numba compiles or a module is loaded, where C calls functions whose exceptions are lost.

    What workers shared has to be cleaned up then, and nobody says so.
    """
    program = [sys.executable, "-c", f"{DEEP}{code}\ntime.sleep(300)"]
    done = subprocess.run(program, capture_output=True, text=True, timeout=200, check=False)
    assert (done.returncode, done.stderr) == (end[0], f"ninja-game: {end[1]}\n")


IN_A_TEXT = """
import os, signal
import ninja_game.cli.main as program
def compiled_from_a_text(*_): exec("os.kill(os.getpid(), signal.SIGINT)\\nwhile True: pass", globals())
program.CommandGroup.invoke = compiled_from_a_text
program.raising.set()
program.main()
"""


def test_an_interrupt_within_a_text_that_python_runs_keeps_the_exit_code(tmp_path: Path) -> None:
    """Python would end `python -m` by the signal then; Numba makes functions of texts."""
    (tmp_path / "interrupted.py").write_text(IN_A_TEXT)
    command, paths = [sys.executable, "-m", "interrupted", "info"], os.pathsep.join([str(tmp_path), *sys.path])
    done = subprocess.run(command, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.strip()) == (130, "ninja-game: interrupted")


MOMENTS = {
    "nothing": ("--help", 400),
    "bad usage": ("fly", 400),
    "a short command": ("info far.txt", 1500),
    "on threads": ("verify walk.replay.txt --memory plain --jobs 2 -q", 15000),
    "with libraries": ("splits walk.replay.txt", 5000),
}
"""A command, and one of how many calls of functions is a moment."""


@pytest.mark.slow
@pytest.mark.parametrize("name", MOMENTS)
@pytest.mark.parametrize("number", ["SIGTERM", "SIGINT"])
def test_a_signal_at_any_moment_ends_the_program_with_a_line_at_most(number: str, name: str, work: Path) -> None:
    """From the first line of the program to the end of its process: no other exit code, no traceback."""
    words, every = MOMENTS[name]
    program = [sys.executable, "-m", "tests.support.stopped_everywhere", number, str(every), *words.split()]
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    done = subprocess.run(program, cwd=work, env=environment, capture_output=True, text=True, timeout=600, check=False)
    ends = done.stdout.splitlines()
    assert len(ends) > 50, done.stderr
    assert [end for end in ends if not end.startswith("right ")] == []


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_that_waits_while_python_starts_ends_the_program(number: signal.Signals) -> None:
    """As tools/dev.py starts it."""
    waiting = f"import os, signal; signal.pthread_sigmask(signal.SIG_BLOCK, [2]); os.kill(os.getpid(), {number:d})"
    start = f"{waiting}; os.execv({sys.executable!r}, [{sys.executable!r}, '-m', 'ninja_game', '--help'])"
    done = subprocess.run([sys.executable, "-c", start], capture_output=True, text=True, timeout=200, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (-number, "", "")


def test_a_signal_waits_until_processes_have_started() -> None:
    done = []
    with pytest.raises(KeyboardInterrupt), signals_deferred():  # noqa: PT012 - it is raised behind the block
        signal.raise_signal(signal.SIGINT)
        done.append("all of it")
    assert done == ["all of it"]
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


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
