"""Whole runs: value equality, inputs checked at the entry, limits, an end that Ctrl-C can bring."""

import copy
import math
import pickle
import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pytest

from ninja_game import ArgumentError, DemoError, Input, Simulation, parse_level, record_replay, run_level, trace_level
from ninja_game.backend.memories import compiled_available
from ninja_game.runs import trace
from ninja_game.sim.inputs import MAX_TICKS, Demo
from tests.support.memories import BOTH

TEXT = "0" * 713 + "|5^100,566!0^160,566"
LEVEL = parse_level(TEXT)


@pytest.mark.parametrize("memory", BOTH)
def test_equal_runs_and_traces_are_equal(memory: str) -> None:
    same, other = bytes([2] * 30), bytes([1] * 30)
    assert run_level(LEVEL, same, memory=memory) == run_level(LEVEL, same, memory="plain")
    assert run_level(LEVEL, same, memory=memory) != run_level(LEVEL, other, memory=memory)
    assert trace_level(LEVEL, same, memory=memory) == trace_level(LEVEL, same, memory="plain")
    assert len({run_level(LEVEL, same), run_level(LEVEL, same)}) == 1
    assert len(repr(run_level(LEVEL, same))) < 100
    assert "0, 0, 0" not in repr(LEVEL)


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("record, death", [("12^130,566", "mine 1"), ("6^130,566,0,0,0,3", "zap drone 1")])
def test_a_run_tells_what_killed_without_a_copy_of_its_world(
    memory: str, record: str, death: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run_level(LEVEL, b"\2", memory=memory).outcome == "running"  # the memory has passed its own test
    monkeypatch.setattr("ninja_game.backend.compiled.plain_copy", None)
    run = run_level(parse_level("0" * 713 + f"|5^100,566!{record}"), bytes([2] * 60), memory=memory)
    assert (run.outcome, run.death) == ("dead", death)


@pytest.mark.parametrize("memory", BOTH)
def test_a_simulation_says_what_it_is_and_how_far(memory: str) -> None:
    run = Simulation(LEVEL, body="box", memory=memory)
    run.step(right=True)
    assert repr(run) == f"<Simulation in tick 1: running, 0 gold, box, {memory}>"


@pytest.mark.parametrize("memory", BOTH)
def test_unknown_keys_are_refused_at_the_entry(memory: str) -> None:
    for keys in (16, 200, -1):
        with pytest.raises(ArgumentError, match="sum of Input flags"):
            Simulation(LEVEL, memory=memory).step_keys(keys)
    with pytest.raises(DemoError, match="tick 1 has unknown keys; found 16"):
        run_level(LEVEL, bytes([0, 16]), memory=memory)
    with pytest.raises(DemoError, match="tick 0"):
        trace_level(LEVEL, bytes([99]), memory=memory)
    run = Simulation(LEVEL, memory=memory)
    run.step_keys(Input.RIGHT | Input.JUMP_HELD | Input.JUMP_PRESSED)
    assert run.inputs == bytes([14])


@pytest.mark.parametrize("memory", BOTH)
def test_a_save_state_fits_every_equal_level_and_no_other(memory: str) -> None:
    run, other = Simulation(LEVEL, memory=memory), Simulation(parse_level(TEXT), memory=memory)
    run.step(right=True)
    other.restore(run.save())
    assert other.digest() == run.digest()
    assert run.save() == other.save()
    with pytest.raises(ArgumentError, match="another level"):
        Simulation(parse_level(TEXT.replace("160", "161")), memory=memory).restore(run.save())


@pytest.mark.parametrize("memory", BOTH)
def test_both_memories_show_tiles_objects_and_events_alike(memory: str) -> None:
    run = Simulation(LEVEL, memory=memory)
    assert run.tiles.ids.count(1) == 33 * 25 - 31 * 23
    while not run.gold:
        run.step(right=True)
    assert [(event.name, event.object_id) for event in run.events] == [("gold-taken", 1)]
    assert run.tick == 26
    assert run.object(1) == run.objects[0]
    with pytest.raises(ArgumentError, match="no object 0"):
        run.object(0)


@pytest.mark.parametrize("memory", BOTH)
def test_events_are_traced_alike(memory: str) -> None:
    ours = trace_level(LEVEL, bytes([2] * 40), memory=memory, events=True)
    assert [(tick, names) for tick, names in enumerate(ours.events) if names] == [(25, "gold-taken")]


def test_runs_that_are_too_long_are_refused_before_they_take_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(DemoError, match="too many ticks; found 1000000000000;"):
        Demo(b"\2", 1.0).playback(10**12)
    with pytest.raises(DemoError, match="too many ticks"):
        run_level(LEVEL, bytes(MAX_TICKS + 1))
    monkeypatch.setattr(trace, "MAX_CELLS", 10)
    with pytest.raises(ArgumentError, match="11 ticks of 1 objects"):
        trace_level(LEVEL, bytes(11))


@pytest.mark.skipif(not compiled_available() or sys.platform == "win32", reason="signals, Numba")
def test_ctrl_c_ends_a_long_compiled_run_soon() -> None:
    program = (
        "from ninja_game import parse_level, run_level\n"
        f"level = parse_level({TEXT!r})\n"
        "run_level(level, bytes(9), memory='compiled')\n"
        "print('runs', flush=True)\n"
        "while True: run_level(level, bytes(1_000_000), memory='compiled')\n"
    )
    words = [sys.executable, "-c", program]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "runs\n"
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=60)
        finally:
            process.kill()
    assert "KeyboardInterrupt" in errors


@pytest.mark.parametrize("memory", BOTH)
def test_a_save_state_after_a_kill_is_another_than_the_one_before(memory: str) -> None:
    run = Simulation(LEVEL, memory=memory)
    run.step(right=True)
    before = run.save()
    run.kill(1, 0.0, 0.0)
    after = run.save()
    assert (run.outcome, before == after, after == run.save()) == ("dead", False, True)
    run.restore(before)
    assert (run.outcome, run.save() == before) == ("running", True)
    for cause in (-3, 99):
        with pytest.raises(ArgumentError, match=f"cause is {cause}; expected 0 to 7"):
            run.kill(cause, 0.0, 0.0)
    assert (run.outcome, run.events) == ("running", [])


def test_a_level_with_a_nan_equals_its_copies() -> None:
    level = parse_level(TEXT + "!12^100,what")
    assert math.isnan(level.objects[-1].values[1])
    assert {level, pickle.loads(pickle.dumps(level)), copy.deepcopy(level), parse_level(TEXT + "!12^100,what")} == {
        level
    }


def test_inputs_may_be_a_list_or_an_array() -> None:
    keys = [2] * 20 + [6] * 10
    several = (keys, np.array(keys), np.array(keys, np.uint8), bytearray(keys), [Input(key) for key in keys])
    assert {run_level(LEVEL, each) for each in several} == {run_level(LEVEL, bytes(keys))}
    assert {record_replay(LEVEL, each).inputs for each in several} == {bytes(keys)}


@pytest.mark.parametrize("wrong", ["222", [2.0], [256], [-1], np.zeros((3, 2), np.int64), 7, None], ids=repr)
def test_what_are_no_inputs_is_refused(wrong: Any) -> None:
    for call in (run_level, record_replay, trace_level):
        with pytest.raises(ArgumentError, match="expected bytes, a list or an array"):
            call(LEVEL, wrong)
