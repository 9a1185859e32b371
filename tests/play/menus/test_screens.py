"""Every screen can be reached, used and left by keys, mouse and gamepad; the focus is always somewhere."""

from pathlib import Path

import pygame
import pytest

from ninja_game.files.bundled import data_folder
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.lab.screen import LabScreen
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen, PausePanel
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import MenuScreen, Question
from ninja_game.play.menus.browser import COMMENT_HEIGHT, SIDE_WIDTH, Browser
from ninja_game.play.menus.daily import DailyScreen
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.panels.replays import RecordsScreen, ReplaysScreen
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.settings import BY_COLUMN
from ninja_game.ui.theme import wrapped
from ninja_game.ui.widgets import Button
from tests.support.menu_driver import MenuDriver

ENTRIES = {
    "Play": LevelScreen,
    "Episodes": EpisodeGrid,
    "Daily": DailyScreen,
    "Levels": Browser,
    "Records": RecordsScreen,
    "Replays": ReplaysScreen,
    "Editor": EditorScreen,
    "Settings": SettingsScreen,
    "Help": HelpScreen,
}
WITH_FOCUS = [entry for entry in ENTRIES if entry not in {"Play", "Editor"}]
"""Screens on which the arrows move a focus and Escape leads back at once; elsewhere they move ninja and pointer."""
DIRECTIONS = ("down", "down", "right", "up", "left", "left", "up", "right", "pagedown", "pageup", "end", "home")


@pytest.mark.parametrize("entry", WITH_FOCUS)
def test_screen_is_reached_and_left_by_keys(driver: MenuDriver, entry: str) -> None:
    assert isinstance(driver.open(entry), ENTRIES[entry])
    driver.frames(5)
    driver.press("escape")
    assert isinstance(driver.top(), MainMenu)


# The daily level is being made at first: there is nothing to choose until then (test_daily.py).
@pytest.mark.parametrize("entry", [entry for entry in WITH_FOCUS if entry != "Daily"])
def test_focus_is_always_on_a_widget_and_seen(driver: MenuDriver, entry: str) -> None:
    screen = driver.open(entry)
    assert isinstance(screen, MenuScreen)
    for name in DIRECTIONS * 2:
        driver.press(name)
        assert screen.focus in screen.widgets
        assert screen.focus is not None
        assert screen.focus.focusable
    with_focus = pygame.image.tobytes(driver.app.surface, "RGB")
    screen.focus = None
    screen.redraw = True
    driver.frames(1, ms=0)
    assert pygame.image.tobytes(driver.app.surface, "RGB") != with_focus


