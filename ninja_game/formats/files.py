"""Load any file or folder of levels or recordings, whatever its format."""

from __future__ import annotations

from pathlib import Path

from ninja_game.errors import LevelError, ReplayError
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.formats.text_file import SUFFIXES, read_text, text_files
from ninja_game.sim.level_data import LevelData

__all__ = ["NamedLevel", "Recording", "load_levels", "load_replays"]


def load_levels(path: Path | str) -> list[NamedLevel]:
    """All levels of a file or folder: our ASCII levels, N level files, in-game strings, levels of recordings.

    Raises LevelError (or ReplayError for a broken replay) naming the file; OSError for a file that cannot be opened.
    """
    files = text_files(Path(path))
    levels = [level for file in files for level in parse_levels(read_text(file), file=str(file))]
    if not levels:
        raise LevelError("no levels here", str(path), expected=f"files *{', *'.join(SUFFIXES)}")
    return levels


def load_replays(path: Path | str, *, level: LevelData | None = None) -> list[Recording]:
    """All recordings of a file or folder: our replays and ``$name#author#comment#level#demo#`` records.

    ``level``: what recordings that do not hold their level are played on.

    Raises ReplayError, DemoError or LevelError naming file and line; OSError for a file that cannot be opened.
    """
    files = text_files(Path(path))
    recordings = [found for file in files for found in parse_replays(read_text(file), file=str(file), level=level)]
    if not recordings:
        raise ReplayError("no recordings here", str(path), expected=f"files *{', *'.join(SUFFIXES)}")
    return recordings
