"""A picture of every screen of the game, for the contact sheet: a short life of a player, played by a script."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pygame

from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.main_menu import MainMenu
from ninja_game.play.menus.pause import PausePanel
from ninja_game.play.menus.settings.screen import SettingsScreen
from tests.support.menu_driver import MenuDriver

SIZE = (1188, 900)

Pictures = list[tuple[str, pygame.Surface]]


def pictures() -> Pictures:
    """Label and picture of each screen, in the order in which a player meets them."""
    with tempfile.TemporaryDirectory() as folder:
        driver = MenuDriver(Path(folder), SIZE)
        shown: Pictures = []
        try:
            _play_an_episode(driver, shown)
            _visit_menus(driver, shown)
        finally:
            driver.close()
        return shown


def _shoot(driver: MenuDriver, shown: Pictures, label: str, frames: int = 2) -> None:
    driver.frames(frames)
    shown.append((label, driver.app.surface.copy()))


def _play_an_episode(driver: MenuDriver, shown: Pictures) -> None:
    """From the main menu through the first episode, with a pause and a death on the way."""
    _shoot(driver, shown, "main menu, attract mode behind it", 90)
    grid = driver.open("Play")
    _shoot(driver, shown, "episodes")
    driver.press("return")
    screen = driver.top()
    assert screen is not grid
    assert isinstance(screen, LevelScreen)
    _shoot(driver, shown, "ready", 40)
    driver.press("space")
    driver.frames(30)
    driver.press("p")
    _shoot(driver, shown, "paused")
    driver.press("p")
    driver.press("k")
    _shoot(driver, shown, "dead", 5)
    _shoot(driver, shown, "dead, the message", 60)
    driver.press("space")
    for number in range(1, 6):
        level = driver.top()
        assert isinstance(level, LevelScreen)
        if number == 4:
            level.begin()
            driver.keys.script = [2] * 60
            _shoot(driver, shown, "playing", 60)
            level.retry()
        level.begin()
        driver.play_replay(number)
        if number == 1:
            _shoot(driver, shown, "passed", 20)
        driver.press("space")
    _shoot(driver, shown, "episode passed", 4)
    driver.press("escape")
    _shoot(driver, shown, "episodes, one passed", 4)


def _home(driver: MenuDriver) -> None:
    """Back to the main menu."""
    for _ in range(10):
        if isinstance(driver.top(), MainMenu):
            return
        # From a paused level escape leads back into it.
        driver.press("q" if isinstance(driver.top(), PausePanel) else "escape")
    raise AssertionError(f"no way home from {driver.top()}")


def _visit_menus(driver: MenuDriver, shown: Pictures) -> None:
    """Everything else."""
    for entry, label in (("Levels", "levels"), ("Records", "records"), ("Replays", "replays")):
        _home(driver)
        driver.open(entry)
        _shoot(driver, shown, label, 30)
        if entry == "Levels":
            driver.press("down", "return")
            driver.press("space")
            _shoot(driver, shown, "with a ghost", 45)
        if entry == "Replays":
            driver.press("return")
            driver.frames(80)
            driver.press("p")
            _shoot(driver, shown, "replay viewer")
    _home(driver)
    settings = driver.open("Settings")
    assert isinstance(settings, SettingsScreen)
    _shoot(driver, shown, "settings")
    _home(driver)
    driver.open("Help")
    _shoot(driver, shown, "help", 60)
    driver.press("tab")
    _shoot(driver, shown, "boss mode")
    driver.press("tab")
