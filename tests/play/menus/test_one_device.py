"""Every screen is reached, used and left by the keyboard alone, by the mouse alone, by a gamepad alone."""

import pygame
import pytest

from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.lab.screen import LabScreen
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen, PausePanel
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import BACK, MenuScreen, Question
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.daily import DailyScreen
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.panels.replays import RecordsScreen, ReplaysScreen
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.play.screen import BaseScreen
from ninja_game.ui.input.gamepad import BUTTONS
from ninja_game.ui.list_view import ListView
from tests.support.menu_driver import MenuDriver

ENTRIES = {
    "Play": LevelScreen, "Episodes": EpisodeGrid, "Daily": DailyScreen, "Levels": Browser, "Records": RecordsScreen,
    "Replays": ReplaysScreen,
    "Editor": EditorScreen, "Settings": SettingsScreen, "Help": HelpScreen,
}  # fmt: skip


class Buttons:
    """A player with keys or buttons only: ``names`` of them by what they mean."""

    def __init__(self, driver: MenuDriver, kind: str) -> None:
        self.driver = driver
        self.kind = kind

    def do(self, action: str) -> None:
        """Press what means an action."""
        if self.kind == "keyboard":
            names = {"confirm": "return", "back": "escape", "pause": "p", "give up": "k"}
            self.driver.press(names.get(action, action))
        else:
            names = {"confirm": "a", "back": "b", "pause": "start", "give up": "back"}
            self.driver.pad(BUTTONS.index(names.get(action, f"dpad-{action}")))

    def back(self) -> None:
        self.do("back")

    def choose(self, text: str) -> None:
        """Go down one column of buttons and up the next one, and press the one with this text."""
        screen = self.driver.shown(MenuScreen)
        far = len(screen.widgets)
        for way in (*["down"] * far, "right", *["up"] * far):
            if getattr(screen.focus, "text", "") == text:
                break
            self.do(way)
        assert getattr(screen.focus, "text", "") == text, f"no way to {text}"
        self.do("confirm")

    def row(self, shown: ListView, index: int) -> None:
        """Select a row of the list that has the focus."""
        while shown.index != index:
            before = shown.index
            self.do("down" if shown.index < index else "up")
            assert shown.index != before

    def open(self, shown: ListView, index: int) -> None:
        """Choose the row that is selected."""
        assert shown.index == index
        self.do("confirm")

    def begin(self) -> None:
        self.do("confirm")

    def pause(self) -> None:
        self.do("pause")


class Mouse(Buttons):
    """A player with a mouse only."""

    def __init__(self, driver: MenuDriver) -> None:
        super().__init__(driver, "mouse")

    def do(self, action: str) -> None:
        assert action == "confirm"
        self.driver.mouse(400, 300)

    def back(self) -> None:
        """What is seen to go back with, else the right button."""
        screen = self.driver.top()
        texts = [getattr(each, "text", "") for each in screen.widgets] if isinstance(screen, MenuScreen) else []
        if "Back" in texts:
            self.driver.choose("Back")
        elif isinstance(screen, MenuScreen) and screen.offers_back:
            self.driver.mouse(BACK[0] + 10, BACK[1] + 10)
        else:
            self.pause()

    def choose(self, text: str) -> None:
        self.driver.choose(text)

    def row(self, shown: ListView, index: int) -> None:
        x, y, w, h = shown.row_area(index)
        self.driver.mouse(x + w / 2, y + h / 2)

    def open(self, shown: ListView, index: int) -> None:
        """A second click."""
        self.row(shown, index)

    def pause(self) -> None:
        """The right button."""
        place = self.driver.app.canvas.point(400, 300)
        for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP):
            pygame.event.post(pygame.Event(kind, pos=place, button=pygame.BUTTON_RIGHT, touch=False))
        self.driver.frames(1)


@pytest.fixture(params=["keyboard", "mouse", "gamepad"])
def player(request: pytest.FixtureRequest, driver: MenuDriver) -> Buttons:
    return Mouse(driver) if request.param == "mouse" else Buttons(driver, request.param)


