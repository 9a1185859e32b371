"""A verdict depends on the run, the level and the rules: the environment and the current folder change nothing.

Real processes, each under one odd setting; what they print is compared byte for byte with that of an ordinary one.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from ninja_game.backend import kernel_cache
from ninja_game.backend.memories import compiled_available
from ninja_game.backend.numba_import import HONOURED
from tests.support.samples import SPIKED, WALK, replay_of_walk, running, write_records
from tests.support.slow import the_rest_is_slow

PROGRAM = Path(sys.executable).with_name("ninja-game")
MODULES = (
    "ninja_game", "numba", "numpy", "yaml", "click", "llvmlite", "json", "hashlib", "struct", "math", "re",
    "encodings", "sitecustomize", "usercustomize", "resource", "sim", "verification", "backend",
)  # fmt: skip

YAML = {
    "features that this world needs taken away": 'cpu_features: "-sse2,-sse"',
    "another processor, and no compiler": "cpu_name: generic\ndisable_jit: 1",
    "no threads": "num_threads: 0",
    "a broken file": "[",
    "no table": "a word",
    "other checks and optimizations": "boundscheck: 1\nopt: 0\nslp_vectorize: 1\nenable_avx: 0",
    "a file that Numba would write": "chrome_trace: written.json",
}
NUMBA = {
    "features": {"NUMBA_CPU_FEATURES": "-sse2,-sse"},
    "no processor": {"NUMBA_CPU_NAME": "generic"},
    "optimizer": {"NUMBA_OPT": "0", "NUMBA_SLP_VECTORIZE": "1", "NUMBA_LOOP_VECTORIZE": "0", "NUMBA_ENABLE_AVX": "0"},
    "no threads": {"NUMBA_NUM_THREADS": "0"},
    "unknown optimizer, debugging": {"NUMBA_OPT": "junk", "NUMBA_DEBUG": "1", "NUMBA_BOUNDSCHECK": "0"},
    "a file": {"NUMBA_CHROME_TRACE": "written.json", "NUMBA_DUMP_HTML": "written.html"},
    "switched off": {"NUMBA_DISABLE_JIT": "1"},
    "profiler, another device": {
        "VS_PROFILER": "1",
        "NUMBA_ENABLE_CUDASIM": "1",
        "LLVMLITE_ENABLE_IR_LAYER_TYPED_POINTERS": "0",
    },
    "features of NumPy": {"NPY_DISABLE_CPU_FEATURES": "SSE2"},
    "more of NumPy": {"NPY_ENABLE_CPU_FEATURES": "JUNK", "NUMPY_MADVISE_HUGEPAGE": "junk"},
    "threads of libraries": {"OMP_NUM_THREADS": "0", "MKL_NUM_THREADS": "x", "OPENBLAS_CORETYPE": "Prescott"},
    "features of the C library": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX"},
    "memory with rubbish in it": {"MALLOC_PERTURB_": "165"},
    "checks": {"NINJA_GAME_CHECKED": "1"},
}
PLAIN = {
    "hash seed": {"PYTHONHASHSEED": "4242"},
    "no assertions": {"PYTHONOPTIMIZE": "2"},
    "developers": {"PYTHONDEVMODE": "1"},
    "warnings": {"PYTHONWARNINGS": "error"},
    "UTF-8": {"PYTHONUTF8": "0", "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0"},
    "another encoding": {"PYTHONIOENCODING": "latin-1"},
    "a start-up file": {"PYTHONSTARTUP": "json.py"},
    "a path that is nowhere": {"PYTHONPATH": "/nowhere/numpy:/nowhere/ninja_game"},
    "short numbers": {"PYTHONINTMAXSTRDIGITS": "640"},
    "no bytecode": {"PYTHONDONTWRITEBYTECODE": "1", "PYTHONNODEBUGRANGES": "1"},
    "Turkish": {"LC_ALL": "tr_TR.UTF-8", "LANGUAGE": "tr"},
    "German": {"LC_ALL": "de_DE.UTF-8", "LC_NUMERIC": "de_DE.UTF-8"},
    "no such language": {"LC_ALL": "xx_XX"},
    "time zone": {"TZ": "Pacific/Apia", "SOURCE_DATE_EPOCH": "1"},
    "terminal": {"TERM": "junk", "COLUMNS": "1", "FORCE_COLOR": "1", "NO_COLOR": ""},
    "NumPy is not asked": {"NPY_DISABLE_CPU_FEATURES": "SSE2", "NUMBA_OPT": "junk"},
}


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Runs that reach the exit, die, claim what is so, and claim what is not."""
    folder = tmp_path_factory.mktemp("runs")
    write_records(folder / "a.txt", ("Walk", WALK, running(60)), ("Mine", SPIKED, running(60)))
    (folder / "b.replay.txt").write_text(replay_of_walk())
    (folder / "c.replay.txt").write_text(replay_of_walk(gold=7))
    return folder


