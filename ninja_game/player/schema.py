"""The tables of the records, and how their file is opened and checked (`docs/player-data.md`)."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from itertools import count
from pathlib import Path
from urllib.parse import quote

APPLICATION_ID = 0x6E696E6A  # distinguishes our files from other SQLite files

OPENING_SECONDS = 1.0  # longest wait of a start for another program that has locked the file

MAX_CELL_BYTES = 2**26  # the largest value, and row; SQLite itself makes values of a gigabyte if a file asks for it

MAX_STEPS = 30  # millions of instructions of SQLite to check a file: some four seconds; the records of years take one

_WRITE_VERSION = 18  # place of a byte in the file's header: 1 or 2 if SQLite may write it


SCHEMA_VERSION = 7  # the version of the tables, in a file's header; raise it with every change of them

_TABLES = {
    "replay": """(
        id INTEGER PRIMARY KEY,
        level TEXT NOT NULL,          -- digest of the level
        level_text TEXT NOT NULL,     -- the level itself, exact
        name TEXT NOT NULL,
        player TEXT NOT NULL,
        body TEXT NOT NULL,
        outcome TEXT NOT NULL,
        final_tick INTEGER NOT NULL,
        gold INTEGER NOT NULL,
        score INTEGER NOT NULL,       -- ticks
        digest TEXT NOT NULL,         -- of the world after the final tick
        inputs BLOB NOT NULL,         -- one byte a tick
        made_at TEXT NOT NULL,        -- UTC, ISO 8601
        kept INTEGER NOT NULL,        -- the player asked for it
        made TEXT NOT NULL,           -- how, as in a replay text
        co_authors TEXT NOT NULL
    )""",
    "level_best": """(
        level TEXT NOT NULL, body TEXT NOT NULL,
        replay INTEGER NOT NULL REFERENCES replay (id),
        PRIMARY KEY (level, body)
    ) WITHOUT ROWID""",
    "death": "(killer TEXT PRIMARY KEY, times INTEGER NOT NULL) WITHOUT ROWID",
    "played": """(
        level TEXT PRIMARY KEY,
        attempts INTEGER NOT NULL, passes INTEGER NOT NULL, deaths INTEGER NOT NULL,
        ticks INTEGER NOT NULL, gold INTEGER NOT NULL
    ) WITHOUT ROWID""",
    "fact": "(name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
    "episode_replay": """(
        episode TEXT NOT NULL, body TEXT NOT NULL,
        place INTEGER NOT NULL,       -- of its level in the episode, from 0
        replay INTEGER NOT NULL REFERENCES replay (id),
        PRIMARY KEY (episode, body, place)
    ) WITHOUT ROWID""",
    "episode_best": """(
        episode TEXT NOT NULL,        -- digest of its levels
        body TEXT NOT NULL,
        score INTEGER NOT NULL,
        made_at TEXT NOT NULL,
        PRIMARY KEY (episode, body)
    ) WITHOUT ROWID""",
    "level_mark": """(
        level TEXT NOT NULL, body TEXT NOT NULL,
        fastest INTEGER NOT NULL,     -- tick of the earliest exit contact
        most_gold INTEGER NOT NULL,   -- pieces in the passed run that took the most
        PRIMARY KEY (level, body)
    ) WITHOUT ROWID""",
    "progress": """(
        pack TEXT NOT NULL,           -- its name; '' for the game's own
        grid_column INTEGER NOT NULL,
        reached_episode INTEGER NOT NULL, reached_level INTEGER NOT NULL,
        beaten_episode INTEGER NOT NULL, beaten_level INTEGER NOT NULL,
        PRIMARY KEY (pack, grid_column)
    ) WITHOUT ROWID""",
}

SCHEMA = {name: f"CREATE TABLE {name} {columns}" for name, columns in _TABLES.items()}
"""A backup's tables are compared with these to the letter: in a file of this version they are written exactly so."""


class OtherVersionError(Exception):
    """The file was written by a newer game, or by one from before the first release. ``age``: "newer" or "older"."""

    def __init__(self, version: int) -> None:
        self.age = "newer" if version > SCHEMA_VERSION else "older"
        super().__init__(f"written by a game that is {self.age}: version {version} instead of {SCHEMA_VERSION}")


def open_database(name: str, source: Path | None = None, seconds: float = OPENING_SECONDS) -> sqlite3.Connection:
    """A connection to a sound, up-to-date database, which is made if it is missing.

    ``source``: copied into it first. ``seconds``: how long to wait for another program that has locked the file.

    Raises OtherVersionError; sqlite3.OperationalError if the file cannot be used now (locked, read-only, no room);
    another sqlite3.DatabaseError if it is damaged or not ours.
    """
    connection = sqlite3.connect(name, timeout=seconds, isolation_level=None)
    try:
        connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, MAX_CELL_BYTES)
        # Text that is not UTF-8 damages one row only: do not fail.
        connection.text_factory = _text
        if source is not None:
            _copy(source, connection)
        with bound_queries(connection):
            _check_file(connection, name)
            _check_tables(connection)
        if connection.execute("PRAGMA journal_mode").fetchone()[0] != "wal":
            connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA foreign_keys = ON")
        if connection.execute("PRAGMA user_version").fetchone()[0] != SCHEMA_VERSION:
            _create(connection)
    except UnicodeDecodeError:
        # SQLite's message about a damaged schema contains its bytes, which Python cannot decode.
        connection.close()
        raise sqlite3.DatabaseError("its tables cannot be read") from None
    except BaseException:
        connection.close()
        raise
    return connection


