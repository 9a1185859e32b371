"""What a type checker says of a user's script: unknown arguments, and those of wrong types, are found."""

from pathlib import Path

import pytest

GOOD = """
from ninja_game import record_replay, run_level
import numpy as np
from ninja_game.learn import GoldReward, NinjaEnv, NinjaVectorEnv, Rays, evaluate

env = NinjaEnv("00-0-first-steps", observation=["state", Rays(8)], reward="gold", frame_skip=2, repeat=0.25)
observation, info = env.reset(seed=3)
observation, reward, terminated, truncated, info = env.step(2)
envs = NinjaVectorEnv(8, "train", flat=True, reward=[GoldReward(0.1)], threads=1, render_mode="rgb_array")
run_level(env.level, [2, 2]), record_replay(env.level, np.array([2, 2]))
"""
WRONG = [
    'NinjaEnv(levle="set")',
    "NinjaEnv(observation=3)",
    'NinjaVectorEnv(8, frame_skip="4")',
    "NinjaVectorEnv(8, wrong_keyword=True)",
    'NinjaEnv(reward=["gold", 1.0])',
    'run_level(env.level, "222")',
]


@pytest.mark.slow
def test_mypy_takes_a_right_script_and_finds_what_is_wrong(tmp_path: Path) -> None:
    api = pytest.importorskip("mypy.api")
    script = tmp_path / "script.py"
    script.write_text("\n".join([GOOD, *WRONG]))
    text, errors, _ = api.run(["--strict", "--no-incremental", str(script)])
    lines = script.read_text().splitlines()
    found = {lines[int(line.split(":")[1]) - 1] for line in text.splitlines() if ": error:" in line}
    assert (found, errors) == (set(WRONG), ""), text
