"""Medals follow from the fastest run of a level, the mark for all gold from the richest; both stay."""

from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.formats.pack.pars import Pars
from ninja_game.levels.episodes import Entry
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.player.progress import Mark, count_results, has_all_gold, medal_of, worst_medal
from ninja_game.sim.level import Body
from tests.support.players import EXIT_TICK, deadly_level, entry, played, player_data, short_level

PARS = Pars("", "", EXIT_TICK)


def with_pars(gold: int = 0) -> Entry:
    """A level whose gold lies on the way, all of it."""
    level = short_level(gold=gold)
    return replace(entry(replace(level, objects=level.objects[:-1])), pars=PARS)


def passed(folder: Path, level: Entry, *, wait: int = 0, practice: bool = False) -> tuple[list[str], Mark | None]:
    data = player_data(folder)
    run = LevelPlaythrough(data, level, practice_mode=practice)
    notices = run.passed(played(level.named.level, wait=wait, practice=practice))
    mark = data.marks.of(level.digest)
    data.close()
    return notices, mark


def test_better_medal_is_announced_once_and_slower_runs_change_nothing(tmp_path: Path) -> None:
    level = with_pars()
    notices, mark = passed(tmp_path, level, wait=10)
    assert mark == (EXIT_TICK + 10, 0)
    assert notices == ["First pass", "New medal"]
    notices, mark = passed(tmp_path, level)
    assert mark == (EXIT_TICK, 0)
    assert notices == ["Your best time", "New medal"]
    assert passed(tmp_path, level, wait=30) == ([], mark)


def test_all_gold_is_announced_once_and_stays_when_a_better_score_has_less(tmp_path: Path) -> None:
    level = with_pars(gold=2)
    notices, mark = passed(tmp_path, level)
    assert mark == (EXIT_TICK, 2)
    assert has_all_gold(level, mark)
    assert notices[1:] == ["New medal", "All gold"]
    assert passed(tmp_path, level) == ([], mark), "the same run again"
    data = player_data(tmp_path)
    assert data.marks.passed(level.digest, EXIT_TICK - 1, 0) == (EXIT_TICK - 1, 2)
    assert not has_all_gold(with_pars(), Mark(1, 0)), "a level without gold has no mark for it"
    data.close()


def test_practice_and_the_other_body_bring_no_medal(tmp_path: Path) -> None:
    level = with_pars()
    assert passed(tmp_path, level, practice=True) == ([], None)
    data = player_data(tmp_path)
    body: Body = "box"
    assert data.marks.passed(level.digest, 5, 0, body) == (5, 0)
    assert data.marks.all() == {}
    assert LevelPlaythrough(data, level, body="box").pars is None
    data.close()


def test_levels_without_pars_have_marks_and_no_medal(tmp_path: Path) -> None:
    notices, mark = passed(tmp_path, entry(short_level()))
    assert len(notices) == 1
    assert mark is not None
    assert medal_of(entry(short_level()), mark) == ""


def test_tally_counts_each_level_by_its_best_medal() -> None:
    first, second, third = with_pars(), with_pars(gold=1), entry(deadly_level())
    marks = {first.digest: Mark(EXIT_TICK, 0), second.digest: Mark(60, 1)}
    assert count_results([first, second, third], marks) == (3, 2, {"author": 1, "gold": 0, "silver": 0, "bronze": 1}, 1)
    assert worst_medal([first, second], marks) == "bronze"
    assert worst_medal([first, third], marks) == ""


@pytest.mark.parametrize("value", ["'odd'", "x'00'"])
def test_damaged_mark_is_left_out_and_mended_by_the_next_pass(tmp_path: Path, value: str) -> None:
    level = with_pars()
    passed(tmp_path, level)
    data = player_data(tmp_path)
    data.store.connection.execute(f"UPDATE level_mark SET fastest = {value}")
    assert data.marks.all() == {}
    data.close()
    assert passed(tmp_path, level)[1] == (EXIT_TICK, 0)
