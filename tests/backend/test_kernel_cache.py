"""The cache of compiled code: it can never run old rules, and whatever is wrong with it, everything works."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import FunctionType

import pytest

from ninja_game.backend import memories
from ninja_game.backend.kernel_cache import MAX_KERNELS, code_folder, evict_old_kernels
from ninja_game.backend.kernels import step_world
from ninja_game.backend.memories import MemoryUnavailableError, choose_memory
from ninja_game.errors import ArgumentError, FileError
from ninja_game.files.user_folder import cache_folder
from ninja_game.sim.ninja import tick
from tests.support.slow import the_rest_is_slow
from tests.support.special_files import needs_special_files
from tests.support.warm_start import WarmStart

needs_numba = pytest.mark.skipif(not memories.compiled_available(), reason="Numba is not installed")

# Compiles one small kernel, so that it takes a second, and says whether it was compiled.
PROGRAM = """
{first}
from ninja_game.backend import kernel_cache, memories
from ninja_game.backend.compiled import load_worlds
from ninja_game.sim.schema.declare import kernel, fast
from ninja_game.sim.schema.world_fields import World
import numpy as np
FACTOR = {factor}
@fast
def product(one: int, other: int) -> int:
    return one * other
@kernel
def scaled(numbers: World, count: int) -> int:
    return product(numbers[count - 1], FACTOR) + count
