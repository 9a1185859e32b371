"""Nobody waits for a compiler: one process compiles everything, and runs go over to what it has made, bit for bit."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any, ClassVar

import pytest

from ninja_game.backend import background_compiler, memories
from ninja_game.backend.compiled import compiled_copy
from ninja_game.backend.kernel_cache import are_cached, code_folder
from ninja_game.backend.kernels import run_world
from ninja_game.backend.memories import (
    CHECKED,
    CHECKED_LATER,
    compiled_available,
    open_worlds,
    proven_memory,
    switch_to_compiled,
)
from ninja_game.backend.self_test import RUNS, known_keys, known_level
from ninja_game.budget import NO_LIMIT, PLAIN_WORK, tick_cost
from ninja_game.errors import FileError
from ninja_game.formats.load import load_replays
from ninja_game.runs.run import run_level
from ninja_game.runs.trace import trace_level
from ninja_game.runs.verify import verify_recording
from ninja_game.sim.digest import differences
from ninja_game.simulation import Simulation
from ninja_game.tas.timeline import Timeline
from tests.support.own_pack import PACK
from tests.support.slow import the_rest_is_slow

pytestmark = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")

ALL_KINDS = known_level()
NAMES = ("00-4-every-switch", "01-0-up-and-away", "01-1-watch-and-go", "01-2-no-hurry")


class Compiler:
    """A compiler that is at work until the kernels have been asked for so often."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.asked, self.ready_after = 0, 10**9
        monkeypatch.setattr(memories, "begins_on_plain", lambda memory, *_, **__: memory == "auto")
        monkeypatch.setattr(memories, "count_run", lambda *_, **__: None)
        monkeypatch.setattr(memories, "kernels_ready", self.are_there)
        monkeypatch.setattr(background_compiler, "is_compiling", lambda: True)
        for module in ("backend.memories", "runs.run", "runs.trace"):
            monkeypatch.setattr(f"ninja_game.{module}.PLAIN_WORK", 1)

    def are_there(self, **_: bool) -> bool:
        self.asked += 1
        return self.asked > self.ready_after


@pytest.fixture
def compiler(monkeypatch: pytest.MonkeyPatch) -> Compiler:
    return Compiler(monkeypatch)


@pytest.mark.parametrize("number", the_rest_is_slow(range(RUNS)[::-1], 2))
def test_a_world_with_every_kind_of_object_goes_on_alike_from_every_tick(number: int) -> None:
    keys = known_keys(number)
    plain, end = (open_worlds("plain", ALL_KINDS, box=number == RUNS - 1) for _ in range(2))
    end.run(keys)
    while plain.tick() < end.tick():
        copy = compiled_copy(memories.compiled, plain)
        assert not list(differences(copy.world(), plain.world())), plain.tick()
        assert [tuple(event) for event in copy.events()] == [
            tuple(getattr(event, name) for name in type(event).__slots__) for event in plain.events()
        ]
        copy.run(keys[plain.tick() :])
        assert not list(differences(copy.world(), end.world())), plain.tick()
        plain.step(keys[plain.tick()])


@pytest.mark.parametrize("name", the_rest_is_slow(NAMES, 1))
def test_a_run_that_goes_over_between_any_two_ticks_ends_alike(name: str, compiler: Compiler) -> None:
    run = load_replays(PACK / "certificates" / f"{name}.exit.replay.txt")[0]
    inputs = run.inputs
    expected = run_level(run.level, inputs, memory="plain", digest=True)
    traced = trace_level(run.level, inputs, memory="plain", events=True)
    for ticks in range(0, expected.ticks, 23):
        compiler.asked, compiler.ready_after = 0, ticks
        assert run_level(run.level, inputs, digest=True) == expected, ticks
        compiler.asked = 0
        trace = trace_level(run.level, inputs, events=True)
        assert (trace.ninja == traced.ninja).all(), ticks
        assert (trace.objects == traced.objects).all(), ticks
        assert trace.events == traced.events, ticks


def test_a_verdict_is_the_same_wherever_the_run_goes_over(compiler: Compiler) -> None:
    run = load_replays(PACK / "certificates" / "01-2-no-hurry.exit.replay.txt")[0]
    expected = verify_recording(run, "plain")
    assert proven_memory("auto") == CHECKED_LATER
    for ticks in (0, 1, 50, expected.ticks):
        compiler.asked, compiler.ready_after = 0, ticks
        assert verify_recording(run) == expected
    compiler.ready_after = 10**9
    assert switch_to_compiled(open_worlds("plain", run.level, box=False), CHECKED_LATER, 10**6).name == "plain"
    compiler.ready_after = 0
    judged = switch_to_compiled(open_worlds("plain", run.level, box=False), CHECKED_LATER, 10**6)
    assert judged.kernel(run_world) is memories.compiled(run_world, checked=True)
    assert switch_to_compiled(open_worlds("plain", run.level, box=False), "plain", 10**6).name == "plain"


