"""The TAS editor in windows of any size: more rows and a larger level, borders that are dragged, text of any size."""

from itertools import combinations
from pathlib import Path
from shutil import copy

import pygame
import pytest

from ninja_game.play.menu_screen import Menu
from ninja_game.player.settings import Settings, read_settings
from ninja_game.tas.files import open_run
from ninja_game.tas_editor.editor import MIN_ROLL, tas_canvas, tas_layout
from ninja_game.tas_editor.screen import TasScreen
from ninja_game.ui.theme import Area
from tests.play.tas.conftest import RUN
from tests.support.tas_driver import TasDriver

SIZES = [(792, 600), (1280, 720), (1920, 1080), (2560, 1440), (3840, 2160), (1584, 1200), (800, 1600), (640, 480)]


def resized(at: TasDriver, size: tuple[int, int]) -> None:
    """Make the window that large."""
    pygame.display.set_mode(size, pygame.RESIZABLE)
    pygame.event.post(pygame.Event(pygame.WINDOWSIZECHANGED))
    at.frames(2)


def overlap(a: Area, b: Area) -> bool:
    """Whether two areas share a point."""
    return a[0] < b[0] + b[2] and b[0] < a[0] + a[2] and a[1] < b[1] + b[3] and b[1] < a[1] + a[3]


CHOSEN = [
    Settings(),
    Settings(text_scale=100, level_width=99, tabs_height=99),
    Settings(text_scale=400, level_width=1, tabs_height=1),
]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("settings", CHOSEN)
def test_parts_are_in_the_window_beside_each_other(size: tuple[int, int], settings: Settings) -> None:
    canvas = tas_canvas(size, settings.text_scale)
    width, height = size[0] / canvas.scale, size[1] / canvas.scale
    layout = tas_layout((width, height), settings)
    areas = layout[1:-1]
    assert all(x >= 0 and y >= 0 and x + w <= width + 0.01 and y + h <= height + 0.01 for x, y, w, h in areas)
    assert not [pair for pair in combinations(areas, 2) if overlap(*pair)]
    assert min(layout.level[2:]) > 190
    assert layout.roll[2] >= MIN_ROLL - 0.01
    assert layout.tabs[3] >= 149


def test_a_larger_window_shows_more_rows_and_a_larger_level(at: TasDriver) -> None:
    rows, scales, text_scale = [], [], []
    for size in SIZES[:5]:
        resized(at, size)
        rows.append(at.screen.roll.layout.rows)
        scales.append(at.screen.level.picture.canvas.scale)
        text_scale.append(at.screen.theme.canvas.scale)
    for grown in (rows, scales, text_scale):
        assert grown == sorted(set(grown))
    assert rows[2] > 1.3 * rows[0]
    assert scales[2] > 2 * scales[0]
    at.editor.go(50)
    at.frames()
    before = at.editor.track.keys_at(60)
    at.drag(at.cell(60, "left"))
    assert at.editor.track.keys_at(60) == before ^ 1, "a click hits the cell that is seen"


def test_a_dragged_border_and_the_size_of_letters_are_remembered(at: TasDriver, tmp_path: Path) -> None:
    resized(at, (1920, 1080))
    layout = at.screen.splitters.layout
    x, y = layout.roll[0] - 3, layout.strip[1] - 1
    at.drag((x, 300), (x - 60, 300), (x - 100, 310))
    moved = at.screen.splitters.layout
    assert abs(layout.roll[0] - moved.roll[0] - 100) < 12
    at.drag((100, y), (100, y + 30))
    assert abs(moved.tabs[3] - at.screen.splitters.layout.tabs[3] - 30) < 10
    assert at.screen.level.paths
    assert at.screen.level.paths.canvas is at.screen.level.picture.canvas
    rows = at.screen.roll.layout.rows
    at.chord("minus", pygame.KMOD_LCTRL)
    assert at.screen.roll.layout.rows > rows
    settings = read_settings(at.player.folder / "settings.toml")[0]
    assert settings == at.screen.app.settings
    assert all((settings.text_scale, settings.level_width, settings.tabs_height))
    again = TasDriver(at.player.folder, Path(copy(RUN, tmp_path / "again.replay.txt")), (1920, 1080))
    assert again.screen.splitters.layout == at.screen.splitters.layout
    again.chord("0", pygame.KMOD_LCTRL)
    assert again.screen.splitters.layout == layout
    again.session.close()
    again.close()


def test_a_tas_editor_that_opens_at_a_tick_has_it_in_the_middle_of_the_roll(at: TasDriver) -> None:
    screen = TasScreen(at.app, open_run(RUN))
    screen.editor.go(90)
    at.app.replace(screen)
    at.frames(2)
    assert 90 - screen.roll.layout.rows // 2 == screen.roll.top


def test_a_border_that_cannot_be_dragged_wishes_nothing(at: TasDriver) -> None:
    x = at.screen.splitters.layout.roll[0] - 3
    at.drag((x, 300), (x - 60, 300), (x - 100, 300))
    assert at.app.settings.level_width == 0


def test_a_press_that_opens_a_dialog_holds_nothing_after_it(at: TasDriver) -> None:
    resized(at, (1280, 720))
    x, y, w, _ = at.screen.roll.area
    at.event(pygame.MOUSEBUTTONDOWN, x + w / 2, y + 5, button=1)
    assert isinstance(at.top(), Menu)
    corner, middle = at.app.surface.get_at((2, 300)), at.app.surface.get_at((640, 2))
    assert corner == middle == at.app.surface.get_at((1278, 718)), "the veil covers all of the window"
    at.event(pygame.MOUSEBUTTONUP, x + w / 2, y + 5, button=1)
    at.press("escape")
    cursor = at.editor.cursor
    at.choose("Branches")
    assert at.screen.tab.name == "Branches"
    assert at.editor.cursor == cursor


def test_letters_end_at_the_size_that_fits(at: TasDriver) -> None:
    resized(at, (1280, 720))
    for _ in range(12):
        at.chord("equals", pygame.KMOD_LCTRL)
    assert at.screen.theme.canvas.scale == pytest.approx(1.2)
    assert "large" in at.app.notice
    for _ in range(12):
        at.chord("minus", pygame.KMOD_LCTRL)
    assert at.screen.theme.canvas.scale == pytest.approx(0.8)
    assert "small" in at.app.notice
