"""The measured difficulty: deterministic, zero where nothing can go wrong, larger where more can."""

from types import SimpleNamespace

import numpy as np
import pytest

from ninja_game.batch.difficulty import _failing, difficulty
from ninja_game.formats.n14.level_string import parse_level_string
from tests.support.memories import BOTH

FLAT = "0" * 713 + "|5^100,566!11^700,564,130,564"
RUN = bytes([2] * 170)
JUMP = bytes([2] * 30 + [6] * 20 + [2] * 130)


def test_nothing_can_go_wrong_on_a_floor() -> None:
    assert difficulty(parse_level_string(FLAT), RUN, tries=32) == 0.0


@pytest.mark.parametrize("memory", BOTH)
def test_same_seed_gives_the_same_number_on_both_memories(memory: str) -> None:
    level = parse_level_string(FLAT + "!12^330,564")
    assert difficulty(level, JUMP, seed=3, tries=32, memory=memory) == difficulty(
        level, JUMP, seed=3, tries=32, memory="plain"
    )


def test_mines_along_the_way_make_a_level_harder() -> None:
    one = "!12^425,564"
    few, many = (difficulty(parse_level_string(FLAT + text), JUMP, tries=64) for text in (one, one + "!12^196,564"))
    assert 0 < few < many


def test_run_that_dies_whatever_is_tried_has_a_finite_number() -> None:
    level = parse_level_string(FLAT + "".join(f"!12^{x},564" for x in range(200, 700, 8)))
    assert 1 < difficulty(level, RUN, tries=32) < 100


def test_a_try_that_lost_the_run_counts_a_quarter_of_one_that_died() -> None:
    # The true run first; then one that died, one far away, one near, one that passed far away.
    batch = SimpleNamespace(
        outcomes=np.array([0, 2, 0, 0, 1]), positions=np.array([[0, 0], [0, 0], [80, 0], [60, 0], [80, 0]])
    )
    assert _failing(batch, slice(1, None)) == (1 + 0.25) / 4  # type: ignore[arg-type]
    batch.outcomes[1:] = 2
    assert _failing(batch, slice(1, None)) == 1 - 0.5 / 4, "of tries that all die one might have lived"  # type: ignore[arg-type]
