"""A player's data as one file: what goes out comes back, twice if need be, and nothing that is there is lost."""

from __future__ import annotations

import io
from pathlib import Path
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.errors import FileError
from ninja_game.player.backup import read_backup, write_backup
from ninja_game.player.playthrough import LevelRun
from ninja_game.player.saving import keep_replay
from tests.support.players import deadly_level, entry, episode, played, player_data, short_level


def filled(folder: Path) -> Path:
    """A player's folder with one of everything; the zip of it."""
    data = player_data(folder)
    run = LevelRun(data, entry(short_level()))
    assert run.passed(played(short_level()))
    keep_replay(data, played(deadly_level()).replay("dead"))
    levels = episode()
    data.records.episode_passed(levels.key, 900, [played(each.named.level).replay("e") for each in levels.levels])
    data.progress.level_passed((0, 2), legitimate=True)
    data.statistics.attempt_ended("x", killer="mine", passed=False, ticks=5, gold=1)
    data.change_settings(data.settings.changed(palette="dark"))
    (folder / "levels" / "own.txt").write_text("a level")
    (folder / "levels" / ".hidden").write_text("not this")
    write_backup(data, folder / "all.zip")
    data.close()
    return folder / "all.zip"


def test_everything_comes_back_in_an_empty_folder_and_twice_changes_nothing(tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    there, here = player_data(tmp_path / "from"), player_data(tmp_path / "to")
    lines = read_backup(here, backup.read_bytes())
    assert "levels/own.txt" in lines
    assert "settings.toml" in lines
    assert (tmp_path / "to" / "levels" / "own.txt").read_text() == "a level"
    for data in (there, here):
        assert data.records.level_best(entry(short_level()).digest) is not None
        assert {replay.name for replay in data.records.replays()} == {"short", "dead", "e"}
    best = here.records.episode_best(episode().key)
    assert best is not None
    assert (best.score, len(best.replays)) == (900, 5)
    for table in ("played", "death", "level_mark", "progress"):
        query = f"SELECT * FROM {table}"
        assert here.store.connection.execute(query).fetchall() == there.store.connection.execute(query).fetchall()
    assert read_backup(here, backup.read_bytes()) == ["0 new replays in the records", "0 new files"]
    assert player_data(tmp_path / "to").settings.palette == "dark"


def test_what_is_better_stays_and_files_of_one_name_stand_beside_each_other(tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    here = player_data(tmp_path / "to")
    rich = short_level()
    run = LevelRun(here, entry(rich))
    assert run.passed(played(rich))
    here.records.episode_passed(
        episode().key, 1000, [played(each.named.level).replay("mine") for each in episode().levels]
    )
    for _ in range(3):
        here.statistics.attempt_ended("x", killer="mine", passed=False, ticks=5, gold=1)
    here.change_settings(here.settings.changed(palette="contrast", name="me"))
    (tmp_path / "to" / "levels" / "own.txt").write_text("another level")
    read_backup(here, backup.read_bytes())
    best = here.records.episode_best(episode().key)
    assert best is not None
    assert best.score == 1000
    assert here.store.connection.execute("SELECT times FROM death").fetchall() == [(3,)]
    assert (tmp_path / "to" / "levels" / "own.txt").read_text() == "another level"
    assert (tmp_path / "to" / "levels" / "own-2.txt").read_text() == "a level"
    assert "contrast" in (tmp_path / "to" / "settings.before-1.toml").read_text()
    assert player_data(tmp_path / "to").settings.palette == "dark"


def packed(**files: bytes) -> bytes:
    out = io.BytesIO()
    with ZipFile(out, "w") as archive:
        for name, content in files.items():
            archive.writestr(name.replace("__", "/").replace("DOT", "."), content)
    return out.getvalue()


@pytest.mark.parametrize(
    "data",
    [b"", b"no zip", packed(), packed(settingsDOTtoml=b""), packed(recordsDOTsqlite=b"no database" * 100)],
    ids=["empty", "text", "empty zip", "no records", "damaged records"],
)
def test_what_is_no_backup_changes_nothing(data: bytes, tmp_path: Path) -> None:
    here = player_data(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(FileError, match="no backup of a player's data"):
        read_backup(here, data)
    assert sorted(tmp_path.rglob("*")) == before


def test_names_that_lead_elsewhere_are_passed_by(tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    with ZipFile(backup, "a") as archive:
        for name in ("../out.txt", "levels/../../out.txt", "/out.txt", "levels/.hidden", "levels/a/b.txt", "x.txt"):
            archive.writestr(name, "stranger")
    read_backup(player_data(tmp_path / "to"), backup.read_bytes())
    assert "stranger" not in [path.read_text() for path in tmp_path.rglob("*.txt")]


def test_the_commands_move_a_player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    filled(tmp_path / "from")
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "from"))
    assert CliRunner().invoke(cli, ["player", "export", str(tmp_path / "data.zip")]).exit_code == 0
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "to"))
    result = CliRunner().invoke(cli, ["player", "import", str(tmp_path / "data.zip")])
    assert (result.exit_code, result.output.splitlines()[0]) == (0, "6 new replays in the records")
