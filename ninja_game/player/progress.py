"""Progress: columns of episodes and what they unlock; the episode to continue; marks, medals, all gold.

game.md §2.1, §8.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Iterable, Sequence
from typing import NamedTuple

from ninja_game.errors import DAMAGED
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE, MAX_COLUMNS
from ninja_game.formats.pack.pars import MEDALS, Pars
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Entry
from ninja_game.player.store import Store

_COLOURS = 9  # colours of the ninja beyond the first one; each complete column unlocks one (presentation.md §3)

OVERCLOCK_COLUMNS = 6
FASTEST_TICK_GAIN = 10  # ms that overclock can take off a tick's 25

_ANNOUNCED, _PLACE = "columns announced", "episode left half-way"  # names of facts in the store

UNLOCKED, CHEATED, LOCKED = "unlocked", "cheated", "locked"

Place = tuple[int, int]  # episode number (0 to 99) and level in it (0 to 4)


class ColumnProgress(NamedTuple):
    """The farthest place that was reached in a column, and the farthest that was reached legitimately."""

    reached: Place
    beaten: Place


_COLUMN_NAMES = "grid_column, reached_episode, reached_level, beaten_episode, beaten_level"


class PackProgress:
    """Progress in a store: each passed level is merged into it, so that two games at once only add to it.

    ``pack``: the name of the pack with these episodes, "" for the game's own.
    """

    def __init__(self, store: Store, pack: str = "") -> None:
        self.store = store
        self.pack = pack
        self._columns: list[ColumnProgress] = []
        self._epoch = -1

    @property
    def columns(self) -> list[ColumnProgress]:
        """The stored progress, read again when it may have changed; damaged columns start again."""
        if self._epoch != self.store.epoch:
            self._columns = [ColumnProgress(*[(c * EPISODES_PER_COLUMN, 0)] * 2) for c in range(MAX_COLUMNS)]
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
        """Whether an episode was passed legitimately; of the tenth in a column it is enough to reach its last level."""
        beaten = self.columns[episode // EPISODES_PER_COLUMN].beaten
        return beaten[0] > episode or (_ends_column(episode) and beaten >= (episode, LEVELS_PER_EPISODE - 1))

    def level_passed(
        self, place: Place, *, levels: int = LEVELS_PER_EPISODE, following: int | None = None, legitimate: bool
    ) -> None:
        """A level of an episode has been passed: move "reached", and "beaten" too if it was legitimate.

        ``levels``: the episode's number of levels; ``following``: the next existing episode of its column, if that is
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
            furthest = _advanced(before.reached, episode, goal)
            beaten = _advanced(before.beaten, episode, goal) if legitimate else before.beaten
            if (furthest, beaten) != before:
                row = (self.pack, number, *furthest, *beaten)
                db.execute(f"REPLACE INTO progress (pack, {_COLUMN_NAMES}) VALUES (?, ?, ?, ?, ?, ?)", row)
                self._epoch = -1


