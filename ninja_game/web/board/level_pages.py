"""What a level's page tells of its runs: tables, how the record fell, the first runs side by side."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from itertools import compress, pairwise
from typing import Any

from ninja_game.files.shown_text import counted
from ninja_game.formats.recording import Recording
from ninja_game.formats.run_time import seconds_text
from ninja_game.player.catalogue import Entry
from ninja_game.runs.compare import SPLIT_EVENTS, RunSplits, SplitRow, run_splits, split_name, split_table, sum_of_best
from ninja_game.web.board.charts import path_data, paths, steps, swatch
from ninja_game.web.board.parts import RUN_HEADS, UP, Parts, signed
from ninja_game.web.board.ranking import Part, Ranked
from ninja_game.web.board.rules import FASTEST
from ninja_game.web.board.runs import Run
from ninja_game.web.pages.frame import Content, Markup, joined, section, table, tag
from ninja_game.web.pages.gallery import level_page, page_name, picture, picture_name

FIRST, TOGETHER, MOST_SPLITS = 10, 5, 60
"""Rows of a table; runs side by side; rows of splits, and where there were more, gold is left out."""

RECORDS, SPLITS = "records", "splits"
NEAR = "A run that is nearly somebody else's is never first, until the keeper of the board confirms it."


class LevelPages(Parts):
    """Adds the pages of levels."""

    def level(self, entry: Entry) -> None:
        """A level's page, and the list of all its runs."""
        digest, named, runs = entry.digest, entry.named, self.ranking.by_level.get(entry.digest, [])
        told: list[list[Any]] = [[self.stems[run.key], run.added, run.remark, run.near, run.tick] for run in runs]
        rules = [[each.name, each.rank, each.when] for each in self.ranking.categories]
        about = [named.name, named.author, named.comment, entry.episode, repr(entry.pars), digest, self.ranking.ladders]

        def content() -> str:
            top, drawn, more = self._runs(entry)
            return level_page(entry, {}, UP + self.game, self.deeper, more, site=self.site, top=top, drawn=drawn)

        self.pages.make(picture_name(digest), digest, lambda: picture(named.level))
        self.pages.make(page_name(digest), [about, told, rules, self.deeper, self.site], content)
        known = {self.stems[run.key]: run for run in runs}

        def cells(row: Sequence[Any]) -> tuple[Content, ...]:
            run = known[row[0]]
            return self.run(run, seconds_text(run.tick), seconds_text(run.score))

        if runs:
            heads, back = ("Player", "Time", "Score", *RUN_HEADS), tag("a", "The level", href=UP + page_name(digest))
            rows = sorted(told, key=lambda row: row[-1])
            name, caption = f"levels/{digest[:16]}-runs", "All runs, the fastest first"
            self.list(name, entry.title, caption, heads, rows, tag("p", back), cells=cells)

    def _runs(self, entry: Entry) -> tuple[Content, Content, Content]:
        """What leads to the tables, the paths of the first runs over the level, and all that stands below."""
        tables = self.ranking.tables.get(entry.digest, {})
        if not tables:
            return None, None, section("Runs", tag("p", "Nobody has passed this level here yet."))
        said = f"All runs: {len(self.ranking.by_level[entry.digest])}"
        link = tag("p", tag("a", said, href=f"{entry.digest[:16]}-runs.html"))
        part, ranked = next(iter(tables.items()))
        runs = [each.run for each in ranked[:TOGETHER]]
        drawn, beside = self._side_by_side(runs, self.part_name(part)) if len(runs) > 1 else (None, None)
        fell = [each for each in tables if len(self.ranking.history[entry.digest, each]) > (each != part)]
        first, *others = [self._progression(entry, each, RECORDS * (not at)) for at, each in enumerate(fell)] or [None]
        folded = tag("details", tag("summary", "How the other records went"), *others) if others else None
        same: dict[str, dict[Part, list[Ranked]]] = defaultdict(dict)
        for each, rows in tables.items():
            same[f"{each[0]} {[(row.place, row.run.key) for row in rows[:FIRST]]}"][each] = rows[:FIRST]
        told: set[str] = set()
        shown, leads = list[Content](), list[tuple[str, str]]()
        for number, parts in enumerate(same.values(), 1):
            shown.append(self._table(parts, told, anchor := f"ranks-{number}"))
            for each, (best, *_) in parts.items():
                leader = f": {self.name(best.run.player)}, {each[1].text(best.values[0])}" if best.place == 1 else ""
                leads.append((anchor, self.part_name(each) + leader))
        near = any(row.run.near for rows in tables.values() for row in rows[:FIRST])
        leads += [(each, each.capitalize()) for each, content in ((RECORDS, first), (SPLITS, beside)) if content]
        links = [tag("li", tag("a", text, href=f"#{anchor}")) for anchor, text in leads]
        contents = tag("nav", tag("ul", *links), class_="contents", aria_label="On this page")
        return contents, drawn, joined(*shown, tag("p", NEAR) if near else None, link, first, folded, beside)

    def _table(self, parts: Mapping[Part, Sequence[Ranked]], told: set[str], anchor: str) -> Markup:
        """A table of categories with the same runs in order, of filled columns. ``told``: remarks of tables above."""
        rows, categories = [], [category for _, category in parts]
        timed = any(category.unit == FASTEST.unit for category in categories)
        for same in zip(*parts.values(), strict=True):
            place, run = same[0].place, same[0].run
            shown = replace(run, remark="as above") if run.remark in told else run
            results = [category.text(each.values[0]) for category, each in zip(categories, same, strict=True)]
            rows.append((place, *self.run(shown, *results, timed=timed)))
            told |= {run.remark} - {""}
        names = [category.name if len(parts) > 1 else category.unit for category in categories]
        heads = ("Place", "Player", *names, *RUN_HEADS)
        filled = [any(cell != "" for cell in column) for column in zip(*rows, strict=True)]
        lines, title = [compress(row, filled) for row in rows], "; ".join(map(self.part_name, parts))
        return section(title, table("Best run of each player", compress(heads, filled), lines), anchor=anchor)

    def _progression(self, entry: Entry, part: Part, anchor: str) -> Content:
        category, runs = part[1], self.ranking.history[entry.digest, part]
        moved = "rose" if category.rising else "fell"
        numbers = [self.ranking.number(category, run) for run in runs]
        better = ["", *(category.difference(before - now) for before, now in pairwise(numbers))]
        rows = [
            (run.moment, self.player_link(run.player, UP), category.text(number), gain, self.watch([run], UP))
            for run, number, gain in zip(runs, numbers, better, strict=True)
        ]
        chart = None
        if len(runs) > 1:
            moments = [datetime.fromisoformat(run.added).timestamp() if run.added else 0.0 for run in runs]
            if moments[0] == moments[-1]:
                moments = [*map(float, range(len(runs)))]
            start, end = (f"{category.text(numbers[at])} {runs[at].day}" for at in (0, -1))
            said = f"The record {moved} from {start} to {end} in {counted(len(runs) - 1, 'step')}"
            heights = [-number if category.rising else number for number in numbers]
            chart = steps(list(zip(moments, heights, strict=True)), start, end, said)
        heads = ("Date", "Player", category.unit, "Better by", "Watch")
        title = f"How the record {moved}: {self.part_name(part)}"
        return section(title, chart, table("Newest first", heads, rows[: -FIRST - 1 : -1]), anchor=anchor or None)

    def _side_by_side(self, runs: Sequence[Run], name: str) -> tuple[Markup, Markup]:
        """The first runs of what is called so: their paths; any two of them, and their splits."""
        names = [self.name(run.player) for run in runs]
        found = [run_splits(Recording(run.entry.named.level, run.replay), memory="auto") for run in runs]
        known = [
            run.folder.drawn.get(run.key) or path_data(each.positions) for run, each in zip(runs, found, strict=True)
        ]
        drawn = paths(UP + picture_name(runs[0].level), list(zip(names, known, strict=True)))
        together = tag("p", self.watch(runs, UP, f"Watch the first {len(runs)} together"))
        pairs = [
            (joined(swatch(number), " ", names[number]), *(self._pair(run, other) for other in runs))
            for number, run in enumerate(runs)
        ]
        races = table("Seconds by which the left one is later; a link watches both", ("Run", *names), pairs)
        rows = _split_rows(found)
        lines = [(split_name(str(row.split)), *_cells(row)) for row in rows]
        splits = table("Seconds; later than the first: +", ("Split", names[0], "Fastest segment", *names[1:]), lines)
        best = tag("p", f"Sum of the fastest segments, each from the row above: {seconds_text(sum_of_best(rows))} s.")
        drawn = joined(drawn, tag("p", f"The first {len(runs)} runs: {name}"), together)
        return drawn, joined(section("Any two of the first", races), section("Splits", splits, best, anchor=SPLITS))

    def _pair(self, run: Run, other: Run) -> Content:
        return "" if run is other else self.watch([run, other], UP, signed(run.tick - other.tick))


def _split_rows(found: Sequence[RunSplits]) -> list[SplitRow]:
    """Rows of splits against the first run; gold that only others take is left out, all of it where it is too much."""
    gold, rows = SPLIT_EVENTS[0], split_table(found, found[0])
    if len(rows) > MOST_SPLITS:
        found = [replace(run, splits=tuple(each for each in run.splits if each.event != gold)) for run in found]
        rows = split_table(found, found[0])
    return [row for row in rows if row.ticks[0] is not None or row.split.event != gold][:MOST_SPLITS]


def _cells(row: SplitRow) -> Iterator[str]:
    """The first run's time, the fastest segment, and how much later the others are."""
    first, *others = row.ticks
    yield from ("" if ticks is None else seconds_text(ticks) for ticks in (first, row.best_segment))
    for tick in others:
        yield "" if tick is None else seconds_text(tick) if first is None else signed(tick - first)
