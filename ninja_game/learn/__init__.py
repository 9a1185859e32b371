"""The worlds as Gymnasium environments, single and vector, with what learning needs around them (docs/learning.md).

Its import registers their ids. Each name is imported when it is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ninja_game.errors import MissingExtraError
from ninja_game.files.user_folder import how_to_install
from ninja_game.learn.protocol import PROTOCOL

try:
    from gymnasium.envs import registration
except ModuleNotFoundError:
    raise MissingExtraError(f"ninja_game.learn needs Gymnasium; {how_to_install('learn')}") from None

if TYPE_CHECKING:
    from ninja_game.learn.demonstrations import (
        Demonstration as Demonstration,
        UnplayableRecordingError as UnplayableRecordingError,
        demonstration as demonstration,
        write_minari as write_minari,
        write_npz as write_npz,
    )
    from ninja_game.learn.evaluation import Evaluation as Evaluation, LevelResult as LevelResult, evaluate as evaluate
    from ninja_game.learn.levels.origins import generated_levels as generated_levels, level_source as level_source
    from ninja_game.learn.levels.source import Curriculum as Curriculum, LevelSource as LevelSource
    from ninja_game.learn.observations.objects import LevelPlanes as LevelPlanes, NearObjects as NearObjects
    from ninja_game.learn.observations.pixels import Image as Image, Pixels as Pixels
    from ninja_game.learn.observations.surroundings import LocalTiles as LocalTiles, Rays as Rays
    from ninja_game.learn.observations.vectors import Guide as Guide, StateVector as StateVector, TimeLeft as TimeLeft
    from ninja_game.learn.rewards import (
        DeathPenalty as DeathPenalty,
        DistanceShaping as DistanceShaping,
        ExitReward as ExitReward,
        GoldReward as GoldReward,
        TimePenalty as TimePenalty,
    )
    from ninja_game.learn.single import NinjaEnv as NinjaEnv
    from ninja_game.learn.vector import NinjaVectorEnv as NinjaVectorEnv
    from ninja_game.learn.worlds import EnvWorlds as EnvWorlds

_NAMES = {
    "demonstrations": "Demonstration UnplayableRecordingError demonstration write_minari write_npz",
    "evaluation": "Evaluation LevelResult evaluate",
    "levels.curriculum": "Curriculum",
    "levels.origins": "generated_levels level_source",
    "levels.source": "LevelSource",
    "observations.objects": "LevelPlanes NearObjects",
    "observations.pixels": "Image Pixels",
    "observations.surroundings": "LocalTiles Rays",
    "observations.vectors": "Guide StateVector TimeLeft",
    "rewards": "DeathPenalty DistanceShaping ExitReward GoldReward TimePenalty",
    "single": "NinjaEnv",
    "vector": "NinjaVectorEnv",
    "worlds": "EnvWorlds",
}
_HOMES = {name: f"ninja_game.learn.{module}" for module, names in _NAMES.items() for name in names.split()}

__all__ = list(_HOMES)


_BENCH = {**PROTOCOL, "level": "bench:train"}

ENVIRONMENTS: dict[str, dict[str, Any]] = {
    "Ninja-v0": {},
    "NinjaPixels-v0": {"observation": "pixels"},
    "NinjaPixels-v1": {"observation": "image"},
    "NinjaSet-v0": {"level": "set"},
    "NinjaTrain-v0": {"level": "train"},
    "NinjaTest-v0": {"level": "test"},
    "NinjaCurriculum-v0": {"level": "curriculum"},
    "NinjaBench-v1": _BENCH,
    "NinjaBench-Gold-v1": {**_BENCH, "reward": ["exit", "gold"]},
    "NinjaBench-Pixels-v1": {**_BENCH, "observation": "image"},
    "NinjaBench-Rays-v1": {**_BENCH, "observation": ["state", "tiles", "rays"], "flat": True},
}
"""The registered ids and what they set besides the defaults; docs/learning.md tells what their version fixes."""

for _name, _settings in ENVIRONMENTS.items():
    if _name not in registration.registry:
        registration.register(
            _name,
            entry_point="ninja_game.learn.single:NinjaEnv",
            vector_entry_point="ninja_game.learn.vector:NinjaVectorEnv",
            kwargs=_settings,
        )


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for."""
    if name not in _HOMES:
        raise AttributeError(f"module 'ninja_game.learn' has no attribute {name!r}")
    value = globals()[name] = getattr(import_module(_HOMES[name]), name)
    return value
