"""Every screen can be reached, used and left by keys, mouse and gamepad; the focus is always somewhere."""

from __future__ import annotations

from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_replays
from ninja_game.play.level.phase import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episode_grid import EpisodeGrid
from ninja_game.play.menus.help import HelpScreen
from ninja_game.play.menus.main_menu import MainMenu
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.panels import PausePanel, Question
from ninja_game.play.menus.records import RecordsScreen
from ninja_game.play.menus.replays import ReplaysScreen
from ninja_game.play.menus.settings import PAGES, SettingsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.play.ui.palette import PALETTES
from ninja_game.player.settings import PALETTES as NAMES_IN_SETTINGS
from tests.support.menu_driver import Stage

ENTRIES = {
    "Play": EpisodeGrid,
    "Levels": Browser,
    "Records": RecordsScreen,
    "Replays": ReplaysScreen,
    "Settings": SettingsScreen,
    "Help": HelpScreen,
}
DIRECTIONS = ("down", "down", "right", "up", "left", "left", "up", "right", "pagedown", "pageup", "end", "home")


@pytest.mark.parametrize("entry", ENTRIES)
def test_screen_is_reached_and_left_by_keys(stage: Stage, entry: str) -> None:
    assert isinstance(stage.open(entry), ENTRIES[entry])
    stage.frames(5)
    stage.press("escape")
    assert isinstance(stage.top(), MainMenu)


@pytest.mark.parametrize("entry", ENTRIES)
def test_focus_is_always_on_a_widget_and_seen(stage: Stage, entry: str) -> None:
    screen = stage.open(entry)
    assert isinstance(screen, MenuScreen)
    for name in DIRECTIONS * 2:
        stage.press(name)
        assert screen.focus in screen.widgets
        assert screen.focus is not None
        assert screen.focus.focusable
    with_focus = pygame.image.tobytes(stage.app.surface, "RGB")
    screen.focus = None
    screen.redraw = True
    stage.frames(1, ms=0)
    assert pygame.image.tobytes(stage.app.surface, "RGB") != with_focus


@pytest.mark.parametrize("entry", ENTRIES)
def test_screen_is_reached_and_left_by_gamepad(stage: Stage, entry: str) -> None:
    menu = stage.top()
    assert isinstance(menu, MainMenu)
    for _ in range(list(ENTRIES).index(entry)):
        stage.pad(pygame.CONTROLLER_BUTTON_DPAD_DOWN)
    stage.pad(pygame.CONTROLLER_BUTTON_A)
    assert isinstance(stage.top(), ENTRIES[entry])
    stage.pad(pygame.CONTROLLER_BUTTON_B)
    assert stage.top() is menu


@pytest.mark.parametrize("entry", ENTRIES)
def test_screen_is_reached_by_mouse(stage: Stage, entry: str) -> None:
    menu = stage.top()
    assert isinstance(menu, MainMenu)
    button = menu.widgets[list(ENTRIES).index(entry)]
    stage.mouse(*button.centre)
    assert isinstance(stage.top(), ENTRIES[entry])


def test_leaving_the_game_is_asked_first(stage: Stage) -> None:
    stage.press("escape")
    assert isinstance(stage.top(), Question)
    stage.press("return")
    assert isinstance(stage.top(), MainMenu)
    stage.press("escape", "down", "return")
    assert not stage.app.running


def test_up_from_the_first_entry_leads_to_the_last(stage: Stage) -> None:
    stage.press("up")
    menu = stage.top()
    assert isinstance(menu, MainMenu)
    assert menu.focus is menu.widgets[-1]


