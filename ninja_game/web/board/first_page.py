"""The board's first page: newest records and runs, the most contested levels, the leaders; and its feed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby, islice
from uuid import NAMESPACE_OID, uuid5
from xml.etree import ElementTree as ET

from ninja_game.board.ranking import Record
from ninja_game.board.report import counts
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.web.board.parts import LESSER, Parts, card, cards, linked_level, made_text, stack
from ninja_game.web.board.player_pages import PlayerPages
from ninja_game.web.pages.frame import Content, Markup, joined, on_this_page, page, section, table, tag
from ninja_game.web.pages.gallery import page_name

# Rows
NEWEST = 30
NEWEST_RUNS = 10
LEADING = 20
CONTESTED = 8
CARDS = 8  # the newest records are cards, older ones rows
MAX_OF_A_MOMENT = 5  # records of one moment that have a row each

HOW_TO_SEND = (
    "Set your name in the settings, and play a level. After it, press E: the game keeps the run as a replay.",
    "Under Replays, E writes it as a text file into the folder exports.",
    "Send the file to the keeper of this board; to a board in a repository, by a pull request that adds it.",
)

Piece = tuple[str, str, Content]  # part of a page: anchor, title, content

FEED = "feed.xml"
ONE_MOMENT = "Where several runs that came in together beat a level's record, the best of them is the record."


class FirstPage:
    """The first page and the feed of a board, whose players are listed as on their ``players`` pages."""

    def __init__(self, parts: Parts, players: PlayerPages) -> None:
        self.parts = parts
        self.ranking = parts.ranking
        self.entries = parts.ranking.shown.entries
        self.players = players

    def page(self) -> str:
        newest = list[Markup]()
        rows = list[tuple[Content, ...]]()
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
        cards_and_table = tag("ul", *newest, class_="cards") if newest else None, older, tag("p", ONE_MOMENT), feed
        news: list[Piece] = [("newest", "Newest records", joined(*cards_and_table))] if newest or rows else []
        leaders: list[Piece] = [
            (ladder, self.players.title(ladder), self.players.short_list(standings[:LEADING]))
            for ladder, standings in self.ranking.standings.items()
            if standings
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
        levels, players = {record.run.level for record in records}, {record.run.player for record in records}
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
        about = tag("ul", card(self.entries[digest], sent, *self.parts.best_results(digest)), class_="cards wide-card")
        return [("week", "Level of the week", about)]

    def _contested(self) -> list[Piece]:
        """The most contested levels; where there are none, those of the newest runs."""
        contested: list[Markup] = []
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
            parts = counted(beaten, "record") + " beaten" if beaten else "", self.parts.counts_of(digest)
            about = joined(*(tag("span", text) for text in parts if text))
            spreads = (self._spread(digest, ladder) for ladder in self.ranking.ladders)
            contested.append(card(self.entries[digest], about, *self.parts.best_results(digest), *spreads))
        caption = f"{order} {self.parts.main.name}{self.parts.of_both()}"
        return [("contested", title, cards(caption, contested))] if contested else []

    def _spread(self, digest: str, ladder: str) -> str:
        """The gaps of the second and the fifth run of a ladder to the first, in the first category."""
        places = zip(("second", "fifth"), self.parts.placed(digest, ladder)[1:5:3], strict=False)
        spread = ", ".join(f"{place} {self.parts.main.difference(row.behind)} behind" for place, row in places)
        return f"{ladder}: {spread}" if spread and len(self.ranking.ladders) > 1 else spread

    def feed(self) -> str:
        """New records as Atom (RFC 4287); dates are those of the ledger."""
        news = list(islice(self._news(), NEWEST))
        name = self.ranking.shown.name
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


def _together(records: Sequence[Record]) -> str:
    return f"{len(records)} runs with records came in together"


def _about(element: ET.Element, title: str, name: str, date: str) -> None:
    """The elements that Atom demands of a feed and of its entries."""
    ET.SubElement(element, "id").text = uuid5(NAMESPACE_OID, f"ninja-game board {name}").urn
    ET.SubElement(element, "title").text = shown_text(title)
    ET.SubElement(element, "updated").text = date or "1970-01-01T00:00:00Z"
