"""The database of records: atomic transactions, and the handling of its failures.

Write-ahead log with full synchronisation: a transaction that has returned is on the disk, and the game shows "saved"
only after that. A process killed in between loses only its own transaction. Failed saves are kept and tried again with
every later save, and once more at the end.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from ninja_game.files.locking import locked
from ninja_game.files.user_folder import quarantine
from ninja_game.player.schema import OPENING_SECONDS, OtherVersionError, copy_in_memory, open_database

GAME_WAIT_MS = 200  # longest wait during play for another program that writes: it holds up the picture
LAST_WAIT_MS = 3000  # longest wait at the end of the game

STARTS_WAIT = 20.0  # seconds that a start waits for other games that are opening the same file

StoreWork = Callable[[], Sequence[str]]
"""Changes within one transaction; gives notices for the player. It may be called more than once."""


class Store:
    """An open database. ``path``: None for one in memory, which forgets, for a reason in ``problem`` if there is one.

    A damaged file, or one of another version, is moved aside and a new one begun. If the file cannot be opened or
    written, the session continues with a copy in memory, and ``problem`` says why nothing would be saved. ``messages``:
    for the player. ``epoch`` changes whenever earlier results may be out of date.
    """

    def __init__(self, path: Path | None, problem: str = "") -> None:
        self.path = path
        self.messages: list[str] = []
        self.problem = problem
        self.epoch = 0
        self._pending: list[StoreWork] = []
        self.connection = self._first_connection()

    def _first_connection(self) -> sqlite3.Connection:
        if self.path is None:
            return open_database(":memory:")
        try:
            return self._open(self.path, STARTS_WAIT, OPENING_SECONDS)
        except (sqlite3.Error, OtherVersionError, OSError) as error:
            self.problem = f"the records cannot be opened ({_reason(error)})"
            self.report(f"{self.problem[0].upper()}{self.problem[1:]}; until they can, they are kept in memory only.")
            return copy_in_memory(self.path)

    def _open(self, path: Path, turn: float, wait: float) -> sqlite3.Connection:
        """The file, or a new one if it had to be moved aside. Raises sqlite3.Error, OtherVersionError, OSError.

        ``turn`` and ``wait``: seconds to wait for others that are opening it, and for one that has locked it.
        """
        path.parent.mkdir(parents=True, exist_ok=True)
        with locked(path, turn):
            try:
                connection = open_database(str(path), seconds=wait)
            except OtherVersionError as error:
                self._move_aside(path, error.age, f"The records were {error}")
                connection = open_database(str(path))
            except sqlite3.OperationalError:
                # Locked, read-only, no room: the file itself is sound.
                raise
            except sqlite3.DatabaseError as error:
                self._move_aside(path, "damaged", f"The records are damaged ({error})")
                connection = open_database(str(path))
        connection.execute(f"PRAGMA busy_timeout = {GAME_WAIT_MS}")
        return connection

    def _move_aside(self, path: Path, why: str, text: str) -> None:
        self.report(f"{text}. They are kept as {quarantine(path, why).name}; new ones are begun.")

    def _reopen(self) -> None:
        """Try once more to open the file; changes made in memory until now wait in ``_pending``."""
        if not self.problem or self.path is None:
            return
        try:
            connection = self._open(self.path, GAME_WAIT_MS / 1000, GAME_WAIT_MS / 1000)
        except (sqlite3.Error, OtherVersionError, OSError) as error:
            self.problem = f"the records cannot be opened ({_reason(error)})"
            return
        self.connection.close()
        self.connection, self.problem = connection, ""
        self.epoch += 1

    def rows(self, query: str, values: Sequence[object], kinds: Sequence[type]) -> list[tuple[Any, ...]]:
        """The rows of a query whose values are of these ``kinds``; damaged rows are skipped and reported.

        A file that cannot be read has no rows, and is reported; within a transaction this raises sqlite3.Error.
        """
        try:
            raw = self.connection.execute(query, values).fetchall()
        except sqlite3.Error as error:
            if self.connection.in_transaction:
                raise
            self.report(f"The records cannot be read ({error}).")
            return []
        sound = [row for row in raw if [type(value) for value in row] == list(kinds)]
        if len(sound) < len(raw):
            self.report("Some of the records are damaged; they are left out.")
        return sound

    def report(self, message: str) -> None:
        """Note a message for the player, once."""
        if message not in self.messages:
            self.messages.append(message)

    @contextmanager
    def change(self) -> Iterator[sqlite3.Connection]:
        """A transaction: after the block all of it is on the disk, or nothing.

        Within another one it is part of that. Raises sqlite3.Error.
        """
        if self.connection.in_transaction:
            yield self.connection
            return
        self.connection.execute("BEGIN IMMEDIATE")
        self.epoch += 1
        try:
            yield self.connection
            self.connection.execute("COMMIT")
        except BaseException:
            # Some errors, as a full disk, have ended the transaction already.
            with suppress(sqlite3.Error):
                self.connection.execute("ROLLBACK")
            raise
        finally:
            self.epoch += 1

    def save(self, work: StoreWork) -> tuple[Sequence[str], str]:
        """Do ``work`` in a transaction, after all earlier failed saves.

        Gives its notices and ''; or why it is not on the disk: it is then tried again with the next save.
        """
        self._reopen()
        self._pending.append(work)
        if not self.problem:
            return self._save_pending()
        try:
            with self.change():
                return work(), self.problem
        except sqlite3.Error:
            return [], self.problem

    def defer(self, work: StoreWork) -> None:
        """Do ``work`` with the next save or ``flush``, for changes that may reach the disk later."""
        self._pending.append(work)

    def flush(self) -> None:
        if self._pending:
            self._reopen()
            if not self.problem:
                self._save_pending()

    def _save_pending(self) -> tuple[Sequence[str], str]:
        """Make the changes that wait; the notices of the last one, and why it could not be made, or ""."""
        notices: Sequence[str] = []
        problem = ""
        while self._pending:
            try:
                with self.change():
                    notices, problem = self._pending[0](), ""
            except sqlite3.OperationalError as error:
                # Locked or full: the waiting changes stay.
                return [], str(error)
            except sqlite3.Error as error:
                notices, problem = [], str(error)
            del self._pending[0]
        return notices, problem

    def close(self) -> None:
        if self._pending:
            self.connection.execute(f"PRAGMA busy_timeout = {LAST_WAIT_MS}")
            self.flush()
        self.connection.close()


def _reason(error: Exception) -> str:
    if isinstance(error, OtherVersionError):
        return f"they were {error}"
    return (error.strerror if isinstance(error, OSError) else None) or str(error)