kernel_cache.before_compiling.append(lambda: print("compiles"))
print(memories.compiled(scaled)(np.array([3]), {count}))
{after}
"""


Run = Callable[..., tuple[str, str]]


def cold_run(folder: Path, first: str = "", count: int = 1, after: str = "", **more: str) -> tuple[str, str]:
    """What the program says where Numba is not loaded yet."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder), **more}
    command = [sys.executable, "-c", PROGRAM.format(factor=2, count=count, first=first, after=after)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    return done.stdout, done.stderr


@pytest.fixture
def run(warm_start: WarmStart) -> Run:
    """Runs the program, with its cache in a folder; what it says on stdout and stderr."""

    def run(folder: Path, factor: int = 2, count: int = 1, first: str = "", **more: str) -> tuple[str, str]:
        code = PROGRAM.format(factor=factor, count=count, first=first, after="")
        return warm_start.run(code, environment={"NUMBA_CACHE_DIR": str(folder), **more})[1:]

    return run


@needs_numba
def test_compiled_code_is_kept_until_a_constant_changes(tmp_path: Path, run: Run) -> None:
    assert run(tmp_path) == ("compiles\n7\n", "")
    assert run(tmp_path) == ("7\n", "")
    assert run(tmp_path, factor=5) == ("compiles\n16\n", "")


@needs_numba
@pytest.mark.parametrize("damage", the_rest_is_slow(["changed", "empty", "truncated", "garbage"], 1))
def test_damaged_code_is_compiled_again_without_a_word(damage: str, tmp_path: Path, run: Run) -> None:
    run(tmp_path)
    (file,) = tmp_path.iterdir()
    code = file.read_bytes()
    changed = code[:2000] + bytes([code[2000] ^ 1]) + code[2001:]
    file.write_bytes({"empty": b"", "truncated": code[:-9], "changed": changed, "garbage": b"junk" * 99}[damage])
    assert run(tmp_path) == ("compiles\n7\n", "")
    assert run(tmp_path) == ("7\n", "")


@needs_numba
def test_code_that_came_with_the_installation_is_used_where_it_is_for_any_processor(tmp_path: Path, run: Run) -> None:
    fixed = "from ninja_game.backend.numba_import import FIXED; FIXED['NUMBA_CPU_NAME'] = {!r}"
    folder = str(tmp_path / "all")
    shipped = f"from ninja_game.backend import kernel_cache; kernel_cache.SHIPPED = kernel_cache.Path({folder!r})"
    assert cold_run(tmp_path / "all", first=fixed.format("generic")) == ("compiles\n7\n", "")
    assert run(tmp_path / "own", first=shipped) == ("7\n", "")
    assert run(tmp_path / "own") == ("compiles\n7\n", "")


@pytest.mark.slow
@needs_special_files
@needs_numba
def test_a_pipe_with_the_name_of_a_kernel_holds_up_nobody(tmp_path: Path, run: Run) -> None:
    run(tmp_path)
    (file,) = tmp_path.iterdir()
    file.unlink()
    os.mkfifo(file)
    assert run(tmp_path) == ("compiles\n7\n", "")


@needs_numba
def test_where_nothing_can_be_written_it_works_and_says_so_once(tmp_path: Path, run: Run) -> None:
    (tmp_path / "file").touch()
    out, errors = run(tmp_path / "file" / "cache")
    assert out == "compiles\n7\n"
    assert errors.count("compiled code cannot be kept in") == len(errors.splitlines()) == 1
    assert not list(Path(memories.__file__).parent.rglob("*.nbi"))


@pytest.mark.slow
@needs_numba
@pytest.mark.parametrize(
    "change, warning_text",
    [
        ("del numba.core.compiler.CompileResult._rebuild", "this Numba has no _rebuild"),
        ("del numba.core.compiler.CompileResult._reduce", "this Numba has no _reduce"),
        ("from numba.core import codegen; del codegen.CPUCodegen.magic_tuple", "this Numba has no magic_tuple"),
        ("numba.core.compiler.CompileResult._reduce = lambda self, more: 0", "cannot be kept (TypeError"),
    ],
)
def test_another_numba_compiles_without_a_cache(change: str, warning_text: str, tmp_path: Path, run: Run) -> None:
    """Without a private part that only the cache needs, or with another one of its name."""
    first = f"from ninja_game.backend.numba_import import *; numba = import_numba(); {change}"
    out, errors = run(tmp_path, first=first)
    assert out == "compiles\n7\n" or (out == "7\n" and "has no" in warning_text)
    assert warning_text in errors
    assert len(errors.splitlines()) == 1


LIBRARIES = """
twin = memories._compiler(False)._twin(product)
print(*(type(made.library).__name__ for made in twin.overloads.values()))
"""


@needs_numba
@pytest.mark.parametrize(
    "change, library", [("", "InnerLibrary"), ("del typed_passes.NativeLowering", "JITCodeLibrary")]
)
def test_only_kernels_become_machine_code_where_numba_has_the_private_parts(
    change: str, library: str, tmp_path: Path
) -> None:
    first = (
        f"from ninja_game.backend.numba_import import *; import_numba(); from numba.core import typed_passes; {change}"
    )
    assert cold_run(tmp_path, first=first, after=LIBRARIES) == (f"compiles\n7\n{library}\n", "")


@needs_numba
@pytest.mark.parametrize(
    "change",
    [
        "numba.core.dispatcher.Dispatcher.get_call_template = lambda self: 0",
        "import numba; del numba.core.config._env_reloader",
        "numba.njit = None",
    ],
)
def test_where_numba_compiles_nothing_auto_is_plain_and_says_why(
    change: str, tmp_path: Path, warm_start: WarmStart
) -> None:
    program = (
        f"from ninja_game.backend.numba_import import import_numba\nnumba = import_numba()\n{change}\n"
        "from ninja_game import Batch, Level, ObjectSpec, Simulation\n"
        "from ninja_game.backend.memories import choose_memory, compiled_if_possible, proven_memory\n"
        "from ninja_game.backend.kernels import step_world\n"
        "level = Level(objects=(ObjectSpec(5, (100.0, 100.0)),))\n"
        "print(Simulation(level, memory='auto').memory, Batch(level, 2).memory, choose_memory('auto'),\n"
        "      proven_memory('auto').first, compiled_if_possible(step_world) is step_world)\n"
        "Simulation(level, memory='compiled')"
    )
    done = warm_start.run(program, environment={"NUMBA_CACHE_DIR": str(tmp_path)})
    assert done.out == "plain plain plain plain True\n"
    first, *rest = done.errors.splitlines()
    assert first.startswith("ninja-game: Numba cannot ")
    assert first.endswith("this is the plain memory, which is slower")
    assert rest[-1].startswith("ninja_game.backend.memories.MemoryUnavailableError: Numba cannot ")


@needs_numba
def test_numba_switched_off_is_numba_missing(tmp_path: Path) -> None:
    out, errors = cold_run(tmp_path, NUMBA_DISABLE_JIT="1")
    assert (out, "MemoryUnavailableError" in errors) == ("", True)


@pytest.mark.slow
@needs_numba
def test_checked_kernels_refuse_an_index_out_of_range_and_are_kept_apart(tmp_path: Path, run: Run) -> None:
    run(tmp_path)
    out, errors = cold_run(tmp_path, count=2, NINJA_GAME_CHECKED="1")
    assert (out, "IndexError" in errors) == ("compiles\n", True)
    assert cold_run(tmp_path, NINJA_GAME_CHECKED="1") == ("7\n", "")


@needs_numba
def test_the_digest_follows_every_rule_and_constant_that_a_kernel_reaches(monkeypatch: pytest.MonkeyPatch) -> None:
    from ninja_game.backend.code_digest import code_digest

    before = code_digest(step_world, "")
    assert code_digest(step_world, "") == before
    assert code_digest(step_world, "another compiler") != before
    monkeypatch.setattr(tick, "FATAL_IMPACT", 99.0)
    assert code_digest(step_world, "") != before


@needs_numba
def test_machine_code_is_another_if_a_named_tuple_has_its_fields_in_another_order(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from ninja_game.backend.code_digest import code_digest
    from ninja_game.search.best_first import expand
    from ninja_game.search.nodes import Resolution

    before = code_digest(expand, "")
    monkeypatch.setattr(Resolution, "_fields", Resolution._fields[::-1])
    assert code_digest(expand, "") != before


def test_only_the_newest_files_are_kept(tmp_path: Path) -> None:
    kernel = f"run_world-{'0' * 32}-{{:016}}.code"
    for age in range(MAX_KERNELS + 3):
        (tmp_path / kernel.format(age)).touch()
        os.utime(tmp_path / kernel.format(age), (1_000_000 - age, 1_000_000 - age))
    (tmp_path / "notes.code").touch()
    os.utime(tmp_path / "notes.code", (0, 0))
    (tmp_path / kernel.format(999)).symlink_to(tmp_path / "nothing")
    evict_old_kernels(tmp_path)
    kept = {kernel.format(age) for age in (*range(MAX_KERNELS), 999)}
    assert {path.name for path in tmp_path.iterdir()} == kept | {"notes.code"}
    evict_old_kernels(tmp_path / "nothing")


@needs_numba
@pytest.mark.parametrize("first", the_rest_is_slow(["", "import numba; "], 1))
def test_threads_may_ask_for_kernels_at_once_whoever_imported_numba(first: str) -> None:
    program = (
        f"{first}from concurrent.futures import ThreadPoolExecutor as Pool\n"
        "from ninja_game.backend.memories import compiled\n"
        "from ninja_game.backend.kernels import run_world\n"
        "with Pool(8) as pool: twins = list(pool.map(lambda _: compiled(run_world), range(8)))\n"
        "print(len({id(twin) for twin in twins}))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("1\n", "")


def test_without_numba_auto_is_plain_and_compiled_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memories, "compiled_available", lambda: False)
    assert choose_memory("auto") == "plain"
    with pytest.raises(MemoryUnavailableError, match="needs Numba"):
        choose_memory("compiled")
    with pytest.raises(ArgumentError, match="expected 'plain'"):
        choose_memory("fast")


@needs_numba
def test_machine_code_is_another_if_a_literal_of_a_rule_is_edited() -> None:
    from ninja_game.backend.code_digest import code_digest

    def rule(x: float) -> float:
        return x * 2.5

    edited = FunctionType(rule.__code__.replace(co_consts=(None, 3.5)), rule.__globals__, rule.__name__)
    edited.__qualname__, edited.__module__ = rule.__qualname__, rule.__module__
    assert (rule(1.0), edited(1.0)) == (2.5, 3.5)
    assert code_digest(edited, "") != code_digest(rule, "")


@pytest.mark.parametrize("folder", ["cache", "./cache", "..", "~nobody-of-this-name/cache"])
def test_compiled_code_is_never_loaded_from_a_relative_folder(folder: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", folder)
    with pytest.raises(FileError, match=r"relative path|NUMBA_CACHE_DIR names no folder"):
        code_folder.__wrapped__()


def test_compiled_code_and_the_site_have_one_cache_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    assert code_folder.__wrapped__() == cache_folder() / "compiled"


def test_the_home_of_the_user_is_meant_by_its_sign(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("NUMBA_CACHE_DIR", "~/cache")
    assert code_folder.__wrapped__() == tmp_path / "cache"
