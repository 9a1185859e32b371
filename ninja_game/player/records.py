"""Personal bests, replays, counts (game.md §2.1). Keys are digests of levels, so that a changed level starts afresh."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from functools import lru_cache
from typing import NamedTuple, get_type_hints

from ninja_game.errors import NinjaGameError
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.replay.provenance import names_of_text, parse_provenance
from ninja_game.formats.replay.text import OUTCOMES, Replay
from ninja_game.formats.run_time import level_score
from ninja_game.player.store import Store
from ninja_game.runs.deaths import KILLERS
from ninja_game.sim.level import BODIES

NEWEST_SHOWN = 500  # replays listed at most, the newest first


class SavedReplay(NamedTuple):
    """A replay in the records, without its inputs: ``score`` in ticks (0 unless passed), ``made_at`` in UTC.

    ``kept``: 1 if the player saved it, else 0.
    """

    id: int  #: its row in the file
    level: str
    name: str
    player: str
    body: str
    outcome: str
    final_tick: int  #: the last tick that is run, from 0
    gold: int
    score: int
    made_at: str
    kept: int


_SAVED = ", ".join(f"replay.{name}" for name in SavedReplay._fields)
_SAVED_KINDS = tuple(get_type_hints(SavedReplay).values())

_level = lru_cache(16)(parse_level_string)  # a level by its text: consecutive replays are often of one level

_TEXTS = ("level", "level_text", "name", "player", "body", "outcome", "digest", "made", "co_authors")
_WHOLE = {**dict.fromkeys(_TEXTS, str), "final_tick": int, "gold": int, "inputs": bytes}
"""The columns read for a whole replay, with their types."""


class EpisodeBest(NamedTuple):
    """An episode's best: score in ticks, and the ids of its replays in the order of the levels."""

    score: int
    replays: tuple[int, ...]
    made_at: str


def has_words(words: Iterable[str], *texts: str) -> bool:
    """Whether each word (casefolded) is in one of the texts.

    >>> has_words(["first", "ann"], "First Steps", "Anna"), has_words(["first", "bob"], "First Steps", "Anna")
    (True, False)
    """
    text = " ".join(texts).casefold()
    return all(word in text for word in words)


def now_text() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


class Records:
    """Personal bests and replays in a store.

    Reading skips damaged rows. A change returns when it is on the disk, or is part of the transaction around it, and
    raises sqlite3.Error.
    """

    def __init__(self, store: Store) -> None:
        self.store = store

    def keep_replay(self, replay: Replay) -> int:
        """Save a replay at the player's request; its id."""
        with self.store.change() as db:
            return self._insert(db, replay, kept=True)

    def replays(self, words: Sequence[str] = ()) -> list[SavedReplay]:
        """The replays whose name and player have all these words (casefolded), newest first; NEWEST_SHOWN at most."""
        if not words:
            # Ids grow with time; by id not every replay has to be read.
            return self._saved("ORDER BY id DESC LIMIT ?", NEWEST_SHOWN)
        rows = self.store.rows("SELECT id, name, player FROM replay ORDER BY id DESC", (), (int, str, str))
        ids = [number for number, *texts in rows if has_words(words, *texts)][:NEWEST_SHOWN]
        return self._saved(f"WHERE id IN ({', '.join('?' * len(ids))}) ORDER BY id DESC", *ids)

    def replay(self, number: int) -> Replay | None:
        """A whole replay by its id, with its level inside; None if it has gone or is damaged."""
        query = f"SELECT {', '.join(_WHOLE)} FROM replay WHERE id = ?"
        for row in self.store.rows(query, (number,), tuple(_WHOLE.values())):
            level, text, name, player, body, outcome, digest, made, co_authors, final_tick, gold, inputs = row
            try:
                return Replay(
                    inputs=inputs, final_tick=final_tick, outcome=outcome, gold=gold, digest=digest, name=name,
                    author=player, body=body, level_digest=level, level=_level(text),
                    made=parse_provenance(made), co_authors=names_of_text(co_authors),
                )  # fmt: skip
            except (NinjaGameError, ValueError) as error:
                self.store.report(f"A replay in the records is damaged ({error}).")
        return None

    def forget_replay(self, number: int) -> bool:
        """Delete a replay unless a personal best needs it; whether it is gone."""
        with self.store.change() as db:
            db.execute("UPDATE replay SET kept = 0 WHERE id = ?", (number,))
            return db.execute(f"DELETE FROM replay WHERE id = ? AND {_UNNEEDED}", (number,)).rowcount > 0

    def _saved(self, condition: str, *values: object) -> list[SavedReplay]:
        query = f"SELECT {_SAVED} FROM replay {condition}"
        runs = (SavedReplay(*row) for row in self.store.rows(query, values, _SAVED_KINDS))
        return [run for run in runs if run.outcome in OUTCOMES and run.body in BODIES]

    def level_best(self, digest: str, body: str = "circle") -> SavedReplay | None:
        rows = self._saved(f"{_BEST} AND level_best.level = ?", body, digest)
        return rows[0] if rows else None

    def level_bests(self, body: str = "circle") -> dict[str, SavedReplay]:
        return {saved.level: saved for saved in self._saved(_BEST, body)}

    def level_passed(self, replay: Replay) -> bool:
        """Save a passed level's replay if it is better than the best so far; whether it is."""
        level = _digest(replay)
        with self.store.change() as db:
            best = self.level_best(level, replay.body)
            if best is not None and best.score >= level_score(replay.gold, replay.final_tick):
                return False
            number = self._insert(db, replay, kept=False)
            db.execute("REPLACE INTO level_best (level, body, replay) VALUES (?, ?, ?)", (level, replay.body, number))
            db.execute(_DROP_UNNEEDED)
        return True

    def episode_best(self, key: str, body: str = "circle") -> EpisodeBest | None:
        which, where = (key, body), "WHERE episode = ? AND body = ?"
        ids = self.store.rows(f"SELECT replay FROM episode_replay {where} ORDER BY place", which, [int])
        rows = self.store.rows(f"SELECT score, made_at FROM episode_best {where}", which, [int, str])
        return EpisodeBest(rows[0][0], tuple(number for (number,) in ids), rows[0][1]) if rows else None

    def episode_passed(self, key: str, score: int, replays: Sequence[Replay]) -> bool:
        """Save an episode's score (ticks) and replays if it is better than the best so far; whether it is."""
        body = replays[0].body
        with self.store.change() as db:
            best = self.episode_best(key, body)
            if best is not None and best.score >= score:
                return False
            row = key, body, score, now_text()
            db.execute("REPLACE INTO episode_best (episode, body, score, made_at) VALUES (?, ?, ?, ?)", row)
            db.execute("DELETE FROM episode_replay WHERE episode = ? AND body = ?", (key, body))
            rows = [(key, body, place, self._insert(db, replay, kept=False)) for place, replay in enumerate(replays)]
            db.executemany("INSERT INTO episode_replay (episode, body, place, replay) VALUES (?, ?, ?, ?)", rows)
            db.execute(_DROP_UNNEEDED)
        return True

    def _insert(self, db: sqlite3.Connection, replay: Replay, *, kept: bool) -> int:
        """Save a replay, once: the same run may be a level's best, part of an episode's best, and kept.

        An equal row is used only if it can be read: one with a damaged cell would be skipped at the next start.
        """
        assert replay.level is not None  # noqa: S101 - attempts give replays with their levels
        # The digest first: it distinguishes most rows, and all of them are compared.
        values = {
            "digest": replay.digest,
            "level": _digest(replay),
            "level_text": write_level_string(replay.level, exact=True),
            "body": replay.body,
            "outcome": replay.outcome,
            "final_tick": replay.final_tick,
            "gold": replay.gold,
            "score": level_score(replay.gold, replay.final_tick) if replay.outcome == "exit" else 0,
            "inputs": replay.inputs,
            "made": str(replay.made),
            "co_authors": ", ".join(replay.co_authors),
        }
        condition = " AND ".join(f"{column} = ?" for column in values)
        for saved in self._saved(f"WHERE {condition}", *values.values()):
            db.execute("UPDATE replay SET kept = max(kept, ?) WHERE id = ?", (kept, saved.id))
            return saved.id
        values |= {"name": replay.name, "player": replay.author, "made_at": now_text(), "kept": kept}
        marks = ", ".join("?" * len(values))
        cursor = db.execute(f"INSERT INTO replay ({', '.join(values)}) VALUES ({marks})", [*values.values()])
        assert cursor.lastrowid is not None  # noqa: S101 - an INSERT has one
        return cursor.lastrowid


