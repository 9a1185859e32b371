"""A damaged file of records is set aside, a damaged row left out; what is kept then is there at the next start."""

import os
import shutil
import sqlite3
import subprocess
import sys
from contextlib import closing, suppress
from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.formats.run_time import seconds_text
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.player_data import keep_replay
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.player.progress import LOCKED, UNLOCKED
from ninja_game.player.records import Records
from ninja_game.player.schema import open_database
from ninja_game.player.store import Store
from tests.support.players import deadly_level, entry, episode, played, player_data, short_level


def file_with_a_best(folder: Path) -> Path:
    """The closed file of records of a player who has passed a level."""
    data = player_data(folder)
    assert LevelPlaythrough(data, entry(short_level())).passed(played(short_level()))
    data.close()
    return folder / "records.sqlite"


def test_a_damaged_table_whose_name_is_no_text_is_set_aside_too(tmp_path: Path) -> None:
    path = tmp_path / "records.sqlite"
    Store(path).close()
    damaged = path.read_bytes().replace(b"level_best", b"l\xb1vel_best")
    path.write_bytes(damaged.replace(b"CREATE TABLE l\xb1", b"CREATE TABLX l\xb1"))
    store = Store(path)
    assert "its tables cannot be read" in store.messages[0]
    assert (tmp_path / "records.damaged-1.sqlite").is_file()
    store.close()


@pytest.mark.parametrize("damage", [b"no database at all" * 100, b"", b"SQLite format 3\0" + b"\xff" * 4000])
def test_damaged_file_is_set_aside_and_the_game_starts(tmp_path: Path, damage: bytes) -> None:
    path = tmp_path / "records.sqlite"
    path.write_bytes(damage)
    store = Store(path)
    assert store.path == path
    if damage:
        assert "records.damaged-1.sqlite" in store.messages[0]
        assert (tmp_path / "records.damaged-1.sqlite").read_bytes() == damage
    assert Records(store).replays() == []


@pytest.mark.parametrize("place, byte", [(18, 3), (47, 9), (63, 0)], ids=["read only", "newer format", "no version"])
def test_file_with_a_wrong_header_is_set_aside_and_saves_last(tmp_path: Path, place: int, byte: int) -> None:
    path = file_with_a_best(tmp_path)
    data = bytearray(path.read_bytes())
    data[place] = byte
    path.write_bytes(data)
    assert_a_replay_can_be_kept(tmp_path, "records.damaged-1.sqlite")


@pytest.mark.parametrize("change", [(b"gold INTEGER", b"gole INTEGER"), (b"REFERENCES replay", b"REFERENCES reploy")])
def test_file_with_another_table_than_ours_is_set_aside(tmp_path: Path, change: tuple[bytes, bytes]) -> None:
    path = file_with_a_best(tmp_path)
    path.write_bytes(path.read_bytes().replace(*change))
    assert_a_replay_can_be_kept(tmp_path, "is not as it should be")


def assert_a_replay_can_be_kept(folder: Path, word: str = "") -> None:
    """Start with a word to the player, keep a replay, start again: it is shown, and can be watched."""
    data = player_data(folder)
    data.open_records()
    assert word in " ".join(data.messages)
    kept = played(deadly_level()).replay("kept", "me")
    assert keep_replay(data, kept) == "Replay: saved"
    data.close()
    data = player_data(folder)
    there = [data.records.replay(saved.id) for saved in data.records.replays() if saved.kept]
    assert kept in [replace(replay, name="kept", author="me") for replay in there if replay is not None]
    data.close()


def test_damage_is_reported_also_where_python_leaves_out_assertions(tmp_path: Path) -> None:
    (tmp_path / "records.sqlite").write_bytes(b"damaged" * 1000)
    code = (
        "import pathlib, sys; from ninja_game.player.player_data import PlayerData\n"
        "data = PlayerData(pathlib.Path(sys.argv[1])); data.open_records(); print(data.messages)"
    )
    words = [sys.executable, "-O", "-c", code, str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert "records.damaged-1.sqlite" in done.stdout


def test_torn_pages_in_the_middle_are_noticed(tmp_path: Path) -> None:
    path = file_with_a_best(tmp_path)
    data = bytearray(path.read_bytes())
    data[4096:] = os.urandom(len(data) - 4096)
    path.write_bytes(data)
    assert Store(path).messages


EDITS = [
    f"UPDATE {table} SET {column} = {value}"
    for table, columns in (
        ("replay", ("name", "player", "body", "outcome", "final_tick", "gold", "score", "made_at", "kept", "inputs",
                    "level_text", "level", "digest", "made")),
        ("level_best", ("level", "body")), ("level_mark", ("level", "fastest", "most_gold")),
        ("episode_best", ("score", "made_at", "episode")),
        ("episode_replay", ("episode", "place")), ("progress", ("beaten_episode", "reached_level")),
        ("death", ("times",)), ("played", ("attempts", "ticks", "gold")), ("fact", ("value",)),
    )
    for column in columns
    for value in ("x'ff00'", "'odd'", "-9e99", "9223372036854775807")
]  # fmt: skip


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The closed file of records of a player who has passed an episode and died."""
    folder = tmp_path_factory.mktemp("full")
    data = player_data(folder, episode())
    run = EpisodePlaythrough(data, episode())
    for _ in range(5):
        run.passed(played(run.entry.named.level, lifetime=run.lifetime))
        run.advance()
    run.died(played(deadly_level()))
    data.close()
    return folder / "records.sqlite"


@pytest.mark.parametrize("edit", EDITS)
def test_damaged_rows_are_left_out_and_play_goes_on(edit: str, full: Path, tmp_path: Path) -> None:
    with closing(open_database(str(shutil.copy(full, tmp_path)))) as records, suppress(sqlite3.IntegrityError):
        records.execute(edit)
    again = player_data(tmp_path, episode())
    for saved in again.records.replays():
        seconds_text(saved.score)
        again.records.replay(saved.id)
    again.records.level_bests()
    best = again.records.episode_best(episode().key)
    assert best is None or all(isinstance(number, int) for number in best.replays)
    assert again.statistics.deaths()["mine"] == 1 or edit.startswith("UPDATE death")
    seconds_text(again.statistics.played().ticks)
    assert again.progress.state(99) == LOCKED
    assert again.columns_complete == (not edit.startswith("UPDATE progress"))
    run = EpisodePlaythrough(again, episode())
    for _ in range(5):
        notices = run.passed(played(run.entry.named.level, lifetime=run.lifetime))
        assert not any("Not saved" in notice for notice in notices)
        run.advance()
    assert again.progress.state(1) == UNLOCKED


@pytest.mark.parametrize("edit", [edit for edit in EDITS if edit.startswith("UPDATE replay")])
def test_keeping_a_run_whose_row_is_damaged_saves_it_again(edit: str, tmp_path: Path) -> None:
    data = player_data(tmp_path)
    data.records.keep_replay(played(deadly_level()).replay("kept", "me"))
    data.store.connection.execute(edit)
    data.close()
    assert_a_replay_can_be_kept(tmp_path)


def test_no_value_of_a_gigabyte_is_made(tmp_path: Path) -> None:
    with closing(open_database(str(tmp_path / "records.sqlite"))) as records, pytest.raises(sqlite3.DataError):
        records.execute("SELECT length(hex(zeroblob(500000000)))")
