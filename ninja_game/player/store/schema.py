"""The tables of the records, and how a file is opened, checked and brought up to date (`docs/player-data.md`)."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

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
    # An episode's replays get a table of their own; replays say whether they were made in practice.
    """
    ALTER TABLE replay ADD COLUMN practice INTEGER NOT NULL DEFAULT 0;
    CREATE TABLE episode_replay (
        episode TEXT NOT NULL, body TEXT NOT NULL,
        place INTEGER NOT NULL,       -- of its level in the episode, from 0
        replay INTEGER NOT NULL REFERENCES replay (id),
        PRIMARY KEY (episode, body, place)
    ) WITHOUT ROWID;
    INSERT INTO episode_replay (episode, body, place, replay)
        SELECT best.episode, best.body, id.key, replay.id
        FROM (SELECT episode, body, '[' || replace(trim(replays), ' ', ',') || ']' AS ids FROM episode_best) AS best
        JOIN json_each(CASE WHEN json_valid(best.ids) THEN best.ids ELSE '[]' END) AS id
        JOIN replay ON replay.id = id.value;
    CREATE TABLE new_best (
        episode TEXT NOT NULL,        -- digest of its levels
        body TEXT NOT NULL,
        score INTEGER NOT NULL,
        made_at TEXT NOT NULL,
        PRIMARY KEY (episode, body)
    ) WITHOUT ROWID;
    INSERT INTO new_best (episode, body, score, made_at) SELECT episode, body, score, made_at FROM episode_best;
    DROP TABLE episode_best;
    ALTER TABLE new_best RENAME TO episode_best;
    DROP VIEW saved_replay;
    """,
    # The fastest and the richest run of each level, from the runs that are here; progress in other packs.
    """
    CREATE TABLE level_mark (
        level TEXT NOT NULL, body TEXT NOT NULL,
        fastest INTEGER NOT NULL,     -- tick of the earliest exit contact
        most_gold INTEGER NOT NULL,   -- pieces in the passed run that took the most
        PRIMARY KEY (level, body)
    ) WITHOUT ROWID;
    INSERT INTO level_mark (level, body, fastest, most_gold)
        SELECT level, body, min(final_tick), max(gold) FROM replay
        WHERE outcome = 'exit' AND practice = 0 GROUP BY level, body;
    CREATE TABLE new_progress (
        pack TEXT NOT NULL,           -- its name; '' for the game's own
        grid_column INTEGER NOT NULL,
        reached_episode INTEGER NOT NULL, reached_level INTEGER NOT NULL,
        beaten_episode INTEGER NOT NULL, beaten_level INTEGER NOT NULL,
        PRIMARY KEY (pack, grid_column)
    ) WITHOUT ROWID;
    INSERT INTO new_progress SELECT '', grid_column, reached_episode, reached_level, beaten_episode, beaten_level
        FROM progress;
    DROP TABLE progress;
    ALTER TABLE new_progress RENAME TO progress;
    """,
)
"""Each brings a file from the version of its index to the next; they are never edited once released."""

VERSION = len(MIGRATIONS)


TABLES = {"replay", "level_best", "level_mark", "episode_best", "episode_replay", "progress", "death", "played", "fact"}

OPENING_SECONDS = 1.0
"""How long a start waits for another program that has locked the file."""


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
        # Text that is no UTF-8 is damage of one row, no reason to fail.
        connection.text_factory = _text
        if source is not None:
            _copy(source, connection)
        _check_file(connection)
        if connection.execute("PRAGMA journal_mode").fetchone()[0] != "wal":
            connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA foreign_keys = ON")
        _migrate(connection)
        _check_tables(connection)
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


def _check_tables(connection: sqlite3.Connection) -> None:
    """Raise sqlite3.DatabaseError where a table is missing."""
    found = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    if not found >= TABLES:
        raise sqlite3.DatabaseError(f"without the table {min(TABLES - found)}")