def top_of(player: Buttons) -> BaseScreen:
    """The screen on top, for a type checker that thinks it cannot change."""
    return player.driver.top()


@pytest.mark.parametrize("entry", ENTRIES)
def test_every_entry_is_opened_and_left(player: Buttons, entry: str) -> None:
    player.choose(entry)
    assert isinstance(top_of(player), ENTRIES[entry])
    player.driver.frames(3)
    if entry == "Play":
        player.back()
        player.choose("Leave the level")
    elif entry == "Editor":
        if player.kind == "mouse":
            player.driver.mouse(20, 14)
        else:
            player.back()
            player.back()
        player.choose("Leave the editor")
    else:
        player.back()
        if entry == "Settings" and not isinstance(top_of(player), MainMenu):
            player.back()
    assert isinstance(top_of(player), MainMenu)


def test_every_page_of_the_settings_and_the_help_and_every_figure_is_seen(player: Buttons) -> None:
    player.choose("Settings")
    settings = player.driver.shown(SettingsScreen)
    for number, page in enumerate(settings.pages):
        player.row(settings.tabs, number)
        assert settings.page == page
    player.back()
    if not isinstance(top_of(player), MainMenu):
        player.back()
    player.choose("Help")
    help_screen = player.driver.shown(HelpScreen)
    for number in range(len(help_screen.topics)):
        player.row(help_screen.list, number)
        assert (help_screen.page is None) == (number == len(help_screen.pages))
    if player.kind == "mouse":
        player.driver.choose("How it works")
    else:
        player.row(help_screen.list, 0)
        player.do("right")
        player.do("confirm")
    lab = player.driver.shown(LabScreen)
    for number, figure in enumerate(lab.figures):
        player.row(lab.list, number)
        assert lab.figure is figure


def test_a_setting_is_changed(player: Buttons) -> None:
    player.choose("Settings")
    screen = player.driver.shown(SettingsScreen)
    player.row(screen.tabs, screen.titles.index("Accessibility"))
    if player.kind == "mouse":
        player.driver.choose("Invincible")
    else:
        player.do("right")
        player.do("down")
        player.do("down")
        player.do("confirm")
    assert player.driver.player.settings.invincible


def test_a_level_is_begun_paused_left_and_a_replay_is_watched(player: Buttons) -> None:
    player.choose("Levels")
    player.driver.frames(3)
    if player.kind == "mouse":
        player.driver.choose("Play")
    else:
        player.do("confirm")
    level = player.driver.shown(LevelScreen)
    player.begin()
    player.driver.frames(3)
    assert level.phase is Phase.PLAY
    player.pause()
    assert isinstance(top_of(player), PausePanel)
    for text, kind in (("Settings", SettingsScreen), ("Help", HelpScreen)):
        player.choose(text)
        assert isinstance(top_of(player), kind)
        player.back()
        if not isinstance(top_of(player), PausePanel):
            player.back()
    player.choose("Leave the level")
    assert isinstance(top_of(player), Browser)
    player.back()
    player.driver.earn_gold()
    player.choose("Replays")
    replays = player.driver.shown(ReplaysScreen)
    player.row(replays.list, 1)
    assert top_of(player) is replays, "one click only selects"
    player.open(replays.list, 1)
    assert isinstance(top_of(player), ReplayScreen)
    player.driver.frames(3)
    player.back()
    assert isinstance(top_of(player), ReplaysScreen)


def test_a_dead_ninja_tries_again(player: Buttons) -> None:
    player.choose("Episodes")
    grid = player.driver.shown(EpisodeGrid)
    player.row(grid.grid, 0)
    assert top_of(player) is grid, "one click only selects"
    player.open(grid.grid, 0)
    level = player.driver.shown(LevelScreen)
    player.begin()
    level.give_up()
    player.driver.frames(60)
    assert level.phase is Phase.DEAD
    player.do("confirm")
    assert level.attempt.simulation.tick == 0


def test_the_game_is_left(player: Buttons) -> None:
    player.choose("Quit")
    assert isinstance(top_of(player), Question)
    player.choose("Quit")
    assert not player.driver.app.running
