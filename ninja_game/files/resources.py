"""The levels and replays that come with the game, in a checkout as in an installed package."""

from __future__ import annotations

import sys
from pathlib import Path

from ninja_game.runtime import IN_PAGE, ONLY_ON_A_DESKTOP

PACKAGE = Path(__file__).resolve().parent.parent
CHECKOUT = {name: PACKAGE.parent / name for name in ("levels", "assets")}
"""Where a checkout has what an installed package has in its folder ``data``."""


def data_folder(name: str) -> Path:
    """The folder of the bundled ``levels`` or ``assets``."""
    inside = PACKAGE / "data" / name
    return inside if inside.is_dir() else CHECKOUT[name]


def bundled_levels() -> list[Path]:
    """The files of the game's own levels, in playing order.

    >>> all(path.suffix == ".txt" for path in bundled_levels())
    True
    """
    return sorted(data_folder("levels").glob("*.txt"))


def bundled_replays() -> list[Path]:
    """The certificates of the game's own levels, replays that pass them, in the levels' order."""
    return sorted(data_folder("levels").glob("certificates/*.replay.txt"))


def how_to_install(extra: str) -> str:
    """What gets an optional part of the program: in a checkout its own tool, else pip of the Python that runs this."""
    if IN_PAGE:
        return ONLY_ON_A_DESKTOP
    tool = PACKAGE.parent / "tools" / "dev.py"
    if tool.is_file():
        return f"start the command as 'python3 {tool} run ...', which installs what is missing"
    return f"install it: {sys.executable} -m pip install 'ninja-game[{extra}]'"
