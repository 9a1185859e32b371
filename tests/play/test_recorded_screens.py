"""Every screen of the game against a recorded list of its texts and draw calls in `tests/play/golden/screens/`.

To accept changed screens and pictures run `python3 tools/dev.py accept-pictures` and read the difference with git.
"""

from __future__ import annotations

import os
from difflib import unified_diff
from pathlib import Path

import pytest

from tests.support.game_screens import screens_as_texts

GOLDEN = Path(__file__).parent / "golden" / "screens"
ACCEPT = bool(os.environ.get("ACCEPT_PICTURES"))
NAMES = sorted(path.stem for path in GOLDEN.glob("*.txt"))


@pytest.fixture(scope="module")
def screens(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The text of each screen by its name."""
    return screens_as_texts(tmp_path_factory.mktemp("player"))


def test_recorded_screens_are_those_that_there_are(screens: dict[str, str]) -> None:
    if ACCEPT:
        GOLDEN.mkdir(parents=True, exist_ok=True)
        for path in GOLDEN.glob("*.txt"):
            path.unlink()
        for name, text in screens.items():
            (GOLDEN / f"{name}.txt").write_text(text, "utf-8")
    else:
        assert sorted(screens) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_screen_is_drawn_as_recorded(screens: dict[str, str], name: str) -> None:
    if ACCEPT:
        return
    recorded = (GOLDEN / f"{name}.txt").read_text("utf-8")
    now = screens.get(name, "")
    if now != recorded:
        lines = unified_diff(recorded.splitlines(), now.splitlines(), "recorded", "now", lineterm="", n=1)
        pytest.fail("\n".join([f"{name} is drawn otherwise; meant? `python3 tools/dev.py accept-pictures`", *lines]))