def test_a_few_short_runs_are_not_worth_loading_numba(monkeypatch: pytest.MonkeyPatch) -> None:
    run = load_replays(PACK / "certificates" / "00-4-every-switch.exit.replay.txt")[0]
    work = tick_cost(run.level) * run.ticks
    monkeypatch.setattr(memories.PROCESS, "kernels", {})
    monkeypatch.setattr(memories.PROCESS, "short_work", PLAIN_WORK - 3 * work)
    monkeypatch.setattr(memories, "kernels_ready", lambda *, checked: True)
    monkeypatch.setenv(background_compiler.VARIABLE, "1")
    assert proven_memory("auto", work) == CHECKED_LATER
    short, long = (open_worlds("auto", run.level, box=False, at_once=True, ticks=n * run.ticks) for n in (2, 4))
    assert (short.name, long.name) == ("plain", "compiled")
    assert open_worlds("auto", run.level, box=False).name == "compiled"
    assert proven_memory("auto", work) == CHECKED


def test_little_work_stays_on_the_plain_memory(compiler: Compiler) -> None:
    compiler.ready_after = 0
    worlds = open_worlds("auto", ALL_KINDS, box=False, at_once=True)
    assert switch_to_compiled(worlds, "auto", 0) is worlds
    assert switch_to_compiled(worlds, "auto", 1).name == "compiled"
    assert Simulation(ALL_KINDS, memory="auto").memory == "plain"


def test_where_nobody_compiles_whoever_has_much_work_does(compiler: Compiler, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background_compiler, "is_compiling", lambda: False)
    assert switch_to_compiled(open_worlds("plain", ALL_KINDS, box=False), "auto", 10**6).name == "compiled"


def test_a_run_under_edit_goes_over_too(compiler: Compiler) -> None:
    keys = known_keys(1)
    timeline, expected = Timeline(ALL_KINDS, keys), Timeline(ALL_KINDS, keys, memory="compiled")
    used: list[str] = []
    for compiler.ready_after in (10**9, 0):
        timeline.simulate(100)
        used.append(timeline.memory)
    assert used == ["plain", "compiled"]
    timeline.simulate(1000)
    expected.simulate(1000)
    assert timeline.simulated_until == expected.simulated_until
    for name in ("x", "y", "state", "outcome"):
        assert timeline.column(name).tobytes() == expected.column(name).tobytes()
    assert timeline.event_ticks == expected.event_ticks


class Started:
    """What is started in place of a process; it works on."""

    commands: ClassVar[list[tuple[list[str], dict[str, Any]]]] = []

    def __init__(self, command: list[str], **options: Any) -> None:
        self.commands.append((command, options))

    def poll(self) -> None:
        return None


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[tuple[list[str], dict[str, Any]]]:
    """The processes that are started; none begins, and the cache is empty."""
    monkeypatch.setattr(subprocess, "Popen", Started)
    monkeypatch.setattr(Started, "commands", [])
    monkeypatch.setattr(background_compiler, "_STARTED", [])
    monkeypatch.setattr(memories.PROCESS, "kernels", {})
    for module in ("kernel_cache", "background_compiler"):
        monkeypatch.setattr(f"ninja_game.backend.{module}.code_folder", lambda: tmp_path / "cache")
    monkeypatch.setenv(background_compiler.VARIABLE, "1")
    return Started.commands


def test_the_first_run_on_a_machine_starts_one_process_that_compiles(
    started: list[tuple[list[str], dict[str, Any]]], tmp_path: Path
) -> None:
    for _ in range(2):
        assert Simulation(ALL_KINDS, memory="auto").memory == "plain"
    ((command, options),) = started
    assert command == [sys.executable, "-m", "ninja_game", "compile", "--background"]
    assert options["env"]["PYTHONSAFEPATH"] == "1", "nothing of the current folder is imported"
    assert options["env"][background_compiler.VARIABLE] == "0", "it starts no other one"
    assert (options["cwd"], options["start_new_session"]) == (tmp_path / "cache", True)
    assert background_compiler.is_compiling()


@pytest.mark.parametrize("memory", ["plain", "compiled"])
def test_who_names_a_memory_gets_it_and_starts_nothing(
    memory: str, started: list[tuple[list[str], dict[str, Any]]]
) -> None:
    assert not memories.begins_on_plain(memory, 0)
    memories.proven_memory(memory)
    assert not started


def test_whether_a_run_begins_on_the_plain_memory_may_be_asked_without_a_process(
    started: list[tuple[list[str], dict[str, Any]]],
) -> None:
    assert memories.begins_on_plain("auto", NO_LIMIT)
    assert not started
    memories.compile_missing()
    assert len(started) == 1


