"""Levels without end: a known run passes each, none is both for learning and for the test, worlds draw them."""

import pickle
from copy import deepcopy
from hashlib import sha256
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ArgumentError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.learn import Curriculum, DistanceShaping, EnvWorlds, NinjaEnv
from ninja_game.learn.levels.bench import BASES, BENCH_GRADES, COUNTS, LARGEST, _base, _bases, _table, bench_level
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.levels.source import LevelSource
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.loader import object_table
from tools.bench_levels import passes

FAST = "compiled" if compiled_available() else "plain"
HOW: dict[str, Any] = {"repeat": 0.25, "longest_wait": 3, "time_limit": 100}
SEEN = ["state", "tiles", "rays", "objects", "planes", "pixels"]


def test_known_runs_pass_a_sample() -> None:
    rng = np.random.default_rng(1)
    for split, count in COUNTS.items():
        for number in rng.integers(count, size=45).tolist():
            assert passes(bench_level(split, number)), (split, number)


def test_grades_take_turns_and_tell_how_long_a_known_run_is() -> None:
    for number in range(60):
        found = bench_level("train", number)
        assert found.grade == list(BENCH_GRADES)[number % 3]
        assert found.grade == "hard" or len(found.inputs) <= {"easy": 120, "medium": 240}[found.grade]


@pytest.mark.slow
def test_no_level_of_the_test_is_one_to_learn_in() -> None:
    train, test = (_bases(split) for split in COUNTS)
    assert (len(train), len(test), len({*train, *test})) == (900, 100, BASES)
    tiles = [{_base(k, mirrored).level.tiles for k in bases for mirrored in (False, True)} for bases in (train, test)]
    assert not tiles[0] & tiles[1]


def test_the_levels_never_change() -> None:
    digests = [level_digest(bench_level(split, number).level) for split in COUNTS for number in range(60)]
    assert sha256("".join(digests).encode()).hexdigest()[:16] == "4a185c1f7f3dd742"
    assert len(_table()) == sum(COUNTS.values())


def test_other_levels_have_another_digest() -> None:
    """Those of the test, and as many to learn in, have the same numbers."""
    names = ("bench:test", "bench:train:0-999", "bench:train:0-998", "bench:val")
    assert len({level_source(name).digest for name in names}) == len(names)
    trained, watched = (set(level_source(name).names) for name in ("bench:train:easy:0-98999", "bench:val:easy"))
    assert (len(trained), len(watched), trained & watched) == (33_000, 334, set())


def test_a_variation_takes_away_gold_and_killers_and_adds_nothing() -> None:
    slots = [object_table(_base(k, mirrored=False).level).slots for k in range(0, BASES, 5)]
    most = object_table(_base(LARGEST, mirrored=False).level).slots
    assert max(slots) <= most
    golds = [bench_level("train", n).level.gold for n in range(0, 30, 3)]
    assert len(set(golds)) > 3
    for number in range(100):
        level = bench_level("train", number).level
        assert object_table(level).slots <= most
        assert [spec.kind for spec in level.objects].count(GOLD) == level.gold


@pytest.mark.parametrize(
    "words,count,first",
    [
        ("bench:train", 100_000, "bench-train-0"),
        ("bench:test", 1000, "bench-test-0"),
        ("bench:test:medium", 333, "bench-test-1"),
        ("bench:train:17", 1, "bench-train-17"),
        ("bench:train:10-19", 10, "bench-train-10"),
        ("bench:train:hard:10-19", 3, "bench-train-11"),
        ("bench:val", 1000, "bench-train-99000"),
        ("bench:val:medium:0-5", 2, "bench-train-99001"),
    ],
)
def test_sources_by_name(words: str, count: int, first: str) -> None:
    source = level_source(words)
    assert (len(source.levels), len(source.names), source.names[0]) == (count, count, first)
    split, number = first.split("-")[1:]
    assert source.levels[0] == bench_level(split, int(number)).level
    assert source.numbers(first).tolist() == [0]
    assert level_source([words]).names == source.names


@pytest.mark.parametrize(
    "wrong",
    [
        "",
        "set",
        "train:5000000",
        "test:harder",
        "train:9-3",
        "train:-3",
        f"train:{'9' * 5000}",
        "test:",
        "test:easy:",
        "test:0-1000",
        "test:easy:2",
    ],
)
def test_other_names_are_reported(wrong: str) -> None:
    with pytest.raises(ArgumentError, match="expected 'bench:train'"):
        level_source(f"bench:{wrong}")
    with pytest.raises(ArgumentError, match="numbers 0 to 999, "):
        level_source("bench:test:1000")
    with pytest.raises(ArgumentError, match="counted from 0"):
        bench_level("train", 100_000)


