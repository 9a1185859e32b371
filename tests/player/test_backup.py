"""A player's data as one file: what goes out comes back, twice if need be, and nothing that is there is lost."""

import io
import json
import re
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path, PurePosixPath
from typing import Any
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.editor.files import ascii_text, lost_drafts
from ninja_game.errors import FileError
from ninja_game.files.tree import Tree
from ninja_game.player import backup, schema
from ninja_game.player.backup import MAX_REPLAYS, MAX_TABLE_ROWS, TargetFolder, read_backup, write_backup
from ninja_game.player.player_data import PlayerData, keep_replay
from ninja_game.player.playthrough import LevelPlaythrough
from tests.support.level_maker import ROOM
from tests.support.players import deadly_level, entry, episode, played, player_data, short_level


def filled(folder: Path) -> Path:
    """A player's folder with one of everything; the zip of it."""
    data = player_data(folder)
    run = LevelPlaythrough(data, entry(short_level()))
    assert run.passed(played(short_level()))
    keep_replay(data, played(deadly_level()).replay("dead"))
    levels = episode()
    data.records.episode_passed(levels.key, 900, [played(each.named.level).replay("e") for each in levels.levels])
    data.progress.level_passed((0, 2), legitimate=True)
    data.statistics.attempt_ended("a" * 64, killer="mine", passed=False, ticks=5, gold=1)
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
    run = LevelPlaythrough(here, entry(rich))
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


