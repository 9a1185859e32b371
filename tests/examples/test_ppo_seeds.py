"""Several seeds at once: processes play what one would, and every seed learns for itself."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from examples.agents import load_policy
from examples.ppo_seeds import main
from ninja_game.backend.memories import compiled_available
from tests.examples.test_ppo import arrays
from tests.support.waiting import LONGEST
from tools import ROOT

fast = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes are copied")

PLAYED = """
import numpy as np
from examples.ppo import Player, Settings
from examples.ppo_seeds import Crew
settings = Settings(worlds=16, round=8, time_limit=40)
crew = Crew("bench:train:0-9", [3, 5], settings, 4)
rng = np.random.default_rng(0)
players = [Player("bench:train:0-9", 16, settings, threads=1) for _ in range(2)]
for player, seed in zip(players, (3, 5)):
    player.begin(seed * 16)
for step in range(40):
    actions = rng.integers(6, size=(2, 16))
    begins = [player.begins.copy() for player in players]
    told = [player.step(row) for player, row in zip(players, actions)]
    crew.step(actions)
    for row, (player, (rewards, terminated, ended)) in enumerate(zip(players, told)):
        assert (crew.observed[row] == player.observed).all(), step
        assert (crew.counts[step % 8, row] == ~begins[row]).all()
        assert (crew.rewards[step % 8, row] == rewards).all()
        assert (crew.terminated[step % 8, row] == terminated).all()
        assert (crew.ended[step % 8, row] == ended).all()
for row, player in enumerate(players):
    every = np.concatenate(player.episodes)
    assert crew.counted[row, :, :2].sum(axis=0).tolist() == [len(every), every.sum()] != [0, 0]
"""
LEARNED = """
from pathlib import Path
from examples.ppo import Settings
from examples.ppo_seeds import train
settings = Settings(hidden=8, worlds=16, round=8, batch=64)
train("bench:train:0-9", 512, [1, 2], 2, Path(), settings)
"""


def run(program: str, folder: Path) -> None:
    """In a process of its own: one with threads is not copied."""
    environment = {"PYTHONPATH": str(ROOT), "JAX_PLATFORMS": "cpu"}
    words = [sys.executable, "-c", program]
    subprocess.run(words, cwd=folder, check=True, timeout=LONGEST, env=os.environ | environment)


@fast
@linux
def test_processes_play_what_one_plays(tmp_path: Path) -> None:
    run(PLAYED, tmp_path)


@fast
@linux
@pytest.mark.slow
def test_each_seed_learns_for_itself(tmp_path: Path) -> None:
    pytest.importorskip("jax")
    run(LEARNED, tmp_path)
    first, last, other = (load_policy(tmp_path / f"ppo-{name}.npz") for name in ("1-01", "1-04", "2-04"))
    assert len({arrays(agent) for agent in (first, last, other)}) == 3
    assert (first.mean == last.mean).all()
    assert [point[0] for point in last.training["curve"]] == [128, 256, 384, 512]
    assert all(np.isfinite(weights).all() for weights, _ in last.layers)


def test_what_cannot_be_is_reported(tmp_path: Path) -> None:
    for words, expected in (
        (["-o", str(tmp_path)], "exists"),
        (["--each", "3", "-o", str(tmp_path / "new")], "divisor"),
    ):
        result = CliRunner().invoke(main, words)
        assert result.exit_code != 0
        assert expected in result.output
