"""The settings: pages are chosen by moving, Esc goes back one step, and no input gets two meanings unasked."""

import pygame
import pytest

from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import Menu
from ninja_game.play.panels.bindings import BINDING_ROW, LIST, SLOTS, Capture, can_clash
from ninja_game.play.panels.settings import PALETTE_PREVIEW, SettingsScreen
from ninja_game.ui.input.bindings import ACTIONS, MENU_KEYS, MENU_PAD, bindable
from ninja_game.ui.theme import PALETTES
from ninja_game.ui.widgets import Choice, Slider
from ninja_game.view.sprites.relief import GRAIN
from tests.support.menu_driver import MenuDriver


@pytest.fixture
def screen(driver: MenuDriver) -> SettingsScreen:
    return driver.opened("Settings", SettingsScreen)


def test_moving_between_pages_shows_them(driver: MenuDriver, screen: SettingsScreen) -> None:
    for page in screen.titles[1:]:
        driver.press("down")
        assert screen.page == page
        assert screen.focus is screen.tabs


def test_right_enters_the_first_row_and_escape_goes_back_one_step(driver: MenuDriver, screen: SettingsScreen) -> None:
    for page in screen.titles:
        assert screen.page == page
        driver.press("right")
        assert screen.focus is screen.widgets[1]
        driver.press("escape")
        assert screen.focus is screen.tabs
        driver.press("down")
    driver.press("escape")
    assert isinstance(driver.top(), MainMenu)


def test_up_from_the_top_row_stays_on_the_page(driver: MenuDriver, screen: SettingsScreen) -> None:
    driver.settings_page("Sound")
    assert screen.focus is screen.widgets[1]
    driver.press("up")
    assert screen.focus is screen.widgets[-1]
    assert screen.page == "Sound"


@pytest.mark.parametrize("place, name", [(1, "volume"), (2, "effects_volume"), (3, "loop_volume"), (4, "music_volume")])
def test_a_volume_is_shown_in_percent_of_the_loudest(
    driver: MenuDriver, screen: SettingsScreen, place: int, name: str
) -> None:
    driver.settings_page("Sound")
    slider = screen.widgets[place]
    assert isinstance(slider, Slider)
    for value, text in ((0, "0%"), (45, "45%"), (96, "97%"), (99, "100%")):
        driver.app.change_settings(**{name: value})
        assert slider.show(slider.get()) == text


def test_palettes_have_names_in_title_case(driver: MenuDriver, screen: SettingsScreen) -> None:
    choice = screen.widgets[1]
    assert isinstance(choice, Choice)
    names = [name for name, _ in choice.options]
    assert names[0] == "By column (default)"
    assert "Safe Dark" in names
    assert all(name == name.title() for name in names[1:])


def test_left_at_the_low_end_of_a_slider_goes_back_to_the_pages(driver: MenuDriver, screen: SettingsScreen) -> None:
    driver.settings_page("Sound")
    driver.app.change_settings(volume=3)
    driver.press("left")
    assert driver.player.settings.volume == 0
    assert screen.focus is screen.widgets[1]
    screen.act("left", held=True)
    assert screen.focus is screen.widgets[1]
    driver.press("left")
    assert screen.focus is screen.tabs


@pytest.mark.parametrize(
    "presses, jump, retry",
    [(("return",), False, True), (("down", "return"), True, False), (("down", "down", "return"), True, True)],
)
def test_taken_key_asks_what_becomes_of_it(
    driver: MenuDriver, screen: SettingsScreen, presses: tuple[str, ...], jump: bool, retry: bool
) -> None:
    driver.settings_page("Keyboard")
    driver.press("down", "down", "return", "r")
    question = driver.shown(Menu)
    assert ACTIONS["retry"].label in question.title
    driver.press(*presses)
    assert driver.top() is screen
    assert ("r" in driver.keys.keys["jump"]) == jump
    assert ("r" in driver.keys.keys["retry"]) == retry


def test_only_a_click_on_a_slot_waits_for_a_press(driver: MenuDriver, screen: SettingsScreen) -> None:
    driver.settings_page("Keyboard")
    x, y, width, _ = LIST
    driver.mouse(x + 10, y + 2.5 * BINDING_ROW)
    assert driver.top() is screen
    assert screen.tables["keys"].index == 2
    driver.mouse(x + width - 12, y + 2.5 * BINDING_ROW)
    assert screen.tables["keys"].slot == 0, "the bar begins where the slots end"
    driver.mouse(x + width / 2, y + 2.5 * BINDING_ROW)
    assert driver.shown(Capture)


def test_defaults_do_not_clash_and_every_input_has_a_place() -> None:
    for name, action in ACTIONS.items():
        assert len(action.keys) <= SLOTS["keys"]
        assert len(action.pad) <= SLOTS["pad"]
        for other, its in ACTIONS.items():
            if set(action.keys) & set(its.keys) or set(action.pad) & set(its.pad):
                assert not can_clash(name, other)
        assert all(bindable(name, each, MENU_KEYS) for each in action.keys)
        assert all(bindable(name, each, MENU_PAD) for each in action.pad)
    assert can_clash("left", "retry")
    assert can_clash("boss", "faster")
    assert not can_clash("faster", "quick_save")


def test_a_key_of_the_menus_cannot_hide_the_game(driver: MenuDriver) -> None:
    driver.app.change_settings(keys={"boss": ("return", "b")})
    assert driver.app.controls.keys["boss"] == ("b",)
    driver.open("Settings")
    driver.settings_page("Keyboard")
    table = driver.shown(SettingsScreen).tables["keys"]
    table.taken("boss", 0, "space")
    assert "Space works the menus" in driver.app.notice
    assert "space" not in table.inputs("boss")


def test_a_palette_is_seen_in_a_level_beside_its_setting(driver: MenuDriver) -> None:
    driver.opened("Settings", SettingsScreen)

    def sample() -> pygame.Color:
        driver.frames(1)
        x, y = PALETTE_PREVIEW
        return driver.app.surface.get_at(driver.app.canvas.point(x + 2, y + 2))

    def is_rock(seen: pygame.Color, palette: str) -> bool:
        return max(abs(a - b) for a, b in zip(seen[:3], PALETTES[palette].tile[:3], strict=True)) <= max(GRAIN.values())

    before = sample()
    assert is_rock(before, "morning"), "in the first picture already"
    driver.app.change_settings(palette="dusk")
    after = sample()
    assert is_rock(after, "dusk")
    assert not is_rock(after, "morning")
