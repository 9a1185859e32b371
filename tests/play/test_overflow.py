"""No text or widget leaves its place, overlaps another, or is cut: every screen, all sizes of text, any window."""

import re
import shutil
from itertools import product
from pathlib import Path
from unittest.mock import patch

import pygame
import pytest

from ninja_game.files.bundled import CHECKOUT
from ninja_game.ui.theme import TEXT_SIZES
from ninja_game.view.level_view import LevelView
from tests.support.game_screens import Tour, run_tour, tour
from tests.support.layout import Layout, noted
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK
from tests.support.tas_screens import tas_editor

SIZES = ((640, 480), (792, 600), (2560, 1600))
LONGEST = 40 * "W"
NAMES = re.compile(r"(?m)^(name|author|level|level-author|comment|teaches): .*$")
TITLES = re.compile(r'"[A-Z][^"]*"')


def pack_of_long_names(folder: Path) -> Path:
    """A copy of the tests' pack in which all that has a name has the longest."""
    pack = folder / "pack"
    shutil.copytree(PACK, pack)
    for file in pack.rglob("*.txt"):
        file.write_text(NAMES.sub(rf"\1: {LONGEST}", file.read_text("utf-8")), "utf-8")
    titles = pack / "pack.toml"
    titles.write_text(TITLES.sub(f'"{LONGEST}"', titles.read_text("utf-8")), "utf-8")
    return pack


@pytest.mark.parametrize(
    "steps, shown",
    [
        pytest.param(tour, [(size, TEXT_SIZES["largest"]) for size in SIZES], id="game"),
        pytest.param(tour, [*product(SIZES, TEXT_SIZES.values())], id="game-in-all-sizes", marks=pytest.mark.slow),
        # It has a setting of its own for the size of its text.
        pytest.param(tas_editor, [(size, TEXT_SIZES["normal"]) for size in SIZES], id="tas-editor"),
    ],
)
def test_nothing_leaves_its_place_on_any_screen(
    tmp_path: Path, steps: Tour, shown: list[tuple[tuple[int, int], int]]
) -> None:
    """At every size. ``shown``: sizes of the window and of the text, percent."""
    found: set[str] = set()
    pack = pack_of_long_names(tmp_path) if steps is tour else PACK

    def show(driver: MenuDriver, name: str) -> None:
        app = driver.app
        for size, percent in shown:
            if size != pygame.display.get_window_size():
                pygame.display.set_mode(size, pygame.RESIZABLE)
            # Written to no file: this is done a thousand times.
            app.player.settings = app.settings.changed(text_size=percent, name=LONGEST)
            app.lay_out()
            layouts.append(Layout())
            app.draw()
            where = f"{name}: {size[0]} x {size[1]}, text of {percent} %"
            found.update(f"{where}: {each}" for each in layouts.pop().problems(app))
        pygame.display.set_mode(SIZES[1], pygame.RESIZABLE)
        app.lay_out()
        driver.frames(1, ms=0)

    with (
        noted() as layouts,
        patch.object(LevelView, "draw", lambda *_, **__: []),
        patch("ninja_game.view.level_view.Backdrop"),
        patch("tests.support.game_screens.instead_of_ours", lambda: patch.dict(CHECKOUT, levels=pack)),
    ):
        run_tour(tmp_path / "player", SIZES[1], show, steps)
    assert not found, f"{len(found)} findings\n" + "\n".join(sorted(found))