def test_a_run_that_begins_now_looks_for_its_kernels_once(
    started: list[tuple[list[str], dict[str, Any]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[bool] = []
    monkeypatch.setattr(memories, "kernels_ready", lambda *, checked: asked.append(checked))
    for work in (NO_LIMIT, 0):
        asked.clear()
        assert memories.open_worlds("auto", ALL_KINDS, box=False, at_once=True, ticks=work).name == "plain"
        assert (asked, len(started)) == ([False], 1)


def test_switched_off_it_is_not_started(
    started: list[tuple[list[str], dict[str, Any]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(background_compiler.VARIABLE, "0")
    assert not memories.begins_on_plain("auto", 0)
    memories.compile_missing()
    background_compiler.start()
    assert not started
    assert not background_compiler.is_compiling()


def test_where_no_cache_can_be_nothing_is_started(
    started: list[tuple[list[str], dict[str, Any]]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "cache").touch()
    background_compiler.start()
    assert not started
    assert not background_compiler.is_compiling()

    def refuse() -> Path:
        raise FileError("no folder")

    monkeypatch.setattr(background_compiler, "code_folder", refuse)
    assert not background_compiler.is_compiling()


HOLDING = """
from ninja_game.backend.background_compiler import lock_compilation
handle = lock_compilation()
print("held" if handle is not None else "busy", flush=True)
input()
"""


def program(folder: Path, code: str, *words: str) -> subprocess.Popen[str]:
    """A process with its cache in a folder: some code, or the module that is named there."""
    command = [sys.executable, "-c", code] if code else [sys.executable, "-P", "-m", "ninja_game", *words]
    pipe = subprocess.PIPE
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder)}
    return subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True, env=environment)


def first_line(process: subprocess.Popen[str]) -> str:
    assert process.stdout
    return process.stdout.readline()


def test_one_compiles_at_a_time_and_a_dead_one_keeps_nobody(tmp_path: Path) -> None:
    with program(tmp_path, HOLDING) as holder:
        assert first_line(holder) == "held\n"
        with program(tmp_path, "", "compile", "--background") as second:
            out, errors = second.communicate()
            assert (second.returncode, out, errors) == (0, "", "")
        assert not list(tmp_path.glob("*.code"))
        holder.kill()
    with program(tmp_path, HOLDING) as third:
        assert first_line(third) == "held\n"
        third.communicate("\n")


SMALL = """
import sys
from ninja_game.backend import kernel_cache, memories
from ninja_game.sim.schema.declare import kernel
import numpy as np
@kernel
def doubled(numbers: object) -> int:
    return numbers[0] * 2
kernel_cache.before_compiling.append(lambda: print("missing", flush=True))
write = kernel_cache.KernelCache._write
kernel_cache.KernelCache._write = lambda *given: print("compiled") or write(*given)
print(memories.compiled(doubled)(np.array([3])))
"""


@pytest.mark.slow
def test_a_kernel_that_another_process_compiles_is_waited_for(tmp_path: Path) -> None:
    from ninja_game.files.locking import try_lock

    with program(tmp_path, SMALL) as alone:
        assert alone.communicate()[0] == "missing\ncompiled\n6\n"
    (code,) = tmp_path.iterdir()
    made = code.rename(tmp_path / "aside")
    handle = try_lock(code.with_suffix(".lock"))
    assert handle is not None
    with program(tmp_path, SMALL) as waiting:
        assert first_line(waiting) == "missing\n"
        made.rename(code)
        os.close(handle)
        assert waiting.communicate()[0] == "6\n"
    assert [path.name for path in tmp_path.iterdir()] == [code.name]


@pytest.mark.slow
def test_the_command_leaves_nothing_to_compile_for_others(tmp_path: Path) -> None:
    """In the cache of whoever runs the tests, so that this compiles only what the other tests need too."""
    folder = code_folder()
    with program(folder, "", "compile") as compiling:
        out, errors = compiling.communicate()
        assert compiling.returncode == 0, errors
        assert out.startswith("All is compiled")
    assert are_cached([run_world], False)
    assert are_cached([run_world], True)
    run = str(PACK / "certificates" / "00-4-every-switch.exit.replay.txt")
    search = ("search", run, "--from", "0", "--to", "9", "--maximise", "x", "--seconds", "0.1", "--jobs", "1")
    check = ("check", str(PACK / "00-4-every-switch.txt"), "--seconds", "1", "--gold", "both")
    for words in (
        ("verify", run),
        ("trace", run),
        search,
        check,
        ("demonstrations", run, "-o", str(tmp_path / "d.npz")),
    ):
        with program(folder, "", *words) as done:
            assert "compiling" not in done.communicate()[1], words