@pytest.mark.parametrize("entry", WITH_FOCUS)
def test_screen_is_reached_and_left_by_gamepad(driver: MenuDriver, entry: str) -> None:
    menu = driver.shown(MainMenu)
    place = [widget.text for widget in menu.widgets if isinstance(widget, Button)].index(entry)
    for _ in range((place + 1) // 2):
        driver.pad(pygame.CONTROLLER_BUTTON_DPAD_DOWN)
    if place % 2 == 0:
        driver.pad(pygame.CONTROLLER_BUTTON_DPAD_RIGHT)
    driver.pad(pygame.CONTROLLER_BUTTON_A)
    assert isinstance(driver.top(), ENTRIES[entry])
    driver.pad(pygame.CONTROLLER_BUTTON_B)
    assert driver.top() is menu


@pytest.mark.parametrize("entry", WITH_FOCUS)
def test_screen_is_reached_by_mouse(driver: MenuDriver, entry: str) -> None:
    menu = driver.shown(MainMenu)
    button = next(widget for widget in menu.widgets if isinstance(widget, Button) and widget.text == entry)
    driver.mouse(*button.centre)
    assert isinstance(driver.top(), ENTRIES[entry])


def test_leaving_the_game_is_asked_first(driver: MenuDriver) -> None:
    driver.press("escape")
    assert isinstance(driver.top(), Question)
    driver.press("return")
    assert isinstance(driver.top(), MainMenu)
    driver.press("escape", "down", "return")
    assert not driver.app.running


def test_up_in_a_question_does_not_lead_to_what_it_warns_of(driver: MenuDriver) -> None:
    driver.press("escape", "up", "return")
    assert isinstance(driver.top(), MainMenu)
    assert driver.app.running


def test_up_from_the_first_entry_leads_to_the_last_row(driver: MenuDriver) -> None:
    driver.press("up", "right")
    menu = driver.shown(MainMenu)
    assert menu.focus is menu.widgets[-1]


def test_held_direction_repeats(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    driver.frames(24)
    pygame.event.post(pygame.Event(pygame.KEYUP, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    driver.frames(1)
    assert menu.focus is not None
    place = menu.widgets.index(menu.focus)
    driver.frames(30)
    assert menu.widgets.index(menu.focus) == place != 1


def test_stall_during_a_short_press_does_not_repeat_it(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    driver.frames(2, ms=1500)
    pygame.event.post(pygame.Event(pygame.KEYUP, key=pygame.K_DOWN, scancode=pygame.KSCAN_DOWN, mod=0, unicode=""))
    driver.frames(2)
    assert menu.focus is menu.widgets[1]


def test_every_page_of_the_settings_shows(driver: MenuDriver) -> None:
    driver.open("Settings")
    for page in driver.shown(SettingsScreen).pages:
        assert driver.settings_page(page).page == page
        driver.frames(2)


def test_palette_is_changed_shown_and_saved(driver: MenuDriver) -> None:
    driver.open("Settings")
    driver.press("right", "right")
    driver.shown(SettingsScreen)
    chosen = driver.player.settings.palette
    assert chosen != BY_COLUMN
    assert driver.app.theme.palette.name == chosen
    assert f'palette = "{chosen}"' in (driver.player.folder / "settings.toml").read_text()


def test_key_is_rebound_by_pressing_it(driver: MenuDriver) -> None:
    driver.open("Settings")
    screen = driver.settings_page("Keyboard")
    driver.press("down", "down", "return", "x")
    assert driver.player.settings.keys["jump"][0] == "x"
    assert "jump" in driver.keys.decode(pygame.Event(pygame.KEYDOWN, key=0, scancode=pygame.KSCAN_X)).pressed
    driver.press("delete")
    assert "x" not in driver.player.settings.keys["jump"]
    driver.press("return", "escape")
    assert screen is driver.top()


def test_levels_are_searched_and_sorted(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    browser.focus = browser.entry_field
    driver.type("wall")
    assert [entry.title for entry in browser.shown] == ["Wall to Wall"]
    for _ in "chimney":
        driver.press("backspace")
    assert len(browser.shown) == len(browser.entries)
    browser.sort_by("name")
    titles = [entry.title.casefold() for entry in browser.shown]
    assert titles == sorted(titles)


def test_dropped_file_is_there_when_the_browser_opens(driver: MenuDriver) -> None:
    (driver.player.folder / "levels" / "mine.txt").write_text("0" * 713 + "|5^100,566!11^160,564,130,564")
    (driver.player.folder / "levels" / "broken.txt").write_text("ninja-game level 1\nnonsense")
    browser = driver.opened("Levels", Browser)
    assert "mine" in [entry.title for entry in browser.shown]
    assert [problem.text[:13] for problem in browser.problems] == ["broken.txt:2:"]


def test_level_without_a_ninja_is_refused_with_a_message(driver: MenuDriver) -> None:
    (driver.player.folder / "levels" / "empty.txt").write_text("0" * 713 + "|0^100,566")
    browser = driver.opened("Levels", Browser)
    browser.play([entry.title for entry in browser.shown].index("empty"))
    assert driver.top() is browser
    assert browser.message


def test_pause_offers_going_on_retry_and_leaving(driver: MenuDriver) -> None:
    driver.open("Episodes")
    driver.press("return", "space")
    level = driver.shown(LevelScreen)
    driver.press("p")
    assert isinstance(driver.top(), PausePanel)
    tick = level.attempt.simulation.tick
    driver.frames(5)
    assert level.attempt.simulation.tick == tick
    driver.press("p")
    assert driver.top() is level
    assert level.phase.value == Phase.PLAY.value
    driver.press("escape", "down", "return")
    assert level.phase.value == Phase.READY.value
    driver.press("space", "p", "q")
    assert isinstance(driver.top(), EpisodeGrid)


def test_settings_and_help_open_from_the_pause(driver: MenuDriver) -> None:
    driver.open("Episodes")
    driver.press("return", "space", "p", "down", "down", "down", "return")
    assert isinstance(driver.top(), SettingsScreen)
    driver.press("escape", "down", "return")
    assert isinstance(driver.top(), HelpScreen)
    driver.press("escape")
    assert isinstance(driver.top(), PausePanel)


def test_locked_episode_does_not_start(driver: MenuDriver) -> None:
    driver.open("Episodes")
    driver.press("down", "return")
    assert isinstance(driver.top(), EpisodeGrid)


def test_replay_of_the_game_is_watched(driver: MenuDriver) -> None:
    driver.earn_gold()
    driver.open("Replays")
    driver.press("return")
    assert isinstance(driver.top(), ReplayScreen)
    driver.frames(10)
    driver.press("escape")
    assert isinstance(driver.top(), ReplaysScreen)


def test_damaged_files_are_reported_in_the_menu(tmp_path: Path) -> None:
    (tmp_path / "records.sqlite").write_bytes(b"rubbish" * 500)
    (tmp_path / "settings.toml").write_text("not [ toml")
    driver = MenuDriver(tmp_path)
    assert len(driver.player.messages) == 2
    assert isinstance(driver.top(), MainMenu)
    driver.frames(3)
    driver.close()


def test_odd_names_and_a_level_without_ninja_stop_no_screen(driver: MenuDriver) -> None:
    level = parse_level_string("0" * 713 + "|0^100,100")
    odd = "$na\tme \x00 \x1b[31m#me#c#" + "0" * 713 + "|5^60,540!0^396,300#"
    (driver.player.folder / "levels" / "odd.txt").write_text(odd.replace("\x00", "\u200b"))
    replay = Replay(b"\1\1", 1, "running", name="x\0y\x1b\ud800" * 100, level=level)
    (driver.player.folder / "replays" / "a.txt").write_text(write_replay(replay))
    driver.open("Levels")
    driver.frames(5)
    driver.press("escape")
    screen = driver.opened("Replays", ReplaysScreen)
    screen.list.index = next(place for place, row in enumerate(screen.rows) if row.text.startswith("x"))
    driver.press("return")
    driver.frames(3)
    assert driver.top() is screen
    assert "no ninja" in driver.app.notice
    driver.press("e")
    assert len(list((driver.player.folder / "exports").iterdir())) == 1


def test_damaged_rows_are_reported_where_they_are_missing(driver: MenuDriver) -> None:
    driver.player.store.connection.execute("INSERT INTO death VALUES ('mine', 'often')")
    driver.player.store.connection.execute("INSERT INTO progress VALUES ('', 0, 'far', 0, 0, 0)")
    driver.player.store.epoch += 1
    driver.open("Episodes")
    assert "Some of the records are damaged" in driver.app.notice
    driver.app.notify("")
    driver.press("escape")
    driver.open("Records")
    assert driver.app.notice == ""


def test_file_dropped_on_the_window_is_taken_in(driver: MenuDriver, tmp_path: Path) -> None:
    browser = driver.opened("Levels", Browser)
    file = tmp_path / "dropped.txt"
    file.write_text("0" * 713 + "|5^100,566!11^160,564,130,564")
    driver.drop_file(file)
    assert "dropped" in [entry.title for entry in browser.shown]
    driver.drop_file(tmp_path / "settings.toml")
    assert browser.message


def test_a_dropped_file_gets_no_name_that_is_odd_and_follows_no_link(driver: MenuDriver, tmp_path: Path) -> None:
    browser = driver.opened("Levels", Browser)
    levels, outside = driver.player.folder / "levels", tmp_path / "outside.txt"
    (levels / "link.txt").symlink_to(outside)
    (tmp_path / "dropped").mkdir()
    for name, refusal in (("aux.txt", "Give it another name"), ("\u202ea.txt", "Give it"), ("LINK.txt", "already")):
        (tmp_path / "dropped" / name).write_text("0" * 713 + "|5^100,566!11^160,564,130,564")
        driver.drop_file(tmp_path / "dropped" / name)
        assert refusal in browser.message
    assert [path.name for path in levels.iterdir()] == ["link.txt"]
    assert not outside.exists()


def test_replay_is_written_as_a_text_to_share(driver: MenuDriver) -> None:
    driver.earn_gold()
    driver.open("Replays")
    driver.press("e")
    written = list((driver.player.folder / "exports").glob("*.replay.txt"))
    assert len(written) == 1
    assert load_replays(written[0])[0].replay


def test_what_players_need_comes_before_what_is_for_the_curious(driver: MenuDriver) -> None:
    names = [text for text, _, _ in driver.shown(MainMenu).entries()]
    assert names[-2:] == ["Settings", "Quit"]
    assert isinstance(driver.open("Help"), HelpScreen)
    driver.choose("How it works")
    assert driver.shown(LabScreen)
    driver.press("escape", "escape")
    for entry in ("Levels", "Episodes"):
        screen = driver.open(entry)
        assert isinstance(screen, MenuScreen)
        words = " ".join(getattr(each, "text", "") for each in screen.widgets)
        assert "Practice" in words
        assert "Practise" not in words
        driver.press("escape")


def test_text_of_every_level_is_seen_whole_in_the_list(driver: MenuDriver) -> None:
    theme, cut = driver.app.theme, []
    for named in Pack(data_folder("levels")).levels.values():
        texts = (named.comment, f"Teaches: {named.teaches}")
        lines = [line for text in texts for line in wrapped(theme, text, SIDE_WIDTH, 10.5)]
        cut += [named.name] * (13.5 * len(lines) > COMMENT_HEIGHT)
    assert not cut
