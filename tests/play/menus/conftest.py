"""The program, fresh for each test: at its main menu, or with the desk of packs."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from ninja_game.levels.findings import pack_finding
from ninja_game.play.menus.packs import PackScreen
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import rewrite
from tests.support.pack_desk import Desk


@pytest.fixture
def no_level_of_the_day(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.generator.daily.take_packed", lambda *_: False)
    monkeypatch.setattr("ninja_game.generator.daily.make_daily", lambda *_, **__: False)


@pytest.fixture
def driver(no_level_of_the_day: None, tmp_path: Path) -> Iterator[MenuDriver]:
    """The program at its main menu, with an empty folder of the player's."""
    driver = MenuDriver(tmp_path)
    yield driver
    driver.close()


@pytest.fixture(name="empty_desk")
def desk_without_packs(no_level_of_the_day: None, tmp_path: Path) -> Iterator[Desk]:
    desk = Desk(tmp_path)
    yield desk
    desk.close()


@pytest.fixture
def desk(empty_desk: Desk) -> Desk:
    """The program with a pack of the player's; its desk is not opened yet."""
    empty_desk.add_pack()
    return empty_desk


@pytest.fixture(name="screen")
def opened_desk(empty_desk: Desk, request: pytest.FixtureRequest) -> PackScreen:
    """The desk, opened; with the player's pack, where a test asks for that too."""
    if "desk" in request.fixturenames:
        request.getfixturevalue("desk")
    return empty_desk.open_packs()


@pytest.fixture
def own(desk: Desk, screen: PackScreen) -> Path:
    """A level of the player's folder, which the tray shows."""
    file = desk.path.with_name("mine.txt")
    file.write_text(desk.first.read_text("utf-8"), "utf-8")
    rewrite(file, "Run and Hop", "Mine")
    screen.choose_tray("yours")
    screen.app.draw()
    return file


@pytest.fixture
def zipped(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> PackScreen:
    """The desk after the player's pack was zipped in spite of a problem."""
    ready = desk.made([pack_finding("no-author", "pack.toml")], "No par times")
    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", lambda *_, **__: ready)
    screen = desk.open_packs()
    desk.choose("Make ready")
    desk.wait(lambda: desk.top() is not screen)
    desk.frames(ms=500)
    desk.choose("Zip and link all the same")
    desk.frames(2)
    desk.wait_for_check()
    return screen
