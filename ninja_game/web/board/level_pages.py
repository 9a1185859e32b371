"""The pages of levels and of runs, and the parts of all pages of a board: links, tables of any length, drawings."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from functools import partial
from hashlib import sha256
from itertools import pairwise
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.board.categories import FASTEST, HIGHEST, Category
from ninja_game.board.memo import Memo, values_digest
from ninja_game.board.ranking import Leaderboard, Ranked, Ranking
from ninja_game.board.runs import PLAYED, Key, Run
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import shared_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Entry
from ninja_game.runs.compare import SPLIT_EVENTS, RunSplits, SplitRow, aligned, run_splits, split_table, sum_of_best
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.web.board.charts import PLACE, lead_chart, paths, signed, speed_and_keys, steps, swatch
from ninja_game.web.pages.frame import (
    GAME,
    REPLAYS,
    Content,
    Markup,
    Pages,
    joined,
    on_this_page,
    page,
    section,
    table,
    tag,
)
from ninja_game.web.pages.gallery import (
    BOARD,
    PICTURE_HEIGHT,
    PICTURE_WIDTH,
    UP,
    level_page,
    medal_mark,
    page_name,
    path_data,
    picture,
    picture_name,
    place_mark,
    run_page,
    watch_address,
)

PER_PAGE = 100  # rows of a table on one page: a page has at most 100 KB

MAX_NAME = 40  # characters of a name in a table

RUN_HEADS = ("Watch", "Made", "Gold", "Date", "Medal", "File")
LESSER = {"No.", "Behind", "Better by", "Score", "With", "On", *RUN_HEADS[2:], *map(str.capitalize, MEDALS)}
"""Heads of columns that a narrow page leaves out."""
EPISODES = "episodes.html", "Episodes"
LINKS = [
    ("index.html", "Board"), ("players.html", "Players"), ("levels.html", "Levels"), EPISODES,
    ("rejected.html", "Rejected"),
]  # fmt: skip

FIRST = 10  # rows of a table
TOGETHER = 5  # runs side by side
ENOUGH_SPLITS = 5  # with fewer, splits do not show where time is lost
MAX_LEADS = 160  # of a line in a chart
COARSE = 4  # one of so many ticks is compared place by place: all would take a third of the time of a board
MAX_ALIGNED_TICKS = 8000  # ticks of a run; longer ones would take too much memory
MAX_SECONDS = 30 * TICKS_PER_SECOND  # a longer run has fewer rows, some seconds apart
MAX_SPLITS = 60  # rows of splits; beyond it gold is left out

RECORDS = "records"
SPLITS = "splits"
SPLITS_OF = "Seconds, and px per tick; numbers are those in the pictures above"
NEAR = "A run that is nearly somebody else's has no place, until the keeper of the board confirms it. "
HOW_TO_CONFIRM = "The keeper confirms one with: ninja-game board FOLDER --json board.json --confirm FILE"


class _Ranks(NamedTuple):
    """A table of a level: its first ``rows`` without those far behind, these, and near copies that are better."""

    leaderboard: Leaderboard
    rows: list[Ranked]
    far: list[Ranked]
    waiting: list[Ranked]


class LevelPages:
    """A board in ``out/board/``: its pages of levels and runs, and the parts of all its pages.

    ``up``: the path from a page to that folder, "" or UP; ``address``: of ``out``, if it is known; ``around``: a digest
    of the text on every page.
    """

    def __init__(self, out: Path, ranking: Ranking, memo: Memo | None = None, *, address: str = "") -> None:
        self.pages = Pages(out, BOARD, memo)
        self.ranking = ranking
        self.entries = ranking.shown.entries
        self.leaderboard_name = ranking.leaderboard_name
        self.main = ranking.categories[0]
        self.game = f"../{GAME}"
        self.site = address and f"{address}{BOARD}/"
        assisted = [("assisted.html", "Assisted")] if len(ranking.ladders) > 1 else []
        others = [link for link in LINKS[2:] if link != EPISODES or ranking.shown.levels.episodes]
        self.links = [(self.game, "Play"), *LINKS[:2], *assisted, *others]
        self.deeper = [(UP + address, name) for address, name in self.links]
        self.around = values_digest([self.links, self.site])
        self._ghosts: dict[Key, RunSplits] = {}
        self.stems = {run.key: _stem(run) for run in ranking.judged.runs}

    def write_table(
        self,
        name: str,
        title: str,
        caption: str,
        heads: Sequence[str],
        rows: Sequence[Any],
        *before: Content,
        cells: Callable[[Any], tuple[Content, ...]] = tuple,
    ) -> None:
        """A table on as many pages as it needs. ``rows``: plain values; ``cells`` makes their cells.

        Without heads each row is a card.
        """
        up, links = (UP, self.deeper) if "/" in name else ("", self.links)
        current = f"{name}.html"
        parts = [rows[first : first + PER_PAGE] for first in range(0, len(rows), PER_PAGE)] or [()]
        names = [f"{name}{f'-{number}' if number > 1 else ''}.html" for number in range(1, len(parts) + 1)]
        turns = [
            tag("a", f"Page {number}", href=up + file, aria_label=f"{title}, page {number} of {len(names)}")
            for number, file in enumerate(names, 1)
        ]
        for number, (file, part) in enumerate(zip(names, parts, strict=True)):
            lead = () if number else before
            others = joined(*(joined(turn, " ") for turn in turns if turn is not turns[number]))
            more = tag("p", others, class_="pages") if others else None

            def content(part: Sequence[Any] = part, lead: Sequence[Content] = lead, more: Content = more) -> str:
                rows = map(cells, part)
                shown = table(caption, heads, rows, LESSER) if heads else cards(caption, (row[0] for row in rows))
                return page(title, *lead, shown, more, up=up, links=links, current=current)

            self.pages.make(file, [title, caption, heads, part, lead, more, links], content)

    def watch_link(self, runs: Sequence[Run], up: str, text: str = "Watch", colours: Sequence[int] = ()) -> Markup:
        """A link that watches a run, the others as ghosts; ``colours``: of all, by number, if not in their order."""
        marks = [f"-{number}" for number in colours] or [""] * len(runs)
        stems = (self.stems[run.key] + mark for run, mark in zip(runs, marks, strict=True))
        address = watch_address(up + self.game, *stems)
        said = f"{text}: {runs[0].player} on {runs[0].entry.title}"
        return tag("a", text, href=address, aria_label=said, class_="watch" if text == "Watch" else None)

    def run_link(self, run: Run, up: str, text: str = "") -> Markup:
        """A link to the page of a run with the text ``text``, such as its time; by default to its replay."""
        address, label = f"{up}../{REPLAYS}/{self.stems[run.key]}", f"{run.player} on {run.entry.title}"
        if text:
            return tag("a", text, href=f"{address}.html", aria_label=f"{text}: {label}")
        return tag("a", "File", href=f"{address}.txt", download=True, aria_label=f"File: {label}")

    def behind(self, category: Category, row: Ranked, first: Ranked, word: str = "") -> str:
        """By how much a run is behind the first, or the criterion that decides. ``word``: behind a number."""
        if not row.place or row is first:
            return ""
        if row.values == first.values:
            return "equal" + ", later in" * (row.run.added > first.run.added)
        return category.difference(row.behind) + word if row.behind else category.decided(row.values, first.values)

    def write_run_page(self, run: Run, beside: Sequence[Run]) -> None:
        """``beside``: the runs of the level that are shown side by side."""
        stem, title = self.stems[run.key], f"{self.shown_name(run.player)} on {run.entry.title}"
        ranks, links, rival = list[tuple[str, str]](), list[Markup](), None
        for leaderboard, rows, number in self.ranking.places.get(run.key, ()):
            row, first = rows[number], rows[0]
            if number >= FIRST:
                continue  # else one new run would change the pages of many
            rival = rival or first.run
            if row.place:
                late = self.behind(leaderboard[1], row, first, " behind")
                ranks.append((self.leaderboard_name(leaderboard), f"place {row.place}" + f", {late}" * bool(late)))
            if number and not links:
                links.append(self.watch_link([run, first.run], "", f"Watch with {self.shown_name(first.run.player)}"))
        links.append(tag("a", "All runs of the player", href=f"{UP}{BOARD}/{player_page(run.player)}.html"))
        if run in beside and len(beside) > 1:
            links.append(tag("a", "Splits", href=f"{UP}{BOARD}/{page_name(run.level)}#{SPLITS}"))
        keys = f"{counted(run.presses, 'press', 'presses')}, {counted(run.jumps, 'jump')}"
        gold, made = f"{run.gold} of {run.entry.all_gold}", run.made or "unknown"
        facts = [("Time", FASTEST.measured(run.tick)), *ranks, ("Score", HIGHEST.measured(-run.score)), ("Gold", gold),
                 ("Medal", run.medal), ("Keys", keys), ("Made", made), ("Date", run.day),
                 ("Remark", run.remark)]  # fmt: skip

        def content() -> str:
            drawn, below = self._of_run(run, rival)
            more = joined(*(tag("p", link) for link in links))
            return run_page(run.entry, stem, title, facts, BOARD, self.game, self.links, self.site, drawn, more, below)

        self.pages.make(f"{stem}.html", [title, facts, links, self.around], content, replay=True)

    def _of_run(self, run: Run, rival: Run | None) -> tuple[Markup, Markup]:
        """The path of a run, and its sections. ``rival``: the first run of a table; without it there are no splits.

        They would take most of the time of a large board.
        """
        beside = [run, *([rival] if rival.key != run.key else [])] if rival else []
        ghosts, name = [*map(self._ghost, beside)], self.shown_name(run.player)
        positions = ghosts[0].positions if ghosts else run.positions
        speeds = np.hypot(*np.diff(positions, axis=0, prepend=positions[:1]).T)
        rows = [row for row in _split_rows(ghosts) if row.ticks[0] is not None] if ghosts else []
        ticks, lines = [row.ticks[0] or 0 for row in rows], list[tuple[Content, ...]]()
        for number, (tick, row) in enumerate(zip(ticks, rows, strict=True), 1):
            other = row.ticks[1] if len(row.ticks) > 1 else None
            about = seconds_text(tick), f"{speeds[tick]:.2f}", "" if other is None else signed(tick - other)
            lines.append((tag("a", number, href=f"#{PLACE}{number}"), row.split.kind, *about))
        where, splits = None, None
        if lines:
            first = self.shown_name(beside[-1].player)
            heads = "No.", "Split", "Time", "Speed", f"Later than {first}"
            splits = section("Splits", table(SPLITS_OF, heads, lines))
        if len(ghosts) > 1:
            where = section("Where time goes", *_where_time_goes([(first, ghosts[1], 1), (name, ghosts[0], 0)]))
        best = int(speeds.argmax())
        fast = f"Fastest at {seconds_text(best)} s: {speeds[best]:.2f} px per tick; {speeds.mean():.2f} on average."
        chart = speed_and_keys(speeds, run.inputs, ticks)
        image, places = f"{UP}{BOARD}/{picture_name(run.level)}", [(row.split.x, row.split.y) for row in rows]
        drawn = paths(image, [(name, path_data(positions))], places)
        return drawn, joined(section("Speed and keys", tag("p", fast), *chart), where, splits)

    def shown_name(self, player: str) -> str:
        """A player's name in a table, with the earlier player whose name looks like it."""
        first = self.ranking.judged.alike.get(player)
        return shown_text(player, MAX_NAME) + (f" (not {shown_text(first, MAX_NAME)})" if first else "")

    def player_link(self, player: str, up: str = "") -> Content:
        return tag("a", self.shown_name(player), href=f"{up}{player_page(player)}.html") if player else ""

    def run_cells(self, run: Run, *results: Content, timed: bool = True, mark: Content = None) -> tuple[Content, ...]:
        """Cells of a run, for heads that end in RUN_HEADS.

        ``timed``: with its medal, which is for the time; ``mark``: before the player's name.
        """
        gold, linked = f"{run.gold} of {run.entry.all_gold}", self.run_link(run, UP, str(results[0]))
        medal = medal_mark(run.medal if timed else "")
        about = made_text(run), gold, run.day, medal, self.run_link(run, UP)
        others = f" with {shown_text(run.co_authors, MAX_NAME)}" if run.co_authors else None
        said = tag("summary", "Near copy" if run.near else "Remark")
        note = tag("details", said, run.remark, class_="note") if run.remark else None
        return (
            joined(mark, self.player_link(run.player, UP), others, note),
            linked,
            *results[1:],
            self.watch_link([run], UP),
            *about,
        )

    def shown_value(self, category: Category, run: Run) -> str:
        """The number that ranks a run, as text; "" if it is not in the category."""
        values = self.ranking.values(category, run)
        return category.text(values[0]) if values else ""

    # --- levels ---

    def write_level(self, entry: Entry) -> None:
        """A level's page, the list of all its runs, and their pages and files."""
        digest, named, runs = entry.digest, entry.named, self.ranking.by_level.get(entry.digest, [])
        rows: list[list[Any]] = [
            [self.stems[run.key], run.added, run.remark, run.near, run.medal, run.tick] for run in runs
        ]
        categories = [[category.name, category.rank, category.when] for category in self.ranking.categories]
        about = [named.name, named.author, named.comment, entry.episode, repr(entry.pars), digest, self.ranking.ladders]

        def content() -> str:
            top, drawn, more = self._runs(entry)
            return level_page(entry, {}, UP + self.game, self.deeper, more, site=self.site, top=top, drawn=drawn)

        self.pages.make(picture_name(digest), digest, lambda: picture(named.level))
        self.pages.make(page_name(digest), [about, rows, categories, self.deeper, self.site], content)
        known = {self.stems[run.key]: run for run in runs}

        def cells(row: Sequence[Any]) -> tuple[Content, ...]:
            run = known[row[0]]
            return self.run_cells(run, seconds_text(run.tick), seconds_text(run.score))

        splits = self.ranking.side_by_side(digest, TOGETHER)[1] if runs else []
        for run in runs:
            self.pages.make(f"{self.stems[run.key]}.txt", self.stems[run.key], partial(_text, run), replay=True)
            self.write_run_page(run, splits)
        for run in runs:
            run.folder.forget(run.key)
        self._ghosts.clear()
        if runs:
            heads, back = ("Player", "Time", "Score", *RUN_HEADS), tag("a", "The level", href=UP + page_name(digest))
            name, caption = f"levels/{digest[:16]}-runs", "All runs, the fastest first"
            ordered = sorted(rows, key=itemgetter(-1))
            self.write_table(name, entry.title, caption, heads, ordered, tag("p", back), cells=cells)

    def _runs(self, entry: Entry) -> tuple[Content, Content, Content]:
        """The links to the tables, the paths of the first runs over the level, and all sections below."""
        tables = self.ranking.tables.get(entry.digest, {})
        if not tables:
            return None, None, section("Runs", tag("p", "Nobody has passed this level here yet."))
        said = f"All runs: {len(self.ranking.by_level[entry.digest])}"
        link = tag("p", tag("a", said, href=f"{entry.digest[:16]}-runs.html"))
        category, first_runs = self.ranking.side_by_side(entry.digest, TOGETHER)
        drawn, beside = self._side_by_side(category, first_runs)
        marks = {run.key: swatch(number) for number, run in enumerate(first_runs)} if beside else {}
        fell = [each for each in tables if len(self.ranking.history[entry.digest, each]) > 1]
        first, *others = [self._progression(entry, each, RECORDS * (not at)) for at, each in enumerate(fell)] or [None]
        folded = tag("details", tag("summary", "How the other records went"), *others) if others else None
        merged: dict[Any, list[_Ranks]] = defaultdict(list)
        for each, table_ in tables.items():
            far, rows = [row for row in table_ if row.far], [row for row in table_ if not row.far][:FIRST]
            ranks = _Ranks(each, rows, far, self.ranking.waiting(entry.digest, each, table_))
            merged[each[0], *((row.place, row.run.key) for row in rows)].append(ranks)
        shown, leaders = list[Content](), dict[Leaderboard, Markup]()
        for number, same in enumerate(merged.values(), 1):
            shown.append(self._table(same, marks, anchor := f"ranks-{number}"))
            shown.append(self._said_of("More than twice as slow", [row for each in same for row in each.far]))
            shown.append(self._said_of("Better, and waiting", [row for each in same for row in each.waiting]))
            leaders |= {each.leaderboard: self._leader(each, anchor) for each in same}
        near = any(row.run.near for same in merged.values() for each in same for row in (*each.rows, *each.waiting))
        leads = [(each, each.capitalize()) for each, content in ((RECORDS, first), (SPLITS, beside)) if content]
        note = tag("p", NEAR, tag("a", "What waits", href=f"{UP}waiting.html")) if near else None
        top = tag("ul", *(leaders[each] for each in tables), class_="cards"), on_this_page(leads) if leads else None
        return joined(*top), drawn, joined(*shown, note, link, first, folded, beside)

    def _said_of(self, what: str, rows: Sequence[Ranked]) -> Content:
        """The remarks below a table about runs that are not in it, each once."""
        said = [
            f"{self.shown_name(run.player)} {seconds_text(run.tick)} with {run.gold} gold"
            for run in {row.run.key: row.run for row in rows[:FIRST]}.values()
        ]
        return tag("p", f"{what}: {', '.join(said)}.") if said else None

    def _leader(self, ranks: _Ranks, anchor: str) -> Markup:
        """Who leads a table, and a link to it; where all wait for confirmation, how many do."""
        leaderboard, best = ranks.leaderboard, ranks.rows[0]
        link = tag("a", self.leaderboard_name(leaderboard), href=f"#{anchor}")
        if best.place != 1:
            number = len(self.ranking.tables[best.run.level][leaderboard])
            waits = tag("a", counted(number, "run waits", "runs wait"), href=f"{UP}waiting.html")
            return tag("li", link, tag("p", waits, class_="facts"), class_="card leader")
        result, run = tag("strong", leaderboard[1].measured(best.values[0])), best.run
        about = tag("p", self.player_link(run.player, UP), run.day, self.watch_link([run], UP), class_="facts")
        return tag("li", link, result, about, class_="card leader")

    def _table(self, same: Sequence[_Ranks], marks: Mapping[Key, Content], anchor: str) -> Markup:
        """A table of categories with the same runs in order. ``marks``: colours of the runs in the picture."""
        rows, categories = [], [each.leaderboard[1] for each in same]
        several = len(same) > 1
        heads = [each.name if several and each.unit == "Value" else each.unit for each in categories]
        names = [*dict.fromkeys(heads)]  # a time is the same in all categories
        for ranked in zip(*(each.rows for each in same), strict=True):
            place, run = ranked[0].place, ranked[0].run
            results = [categories[at].text(ranked[at].values[0]) for at in map(heads.index, names)]
            late = self.behind(categories[0], ranked[0], same[0].rows[0])
            cells = self.run_cells(run, *results, late, timed=FASTEST.unit in heads, mark=marks.get(run.key))
            rows.append((place_mark(place), *cells))
        lesser = LESSER.union(names[1:]) - {names[0]}
        best = table("Best run of each player", ("Place", "Player", *names, "Behind", *RUN_HEADS), rows, lesser)
        return section("; ".join(self.leaderboard_name(each.leaderboard) for each in same), best, anchor=anchor)

    def _progression(self, entry: Entry, leaderboard: Leaderboard, anchor: str) -> Content:
        category, runs = leaderboard[1], self.ranking.history[entry.digest, leaderboard]
        moved = "rose" if category.rising else "fell"
        numbers = [self.ranking.number(category, run) for run in runs]
        better = ["", *(category.gain(before - now) for before, now in pairwise(numbers))]
        rows = [
            (run.moment, self.player_link(run.player, UP), category.text(number), gain, self.watch_link([run], UP))
            for run, number, gain in zip(runs, numbers, better, strict=True)
        ]
        # Several records of one moment count as one.
        moments = [datetime.fromisoformat(run.added).timestamp() if run.added else 0.0 for run in runs]
        start, end = (f"{category.text(numbers[at])} {runs[at].day}" for at in (0, -1))
        said = f"The record {moved} from {start} to {end} in {counted(len(runs) - 1, 'step')}"
        heights = [-number if category.rising else number for number in numbers]  # as they are shown
        named = [f"{self.shown_name(run.player)}: {row[2]} {run.day}" for run, row in zip(runs, rows, strict=True)]
        # The first records of a level are often runs for gold: their scale would hide all later steps.
        since = next(at for at, number in enumerate(numbers) if not category.far(number, numbers[-1]))
        points = list(zip(moments, heights, strict=True))[since:]
        days = runs[since].day, runs[-1].day
        chart = steps(points, named[since:], category.difference, days, said) if len(points) > 1 else None
        heads = ("Date", "Player", category.unit, "Better by", "Watch")
        title = f"How the record {moved}: {self.leaderboard_name(leaderboard)}"
        ranked = table("Newest first", heads, rows[: -FIRST - 1 : -1], LESSER)
        return section(title, chart, ranked, anchor=anchor or None)

    def _side_by_side(self, category: Category, runs: Sequence[Run]) -> tuple[Markup, Content]:
        """The paths of the first runs of a category; for several runs also links to races of two, and splits."""
        names = [self.shown_name(run.player) + ", assisted" * (run.ladder != PLAYED) for run in runs]
        ghosts = [*map(self._ghost, runs)]
        if len(runs) == 1:
            return paths(UP + picture_name(runs[0].level), [(names[0], path_data(ghosts[0].positions))]), None
        by_time = sorted(zip(names, ghosts, range(len(runs)), strict=True), key=lambda each: each[1].ticks)
        rows = _split_rows([ghost for _, ghost, _ in by_time])
        ways = [(name, path_data(ghost.positions)) for ghost, name in zip(ghosts, names, strict=True)]
        drawn = paths(UP + picture_name(runs[0].level), ways, [(row.split.x, row.split.y) for row in rows])
        said = f"Watch the first {len(runs)} together"
        together = tag("p", f"{category.name}: ", self.watch_link(runs, UP, said))
        every = range(len(runs))
        pairs = [
            (tag("div", swatch(at), " ", names[at], class_="text"), *(self._pair(runs, at, other) for other in every))
            for at in every
        ]
        races = table("Seconds by which the left one is later; a link watches both", ("Run", *names), pairs)
        lines = [
            (tag("a", number, href=f"#{PLACE}{number}"), row.split.kind, *_cells(row))
            for number, row in enumerate(rows, 1)
        ]
        fastest, *others = [name for name, *_ in by_time]
        note = f"Seconds; later than {fastest}: +; numbers are those in the picture"
        splits = table(note, ("No.", "Split", fastest, "Fastest segment", *others), lines)
        best = tag("p", f"Sum of the fastest segments, each from the row above: {seconds_text(sum_of_best(rows))} s.")
        where = _where_time_goes(by_time, tabled=len(rows) < ENOUGH_SPLITS)
        return joined(drawn, together), joined(
            section("Any two of the first", races), section("Splits", splits, best, anchor=SPLITS),
            section("Where time goes", *where) if where else None,
        )  # fmt: skip

    def _ghost(self, run: Run) -> RunSplits:
        """A run with its splits, simulated once for all pages of its level."""
        if run.key not in self._ghosts:
            self._ghosts[run.key] = run_splits(Recording(run.entry.named.level, run.replay), memory="auto")
        return self._ghosts[run.key]

    def _pair(self, runs: Sequence[Run], at: int, other: int) -> Content:
        """A race of two of the runs, in their colours."""
        both = [runs[at], runs[other]]
        return self.watch_link(both, UP, signed(both[0].tick - both[1].tick), (at, other)) if at != other else ""


