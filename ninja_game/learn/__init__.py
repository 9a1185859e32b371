"""The worlds as Gymnasium environments, single and vector, and the tools of learning around them (docs/learning.md).

Importing this package registers their ids.
"""

from __future__ import annotations

from typing import Any

from ninja_game.errors import MissingExtraError
from ninja_game.runtime import install_hint

try:
    from gymnasium.envs import registration

    from ninja_game.learn.demonstrations import (
        Demonstration,
        UnplayableRecordingError,
        demonstration,
        write_minari,
        write_npz,
    )
    from ninja_game.learn.evaluation import Evaluation, LevelResult, evaluate
    from ninja_game.learn.levels.origins import generated_levels, level_source
    from ninja_game.learn.levels.source import Curriculum, LevelSource
    from ninja_game.learn.observations.objects import LevelPlanes, NearObjects
    from ninja_game.learn.observations.pixels import Image, Pixels
    from ninja_game.learn.observations.surroundings import LocalTiles, Rays
    from ninja_game.learn.observations.vectors import Guide, StateVector, TimeLeft
    from ninja_game.learn.protocol import PROTOCOL
    from ninja_game.learn.rewards import DeathPenalty, DistanceShaping, ExitReward, GoldReward, TimePenalty
    from ninja_game.learn.single import NinjaEnv
    from ninja_game.learn.vector import NinjaVectorEnv
    from ninja_game.learn.worlds import EnvWorlds
except ModuleNotFoundError as error:
    if not str(error.name).startswith("gymnasium"):
        raise
    raise MissingExtraError(f"ninja_game.learn needs Gymnasium; {install_hint('learn')}") from None

__all__ = [
    "Curriculum", "DeathPenalty", "Demonstration", "DistanceShaping", "EnvWorlds", "Evaluation", "ExitReward",
    "GoldReward", "Guide", "Image", "LevelPlanes", "LevelResult", "LevelSource", "LocalTiles", "NearObjects",
    "NinjaEnv", "NinjaVectorEnv", "Pixels", "Rays", "StateVector", "TimeLeft", "TimePenalty",
    "UnplayableRecordingError", "demonstration", "evaluate", "generated_levels", "level_source", "write_minari",
    "write_npz",
]  # fmt: skip

_BENCH = {**PROTOCOL, "level": "bench:train"}

ENVIRONMENTS: dict[str, dict[str, Any]] = {
    "Ninja-v0": {},
    "NinjaPixels-v0": {"observation": "image"},
    "NinjaSet-v0": {"level": "set"},
    "NinjaTrain-v0": {"level": "train"},
    "NinjaTest-v0": {"level": "test"},
    "NinjaCurriculum-v0": {"level": "curriculum"},
    "NinjaBench-v1": _BENCH,
    "NinjaBench-Gold-v1": {**_BENCH, "reward": ["exit", "gold"]},
    "NinjaBench-Pixels-v1": {**_BENCH, "observation": "image"},
    "NinjaBench-Rays-v1": {**_BENCH, "observation": ["state", "tiles", "rays"], "flat": True},
}
"""The registered ids with their settings besides the defaults; docs/learning.md explains their versions."""

for _name, _settings in ENVIRONMENTS.items():
    if _name not in registration.registry:
        registration.register(
            _name,
            entry_point="ninja_game.learn.single:NinjaEnv",
            vector_entry_point="ninja_game.learn.vector:NinjaVectorEnv",
            kwargs=_settings,
        )
