"""The agent that comes with the game: it plays without JAX, and passes levels of the game whatever chance does."""

from __future__ import annotations

import sys

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.learn.agents import load_agent
from ninja_game.learn.agents.load import learned_file
from ninja_game.learn.agents.policy import PolicyAgent
from ninja_game.learn.evaluation import evaluate


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_it_passes_three_levels_nine_times_in_ten(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("jax", "optax"):
        monkeypatch.setitem(sys.modules, name, None)
    table = evaluate(load_agent("learned"), ["00-0-first-steps", "00-2-rolling-hills", "01-1-the-chimney"], episodes=50)
    assert [each.rate >= 0.9 for each in table.results] == [True] * 3, table.text()
    chance = evaluate(load_agent("random"), "00-2-rolling-hills", episodes=20)
    assert chance.results[0].rate < 0.1


def test_its_file_is_small_and_tells_how_it_was_made() -> None:
    agent = load_agent("learned")
    assert isinstance(agent, PolicyAgent)
    assert learned_file().stat().st_size < 500_000
    assert {"levels", "seed", "curve"} <= set(agent.training)
    assert len(agent.training["curve"][0]) == 2 + len(agent.training["levels"])
