"""How a file of records is opened, checked and brought up to date (`docs/player-data.md`)."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

from ninja_game.player.store.migrations import MIGRATIONS, TABLES, VERSION

APPLICATION_ID = 0x6E696E6A
"""Tells our files from other people's SQLite files."""

OPENING_SECONDS = 1.0
"""How long a start waits for another program that has locked the file."""

MOST_CELL_BYTES = 2**26
"""Of a value, and of a row; SQLite itself makes values of a gigabyte where a file asks for it."""

_WRITE_VERSION = 18
"""Place of the byte in a file's header that is 1 or 2 where SQLite may write it."""


class NewerFileError(Exception):
    """The file was written by a newer game."""


def open_database(name: str, source: Path | None = None, seconds: float = OPENING_SECONDS) -> sqlite3.Connection:
    """A connection to a sound, up-to-date database; a new one where there is none.

    ``source``: copied into it first. ``seconds``: how long to wait for another program that has locked the file.

    Raises NewerFileError; sqlite3.OperationalError where the file cannot be used now (locked, read-only, no room);
    another sqlite3.DatabaseError where it is damaged or not ours.
    """
    connection = sqlite3.connect(name, timeout=seconds, isolation_level=None)
    try:
        connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, MOST_CELL_BYTES)
        # Text that is not UTF-8 is damage of one row, no reason to fail.
        connection.text_factory = _text
        if source is not None:
            _copy(source, connection)
        _check_file(connection, name)
        _check_tables(connection)
        if connection.execute("PRAGMA journal_mode").fetchone()[0] != "wal":
            connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA foreign_keys = ON")
        _migrate(connection)
    except UnicodeDecodeError:
        # What SQLite says about a damaged schema holds its bytes, and Python fails to make a text of them.
        connection.close()
        raise sqlite3.DatabaseError("its tables cannot be read") from None
    except BaseException:
        connection.close()
        raise
    return connection


def copy_in_memory(path: Path) -> sqlite3.Connection:
    """A database in memory with what a file holds that cannot be written; empty where it cannot be read either."""
    try:
        return open_database(":memory:", path)
    except (sqlite3.Error, NewerFileError):
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
        # Where its folder cannot be written either, SQLite reads only what it takes for unchangeable.
        with closing(sqlite3.connect(f"{uri}?immutable=1", uri=True)) as opened:
            opened.backup(connection)


def _text(data: bytes) -> str:
    return data.decode("utf-8", "replace")


def _check_file(connection: sqlite3.Connection, name: str) -> None:
    """Raise sqlite3.DatabaseError unless this is a sound file of ours or an empty one, NewerFileError for a newer.

    Raises sqlite3.OperationalError where it can be read only, or not now.
    """
    version = connection.execute("PRAGMA user_version").fetchone()[0]
    application = connection.execute("PRAGMA application_id").fetchone()[0]
    try:
        empty = not connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        # A file that can be read only is opened without a word, and refuses the first save.
        connection.execute("BEGIN IMMEDIATE")
        connection.execute(f"PRAGMA user_version = {version}")
        connection.execute("ROLLBACK")
    except sqlite3.OperationalError as error:
        if error.sqlite_errorcode == sqlite3.SQLITE_ERROR or _forbids_writing(name):
            raise sqlite3.DatabaseError(f"its header is wrong: {error}") from None
        raise
    if not empty and application != APPLICATION_ID:
        raise sqlite3.DatabaseError("not a file of this game")
    if version > VERSION:
        raise NewerFileError
    if connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
        raise sqlite3.DatabaseError("its pages contradict each other")


def _forbids_writing(name: str) -> bool:
    """Whether a database's own header says that it can be read only, as those of formats after ours would."""
    with Path(name).open("rb") as file:
        return file.read(_WRITE_VERSION + 1)[_WRITE_VERSION:] > b"\2"


def _migrate(connection: sqlite3.Connection) -> None:
    """Bring a file up to VERSION, in one transaction; a second process that does the same meanwhile waits."""
    if connection.execute("PRAGMA user_version").fetchone()[0] == VERSION:
        return
    connection.execute("BEGIN IMMEDIATE")
    try:
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        for script in MIGRATIONS[version:]:
            for statement in _statements(script):
                connection.execute(statement)
        connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        connection.execute(f"PRAGMA user_version = {VERSION}")
    except BaseException:
        connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def _statements(script: str) -> Iterator[str]:
    """The single statements of a script (``executescript`` would end the transaction)."""
    statement = ""
    for line in script.splitlines(keepends=True):
        statement += line
        if sqlite3.complete_statement(statement):
            yield statement
            statement = ""


def _check_tables(connection: sqlite3.Connection) -> None:
    """Raise sqlite3.DatabaseError where a table is missing, too many or other than in a sound file of its version."""
    version = connection.execute("PRAGMA user_version").fetchone()[0]
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as sound:
        for script in MIGRATIONS[:version]:
            for statement in _statements(script):
                sound.execute(statement)
        for table in sorted(TABLES):
            if _shape(connection, table) != _shape(sound, table):
                raise sqlite3.DatabaseError(f"the table {table} is not as it should be")


def _shape(connection: sqlite3.Connection, table: str) -> list[tuple[object, ...]]:
    """The columns of a table and what they refer to; empty where it is missing."""
    columns = connection.execute("SELECT * FROM pragma_table_info(?)", (table,))
    references = connection.execute("SELECT * FROM pragma_foreign_key_list(?)", (table,))
    return [*columns, *references]
