"""Python files compiled for the page's Python, which is not this one: a first visit need not do it."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from ninja_game.errors import NinjaGameError

_WAIT = 600
"""Seconds for node."""

Files = dict[str, bytes]
"""Content by name."""


def compiled(library: Files, game: Files, pyodide: Mapping[str, bytes]) -> tuple[Files, Files]:
    """The standard library's and the game's files with bytecode in the place of Python text.

    ``pyodide``: the files of its package. Where there is no Node.js the files are as they were, and the first
    visit takes longer. Raises NinjaGameError where node fails.
    """
    node = shutil.which("node")
    if node is None:
        return library, game
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch)
        _write(place / "pyodide", pyodide)
        _write(place / "work" / "library", _texts(library))
        _write(place / "work" / "game", _texts(game))
        _write(place / "work", {"compiling.py": Path(__file__).with_name("compiling.py").read_bytes()})
        words = [node, str(Path(__file__).with_suffix(".mjs")), str(place / "pyodide"), str(place / "work")]
        try:
            subprocess.run(words, capture_output=True, text=True, check=True, timeout=_WAIT)  # noqa: S603 - our own words
        except (OSError, subprocess.SubprocessError) as error:
            said = str(getattr(error, "stderr", "") or error).strip().splitlines()[-1:]
            raise NinjaGameError(f"node could not compile the game for the page: {''.join(said)}") from None
        return _replaced(library, place / "work" / "library"), _replaced(game, place / "work" / "game")


def _texts(files: Files) -> Files:
    return {name: content for name, content in files.items() if name.endswith(".py")}


def _replaced(files: Files, folder: Path) -> Files:
    """The same files, but what ``folder`` has as bytecode."""
    made = {f"{name}c": (folder / f"{name}c").read_bytes() for name in _texts(files)}
    return {name: content for name, content in files.items() if not name.endswith(".py")} | made


def _write(folder: Path, files: Mapping[str, bytes]) -> None:
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
