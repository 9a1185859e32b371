"""ninja-game: a playable N-style platformer whose world is that of N v1.4, bit for bit.

The public API, each name imported when it is first used:

- levels: ``load_levels(path)``, ``load_level(path)``, ``parse_level(text)``, ``Level``, ``ObjectSpec``, ``NamedLevel``
- a run: ``Simulation`` (step, look, save, restore, digest), ``SaveState``, ``Input``
- whole runs: ``run_level`` and its ``RunResult``, ``trace_level`` and its ``RunTrace``
- many worlds: ``Batch``, ``BatchState``
- recordings: ``load_replays(path)``, ``Recording``, ``verify_recording``, ``Verdict``; our replays: ``Replay``,
  ``record_replay``, ``parse_replay``, ``write_replay``; the demos of N: ``Demo``, ``parse_demo``, ``write_demo``
- learning: ``gymnasium.make("ninja_game:Ninja-v0")``, ``ninja_game.learn``; docs/learning.md describes it
- errors: everything raised on purpose is a ``NinjaGameError``

docs/python-api.md describes them all.
"""

from __future__ import annotations

import sys

# Every import here is time in which the program does not handle signals yet; `typing` is the longest of them.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ninja_game.backend.memories import MemoryUnavailableError
    from ninja_game.batch.batch import Batch, BatchState
    from ninja_game.errors import ArgumentError, DemoError, FormatError, LevelError, NinjaGameError, ReplayError
    from ninja_game.formats.load import load_level, load_levels, load_replays, parse_level
    from ninja_game.formats.n14.demo import parse_demo, write_demo
    from ninja_game.formats.named_level import NamedLevel
    from ninja_game.formats.recording import Recording
    from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
    from ninja_game.runs.run import RunResult, record_replay, run_level
    from ninja_game.runs.trace import RunTrace, trace_level
    from ninja_game.runs.verify import Verdict, verify_recording
    from ninja_game.sim.inputs import Demo, Input
    from ninja_game.sim.level import Level, ObjectSpec
    from ninja_game.simulation import SaveState, Simulation

__version__ = "0.1.0"

_NAMES = {
    "batch.batch": ("Batch", "BatchState"),
    "backend.memories": ("MemoryUnavailableError",),
    "errors": ("ArgumentError", "DemoError", "FormatError", "LevelError", "NinjaGameError", "ReplayError"),
    "formats.load": ("load_level", "load_levels", "load_replays", "parse_level"),
    "formats.n14.demo": ("parse_demo", "write_demo"),
    "formats.named_level": ("NamedLevel",),
    "formats.recording": ("Recording",),
    "formats.replay.text": ("Replay", "parse_replay", "write_replay"),
    "runs.run": ("RunResult", "record_replay", "run_level"),
    "runs.trace": ("RunTrace", "trace_level"),
    "runs.verify": ("Verdict", "verify_recording"),
    "sim.inputs": ("Demo", "Input"),
    "sim.level": ("Level", "ObjectSpec"),
    "simulation": ("SaveState", "Simulation"),
}
_HOMES = {name: module for module, names in _NAMES.items() for name in names}

__all__ = [
    "ArgumentError",
    "Batch",
    "BatchState",
    "Demo",
    "DemoError",
    "FormatError",
    "Input",
    "Level",
    "LevelError",
    "MemoryUnavailableError",
    "NamedLevel",
    "NinjaGameError",
    "ObjectSpec",
    "Recording",
    "Replay",
    "ReplayError",
    "RunResult",
    "RunTrace",
    "SaveState",
    "Simulation",
    "Verdict",
    "__version__",
    "load_level",
    "load_levels",
    "load_replays",
    "parse_demo",
    "parse_level",
    "parse_replay",
    "record_replay",
    "run_level",
    "trace_level",
    "verify_recording",
    "write_demo",
    "write_replay",
]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for, so that the program's help does not load NumPy."""
    if name not in _HOMES:
        raise AttributeError(f"module 'ninja_game' has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"ninja_game.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


# `gymnasium.make("ninja_game:Ninja-v0")` imports this module for the ids, which that one registers.
if sys.modules.get("gymnasium"):
    __import__("ninja_game.learn")