def test_held_direction_repeats(stage: Stage) -> None:
    menu = stage.top()
    assert isinstance(menu, MainMenu)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    stage.frames(30)
    pygame.event.post(pygame.Event(pygame.KEYUP, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    stage.frames(1)
    assert menu.focus is not None
    place = menu.widgets.index(menu.focus)
    stage.frames(30)
    assert menu.widgets.index(menu.focus) == place != 1


def test_stall_during_a_short_press_does_not_repeat_it(stage: Stage) -> None:
    menu = stage.top()
    assert isinstance(menu, MainMenu)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    stage.frames(2, ms=1500)
    pygame.event.post(pygame.Event(pygame.KEYUP, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    stage.frames(2)
    assert menu.focus is menu.widgets[1]


def test_every_page_of_the_settings_shows(stage: Stage) -> None:
    screen = stage.open("Settings")
    assert isinstance(screen, SettingsScreen)
    for number, page in enumerate(PAGES):
        stage.mouse(*screen.widgets[number].centre)
        assert screen.page == page
        stage.frames(2)


def test_palette_is_changed_shown_and_saved(stage: Stage) -> None:
    assert tuple(PALETTES) == NAMES_IN_SETTINGS
    stage.open("Settings")
    stage.press("right", "right")
    screen = stage.top()
    assert isinstance(screen, SettingsScreen)
    chosen = stage.player.settings.palette
    assert chosen != "classic"
    assert stage.app.theme.palette.name == chosen
    assert f'palette = "{chosen}"' in (stage.player.folder / "settings.toml").read_text()


def test_key_is_rebound_by_pressing_it(stage: Stage) -> None:
    screen = stage.open("Settings")
    assert isinstance(screen, SettingsScreen)
    stage.mouse(*screen.widgets[PAGES.index("Keyboard")].centre)
    screen.focus = screen.widgets[len(PAGES)]
    stage.press("down", "down", "return", "x")
    assert stage.player.settings.keys["jump"][0] == "x"
    assert "jump" in stage.keys.actions(pygame.Event(pygame.KEYDOWN, key=0, scancode=pygame.KSCAN_X))
    stage.press("delete")
    assert "x" not in stage.player.settings.keys["jump"]
    stage.press("return", "escape")
    assert screen is stage.top()


def test_levels_are_searched_and_sorted(stage: Stage) -> None:
    browser = stage.open("Levels")
    assert isinstance(browser, Browser)
    browser.focus = browser.entry_field
    stage.type("chimney")
    assert [entry.title for entry in browser.shown] == ["The Chimney"]
    for _ in "chimney":
        stage.press("backspace")
    assert len(browser.shown) == len(browser.entries)
    browser._sort("name")
    titles = [entry.title.casefold() for entry in browser.shown]
    assert titles == sorted(titles)


def test_dropped_file_is_there_when_the_browser_opens(stage: Stage) -> None:
    (stage.player.folder / "levels" / "mine.txt").write_text("0" * 713 + "|5^100,566!11^160,564,130,564")
    (stage.player.folder / "levels" / "broken.txt").write_text("ninja-game level 1\nnonsense")
    browser = stage.open("Levels")
    assert isinstance(browser, Browser)
    assert "mine" in [entry.title for entry in browser.shown]
    assert browser.message


def test_level_without_a_ninja_is_refused_with_a_message(stage: Stage) -> None:
    (stage.player.folder / "levels" / "empty.txt").write_text("0" * 713 + "|0^100,566")
    browser = stage.open("Levels")
    assert isinstance(browser, Browser)
    browser._play([entry.title for entry in browser.shown].index("empty"))
    assert stage.top() is browser
    assert browser.message


def test_pause_offers_going_on_retry_and_leaving(stage: Stage) -> None:
    stage.open("Play")
    stage.press("return", "space")
    level = stage.top()
    assert isinstance(level, LevelScreen)
    stage.press("p")
    assert isinstance(stage.top(), PausePanel)
    tick = level.attempt.simulation.tick
    stage.frames(5)
    assert level.attempt.simulation.tick == tick
    stage.press("p")
    assert stage.top() is level
    assert level.phase.value == Phase.PLAY.value
    stage.press("escape", "down", "return")
    assert level.phase.value == Phase.READY.value
    stage.press("space", "p", "q")
    assert isinstance(stage.top(), EpisodeGrid)


def test_settings_and_help_open_from_the_pause(stage: Stage) -> None:
    stage.open("Play")
    stage.press("return", "space", "p", "down", "down", "return")
    assert isinstance(stage.top(), SettingsScreen)
    stage.press("escape", "down", "return")
    assert isinstance(stage.top(), HelpScreen)
    stage.press("escape")
    assert isinstance(stage.top(), PausePanel)


def test_locked_episode_does_not_start(stage: Stage) -> None:
    stage.open("Play")
    stage.press("down", "return")
    assert isinstance(stage.top(), EpisodeGrid)


def test_replay_of_the_game_is_watched(stage: Stage) -> None:
    stage.open("Replays")
    stage.press("return")
    assert isinstance(stage.top(), ReplayScreen)
    stage.frames(10)
    stage.press("escape")
    assert isinstance(stage.top(), ReplaysScreen)


def test_damaged_files_are_told_of_in_the_menu(tmp_path: Path) -> None:
    (tmp_path / "records.sqlite").write_bytes(b"rubbish" * 500)
    (tmp_path / "settings.toml").write_text("not [ toml")
    stage = Stage(tmp_path)
    assert len(stage.player.messages) == 2
    assert isinstance(stage.top(), MainMenu)
    stage.frames(3)
    stage.close()


def test_file_dropped_on_the_window_is_taken_in(stage: Stage, tmp_path: Path) -> None:
    browser = stage.open("Levels")
    assert isinstance(browser, Browser)
    file = tmp_path / "dropped.txt"
    file.write_text("0" * 713 + "|5^100,566!11^160,564,130,564")
    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(file)))
    stage.frames(2)
    assert "dropped" in [entry.title for entry in browser.shown]
    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(tmp_path / "settings.toml")))
    stage.frames(2)
    assert browser.message


def test_replay_is_written_as_a_text_to_share(stage: Stage) -> None:
    stage.open("Replays")
    stage.press("e")
    written = list((stage.player.folder / "exports").glob("*.replay.txt"))
    assert len(written) == 1
    assert load_replays(written[0])[0].replay
