"""The whole program in a real window with real key presses: menu, level, passed, record saved, ghost shown.

Runs under Xvfb with xdotool; skipped where they are missing (`apt-get install xvfb xdotool`).
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.real_window import NEEDS_WINDOW, TIMEOUT, Player, virtual_screen

EASY = "0" * 713 + "|5^100,566!11^400,564,300,564"

pytestmark = NEEDS_WINDOW


@pytest.fixture
def display() -> Iterator[str]:
    """A virtual screen of its own."""
    with virtual_screen() as name:
        yield name


def test_from_the_menu_to_a_saved_record_and_its_ghost(display: str, tmp_path: Path, root: Path) -> None:
    (tmp_path / "levels").mkdir()
    (tmp_path / "levels" / "zz.txt").write_text(EASY)
    player = Player(display, tmp_path, root)
    try:
        player.press("Down", "Right", "Return", "Home", "Return")  # Levels, the player's own comes first, play
        player.press("space")
        alone = player.still_picture()  # the dust of the landing has gone
        assert player.differs_from(alone) < 20
        player.tool("keydown", "Right")
        player.wait_for(lambda: player.count("level_best") == 1, "saved record")
        player.tool("keyup", "Right")
        player.press("q", "Return", "space")  # back to the list, play again
        player.wait_for(lambda: player.differs_from(alone) > 60, "ghost")
        player.press("Escape", "q", "Escape", "Escape", "Down", "Return")  # pause, list, menu, question, leave
        assert player.game.wait(TIMEOUT) == 0
    finally:
        player.game.kill()
        player.game.wait()
    assert player.count("level_best") == 1
