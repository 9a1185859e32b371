"""Evaluation: tables that seeds decide, rows that do not depend on each other, planners that are not believed."""

from typing import Any, ClassVar

import numpy as np
import pytest
from numpy.typing import NDArray

from ninja_game import load_replays
from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.learn.evaluation import Evaluation, evaluate
from ninja_game.learn.levels.source import LevelSource
from ninja_game.sim.level import Level

NEAR = parse_level_string("0" * 713 + "|5^100,566!0^130,566!11^260,564,230,564")
DEADLY = parse_level_string("0" * 713 + "|5^100,566!12^160,566!11^560,564,530,564")
LEVELS = LevelSource(["near", "deadly"], [NEAR, DEADLY])


class Runner:
    """Runs to the right, or about at random."""

    settings: ClassVar[dict[str, Any]] = {"frame_skip": 4}

    def __init__(self, share: float = 0.0) -> None:
        self.share = share

    def reset(self, count: int, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.count = count

    def act(self, observations: Any) -> NDArray[np.integer]:
        assert len(observations) == self.count
        drawn = self.rng.integers(6, size=self.count)
        return np.where(self.rng.random(self.count) < self.share, drawn, 2)


class Walker:
    """Plans to run to the right for this many steps."""

    settings: ClassVar[dict[str, Any]] = {"frame_skip": 4, "actions": "discrete"}

    def __init__(self, steps: int) -> None:
        self.steps = steps

    def plan(self, _level: Level, _seed: int) -> NDArray[np.integer]:
        return np.full(self.steps, 2)


def table(agent: Any, levels: LevelSource = LEVELS, **options: Any) -> Evaluation:
    return evaluate(agent, levels, memory="plain", time_limit=400, **{"episodes": 8, **options})


def test_a_policy_is_counted_by_what_came_of_its_episodes() -> None:
    near, deadly = table(Runner()).results
    assert (near.passed, near.dead, near.late, near.gold, near.reward, near.rate) == (8, 0, 0, 1.0, 1.0, 1.0)
    assert near.ticks > 50
    assert (deadly.passed, deadly.dead, deadly.late, deadly.reward) == (0, 8, 0, 0.0)
    assert np.isnan(deadly.ticks)


def test_time_over_is_late() -> None:
    near = evaluate(Runner(), LevelSource(["near"], [NEAR]), memory="plain", time_limit=20, episodes=3).results[0]
    assert (near.passed, near.late) == (0, 3)


def test_the_seed_decides_the_table_and_other_levels_do_not() -> None:
    agent = Runner(share=0.6)
    whole = table(agent, longest_wait=20)
    assert repr(whole) == repr(table(agent, longest_wait=20))
    assert repr(whole.results[1]) == repr(table(agent, LevelSource(["deadly"], [DEADLY]), longest_wait=20).results[0])
    assert repr(whole.results) != repr(table(agent, longest_wait=20, seed=5).results)


def test_without_noise_all_episodes_of_a_policy_are_one() -> None:
    ticks = {table(Runner(), repeat=0.0, longest_wait=0, episodes=n).results[0].ticks for n in (1, 7)}
    assert len(ticks) == 1


def test_both_memories_give_the_same_table() -> None:
    pytest.importorskip("numba")
    agent = Runner(share=0.3)
    assert repr(table(agent)) == repr(evaluate(agent, LEVELS, memory="compiled", time_limit=400, episodes=8))


def test_a_planner_is_believed_what_its_actions_do() -> None:
    near, deadly = table(Walker(60)).results
    assert (near.episodes, near.passed, deadly.episodes, deadly.dead) == (1, 1, 1, 1)
    for steps in (0, 3):
        near = table(Walker(steps)).results[0]
        assert (near.passed, near.dead, near.late) == (0, 0, 1)


def test_a_certificate_is_a_plan() -> None:
    recording = load_replays(bundled_replays()[0])[0]

    class Certified(Walker):
        settings: ClassVar[dict[str, Any]] = {"frame_skip": 1}

        def plan(self, _level: Level, _seed: int) -> NDArray[np.integer]:
            from ninja_game.learn.demonstrations import demonstration

            return demonstration(recording, memory="plain").actions

    result = evaluate(Certified(0), recording.level, memory="plain").results[0]
    assert (result.passed, result.ticks) == (1, recording.ticks)
