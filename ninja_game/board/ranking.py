"""Ranks, records, medals and totals, from the runs that count."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from functools import cached_property
from itertools import zip_longest
from math import inf
from operator import itemgetter

from ninja_game.board.categories import DEFAULT_CATEGORIES, Category
from ninja_game.board.runs import PLAYED, Run, RunKey, ValidatedRuns
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.levels.episodes import Episode
from ninja_game.levels.published import PublishedLevels

Leaderboard = tuple[str, Category]  # a ladder and a category, within which runs are ranked

WEEK = timedelta(days=7)


@dataclass(frozen=True)
class Ranked:
    """A run in a table."""

    place: int  #: equal runs share one; a run that waits has 0
    run: Run
    values: tuple[float, ...]  #: the numbers that rank it
    behind: float  #: the gap of its first number to the first run's
    is_far: bool  #: as ``Category.is_far``


@dataclass(frozen=True)
class Record:
    """A run that was the best of its level when it was added."""

    run: Run
    gains: Mapping[Category, float | None]  #: the improvement of its first number; None if it was the first run


@dataclass
class Standing:
    """A player's sums in a ladder."""

    player: str
    levels: int = 0
    runs: int = 0
    medals: dict[str, int] = field(default_factory=lambda: dict.fromkeys(MEDALS, 0))  #: levels by best medal
    records: dict[Category, int] = field(default_factory=lambda: defaultdict(int))  #: levels led
    ranks: list[int] = field(default_factory=list)  #: places of the best runs in the first category
    behind: list[float] = field(default_factory=list)  #: shares by which these are slower than the best, unless far

    def add(self, ranked: Ranked, best: int) -> None:
        """Count the player's best run of a level in the first category. ``best``: ticks of the level's best."""
        self.levels += 1
        self.ranks.append(ranked.place)
        if not ranked.is_far:
            self.behind.append(ranked.run.tick / max(1, best) - 1)
        if ranked.run.medal:
            self.medals[ranked.run.medal] += 1


