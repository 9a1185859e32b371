"""What has been reached in levels: marks, medals, all gold (game.md §2.1)."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import NamedTuple

from ninja_game.formats.pack.pars import MEDALS, Pars
from ninja_game.formats.run_time import seconds_text
from ninja_game.player.catalogue import Entry
from ninja_game.player.store import Store

NO_MEDAL = "with help: no medal"
HELPED = f"Passed {NO_MEDAL}"
"""What a run that is assisted, and a pass by it, are called on every screen."""

WITH_HELP = "with help"
"""In the place of the body in marks of such passes: they open what follows, and are no records."""


class Mark(NamedTuple):
    """``fastest``: tick of the earliest exit contact; ``most_gold``: pieces in the passed run that took the most."""

    fastest: int
    most_gold: int


class Marks:
    """Marks in a store. Reading leaves out what is damaged."""

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
        """Take note of a passed run: what is better in it stays. Raises sqlite3.Error."""
        with self.store.change() as db:
            before = self.of(level, body) or Mark(tick, gold)
            mark = Mark(min(tick, before.fastest), max(gold, before.most_gold))
            row = (level, body, *mark)
            db.execute("REPLACE INTO level_mark (level, body, fastest, most_gold) VALUES (?, ?, ?, ?)", row)
        return mark


class Tally(NamedTuple):
    """What has been reached in levels: how many there are, passed, whose best medal is which, with all gold."""

    levels: int
    passed: int
    medals: dict[str, int]
    all_gold: int


def medal_of(entry: Entry, mark: Mark | None) -> str:
    return entry.pars.medal(mark.fastest) if entry.pars and mark else ""


def opens_author(entry: Entry, mark: Mark | None) -> bool:
    """Whether a mark opens the run of the level's author: a gold medal does."""
    return medal_of(entry, mark) in {"gold", "author"}


def next_par(pars: Pars, mark: Mark) -> str:
    """The medal after the one that a mark brings, its time, and by how much that was missed; "" after the best."""
    medal = pars.next_medal(mark.fastest)
    par = pars.par(medal) if medal else 0
    missing = seconds_text(mark.fastest - par)
    return f"{medal.capitalize()} medal: {seconds_text(par)} s, {missing} s to go" if medal else ""


def reached(entry: Entry, mark: Mark | None) -> str:
    """The player's fastest time in a level and the most gold of a pass, in words; "" without a mark."""
    if mark is None:
        return ""
    return f"Time {seconds_text(mark.fastest)} s, gold {mark.most_gold} of {entry.all_gold}"


def has_all_gold(entry: Entry, mark: Mark | None) -> bool:
    return mark is not None and mark.most_gold >= entry.all_gold > 0


def worst_medal(entries: Iterable[Entry], marks: dict[str, Mark]) -> str:
    """The medal that all the levels have, or a better one; "" where one has none."""
    order = [*MEDALS, ""]
    found = (order.index(medal_of(entry, marks.get(entry.digest))) for entry in entries)
    return order[max(found, default=len(MEDALS))]


def tally(entries: Iterable[Entry], marks: dict[str, Mark], helped: Collection[str] = ()) -> Tally:
    """Count what has been reached in levels. ``helped``: digests of those passed with help."""
    pairs = [(entry, marks.get(entry.digest)) for entry in entries]
    medals = [medal_of(*pair) for pair in pairs]
    passed = sum(mark is not None or entry.digest in helped for entry, mark in pairs)
    counts = {medal: medals.count(medal) for medal in MEDALS}
    return Tally(len(pairs), passed, counts, sum(has_all_gold(*pair) for pair in pairs))