def _where_time_goes(runs: Sequence[tuple[str, RunSplits, int]], *, tabled: bool = False) -> list[Markup]:
    """Where each named run loses most on the first, the fastest, and a chart of how much later it is on the way.

    The number of a run is that of its colour. ``tabled``: also as a table, at each second of the first.
    """
    (fastest, first, _), *others = runs
    if max(run.ticks for _, run, _ in runs) > MAX_ALIGNED_TICKS:
        return []
    seconds = range(step := TICKS_PER_SECOND * (1 + first.ticks // MAX_SECONDS), first.ticks, step)
    ticks = sorted({*range(0, first.ticks, 1 + first.ticks // MAX_LEADS), *seconds, first.ticks - 1})
    late = [dict(zip(ticks, _leads(first.positions, other.positions, ticks), strict=True)) for _, other, _ in others]
    sentences = []
    for (name, *_), at in zip(others, late, strict=True):
        near = [(0, 0), *((tick, lead) for tick in seconds if (lead := at[tick]) is not None)]
        lost, start, end = max(((b[1] - a[1], a[0], b[0]) for a, b in pairwise(near)), default=(0, 0, 0))
        span = f"between {start // TICKS_PER_SECOND} s and {end // TICKS_PER_SECOND} s of {fastest}"
        sentences += [tag("p", f"{name} loses most {span}: {seconds_text(lost)} s.")] if lost > 0 else []
    caption = f"Seconds by which each is later where {fastest} is then; a gap: it goes another way"
    lines = [(number, [*at.values()]) for (*_, number), at in zip(others, late, strict=True)]
    legend = tag("ul", *(tag("li", swatch(number), f" {name}") for name, _, number in others), class_="facts")
    shown = [*sentences, tag("p", caption, class_="faint"), lead_chart(ticks, lines, caption), legend]
    rows = [
        (f"{tick // TICKS_PER_SECOND} s", *("" if at[tick] is None else signed(at[tick] or 0) for at in late))
        for tick in seconds
    ]
    rows = [row for row in rows if tabled and any(row[1:])]
    heads = [name for name, *_ in runs]
    return [*shown, tag("details", tag("summary", "As a table"), table(caption, heads, rows))] if rows else shown


def _leads(ours: NDArray[np.float64], theirs: NDArray[np.float64], ticks: Sequence[int]) -> list[int | None]:
    """By how many ticks the other run is later at the places of these ticks; None: it is not near there."""
    partner = aligned(ours[::COARSE], theirs[::COARSE])
    leads: list[int | None] = []
    for tick in ticks:
        start = max(0, COARSE * (int(partner[tick // COARSE]) - 1))
        apart = np.hypot(*(theirs[start : start + 2 * COARSE + 1] - ours[tick]).T)
        leads.append(start + int(apart.argmin()) - tick if partner[tick // COARSE] >= 0 else None)
    return leads


def _split_rows(runs: Sequence[RunSplits]) -> list[SplitRow]:
    """Rows of splits of the first, the fastest; gold that only others take is left out, all of it where too much."""
    gold, rows = SPLIT_EVENTS[0], split_table(runs, runs[0])
    if len(rows) > MAX_SPLITS:
        runs = [replace(run, splits=tuple(split for split in run.splits if split.event != gold)) for run in runs]
        rows = split_table(runs, runs[0])
    return [row for row in rows if row.ticks[0] is not None or row.split.event != gold][:MAX_SPLITS]


def _cells(row: SplitRow) -> Iterator[str]:
    """The first run's time, the fastest segment, and the delays of the others."""
    first, *others = row.ticks
    yield from ("" if ticks is None else seconds_text(ticks) for ticks in (first, row.best_segment))
    for tick in others:
        yield "" if tick is None else seconds_text(tick) if first is None else signed(tick - first)


def player_page(player: str) -> str:
    """The file of a player's page, without its ending: an untrusted name never becomes a path."""
    return f"players/{sha256(player.encode('utf-8', 'replace')).hexdigest()[:16]}"


def level_link(entry: Entry, up: str = "") -> Markup:
    return tag("a", shown_text(entry.title, MAX_NAME), href=up + page_name(entry.digest))


def card(entry: Entry, *facts: Content) -> Markup:
    """A level with its picture, both links, and lines about it. For a page in the board's own folder."""
    image = tag(
        "img", src=picture_name(entry.digest), alt="", width=PICTURE_WIDTH, height=PICTURE_HEIGHT, loading="lazy"
    )
    number = tag("span", f"Level {entry.number}", class_="number") if entry.number else None
    lines = (tag("p", each, class_="facts") for each in facts if each)
    return tag("li", image, tag("h3", number, level_link(entry)), *lines, class_="card")


def cards(caption: str, each: Iterable[Content]) -> Markup:
    return joined(tag("p", caption, class_="faint"), tag("ul", *each, class_="cards"))


def made_text(run: Run) -> Markup:
    return tag("span", run.made or "unknown", class_="made")


def _text(run: Run) -> str:
    return shared_text(run.replay, run.entry.named.level)


def _stem(run: Run) -> str:
    """The stem of the file in ``replays`` with a run, derived from the file's content."""
    author = run.entry.named.author
    held = run.digest, str(run.record), run.player, run.entry.title, author, run.made, run.co_authors, run.level
    return sha256("\0".join(held).encode("utf-8", "replace")).hexdigest()[:16]
