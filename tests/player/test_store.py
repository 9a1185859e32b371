"""Whatever has happened to the files, the game starts, says so, and loses nothing that can be kept."""

import sqlite3
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.files.user_folder import RECORDS, SETTINGS
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import parse_replay, write_replay
from ninja_game.player import schema
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.player_data import PlayerData, keep_replay, save_work
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.player.progress import UNLOCKED
from ninja_game.player.schema import SCHEMA_VERSION
from ninja_game.player.store import Store
from tests.support.players import deadly_level, entry, episode, played, player_data, short_level


def saved_record(folder: Path) -> str:
    """Pass a level in this folder; the level's digest."""
    data = player_data(folder)
    run = LevelPlaythrough(data, entry(short_level()))
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


@pytest.mark.parametrize("version, age", [(SCHEMA_VERSION + 1, "newer"), (SCHEMA_VERSION - 1, "older")])
def test_file_of_another_version_is_set_aside(tmp_path: Path, version: int, age: str) -> None:
    path = tmp_path / "records.sqlite"
    Store(path).close()
    with sqlite3.connect(path) as db:
        db.execute(f"PRAGMA user_version = {version}")
    db.close()
    store = Store(path)
    assert f"a game that is {age}: version {version} instead of {SCHEMA_VERSION}" in store.messages[0]
    assert (tmp_path / f"records.{age}-1.sqlite").is_file()


def test_someone_elses_database_is_set_aside(tmp_path: Path) -> None:
    path = tmp_path / "records.sqlite"
    with sqlite3.connect(path) as db:
        db.execute("CREATE TABLE photographs (name TEXT)")
    db.close()
    assert Store(path).messages
    assert (tmp_path / "records.damaged-1.sqlite").is_file()


def test_setting_aside_never_overwrites(tmp_path: Path) -> None:
    path = tmp_path / "records.sqlite"
    for _ in range(3):
        path.write_bytes(b"rubbish" * 200)
        Store(path).close()
        path.unlink()
    assert sorted(each.name for each in tmp_path.glob("records.damaged-*.sqlite")) == [
        f"records.damaged-{number}.sqlite" for number in (1, 2, 3)
    ]


def test_file_of_this_version_opens_with_its_records(tmp_path: Path) -> None:
    made = sqlite3.connect(tmp_path / "records.sqlite")
    made.executescript(Path(__file__).with_name(f"records-version-{SCHEMA_VERSION}.sql").read_text("utf-8"))
    made.close()
    data = player_data(tmp_path, episode())
    tables = "SELECT type, name, sql FROM sqlite_master WHERE sql IS NOT NULL ORDER BY name"
    there = data.store.connection.execute(tables).fetchall()
    assert there == Store(None).connection.execute(tables).fetchall(), "backups compare them"
    assert data.store.connection.execute("PRAGMA user_version").fetchone()[0] == SCHEMA_VERSION
    assert not data.messages
    best = data.records.episode_best(episode().key)
    assert best is not None
    assert best.score == 3485
    assert [replay.level_digest for replay in map(data.records.replay, best.replays) if replay] == [
        each.digest for each in episode().levels
    ]
    bests = data.records.level_bests()
    assert len(bests) == 6
    assert data.marks.all() == {level: (best.final_tick, best.gold) for level, best in bests.items()}
    newest = data.records.replays()[0]
    assert (newest.name, newest.player, newest.kept) == ("a death", "somebody", 1)
    assert data.progress.state(1) == UNLOCKED
    assert (data.statistics.deaths()["mine"], data.statistics.played().passes) == (1, 6)


def test_tables_are_made_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(schema, "SCHEMA", schema.SCHEMA | {"again": "CREATE TABLE death (x)"})
    with pytest.raises(sqlite3.OperationalError):
        schema.open_database(str(tmp_path / "records.sqlite"))
    with sqlite3.connect(tmp_path / "records.sqlite") as db:
        assert not db.execute("SELECT * FROM sqlite_master").fetchall()
    db.close()


def test_failed_change_leaves_nothing_behind(tmp_path: Path) -> None:
    store = Store(tmp_path / "records.sqlite")

    def change_half() -> None:
        with store.change() as db, store.change():
            db.execute("INSERT INTO death VALUES ('mine', 1)")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        change_half()
    assert store.connection.execute("SELECT * FROM death").fetchall() == []


# --- a place that cannot be used now ---


