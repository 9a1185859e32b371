"""ninja-game: a playable N-style platformer whose world is that of N v1.4, bit for bit.

The public API is what ``__all__`` names, each imported when it is first used: docs/python-api.md describes it, and
docs/learning.md ``ninja_game.learn``. Every error that is raised on purpose is a ``NinjaGameError``.
"""

from __future__ import annotations

# Every import here is time in which the program does not handle signals yet; `typing` is the longest of them.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ninja_game.backend.memories import MemoryUnavailableError as MemoryUnavailableError
    from ninja_game.batch.batch import Batch as Batch, BatchState as BatchState
    from ninja_game.errors import (
        ArgumentError as ArgumentError,
        DemoError as DemoError,
        FormatError as FormatError,
        LevelError as LevelError,
        NinjaGameError as NinjaGameError,
        ReplayError as ReplayError,
    )
    from ninja_game.formats.load import (
        load_level as load_level,
        load_levels as load_levels,
        load_replays as load_replays,
        parse_level as parse_level,
    )
    from ninja_game.formats.n14.demo import parse_demo as parse_demo, write_demo as write_demo
    from ninja_game.formats.named_level import NamedLevel as NamedLevel
    from ninja_game.formats.recording import Recording as Recording
    from ninja_game.formats.replay.text import (
        Replay as Replay,
        parse_replay as parse_replay,
        write_replay as write_replay,
    )
    from ninja_game.runs.run import RunResult as RunResult, record_replay as record_replay, run_level as run_level
    from ninja_game.runs.trace import RunTrace as RunTrace, trace_level as trace_level
    from ninja_game.runs.verify import Verdict as Verdict, verify_recording as verify_recording
    from ninja_game.sim.inputs import Demo as Demo, Input as Input
    from ninja_game.sim.level import Level as Level, ObjectSpec as ObjectSpec
    from ninja_game.simulation import SaveState as SaveState, Simulation as Simulation

__version__ = "0.1.0"

_NAMES = {
    "backend.memories": "MemoryUnavailableError",
    "batch.batch": "Batch BatchState",
    "errors": "ArgumentError DemoError FormatError LevelError NinjaGameError ReplayError",
    "formats.load": "load_level load_levels load_replays parse_level",
    "formats.n14.demo": "parse_demo write_demo",
    "formats.named_level": "NamedLevel",
    "formats.recording": "Recording",
    "formats.replay.text": "Replay parse_replay write_replay",
    "runs.run": "RunResult record_replay run_level",
    "runs.trace": "RunTrace trace_level",
    "runs.verify": "Verdict verify_recording",
    "sim.inputs": "Demo Input",
    "sim.level": "Level ObjectSpec",
    "simulation": "SaveState Simulation",
}
_HOMES = {name: module for module, names in _NAMES.items() for name in names.split()}

__all__ = ["__version__", *_HOMES]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for, so that the program's help does not load NumPy."""
    if name not in _HOMES:
        raise AttributeError(f"module 'ninja_game' has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"ninja_game.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals() | _HOMES]
