"""The places of the player's files: settings, records, levels, replays, pictures."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import count
from pathlib import Path

from ninja_game.errors import FileError
from ninja_game.files.shown_text import file_stem, name_key
from ninja_game.runtime import IN_PAGE, ONLY_ON_A_DESKTOP

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


def make_user_folder(folder: Path | None = None) -> Path:
    """The folder with its parents, made if they are missing. Raises OSError if that is impossible."""
    folder = user_folder() if folder is None else folder
    for name in (LEVELS, REPLAYS, EXPORTS):
        (folder / name).mkdir(parents=True, exist_ok=True)
    return folder


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
    there: set[str] = set()
    with suppress(OSError):
        there = {name_key(path.name) for path in folder.iterdir()}
    names = (f"{stem}-{number}{suffix}" if number > first else f"{stem}{suffix}" for number in count(1))
    return folder / next(name for name in names if name_key(name) not in there)


def export_path(folder: Path, title: str, suffix: str) -> Path:
    """A free path for a picture, a film or a replay that the game writes: ``exports/title-1.gif`` and so on.

    What a file name cannot hold becomes "-". Raises OSError where the folder cannot be made.
    """
    exports = folder / EXPORTS
    exports.mkdir(parents=True, exist_ok=True)
    return free_path(exports, file_stem(title, "replay"), suffix, first=0)


PACKAGE = Path(__file__).resolve().parent.parent
CHECKOUT = {name: PACKAGE.parent / name for name in ("levels", "assets", "docs")}
"""The folders of a checkout that an installed package has in ``data``."""


def data_folder(name: str) -> Path:
    """The folder of the bundled ``levels``, ``assets`` or ``docs``."""
    inside = PACKAGE / "data" / name
    return inside if inside.is_dir() else CHECKOUT[name]


def asset_text(name: str) -> str:
    """The text of a bundled file of ``assets``."""
    return (data_folder("assets") / name).read_text("utf-8")


def asset_lines(name: str) -> Iterator[str]:
    """The lines of such a file, without comments (``# ...``) and empty ones."""
    return (line for line in asset_text(name).splitlines() if line and not line.startswith("# "))


def asset_rows(name: str) -> Iterator[list[str]]:
    """The cells of those lines, between bars."""
    return ([cell.strip() for cell in line.split("|")] for line in asset_lines(name))


def is_bundled(path: Path) -> bool:
    """Whether a file is one of the game's own, in its folder of levels, by any path."""
    return path.resolve().is_relative_to(data_folder("levels").resolve())


def bundled_levels() -> list[Path]:
    """The files of the game's own levels, in playing order.

    >>> all(path.suffix == ".txt" for path in bundled_levels())
    True
    """
    return sorted(data_folder("levels").glob("*.txt"))


def own_levels() -> dict[str, Path]:
    """The game's level files by their names without a suffix, for commands and agents."""
    return {path.stem: path for path in bundled_levels()}


def bundled_replays() -> list[Path]:
    """The certificates of the game's own levels, replays that pass them, in the levels' order."""
    return sorted(data_folder("levels").glob(f"certificates/*{REPLAY_SUFFIX}"))


def install_hint(extra: str) -> str:
    """How to install an optional part of the program: in a checkout its own tool, else pip of the running Python.

    It names the packages of the part, not this one, which the user's index may not have.
    """
    if IN_PAGE:
        return ONLY_ON_A_DESKTOP
    # Its import takes as long as all the rest.
    from importlib.metadata import PackageNotFoundError, requires

    tool = PACKAGE.parent / "tools" / "dev.py"
    if tool.is_file():
        return f"start the command as 'python3 {tool} run ...', which installs what is missing"
    try:
        needed = [requirement.partition(";") for requirement in requires("ninja-game") or ()]
    except PackageNotFoundError:
        return "this copy of the program cannot be added to; use one that is installed in a Python"
    packages = [
        package.strip() for package, _, marker in needed if marker.replace('"', "'").strip() == f"extra == '{extra}'"
    ]
    return f"install it: {sys.executable} -m pip install {shlex.join(packages)}"
