"""The levels that come with the game, in a checkout as in an installed package."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent


def data_folder(name: str) -> Path:
    """The folder ``levels`` or ``assets``: beside the package in a checkout, inside it when installed from a wheel."""
    inside = PACKAGE / "data" / name
    return inside if inside.is_dir() else PACKAGE.parent / name


def bundled_levels() -> list[Path]:
    """The files of the game's own levels, in playing order.

    >>> all(path.suffix == ".txt" for path in bundled_levels())
    True
    """
    return sorted(data_folder("levels").glob("*.txt"))
