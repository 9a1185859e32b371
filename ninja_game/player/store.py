"""The database of what was played: opened, brought up to date, set aside when it cannot be used.

Write-ahead log with full synchronisation: a transaction that has returned is on the disk, and the game tells the
player that something is saved only after that. A process killed in between loses the transaction it was in, no other.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ninja_game.files.user_folder import quarantine

APPLICATION_ID = 0x6E696E6A
"""Tells our files from other people's SQLite files."""

MIGRATIONS = (
    """
    CREATE TABLE replay (
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
        kept INTEGER NOT NULL         -- the player asked for it
    );
    CREATE VIEW saved_replay AS
        SELECT id, level, name, player, body, outcome, final_tick, gold, score, made_at, kept FROM replay;
    CREATE TABLE level_best (
        level TEXT NOT NULL, body TEXT NOT NULL,
        replay INTEGER NOT NULL REFERENCES replay (id),
        PRIMARY KEY (level, body)
    ) WITHOUT ROWID;
    CREATE TABLE episode_best (
        episode TEXT NOT NULL,        -- digest of its levels
        body TEXT NOT NULL,
        score INTEGER NOT NULL,
        replays TEXT NOT NULL,        -- ids with blanks between, in the order of its levels
        made_at TEXT NOT NULL,
        PRIMARY KEY (episode, body)
    ) WITHOUT ROWID;
    CREATE TABLE progress (
        grid_column INTEGER PRIMARY KEY,
        reached_episode INTEGER NOT NULL, reached_level INTEGER NOT NULL,
        beaten_episode INTEGER NOT NULL, beaten_level INTEGER NOT NULL
    );
    CREATE TABLE death (killer TEXT PRIMARY KEY, times INTEGER NOT NULL) WITHOUT ROWID;
    """,
    """
    CREATE TABLE played (
        level TEXT PRIMARY KEY,
        attempts INTEGER NOT NULL, passes INTEGER NOT NULL, deaths INTEGER NOT NULL,
        ticks INTEGER NOT NULL, gold INTEGER NOT NULL
    ) WITHOUT ROWID;
    CREATE TABLE fact (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
    """,
    # The digest of a replay became one of what the world shows; the older ones mean nothing any more.
    "UPDATE replay SET digest = '';",
)
"""Each brings a file from the version of its index to the next; they are never edited once released."""

VERSION = len(MIGRATIONS)


class NewerFileError(Exception):
    """The file was written by a newer game."""


class Store:
    """An open database. ``messages``: what the player should know about its opening; ``path``: None in memory."""

    def __init__(self, connection: sqlite3.Connection, path: Path | None, messages: list[str]) -> None:
        self.connection = connection
        self.path = path
        self.messages = messages

    @contextmanager
    def change(self) -> Iterator[sqlite3.Connection]:
        """One transaction: all of it is on the disk when the block has been left, or nothing of it is.

        Within another one it is part of that.
        """
        if self.connection.in_transaction:
            yield self.connection
            return
        self.connection.execute("BEGIN IMMEDIATE")
        try:
            yield self.connection
        except BaseException:
            self.connection.execute("ROLLBACK")
            raise
        self.connection.execute("COMMIT")

    def close(self) -> None:
        """Close the file. What was changed has long been saved."""
        self.connection.close()


def open_store(path: Path | None) -> Store:
    """The database at ``path``, made or migrated as needed; None: one in memory, which forgets.

    A damaged file or one from a newer game is set aside and a new one begun; if the place cannot be written, the
    records live in memory. Either way the game goes on and ``messages`` says what happened.
    """
    messages: list[str] = []
    if path is None:
        return Store(_opened(":memory:"), None, messages)
    for _ in range(2):
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            return Store(_opened(str(path)), path, messages)
        except NewerFileError:
            why, text = "newer", "The records were written by a newer game"
        except sqlite3.OperationalError as error:
            # Locked, read-only, no room: the file itself is sound.
            messages.append(f"The records cannot be opened ({error}); this session's records will be lost.")
            break
        except sqlite3.DatabaseError as error:
            why, text = "damaged", f"The records are damaged ({error})"
        except OSError as error:
            messages.append(f"There is no place for records ({error.strerror}); this session's records will be lost.")
            break
        try:
            messages.append(f"{text}. They are kept as {quarantine(path, why).name}; new ones are begun.")
        except OSError as error:
            messages.append(f"{text} and cannot be moved ({error.strerror}); this session's records will be lost.")
            break
    return Store(_opened(":memory:"), None, messages)


def _opened(name: str) -> sqlite3.Connection:
    """A connection to a sound, up-to-date database. Raises sqlite3.DatabaseError or NewerFileError."""
    connection = sqlite3.connect(name, timeout=5.0, isolation_level=None)
    try:
        _check_file(connection)
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA foreign_keys = ON")
        _migrate(connection)
        _check_tables(connection)
    except BaseException:
        connection.close()
        raise
    return connection


def _check_file(connection: sqlite3.Connection) -> None:
    """Raise sqlite3.DatabaseError unless this is a sound file of ours or an empty one, NewerFileError for a newer."""
    version = connection.execute("PRAGMA user_version").fetchone()[0]
    application = connection.execute("PRAGMA application_id").fetchone()[0]
    empty = not connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
    if not empty and application != APPLICATION_ID:
        raise sqlite3.DatabaseError("not a file of this game")
    if version > VERSION:
        raise NewerFileError
    if connection.execute("PRAGMA quick_check(1)").fetchone()[0] != "ok":
        raise sqlite3.DatabaseError("its pages contradict each other")


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


TABLES = {"replay", "level_best", "episode_best", "progress", "death", "played", "fact"}


def _check_tables(connection: sqlite3.Connection) -> None:
    """Raise sqlite3.DatabaseError where a table is missing."""
    found = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    if not found >= TABLES:
        raise sqlite3.DatabaseError(f"without the table {min(TABLES - found)}")
