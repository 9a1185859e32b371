"""The measurement of the learning environments: the bare kernel runs the same ticks as the environments."""

import pytest

from benchmarks import measure_learning as measured
from benchmarks.measure_worlds import resident_bytes
from ninja_game.backend.memories import compiled_available
from ninja_game.learn.vector import NinjaVectorEnv

pytestmark = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


def test_the_bare_kernel_runs_the_same_ticks() -> None:
    envs = NinjaVectorEnv(8, "train", memory="compiled", threads=1)
    envs.reset(seed=3)
    begun = envs.worlds.levels_now.copy()
    actions, ended, levels, ticks = measured.random_actions(150, 8), [], [], 0
    for row in actions:
        ended.append(envs.worlds.ended())
        before = envs.worlds.ticks.copy()
        envs.step(row)
        levels.append(envs.worlds.levels_now[ended[-1]])
        before[ended[-1]] = 0
        ticks += int((envs.worlds.ticks - before).sum())
    replay = measured.Replay(envs.worlds.levels, begun)
    assert any(len(each) for each in ended)
    assert replay.run(actions, ended, levels) == ticks
    assert replay.seconds > 0


def test_speeds_and_memory_are_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(measured, "STEPS", 4)
    speed = measured.vector_speed(2, ["state"], level="00-0-first-steps", rounds=1)
    assert min(speed) > 0
    assert measured.vector_speed(2, ["state"], level="00-0-first-steps", rounds=1, threads=2).environment > 0
    levels = NinjaVectorEnv(1).worlds.levels
    assert measured.single_speed(measured.PlainWrapper, levels, steps=3) > 0
    assert measured.single_speed(measured.single_env, levels, steps=3) > 0


def test_the_table_has_speeds_of_one_thread_and_of_two(monkeypatch: pytest.MonkeyPatch) -> None:
    def speed(_count: int, _parts: list[str], *, threads: int) -> measured.Speed:
        return measured.Speed(4000.0 * threads, 8000.0, 0.5)

    monkeypatch.setattr(measured, "vector_speed", speed)
    monkeypatch.setattr(measured, "single_speed", lambda *_: 400.0)
    monkeypatch.setattr(measured, "memory_of", lambda _: 2**20)
    rows = [line for line in measured.table().splitlines() if line.startswith("|")]
    assert rows[2:5] == [
        "| a plain wrapper round `Simulation` (compiled), four numbers | 400 | 100 |  |  |",
        "| `NinjaEnv`, state | 400 | 100 |  |  |",
        "| vector, state | 4,000 | 1,000 | 0.50 | 2,000 |",
    ]
    assert {row.count("|") for row in rows} == {6}


def test_ten_thousand_worlds_take_less_than_a_gibibyte() -> None:
    if not resident_bytes():
        pytest.skip("this system does not tell a process's memory")
    measured.memory_of(10)  # compiles
    assert measured.memory_of(2000) < (1 << 30) / 5
