"""Training: the same seed makes the same agent, episodes begin where they teach most, the command keeps the best."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from examples.agents import PolicyAgent, load_policy
from examples.ppo import PPOSettings
from examples.starts import SPACING, Starts, runs_through
from examples.train import ROUND, Progress, Task, main, train
from ninja_game.backend.memories import compiled_available
from ninja_game.learn.levels import level_source
from ninja_game.learn.worlds import EnvWorlds
from tests.support.waiting import LONGEST
from tools import ROOT

pytestmark = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
pytest.importorskip("jax")

LEVELS = ["00-0-first-steps", "00-1-mind-the-gap"]


def short(seed: int) -> Task:
    """A task of two rounds."""
    return Task(
        level_source(LEVELS),
        steps=2 * ROUND * 16,
        seed=seed,
        worlds=16,
        searches=0,
        method=PPOSettings(hidden=8, batch=64),
    )


def arrays(agent: PolicyAgent) -> bytes:
    """Everything that decides what an agent does."""
    parts = [array for layer in agent.layers for array in layer]
    return b"".join(array.tobytes() for array in (*parts, agent.mean, agent.scale))


@pytest.mark.slow
def test_the_same_seed_makes_the_same_agent() -> None:
    reports: list[Progress] = []
    better: list[PolicyAgent] = []
    first = train(short(1), report=reports.append, on_better=better.append)
    assert arrays(first) == arrays(train(short(1))) != arrays(train(short(2)))
    assert [progress.steps for progress in reports] == [ROUND * 16, 2 * ROUND * 16]
    assert better == [first]
    assert first.training["levels"] == LEVELS
    assert len(first.training["curve"][-1]) == 2 + len(LEVELS)


def test_starts_are_moments_of_the_certificates() -> None:
    source = level_source(LEVELS)
    starts = Starts(source, {}, 0, searches=0)
    (run,) = runs_through(source.names[1], source.levels[1], 0, 0)
    worlds = EnvWorlds(source, 3)
    number = int(np.flatnonzero(starts.level_of == 1)[5])
    starts.put(worlds, np.array([2]), np.array([number]))
    alone = EnvWorlds(source.levels[1], 1, frame_skip=1)
    for tick in range(5 * SPACING):
        alone.step(run[tick : tick + 1])
    assert worlds.ticks[2] == 5 * SPACING
    assert worlds.digest(2) == alone.digest(0)
    assert starts.limits[number] < starts.limits[1]


def test_episodes_begin_where_they_fail_next_and_at_the_start_of_the_level() -> None:
    starts = Starts(level_source(LEVELS[:1]), {}, 0, searches=0)
    starts.rates[:] = 0.0
    starts.rates[10:] = 1.0
    chosen = starts.choose(4000, np.random.default_rng(0))
    shares = np.bincount(chosen, minlength=len(starts.rates)) / 4000
    assert shares[9] > 0.4
    assert 0.2 < shares[0] < 0.4
    before = starts.rates.copy()
    starts.note(np.array([9, 9, 12]), np.array([True, False, False]))
    assert starts.rates[9] > before[9]
    assert starts.rates[12] < before[12]
    assert (np.delete(starts.rates, [9, 12]) == np.delete(before, [9, 12])).all()


def test_a_level_without_a_certificate_is_searched() -> None:
    level = level_source(LEVELS[0]).levels[0]
    first, second = runs_through("a level of mine", level, 1, 2)
    assert first.tobytes() != second.tobytes()
    for run in (first, second):
        worlds = EnvWorlds(level, 1, frame_skip=1)
        for keys in run:
            worlds.step(np.array([keys]))
        assert worlds.outcomes[0] == 1


@pytest.mark.slow
def test_the_program_keeps_the_agent_and_says_how_good_it_is(tmp_path: Path) -> None:
    output = tmp_path / "agent.npz"
    words = ["--levels", LEVELS[0], "--steps", "500", "--worlds", "16", "-o", str(output)]
    result = CliRunner().invoke(main, words, catch_exceptions=False)
    assert result.exit_code == 0
    assert "agent.npz: the best agent, after 0.0M steps" in result.output
    assert "%  00-0-first-steps" in result.output
    assert load_policy(output).training["seed"] == 0
    result = CliRunner().invoke(main, words)
    assert (result.exit_code, "exists; name another file" in result.stderr) == (2, True)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals are another thing there")
def test_a_training_that_is_stopped_leaves_the_best_agent(tmp_path: Path) -> None:
    output = tmp_path / "agent.npz"
    words = ["--levels", LEVELS[0], "--seconds", "3000", "--worlds", "16", "-o", str(output)]
    program = [sys.executable, "-m", "examples.train", *words]
    with subprocess.Popen(program, stderr=subprocess.PIPE, cwd=ROOT) as training:
        while not output.exists():
            assert training.poll() is None
            time.sleep(0.2)
        training.send_signal(signal.SIGINT)
        _, errors = training.communicate(timeout=LONGEST)
    assert training.returncode == 130
    assert b"stopped" in errors
    assert load_policy(output).training["curve"]
    assert list(tmp_path.iterdir()) == [output]
