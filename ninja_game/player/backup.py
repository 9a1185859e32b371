"""All data of a player as one file, and back: a zip that the game in a window and the one in a page exchange.

Taking one in merges it: a best is replaced only by a better one, progress only moves forward, of two counts the larger
stays, and no file of the player's is overwritten. So it may be taken in twice.
"""

from __future__ import annotations

import io
import re
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ninja_game.errors import FileError
from ninja_game.files.reading import files_in, read_bytes
from ninja_game.files.user_folder import EXPORTS, LEVELS, RECORDS, REPLAYS, SETTINGS, quarantine
from ninja_game.files.writing import write_atomically
from ninja_game.files.zips import open_zip, unpacked
from ninja_game.player.player_data import PlayerData
from ninja_game.player.records import Records
from ninja_game.player.store import Store
from ninja_game.sim.memory.interface import BODIES

MOST_FILES, MOST_BYTES = 4096, 256 * 2**20
"""Of a backup: files, and bytes when they are unpacked."""

FOLDERS = (LEVELS, REPLAYS, EXPORTS, "editing")
"""What of the player's folder goes along, besides the settings and the records."""

_SAFE = re.compile(r"[^\x00-\x1f/\\:*?\"<>|.][^\x00-\x1f/\\:*?\"<>|]{0,199}")
"""Names that are plain files on every system; hidden ones are not."""

_COUNTS = (
    ("played", ("level",), ("attempts", "passes", "deaths", "ticks", "gold"), "max"),
    ("death", ("killer",), ("times",), "max"),
    ("level_mark", ("level", "body"), ("most_gold",), "max"),
    ("level_mark", ("level", "body"), ("fastest",), "min"),
)
"""Tables whose rows are joined by number: keys, columns, and which of two numbers stays."""


def write_backup(player: PlayerData, path: Path) -> None:
    """Write everything of a player's into a zip. Raises FileError, OSError, sqlite3.Error."""
    player.store.flush()
    with TemporaryDirectory() as scratch:
        copy = Path(scratch) / RECORDS
        with closing(sqlite3.connect(copy)) as target:
            player.store.connection.backup(target)
        packed = io.BytesIO()
        with ZipFile(packed, "w", ZIP_DEFLATED) as archive:
            archive.writestr(ZipInfo(RECORDS), copy.read_bytes(), ZIP_DEFLATED)
            for name in _own_files(player.folder):
                if player.folder / name != path:
                    archive.writestr(ZipInfo(name), read_bytes(player.folder / name), ZIP_DEFLATED)
    write_atomically(path, packed.getvalue())


def _own_files(folder: Path) -> Iterator[str]:
    """The names of the files that go along, but the records."""
    yield from (name for name in files_in(folder) if name == SETTINGS)
    for part in FOLDERS:
        yield from (f"{part}/{name}" for name in files_in(folder / part) if _SAFE.fullmatch(name))


def read_backup(player: PlayerData, data: bytes) -> list[str]:
    """Take a backup in; what came of it, in words. The settings count from the next start on.

    Raises FileError for what is no backup: then nothing has changed. OSError, sqlite3.Error.
    """
    files = _unpacked(data)
    with TemporaryDirectory() as scratch:
        path = Path(scratch) / RECORDS
        path.write_bytes(files.pop(RECORDS))
        store = Store(path)
        try:
            if store.messages:
                raise FileError("this is no backup of a player's data", found=" ".join(store.messages))
            replays = _merge(player, store)
        finally:
            store.connection.close()
    taken = [name for name, content in files.items() if _taken(player.folder, name, content)]
    return [f"{replays} new replays in the records", f"{len(taken)} new files", *taken]


