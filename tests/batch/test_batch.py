"""Batches: the same bits as single stepping, whatever the threads; resets, snapshots, copies, observations."""

import threading
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest

from ninja_game import Level, Simulation, parse_level
from ninja_game.backend import plain
from ninja_game.backend.kernels import run_worlds
from ninja_game.backend.layout import OBJECT_DTYPE
from ninja_game.backend.memories import MemoryUnavailableError, compiled, compiled_available, open_worlds
from ninja_game.batch.batch import OBJECT_FIELDS, Batch
from ninja_game.batch.thread_pool import ThreadPool
from ninja_game.errors import ArgumentError, LevelError
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.kinds import DRONE, EXIT, MINE
from ninja_game.sim.loader import object_table
from ninja_game.sim.states import OUTCOME_NAMES
from tests.support.learning import FLOOR, LEVELS
from tests.support.memories import BOTH

needs_numba = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


def keys(ticks: int, count: int, seed: int = 6) -> np.ndarray[tuple[int, int], np.dtype[np.uint8]]:
    """Random inputs that keep keys down for some ticks."""
    random = np.random.default_rng(seed)
    return np.repeat(random.integers(0, 16, (ticks // 8 + 1, count), np.uint8), 8, axis=0)[:ticks]


def single_digests(inputs: np.ndarray[tuple[int, int], np.dtype[np.uint8]]) -> list[str]:
    """Digests of the same worlds stepped one by one by the plain memory."""
    digests = []
    for index in range(inputs.shape[1]):
        run = Simulation(LEVELS[index % len(LEVELS)])
        for down in inputs[:, index].tolist():
            run.step_keys(down)
        digests.append(run.digest())
    return digests


@pytest.mark.parametrize("memory", BOTH)
def test_a_batch_is_single_stepping_to_the_last_bit(memory: str) -> None:
    inputs = keys(120, 7)
    batch = Batch(LEVELS, 7, memory=memory)
    for row in inputs[:40]:
        batch.step(row)
    batch.run(inputs[40:])
    assert [batch.digest(index) for index in range(7)] == single_digests(inputs)


@pytest.mark.parametrize("memory", BOTH)
def test_a_malformed_exit_is_an_object_like_any_other(memory: str) -> None:
    """It has no switch, for which an exit has room."""
    batch = Batch(parse_level(FLOOR + "|5^100,566!11^1,2"), 3, memory=memory)
    batch.run([[2] * 3] * 10)
    assert batch.used.tolist() == [3] * 3
    assert batch.ticks.tolist() == [10] * 3


@needs_numba
def test_the_number_of_threads_changes_nothing() -> None:
    inputs = keys(60, 900)
    batches = [Batch(LEVELS, 900, memory="compiled", threads=threads) for threads in (1, 2, 4)]
    for batch in batches:
        batch.run(inputs[:30])
        for row in inputs[30:]:
            batch.step(row)
    digests = [[batch.digest(index) for index in range(0, 900, 7)] for batch in batches]
    assert digests[0] == digests[1] == digests[2]
    assert np.array_equal(batches[0].objects, batches[1].objects)


@needs_numba
def test_batches_of_all_sizes_share_one_compiled_function() -> None:
    for count in (1, 2, 5):
        batch = Batch(LEVELS, count, memory="compiled")
        batch.step([0] * count)
        batch.run(np.frombuffer(bytes(3 * count), np.uint8).reshape(3, count))
    entry: Any = compiled(run_worlds)
    assert len(entry.signatures) == 1


@needs_numba
def test_both_memories_show_the_same_bytes() -> None:
    batches = [Batch(LEVELS, 6, memory=memory) for memory in ("plain", "compiled")]
    for batch in batches:
        batch.run(keys(90, 6))
    plain, compiled = batches
    for name in ("positions", "previous", "states", "outcomes", "gold", "ticks", "used", "places"):
        assert np.array_equal(getattr(plain, name), getattr(compiled, name), equal_nan=True), name
    assert plain.objects.shape == compiled.objects.shape == (6, int(compiled.used.max()))
    for index in range(6):
        used = compiled.used[index]
        assert plain.objects[index, 1:used].tobytes() == compiled.objects[index, 1:used].tobytes()


@pytest.mark.parametrize("memory", BOTH)
def test_observations_are_views_that_stay_current(memory: str) -> None:
    batch = Batch(LEVELS, 5, memory=memory)
    positions, states, objects = batch.positions, batch.states, batch.objects
    assert positions.base is not None
    assert positions.shape == (5, 2)
    batch.run(np.full((40, 5), 2))
    run = Simulation(LEVELS[1])
    for _ in range(40):
        run.step_keys(2)
    assert positions[1].tolist() == [run.ninja.x, run.ninja.y]
    assert batch.velocities()[1].tolist() == [run.ninja.vx, run.ninja.vy]
    assert states.dtype == np.int32
    assert OUTCOME_NAMES[batch.outcomes[1]] == run.outcome
    kinds = objects["kind"][0, 1 : batch.used[0]].tolist()
    assert [kinds.count(kind) for kind in (EXIT, DRONE, MINE)] == [1, 1, 0]
    drone = kinds.index(DRONE) + 1
    assert batch.places[0, drone].tolist() == [objects["x"][0, drone], objects["y"][0, drone]]
    assert objects.dtype == OBJECT_DTYPE


@pytest.mark.parametrize("memory", BOTH)
def test_stop_leaves_ended_worlds_alone(memory: str) -> None:
    batch = Batch(parse_level(FLOOR + "|5^100,566!11^160,564,130,564"), 3, memory=memory)
    inputs = np.zeros((60, 3), np.uint8)
    inputs[:, 1] = 2
    ticks = batch.run(inputs, stop=True)
    assert [OUTCOME_NAMES[number] for number in batch.outcomes] == ["running", "exit", "running"]
    assert batch.ticks.tolist() == [60, 24, 60]
    assert ticks == 144
    batch.run(inputs[:5])
    assert batch.ticks.tolist() == [65, 29, 65]


@pytest.mark.parametrize("memory", BOTH)
def test_a_world_of_a_smaller_level_shows_nothing_of_the_larger_one(memory: str) -> None:
    small = "0" * 713 + "|5^100,566"
    large = small + "".join(f"!0^{x},300" for x in range(100, 700, 20))
    batch = Batch([parse_level(large), parse_level(small)], 1, memory=memory)
    assert batch.objects["x"][0].any()
    batch.reset(0, levels=1)
    assert not batch.objects["x"][0, int(batch.used[0]) :].any()


@pytest.mark.parametrize("memory", BOTH)
def test_a_world_in_a_level_that_replaced_another_starts_afresh_in_it(
    memory: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    loads = Mock(wraps=object_table)
    monkeypatch.setattr(plain, "object_table", loads)
    worlds = open_worlds(memory, LEVELS, len(LEVELS), box=True)
    worlds.load(range(len(LEVELS)), range(len(LEVELS)))
    loads.reset_mock()
    worlds.put_levels(np.array([0, 1]), [LEVELS[2], LEVELS[2]])
    assert loads.call_count == (2 if memory == "plain" else 0), "a level is loaded once"
    expected = worlds.states[0].tobytes()
    worlds.run(bytes([2] * 20), 0)
    worlds.load([0], [0])
    assert worlds.states[0].tobytes() == expected == open_worlds(memory, LEVELS[2:], 1, box=True).states[0].tobytes()


@pytest.mark.parametrize("memory", BOTH)
def test_single_worlds_are_reset_saved_copied_and_restored(memory: str) -> None:
    batch = Batch(LEVELS, 6, memory=memory)
    fresh = [batch.digest(index) for index in range(6)]
    batch.run(keys(30, 6))
    middle = [batch.digest(index) for index in range(6)]
    state = batch.save([1, 4])
    batch.run(keys(30, 6, seed=7))
    late = batch.save()
    batch.reset([0, 2])
    assert [batch.digest(0), batch.digest(2)] == [fresh[0], fresh[2]]
    batch.restore(state, [3, 1])
    assert [batch.digest(3), batch.digest(1)] == [middle[1], middle[4]]
    assert batch.levels_now.tolist() == [0, 1, 2, 1, 1, 2]
    batch.copy([3, 3], [0, 5])
    assert batch.digest(0) == batch.digest(5) == middle[1]
    batch.reset(1, levels=2)
    assert batch.digest(1) == fresh[2]
    batch.restore(late)
    inputs = keys(30, 6, seed=8)
    batch.run(inputs)
    again = [batch.digest(index) for index in range(6)]
    batch.restore(late)
    batch.run(inputs)
    assert [batch.digest(index) for index in range(6)] == again


@pytest.mark.parametrize("memory", BOTH)
def test_a_world_goes_on_alike_in_every_slot(memory: str) -> None:
    batch = Batch(LEVELS, 6, memory=memory)
    batch.run(keys(50, 6))
    batch.copy([2] * 5, [0, 1, 3, 4, 5])
    batch.run(np.repeat(keys(50, 1), 6, axis=1))
    assert len({batch.digest(index) for index in range(6)}) == 1


@pytest.mark.parametrize("memory", BOTH)
def test_wrong_use_is_refused(memory: str) -> None:
    batch = Batch(LEVELS[0], 2, memory=memory)
    with pytest.raises(ValueError, match=r"of shape \(1,\); expected \(2,\)"):
        batch.step([1])
    with pytest.raises(ValueError, match="expected integers"):
        batch.step([0.5, 1.0])
    for keys_of_all in ([16, 0], [-1, 0], [18, 18]):
        with pytest.raises(ArgumentError, match="expected sums of Input, 0 to 15"):
            batch.step(keys_of_all)
    with pytest.raises(ArgumentError, match=r"of shape \(1000,\); expected \(2,\)"):
        batch.step(np.zeros(1000, np.uint8))
    for which, message in ((2, "numbers below 2"), ([True] * 3, "3 truth values; expected 2"), ("all", "truth value")):
        with pytest.raises(ArgumentError, match=message):
            batch.reset(which)  # type: ignore[arg-type]
    with pytest.raises(ArgumentError, match="levels are 1 to 1"):
        batch.reset(0, levels=1)
    with pytest.raises(LevelError, match="this is not a level; found 'levels/01'"):
        Batch("levels/01", 3, memory=memory)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="1 saved worlds do not fit 2"):
        batch.restore(batch.save(0))
    with pytest.raises(ValueError, match="do not fit"):
        batch.restore(Batch(LEVELS[1], 2, memory=memory).save())
    with pytest.raises(ValueError, match="at least 1"):
        Batch(LEVELS[0], 0, memory=memory)
    for wrong in ({"count": 1.5}, {"count": True}, {"threads": 0}, {"threads": -1}, {"threads": "2"}):
        settings: dict[str, Any] = {"count": 1, "memory": memory, **wrong}
        with pytest.raises(ArgumentError, match="expected a whole number, at least 1"):
            Batch(LEVELS[0], **settings)


def test_without_numba_the_plain_memory_does_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.backend.memories.compiled_available", lambda: False)
    assert Batch(LEVELS[0], 1).memory == "plain"
    with pytest.raises(MemoryUnavailableError):
        Batch(LEVELS[0], 1, memory="compiled")


def test_a_box_is_a_box() -> None:
    batch = Batch(LEVELS[0], 1, body="box", memory="plain")
    batch.run([[2]] * 20)
    run = Simulation(LEVELS[0], body="box")
    for _ in range(20):
        run.step_keys(2)
    assert batch.digest(0) == run.digest()


def test_a_pool_does_every_item_once_and_raises_what_fails() -> None:
    seen: list[int] = []
    lock = threading.Lock()

    def work(first: int, last: int) -> int:
        with lock:
            seen.extend(range(first, last))
        return last - first

    pool = ThreadPool(3)
    for count in (1, 2, 23, 24, 25, 255, 256, 257, 1000, 10_000):
        for ticks in (0, 1, 7, 64, 5000):
            seen.clear()
            assert pool.share(work, count, ticks) == count
            assert sorted(seen) == list(range(count))

    def fail(first: int, last: int) -> int:
        raise LookupError(f"{first} {last}")

    with pytest.raises(LookupError):
        pool.share(fail, 100)
    assert pool.share(work, 24) == 24


def test_an_empty_choice_of_levels_is_refused() -> None:
    none: list[Level] = []
    with pytest.raises(ValueError, match="0 levels"):
        Batch(none, 1)


@pytest.mark.parametrize("memory", BOTH)
def test_worlds_are_chosen_by_truth_values_and_slices_too(memory: str) -> None:
    batch = Batch(LEVELS[0], 8, memory=memory)
    batch.run(keys(10, 8))
    batch.reset(np.arange(8) == 5)
    assert batch.ticks.tolist() == [10, 10, 10, 10, 10, 0, 10, 10]
    batch.reset([False] * 8)
    batch.reset([])
    assert batch.ticks.tolist() == [10, 10, 10, 10, 10, 0, 10, 10]
    batch.reset(slice(2, 4))
    assert batch.ticks.tolist() == [10, 10, 0, 0, 10, 0, 10, 10]


@pytest.mark.parametrize("memory", BOTH)
def test_press_jumps_as_a_keyboard_does(memory: str) -> None:
    held = [2, 6, 6, 2, 4, 4, 4, 0, 6, 5]
    pressed = with_press_bits(held)
    ours, theirs = (Batch(LEVELS[1], 1, memory=memory) for _ in range(2))
    theirs.run([[down] for down in pressed])
    ours.run([[down] for down in held[:6]], press=True)
    for down in held[6:]:
        ours.step([down], press=True)
    assert ours.digest(0) == theirs.digest(0)
    single = Simulation(LEVELS[1])
    for down in held:
        single.step(left=bool(down & 1), right=bool(down & 2), jump=bool(down & 4))
    assert single.inputs == pressed


@pytest.mark.parametrize("memory", BOTH)
def test_observations_cannot_be_written_and_are_not_printed(memory: str) -> None:
    batch = Batch(LEVELS[0], 3, memory=memory)
    for view in (batch.positions, batch.states, batch.levels_now, batch.places, batch.records, batch.objects):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = view[1]
    assert repr(batch) == f"<Batch of 3 worlds in 1 levels, circle, {memory}>"
    assert len(repr(batch.save())) < 80


def test_every_field_of_a_kind_is_one_of_the_objects_dtype() -> None:
    assert OBJECT_DTYPE.names is not None
    assert set(OBJECT_FIELDS) >= {"gold", "drone", "door"}
    assert {name for names in OBJECT_FIELDS.values() for name in names} == set(OBJECT_DTYPE.names)