_BEST = "JOIN level_best ON level_best.replay = replay.id AND level_best.level = replay.level WHERE level_best.body = ?"

_UNNEEDED = "id NOT IN (SELECT replay FROM level_best) AND id NOT IN (SELECT replay FROM episode_replay) AND NOT kept"
"""Replays that are no longer bests, and that the player did not save."""

_DROP_UNNEEDED = f"DELETE FROM replay WHERE {_UNNEEDED}"


def _digest(replay: Replay) -> str:
    assert replay.level is not None  # noqa: S101 - attempts give replays with their levels
    return replay.level_digest or level_digest(replay.level)


class Played(NamedTuple):
    """Statistics, in all or of a level: attempts, passes, deaths, ticks in play, pieces of gold."""

    attempts: int = 0
    passes: int = 0
    deaths: int = 0
    ticks: int = 0
    gold: int = 0


class Statistics:
    """Counts of attempts, passes, deaths, ticks and gold by level, in the player's database."""

    def __init__(self, store: Store) -> None:
        self.store = store

    def attempt_ended(self, level: str, *, killer: str | None, passed: bool, ticks: int, gold: int) -> None:
        """Count an attempt at a level (its digest) that ended: passed, killed by ``killer``, or ended by the player.

        Raises sqlite3.Error.
        """
        with self.store.change() as db:
            db.execute(
                "INSERT INTO played (level, attempts, passes, deaths, ticks, gold) VALUES (?, 1, ?, ?, ?, ?)"
                " ON CONFLICT (level) DO UPDATE SET"
                " attempts = attempts + 1, passes = passes + excluded.passes, deaths = deaths + excluded.deaths,"
                " ticks = ticks + excluded.ticks, gold = gold + excluded.gold",
                (level, int(passed), int(killer is not None), ticks, gold),
            )
            if killer is not None:
                death = "INSERT INTO death (killer, times) VALUES (?, 1)"
                db.execute(f"{death} ON CONFLICT (killer) DO UPDATE SET times = times + 1", (killer,))

    def deaths(self) -> dict[str, int]:
        """Deaths by killer, every killer present, in the order of KILLERS."""
        times = dict(self.store.rows("SELECT killer, times FROM death", (), [str, int]))
        return {killer: times.get(killer, 0) for killer in KILLERS}

    def played(self, level: str | None = None) -> Played:
        query = "SELECT attempts, passes, deaths, ticks, gold FROM played WHERE ?1 IS NULL OR level = ?1"
        return Played(*map(sum, zip(*self.store.rows(query, (level,), [int] * 5), strict=True)))
