"""Ranks, records, medals and totals, from the runs that count."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from ninja_game.formats.pack.pars import MEDALS
from ninja_game.player.catalogue import Episode
from ninja_game.web.board.runs import Run, ValidatedRuns
from ninja_game.web.pages.published import PublishedLevels

Order = Callable[[Run], tuple[int, ...]]

FASTEST, HIGHEST = "fastest", "highest score"
ORDERS: dict[str, Order] = {FASTEST: lambda run: (run.tick, -run.gold), HIGHEST: lambda run: (-run.score, run.tick)}
"""What runs are ranked by, the smaller the better: the time to the exit, or the score with gold (game.md §1.3)."""


@dataclass(frozen=True)
class Ranked:
    """A run with its place; equal runs share one."""

    place: int
    run: Run


@dataclass(frozen=True)
class Record:
    """A run that was the best of its level when it was added. ``before``: the one that it beat, None for the first."""

    kind: str
    run: Run
    before: Run | None


@dataclass
class Standing:
    """A player's sums. ``medals``: levels by best medal; ``records``: levels led, by what is ranked."""

    player: str
    levels: int = 0
    runs: int = 0
    medals: dict[str, int] = field(default_factory=lambda: dict.fromkeys(MEDALS, 0))
    records: dict[str, int] = field(default_factory=lambda: dict.fromkeys(ORDERS, 0))


class Ranking:
    """Everything that the pages tell of the runs of a folder."""

    def __init__(self, judged: ValidatedRuns, shown: PublishedLevels) -> None:
        self.judged = judged
        self.shown = shown
        self.by_level: dict[str, list[Run]] = defaultdict(list)
        for run in judged.runs:
            self.by_level[run.entry.digest].append(run)

    def table(self, level: str, kind: str) -> list[Ranked]:
        """The best run of each player on a level, in order; of equal ones of a player the one that came first."""
        order = ORDERS[kind]
        best: dict[str, Run] = {}
        for run in self.by_level.get(level, ()):
            if run.player not in best or order(run) < order(best[run.player]):
                best[run.player] = run
        ranked = sorted(best.values(), key=lambda run: (order(run), run.added, run.key))
        keys = [order(run) for run in ranked]
        return [Ranked(keys.index(order(run)) + 1, run) for run in ranked]

    @cached_property
    def tables(self) -> dict[str, dict[str, list[Ranked]]]:
        """All tables, by level and by what is ranked."""
        return {level: {kind: self.table(level, kind) for kind in ORDERS} for level in self.by_level}

    @cached_property
    def records(self) -> list[Record]:
        """Every record that was ever set, the newest first."""
        found = []
        best: dict[tuple[str, str], Run] = {}
        for run in self.judged.runs:
            for kind, order in ORDERS.items():
                before = best.get((run.entry.digest, kind))
                if before is None or order(run)[0] < order(before)[0]:
                    best[run.entry.digest, kind] = run
                    found.append(Record(kind, run, before))
        return found[::-1]

    @cached_property
    def standings(self) -> list[Standing]:
        """All players, who leads most levels first."""
        found: dict[str, Standing] = {}
        for run in self.judged.runs:
            found.setdefault(run.player, Standing(run.player)).runs += 1
        for tables in self.tables.values():
            for kind, table in tables.items():
                for ranked in table:
                    found[ranked.run.player].records[kind] += ranked.place == 1
            for ranked in tables[FASTEST]:
                standing = found[ranked.run.player]
                standing.levels += 1
                if ranked.run.medal:
                    standing.medals[ranked.run.medal] += 1
        return sorted(found.values(), key=lambda each: (-sum(each.records.values()), -each.levels, each.player))

    def of_player(self, player: str) -> list[tuple[Ranked | None, Ranked | None]]:
        """A player's best run of each level, by time and by score, in playing order."""
        found = []
        for level in self.shown.entries:
            places = [self._place(self.tables.get(level, {}).get(kind, ()), player) for kind in ORDERS]
            if any(places):
                found.append((places[0], places[1]))
        return found

    @staticmethod
    def _place(table: Iterable[Ranked], player: str) -> Ranked | None:
        return next((each for each in table if each.run.player == player), None)

    def episode(self, episode: Episode) -> list[tuple[str, int, Sequence[Run]]]:
        """Who has passed every level of an episode: player, sum of the best ticks, and the runs; the fastest first."""
        tables = [self.tables.get(entry.digest, {}).get(FASTEST, []) for entry in episode.levels]
        found = []
        for ranked in tables[0]:
            runs = [place.run for table in tables if (place := self._place(table, ranked.run.player))]
            if len(runs) == len(tables):
                found.append((ranked.run.player, sum(run.tick for run in runs), runs))
        return sorted(found, key=lambda each: (each[1], each[0]))