@cache
def ordinary(runs: Path, memory: str) -> tuple[bytes, int]:
    """What is printed, and the exit code, where nothing is odd."""
    return judged(runs, memory, runs, {})


def judged(runs: Path, memory: str, here: Path, settings: dict[str, str]) -> tuple[bytes, int]:
    """What `verify` prints, and its exit code, started in a folder with settings of its own."""
    kept = {name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "PYTHONSAFEPATH"}}
    words = [str(PROGRAM), "verify", str(runs), "--json", "--memory", memory]
    done = subprocess.run(words, cwd=here, env=kept | settings, capture_output=True, check=False)
    return done.stdout, done.returncode


def require(memory: str) -> None:
    if not PROGRAM.exists() or (memory == "compiled" and not compiled_available()):
        pytest.skip("the program, or Numba, is not installed")


@pytest.mark.parametrize("text", the_rest_is_slow(YAML, 1))
def test_a_file_of_settings_in_the_current_folder_has_no_power(text: str, runs: Path, tmp_path: Path) -> None:
    require("compiled")
    (tmp_path / ".numba_config.yaml").write_text(text)
    assert judged(runs, "compiled", tmp_path, {}) == ordinary(runs, "compiled")
    assert [path.name for path in tmp_path.iterdir()] == [".numba_config.yaml"]


@pytest.mark.parametrize("settings", the_rest_is_slow(NUMBA, 1))
def test_variables_that_compilers_and_libraries_read_have_no_power(
    settings: dict[str, str], runs: Path, tmp_path: Path
) -> None:
    require("compiled")
    memory = "auto" if "NUMBA_DISABLE_JIT" in settings else "compiled"
    assert judged(runs, memory, tmp_path, settings) == ordinary(runs, "compiled")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("settings", the_rest_is_slow(PLAIN, 2))
def test_variables_of_python_and_of_the_language_have_no_power(
    settings: dict[str, str], runs: Path, tmp_path: Path
) -> None:
    require("plain")
    assert judged(runs, "plain", tmp_path, settings) == ordinary(runs, "plain")


@pytest.mark.parametrize("memory", the_rest_is_slow(["plain", "compiled"], 1))
def test_a_folder_full_of_modules_has_no_power(memory: str, runs: Path, tmp_path: Path) -> None:
    require(memory)
    for name in MODULES:
        (tmp_path / f"{name}.py").write_text("open('touched', 'w')\n")
    assert judged(runs, memory, tmp_path, {}) == ordinary(runs, memory)
    assert not (tmp_path / "touched").exists()


def _damage(folder: Path) -> None:
    for file in folder.glob("load_world-*"):
        file.write_bytes(file.read_bytes()[:-9])


def _of_another_processor(folder: Path) -> None:
    for file in list(folder.iterdir()):
        (folder / f"{file.name[:-8]}00000.code").write_bytes(b"rubbish")


@pytest.mark.slow
@pytest.mark.parametrize("change", [_damage, _of_another_processor])
def test_a_cache_that_is_damaged_or_of_another_processor_has_no_power(
    change: Callable[[Path], None], runs: Path, tmp_path: Path
) -> None:
    require("compiled")
    expected = ordinary(runs, "compiled")
    shutil.copytree(kernel_cache.code_folder(), tmp_path / "cache")
    change(tmp_path / "cache")
    assert judged(runs, "compiled", tmp_path, {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}) == expected


def test_both_memories_print_the_same(runs: Path) -> None:
    require("compiled")
    assert ordinary(runs, "plain") == ordinary(runs, "compiled")
    assert ordinary(runs, "plain")[1] == 1


def test_what_is_honoured_is_written_down(root: Path) -> None:
    page = (root / "docs" / "verification.md").read_text("utf-8")
    assert all(f"`{name}`" in page for name in (*HONOURED, "NINJA_GAME_CHECKED"))


def test_numba_is_imported_in_one_place(root: Path) -> None:
    found = [
        path.name
        for folder in ("ninja_game", "tools", "benchmarks")
        for path in sorted((root / folder).rglob("*.py"))
        if any(line.split() == ["import", "numba"] for line in path.read_text("utf-8").splitlines())
    ]
    assert found == ["numba_import.py"]


def test_settings_of_whoever_imported_numba_before_do_not_count() -> None:
    require("compiled")
    code = (
        "import os; os.environ.update(NUMBA_OPT='0', NUMBA_CPU_NAME='generic', NUMBA_BOUNDSCHECK='0')\n"
        "import numba.core.config as config\n"
        "from ninja_game.backend.numba_import import import_numba\n"
        "import_numba(); os.environ['NUMBA_OPT'] = '1'; config.reload_config()\n"
        "print(int(config.OPT), config.CPU_NAME, config.BOUNDSCHECK)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("3 None None\n", "")