@contextmanager
def bound_queries(connection: sqlite3.Connection) -> Iterator[None]:
    """Bound the work of queries on a file, whatever its pages say. Raises sqlite3.DatabaseError beyond the bound."""
    steps = count(1)
    connection.set_progress_handler(lambda: next(steps) > MAX_STEPS, 1_000_000)
    try:
        yield
    except sqlite3.OperationalError as error:
        if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_INTERRUPT:
            raise sqlite3.DatabaseError("its pages lead in circles") from None
        raise
    finally:
        connection.set_progress_handler(None, 0)


def copy_in_memory(path: Path) -> sqlite3.Connection:
    """A database in memory with the content of a file that cannot be written; empty if it cannot be read either."""
    try:
        return open_database(":memory:", path)
    except (sqlite3.Error, OtherVersionError):
        return open_database(":memory:")


def _copy(source: Path, connection: sqlite3.Connection) -> None:
    uri = f"file:{quote(str(source.absolute()), errors='surrogateescape')}"
    try:
        with closing(sqlite3.connect(f"{uri}?mode=ro", timeout=OPENING_SECONDS, uri=True)) as opened:
            # A backup waits for a lock without end; a transaction that has begun to read has it, or fails.
            opened.execute("BEGIN")
            opened.execute("SELECT count(*) FROM sqlite_master").fetchone()
            opened.backup(connection)
    except sqlite3.OperationalError:
        # If its folder cannot be written either, SQLite reads only files declared immutable.
        with closing(sqlite3.connect(f"{uri}?immutable=1", uri=True)) as opened:
            opened.backup(connection)


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")


def _check_file(connection: sqlite3.Connection, name: str) -> None:
    """Raise sqlite3.DatabaseError unless this is a sound file of ours or an empty one.

    Raises OtherVersionError for another version; sqlite3.OperationalError if it is read-only, or locked.
    """
    version = connection.execute("PRAGMA user_version").fetchone()[0]
    application = connection.execute("PRAGMA application_id").fetchone()[0]
    try:
        empty = not connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        # A read-only file opens without an error, and fails at the first save.
        connection.execute("BEGIN IMMEDIATE")
        connection.execute(f"PRAGMA user_version = {version}")
        connection.execute("ROLLBACK")
    except sqlite3.OperationalError as error:
        if error.sqlite_errorcode == sqlite3.SQLITE_ERROR or _forbids_writing(name):
            raise sqlite3.DatabaseError(f"its header is wrong: {error}") from None
        raise
    if not empty and application != APPLICATION_ID:
        raise sqlite3.DatabaseError("not a file of this game")
    if version not in {0, SCHEMA_VERSION}:
        raise OtherVersionError(version)
    if connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
        raise sqlite3.DatabaseError("its pages contradict each other")


def _forbids_writing(name: str) -> bool:
    """Whether a database's own header makes it read-only, as those of later formats would."""
    with Path(name).open("rb") as file:
        return file.read(_WRITE_VERSION + 1)[_WRITE_VERSION:] > b"\2"


def _create(connection: sqlite3.Connection) -> None:
    """Make the tables of a new file, in one transaction; a second process with the same aim waits."""
    connection.execute("BEGIN IMMEDIATE")
    try:
        if connection.execute("PRAGMA user_version").fetchone()[0] != SCHEMA_VERSION:
            for statement in SCHEMA.values():
                connection.execute(statement)
            connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
            connection.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
    except BaseException:
        connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def _check_tables(connection: sqlite3.Connection) -> None:
    """Raise sqlite3.DatabaseError if a table is missing, surplus or other than in a sound file of its version."""
    version = connection.execute("PRAGMA user_version").fetchone()[0]
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as sound:
        for statement in SCHEMA.values() if version else ():
            sound.execute(statement)
        for table in sorted(SCHEMA):
            if _shape(connection, table) != _shape(sound, table):
                raise sqlite3.DatabaseError(f"the table {table} is not as it should be")


def _shape(connection: sqlite3.Connection, table: str) -> list[tuple[object, ...]]:
    columns = connection.execute("SELECT * FROM pragma_table_info(?)", (table,))
    references = connection.execute("SELECT * FROM pragma_foreign_key_list(?)", (table,))
    return [*columns, *references]