def _unpacked(data: bytes) -> dict[str, bytes]:
    """The files of a backup that belong into a player's folder, by name. Raises FileError."""
    try:
        archive = open_zip(io.BytesIO(data), most_files=MOST_FILES, most_bytes=MOST_BYTES)
        files = {entry.filename: unpacked(archive, entry) for entry in archive.infolist() if _belongs(entry.filename)}
    except ValueError as error:
        raise FileError("this is no backup of a player's data", found=str(error)) from None
    if RECORDS not in files:
        raise FileError("this is no backup of a player's data", expected=f"a zip with {RECORDS} in it")
    return files


def _belongs(name: str) -> bool:
    folder, _, file = name.rpartition("/")
    return name in {SETTINGS, RECORDS} or (folder in FOLDERS and _SAFE.fullmatch(file) is not None)


def _taken(folder: Path, name: str, content: bytes) -> bool:
    """Put a file into the player's folder, beside any other of its name; whether it was not there yet."""
    path = folder / name
    if path.exists() and read_bytes(path) == content:
        return False
    if name == SETTINGS and path.exists():
        quarantine(path, "before")
    number = 2
    while path.exists():
        path = folder / PurePosixPath(name).with_stem(f"{PurePosixPath(name).stem}-{number}")
        if path.exists() and read_bytes(path) == content:
            return False
        number += 1
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, content)
    return True


def _merge(player: PlayerData, store: Store) -> int:
    """Join other records into the player's, in one transaction; how many more replays there are now."""
    theirs = Records(store)
    with player.store.change() as db:
        before = _count(db)
        for row in store.rows("SELECT id FROM replay WHERE kept", (), (int,)):
            if replay := theirs.replay(row[0]):
                player.records.keep_replay(replay)
        for body in BODIES:
            for best in theirs.level_bests(body).values():
                if replay := theirs.replay(best.id):
                    player.records.level_passed(replay)
        _merge_episodes(player.records, theirs)
        for table, keys, columns, chosen in _COUNTS:
            _merge_numbers(db, store, table, keys, columns, chosen)
        _merge_progress(db, store)
        return _count(db) - before


def _count(db: sqlite3.Connection) -> int:
    count: int = db.execute("SELECT count(*) FROM replay").fetchone()[0]
    return count


def _merge_episodes(mine: Records, theirs: Records) -> None:
    rows = theirs.store.rows("SELECT episode, body, score FROM episode_best", (), (str, str, int))
    for episode, body, score in rows:
        best = theirs.episode_best(episode, body)
        replays = [theirs.replay(number) for number in best.replays] if best else []
        whole = [replay for replay in replays if replay is not None]
        if whole and len(whole) == len(replays):
            mine.episode_passed(episode, score, whole)


def _merge_numbers(
    db: sqlite3.Connection, store: Store, table: str, keys: tuple[str, ...], columns: tuple[str, ...], chosen: str
) -> None:
    names = [name for _, name, *_ in store.connection.execute(f"PRAGMA table_info({table})")]
    kinds = [str if name in {"level", "body", "killer"} else int for name in names]
    joined = ", ".join(f"{name} = {chosen}({table}.{name}, excluded.{name})" for name in columns)
    db.executemany(
        f"INSERT INTO {table} ({', '.join(names)}) VALUES ({', '.join('?' * len(names))}) "
        f"ON CONFLICT ({', '.join(keys)}) DO UPDATE SET {joined}",
        store.rows(f"SELECT {', '.join(names)} FROM {table}", (), kinds),
    )


def _merge_progress(db: sqlite3.Connection, store: Store) -> None:
    """The farther of two places, both for what was reached and for what was reached without help."""
    query = "SELECT pack, grid_column, reached_episode, reached_level, beaten_episode, beaten_level FROM progress"
    mine = {row[:2]: row[2:] for row in db.execute(query)}
    for row in store.rows(query, (), (str, *[int] * 5)):
        here = mine.get(row[:2], row[2:])
        merged = max(row[2:4], here[:2]) + max(row[4:], here[2:])
        db.execute("REPLACE INTO progress VALUES (?, ?, ?, ?, ?, ?)", (*row[:2], *merged))