class Ranking:
    """All rankings for the pages of a folder. ``name``, ``unknown``: as in BoardRules."""

    def __init__(
        self,
        judged: ValidatedRuns,
        shown: PublishedLevels,
        categories: Sequence[Category] = DEFAULT_CATEGORIES,
        name: str = "",
        unknown: str = PLAYED,
    ) -> None:
        self.judged, self.name, self.unknown = judged, name, unknown
        self.shown = shown
        self.categories = tuple(categories)
        self.by_level: dict[str, list[Run]] = defaultdict(list)
        for run in judged.runs:
            self.by_level[run.level].append(run)
        self._values = {
            category: dict(zip((run.key for run in judged.runs), category.values(judged.runs), strict=True))
            for category in self.categories
        }

    def values(self, category: Category, run: Run) -> tuple[float, ...] | None:
        """The numbers that rank a run; None if it is not in the category."""
        return self._values[category][run.key]

    def number(self, category: Category, run: Run) -> float:
        """The first of ``values``, the one shown, for a run in the category."""
        return (self.values(category, run) or (0.0,))[0]

    def _table(self, runs: Iterable[Run], category: Category) -> list[Ranked]:
        """The best run of each player, in order; of equal ones the earliest.

        Runs that wait come after all others, and after the player's own runs.
        """
        valued = [(bool(run.waits), values, run) for run in runs if (values := self.values(category, run)) is not None]
        best: dict[str, tuple[bool, tuple[float, ...], Run]] = {}
        for row in sorted(valued, key=itemgetter(0, 1)):
            best.setdefault(row[2].player, row)
        table: list[Ranked] = []
        for number, (waits, values, run) in enumerate(best.values(), 1):
            shared = table and table[-1].values == values
            place = 0 if waits else table[-1].place if shared else number
            first = (table[0].values if table else values)[0]
            table.append(Ranked(place, run, values, values[0] - first, category.is_far(values[0], first)))
        return table

    @cached_property
    def tables(self) -> dict[str, dict[Leaderboard, list[Ranked]]]:
        """All tables with runs, by level, then by ladder and category."""
        of_levels: dict[str, dict[Leaderboard, list[Ranked]]] = {}
        for level, runs in self.by_level.items():
            ladders: dict[str, list[Run]] = defaultdict(list)
            for run in runs:
                ladders[run.ladder].append(run)
            leaderboards = {
                (ladder, category): self._table(ladders[ladder], category)
                for ladder in self.ladders
                for category in self.categories
            }
            of_levels[level] = {leaderboard: table for leaderboard, table in leaderboards.items() if table}
        return of_levels

    def waiting(self, level: str, leaderboard: Leaderboard, table: Sequence[Ranked]) -> list[Ranked]:
        """Runs that wait and are better than their player's run in the table."""
        ladder, category = leaderboard
        best = {row.run.player: row for row in table if row.run.ladder == ladder}
        waiting = []
        for run in self.by_level.get(level, ()):
            values, row = self.values(category, run), best.get(run.player)
            if run.waits and run.ladder == ladder and values and row and values < row.values:
                first = table[0].values[0]
                waiting.append(Ranked(0, run, values, values[0] - first, category.is_far(values[0], first)))
        return waiting

    def side_by_side(self, level: str, most: int) -> tuple[Category, list[Run]]:
        """The first category of a level with runs, and its first runs: of both ladders in turn, played ones first.

        Runs far behind are left out: they take another route.
        """
        tables = self.tables[level]
        category = next(other for other in self.categories if any((ladder, other) in tables for ladder in self.ladders))
        turns = zip_longest(*(tables.get((ladder, category), [])[:most] for ladder in self.ladders))
        runs = [ranked.run for turn in turns for ranked in turn if ranked][:most]
        best = min(self.number(category, run) for run in runs)
        runs = [run for run in runs if not category.is_far(self.number(category, run), best)]
        return category, sorted(runs, key=lambda run: run.ladder != PLAYED)

    @cached_property
    def places(self) -> dict[RunKey, list[tuple[Leaderboard, list[Ranked], int]]]:
        """The tables in which a run stands, and its row in each, by run."""
        rows_of: dict[RunKey, list[tuple[Leaderboard, list[Ranked], int]]] = defaultdict(list)
        for tables in self.tables.values():
            for leaderboard, table in tables.items():
                for number, ranked in enumerate(table):
                    rows_of[ranked.run.key].append((leaderboard, table, number))
        return rows_of

    @cached_property
    def ladders(self) -> list[str]:
        """The ladders with runs; the one of played runs is first, and always there."""
        return sorted({PLAYED} | {run.ladder for run in self.judged.runs}, key=lambda ladder: ladder != PLAYED)

    def leaderboard_name(self, leaderboard: Leaderboard) -> str:
        """The name of a ladder's category, with the ladder only if there are two."""
        ladder, category = leaderboard
        return f"{category.name}, {ladder}" if len(self.ladders) > 1 else category.name

    @cached_property
    def history(self) -> dict[tuple[str, Leaderboard], list[Run]]:
        """All records in order, by level, ladder and category; of one moment only the last."""
        by_board: dict[tuple[str, Leaderboard], list[Run]] = defaultdict(list)
        for run in self.judged.runs:
            for category in self.categories:
                values = self.values(category, run)
                records = by_board[run.level, (run.ladder, category)] if values else []
                best = self.values(category, records[-1]) if records else None
                if values and not run.waits and (best is None or values < best):
                    records[-1:] = [run] if best and records[-1].added == run.added else [*records[-1:], run]
        return by_board

    @cached_property
    def records(self) -> list[Record]:
        """Every record that was ever set, a run once, the newest first."""
        changes: dict[tuple[str, int], dict[Category, float | None]] = defaultdict(dict)
        for (_, (_, category)), runs in self.history.items():
            numbers = [self.number(category, run) for run in runs]
            for number, run in enumerate(runs):
                changes[run.key][category] = numbers[number - 1] - numbers[number] if number else None
        return [Record(run, changes[run.key]) for run in reversed(self.judged.runs) if run.key in changes]

    @cached_property
    def standings(self) -> dict[str, list[Standing]]:
        """All players, most levels led first, by ladder."""
        players_of: dict[str, dict[str, Standing]] = {ladder: {} for ladder in self.ladders}
        for run in self.judged.runs:
            players_of[run.ladder].setdefault(run.player, Standing(run.player)).runs += 1
        for tables in self.tables.values():
            for (ladder, category), table in tables.items():
                for ranked in table:
                    standing = players_of[ladder][ranked.run.player]
                    standing.records[category] += ranked.place == 1
                    if category is self.categories[0] and ranked.place:
                        standing.add(ranked, table[0].run.tick)
        return {
            ladder: sorted(players.values(), key=lambda item: (-sum(item.records.values()), -item.levels, item.player))
            for ladder, players in players_of.items()
        }

    def episode(self, episode: Episode, leaderboard: Leaderboard) -> list[tuple[str, float, Sequence[Run]]]:
        """The players who passed every level of an episode: player, sum of the best numbers, and the runs, in order."""
        tables = [
            {row.run.player: row for row in self.tables.get(entry.digest, {}).get(leaderboard, ()) if row.place}
            for entry in episode.levels
        ]
        totals = []
        for player in tables[0] if tables else ():
            best = [table[player] for table in tables if player in table]
            if len(best) == len(tables):
                totals.append((player, sum(row.values[0] for row in best), [row.run for row in best]))
        return sorted(totals, key=itemgetter(1, 0))

    def whole(self, episode: Episode, leaderboard: Leaderboard) -> list[tuple[str, float, Sequence[Run]]]:
        """As ``episode``, for each player's best recording of the whole episode; one assisted run makes it assisted."""
        ladder, category = leaderboard
        best: dict[str, tuple[str, float, Sequence[Run]]] = {}
        for runs in self.judged.episodes.get(episode.key, ()):
            values = [of_run[0] for run in runs if not run.waits and (of_run := self.values(category, run))]
            player = runs[0].player
            if max(run.ladder != PLAYED for run in runs) == (ladder != PLAYED) and len(values) == len(runs):
                now = player, sum(values), runs
                best[player] = min(best.get(player, now), now, key=itemgetter(1))
        return sorted(best.values(), key=itemgetter(1, 0))

    @cached_property
    def beaten(self) -> Counter[str]:
        """The number of times that a level's records were beaten, by level; empty if all runs came at one moment."""
        beaten = Counter[str]()
        for (level, _), runs in self.history.items():
            beaten[level] += len(runs) - 1
        return +beaten

    @cached_property
    def contested(self) -> list[str]:
        """The levels by how often their records were beaten, else those with a second run by how close it is."""
        players = {level: len({run.player for run in runs}) for level, runs in self.by_level.items()}
        close = {digest: 0.0 if self.beaten else self._close(digest) for digest in self.by_level}
        close_levels = [level for level in self.by_level if close[level] < inf]
        return sorted(close_levels, key=lambda level: (-self.beaten[level], close[level], -players[level]))

    def _close(self, level: str) -> float:
        """The gap between the first two runs in the first category, on the ladder where it is smallest."""
        tables = (self.tables[level].get((ladder, self.categories[0]), ()) for ladder in self.ladders)
        return min((row.behind for table in tables for row in table[1:2] if row.place), default=inf)

    @cached_property
    def level_of_the_week(self) -> tuple[str, int, int] | None:
        """The level with runs by most players in the seven days up to the newest run; then by most runs.

        And the numbers of players, at least two, and of runs. None without two dates: it depends only on the ledger,
        never on a clock.
        """
        dated = [(datetime.fromisoformat(run.added), run) for run in self.judged.runs if run.added]
        week: dict[str, list[Run]] = defaultdict(list)
        for date, run in dated:
            if date > dated[-1][0] - WEEK:
                week[run.level].append(run)
        counts = {level: (len({run.player for run in runs}), len(runs)) for level, runs in week.items()}
        several = [level for level in self.shown.entries if counts.get(level, (0, 0))[0] > 1]
        best = max(several, key=counts.__getitem__, default=None)
        return (best, *counts[best]) if best and dated[0][0] < dated[-1][0] else None
