"""The board's pages: news, players, levels, episodes, and runs that do not count."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from itertools import groupby, islice, product
from operator import itemgetter
from pathlib import Path
from shlex import quote
from statistics import mean, median
from typing import Any
from uuid import NAMESPACE_OID, uuid5
from xml.etree import ElementTree as ET

from ninja_game.board.categories import HIGHEST
from ninja_game.board.collect import is_in
from ninja_game.board.memo import Memo
from ninja_game.board.ranking import Ranked, Ranking, Record, Standing
from ninja_game.board.report import counts, unnamed_hint
from ninja_game.board.runs import REJECTED_KINDS, Run, RunKey
from ninja_game.errors import FileError
from ninja_game.files.reading import SUFFIXES
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.formats.run_time import seconds_text
from ninja_game.sim.rules import LIFETIME
from ninja_game.web.board.level_pages import ROWS_SHOWN, LevelPages
from ninja_game.web.board.parts import (
    EPISODES,
    HOW_TO_CONFIRM,
    LESSER,
    NEAR,
    Parts,
    card,
    cards,
    linked_level,
    made_text,
    player_page,
)
from ninja_game.web.pages.frame import (
    REPLAYS,
    Content,
    Markup,
    definitions,
    joined,
    on_this_page,
    page,
    section,
    table,
    tag,
)
from ninja_game.web.pages.gallery import BOARD, UP, medal_mark, page_name

# Rows on the first page.
NEWEST = 30
NEWEST_RUNS = 10
LEADING = 20
CONTESTED = 8
CARDS = 8  # the newest records are cards, older ones rows
MAX_FILE_NAME = 24  # characters of a name of a file
MAX_OF_A_MOMENT = 5  # records of one moment that have a row each

HOW_TO_SEND = (
    "Set your name in the settings, and play a level. After it, press E: the game keeps the run as a replay.",
    "Under Replays, E writes it as a text file into the folder exports.",
    "Send the file to the keeper of this board; to a board in a repository, by a pull request that adds it.",
)

Piece = tuple[str, str, Content]  # part of a page: anchor, title, content

FEED = "feed.xml"
ONE_MOMENT = "Where several runs that came in together beat a level's record, the best of them is the record."
HOW_TO_MOVE = (
    "What no keyboard can do was made by tools. The keeper ranks it so with: "
    "ninja-game board FOLDER --json board.json --ladder FILE assisted, or all unknown ones by its rules."
)
GAINS = "By how much could be won"
BY_LEVELS = "By levels led in all categories together, then by levels passed"


def check_site(out: Path, folder: Path) -> None:
    """Raise FileError if the pages in ``out`` would be written into the folder of runs, or around it."""
    for written in (out / BOARD, out / REPLAYS):
        if is_in(written, folder) or is_in(folder, written):
            what = f"the pages would be written into {written.name!r}, and the runs are read there"
            raise FileError(what, str(out), found=str(folder), hint="choose another folder for the pages")


def check_ledger(data: Path, folder: Path) -> None:
    """Raise FileError if the next time the ledger would be read as a run."""
    if is_in(data, folder) and data.name.lower().endswith(SUFFIXES):
        raise FileError("the board would be read as a run", str(data), hint="choose a name that ends in .json")


EPISODE_NUMBERS = (
    "Sum: what ranks the runs, such as their times, added up over the levels. Score: 90 s, and 2 s for each piece of "
    "gold, less the times of all levels, as the clock of an episode runs on; it ranks where there is no sum."
)
EPISODE_HEADS = ("Place", "Player", "Sum", "Score", "Levels", "Watch")


class BoardPages:
    """Writes the pages of a ranking into ``out/board/``, and its runs into ``out/replays/``.

    ``memo``: of earlier pages in ``out``. Raises FileError if ``out/board`` holds other files.
    """

    def __init__(self, out: Path, ranking: Ranking, memo: Memo | None = None, *, address: str = "") -> None:
        self.parts, self.ranking = Parts(out, ranking, memo, address=address), ranking
        self.entries, self.main = ranking.shown.entries, ranking.categories[0]
        self._players_with_runs = {run.player for run in ranking.judged.runs}

    def write(self) -> None:
        parts, levels = self.parts, LevelPages(self.parts)
        for entry in self.entries.values():
            levels.write_level(entry)
        self._players()
        self._levels()
        self._rejected()
        if episodes := self._episodes():
            parts.pages.write(EPISODES[0], page(EPISODES[1], tag("p", EPISODE_NUMBERS), *episodes, links=parts.top))
        parts.pages.write("index.html", self._first())
        parts.pages.write(FEED, self._feed())
        # Last: if the disk is full, the earlier pages are still complete.
        for folder in ("players", "levels", "pictures"):
            parts.pages.clear(folder)
        parts.pages.finish()

    # --- the first page and the feed ---

    def _first(self) -> str:
        newest, rows = list[Markup](), list[tuple[Content, ...]]()
        for records in self._moments():
            if len(rows) >= NEWEST:
                break
            if len(records) <= MAX_OF_A_MOMENT and not rows and len(newest) < CARDS:
                newest += map(self._newest, records)
            else:
                rows += self._of_a_moment(records)
        heads = ("Level", "Watch", "Player", "Record", "Date")
        older = table("Newest first", heads, rows[:NEWEST], LESSER) if rows else None
        older = tag("details", tag("summary", "Earlier records"), older) if newest and older else older
        feed = tag("p", tag("a", "Feed of new records (Atom)", href=FEED))
        shown = tag("ul", *newest, class_="cards") if newest else None, older, tag("p", ONE_MOMENT), feed
        news: list[Piece] = [("newest", "Newest records", joined(*shown))] if newest or rows else []
        leaders: list[Piece] = [
            (ladder, self._players_of(ladder), table(BY_LEVELS, self._heads(), map(self._standing, first), LESSER))
            for ladder, standings in self.ranking.standings.items()
            if (first := standings[:LEADING])
        ]
        lead = tag("p", f"{counts(self.ranking.judged)}.", class_="lead")
        again = tag("p", "Every run was simulated again: times, gold and scores are the result of its inputs.")
        parts = [*self._week(), *news, *self._runs_and_how_to_send(), *self._contested(), *leaders]
        contents = [section(title, content, anchor=anchor) for anchor, title, content in parts]
        leads = on_this_page([part[:2] for part in parts])
        title = self.ranking.name or f"Board: {self._name}"
        return page(title, lead, again, leads, *contents, links=self.parts.top, current="index.html")

    @property
    def _name(self) -> str:
        """The name of the pack or folder, or that of the only level: its file's says nothing to readers."""
        titles = [entry.title for entry in self.entries.values()]
        return titles[0] if len(titles) == 1 and not self.ranking.shown.pack else self.ranking.shown.name

    def _runs_and_how_to_send(self) -> list[Piece]:
        parts = self.parts
        rows = [
            (linked_level(run.entry), parts.watch_link([run], ""), player, time, run.moment)
            for run in self.ranking.judged.runs[: -NEWEST_RUNS - 1 : -1]
            for player in [joined(parts.player_link(run.player), tag("div", made_text(run), class_="faint"))]
            for time in [parts.run_link(run, "", seconds_text(run.tick))]
        ]
        newest = table("Newest first", ("Level", "Watch", "Player", "Time", "Date"), rows, LESSER)
        steps = tag("ol", *(tag("li", step) for step in HOW_TO_SEND))
        play = tag("p", tag("a", "Play", href=parts.game, class_="button"))
        runs: list[Piece] = [("runs", "Newest runs", newest)] if rows else []
        return [*runs, ("send", "Send a run", joined(steps, play))]

    def _newest(self, record: Record) -> Markup:
        """The card of a record with its level."""
        run, link = record.run, self.parts.player_link(record.run.player)
        achieved = (
            joined(tag("span", name), " ", tag("b", result), " ", tag("span", gain))
            for name, result, gain in self._achieved(record)
        )
        return card(run.entry, joined(link, " ", self.parts.watch_link([run], "")), *achieved, run.moment)

    def _moments(self) -> Iterator[list[Record]]:
        """The records of each moment, the newest first."""
        for _, group in groupby(self.ranking.records, key=lambda record: record.run.added):
            yield [*group]

    def _of_a_moment(self, records: Sequence[Record]) -> list[tuple[Content, ...]]:
        """A row for each record of one moment; a single row for many of them."""
        moment, rows = records[0].run.moment, list[tuple[Content, ...]]()
        if len(records) <= MAX_OF_A_MOMENT:
            for record in records:
                links = self.parts.watch_link([record.run], ""), self.parts.player_link(record.run.player)
                lines = stack(*self._lines(record))
                rows.append((linked_level(record.run.entry), *links, lines, moment))
            return rows
        levels, players = ({getattr(record.run, name) for record in records} for name in ("level", "player"))
        where = tag("a", counted(len(levels), "level"), href="levels.html")
        return [(where, "", counted(len(players), "player"), stack(_together(records)), moment)]

    def _lines(self, record: Record) -> Iterator[str]:
        return (f"{name}: {result}, {gain}" for name, result, gain in self._achieved(record))

    def _achieved(self, record: Record) -> Iterator[tuple[str, str, str]]:
        """The categories of a record, its result in each, and the gain."""
        for category, amount in record.gains.items():
            result = category.measured(self.ranking.number(category, record.run))
            gain = "first" if amount is None else f"better by {category.gain(amount)}"
            yield self.ranking.leaderboard_name((record.run.ladder, category)), result, gain

    def _week(self) -> list[Piece]:
        if not (chosen := self.ranking.level_of_the_week):
            return []
        digest, players, runs = chosen
        sent = f"{counted(runs, 'run')} by {counted(players, 'player')} in the seven days up to the newest run"
        about = tag("ul", card(self.entries[digest], sent, *self._best(digest)), class_="cards wide-card")
        return [("week", "Level of the week", about)]

    def _contested(self) -> list[Piece]:
        """The most contested levels; where there are none, those of the newest runs."""
        shown: list[Markup] = []
        order = "By how often records were beaten, of all categories and ladders; results are those in"
        if len(self.entries) == 1:
            return []
        title, chosen = "Most contested levels", self.ranking.contested
        if not chosen:
            title, order = "Levels of the newest runs", "Newest first; results are those in"
            chosen = [*dict.fromkeys(run.level for run in reversed(self.ranking.judged.runs))]
        elif not self.ranking.beaten:
            order = "By how close the second is, in"
        for digest in chosen[:CONTESTED]:
            beaten = self.ranking.beaten[digest]
            parts = counted(beaten, "record") + " beaten" if beaten else "", self._counts(digest)
            about = joined(*(tag("span", text) for text in parts if text))
            spreads = (self._spread(digest, ladder) for ladder in self.ranking.ladders)
            shown.append(card(self.entries[digest], about, *self._best(digest), *spreads))
        caption = f"{order} {self.main.name}{self._of_both()}"
        return [("contested", title, cards(caption, shown))] if shown else []

    def _spread(self, digest: str, ladder: str) -> str:
        """How far the second and the fifth run of a ladder are behind in the first category."""
        places = zip(("second", "fifth"), self._placed(digest, ladder)[1:5:3], strict=False)
        spread = ", ".join(f"{place} {self.main.difference(row.behind)} behind" for place, row in places)
        return f"{ladder}: {spread}" if spread and len(self.ranking.ladders) > 1 else spread

    def _of_both(self) -> str:
        """A caption's addition if there are two ladders."""
        return "; runs and players are those of both ladders" if len(self.ranking.ladders) > 1 else ""

    def _best(self, digest: str) -> list[Content]:
        """The best number and its player in the first category of each ladder with runs."""
        firsts: list[Content] = []
        for ladder in self.ranking.ladders:
            if first := next(iter(self._placed(digest, ladder)), None):
                name = ladder.capitalize() if len(self.ranking.ladders) > 1 else self.main.name
                result = tag("b", self.main.measured(first.values[0]))
                firsts.append(joined(tag("span", name), " ", result, " ", self.parts.player_link(first.run.player)))
        return firsts

    def _feed(self) -> str:
        """New records as Atom (RFC 4287); dates are those of the ledger."""
        news, name = list(islice(self._news(), NEWEST)), self.ranking.shown.name
        feed = ET.Element("feed", xmlns="http://www.w3.org/2005/Atom")
        _about(feed, f"New records: {self.ranking.name or name}", name, news[0][2] if news else "")
        ET.SubElement(feed, "link", rel="self", href=FEED)
        for title, known_by, date, author, leads_to in news:
            _about(entry := ET.SubElement(feed, "entry"), title, known_by, date)
            ET.SubElement(ET.SubElement(entry, "author"), "name").text = author
            ET.SubElement(entry, "link", href=leads_to)
        return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(feed, "unicode") + "\n"

    def _news(self) -> Iterator[tuple[str, str, str, str, str]]:
        """Entries of the feed: title, id, date, author, page."""
        for records in self._moments():
            date = records[0].run.added
            if date and len(records) > MAX_OF_A_MOMENT:
                yield _together(records), date, date, self.ranking.shown.name, "index.html"
            elif date:
                for record in records:
                    run, name = record.run, self.parts.shown_name(record.run.player)
                    title = f"{name}, {run.entry.title}, {'; '.join(self._lines(record))}"
                    yield title, self.parts.stems[run.key], date, name, page_name(run.level)

    # --- players ---

    def _heads(self) -> list[str]:
        names = [f"First, {category.name}" for category in self.ranking.categories]
        return ["Player", "Levels", "Runs", *names, *map(str.capitalize, MEDALS)]

    def _players_of(self, ladder: str) -> str:
        """The title of a list of players, with the ladder if there are two."""
        return f"Players, {ladder}" if len(self.ranking.ladders) > 1 else "Players"

    def _standing(self, row: Standing) -> tuple[Content, ...]:
        parts = self.parts
        firsts = [row.records[category] for category in self.ranking.categories]
        return (parts.player_link(row.player), row.levels, row.runs, *firsts, *(n or "" for n in row.medals.values()))

    def _players(self) -> None:
        parts = self.parts
        sums: dict[str, list[Content]] = defaultdict(list)
        pages = dict(zip(self.ranking.ladders, ("players", "assisted"), strict=False))
        for ladder, standings in self.ranking.standings.items():
            leads: list[Content] = [
                tag("a", self._players_of(other), href=f"{pages[other]}.html") for other in pages if other != ladder
            ]
            leads += filter(None, [unnamed_hint(self.ranking.judged)])
            title, rows = self._players_of(ladder), [*map(self._standing, standings)]
            parts.write_table(pages[ladder], title, BY_LEVELS, self._heads(), rows, *(tag("p", lead) for lead in leads))
            for standing in standings:
                sums[standing.player].append(_sums(ladder, self.main.name, standing))
        runs: dict[str, list[Run]] = defaultdict(list)
        for run in self.ranking.judged.runs:
            runs[run.player].append(run)
        kept, lost = self._records()
        heads = ("Level", "Record", "Result", "Date", "Lost to", "With", "On")
        for player, own in runs.items():
            name, records = player_page(player), kept[player] + lost[player]
            note = f"Records: {len(kept[player])} held, {len(lost[player])} lost"
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

    def _gains(self, runs: Sequence[Run]) -> list[tuple[Content, ...]]:
        """Rows of a player's runs that are behind the first of the main category, the farthest first."""
        parts = self.parts
        gains = []
        for run in runs:
            for part, rows, number in self.ranking.places.get(run.key, ()):
                row, first = rows[number], rows[0].run
                if part[1] == self.main and row.place and row.behind and not row.is_far:
                    result = parts.run_link(run, UP, self.main.text(row.values[0])), self.main.difference(row.behind)
                    both = parts.player_link(first.player, UP), parts.watch_link([run, first], UP, "Watch both")
                    gains.append((row.behind, (linked_level(run.entry, UP), *result, row.place, *both)))
        return [cells for _, cells in sorted(gains, key=itemgetter(0), reverse=True)]

    def _records(self) -> tuple[dict[str, list[tuple[Content, ...]]], dict[str, list[tuple[Content, ...]]]]:
        """By player the rows of records held, and of records lost."""
        kept: dict[str, list[tuple[Content, ...]]] = defaultdict(list)
        lost: dict[str, list[tuple[Content, ...]]] = defaultdict(list)
        for (level, part), runs in self.ranking.history.items():
            last = {run.player: number for number, run in enumerate(runs)}
            results = [self.parts.run_link(run, UP, self.parts.shown_value(part[1], run)) for run in runs]
            for player, number in last.items():
                best, by = runs[number], runs[number + 1] if number + 1 < len(runs) else None
                about = (
                    linked_level(self.entries[level], UP),
                    self.ranking.leaderboard_name(part),
                    results[number],
                    best.day,
                )
                loss = (self.parts.player_link(by.player, UP), results[number + 1], by.day) if by else ("", "", "")
                (lost if by else kept)[player].append((*about, *loss))
        return kept, lost

    def _runs_of(self, player: str, runs: Sequence[Run], lead: Sequence[Content]) -> None:
        """A player's page: the sums, and all runs in playing order."""
        order = {level: number for number, level in enumerate(self.entries)}
        known = {self.parts.stems[run.key]: run for run in runs}

        def cells(row: Sequence[Any]) -> tuple[Content, ...]:
            run = known[row[0]]
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
        return waits + [
            f"{self.ranking.leaderboard_name(part)}: {place}"
            for part, rows, number in self.ranking.places.get(run.key, ())
            if (place := self.parts.place(part[1], rows[number], rows[0]))
        ]

    # --- levels, episodes, and runs that do not count ---

    def _levels(self) -> None:
        rows = [(card(entry, self._counts(digest), *self._best(digest)),) for digest, entry in self.entries.items()]
        caption = f"In playing order; who is first, in {self.main.name}{self._of_both()}"
        self.parts.write_table("levels", "Levels", caption, (), rows)

    def _placed(self, digest: str, ladder: str) -> list[Ranked]:
        """The runs with a place in the first category of a ladder, except those far behind."""
        rows = self.ranking.tables.get(digest, {}).get((ladder, self.main), [])
        return [row for row in rows if row.place and not row.is_far]

    def _counts(self, digest: str) -> str:
        """The numbers of a level's runs and players, over all ladders and categories."""
        runs = self.ranking.by_level.get(digest, [])
        players = {run.player for run in runs}
        return f"{counted(len(runs), 'run')} by {counted(len(players), 'player')}" if runs else "no run yet"

    def _episodes(self) -> list[Content]:
        sections: list[Content] = []
        parts = [(ladder, kind) for ladder in self.ranking.ladders for kind in self.ranking.categories if kind.episodes]
        kinds = ("sum of the best of all its levels", self.ranking.episode), ("in one recording", self.ranking.whole)
        for number, episode in sorted(self.ranking.shown.levels.episodes.items()):
            tables = []
            for part, (what, ranked) in product(parts, kinds):
                # A sum of scores contains the 90 s of each level; the order is the same.
                ranks_score = part[1].unit == HIGHEST.unit
                rows = []
                for place, (player, total, runs) in enumerate(ranked(episode, part)[:ROWS_SHOWN], 1):
                    score = seconds_text(LIFETIME + sum(run.score - LIFETIME for run in runs))
                    results = "" if ranks_score else part[1].text(total), score
                    levels = ", ".join(self.parts.shown_value(part[1], run) for run in runs)
                    linked = self.parts.player_link(player)
                    rows.append((place, linked, *results, levels, self.parts.watch_link(runs, "")))
                caption = f"Episode {number:02d}, {self.ranking.leaderboard_name(part)}: {what}"
                tables += [table(caption, EPISODE_HEADS, rows)] if rows else []
            nobody = tag("p", "No player yet.")
            listed = tag("ul", *(tag("li", linked_level(level)) for level in episode.levels), class_="facts")
            sections.append(section(f"Episode {number:02d}: {episode.name}", listed, *tables or [nobody]))
        return sections

    def _rejected(self) -> None:
        parts, rejected, order = self.parts, self.ranking.judged.rejected, list(REJECTED_KINDS)
        by_kind = Counter(item.kind for item in rejected)
        kinds = ", ".join(
            f"{title.lower()}: {by_kind[kind]}" for kind, (_, title, _) in REJECTED_KINDS.items() if by_kind[kind]
        )
        rows: list[tuple[Content, ...]] = [
            (
                stack(
                    tag("b", REJECTED_KINDS[item.kind][2]),
                    _file(item.file, item.record),
                    joined(self._known_player(item.player), f", {item.level}" if item.level else None),
                    item.added.partition("T")[0],
                ),
                tag("div", item.why, " ", self._first_run(item.first), class_="why"),
            )
            for item in sorted(rejected, key=lambda item: order.index(item.kind))
        ]
        lead = f"None of them is ranked; {kinds}." if kinds else "Every file of the folder is a run that counts."
        runs: dict[RunKey | None, Run] = {run.key: run for run in self.ranking.judged.runs}
        near = [
            (
                parts.watch_link([run], ""),
                stack(
                    _file(*run.key),
                    joined(parts.player_link(run.player), ", ", linked_level(run.entry)),
                    joined(parts.run_link(run, "", seconds_text(run.tick)), f" with {run.gold} gold"),
                    run.day,
                ),
                tag("div", run.waits, *self._decide(run, runs.get(run.near_to)), class_="why"),
            )
            for run in runs.values()
            if run.waits
        ]
        movable = any(item.kind == "refused" and item.way for item in rejected)
        leads = tag("p", lead), tag("p", HOW_TO_MOVE) if movable else None
        heads = "Run", "Why"
        parts.write_table("rejected", "Rejected", "What does not count", heads, rows, *leads)
        if near:
            names = "Watch", "Run", "Why"
            about, caption = (tag("p", NEAR), tag("p", HOW_TO_CONFIRM)), "Runs without a place"
            parts.write_table("waiting", "Waiting for confirmation", caption, names, near, *about)

    def _decide(self, run: Run, other: Run | None) -> Iterator[Content]:
        """Below the reason why a run waits: a link beside the run that it resembles, and the keeper's two commands."""
        if other:
            yield tag("p", self.parts.watch_link([run, other], "", f"Watch with {self.parts.shown_name(other.player)}"))
        file, folder = quote(shown_text(run.file)), quote(shown_text(run.folder.folder.resolve().name))
        for does in f"--confirm {file}", f"--reject {file} --reason 'not confirmed'":
            yield tag("p", tag("code", f"ninja-game board {folder} --json board.json {does}"))

    def _known_player(self, player: str) -> Content:
        """A player's name, a link if some of the player's runs count."""
        return self.parts.player_link(player) if player in self._players_with_runs else self.parts.shown_name(player)

    def _first_run(self, key: RunKey | None) -> Content:
        """A link to the page of a run that others have copied."""
        return tag("a", "The first run", href=f"../{REPLAYS}/{self.parts.stems[key]}.html") if key else ""


def stack(*lines: Content) -> Markup:
    """Lines in one cell of a table, without empty ones."""
    return tag("div", *(tag("div", line) for line in lines if line), class_="stack")


def _file(name: str, record: int) -> Content:
    """A file, and the record in it; a long name is folded."""
    text = f"{name}, record {record}" if record else name
    short = shown_text(text, MAX_FILE_NAME)
    return tag("details", tag("summary", short), text, class_="note") if short != text else text


def _together(records: Sequence[Record]) -> str:
    return f"{len(records)} runs with records came in together"


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


def _about(element: ET.Element, title: str, name: str, date: str) -> None:
    """The elements that Atom demands of a feed and of its entries."""
    ET.SubElement(element, "id").text = uuid5(NAMESPACE_OID, f"ninja-game board {name}").urn
    ET.SubElement(element, "title").text = shown_text(title)
    ET.SubElement(element, "updated").text = date or "1970-01-01T00:00:00Z"
