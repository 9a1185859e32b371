"""ninja-game: a playable N-style platformer whose world is that of N v1.4, bit for bit.

The public API, each name imported when it is first used:

- levels: ``load_levels(path)``, ``load_level(path)``, ``parse_level(text)``, ``LevelData``
- a run: ``Simulation`` (step, look, save, restore, digest, inputs)
- whole runs: ``run_level``, ``trace_level``
- replays: ``load_replays(path)``, ``parse_replay``, ``record_replay``, ``write_replay``,
  ``verify_recording``
- errors: everything raised on purpose is a ``NinjaGameError``
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ninja_game.errors import DemoError, FormatError, LevelError, NinjaGameError, ReplayError

if TYPE_CHECKING:
    from ninja_game.formats.files import load_level, load_levels, load_replays
    from ninja_game.formats.level_string import parse_level_string as parse_level
    from ninja_game.formats.replay import Replay, parse_replay, write_replay
    from ninja_game.runs import RunResult, RunTrace, record_replay, run_level, trace_level
    from ninja_game.session.verify import Verdict, verify_recording
    from ninja_game.sim.level_data import LevelData
    from ninja_game.simulation import Simulation

__version__ = "0.1.0"

_HOMES = {
    "LevelData": ("ninja_game.sim.level_data", "LevelData"),
    "Replay": ("ninja_game.formats.replay", "Replay"),
    "RunResult": ("ninja_game.runs", "RunResult"),
    "RunTrace": ("ninja_game.runs", "RunTrace"),
    "Simulation": ("ninja_game.simulation", "Simulation"),
    "Verdict": ("ninja_game.session.verify", "Verdict"),
    "load_level": ("ninja_game.formats.files", "load_level"),
    "load_levels": ("ninja_game.formats.files", "load_levels"),
    "load_replays": ("ninja_game.formats.files", "load_replays"),
    "parse_level": ("ninja_game.formats.level_string", "parse_level_string"),
    "parse_replay": ("ninja_game.formats.replay", "parse_replay"),
    "record_replay": ("ninja_game.runs", "record_replay"),
    "run_level": ("ninja_game.runs", "run_level"),
    "trace_level": ("ninja_game.runs", "trace_level"),
    "verify_recording": ("ninja_game.session.verify", "verify_recording"),
    "write_replay": ("ninja_game.formats.replay", "write_replay"),
}

__all__ = [
    "DemoError",
    "FormatError",
    "LevelData",
    "LevelError",
    "NinjaGameError",
    "Replay",
    "ReplayError",
    "RunResult",
    "RunTrace",
    "Simulation",
    "Verdict",
    "__version__",
    "load_level",
    "load_levels",
    "load_replays",
    "parse_level",
    "parse_replay",
    "record_replay",
    "run_level",
    "trace_level",
    "verify_recording",
    "write_replay",
]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for, so that the program's help does not load NumPy."""
    if name not in _HOMES:
        raise AttributeError(f"module 'ninja_game' has no attribute {name!r}")
    module, attribute = _HOMES[name]
    value = getattr(import_module(module), attribute)
    globals()[name] = value
    return value