def test_what_cannot_be_done_with_levels_without_end_is_reported() -> None:
    with pytest.raises(ArgumentError, match="expected it alone"):
        level_source(["bench:train", "set"])
    with pytest.raises(ArgumentError, match="holds its levels"):
        Curriculum(level_source("bench:train"))
    with pytest.raises(ArgumentError, match="not made for levels without end"):
        EnvWorlds("bench:train", 1, memory="plain", observation="guide")
    with pytest.raises(ArgumentError, match="not made for levels without end"):
        EnvWorlds("bench:train", 1, memory="plain", reward=DistanceShaping())


class Held(LevelSource):
    """Some levels of a source without end, held, and drawn as that source draws them."""

    def __init__(self, source: LevelSource, numbers: list[int]) -> None:
        super().__init__([source.names[k] for k in numbers], [source.levels[k] for k in numbers])
        self._source, self._numbers = source, numbers

    def choose(self, draws: NDArray[np.uint64]) -> NDArray[np.intp]:
        return np.array([self._numbers.index(k) for k in self._source.choose(draws).tolist()], np.intp)


@pytest.mark.parametrize(
    "memory", ["plain", pytest.param("compiled", marks=pytest.mark.skipif(FAST == "plain", reason="no Numba"))]
)
def test_drawn_levels_are_played_as_held_ones(memory: str) -> None:
    count, steps = {"plain": (3, 40), "compiled": (20, 120)}[memory]
    source = level_source("bench:train")
    worlds = EnvWorlds(source, count, observation=SEEN, memory=memory, **HOW)
    worlds.reset(seeds=range(count))
    actions = np.random.default_rng(0).choice([0, 1, 2, 4, 5, 6], size=(steps, count)).astype(np.uint8)
    played = []
    for row in actions:
        worlds.step(row, worlds.ended())
        shown = worlds.observations
        assert isinstance(shown, dict)
        played.append((worlds.levels_now.tolist(), [shown[name].copy() for name in SEEN], worlds.ticks.tolist()))
    numbers = sorted({number for levels, _, _ in played for number in levels})
    assert len(numbers) > count
    held = EnvWorlds(Held(source, numbers), count, observation=SEEN, memory=FAST, **HOW)
    held.reset(seeds=range(count))
    for row, (levels, seen, ticks) in zip(actions, played, strict=True):
        held.step(row, held.ended())
        shown = held.observations
        assert isinstance(shown, dict)
        assert [numbers[k] for k in held.levels_now.tolist()] == levels
        assert held.ticks.tolist() == ticks
        for name, array in zip(SEEN, seen, strict=True):
            assert (shown[name] == array).all(), name


def test_copies_and_saved_moments_of_drawn_levels_go_on_alike() -> None:
    worlds = EnvWorlds("bench:test:easy", 4, memory=FAST, observation=["state", "rays"], flat=True, repeat=0.25)
    keys = np.full(4, 2, np.uint8)
    for _ in range(30):
        worlds.step(keys, worlds.ended())
    moment, then = worlds.save(), np.array(worlds.observations)
    copies = [deepcopy(worlds), pickle.loads(pickle.dumps(worlds))]
    for _ in range(30):
        for each in (worlds, *copies):
            each.step(keys, each.ended())
    for each in copies:
        assert np.array_equal(np.asarray(each.observations), np.asarray(worlds.observations))
        assert each.levels_now.tolist() == worlds.levels_now.tolist()
    worlds.restore(moment)
    assert np.array_equal(np.asarray(worlds.observations), then)
    with pytest.raises(ArgumentError, match="do not fit"):
        EnvWorlds("bench:test:hard", 4, memory=FAST).restore(moment)


def test_a_single_environment_plays_a_level_that_is_asked_for() -> None:
    env = NinjaEnv("bench:train", memory="plain")
    _, info = env.reset(seed=3, options={"level": "bench-train-99"})
    assert (info["level"], env.level) == ("bench-train-99", bench_level("train", 99).level)
    _, info = env.reset(options={"level": 7})
    assert info["level"] == "bench-train-7"
