"""The episode that was left half-way: its key and the runs of its first levels, in a store."""

from __future__ import annotations

import json
from collections.abc import Sequence

from ninja_game.errors import NinjaGameError
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from ninja_game.player.store import Store

_PLACE = "episode left half-way"


def keep_place(store: Store, key: str, replays: Sequence[Replay]) -> None:
    """Note where an episode stands; without runs nothing is noted any more. Raises sqlite3.Error."""
    with store.change() as db:
        db.execute("DELETE FROM fact WHERE name = ?", (_PLACE,))
        if replays:
            value = json.dumps([key, *map(write_replay, replays)])
            db.execute("INSERT INTO fact (name, value) VALUES (?, ?)", (_PLACE, value))


def kept_place(store: Store) -> tuple[str, list[Replay]]:
    """The key of the episode that was left, and its runs; ("", []) where there is none, or it is damaged."""
    for (value,) in store.rows("SELECT value FROM fact WHERE name = ?", (_PLACE,), [str]):
        try:
            key, *texts = json.loads(value)
            return str(key), [parse_replay(text) for text in texts]
        except (NinjaGameError, ValueError, TypeError, AttributeError, RecursionError):
            break
    return "", []
