"""Links in the game: what is copied opens again, with the main menu behind it."""

from dataclasses import replace
from pathlib import Path

import pygame
import pytest

from ninja_game.editor.files import new_source, open_source
from ninja_game.errors import ReplayError
from ninja_game.files.bundled import bundled_levels, bundled_replays
from ninja_game.formats.links import level_link, recording_link
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.pack.pack import Pack, PackFiles
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.level.screen import LevelScreen, PausePanel
from ninja_game.play.main import first_screen, watch_screen
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.panels.replays import ReplaysScreen
from ninja_game.play.replay.screen import ReplayScreen
from tests.support.menu_driver import MenuDriver


@pytest.fixture
def clipboard(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    texts: list[str] = []
    monkeypatch.setattr(pygame.scrap, "put_text", texts.append)
    return texts


@pytest.fixture
def driver(tmp_path: Path) -> MenuDriver:
    return MenuDriver(tmp_path)


def opened(driver: MenuDriver, link: str) -> None:
    driver.app.push(first_screen(link, None, body="circle", practice=False)(driver.app))


def test_link_of_a_level_is_copied_under_levels_and_played(driver: MenuDriver, clipboard: list[str]) -> None:
    driver.app.change_settings(site="https://example.org/game/")
    browser = driver.opened("Levels", Browser)
    next(each for each in browser.widgets if getattr(each, "text", "") == "Link").confirm()
    (link,) = clipboard
    assert link.startswith("https://example.org/game/#level=1.")
    opened(driver, link)
    screen = driver.shown(LevelScreen)
    assert browser.selected is not None
    assert screen.playthrough.level == browser.selected.named.level
    driver.frames(2)
    driver.press("q")
    assert isinstance(driver.top(), MainMenu)


def test_link_of_a_replay_is_copied_in_the_viewer_and_watched(driver: MenuDriver, clipboard: list[str]) -> None:
    driver.earn_gold()
    assert isinstance(driver.open("Replays"), ReplaysScreen)
    driver.press("c")
    driver.press("return")
    assert isinstance(driver.top(), ReplayScreen)
    driver.press("c")
    assert len(clipboard) == 2
    (first,), (again,) = map(load_replays, clipboard)
    assert first.replay == again.replay
    opened(driver, clipboard[1])
    screen = driver.shown(ReplayScreen)
    assert screen.outcome == "exit"
    driver.press("escape")
    assert isinstance(driver.top(), MainMenu)


def test_link_of_a_run_is_copied_after_it(driver: MenuDriver, clipboard: list[str]) -> None:
    named = load_levels(bundled_levels()[0])[0]
    opened(driver, level_link(named.level, name=named.name))
    driver.press("space")
    driver.frames(5)
    driver.press("k")
    driver.frames(2)
    driver.press("c")
    (recording,) = load_replays(clipboard[0])
    assert recording.level == named.level
    assert recording.ticks > 1


def test_link_of_a_pack_is_copied_from_its_episodes_and_offered(driver: MenuDriver, clipboard: list[str]) -> None:
    opened(driver, PackFiles(Path("tests/pack")).link())
    screen = driver.shown(EpisodeGrid)
    name = screen.pack.name
    assert name == Pack(Path("tests/pack")).name
    driver.frames(2)
    driver.press("c")
    assert Pack(Path(clipboard[0])).name == name
    driver.press("return")
    assert isinstance(driver.top(), LevelScreen)


def test_link_of_several_replays_shows_ghosts(driver: MenuDriver) -> None:
    opened(driver, recording_link(load_replays(bundled_replays()[0]) * 2))
    screen = driver.shown(ReplayScreen)
    assert len(screen.view.ghosts) == 1


def test_texts_of_the_board_are_watched_over_the_menu(driver: MenuDriver) -> None:
    text = write_replay(replace(load_replays(bundled_replays()[0])[0].replay or Replay(b"", 0, "dead"), waypoints=()))
    driver.app.push(watch_screen([text, text])(driver.app))
    screen = driver.shown(ReplayScreen)
    assert len(screen.view.ghosts) == 1
    driver.press("escape")
    assert isinstance(driver.top(), MainMenu)
    with pytest.raises(ReplayError):
        watch_screen([text.replace("inputs:", "in puts:")])


def test_link_from_the_editor_opens_in_it(
    driver: MenuDriver, clipboard: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    says, teaches = "at 3,4: Jump | switch: Out!", "jumps"
    link = level_link(load_levels(bundled_levels()[0])[0].level, name="mine", says=says, teaches=teaches)
    source = open_source(Path(link))
    assert source.path is None
    screen = EditorScreen(driver.app, source)
    screen.commands.file_menu()
    driver.choose("Copy a link")
    copied = load_levels(clipboard[0])[0]
    assert (copied.name, copied.says, copied.teaches) == ("mine", says, teaches)
    screen.session.begin(new_source())
    monkeypatch.setattr(pygame.scrap, "get_text", lambda: f" {clipboard[0]}\n")
    screen.session.paste_string()
    assert screen.session.draft.name == "mine"
    screen.session.close()


def test_link_of_a_level_is_copied_in_the_pause(driver: MenuDriver, clipboard: list[str]) -> None:
    named = load_levels(bundled_levels()[0])[0]
    opened(driver, level_link(named.level, name=named.name, author=named.author))
    driver.press("space")
    driver.press("p")
    panel = driver.shown(PausePanel)
    next(each for each in panel.widgets if getattr(each, "text", "") == "Copy a link").confirm()
    (again,) = load_levels(clipboard[0])
    assert (again.level, again.name, again.author) == (named.level, named.name, named.author)


def test_without_a_clipboard_a_file_is_written(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(_: str) -> None:
        raise pygame.error("no clipboard")

    monkeypatch.setattr(pygame.scrap, "put_text", none)
    driver.earn_gold()
    driver.open("Replays")
    driver.press("c")
    (file,) = (driver.player.folder / "exports").iterdir()
    assert file.name.endswith(".link.txt")
    assert load_replays(file.read_text("utf-8").strip())
