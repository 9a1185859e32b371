"""The tests' own pack of levels (tests/pack), and how it takes the place of the game's."""

from contextlib import AbstractContextManager
from pathlib import Path
from unittest.mock import patch

from ninja_game.files.bundled import CHECKOUT

PACK = Path(__file__).resolve().parent.parent / "pack"


def instead_of_ours() -> AbstractContextManager[object]:
    """While it is entered, the game's levels and replays are those of the tests' pack."""
    return patch.dict(CHECKOUT, levels=PACK)


def rewrite(path: Path, old: str, new: str, count: int = -1) -> None:
    """Replace a text that a file has."""
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, count), "utf-8")
