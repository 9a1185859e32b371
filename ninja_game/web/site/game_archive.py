"""The game as one archive: its files without what a page has no use for, compiled where Node can be had."""

from __future__ import annotations

import gzip
import io
import shutil
import subprocess
import tarfile
import tempfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from importlib.util import find_spec
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import PACKAGE, data_folder

LEFT_OUT = (
    "batch", "bench.", "cli", "generated.tsv.xz", "data", "learn", "search", "sounds/music", "tas", "verification",
    "web/board", "web/pages", "web/licences", "web/page", "web/site",
)  # fmt: skip
"""What of the package a page has no use for."""


def game_archive(files: Mapping[str, bytes]) -> bytes:
    """A compressed tar of files; the same bytes for the same files."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name, content in sorted(files.items()):
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return gzip.compress(packed.getvalue(), 9, mtime=0)


def game_files() -> Iterator[tuple[str, bytes]]:
    """Name and content of every file of the package, its data, and the library for TOML."""
    for path in PACKAGE.rglob("*.py"):
        name = path.relative_to(PACKAGE).as_posix()
        if not name.startswith(LEFT_OUT):
            yield f"ninja_game/{name}", path.read_bytes()
    yield "boot.py", (PACKAGE / "web" / "page" / "boot.py").read_bytes()
    for folder in ("levels", "assets"):
        root = data_folder(folder)
        for path in root.rglob("*"):
            if path.is_file() and path.suffix != ".md" and not path.relative_to(root).as_posix().startswith(LEFT_OUT):
                yield f"ninja_game/data/{folder}/{path.relative_to(root).as_posix()}", path.read_bytes()
    for path in _package("tomlkit").rglob("*.py"):
        yield f"tomlkit/{path.relative_to(_package('tomlkit')).as_posix()}", path.read_bytes()


def _package(name: str) -> Path:
    """The folder of an installed package."""
    spec = find_spec(name)
    assert spec is not None  # noqa: S101 - one of our requirements
    assert spec.origin is not None  # noqa: S101 - likewise
    return Path(spec.origin).parent


def licence_of(name: str) -> str:
    """The text of an installed package's licence, "" where it has none."""
    for path in distribution(name).files or ():
        if path.name.upper().startswith("LICEN"):
            return path.read_text("utf-8")
    return ""


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
        words = [node, str(Path(__file__).with_name("bytecode.mjs")), str(place / "pyodide"), str(place / "work")]
        try:
            subprocess.run(words, capture_output=True, text=True, check=True, timeout=_WAIT)  # noqa: S603 - our own words
        except (OSError, subprocess.SubprocessError) as error:
            said = str(getattr(error, "stderr", "") or error).strip().splitlines()[-1:]
            raise NinjaGameError(f"node could not compile the game for the page: {''.join(said)}") from None
        return _replaced(library, place / "work" / "library"), _replaced(game, place / "work" / "game")


def _texts(files: Files) -> Files:
    return {name: content for name, content in files.items() if name.endswith(".py")}


def _replaced(files: Files, folder: Path) -> Files:
    """The files, with bytecode in place of what ``folder`` has as such."""
    made = {f"{name}c": (folder / f"{name}c").read_bytes() for name in _texts(files)}
    return {name: content for name, content in files.items() if not name.endswith(".py")} | made


def _write(folder: Path, files: Mapping[str, bytes]) -> None:
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
