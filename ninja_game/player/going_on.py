"""Where play goes on: the key of an episode, and the runs of its first levels if none was left out, in a store."""

from __future__ import annotations

import json
from collections.abc import Sequence

from ninja_game.errors import NinjaGameError
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from ninja_game.player.store import Store

_PLACE = "episode left half-way"


def keep_place(store: Store, key: str, replays: Sequence[Replay] = ()) -> None:
    """Note the episode with which play goes on, "" for none, and its runs. Raises sqlite3.Error."""
    with store.change() as db:
        value = json.dumps([key, *map(write_replay, replays)])
        db.execute("REPLACE INTO fact (name, value) VALUES (?, ?)", (_PLACE, value))


def kept_place(store: Store) -> tuple[str, list[Replay]]:
    """The key of the episode that play goes on with, and its runs; ("", []) where there is none, or it is damaged."""
    for (value,) in store.rows("SELECT value FROM fact WHERE name = ?", (_PLACE,), [str]):
        try:
            key, *texts = json.loads(value)
            return str(key), [parse_replay(text) for text in texts]
        except (NinjaGameError, ValueError, TypeError, AttributeError, RecursionError):
            break
    return "", []
