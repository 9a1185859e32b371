"""The daily level: made once from the date, kept as a pack, played with par times and records; problems are shown."""

from datetime import date, timedelta
from pathlib import Path
from threading import Event
from time import monotonic, sleep
from typing import Self

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.files.user_folder import DAILY
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.pack import Pack
from ninja_game.generator import daily
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.daily import DailyScreen
from ninja_game.player.progress import WITH_HELP
from ninja_game.runs.packs import read_pack_certificate
from tests.support.draw_log import drawn
from tests.support.menu_driver import MenuDriver
from tests.support.waiting import LONGEST

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from tests.support.golden_generated import SMALL

MADE, PACKED = daily.make_daily, daily.take_packed
DAY = date(2026, 11, 23)


class Today(date):
    """A calendar that stands still: other days make other levels, and not every one of a small budget."""

    @classmethod
    def today(cls) -> Self:
        return cls(DAY.year, DAY.month, DAY.day)


class Thursday(Today):
    @classmethod
    def today(cls) -> Self:
        return cls(2026, 11, 26)


@pytest.fixture
def making(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> MenuDriver:
    """The program on a Monday, with real levels of the day from a small budget."""
    monkeypatch.setattr("ninja_game.play.menus.daily.date", Today)
    monkeypatch.setattr("ninja_game.generator.generate.DEFAULT", SMALL)
    monkeypatch.setattr(daily, "make_daily", MADE)
    return driver


def opened(driver: MenuDriver) -> DailyScreen:
    """The screen, when nothing is being made any more."""
    screen = driver.opened("Daily", DailyScreen)
    end = monotonic() + LONGEST
    while screen.maker and monotonic() < end:
        sleep(0.02)
        driver.frames(1)
    return screen


def test_the_daily_level_is_made_once_beside_other_days_played_and_in_the_list_of_levels(making: MenuDriver) -> None:
    assert PACKED(making.player.folder / "levels", date(2026, 11, 24))
    screen = opened(making)
    assert screen.entry is not None, screen.message
    assert screen.entry.pars is not None
    assert screen.entry.pars.difficulty is not None
    before = screen.file.read_bytes(), screen.file.stat().st_mtime_ns
    making.press("return")
    assert isinstance(making.top(), LevelScreen)
    making.app.pop()
    assert screen.entry.digest in {entry.digest for entry in making.player.catalogue.single_levels()}
    making.press("escape")
    assert opened(making).entry is not None
    assert (screen.file.read_bytes(), screen.file.stat().st_mtime_ns) == before
    pack = Pack(screen.file.parent)
    assert len(pack.levels) == len(pack.pars) == 2
    for file in pack.levels:
        found = read_pack_certificate(pack, file, "exit")
        assert found is not None
        assert found.problems == []


def test_the_days_that_come_with_the_game_need_no_compiler(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.play.menus.daily.date", Today)
    monkeypatch.setattr(daily, "take_packed", PACKED)
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    screen = opened(driver)
    assert screen.entry is not None, screen.message
    assert screen.entry.pars is not None
    found = read_pack_certificate(Pack(screen.file.parent), screen.file.name, "exit")
    assert found is not None
    assert found.problems == []


def test_a_hundred_weeks_of_days_come_with_the_game(tmp_path: Path) -> None:
    last = daily.FIRST_DAY + timedelta(weeks=100, days=-1)
    seen = set()
    for day in (daily.FIRST_DAY, daily.FIRST_DAY + timedelta(1), daily.FIRST_DAY + timedelta(7), last):
        assert daily.take_packed(tmp_path, day)
        found = read_pack_certificate(Pack(tmp_path / DAILY), f"{day}.txt", "exit")
        assert found is not None
        assert found.problems == []
        seen.add(level_digest(found.level))
    assert len(seen) == 4
    assert not daily.take_packed(tmp_path, daily.FIRST_DAY - timedelta(1))
    assert not daily.take_packed(tmp_path, last + timedelta(1))


def test_without_numba_it_is_said(making: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    screen = opened(making)
    assert screen.entry is None
    assert "needs Numba" in screen.message
    making.frames(2)


def test_a_file_that_is_not_a_level_is_reported_and_stays(making: MenuDriver) -> None:
    file = daily.daily_file(making.player.folder / "levels", DAY)
    file.parent.mkdir(parents=True)
    file.write_text("ninja-game level 1\nname: mine\n")
    screen = opened(making)
    assert screen.entry is None
    assert screen.message
    assert file.read_text() == "ninja-game level 1\nname: mine\n"


def test_leaving_gives_up_what_is_made(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    stopped = Event()

    def slow(*_: object, stop: Event, **__: object) -> bool:
        stop.wait(20)
        stopped.set()
        return False

    monkeypatch.setattr(daily, "make_daily", slow)
    screen = driver.opened("Daily", DailyScreen)
    assert screen.maker is not None
    driver.press("escape")
    assert stopped.wait(15), "it is not told that nobody waits for it"
    driver.frames(2)


def test_days_in_a_row_and_the_week_are_shown_and_one_way_back(
    making: MenuDriver, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(daily, "take_packed", PACKED)
    for number in range(23, 27):
        assert PACKED(making.player.folder / "levels", date(2026, 11, number))
    monkeypatch.setattr("ninja_game.play.menus.daily.date", Thursday)
    screen = opened(making)
    marks = making.player.marks
    found = []
    for day, body in (("24", "circle"), ("25", WITH_HELP), ("26", "circle"), ("23", "circle")):
        found.append(screen.streak)
        marks.passed(screen.days[f"2026-11-{day}"].digest, 400, 1, body)
    assert [*found, screen.streak] == [0, 0, 2, 3, 4]
    shown = drawn(making.app)
    assert "4 daily levels in a row" in shown
    assert shown.count("10.000 s'") >= 3
    assert "with help" in shown
    screen.entry = None
    assert not screen.build(), "the frame has its own way back"


def test_it_gets_harder_over_the_week() -> None:
    assert [daily.daily_difficulty(date(2026, 11, day)) for day in range(23, 30)] == [2, 3, 4, 5, 6, 7, 8]
    assert daily.daily_seed(DAY) == 20261123