def test_unusable_place_keeps_the_records_in_memory_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "player").write_text("in the way")
    data = player_data(tmp_path / "player")
    run = LevelPlaythrough(data, entry(short_level()))
    notices = run.passed(played(short_level()))
    assert not any("saved" in notice for notice in notices[:-1])
    assert notices[-1].startswith("Not saved yet: the records cannot be opened")
    assert keep_replay(data, played(deadly_level()).replay()).startswith("Not saved yet")
    assert "in memory only" in " ".join(data.messages)
    assert data.records.level_best(run.entry.digest) is not None


def test_what_was_kept_in_memory_is_saved_as_soon_as_the_place_can_be_used(tmp_path: Path) -> None:
    (tmp_path / "player").write_text("in the way")
    data = player_data(tmp_path / "player", episode())
    EpisodePlaythrough(data, episode()).passed(played(short_level()))
    (tmp_path / "player").unlink()
    assert keep_replay(data, played(deadly_level()).replay()) == "Replay: saved"
    data.close()
    again = player_data(tmp_path / "player", episode())
    assert len(again.records.replays()) == 2
    assert again.progress.columns[0].beaten == (0, 1)
    assert again.statistics.played().passes == 1


def lock(folder: Path) -> sqlite3.Connection:
    """Another program that writes to the records for a long time."""
    other = sqlite3.connect(folder / "records.sqlite", isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    return other


def test_locked_records_hold_nobody_up_and_nothing_is_lost(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode())
    assert not data.records.replays()
    other = lock(tmp_path)
    run = EpisodePlaythrough(data, episode())
    attempt = played(short_level())
    assert data.store.connection.execute("PRAGMA busy_timeout").fetchone() == (200,), "ms"
    assert run.passed(attempt) == ["Not saved yet: database is locked"]
    run.died(played(deadly_level()))
    assert data.progress.columns[0].beaten == (0, 0)
    # The same object goes on to another try; what was passed must not change.
    attempt.restart()
    other.execute("COMMIT")
    other.close()
    assert keep_replay(data, played(deadly_level()).replay()) == "Replay: saved"
    assert data.records.level_best(run.entry.digest) is not None
    assert data.progress.columns[0].beaten == (0, 1)
    assert data.statistics.played().deaths == 1


def test_start_goes_on_while_another_program_keeps_everyone_out(tmp_path: Path) -> None:
    assert schema.OPENING_SECONDS <= 1, "longer than that nobody waits for a game"
    saved_record(tmp_path)
    other = sqlite3.connect(tmp_path / "records.sqlite", isolation_level=None)
    other.execute("PRAGMA locking_mode = EXCLUSIVE")
    other.execute("BEGIN EXCLUSIVE")
    data = player_data(tmp_path)
    assert "locked" in data.store.problem
    assert keep_replay(data, played(deadly_level()).replay()).startswith("Not saved yet")
    other.execute("ROLLBACK")
    other.close()
    data.close()
    assert len(player_data(tmp_path).records.replays()) == 2


def test_what_waits_is_saved_at_the_end(tmp_path: Path) -> None:
    data = player_data(tmp_path)
    assert not data.records.replays()
    other = lock(tmp_path)
    LevelPlaythrough(data, entry(short_level())).passed(played(short_level()))
    other.execute("ROLLBACK")
    other.close()
    data.close()
    assert len(player_data(tmp_path).records.level_bests()) == 1


def test_records_that_may_only_be_read_are_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    digest = saved_record(tmp_path)

    def refuse(*_: object, **__: object) -> None:
        raise sqlite3.OperationalError("attempt to write a readonly database")

    # A root user may write everything, so that modes would not do.
    opened = schema.open_database
    monkeypatch.setattr("ninja_game.player.store.open_database", refuse)
    data = player_data(tmp_path)
    assert data.records.level_best(digest) is not None
    assert "readonly" in data.messages[0]
    monkeypatch.setattr("ninja_game.player.store.open_database", opened)


def test_failed_commit_advances_nothing(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode())
    run = EpisodePlaythrough(data, episode())
    # A constraint that is looked at when the transaction ends.
    data.store.connection.executescript(
        "CREATE TABLE a (id INTEGER PRIMARY KEY); CREATE TABLE b (a REFERENCES a DEFERRABLE INITIALLY DEFERRED);"
        "CREATE TRIGGER t AFTER INSERT ON progress BEGIN INSERT INTO b VALUES (7); END;"
    )
    assert run.passed(played(short_level())) == ["Not saved yet: FOREIGN KEY constraint failed"]
    assert data.progress.columns[0].beaten == (0, 0)
    assert not data.store.connection.in_transaction
    data.store.connection.execute("DROP TRIGGER t")
    assert run.passed(played(short_level()))[0] == "First pass"
    assert data.progress.columns[0].beaten == (0, 1)


# --- two games at once ---

PATIENT = (
    "import pathlib, sys\nfrom ninja_game.player import store\n"
    "store.STARTS_WAIT, store.OPENING_SECONDS, store.LAST_WAIT_MS = 600, 600, 600_000\n"
)
"""The begin of programs that wait for each other however slow the machine is."""


def test_two_games_merge_their_progress(tmp_path: Path) -> None:
    first, second = player_data(tmp_path), player_data(tmp_path)
    assert first.progress.columns == second.progress.columns
    for level in range(4):
        first.progress.level_passed((0, level), legitimate=True)
    second.progress.level_passed((0, 0), legitimate=True)
    assert second.progress.columns[0].beaten == (0, 4)
    assert player_data(tmp_path).progress.columns[0].beaten == (0, 4)


def test_many_first_starts_at_once(tmp_path: Path) -> None:
    program = (
        f"{PATIENT}from ninja_game.player.player_data import PlayerData\n"
        "data = PlayerData(pathlib.Path(sys.argv[1]))\ndata.statistics.attempt_ended('level', killer='mine', "
        "passed=False, ticks=1, gold=0)\nprint(*data.messages, data.store.problem)\ndata.close()"
    )
    command = [sys.executable, "-c", program, str(tmp_path / "home")]
    starts = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) for _ in range(8)]
    assert [start.communicate()[0].strip() for start in starts] == [""] * 8
    assert player_data(tmp_path / "home").statistics.deaths()["mine"] == 8


