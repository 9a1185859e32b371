"""The agents: what is written is read, a file without one is named; the learned one passes new levels without JAX."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from examples.agents import LEARNED, PolicyAgent, RandomAgent, load_agent, load_policy
from examples.measure import measure
from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ArgumentError, FileError
from ninja_game.learn.observations.observation import Observation


def small_agent() -> PolicyAgent:
    """An agent with random weights."""
    rng = np.random.default_rng(0)
    shapes = [(30, 8), (8, 6)]
    layers = [(rng.random(shape).astype(np.float32), rng.random(shape[1]).astype(np.float32)) for shape in shapes]
    settings = {"observation": Observation("state").parts, "flat": True, "frame_skip": 4, "time_limit": 400}
    mean, scale = rng.random((2, 30)).astype(np.float32)
    return PolicyAgent(layers, mean, scale, settings, {"seed": 3})


def test_what_is_saved_is_loaded(tmp_path: Path) -> None:
    agent = small_agent()
    agent.save(tmp_path / "agent.npz")
    again = load_policy(tmp_path / "agent.npz")
    seen = np.random.default_rng(1).standard_normal((20, 30)).astype(np.float32)
    assert again.scores(seen).tobytes() == agent.scores(seen).tobytes()
    assert (again.settings, again.training) == (agent.settings, agent.training)
    agent.reset(20, 4)
    again.reset(20, 4)
    assert again.act(seen).tolist() == agent.act(seen).tolist()


def test_actions_are_drawn_by_their_chances() -> None:
    agent = small_agent()
    seen = np.repeat(np.random.default_rng(2).standard_normal((1, 30)).astype(np.float32), 20_000, axis=0)
    shares = np.bincount(agent.act(seen), minlength=6) / len(seen)
    chances = np.exp(agent.scores(seen[:1])[0])
    assert np.allclose(shares, chances / chances.sum(), atol=0.02)


def changed(path: Path, **arrays: object) -> Path:
    """The agent's file with other arrays, None: without one."""
    small_agent().save(path)
    with np.load(path) as stored:
        kept = {**stored, **arrays}
    with path.open("wb") as file:
        np.savez(file, **{name: array for name, array in kept.items() if array is not None})
    return path


@pytest.mark.parametrize(
    "arrays",
    [
        {"mean": np.zeros(29, np.float32)},
        {"weights_1": np.zeros((9, 6), np.float32)},
        {"weights_1": np.zeros((8, 7), np.float32), "biases_1": np.zeros(7, np.float32)},
        {"biases_0": None},
        {"about": None},
        {"about": np.array("no JSON")},
        {"about": np.array(json.dumps({"format": 2}))},
        {"about": np.array(json.dumps({"format": 1, "settings": {"observation": [{"part": "crystal ball"}]}}))},
        {"about": np.array(json.dumps([1]))},
        {"mean": np.array([print])},
    ],
    ids=str,
)
def test_a_file_that_holds_no_agent_is_named(tmp_path: Path, arrays: dict[str, object]) -> None:
    with pytest.raises(FileError, match=r"agent\.npz: (not an agent|an agent of another format)"):
        load_policy(changed(tmp_path / "agent.npz", **arrays))


@pytest.mark.parametrize("content", [b"", b"text", b"PK\x03\x04 torn"])
def test_other_files_are_named(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "agent.npz").write_bytes(content)
    with pytest.raises(FileError, match=r"agent\.npz: not an agent"):
        load_policy(tmp_path / "agent.npz")


def test_agents_by_name() -> None:
    assert isinstance(load_agent("random"), RandomAgent)
    with pytest.raises(ArgumentError, match="no agent 'nobody'; expected random, search, learned or a file"):
        load_agent("nobody")
    with pytest.raises(FileNotFoundError):
        load_agent("nobody.npz")


def test_the_random_agent_plays_everything_and_the_same_by_the_same_seed() -> None:
    agent = RandomAgent()
    rounds = []
    for _ in range(2):
        agent.reset(100, 5)
        rounds.append([agent.act(None).tolist() for _ in range(50)])
    assert rounds[0] == rounds[1]
    assert set(np.ravel(rounds[0])) == set(range(6))
    kept = np.mean(np.diff(np.array(rounds[0]), axis=0) == 0)
    assert 0.78 < kept < 0.88


@pytest.mark.slow
@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_it_passes_levels_that_it_has_never_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("jax", "optax"):
        monkeypatch.setitem(sys.modules, name, None)
    agent = load_agent("learned")
    assert isinstance(agent, PolicyAgent)
    learned = measure(agent, "bench:test:easy", episodes=1)["passed"].mean()
    chance = measure(RandomAgent(), "bench:test:easy", episodes=1)["passed"].mean()
    assert chance < 0.3
    assert learned > 0.45


def test_its_file_is_small_and_tells_how_it_was_made() -> None:
    agent = load_agent("learned")
    assert isinstance(agent, PolicyAgent)
    assert LEARNED.stat().st_size < 500_000
    assert {"level", "seed", "settings", "curve"} <= set(agent.training)
    assert {len(point) for point in agent.training["curve"]} == {5}
    assert not any(part.needs_goal for part in agent.settings["observation"])
