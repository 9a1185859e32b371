"""How far the player has come: ten columns of ten episodes, each episode five levels (game.md §2.1).

And what is unlocked by completing columns (game.md §8).
"""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import NamedTuple

from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE
from ninja_game.player.store import Store

COLUMNS = 10

COLOURS = 9
"""Colours of the ninja beyond the first one; each complete column unlocks one (presentation.md §3)."""

OVERCLOCK_COLUMNS = 6
FASTEST_TICK_GAIN = 10
"""ms that overclock can take off a tick's 25."""

_ANNOUNCED = "columns announced"

UNLOCKED, CHEATED, LOCKED = "unlocked", "cheated", "locked"

Place = tuple[int, int]
"""Episode number (0 to 99) and level in it (0 to 4)."""


class ColumnProgress(NamedTuple):
    """The farthest place of a column that was reached, and the farthest that was reached legitimately."""

    reached: Place
    beaten: Place


_COLUMN_NAMES = "grid_column, reached_episode, reached_level, beaten_episode, beaten_level"


class Progress:
    """Progress in a store: each passed level is merged into what is there, so that two games at once only add to it.

    ``pack``: the name of the pack whose episodes these are, "" for the game's own.
    """

    def __init__(self, store: Store, pack: str = "") -> None:
        self.store = store
        self.pack = pack
        self._columns: list[ColumnProgress] = []
        self._epoch = -1

    @property
    def columns(self) -> list[ColumnProgress]:
        """What is in the store, read again whenever that may have changed; damaged columns start again."""
        if self._epoch != self.store.epoch:
            self._columns = [ColumnProgress(*[(c * EPISODES_PER_COLUMN, 0)] * 2) for c in range(COLUMNS)]
            query = f"SELECT {_COLUMN_NAMES} FROM progress WHERE pack = ?"
            for number, *places in self.store.rows(query, (self.pack,), [int] * 5):
                column = ColumnProgress((places[0], places[1]), (places[2], places[3]))
                if all(is_place(place, number) for place in column):
                    self._columns[number] = column
            self._epoch = self.store.epoch
        return self._columns

    def state(self, episode: int) -> str:
        """Whether an episode is unlocked, "cheated" (only reached in practice and the like), or locked."""
        column = self.columns[episode // EPISODES_PER_COLUMN]
        if episode <= column.beaten[0]:
            return UNLOCKED
        return CHEATED if episode <= column.reached[0] else LOCKED

    def is_beaten(self, episode: int) -> bool:
        """Whether an episode was passed legitimately; the tenth of a column counts once its last level is reached."""
        beaten = self.columns[episode // EPISODES_PER_COLUMN].beaten
        return beaten[0] > episode or (_ends_column(episode) and beaten >= (episode, LEVELS_PER_EPISODE - 1))

    def level_passed(
        self, place: Place, *, levels: int = LEVELS_PER_EPISODE, following: int | None = None, legitimate: bool
    ) -> None:
        """A level of an episode has been passed: move "reached", and "beaten" too if it was legitimate.

        ``levels``: how many the episode has; ``following``: the next episode that there is in its column, where that is
        not the next number. Raises sqlite3.Error.
        """
        episode, level = place
        if level < levels - 1:
            goal = (episode, level + 1)
        elif _ends_column(episode):
            return
        else:
            goal = (following or episode + 1, 0)
        number = episode // EPISODES_PER_COLUMN
        with self.store.change() as db:
            before = self.columns[number]
            reached = _advanced(before.reached, episode, goal)
            beaten = _advanced(before.beaten, episode, goal) if legitimate else before.beaten
            if (reached, beaten) != before:
                row = (self.pack, number, *reached, *beaten)
                db.execute(f"REPLACE INTO progress (pack, {_COLUMN_NAMES}) VALUES (?, ?, ?, ?, ?, ?)", row)
                self._epoch = -1


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
    messages = ["A new ninja colour is yours: see Settings"] if unlocked_colours(columns) > before else []
    if overclock_unlocked(columns, present) and not overclock_unlocked(before, present):
        messages.append("Overclock unlocked: see Settings")
    if custom_colour_unlocked(columns, present) and not custom_colour_unlocked(before, present):
        messages.append("All ninja colours are yours: see Settings")
    with store.change() as db:
        db.execute("REPLACE INTO fact (name, value) VALUES (?, ?)", (_ANNOUNCED, str(columns)))
    return messages


def is_place(place: Place, column: int) -> bool:
    return place[0] // EPISODES_PER_COLUMN == column in range(COLUMNS) and place[1] in range(LEVELS_PER_EPISODE)


def _ends_column(episode: int) -> bool:
    return episode % EPISODES_PER_COLUMN == EPISODES_PER_COLUMN - 1


def _advanced(present: Place, episode: int, goal: Place) -> Place:
    """The farther of two places. Within an episode only from that episode: later levels of earlier ones change nothing.

    >>> _advanced((0, 2), 0, (0, 3)), _advanced((3, 0), 0, (0, 3)), _advanced((0, 1), 0, (1, 0))
    ((0, 3), (3, 0), (1, 0))
    """
    if goal[0] == episode and present[0] != episode:
        return present
    return max(present, goal)
