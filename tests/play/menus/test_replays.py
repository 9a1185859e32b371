"""The list of replays: opens at once whatever there is, is searched, and says what each run is."""

from dataclasses import replace
from pathlib import Path
from time import process_time

import pytest

from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.panels.replays import FIRST_SECONDS, ReplaysScreen, _row_of_recording
from ninja_game.player.player_data import PlayerData
from tests.support.layout import Layout, noted
from tests.support.menu_driver import MenuDriver

MANY = 10_000


def with_replays(folder: Path, count: int) -> None:
    """Records with this many replays of one level, each with a name of its own."""
    player = PlayerData(folder)
    player.open_records()
    recording = load_replays(bundled_replays()[0])[0]
    first = player.records.keep_replay(replace(recording.replay, level=recording.level))
    columns = [row[1] for row in player.store.connection.execute("PRAGMA table_info(replay)") if row[1] != "id"]
    chosen = ", ".join({"name": "'Level ' || ?"}.get(column, column) for column in columns)
    with player.store.change() as db:
        query = f"INSERT INTO replay ({', '.join(columns)}) SELECT {chosen} FROM replay WHERE id = ?"
        db.executemany(query, [(number, first) for number in range(count)])
    player.close()


def test_ten_thousand_replays_open_within_a_tenth_of_a_second_and_all_are_found(tmp_path: Path) -> None:
    with_replays(tmp_path, MANY)
    driver = MenuDriver(tmp_path)
    try:
        before = process_time()
        screen = driver.open("Replays")
        taken = process_time() - before
        assert isinstance(screen, ReplaysScreen)
        assert taken < 0.1 + FIRST_SECONDS
        assert screen.rows[0].text == f"Level {MANY - 1}", "the newest first"
        driver.mouse(*screen.field.centre)
        driver.type("level 37")
        assert {row.text for row in screen.rows} >= {"Level 37", "Level 3700"}
        driver.type("00")
        assert [row.text for row in screen.rows] == ["Level 3700"]
        driver.type("x")
        assert not screen.rows
        driver.press("e")
        assert screen.list.empty == "No replay matches"
    finally:
        driver.close()


def test_ones_own_runs_are_shown_alone(driver: MenuDriver) -> None:
    driver.open("Play")
    driver.shown(LevelScreen).begin()
    driver.play_replay(1)
    driver.press("q")
    screen = driver.opened("Replays", ReplaysScreen)
    assert [row.when == "Included" for row in screen.rows] == [False, True]
    screen.focus = screen.filter
    driver.press("right")
    assert [row.player for row in screen.rows] == ["you"]
    driver.press("right")
    assert [row.when for row in screen.rows] == ["Included"]


def test_authors_runs_are_there_where_a_gold_medal_has_opened_them(driver: MenuDriver) -> None:
    screen = driver.opened("Replays", ReplaysScreen)
    assert not screen.rows
    driver.press("escape")
    first = driver.player.catalogue.episodes[0].levels[0]
    assert first.pars is not None
    driver.player.marks.passed(first.digest, first.pars.par("gold"), 0)
    screen = driver.opened("Replays", ReplaysScreen)
    assert {row.text for row in screen.rows} == {"Run and Hop"}


def test_rows_say_exit_or_gold_and_authors_have_one_name(driver: MenuDriver) -> None:
    driver.earn_gold()
    screen = driver.opened("Replays", ReplaysScreen)
    driver.wait(lambda: len(screen.rows) >= len(bundled_replays()))
    assert "exit" in {row.result.split(", ")[0] for row in screen.rows}
    level = room_level(["@.o.o"], ())
    full = Replay(b"", 9, "exit", gold=level.gold, level=level)
    assert _row_of_recording(Recording(level, full), "").result == "all gold, 0.225 s"
    theirs = replace(full, author="ninja-game check")
    assert _row_of_recording(Recording(level, theirs), "").player == "ninja-game"


def test_the_same_run_of_an_author_stands_once(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    files = [bundled_replays()[0]] * 2
    monkeypatch.setattr(ReplaysScreen, "bundled", lambda _: files)
    screen = driver.opened("Replays", ReplaysScreen)
    driver.frames(5)
    assert len(screen.rows) == 1


def test_only_who_has_killed_is_named(driver: MenuDriver) -> None:
    for killer, seen in (("", "Nothing so far"), ("mine", "Mine")):
        if killer:
            driver.player.statistics.attempt_ended("x", killer=killer, passed=False, ticks=1, gold=0)
        with noted() as layouts:
            layouts.append(Layout())
            driver.open("Records")
        texts = {each.text for each in layouts[-1].texts}
        assert texts & {"Mine", "Thwump", "Nothing so far"} == {seen}
        driver.press("escape")
