"""The levels and replays that come with the game, in a checkout as in an installed package."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).resolve().parent.parent
CHECKOUT = {"levels": "levels", "assets": "assets", "replays": "tests/replays"}
"""Where a checkout has what an installed package has in its folder ``data``."""


def data_folder(name: str) -> Path:
    """The folder of the bundled ``levels``, ``replays`` or ``assets``."""
    inside = PACKAGE / "data" / name
    return inside if inside.is_dir() else PACKAGE.parent / CHECKOUT[name]


def bundled_levels() -> list[Path]:
    """The files of the game's own levels, in playing order.

    >>> all(path.suffix == ".txt" for path in bundled_levels())
    True
    """
    return sorted(data_folder("levels").glob("*.txt"))


def bundled_replays() -> list[Path]:
    """The files of the replays that pass the game's own levels, in the levels' order."""
    return sorted(data_folder("replays").glob("*.replay.txt"))
