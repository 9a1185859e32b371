"""The search agent: it finds runs by save and restore alone, the same ones by the same seed."""

import numpy as np
import pytest

from examples.search import SearchAgent
from ninja_game import parse_level
from ninja_game.backend.memories import compiled_available
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.levels.origins import level_source
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.level import Level

SHUT_IN = parse_level("0" * 713 + "|5^100,566!11^400,300,130,30")  # the switch is out of reach


def outcome(level: Level, actions: np.ndarray) -> int:
    """What an environment says of a run."""
    worlds = EnvWorlds(level, 1)
    for action in actions:
        worlds.step(DISCRETE_KEYS[[action]])
    return int(worlds.outcomes[0])


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@pytest.mark.parametrize("name", ["00-0-first-steps", "02-0-red-means-no"])
def test_it_passes_levels_of_the_game(name: str) -> None:
    (level,) = level_source(name).levels
    found = SearchAgent().search(level, seed=1)
    assert found.actions is not None
    assert found.ticks < 2_000_000
    assert outcome(level, found.actions) == 1


def test_the_same_seed_finds_the_same_run_even_when_it_has_to_forget() -> None:
    level = level_source("00-0-first-steps").levels[0]
    small = SearchAgent(ticks=20_000, worlds=20, kept=40)
    runs = [small.search(level, seed) for seed in (1, 1, 2)]
    assert runs[0].ticks == runs[1].ticks
    assert np.array_equal(small.plan(level, 1), small.plan(level, 1))
    assert all(run.ticks <= 20_000 for run in runs)


def test_what_cannot_be_passed_costs_the_budget_and_gives_no_actions() -> None:
    agent = SearchAgent(ticks=5_000, worlds=20, kept=100)
    found = agent.search(SHUT_IN)
    assert found.actions is None
    assert 4_000 < found.ticks <= 5_000
    assert agent.plan(SHUT_IN).shape == (0,)
