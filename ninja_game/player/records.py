"""Personal bests and replays (game.md §2.1). Keys are digests of levels, so that a changed level starts afresh."""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.player.scoring import level_score
from ninja_game.player.store import Store
from ninja_game.sim.level import Level

NEWEST_SHOWN = 500
"""Replays listed at most, the newest first."""


@dataclass(frozen=True)
class SavedReplay:
    """A replay in the records, without its inputs: ``score`` in ticks (0 unless passed), ``made_at`` in UTC.

    ``kept``: 1 if the player asked for it, else 0.
    """

    id: int
    level: str
    name: str
    player: str
    body: str
    outcome: str
    final_tick: int
    gold: int
    score: int
    made_at: str
    kept: int


@dataclass(frozen=True)
class EpisodeBest:
    """An episode's best: score in ticks, and the ids of its replays in the order of the levels."""

    score: int
    replays: tuple[int, ...]
    made_at: str


def now_text() -> str:
    """The time, UTC, as the records have it."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def episode_key(levels: Iterable[Level]) -> str:
    """What an episode is known by: a digest of its levels in their order."""
    return hashlib.sha256(" ".join(level_digest(level) for level in levels).encode()).hexdigest()


class Records:
    """Personal bests and replays in a store. Every method that changes something returns when it is on the disk."""

    def __init__(self, store: Store) -> None:
        self.store = store

    # --- replays ---

    def keep_replay(self, replay: Replay) -> int:
        """Save a replay because the player asked for it; its id."""
        with self.store.change() as db:
            return _insert(db, replay, kept=True)

    def replays(self) -> list[SavedReplay]:
        """The replays, newest first."""
        rows = self.store.connection.execute(
            "SELECT * FROM saved_replay ORDER BY made_at DESC, id DESC LIMIT ?", (NEWEST_SHOWN,)
        )
        return [SavedReplay(*row) for row in rows]

    def replay(self, number: int) -> Replay | None:
        """A whole replay by its id, with its level inside; None if it has gone."""
        row = self.store.connection.execute(
            "SELECT inputs, final_tick, outcome, gold, digest, name, player, body, level, level_text"
            " FROM replay WHERE id = ?",
            (number,),
        ).fetchone()
        if row is None:
            return None
        inputs, final_tick, outcome, gold, digest, name, player, body, level, text = row
        return Replay(
            inputs=inputs, final_tick=final_tick, outcome=outcome, gold=gold, digest=digest, name=name, author=player,
            body=body, level_digest=level, level=parse_level_string(text),
        )  # fmt: skip

    def forget_replay(self, number: int) -> bool:
        """Remove a replay unless a personal best needs it; whether it has gone."""
        with self.store.change() as db:
            if number in _needed(db):
                db.execute("UPDATE replay SET kept = 0 WHERE id = ?", (number,))
                return False
            return db.execute("DELETE FROM replay WHERE id = ?", (number,)).rowcount > 0

    # --- levels ---

    def level_best(self, digest: str, body: str = "circle") -> SavedReplay | None:
        """The personal best of a level, by the level's digest."""
        row = self.store.connection.execute(
            "SELECT * FROM saved_replay WHERE id = (SELECT replay FROM level_best WHERE level = ? AND body = ?)",
            (digest, body),
        ).fetchone()
        return SavedReplay(*row) if row else None

    def level_bests(self, body: str = "circle") -> dict[str, SavedReplay]:
        """All personal bests by level digest."""
        rows = self.store.connection.execute(
            "SELECT * FROM saved_replay WHERE id IN (SELECT replay FROM level_best WHERE body = ?)", (body,)
        )
        return {saved.level: saved for saved in (SavedReplay(*row) for row in rows)}

    def level_passed(self, replay: Replay) -> bool:
        """Save a passed level's replay if it is better than the best so far; whether it is."""
        with self.store.change() as db:
            return _save_level_best(db, replay)

    # --- episodes ---

    def episode_best(self, key: str, body: str = "circle") -> EpisodeBest | None:
        """The personal best of an episode, by its key."""
        row = self.store.connection.execute(
            "SELECT score, replays, made_at FROM episode_best WHERE episode = ? AND body = ?", (key, body)
        ).fetchone()
        return EpisodeBest(row[0], tuple(map(int, row[1].split())), row[2]) if row else None

    def episode_passed(self, key: str, score: int, replays: Sequence[Replay]) -> bool:
        """Save an episode's score (ticks) and replays if it is better than the best so far; whether it is."""
        body = replays[0].body
        with self.store.change() as db:
            row = db.execute("SELECT score FROM episode_best WHERE episode = ? AND body = ?", (key, body)).fetchone()
            if row and row[0] >= score:
                return False
            ids = " ".join(str(_insert(db, replay, kept=False)) for replay in replays)
            db.execute("REPLACE INTO episode_best VALUES (?, ?, ?, ?, ?)", (key, body, score, ids, now_text()))
            _drop_unneeded(db)
        return True


def _save_level_best(db: sqlite3.Connection, replay: Replay) -> bool:
    score = level_score(replay.gold, replay.final_tick)
    level = _digest(replay)
    row = db.execute(
        "SELECT score FROM replay WHERE id = (SELECT replay FROM level_best WHERE level = ? AND body = ?)",
        (level, replay.body),
    ).fetchone()
    if row and row[0] >= score:
        return False
    number = _insert(db, replay, kept=False)
    db.execute("REPLACE INTO level_best VALUES (?, ?, ?)", (level, replay.body, number))
    _drop_unneeded(db)
    return True


def _digest(replay: Replay) -> str:
    assert replay.level is not None  # noqa: S101 - attempts give replays with their levels
    return replay.level_digest or level_digest(replay.level)


def _insert(db: sqlite3.Connection, replay: Replay, *, kept: bool) -> int:
    """Save a replay, once: the same run may be a level's best, part of an episode's best, and kept."""
    assert replay.level is not None  # noqa: S101 - as above
    found = db.execute(
        "SELECT id FROM replay WHERE level = ? AND body = ? AND inputs = ? AND final_tick = ?",
        (_digest(replay), replay.body, replay.inputs, replay.final_tick),
    ).fetchone()
    if found:
        db.execute("UPDATE replay SET kept = max(kept, ?) WHERE id = ?", (kept, found[0]))
        return int(found[0])
    score = level_score(replay.gold, replay.final_tick) if replay.outcome == "exit" else 0
    cursor = db.execute(
        "INSERT INTO replay VALUES (NULL, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (
            _digest(replay), write_level_string(replay.level, exact=True), replay.name, replay.author, replay.body,
            replay.outcome, replay.final_tick, replay.gold, score, replay.digest, replay.inputs, now_text(), kept,
        ),
    )  # fmt: skip
    assert cursor.lastrowid is not None  # noqa: S101 - an INSERT has one
    return cursor.lastrowid


def _needed(db: sqlite3.Connection) -> set[int]:
    """Ids of the replays that bests refer to."""
    needed = {number for (number,) in db.execute("SELECT replay FROM level_best")}
    for (ids,) in db.execute("SELECT replays FROM episode_best"):
        needed.update(map(int, ids.split()))
    return needed


def _drop_unneeded(db: sqlite3.Connection) -> None:
    """Remove replays that were bests once and that nobody asked for."""
    loose = {number for (number,) in db.execute("SELECT id FROM replay WHERE kept = 0")} - _needed(db)
    db.executemany("DELETE FROM replay WHERE id = ?", [(number,) for number in loose])
