"""What is unlocked by completing columns of episodes (game.md §8)."""

from __future__ import annotations

import re
from collections.abc import Collection

from ninja_game.player.progress import COLUMNS, EPISODES_PER_COLUMN, Progress
from ninja_game.player.store import Store

COLOURS = 9
"""Colours of the ninja beyond the first one; each complete column unlocks one (presentation.md §3)."""

OVERCLOCK_COLUMNS = 6
FASTEST_TICK_GAIN = 10
"""ms that overclock can take off a tick's 25."""

_ANNOUNCED = "columns announced"


def complete_columns(progress: Progress, episodes: Collection[int]) -> int:
    """How many columns are complete: all of the ``episodes`` that exist in them are beaten, and there are some."""
    count = 0
    for column in range(COLUMNS):
        present = [episode for episode in episodes if episode // EPISODES_PER_COLUMN == column]
        count += bool(present) and progress.is_beaten(max(present))
    return count


def unlocked_colours(columns: int) -> int:
    """How many colours beyond the first one may be chosen with so many columns complete."""
    return min(columns, COLOURS)


def custom_colour_unlocked(columns: int, present: int) -> bool:
    """Whether any colour may be chosen: all ``present`` columns are complete."""
    return 0 < present <= columns


def overclock_unlocked(columns: int, present: int) -> bool:
    """Whether the game may be sped up: six complete columns, or all of them where there are fewer."""
    return 0 < min(OVERCLOCK_COLUMNS, present) <= columns


def new_unlocks(store: Store, columns: int, present: int) -> list[str]:
    """Messages for what has become unlocked since the last call; each comes once. Raises sqlite3.Error."""
    rows = store.rows("SELECT value FROM fact WHERE name = ?", (_ANNOUNCED,), [str])
    before = int(rows[0][0]) if rows and re.fullmatch("[0-9]{1,3}", rows[0][0]) else 0
    if columns <= before:
        return []
    messages = ["New ninja colour unlocked"] if unlocked_colours(columns) > before else []
    if overclock_unlocked(columns, present) and not overclock_unlocked(before, present):
        messages.append("Overclock unlocked")
    if custom_colour_unlocked(columns, present) and not custom_colour_unlocked(before, present):
        messages.append("Any ninja colour unlocked")
    with store.change() as db:
        db.execute("REPLACE INTO fact (name, value) VALUES (?, ?)", (_ANNOUNCED, str(columns)))
    return messages