ELSEWHERE = (
    "../out.txt", "levels/../../out.txt", "/out.txt", "levels/.hidden", "levels/a/b.txt", "x.txt", "levels/..\\out.txt",
    "levels/CON.txt", "levels/aux", "levels/a.txt.", "levels/a ", "levels/\x9b2J.txt", "levels/\u202egnp.txt",
    f"levels/{'ä' * 200}.txt", "levels/c:out.txt", "tas/a.jsonl",
)  # fmt: skip


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
def test_what_is_not_a_backup_changes_nothing(data: bytes, tmp_path: Path) -> None:
    here = player_data(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(FileError, match="not a backup of a player's data"):
        read_backup(here, data)
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", ELSEWHERE, ids=ascii)
def test_a_name_that_leads_elsewhere_or_is_odd_somewhere_is_left_out_and_told(name: str, tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    with ZipFile(backup, "a") as archive:
        archive.writestr(name, "untrusted")
    (line,) = [line for line in read_backup(player_data(tmp_path / "to"), backup.read_bytes()) if "left out" in line]
    assert line.isprintable()
    assert "untrusted" not in [path.read_text() for path in tmp_path.rglob("*.txt")]
    assert (tmp_path / "to" / "levels" / "own.txt").read_text() == "a level"


def test_an_odd_name_of_ones_own_does_not_go_along_and_is_reported(tmp_path: Path) -> None:
    data = player_data(tmp_path)
    (tmp_path / "levels" / "what?.txt").write_text("a level")
    assert write_backup(data, tmp_path / "all.zip") == [
        'left out: levels/what?.txt: not one of /\\:*?"<>| may be in it'
    ]
    assert "levels/what?.txt" not in ZipFile(tmp_path / "all.zip").namelist()


def test_what_would_not_be_taken_in_is_reported_when_it_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    filled(tmp_path)
    data = player_data(tmp_path)
    (tmp_path / "editing").mkdir(exist_ok=True)
    (tmp_path / "editing" / "long.json").write_bytes(bytes(2**20 + 1))
    assert write_backup(data, tmp_path / "one.zip") == ["left out: editing/long.json: no level under edit"]
    monkeypatch.setattr(backup, "MAX_REPLAYS", 2)
    last_line = write_backup(data, tmp_path / "all.zip")[-1]
    assert last_line.startswith("too large to be taken in: 6 rows in the table replay, of which at most 2 are accepted")
    with pytest.raises(FileError, match="6 rows"):
        read_backup(player_data(tmp_path / "to"), (tmp_path / "all.zip").read_bytes())


def test_records_whose_pages_lead_in_circles_are_refused(tmp_path: Path) -> None:
    filled(tmp_path / "from")
    records = tmp_path / "from" / "records.sqlite"
    with closing(sqlite3.connect(records)) as db:
        db.execute("PRAGMA writable_schema = ON")
        db.execute(
            "UPDATE sqlite_master SET rootpage = (SELECT rootpage FROM sqlite_master WHERE name = 'replay')"
            " WHERE name = 'death'"
        )
        db.commit()
    with ZipFile(tmp_path / "all.zip", "w") as archive:
        archive.write(records, "records.sqlite")
    with pytest.raises(FileError, match="damaged records: "):
        read_backup(player_data(tmp_path / "to"), (tmp_path / "all.zip").read_bytes())


def test_own_records_whose_pages_lead_in_circles_are_put_aside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    endless = "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT max(i) FROM n"
    filled(tmp_path)
    looks = iter([endless])
    monkeypatch.setattr(schema, "MAX_STEPS", 1)
    monkeypatch.setattr(schema, "_check_tables", lambda db: db.execute(next(looks, "SELECT 1")).fetchall())
    data = player_data(tmp_path)
    assert not data.records.replays()
    assert "damaged (its pages lead in circles)" in "".join(data.messages)


def test_an_error_without_a_code_of_sqlite_stays_what_it_is() -> None:
    db, error = sqlite3.connect(":memory:"), sqlite3.OperationalError("Could not decode to UTF-8")
    with closing(db), pytest.raises(sqlite3.OperationalError, match="decode"), schema.bound_queries(db):
        raise error


def test_names_that_are_one_file_on_some_system_stand_beside_each_other(tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    with ZipFile(backup, "a") as archive:
        for name in ("levels/\u00c9.txt", "levels/e\u0301.TXT", "levels/OWN.txt"):
            archive.writestr(name, name)
    lines = read_backup(player_data(tmp_path / "to"), backup.read_bytes())
    there = {path.name for path in (tmp_path / "to" / "levels").iterdir()}
    assert there == {"own.txt", "OWN-2.txt", "\u00c9.txt", "e\u0301-2.TXT"}
    assert read_backup(player_data(tmp_path / "to"), backup.read_bytes())[1] == "0 new files", lines


@pytest.mark.parametrize("target", ["outside.txt", "made.txt"])
def test_a_link_among_the_players_files_is_not_written_through(target: str, tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    (tmp_path / "outside.txt").write_text("mine")
    here = player_data(tmp_path / "to")
    (tmp_path / "to" / "levels" / "own.txt").symlink_to(tmp_path / target)
    read_backup(here, backup.read_bytes())
    assert (tmp_path / "outside.txt").read_text() == "mine"
    assert not (tmp_path / "made.txt").exists()
    assert (tmp_path / "to" / "levels" / "own-2.txt").read_text() == "a level"


def everything(data: PlayerData) -> tuple[list[str], dict[Path, bytes]]:
    """All rows of the records, and all other files."""
    files = {
        path: path.read_bytes() for path in data.folder.rglob("*") if path.is_file() and "records" not in path.name
    }
    return list(data.store.connection.iterdump()), files


@pytest.mark.parametrize("after", range(4))
def test_a_disk_that_is_full_in_the_middle_leaves_everything_as_it_was(
    after: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    backup = filled(tmp_path / "from")
    with ZipFile(backup, "a") as archive:
        archive.writestr("replays/a.txt", "one more")
    here = player_data(tmp_path / "to")
    here.change_settings(here.settings.changed(name="me"))
    before = everything(here)
    write, left = Tree.write, iter(range(after))

    def full(tree: Tree, name: str, content: bytes | str) -> None:
        if next(left, None) is None:
            raise OSError(28, "No space left on device")
        write(tree, name, content)

    monkeypatch.setattr(Tree, "write", full)
    if after == 3:
        monkeypatch.setattr("ninja_game.player.backup.TargetFolder.add", full_at_the_end(TargetFolder.add))
    with pytest.raises(OSError, match="No space left"):
        read_backup(here, backup.read_bytes())
    assert everything(here) == before


def full_at_the_end(add: Callable[..., bool]) -> Callable[..., bool]:
    """Takes everything, and fails after the settings, as a transaction may at its end."""

    def failing(folder: TargetFolder, name: PurePosixPath, *more: Any) -> bool:
        taken = add(folder, name, *more)
        if name.name == "settings.toml":
            raise OSError(28, "No space left on device")
        return taken

    return failing


def with_records(backup: Path, *statements: str) -> bytes:
    """The backup after these statements on its records."""
    with ZipFile(backup) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    path = backup.with_suffix(".sqlite")
    path.write_bytes(files["records.sqlite"])
    with closing(sqlite3.connect(path)) as db:
        for statement in statements:
            db.execute(statement)
        db.commit()
    files["records.sqlite"] = path.read_bytes()
    out = io.BytesIO()
    with ZipFile(out, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return out.getvalue()


NOTHING = "NULL, '', '', '', '', '', '', 0, 0, 0, '', '', '', 1, '', ''"
NOTHING_OF_A_MEGABYTE = NOTHING.replace("''", "hex(zeroblob(500000))", 2).replace("hex(zeroblob(500000))", "''", 1)
COUNTING = "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < {}) "


@pytest.mark.parametrize(
    "statement, problem",
    [
        (
            f"INSERT INTO played {COUNTING.format(MAX_TABLE_ROWS)} SELECT i, 1, 1, 1, 1, 1 FROM n",
            "rows in the table played",
        ),
        (f"INSERT INTO replay {COUNTING.format(MAX_REPLAYS)} SELECT {NOTHING} FROM n", "rows in the table replay"),
        ("CREATE TRIGGER t BEFORE UPDATE ON replay BEGIN DELETE FROM replay; END", "the trigger t is not ours"),
        ("CREATE TRIGGER replay BEFORE UPDATE ON replay BEGIN DELETE FROM replay; END", "trigger replay is not ours"),
        ("CREATE INDEX i ON replay (length(hex(inputs)))", "the index i is not ours"),
        ("CREATE VIEW saved AS SELECT * FROM replay", "the view saved is not ours"),
        ("CREATE TABLE more (a)", "the table more is not ours"),
        ("UPDATE replay SET level_text = level_text || hex(zeroblob(600000))", "a level of"),
        (f"INSERT INTO replay {COUNTING.format(20)} SELECT {NOTHING_OF_A_MEGABYTE} FROM n", "levels of"),
        ("UPDATE replay SET inputs = zeroblob(2000000)", "replays of"),
        ("PRAGMA user_version = 99", "a game that is newer"),
        ("PRAGMA user_version = 4", "a game that is older"),
    ],
)
def test_records_that_hold_too_much_or_more_than_rows_change_nothing(
    statement: str, problem: str, tmp_path: Path
) -> None:
    data = with_records(filled(tmp_path / "from"), statement)
    here = player_data(tmp_path / "to")
    before = everything(here)
    with pytest.raises(FileError, match=problem):
        read_backup(here, data)
    assert everything(here) == before


@pytest.mark.parametrize("more", ["CHECK (length(key) > 0)", "COLLATE NOCASE", "DEFAULT (hex(randomblob(9)))"])
def test_records_whose_tables_would_do_something_are_refused(more: str, tmp_path: Path) -> None:
    data = filled(tmp_path / "from")
    with closing(sqlite3.connect(tmp_path / "from" / "records.sqlite")) as db:
        ((made,),) = db.execute("SELECT sql FROM sqlite_master WHERE name = 'fact'")
    column = re.search(r"\(\s*(\w+ TEXT[^,]*)", made)
    assert column
    other = made.replace(column[1], f"{column[1]} {more.replace('key', column[1].split()[0])}", 1)
    with pytest.raises(FileError, match="the table fact is not ours"):
        read_backup(player_data(tmp_path / "to"), with_records(data, "DROP TABLE fact", other))


def test_what_replays_claim_and_do_not_do_is_left_out(tmp_path: Path) -> None:
    forged = "UPDATE replay SET gold = 1000, score = 80000, player = 'eve'"
    data = with_records(filled(tmp_path / "from"), forged, "UPDATE episode_best SET score = 99999")
    here = player_data(tmp_path / "to")
    level = short_level()
    assert LevelPlaythrough(here, entry(level)).passed(played(level))
    words = read_backup(here, data)
    assert words[0] == "0 new replays in the records"
    assert [word for word in words if "does not do what it says" in word], words
    assert here.store.connection.execute("SELECT DISTINCT player FROM replay WHERE player = 'eve'").fetchall() == []
    assert here.records.episode_best(episode().key) is None
    assert [best.gold for best in here.records.level_bests("circle").values()] != [1000]


@pytest.mark.parametrize("name", ["levels/desktop.ini", "replays/a.lnk", "exports/b.bat", "levels/x.txt.lock"])
def test_a_file_that_a_system_may_start_is_left_out(name: str, tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    with ZipFile(backup, "a") as archive:
        archive.writestr(name, "untrusted")
    lines = read_backup(player_data(tmp_path / "to"), backup.read_bytes())
    assert f"left out: {name}: no file of a player's" in lines
    assert not (tmp_path / "to" / name).exists()


def test_branches_come_with_their_run_alone(tmp_path: Path) -> None:
    backup = filled(tmp_path / "from")
    here = player_data(tmp_path / "to")
    (tmp_path / "to" / "replays" / "mine.txt").write_text("my run")
    with ZipFile(backup, "a") as archive:
        for name in ("mine.txt", "mine.txt.branches.json", "new.txt", "new.txt.branches.json", "no.txt.branches.json"):
            archive.writestr(f"replays/{name}", "theirs")
    read_backup(here, backup.read_bytes())
    there = {path.name for path in (tmp_path / "to" / "replays").iterdir()}
    assert there == {"mine.txt", "mine-2.txt", "new.txt", "new.txt.branches.json"}


def test_an_address_for_links_that_changes_is_reported(tmp_path: Path) -> None:
    data = player_data(tmp_path / "from")
    data.change_settings(data.settings.changed(site="https://other.example/"))
    write_backup(data, tmp_path / "all.zip")
    lines = read_backup(player_data(tmp_path / "to"), (tmp_path / "all.zip").read_bytes())
    assert "links lead to https://other.example/ now" in lines


def test_a_level_under_edit_that_is_none_or_too_large_is_left_out(tmp_path: Path) -> None:
    with ZipFile(filled(tmp_path / "from")) as archive:
        files = {name.replace("/", "__").replace(".", "DOT"): archive.read(name) for name in archive.namelist()}
    files |= {"editing__aDOTjson": b'{"level": "' + b"x" * 2**20 + b'"}', "editing__aDOTlock": b""}
    read_backup(player_data(tmp_path / "to"), packed(**files))
    assert not list((tmp_path / "to").rglob("editing/a.*"))


LONG = "a" * 64


@pytest.mark.parametrize(
    "table, statement",
    [
        ("played", "INSERT INTO played VALUES ('no digest', 1, 1, 1, 1, 1)"),
        ("played", f"INSERT INTO played VALUES ('{LONG}', -1, 1, 1, 1, 1)"),
        ("played", f"INSERT INTO played VALUES ('{LONG}', 1, 1, 1, {2**60}, 1)"),
        ("death", "INSERT INTO death VALUES ('nobody', 1)"),
        ("level_mark", f"INSERT INTO level_mark VALUES ('{LONG}', 'cube', 1, 1)"),
        ("progress", "INSERT INTO progress VALUES ('pack', 3, 99, 0, 99, 0)"),
        ("progress", "INSERT INTO progress VALUES (char(27) || '[2J', 0, 1, 0, 1, 0)"),
        ("episode_best", f"INSERT INTO episode_best VALUES ('{LONG}', 'circle', 99999, '')"),
        ("replay", "UPDATE replay SET kept = 1, final_tick = 2000000"),
        ("replay", "UPDATE replay SET kept = 1, outcome = 'won'"),
        ("replay", "UPDATE replay SET kept = 1, inputs = x'ff'"),
        ("replay", f"UPDATE replay SET kept = 1, level = '{LONG}'"),
        ("replay", "UPDATE replay SET kept = 1, gold = -1"),
    ],
)
def test_rows_that_no_game_writes_are_left_out(table: str, statement: str, tmp_path: Path) -> None:
    empty = player_data(tmp_path / "from")
    if table == "replay":
        keep_replay(empty, played(deadly_level()).replay("dead"))
    write_backup(empty, tmp_path / "all.zip")
    empty.close()
    here = player_data(tmp_path / "to")
    read_backup(here, with_records(tmp_path / "all.zip", statement))
    assert here.store.connection.execute(f"SELECT count(*) FROM {table}").fetchone() == (0,)


def autosave(path: Path, digest: str = "") -> str:
    return json.dumps({"path": str(path), "digest": digest, "level": ascii_text(ROOM)})


def test_a_level_under_edit_of_another_machine_has_no_file_here(tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("mine")
    backup = filled(tmp_path / "from")
    with ZipFile(backup, "a") as archive:
        for number, text in enumerate((autosave(victim), autosave(tmp_path / "new"), "no JSON", "[" * 9999, "[]")):
            archive.writestr(f"editing/{number}.json", text)
    here = player_data(tmp_path / "to")
    read_backup(here, backup.read_bytes())
    found = list(lost_drafts(tmp_path / "to"))
    assert [(each.draft, each.source.path) for each in found] == [(ROOM, None)] * 2
    assert read_backup(here, backup.read_bytes())[1] == "0 new files"


def test_an_own_level_under_edit_is_not_doubled_by_the_own_backup(tmp_path: Path) -> None:
    here = player_data(tmp_path)
    (tmp_path / "editing").mkdir()
    (tmp_path / "editing" / "a.json").write_text(autosave(tmp_path / "a.txt"))
    write_backup(here, tmp_path / "all.zip")
    assert read_backup(here, (tmp_path / "all.zip").read_bytes())[1] == "0 new files"


def test_the_commands_move_a_player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    filled(tmp_path / "from")
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "from"))
    assert CliRunner().invoke(cli, ["player", "export", str(tmp_path / "data.zip")]).exit_code == 0
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "to"))
    result = CliRunner().invoke(cli, ["player", "import", str(tmp_path / "data.zip")])
    assert (result.exit_code, result.output.splitlines()[0]) == (0, "6 new replays in the records")
