"""The player's packs in the window: with mouse, keys and pad levels are moved, packs made, made ready and mended."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from zipfile import ZipFile

import pytest

from ninja_game.editor.packing import ReadyPack
from ninja_game.formats.pack.pack import Pack
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.menu_screen import BACK, MenuScreen
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.panels import FormPanel
from ninja_game.play.menus.problems import ProblemsScreen
from ninja_game.ui.input.gamepad import BUTTONS
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK


@pytest.fixture(name="path")
def pack_of_the_player(driver: MenuDriver) -> Path:
    path = driver.player.folder / "levels" / "laundry"
    shutil.copytree(PACK, path, ignore=shutil.ignore_patterns("gallery", "README.md"))
    index = path / "pack.toml"
    index.write_text(index.read_text("utf-8").replace("test pack", "Laundry"), "utf-8")
    return path


def opened(driver: MenuDriver) -> PackScreen:
    driver.open("Levels")
    driver.choose("Packs")
    driver.frames(2)
    return driver.shown(PackScreen)


def layout(path: Path) -> dict[int, list[str]]:
    pack = Pack(path)
    return {each.number: [file[:4] for file in each.files(pack.files.levels)] for each in pack.index.episodes}


def typed(driver: MenuDriver, text: str) -> None:
    """Put a text into the form on top, and accept it."""
    driver.fill(text, "OK")


def test_levels_and_episodes_are_dragged(driver: MenuDriver, path: Path) -> None:
    screen = opened(driver)
    shelves = screen.shelves
    driver.carry(shelves.row_area(2), shelves.row_area(8))
    assert layout(path) == {0: ["00-0", "00-2", "00-3", "00-4"], 1: ["01-0", "00-1", "01-1", "01-2"]}
    driver.carry(shelves.row_area(1), screen.tray.area)
    assert layout(path)[0] == ["00-2", "00-3", "00-4"]
    assert [cell.level.title for cell in screen.side if cell.level] == ["First Steps"]
    driver.carry(screen.tray.row_area(0), shelves.row_area(13))
    assert layout(path)[2] == ["00-0"], "a row below the others is a new episode"
    driver.carry(shelves.row_area(12), shelves.row_area(0))
    assert layout(path) == {0: ["00-0"], 1: ["00-2", "00-3", "00-4"], 2: ["01-0", "00-1", "01-1", "01-2"]}
    driver.carry(shelves.row_area(1), (300, 530, 2, 2))
    assert layout(path)[0] == ["00-0"], "let go over nothing it stays"
    assert driver.top() is screen


def test_a_full_episode_says_so(driver: MenuDriver, path: Path) -> None:
    screen = opened(driver)
    driver.carry(screen.shelves.row_area(7), screen.shelves.row_area(2))
    assert "episode 1 is full" in driver.app.notice
    assert layout(path)[1] == ["01-0", "01-1", "01-2"]


def test_keys_alone_move_a_level(driver: MenuDriver, path: Path) -> None:
    opened(driver)
    driver.press("right", "return")
    driver.choose("Move...")
    driver.press("down", "return")
    assert layout(path) == {0: ["00-1", "00-2", "00-3", "00-4"], 1: ["00-0", "01-0", "01-1", "01-2"]}
    driver.press("return")
    driver.choose("Move...")
    driver.press("escape")
    driver.shown(PackScreen)
    driver.press("escape")
    driver.shown(Browser)


def test_a_pad_alone_makes_a_pack_with_a_level_and_edits_it(driver: MenuDriver) -> None:
    def button(name: str) -> None:
        driver.pad(BUTTONS.index(name))

    opened(driver)
    button("a")
    button("dpad-down")
    button("a")
    screen = driver.shown(PackScreen)
    assert [pack.name for pack in screen.mine] == ["My pack"]
    button("a")
    assert driver.shown(MenuScreen).title == "Episode 1"
    button("a")
    button("dpad-down")
    button("a")
    assert [cell.level.title for cell in screen.cells if cell.level] == ["New level"]
    button("dpad-right")
    button("a")
    button("a")
    assert driver.shown(EditorScreen).session.source.path == screen.path / "new-level.txt"
    driver.shown(EditorScreen).session.close()


def test_a_level_of_the_players_folder_goes_into_the_pack_and_one_of_the_game_is_copied(
    driver: MenuDriver, path: Path
) -> None:
    own = driver.player.folder / "levels" / "mine.txt"
    own.write_text((path / "00-0-first-steps.txt").read_text("utf-8").replace("First Steps", "Mine"), "utf-8")
    screen = opened(driver)
    screen._choose_tray("yours")
    driver.frames(2)
    driver.carry(screen.tray.row_area(0), screen.shelves.row_area(11))
    assert not own.exists()
    assert (path / "mine.txt").exists()
    screen._choose_tray("")
    driver.carry(screen.tray.row_area(0), screen.shelves.row_area(11))
    assert layout(path)[1][3:] == ["mine", "00-0"]
    driver.carry(screen.shelves.row_area(10), screen.tray.row_area(0))
    assert "cannot be changed: it is the game's own" in driver.app.notice


def test_everything_about_a_pack_is_named_again(driver: MenuDriver, path: Path) -> None:
    screen = opened(driver)
    for index, entry, text in ((1, "Rename...", "Early steps"), (0, "Rename...", "Falls"), (0, "New level...", "New")):
        driver.mouse(*(value + 20 for value in screen.shelves.row_area(index)[:2]))
        driver.mouse(*(value + 20 for value in screen.shelves.row_area(index)[:2]))
        driver.choose(entry)
        if entry == "New level...":
            typed(driver, text)
            assert "episode 1 is full" in driver.app.notice
        else:
            typed(driver, text)
    driver.choose("About it...")
    driver.choose("Name, author, version...")
    driver.shown(FormPanel).texts[2] = "2"
    driver.choose("OK")
    pack = Pack(path)
    assert (pack.index.version, pack.index.episodes[0].name) == ("2", "Falls")
    assert pack.levels["00-0-first-steps.txt"].name == "Early steps"
    driver.choose("About it...")
    driver.choose("Copy of the pack...")
    typed(driver, "Laundry")
    assert [each.name for each in screen.mine] == [
        "Laundry by the ninja-game developers, 2 (laundry)", "Laundry by the ninja-game developers, 2 (laundry-2)",
    ]  # fmt: skip


def test_a_problem_leads_to_its_place_and_is_accepted_with_a_reason(driver: MenuDriver, path: Path) -> None:
    level = path / "00-0-first-steps.txt"
    level.write_text(level.read_text("utf-8").replace("author: the ninja-game team\n", ""), "utf-8")
    opened(driver)
    driver.choose("Problems")
    screen = driver.shown(ProblemsScreen)
    assert [problem.text for problem in screen.problems] == ["00-0-first-steps.txt: no author"]
    driver.press("return")
    assert driver.shown(EditorScreen).session.source.path == level
    driver.shown(EditorScreen).session.close()
    driver.app.pop()
    driver.choose("Accept it...")
    typed(driver, "found on the street")
    assert driver.top() is screen
    assert screen.problems == []
    assert Pack(path).index.accepted[0].reason == "found on the street"
    driver.mouse(BACK[0] + 10, BACK[1] + 10)
    driver.shown(PackScreen)


def test_a_pack_is_made_ready_in_the_background(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pack = Pack(path)
    ready = ReadyPack(pack, [], pack.files.zipped(), pack.files.link(), [])
    said = []

    def made(folder: Path, *, seconds: float, jobs: int, say: object) -> ReadyPack:
        said.append(folder)
        say("Certifying")  # type: ignore[operator]
        return replace(ready)

    monkeypatch.setattr("ninja_game.play.menus.packs.make_ready", made)
    screen = opened(driver)
    driver.choose("Make ready")
    driver.wait(lambda: screen.status == "8 levels, 0 problems", "the pack is ready")
    zipped = driver.player.folder / "exports" / "laundry-1.zip"
    assert said == [path]
    assert ZipFile(zipped).namelist()[0] == "laundry/pack.toml"
    assert "laundry-1.zip; the link is in the clipboard" in driver.app.notice
    assert driver.button("Make ready")


def test_making_ready_is_stopped(driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(folder: Path, *, seconds: float, jobs: int, say: object) -> ReadyPack:
        while True:
            say("Certifying")  # type: ignore[operator]

    monkeypatch.setattr("ninja_game.play.menus.packs.make_ready", endless)
    screen = opened(driver)
    driver.choose("Make ready")
    driver.wait(lambda: screen.status == "Certifying")
    driver.choose("Stop")
    driver.wait(lambda: "Stopped" in screen.status)
    assert driver.button("Make ready")


def test_what_changed_is_marked(driver: MenuDriver, path: Path) -> None:
    level = path / "00-1-mind-the-gap.txt"
    level.write_text(level.read_text("utf-8").replace("@", ".", 1), "utf-8")
    screen = opened(driver)
    stale = [cell.level.title for cell in screen.cells if cell.level and cell.level.pars is None]
    assert stale == ["Mind the Gap"]
    assert screen._counts() == "8 levels in 2 episodes; 1 to certify"