@pytest.mark.parametrize("count", [1, 4])
def test_damaged_file_costs_no_session_its_persistence(tmp_path: Path, count: int) -> None:
    (tmp_path / "records.sqlite").write_bytes(b"rubbish" * 500)
    program = f"{PATIENT}opened = store.Store(pathlib.Path(sys.argv[1]))\nprint(opened.problem)\nopened.close()"
    command = [sys.executable, "-c", program, str(tmp_path / "records.sqlite")]
    starts = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(count)]
    assert [start.communicate()[0].strip() for start in starts] == [""] * count
    assert [each.name for each in tmp_path.glob("records.damaged-*.sqlite")] == ["records.damaged-1.sqlite"]


def test_practice_replay_carries_its_mark(tmp_path: Path) -> None:
    data = player_data(tmp_path)
    keep_replay(data, played(short_level(), practice=True).replay("practised"))
    keep_replay(data, played(deadly_level()).replay("played"))
    marks = {saved.name: data.records.replay(saved.id) for saved in data.records.replays()}
    practised, plain = marks["practised"], marks["played"]
    assert practised is not None
    assert plain is not None
    assert "made: played (practice)\n" in write_replay(practised)
    assert parse_replay(write_replay(practised)).practice
    assert "made: played\n" in write_replay(plain)


def test_records_keep_how_a_run_was_made_and_who_took_part(tmp_path: Path) -> None:
    data = player_data(tmp_path)
    made = Provenance(edits=34, searches=("improve", "search"), begun_by="Ann")
    keep_replay(data, replace(played(short_level()).replay(), author="Ann", made=made, co_authors=("Bob", "Cy")))
    (saved,) = data.records.replays()
    replay = data.records.replay(saved.id)
    assert replay is not None
    assert (replay.made, replay.co_authors) == (made, ("Bob", "Cy"))


def test_replay_that_a_best_needs_is_not_forgotten(tmp_path: Path) -> None:
    digest = saved_record(tmp_path)
    records = player_data(tmp_path).records
    best = records.level_best(digest)
    assert best is not None
    assert not records.forget_replay(best.id)
    kept = records.keep_replay(played(short_level(1)).replay())
    assert records.forget_replay(kept)
    assert [each.id for each in records.replays()] == [best.id]


def test_what_a_newcomer_plays_is_forgotten_and_touches_no_records(tmp_path: Path) -> None:
    data = PlayerData(tmp_path)
    (tmp_path / SETTINGS).write_text("damaged")
    newcomer = data.newcomer()
    assert newcomer.catalogue is data.catalogue
    assert not newcomer.messages, "the settings are those that are in use: the file is not read again"
    assert save_work(newcomer, lambda: ["New best"]) == ["New best", "Not saved yet: this is a preview"]
    newcomer.close()
    assert not (tmp_path / RECORDS).exists()
