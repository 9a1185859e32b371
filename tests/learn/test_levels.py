"""Levels to learn in: every origin, the fixed split, the curriculum."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from ninja_game import Level, LevelError, load_level, load_levels
from ninja_game.errors import ArgumentError
from ninja_game.files.bundled import bundled_levels
from ninja_game.learn.levels.origins import Origin, generated_levels, level_source
from ninja_game.learn.levels.source import Curriculum, LevelSource

FLAT = "0" * 713 + "|5^100,566!0^160,566"
PACK = Path(__file__).resolve().parents[1] / "pack"


def draws(count: int) -> NDArray[np.uint64]:
    return np.random.default_rng(0).integers(2**64, size=count, dtype=np.uint64)


def test_every_origin_gives_its_levels() -> None:
    first = load_level(bundled_levels()[0])
    named = load_levels(PACK / "00-0-run-and-hop.txt")[0]
    origins: tuple[tuple[Origin, list[Level]], ...] = (
        ("00-0-first-steps", [first]),
        (first, [first]),
        (named, [named.level]),
        (PACK / "00-0-run-and-hop.txt", [named.level]),
        (str(PACK), [each.level for each in load_levels(PACK)]),
        (FLAT, [level_source(FLAT).levels[0]]),
        (["00-0-first-steps", named], [first, named.level]),
    )
    for origin, levels in origins:
        assert level_source(origin).levels == levels
    source = level_source("set")
    assert level_source(source) is source
    assert len(set(source.names)) == len(bundled_levels())


def test_levels_of_one_name_are_told_apart_by_numbers(tmp_path: Path) -> None:
    path = tmp_path / "two.nlevel"
    path.write_text(f"{FLAT}\n{FLAT}\n")
    assert level_source(path).names == ["two#0", "two#1"]
    assert level_source([FLAT, path, FLAT]).names == ["level#0", "two#0", "two#1", "level#1"]


def test_the_split_is_one_level_of_each_episode_and_never_changes() -> None:
    whole, train, test = (level_source(part).names for part in ("set", "train", "test"))
    assert sorted(train + test) == sorted(whole)
    digits = "002 013 024 030 101 112 123 134 200 211 222 233 304 310 321 332 403 414 420 431"
    assert " ".join(name[:2] + name[3] for name in test) == digits


@pytest.mark.parametrize(
    "wrong", ["00-0-first-stepz", "nowhere.txt", "", "generated:3", "generated:11:1", "generated:3:a-b", "a\0b",
              "packed:0", "packed:11"],
)  # fmt: skip
def test_a_level_that_does_not_exist_is_an_error_that_names_levels(wrong: str) -> None:
    with pytest.raises(ArgumentError, match="expected"):
        level_source(wrong)


def test_a_level_that_cannot_be_read_is_a_level_error() -> None:
    with pytest.raises(LevelError):
        level_source("no|level")
    with pytest.raises(ArgumentError, match="expected a name, a path, a Level"):
        level_source([])


def test_levels_are_chosen_alike() -> None:
    counts = np.bincount(level_source("test").choose(draws(20_000)), minlength=20)
    assert counts.min() > 850
    assert counts.max() < 1150


def test_levels_are_chosen_by_name_or_number() -> None:
    source = LevelSource(["a", "b"], level_source([FLAT, FLAT]).levels)
    assert source.numbers("b", 3).tolist() == [1, 1, 1]
    assert source.numbers(["b", 0], 2).tolist() == [1, 0]
    assert source.numbers(np.array([1, 0]), 2).tolist() == [1, 0]
    wrong: Any
    for wrong in ("c", 2, -1, 0.5, [0, 1, 0]):
        with pytest.raises(ArgumentError, match="expected"):
            source.numbers(wrong, 2)


def test_the_digest_is_of_the_levels_alone() -> None:
    one, other = level_source(FLAT), level_source("00-0-first-steps")
    assert one.digest == LevelSource(["x"], one.levels).digest != other.digest


def test_a_curriculum_begins_with_the_easiest_levels() -> None:
    source = level_source("curriculum")
    assert isinstance(source, Curriculum)
    assert source.difficulties == sorted(source.difficulties)
    assert set(source.names) == set(level_source("train").names)
    assert set(source.choose(draws(1000)).tolist()) == {0, 1, 2}
    assert set(level_source("curriculum:test").names) == set(level_source("test").names)


def test_a_curriculum_opens_the_next_level_when_the_open_ones_are_passed() -> None:
    source = Curriculum(level_source([FLAT] * 6), difficulties=[5, 4, 3, 2, 1, 0], start=2, threshold=0.75)
    for _ in range(50):
        source.report(np.array([0, 1]), np.array([False, True]))
    assert source.open == 2
    assert np.bincount(source.choose(draws(10_000))).argmax() == 0
    for _ in range(30):
        source.report(np.array([0]), np.array([True]))
    assert source.open == 3
    for _ in range(90):
        source.report(np.arange(6), np.ones(6, bool))
    assert source.open == 6


def test_every_random_number_chooses_a_level_that_is_open() -> None:
    edges = np.array([0, 2**63, 2**64 - 1], np.uint64)
    assert Curriculum(level_source("test")).choose(edges).tolist() == [0, 1, 2]


def test_a_curriculum_counts_episodes_of_one_report_as_of_many() -> None:
    one, many = (Curriculum(level_source([FLAT]), difficulties=[0]) for _ in range(2))
    one.report(np.zeros(5, np.intp), np.ones(5, bool))
    for _ in range(5):
        many.report(np.zeros(1, np.intp), np.ones(1, bool))
    assert one.rates == pytest.approx(many.rates)


def test_a_curriculum_needs_to_know_how_hard_its_levels_are() -> None:
    with pytest.raises(ArgumentError, match="difficulty of level is not known"):
        Curriculum(level_source(FLAT))
    with pytest.raises(ArgumentError, match="one for each level"):
        Curriculum(level_source(FLAT), difficulties=[1, 2])
    with pytest.raises(ArgumentError, match=r"found 'train'; expected a LevelSource"):
        Curriculum("train")  # type: ignore[arg-type]


@pytest.mark.slow
def test_generated_levels_are_those_of_their_seeds() -> None:
    pytest.importorskip("numba")
    source = level_source("generated:1:3-4")
    assert source.names == ["generated-1-3", "generated-1-4"]
    assert source.levels == generated_levels([3, 4], 1).levels


@pytest.mark.parametrize("difficulty", [1, 10])
def test_packed_levels_are_those_of_a_difficulty(difficulty: int) -> None:
    source = level_source(f"packed:{difficulty}")
    assert {name.rpartition("-")[0] for name in source.names} == {f"generated-{difficulty}"}