def complete_columns(progress: PackProgress, episodes: Collection[int]) -> int:
    """The number of complete columns: those with episodes, all of which are beaten. ``episodes``: those that exist."""
    count = 0
    for column in range(MAX_COLUMNS):
        present = [episode for episode in episodes if episode // EPISODES_PER_COLUMN == column]
        count += bool(present) and progress.is_beaten(max(present))
    return count


def unlocked_colours(columns: int) -> int:
    """The number of colours beyond the first one that this many complete columns unlock."""
    return min(columns, _COLOURS)


def custom_colour_unlocked(columns: int, present: int) -> bool:
    """Whether any colour may be chosen: all ``present`` columns are complete."""
    return 0 < present <= columns


def overclock_unlocked(columns: int, present: int) -> bool:
    """Whether the game may be sped up: six complete columns, or all of them where there are fewer."""
    return 0 < min(OVERCLOCK_COLUMNS, present) <= columns


def new_unlocks(store: Store, columns: int, present: int) -> list[str]:
    """Messages about new unlocks since the last call; each comes once. Raises sqlite3.Error."""
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


def save_unfinished(store: Store, key: str, replays: Sequence[Replay] = ()) -> None:
    """Save the episode to continue, "" for none, and its runs. Raises sqlite3.Error."""
    with store.change() as db:
        value = json.dumps([key, *map(write_replay, replays)])
        db.execute("REPLACE INTO fact (name, value) VALUES (?, ?)", (_PLACE, value))


def load_unfinished(store: Store) -> tuple[str, list[Replay]]:
    """The key of the episode to continue, and its runs; ("", []) without one, or for a damaged one."""
    for (value,) in store.rows("SELECT value FROM fact WHERE name = ?", (_PLACE,), [str]):
        try:
            key, *texts = json.loads(value)
            return str(key), [parse_replay(text) for text in texts]
        except DAMAGED:
            break
    return "", []


def is_place(place: Place, column: int) -> bool:
    return place[0] // EPISODES_PER_COLUMN == column in range(MAX_COLUMNS) and place[1] in range(LEVELS_PER_EPISODE)


def _ends_column(episode: int) -> bool:
    return episode % EPISODES_PER_COLUMN == EPISODES_PER_COLUMN - 1


def _advanced(present: Place, episode: int, goal: Place) -> Place:
    """The farther of two places in a column; a later level counts only in the same episode.

    >>> _advanced((0, 2), 0, (0, 3)), _advanced((3, 0), 0, (0, 3)), _advanced((0, 1), 0, (1, 0))
    ((0, 3), (3, 0), (1, 0))
    """
    if goal[0] == episode and present[0] != episode:
        return present
    return max(present, goal)


NO_MEDAL = "with help: no medal"
HELPED = f"Passed {NO_MEDAL}"  # the label of an assisted run, and of a pass by one, on every screen

WITH_HELP = "with help"  # instead of the body in marks of such passes: they unlock, and are no records


class Mark(NamedTuple):
    """The best so far. ``fastest``: tick of the earliest exit contact; ``most_gold``: most pieces in a passed run."""

    fastest: int
    most_gold: int


class LevelMarks:
    """Marks in a store. Damaged ones are not read."""

    def __init__(self, store: Store) -> None:
        self.store = store

    def all(self, body: str = "circle") -> dict[str, Mark]:
        query = "SELECT level, fastest, most_gold FROM level_mark WHERE body = ?"
        return {level: Mark(*numbers) for level, *numbers in self.store.rows(query, (body,), [str, int, int])}

    def of(self, level: str, body: str = "circle") -> Mark | None:
        query = "SELECT fastest, most_gold FROM level_mark WHERE level = ? AND body = ?"
        rows = self.store.rows(query, (level, body), [int, int])
        return Mark(*rows[0]) if rows else None

    def is_passed(self, level: str) -> bool:
        return (self.of(level) or self.of(level, WITH_HELP)) is not None

    def passed(self, level: str, tick: int, gold: int, body: str = "circle") -> Mark:
        """Record a passed run: the earlier tick and the larger gold stay. Raises sqlite3.Error."""
        with self.store.change() as db:
            before = self.of(level, body) or Mark(tick, gold)
            mark = Mark(min(tick, before.fastest), max(gold, before.most_gold))
            row = (level, body, *mark)
            db.execute("REPLACE INTO level_mark (level, body, fastest, most_gold) VALUES (?, ?, ?, ?)", row)
        return mark


class Tally(NamedTuple):
    """Results over several levels: how many there are, are passed, have each best medal, have all gold."""

    levels: int
    passed: int
    medals: dict[str, int]
    all_gold: int


def medal_of(entry: Entry, mark: Mark | None) -> str:
    return entry.pars.medal(mark.fastest) if entry.pars and mark else ""


def opens_author(entry: Entry, mark: Mark | None) -> bool:
    """Whether a mark unlocks the author's run of the level: a gold medal does."""
    return medal_of(entry, mark) in {"gold", "author"}


def next_par(pars: Pars, mark: Mark) -> str:
    """The medal above that of a mark, its time, and by how much the mark missed it; "" after the best."""
    medal = pars.next_medal(mark.fastest)
    par = pars.par(medal) if medal else 0
    missing = seconds_text(mark.fastest - par)
    return f"{medal.capitalize()} medal: {seconds_text(par)} s, {missing} s to go" if medal else ""


def result_sentence(entry: Entry, mark: Mark | None) -> str:
    """The player's fastest time in a level and most gold in a pass, as a sentence; "" without a mark."""
    if mark is None:
        return ""
    gold = f", gold {mark.most_gold} of {entry.all_gold}" if entry.all_gold else ""
    return f"Time {seconds_text(mark.fastest)} s{gold}"


def has_all_gold(entry: Entry, mark: Mark | None) -> bool:
    return mark is not None and mark.most_gold >= entry.all_gold > 0


def worst_medal(entries: Iterable[Entry], marks: dict[str, Mark]) -> str:
    """The worst medal of all the levels; "" if one has none."""
    order = [*MEDALS, ""]
    medals = (order.index(medal_of(entry, marks.get(entry.digest))) for entry in entries)
    return order[max(medals, default=len(MEDALS))]


def count_results(entries: Iterable[Entry], marks: dict[str, Mark], helped: Collection[str] = ()) -> Tally:
    """Count the results over levels. ``helped``: digests of those passed with help."""
    pairs = [(entry, marks.get(entry.digest)) for entry in entries]
    medals = [medal_of(*pair) for pair in pairs]
    passed = sum(mark is not None or entry.digest in helped for entry, mark in pairs)
    counts = {medal: medals.count(medal) for medal in MEDALS}
    return Tally(len(pairs), passed, counts, sum(has_all_gold(*pair) for pair in pairs))
