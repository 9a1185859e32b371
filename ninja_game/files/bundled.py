"""Files that come with the program: its levels, their certificates, and ``assets``."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.runtime import PACKAGE

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
