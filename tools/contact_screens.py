"""A picture of every screen of the game, for the contact sheet: a short life of a player, played by a script."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pygame

from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.main_menu import MainMenu
from ninja_game.play.menus.panels import PausePanel
from ninja_game.play.menus.settings import SettingsScreen
from tests.support.menu_driver import Stage

SIZE = (1188, 900)

Pictures = list[tuple[str, pygame.Surface]]


def pictures() -> Pictures:
    """Label and picture of each screen, in the order in which a player meets them."""
    with tempfile.TemporaryDirectory() as folder:
        stage = Stage(Path(folder), SIZE)
        shown: Pictures = []
        try:
            _play_an_episode(stage, shown)
            _visit_menus(stage, shown)
        finally:
            stage.close()
        return shown


def _shoot(stage: Stage, shown: Pictures, label: str, frames: int = 2) -> None:
    stage.frames(frames)
    shown.append((label, stage.app.surface.copy()))


def _play_an_episode(stage: Stage, shown: Pictures) -> None:
    """From the main menu through the first episode, with a pause and a death on the way."""
    _shoot(stage, shown, "main menu, attract mode behind it", 90)
    grid = stage.open("Play")
    _shoot(stage, shown, "episodes")
    stage.press("return")
    screen = stage.top()
    assert screen is not grid
    assert isinstance(screen, LevelScreen)
    _shoot(stage, shown, "ready", 40)
    stage.press("space")
    stage.frames(30)
    stage.press("p")
    _shoot(stage, shown, "paused")
    stage.press("p")
    stage.press("k")
    _shoot(stage, shown, "dead", 5)
    _shoot(stage, shown, "dead, the message", 60)
    stage.press("space")
    for number in range(1, 6):
        level = stage.top()
        assert isinstance(level, LevelScreen)
        if number == 4:
            level.begin()
            stage.keys.script = [2] * 60
            _shoot(stage, shown, "playing", 60)
            level.retry()
        level.begin()
        stage.play_replay(number)
        if number == 1:
            _shoot(stage, shown, "passed", 20)
        stage.press("space")
    _shoot(stage, shown, "episode passed", 4)
    stage.press("escape")
    _shoot(stage, shown, "episodes, one passed", 4)


def _home(stage: Stage) -> None:
    """Back to the main menu."""
    for _ in range(10):
        if isinstance(stage.top(), MainMenu):
            return
        # From a paused level escape leads back into it.
        stage.press("q" if isinstance(stage.top(), PausePanel) else "escape")
    raise AssertionError(f"no way home from {stage.top()}")


def _visit_menus(stage: Stage, shown: Pictures) -> None:
    """Everything else."""
    for entry, label in (("Levels", "levels"), ("Records", "records"), ("Replays", "replays")):
        _home(stage)
        stage.open(entry)
        _shoot(stage, shown, label, 30)
        if entry == "Levels":
            stage.press("down", "return")
            stage.press("space")
            _shoot(stage, shown, "with a ghost", 45)
        if entry == "Replays":
            stage.press("return")
            stage.frames(80)
            stage.press("p")
            _shoot(stage, shown, "replay viewer")
    _home(stage)
    settings = stage.open("Settings")
    assert isinstance(settings, SettingsScreen)
    _shoot(stage, shown, "settings")
    _home(stage)
    stage.open("Help")
    _shoot(stage, shown, "help", 60)
    stage.press("tab")
    _shoot(stage, shown, "boss mode")
    stage.press("tab")
