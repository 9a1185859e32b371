"""Whatever has happened to the files, the game starts, says so, and loses nothing that can be kept."""

from __future__ import annotations

import os
import sqlite3
from pathlib import Path

import pytest

from ninja_game.player import store as store_module
from ninja_game.player.playthrough import LevelRun
from ninja_game.player.records import Records
from ninja_game.player.store import APPLICATION_ID, MIGRATIONS, VERSION, open_store
from tests.support.players import entry, played, player_data, short_level


def saved_record(folder: Path) -> str:
    """Pass a level in this folder; the level's digest."""
    data = player_data(folder)
    run = LevelRun(data, entry(short_level()))
    assert run.passed(played(short_level()))
    data.close()
    return run.entry.digest


def test_record_and_its_replay_come_back_equal(tmp_path: Path) -> None:
    digest = saved_record(tmp_path)
    records = player_data(tmp_path).records
    best = records.level_best(digest)
    assert best is not None
    replay = records.replay(best.id)
    assert replay is not None
    expected = played(short_level()).replay("short")
    assert (replay.inputs, replay.final_tick, replay.digest, replay.level) == (
        expected.inputs, expected.final_tick, expected.digest, expected.level,
    )  # fmt: skip


@pytest.mark.parametrize("damage", [b"no database at all" * 100, b"", b"SQLite format 3\0" + b"\xff" * 4000])
def test_damaged_file_is_set_aside_and_the_game_starts(tmp_path: Path, damage: bytes) -> None:
    path = tmp_path / "records.sqlite"
    path.write_bytes(damage)
    store = open_store(path)
    assert store.path == path
    if damage:
        assert "records.damaged-1.sqlite" in store.messages[0]
        assert (tmp_path / "records.damaged-1.sqlite").read_bytes() == damage
    assert Records(store).replays() == []


def test_torn_pages_in_the_middle_are_noticed(tmp_path: Path) -> None:
    saved_record(tmp_path)
    path = tmp_path / "records.sqlite"
    data = bytearray(path.read_bytes())
    data[4096:] = os.urandom(len(data) - 4096)
    path.write_bytes(data)
    assert open_store(path).messages


def test_newer_file_is_set_aside(tmp_path: Path) -> None:
    path = tmp_path / "records.sqlite"
    open_store(path).close()
    with sqlite3.connect(path) as db:
        db.execute(f"PRAGMA user_version = {VERSION + 1}")
    db.close()
    store = open_store(path)
    assert "newer game" in store.messages[0]
    assert (tmp_path / "records.newer-1.sqlite").is_file()


def test_someone_elses_database_is_set_aside(tmp_path: Path) -> None:
    path = tmp_path / "records.sqlite"
    with sqlite3.connect(path) as db:
        db.execute("CREATE TABLE photographs (name TEXT)")
    db.close()
    assert open_store(path).messages
    assert (tmp_path / "records.damaged-1.sqlite").is_file()


def test_setting_aside_never_overwrites(tmp_path: Path) -> None:
    path = tmp_path / "records.sqlite"
    for _ in range(3):
        path.write_bytes(b"rubbish" * 200)
        open_store(path).close()
        path.unlink()
    assert sorted(each.name for each in tmp_path.glob("records.damaged-*.sqlite")) == [
        f"records.damaged-{number}.sqlite" for number in (1, 2, 3)
    ]


def test_older_version_is_migrated_with_its_records(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "records.sqlite"
    old = sqlite3.connect(path)
    old.executescript(MIGRATIONS[0])
    old.execute("INSERT INTO death VALUES ('mine', 7)")
    old.execute(f"PRAGMA application_id = {APPLICATION_ID}")
    old.execute("PRAGMA user_version = 1")
    old.commit()
    old.close()
    data = player_data(tmp_path)
    assert data.statistics.deaths()["mine"] == 7
    assert data.store.connection.execute("PRAGMA user_version").fetchone()[0] == VERSION
    assert not data.store.messages


def test_failing_migration_leaves_the_old_file_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "records.sqlite"
    open_store(path).close()
    monkeypatch.setattr(store_module, "MIGRATIONS", (*MIGRATIONS, "CREATE TABLE more (x);\nCREATE TABLE death (x);"))
    monkeypatch.setattr(store_module, "VERSION", VERSION + 1)
    with pytest.raises(sqlite3.OperationalError):
        store_module._opened(str(path))
    db = sqlite3.connect(path)
    assert db.execute("PRAGMA user_version").fetchone()[0] == VERSION
    assert not db.execute("SELECT * FROM sqlite_master WHERE name = 'more'").fetchall()
    db.close()


def test_failed_change_leaves_nothing_behind(tmp_path: Path) -> None:
    store = open_store(tmp_path / "records.sqlite")

    def change_half() -> None:
        with store.change() as db, store.change():
            db.execute("INSERT INTO death VALUES ('mine', 1)")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        change_half()
    assert store.connection.execute("SELECT * FROM death").fetchall() == []


def test_unusable_place_keeps_the_records_in_memory(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    store = open_store(tmp_path / "file" / "records.sqlite")
    assert store.path is None
    assert "lost" in store.messages[0]


def test_replay_that_a_best_needs_is_not_forgotten(tmp_path: Path) -> None:
    digest = saved_record(tmp_path)
    records = player_data(tmp_path).records
    best = records.level_best(digest)
    assert best is not None
    assert not records.forget_replay(best.id)
    kept = records.keep_replay(played(short_level(1)).replay())
    assert records.forget_replay(kept)
    assert [each.id for each in records.replays()] == [best.id]
