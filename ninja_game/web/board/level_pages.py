"""A board's pages of levels and of runs; all others are in ``pages``."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from functools import partial
from itertools import pairwise, repeat
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.board.categories import FASTEST, HIGHEST, Category
from ninja_game.board.ranking import Leaderboard, Ranked
from ninja_game.board.runs import PLAYED, Run, RunKey
from ninja_game.files.shown_text import counted
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import shared_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Entry
from ninja_game.runs.compare import aligned
from ninja_game.runs.splits import SPLIT_EVENTS, RunSplits, SplitRow, run_splits, split_table, sum_of_best
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.web.board.charts import PLACE, lead_chart, paths, signed, speed_and_keys, step_chart, swatch
from ninja_game.web.board.parts import LESSER, NEAR, RUN_HEADS, UNKNOWN_ORIGIN, Parts, player_page
from ninja_game.web.pages.frame import Content, Markup, joined, on_this_page, section, table, tag
from ninja_game.web.pages.gallery import BOARD, UP, level_page, page_name, path_data, picture, picture_name, run_page

ROWS_SHOWN = 10  # rows of a table
RUNS_SIDE_BY_SIDE = 5
MIN_SPLITS = 5  # with fewer, splits do not show where time is lost
MAX_LEADS = 160  # points of a line in a chart
COARSE = 4  # one of this many ticks is compared place by place: all would take a third of the time of a board
MAX_ALIGNED_TICKS = 8000  # ticks of a run; longer ones would take too much memory
_MAX_SECONDS = 30 * TICKS_PER_SECOND  # a longer run has fewer rows, some seconds apart
MAX_SPLITS = 60  # rows of splits; beyond it gold is left out

_RECORDS = "records"
SPLITS, RACES = "splits", "races"  # tables that a narrow page makes small
SPLITS_OF = "Seconds, and px per tick; numbers are those in the pictures above"


class _Ranks(NamedTuple):
    """A table of a level: its first ``rows`` without those far behind, these, and runs that wait and are better."""

    leaderboard: Leaderboard
    rows: list[Ranked]
    far: list[Ranked]
    waiting: list[Ranked]


class LevelPages:
    """Writes the pages of levels and runs of a board."""

    def __init__(self, parts: Parts) -> None:
        self.parts, self.ranking = parts, parts.ranking
        self._ghosts: dict[RunKey, RunSplits] = {}
        self._compared: dict[tuple[RunKey, RunKey], list[int | None]] = {}

    def write_run_page(self, run: Run, beside: Sequence[Run]) -> None:
        """Write the page of a run. ``beside``: the runs of the level that are shown side by side."""
        parts = self.parts
        stem = parts.stems[run.key]
        title = f"{parts.shown_name(run.player)} on {run.entry.title}"
        ranks = list[tuple[str, str]]()
        links = list[Markup]()
        rival = None
        for leaderboard, rows, number in self.ranking.places.get(run.key, ()):
            row, first = rows[number], rows[0]
            if number >= ROWS_SHOWN:
                continue  # else one new run would change the pages of many
            rival = rival or first.run
            if place := parts.place(leaderboard[1], row, first):
                ranks.append((self.ranking.leaderboard_name(leaderboard), f"place {place}"))
            if number and not links:
                links.append(parts.watch_link([run, first.run], "", f"Watch with {parts.shown_name(first.run.player)}"))
        links.append(tag("a", "All runs of the player", href=f"{UP}{BOARD}/{player_page(run.player)}.html"))
        if run in beside and len(beside) > 1:
            links.append(tag("a", "Splits", href=f"{UP}{BOARD}/{page_name(run.level)}#{SPLITS}"))
        keys = f"{counted(run.presses, 'press', 'presses')}, {counted(run.jumps, 'jump')}"
        gold, origin = f"{run.gold} of {run.entry.all_gold}", run.made or "unknown"
        facts = [("Time", FASTEST.measured(run.tick)), *ranks, ("Score", HIGHEST.measured(-run.score)), ("Gold", gold),
                 ("Medal", run.medal), ("Keys", keys), ("With", run.co_authors), ("Made", origin), ("Date", run.day),
                 ("Remark", run.remark)]  # fmt: skip

        def content() -> str:
            drawn, below = self._run_sections(run, rival)
            more = joined(*(tag("p", link) for link in links))
            return run_page(
                run.entry, stem, title, facts, folder=BOARD, game=parts.game, links=parts.links, site=parts.site,
                drawn=drawn, more=more, below=below,
            )  # fmt: skip

        parts.pages.make(f"{stem}.html", [title, facts, links, parts.around], content, replay=True)

    def _run_sections(self, run: Run, rival: Run | None) -> tuple[Markup, Markup]:
        """The path of a run, and its sections. ``rival``: the first run of a table; without it there are no splits.

        They would take most of the time of a large board.
        """
        beside = [run] if rival else []
        if rival and rival.key != run.key:
            beside.append(rival)
        ghosts = [*map(self._ghost, beside)]
        name = self.parts.shown_name(run.player)
        positions = ghosts[0].positions if ghosts else run.positions
        speeds = np.hypot(*np.diff(positions, axis=0, prepend=positions[:1]).T)
        rows = [row for row in _split_rows(ghosts) if row.ticks[0] is not None] if ghosts else []
        ticks = [row.ticks[0] or 0 for row in rows]
        lines = list[tuple[Content, ...]]()
        for number, (tick, row) in enumerate(zip(ticks, rows, strict=True), 1):
            other = row.ticks[1] if len(row.ticks) > 1 else None
            about = seconds_text(tick), f"{speeds[tick]:.2f}", "" if other is None else signed(tick - other)
            lines.append((tag("a", number, href=f"#{PLACE}{number}"), row.split.name, *about))
        where, splits = None, None
        if ghosts:
            first = self.parts.shown_name(beside[-1].player)
            heads = "No.", "Split", "Time", "Speed", f"Later than {first}"
            splits = section("Splits", table(SPLITS_OF, heads, lines), anchor=SPLITS)
        if len(ghosts) > 1:
            where = self._where_time_goes([(first, beside[1], 1), (name, run, 0)])
        best = int(speeds.argmax())
        fast = f"Fastest at {seconds_text(best)} s: {speeds[best]:.2f} px per tick; {speeds.mean():.2f} on average."
        chart = speed_and_keys(speeds, run.inputs, ticks)
        image = f"{UP}{BOARD}/{picture_name(run.level)}"
        places = [(row.split.x, row.split.y) for row in rows]
        drawn = paths(image, [(name, path_data(positions))], places)
        return drawn, joined(section("Speed and keys", tag("p", fast), *chart), where, splits)

    def write_level(self, entry: Entry) -> None:
        """A level's page, the list of all its runs, and their pages and files."""
        parts, digest, named = self.parts, entry.digest, entry.named
        runs = self.ranking.by_level.get(digest, [])
        rows: list[list[Any]] = [
            [parts.stems[run.key], run.added, run.remark, run.waits, run.medal, run.tick] for run in runs
        ]
        categories = [[category.name, category.rank, category.when] for category in self.ranking.categories]
        about = [named.name, named.author, named.comment, entry.episode, repr(entry.pars), digest]
        ladders = self.ranking.ladders, self.ranking.unknown

        def content() -> str:
            top, drawn, more = self._level_sections(entry)
            return level_page(entry, {}, UP + parts.game, parts.deeper, more, site=parts.site, top=top, drawn=drawn)

        parts.pages.make(picture_name(digest), digest, lambda: picture(named.level))
        parts.pages.make(page_name(digest), [about, ladders, rows, categories, parts.deeper, parts.site], content)
        runs_by_stem = {parts.stems[run.key]: run for run in runs}

        def cells(row: Sequence[Any]) -> tuple[Content, ...]:
            run = runs_by_stem[row[0]]
            return parts.run_cells(run, seconds_text(run.tick), seconds_text(run.score))

        splits = self.ranking.side_by_side(digest, RUNS_SIDE_BY_SIDE)[1] if runs else []
        for run in runs:
            parts.pages.make(f"{parts.stems[run.key]}.txt", parts.stems[run.key], partial(_text, run), replay=True)
            self.write_run_page(run, splits)
        for run in runs:
            run.folder.forget(run.key)
        self._ghosts.clear()
        self._compared.clear()
        if runs:
            heads = ("Player", "Time", "Score", *RUN_HEADS)
            back = tag("a", "The level", href=UP + page_name(digest))
            name, caption = f"levels/{digest[:16]}-runs", "All runs, the fastest first"
            ordered = sorted(rows, key=itemgetter(-1))
            parts.write_table(name, entry.title, caption, heads, ordered, tag("p", back), cells=cells)

    def _level_sections(self, entry: Entry) -> tuple[Content, Content, Content]:
        """The links to the tables, the paths of the first runs over the level, and all sections below."""
        tables = self.ranking.tables.get(entry.digest, {})
        if not tables:
            return None, None, section("Runs", tag("p", "Nobody has passed this level here yet."))
        runs = f"All runs: {len(self.ranking.by_level[entry.digest])}"
        link = tag("p", tag("a", runs, href=f"{entry.digest[:16]}-runs.html"))
        category, first_runs = self.ranking.side_by_side(entry.digest, RUNS_SIDE_BY_SIDE)
        drawn, beside = self._side_by_side(category, first_runs)
        marks = {run.key: swatch(number) for number, run in enumerate(first_runs)} if beside else {}
        beaten = [part for part in tables if len(self.ranking.history[entry.digest, part]) > 1]
        anchors = _RECORDS, *[""] * len(beaten)
        first, *others = map(self._progression, repeat(entry), beaten, anchors) if beaten else [None]
        folded = tag("details", tag("summary", "How the other records went"), *others) if others else None
        merged: dict[Any, list[_Ranks]] = defaultdict(list)
        for part, table_ in tables.items():
            far = [row for row in table_ if row.is_far]
            rows = [row for row in table_ if not row.is_far][:ROWS_SHOWN]
            ranks = _Ranks(part, rows, far, self.ranking.waiting(entry.digest, part, table_))
            merged[part[0], *((row.place, row.run.key) for row in rows)].append(ranks)
        contents, leaders = list[Content](), dict[Leaderboard, Markup]()
        for number, group in enumerate(merged.values(), 1):
            contents.append(self._table(group, marks, anchor := f"ranks-{number}"))
            contents.append(self._note_on("More than twice as slow", [row for ranks in group for row in ranks.far]))
            contents.append(self._note_on("Better, and waiting", [row for ranks in group for row in ranks.waiting]))
            leaders |= {ranks.leaderboard: self._leader(ranks, anchor) for ranks in group}
        waits = self.parts.waiting_link(self.ranking.by_level[entry.digest])
        leads = [(name, name.capitalize()) for name, content in ((_RECORDS, first), (SPLITS, beside)) if content]
        note = tag("p", NEAR, waits) if waits else None
        top = tag("ul", *(leaders[part] for part in tables), class_="cards"), on_this_page(leads) if leads else None
        unknown = any(not row.run.made for group in merged.values() for ranks in group for row in ranks.rows)
        contents.append(tag("p", UNKNOWN_ORIGIN.format(self.ranking.unknown)) if unknown else None)
        return joined(*top), drawn, joined(*contents, note, link, first, folded, beside)

    def _note_on(self, what: str, rows: Sequence[Ranked]) -> Content:
        """The line below a table about runs that are not in it, each once."""
        texts = [
            f"{self.parts.shown_name(run.player)} {seconds_text(run.tick)} with {run.gold} gold"
            for run in {row.run.key: row.run for row in rows[:ROWS_SHOWN]}.values()
        ]
        return tag("p", f"{what}: {', '.join(texts)}.") if texts else None

    def _leader(self, ranks: _Ranks, anchor: str) -> Markup:
        """The leader of a table, and a link to it; if all runs wait for confirmation, their number."""
        parts, leaderboard = self.parts, ranks.leaderboard
        best = ranks.rows[0]
        link = tag("a", self.ranking.leaderboard_name(leaderboard), href=f"#{anchor}")
        if best.place != 1:
            waits = parts.waiting_link(row.run for row in self.ranking.tables[best.run.level][leaderboard])
            return tag("li", link, tag("p", waits, class_="facts"), class_="card leader")
        result = tag("strong", leaderboard[1].measured(best.values[0]))
        run = best.run
        about = tag("p", parts.player_link(run.player, UP), parts.watch_link([run], UP), run.day, class_="facts")
        return tag("li", link, result, about, class_="card leader")

    def _table(self, same: Sequence[_Ranks], marks: Mapping[RunKey, Content], anchor: str) -> Markup:
        """A table of categories with the same runs in order. ``marks``: colours of the runs in the picture."""
        rows, categories = [], [ranks.leaderboard[1] for ranks in same]
        several = len(same) > 1
        heads = [category.name if several and category.unit == "Value" else category.unit for category in categories]
        names = [*dict.fromkeys(heads)]  # a time is the same in all categories
        for ranked in zip(*(ranks.rows for ranks in same), strict=True):
            place, run = ranked[0].place, ranked[0].run
            results = [categories[at].text(ranked[at].values[0]) for at in map(heads.index, names)]
            delay = self.parts.behind(categories[0], ranked[0], same[0].rows[0])
            cells = self.parts.run_cells(run, *results, delay, timed=FASTEST.unit in heads, mark=marks.get(run.key))
            rank = tag("span", place, class_=f"place {MEDALS[place]}") if 0 < place < len(MEDALS) else place or ""
            rows.append((rank, *cells))
        lesser = LESSER.union(names[1:]) - {names[0]}
        best = table("Best run of each player", ("Place", "Player", *names, "Behind", *RUN_HEADS), rows, lesser)
        last = self.ranking.leaderboard_name(same[-1].leaderboard)  # all are of one ladder
        title = "; ".join([*(category.name for category in categories[:-1]), last])
        return section(title, best, anchor=anchor)

    def _progression(self, entry: Entry, leaderboard: Leaderboard, anchor: str) -> Content:
        parts = self.parts
        category = leaderboard[1]
        runs = self.ranking.history[entry.digest, leaderboard]
        moved = "rose" if category.greatest_first else "fell"
        numbers = [self.ranking.number(category, run) for run in runs]
        better = ["", *(category.gain(before - now) for before, now in pairwise(numbers))]
        rows = [
            (run.moment, parts.player_link(run.player, UP), category.text(number), gain, parts.watch_link([run], UP))
            for run, number, gain in zip(runs, numbers, better, strict=True)
        ]
        # Several records of one moment count as one.
        moments = [datetime.fromisoformat(run.added).timestamp() if run.added else 0.0 for run in runs]
        start, end = (f"{category.text(numbers[at])} {runs[at].day}" for at in (0, -1))
        label = f"The record {moved} from {start} to {end} in {counted(len(runs) - 1, 'step')}"
        heights = [-number if category.greatest_first else number for number in numbers]  # as they are shown
        named = [f"{parts.shown_name(run.player)}: {row[2]} {run.day}" for run, row in zip(runs, rows, strict=True)]
        # The first records of a level are often runs for gold: their scale would hide all later steps.
        since = next(at for at, number in enumerate(numbers) if not category.is_far(number, numbers[-1]))
        points = list(zip(moments, heights, strict=True))[since:]
        days = runs[since].day, runs[-1].day
        chart = step_chart(points, named[since:], category.difference, days, label) if len(points) > 1 else None
        heads = ("Date", "Player", category.unit, "Better by", "Watch")
        title = f"How the record {moved}: {self.ranking.leaderboard_name(leaderboard)}"
        ranked = table("Newest first", heads, rows[: -ROWS_SHOWN - 1 : -1], LESSER)
        return section(title, chart, ranked, anchor=anchor or None)

    def _side_by_side(self, category: Category, runs: Sequence[Run]) -> tuple[Markup, Content]:
        """The paths of the first runs of a category; for several runs also links to races of two, and splits."""
        names = [self.parts.shown_name(run.player) + ("" if run.ladder == PLAYED else ", assisted") for run in runs]
        ghosts = [*map(self._ghost, runs)]
        if len(runs) == 1:
            return paths(UP + picture_name(runs[0].level), [(names[0], path_data(ghosts[0].positions))]), None
        by_time = sorted(zip(names, runs, range(len(runs)), strict=True), key=lambda named: named[1].tick)
        rows = _split_rows([self._ghost(run) for _, run, _ in by_time])
        named_paths = [(name, path_data(ghost.positions)) for ghost, name in zip(ghosts, names, strict=True)]
        drawn = paths(UP + picture_name(runs[0].level), named_paths, [(row.split.x, row.split.y) for row in rows])
        text = f"Watch the first {len(runs)} together"
        together = tag("p", f"{category.name}: ", self.parts.watch_link(runs, UP, text))
        numbers = range(len(runs))
        pairs = [
            (tag("div", swatch(at), " ", names[at], class_="text"), *(self._race(runs, at, other) for other in numbers))
            for at in numbers
        ]
        heads = [tag("div", swatch(at), tag("span", names[at], class_="name"), class_="text") for at in numbers]
        races = table("Seconds by which the left one is later; a link watches both", ("Run", *heads), pairs)
        lines = [
            (tag("a", number, href=f"#{PLACE}{number}"), row.split.name, *_cells(row))
            for number, row in enumerate(rows, 1)
        ]
        first, *others = (heads[number] for *_, number in by_time)
        note = f"Seconds; later than {by_time[0][0]}: +; numbers are those in the picture"
        splits = table(note, ("No.", "Split", first, "Fastest segment", *others), lines, ("No.",))
        best = tag("p", f"Sum of the fastest segments, each from the row above: {seconds_text(sum_of_best(rows))} s.")
        where = self._where_time_goes(by_time, tabled=len(rows) < MIN_SPLITS)
        of_two = section("Any two of the first", races, anchor=RACES)
        return joined(drawn, together), joined(of_two, section("Splits", splits, best, anchor=SPLITS), where)

    def _ghost(self, run: Run) -> RunSplits:
        """A run with its splits, simulated once for all pages of its level."""
        if run.key not in self._ghosts:
            self._ghosts[run.key] = run_splits(Recording(run.entry.named.level, run.replay), memory="auto")
        return self._ghosts[run.key]

    def _race(self, runs: Sequence[Run], at: int, other: int) -> Content:
        """A race of two of the runs, in their colours."""
        both = [runs[at], runs[other]]
        return self.parts.watch_link(both, UP, signed(both[0].tick - both[1].tick), (at, other)) if at != other else ""

    def _where_time_goes(self, runs: Sequence[tuple[str, Run, int]], *, tabled: bool = False) -> Content:
        """The part on which each named run loses most to the first, fastest one, and a chart of its delay on the way.

        None for runs too long to align. The number of a run is its colour's. ``tabled``: also a table by seconds.
        """
        (fastest, first, _), *others = runs
        if max(run.tick for _, run, _ in runs) >= MAX_ALIGNED_TICKS:
            return None
        length = first.tick + 1
        step = TICKS_PER_SECOND * (1 + length // _MAX_SECONDS)
        seconds = range(step, length, step)
        ticks = sorted({*range(0, length, 1 + length // MAX_LEADS), *seconds, first.tick})
        delays = [dict(zip(ticks, self._delays(first, other, ticks), strict=True)) for _, other, _ in others]
        sentences = []
        for (name, *_), delay in zip(others, delays, strict=True):
            leads = ((tick, delay[tick]) for tick in seconds)
            near = [(0, 0), *((tick, lead) for tick, lead in leads if lead is not None)]
            lost, start, end = max(((b[1] - a[1], a[0], b[0]) for a, b in pairwise(near)), default=(0, 0, 0))
            span = f"between {start // TICKS_PER_SECOND} s and {end // TICKS_PER_SECOND} s of {fastest}"
            sentences += [tag("p", f"{name} loses most {span}: {seconds_text(lost)} s.")] if lost > 0 else []
        caption = f"Seconds by which each is later where {fastest} is then; a gap: it goes another way"
        lines = [(number, [*delay.values()]) for (*_, number), delay in zip(others, delays, strict=True)]
        legend = tag("ul", *(tag("li", swatch(number), f" {name}") for name, _, number in others), class_="facts")
        contents = [*sentences, tag("p", caption, class_="faint"), lead_chart(ticks, lines, caption), legend]
        rows = []
        for tick in seconds if tabled else ():
            cells = ["" if delay[tick] is None else signed(delay[tick] or 0) for delay in delays]
            if any(cells):
                rows.append((f"{tick // TICKS_PER_SECOND} s", *cells))
        heads = [name for name, *_ in runs]
        folded = tag("details", tag("summary", "As a table"), table(caption, heads, rows)) if rows else None
        return section("Where time goes", *contents, folded)

    def _delays(self, first: Run, other: Run, ticks: Sequence[int]) -> list[int | None]:
        """As ``_leads``, compared once for all pages of the level. ``ticks``: always the same of a first run."""
        pair = first.key, other.key
        if pair not in self._compared:
            self._compared[pair] = _leads(self._ghost(first).positions, self._ghost(other).positions, ticks)
        return self._compared[pair]


def _leads(ours: NDArray[np.float64], theirs: NDArray[np.float64], ticks: Sequence[int]) -> list[int | None]:
    """The ticks by which the other run is later at the places of these ticks; None where it is not near."""
    partner = aligned(ours[::COARSE], theirs[::COARSE])
    leads: list[int | None] = []
    for tick in ticks:
        start = max(0, COARSE * (int(partner[tick // COARSE]) - 1))
        apart = np.hypot(*(theirs[start : start + 2 * COARSE + 1] - ours[tick]).T)
        leads.append(start + int(apart.argmin()) - tick if partner[tick // COARSE] >= 0 else None)
    return leads


def _split_rows(runs: Sequence[RunSplits]) -> list[SplitRow]:
    """Rows of splits of the fastest run, without gold that only others take; without any gold if rows are too many."""
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


def _text(run: Run) -> str:
    return shared_text(run.replay, run.entry.named.level)
