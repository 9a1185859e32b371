"""The game as the page gets it: one archive of what the package holds, unpacked there as it is installed here."""

from __future__ import annotations

import gzip
import io
import tarfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from importlib.util import find_spec
from pathlib import Path

from ninja_game.files.user_folder import PACKAGE, data_folder
from ninja_game.web.sounds import compressed

LEFT_OUT = (
    "batch", "cli", "data", "learn", "play/tas", "search", "tas", "verification", "web/board", "web/pages",
    "web/licences", "web/page", "web/site",
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
            if path.is_file() and path.suffix != ".md" and path.relative_to(root).parts[0] not in LEFT_OUT:
                data = path.read_bytes()
                name = f"ninja_game/data/{folder}/{path.relative_to(root).as_posix()}"
                yield name, compressed(data, str(path)) if path.suffix == ".wav" else data
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
