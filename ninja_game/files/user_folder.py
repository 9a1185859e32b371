"""The places of the player's files: settings, records, levels, replays, pictures."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from itertools import count
from pathlib import Path

from ninja_game.errors import FileError
from ninja_game.files.shown_text import file_stem, name_key

HOME_VARIABLE = "NINJA_GAME_HOME"  # environment variable that moves the folder

# Folders in it.
LEVELS = "levels"
DAILY = "daily-levels"  # in the folder of levels: the pack of daily levels
REPLAYS = "replays"
EXPORTS = "exports"  # files that the game writes on request
EDITING = "editing"  # levels under edit
STAMPS = "stamps"  # parts of levels, kept in the level editor

# Files in it.
SETTINGS = "settings.toml"
RECORDS = "records.sqlite"

REPLAY_SUFFIX = ".replay.txt"  # the end of our replays' names


def user_folder() -> Path:
    """The folder, whether it exists or not: ``NINJA_GAME_HOME``, else the system's place for data of programs.

    Raises FileError where ``NINJA_GAME_HOME`` begins with a ``~name`` of an unknown user, or the user has no home.
    """
    return folder_from_variable(HOME_VARIABLE, _system_folder)


def _system_folder() -> Path:
    # The page sets its folder itself, and lacks this library.
    from platformdirs import user_data_path

    return user_data_path("ninja-game", appauthor=False)


def cache_folder() -> Path:
    """The system's cache folder: compiled code, pages, a board's memo; all of it can be made again."""
    from platformdirs import user_cache_path

    return user_cache_path("ninja-game", appauthor=False)


def folder_from_variable(variable: str, otherwise: Callable[[], Path]) -> Path:
    """The folder in an environment variable, or a default. Raises FileError without either."""
    named = os.environ.get(variable)
    try:
        return Path(named).expanduser() if named else otherwise()
    except RuntimeError as error:
        what = f"{variable} names no folder" if named else f"no folder for the program's files ({error})"
        hint = "" if named else f"name one with {variable}"
        raise FileError(what, found=named or "", expected="a path" if named else "", hint=hint) from None


def make_user_folder(folder: Path) -> None:
    """Make the folders in it, with its parents, if they are missing. Raises OSError if that is impossible."""
    for name in (LEVELS, REPLAYS, EXPORTS):
        (folder / name).mkdir(parents=True, exist_ok=True)


def quarantine(path: Path, why: str) -> Path:
    """Rename a file that cannot be used, and the files that SQLite keeps next to it; its new path.

    ``why``: one word for the new name. Nothing is ever overwritten. Raises OSError.
    """
    number = 1
    while (target := path.with_name(f"{path.stem}.{why}-{number}{path.suffix}")).exists():
        number += 1
    path.replace(target)
    for tail in ("-wal", "-shm", "-journal"):
        aside = path.with_name(path.name + tail)
        if aside.exists():
            aside.replace(target.with_name(target.name + tail))
    return target


def short_path(path: Path) -> str:
    """A path as people read it: ``~`` is the user's own folder."""
    with suppress(RuntimeError, ValueError):
        return str(Path("~") / path.relative_to(Path.home()))
    return str(path)


def free_path(folder: Path, stem: str, suffix: str, first: int = 1) -> Path:
    """The first of ``stem.txt``, ``stem-2.txt``, … (for ``.txt``) that is free on every system.

    ``first``: how many names have no number; with 0 the first one is ``stem-1.txt``.
    """
    taken: set[str] = set()
    with suppress(OSError):
        taken = {name_key(path.name) for path in folder.iterdir()}
    names = (f"{stem}-{number}{suffix}" if number > first else f"{stem}{suffix}" for number in count(1))
    return folder / next(name for name in names if name_key(name) not in taken)


def export_path(folder: Path, title: str, suffix: str, first: int = 0) -> Path:
    """A free path for a picture, a film or a replay that the game writes: ``exports/title-1.gif`` and so on.

    Characters that a file name cannot hold become "-". ``first``: as in ``free_path``. Raises OSError without a folder.
    """
    exports = folder / EXPORTS
    exports.mkdir(parents=True, exist_ok=True)
    return free_path(exports, file_stem(title, "replay"), suffix, first)
