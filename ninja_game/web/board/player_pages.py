"""The board's pages of players: lists by ladder, runs, records, and what a player could gain."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from operator import itemgetter
from statistics import mean, median
from typing import Any

from ninja_game.board.ranking import Standing
from ninja_game.board.report import unnamed_hint
from ninja_game.board.runs import Run
from ninja_game.files.shown_text import counted
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.formats.run_time import seconds_text
from ninja_game.web.board.parts import LESSER, Parts, linked_level, made_text, player_page, stack
from ninja_game.web.pages.frame import Content, Markup, definitions, section, table, tag
from ninja_game.web.pages.gallery import UP, medal_mark

GAINS = "By how much could be won"
BY_LEVELS = "By levels led in all categories together, then by levels passed"


class PlayerPages:
    """Writes the pages of a board's players."""

    def __init__(self, parts: Parts) -> None:
        self.parts, self.ranking, self.main = parts, parts.ranking, parts.main

    def write(self) -> None:
        parts = self.parts
        sums: dict[str, list[Content]] = defaultdict(list)
        pages = dict(zip(self.ranking.ladders, ("players", "assisted"), strict=False))
        for ladder, standings in self.ranking.standings.items():
            leads: list[Content] = [
                tag("a", self.title(other), href=f"{pages[other]}.html") for other in pages if other != ladder
            ]
            leads += filter(None, [unnamed_hint(self.ranking.judged)])
            title, rows = self.title(ladder), [*map(self._cells, standings)]
            parts.write_table(pages[ladder], title, BY_LEVELS, self._heads(), rows, *(tag("p", lead) for lead in leads))
            for standing in standings:
                sums[standing.player].append(_sums(ladder, self.main.name, standing))
        runs: dict[str, list[Run]] = defaultdict(list)
        for run in self.ranking.judged.runs:
            runs[run.player].append(run)
        held, lost = self._records()
        heads = ("Level", "Record", "Result", "Date", "Lost to", "With", "On")
        for player, own in runs.items():
            name, records = player_page(player), held[player] + lost[player]
            note = f"Records: {len(held[player])} held, {len(lost[player])} lost"
            link = tag("p", tag("a", note, href=f"{UP}{name}-records.html")) if records else None
            gains = self._gains(own)
            ahead = tag("p", tag("a", f"{GAINS}: {counted(len(gains), 'level')}", href=f"{UP}{name}-gains.html"))
            waits = tag("p", waiting) if (waiting := parts.waiting_link(own)) else None
            self._runs_of(player, own, [*sums[player], link, ahead if gains else None, waits])
            back = tag("p", tag("a", "All runs of the player", href=f"{UP}{name}.html"))
            if gains:
                names = ("Level", self.main.unit, "Behind", "Place", "First", "Watch")
                parts.write_table(f"{name}-gains", player, f"{GAINS}, in {self.main.name}", names, gains, back)
            if records:
                parts.write_table(f"{name}-records", player, "Records held, then those lost", heads, records, back)

    def _heads(self) -> list[str]:
        names = [f"First, {category.name}" for category in self.ranking.categories]
        return ["Player", "Levels", "Runs", *names, *map(str.capitalize, MEDALS)]

    def short_list(self, standings: Sequence[Standing]) -> Markup:
        return table(BY_LEVELS, self._heads(), map(self._cells, standings), LESSER)

    def title(self, ladder: str) -> str:
        """The title of a list of players, with the ladder if there are two."""
        return f"Players, {ladder}" if len(self.ranking.ladders) > 1 else "Players"

    def _cells(self, row: Standing) -> tuple[Content, ...]:
        parts = self.parts
        firsts = [row.records[category] for category in self.ranking.categories]
        return (parts.player_link(row.player), row.levels, row.runs, *firsts, *(n or "" for n in row.medals.values()))

    def _gains(self, runs: Sequence[Run]) -> list[tuple[Content, ...]]:
        """Rows of a player's runs that are behind the first of the main category, the farthest first."""
        parts = self.parts
        gains = []
        for run in runs:
            for part, rows, number in self.ranking.places.get(run.key, ()):
                row, first = rows[number], rows[0].run
                if part[1] == self.main and row.place and row.behind and not row.is_far:
                    result = (parts.run_link(run, UP, self.main.text(row.values[0])), self.main.difference(row.behind))
                    both = parts.player_link(first.player, UP), parts.watch_link([run, first], UP, "Watch both")
                    gains.append((row.behind, (linked_level(run.entry, UP), *result, row.place, *both)))
        return [cells for _, cells in sorted(gains, key=itemgetter(0), reverse=True)]

    def _records(self) -> tuple[dict[str, list[tuple[Content, ...]]], dict[str, list[tuple[Content, ...]]]]:
        """The rows of records held, and of records lost, by player."""
        held: dict[str, list[tuple[Content, ...]]] = defaultdict(list)
        lost: dict[str, list[tuple[Content, ...]]] = defaultdict(list)
        for (level, part), runs in self.ranking.history.items():
            last = {run.player: number for number, run in enumerate(runs)}
            results = [self.parts.run_link(run, UP, self.parts.shown_value(part[1], run)) for run in runs]
            record = linked_level(self.ranking.shown.entries[level], UP), self.ranking.leaderboard_name(part)
            for player, number in last.items():
                by = runs[number + 1] if number + 1 < len(runs) else None
                loss = (self.parts.player_link(by.player, UP), results[number + 1], by.day) if by else ("", "", "")
                (lost if by else held)[player].append((*record, results[number], runs[number].day, *loss))
        return held, lost

    def _runs_of(self, player: str, runs: Sequence[Run], lead: Sequence[Content]) -> None:
        """A player's page: the sums, and all runs in playing order."""
        order = {level: number for number, level in enumerate(self.ranking.shown.entries)}
        runs_by_stem = {self.parts.stems[run.key]: run for run in runs}

        def cells(row: Sequence[Any]) -> tuple[Content, ...]:
            run = runs_by_stem[row[0]]
            gold = f"{run.gold} of {run.entry.all_gold}"
            time = self.parts.run_link(run, UP, seconds_text(run.tick))
            result = time, self.parts.watch_link([run], UP), medal_mark(run.medal), seconds_text(run.score), gold
            leads = made_text(run), run.day, self.parts.run_link(run, UP)
            places = stack(*row[3]) if row[3] else ""
            return (row[1], linked_level(run.entry, UP), *result, places, *leads)

        rows = [
            [self.parts.stems[run.key], run.entry.number, run.medal, self._places(run), run.day]
            for run in sorted(runs, key=lambda run: (order[run.level], run.added, run.key))
        ]
        heads = ("No.", "Level", "Time", "Watch", "Medal", "Score", "Gold", "Places", "Made", "Date", "File")
        self.parts.write_table(
            player_page(player), player, "All runs", heads, rows, *lead, cells=cells, lesser={*LESSER, "Made"}
        )

    def _places(self, run: Run) -> list[str]:
        """Its place in each category, and its distance from the first; whether it waits."""
        waits = ["waits for confirmation"] if run.waits else []
        for part, rows, number in self.ranking.places.get(run.key, ()):
            place = self.parts.place(part[1], rows[number], rows[0])
            waits += [f"{self.ranking.leaderboard_name(part)}: {place}"] if place else []
        return waits


def _sums(ladder: str, category: str, standing: Standing) -> Markup:
    """A player's sums in a ladder, and ranks in a category."""
    facts: list[tuple[str, Content]] = [("Runs", standing.runs), ("Levels", standing.levels)]
    if standing.ranks:
        facts += [
            (f"First in {category}", standing.ranks.count(1)),
            ("Total of ranks", f"{sum(standing.ranks)}, {mean(standing.ranks):.2f} on average"),
        ]
    if standing.behind:
        facts.append(("Behind the fastest, in the median", f"{100 * median(standing.behind):.1f}%"))
    return section(ladder.capitalize(), definitions(facts))
