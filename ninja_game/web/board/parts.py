"""Parts of all pages of a board: links, tables of any length, names."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from ninja_game.board.categories import Category
from ninja_game.board.memo import Memo, values_digest
from ninja_game.board.ranking import Ranked, Ranking
from ninja_game.board.runs import Run
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.levels.episodes import Entry
from ninja_game.web.pages.frame import GAME_PAGE, LONG_CELL, REPLAYS, Content, Markup, Pages, joined, page, table, tag
from ninja_game.web.pages.gallery import BOARD, PICTURE_SIZE, UP, medal_mark, page_name, picture_name, watch_address

PER_PAGE = 100  # rows of a table on one page: a page has at most 100 KB

_MAX_NAME = 40  # characters of a name in a table

RUN_HEADS = ("Watch", "Made", "Gold", "Date", "Medal", "File")
LESSER = {"No.", "Behind", "Better by", "Score", "With", "On", *RUN_HEADS[2:], *map(str.capitalize, MEDALS)}
"""Heads of columns that a narrow page leaves out."""
EPISODES = "episodes.html", "Episodes"
LINKS = [
    ("index.html", "Board"), ("players.html", "Players"), ("levels.html", "Levels"), EPISODES,
    ("rejected.html", "Rejected"),
]  # fmt: skip
NEAR = (
    "A run that is nearly somebody else's, or from another folder than the player's own, has no place until the keeper "
    "of the board confirms it. "
)
HOW_TO_CONFIRM = (
    "The commands in a row confirm or reject its run; the keeper runs them where the folder and the ledger lie."
)
UNKNOWN_ORIGIN = (
    "Made unknown: the run does not say how it was made, and nobody can check it. It is ranked among the {} ones until "
    "the keeper of the board moves it. "
)


class Parts:
    """The common parts of a board's pages in ``out/board/``: their folder, links, tables, and the names of its runs.

    ``up``: the path from a page to that folder, "" or UP; ``address``: of ``out``, if it is known.
    """

    def __init__(self, out: Path, ranking: Ranking, memo: Memo | None = None, *, address: str = "") -> None:
        self.pages, self.ranking = Pages(out, BOARD, memo), ranking
        self.main = ranking.categories[0]
        self.game = f"../{GAME_PAGE}"
        self.site = address and f"{address}{BOARD}/"
        assisted = [("assisted.html", "Assisted")] if len(ranking.ladders) > 1 else []
        others = [link for link in LINKS[2:] if link != EPISODES or ranking.shown.levels.episodes]
        self.links = [(self.game, "Play"), (LINKS[0][0], ranking.name or LINKS[0][1]), LINKS[1], *assisted, *others]
        waiting = sum(bool(run.waits) for run in ranking.judged.runs)
        # Pages of levels and runs have no number that changes them all.
        self.top = [*self.links, *([("waiting.html", f"Waiting: {waiting}")] if waiting else [])]
        self.deeper = [(UP + address, name) for address, name in self.links]
        self.around = values_digest([self.links, self.site])  #: digest of the text on every page
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
        lesser: Collection[str] = LESSER,
    ) -> None:
        """A table on as many pages as it needs. ``rows``: plain values; ``cells`` makes their cells.

        Without heads each row is a card.
        """
        up, links = (UP, self.deeper) if "/" in name else ("", self.top)
        current = f"{name}.html"
        parts = [rows[first : first + PER_PAGE] for first in range(0, len(rows), PER_PAGE)] or [()]
        names = [current, *(f"{name}-{number}.html" for number in range(2, len(parts) + 1))]
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
                shown = table(caption, heads, rows, lesser) if heads else cards(caption, (row[0] for row in rows))
                return page(title, *lead, shown, more, up=up, links=links, current=current)

            self.pages.make(file, [title, caption, heads, part, lead, more, links], content)

    def watch_link(self, runs: Sequence[Run], up: str, text: str = "", colours: Sequence[int] = ()) -> Markup:
        """A link that watches a run, the others as ghosts; ``colours``: of all, by number, if not in their order."""
        marks = [f"-{number}" for number in colours] or [""] * len(runs)
        stems = (self.stems[run.key] + mark for run, mark in zip(runs, marks, strict=True))
        address = watch_address(up + self.game, *stems)
        label = f"{text or 'Watch'}: {runs[0].player} on {runs[0].entry.title}"
        return tag("a", text or "Watch", href=address, aria_label=label, class_=None if text else "watch")

    def waiting_link(self, runs: Iterable[Run]) -> Content:
        """A link from a deeper page to what waits, with the number of these runs that do; None for none."""
        number = sum(bool(run.waits) for run in runs)
        return tag("a", counted(number, "run waits", "runs wait"), href=f"{UP}waiting.html") if number else None

    def run_link(self, run: Run, up: str, text: str = "") -> Markup:
        """A link to the page of a run with the text ``text``, such as its time; by default to its replay."""
        address = f"{up}../{REPLAYS}/{self.stems[run.key]}"
        label = f"{run.player} on {run.entry.title}"
        if text:
            return tag("a", text, href=f"{address}.html", aria_label=f"{text}: {label}")
        return tag("a", "File", href=f"{address}.txt", download=True, aria_label=f"File: {label}")

    def behind(self, category: Category, row: Ranked, first: Ranked, word: str = "") -> str:
        """The gap of a run to the first, or the criterion that decides. ``word``: written behind a number."""
        if not row.place or row is first:
            return ""
        if row.values == first.values:
            return "equal, later in" if row.run.added > first.run.added else "equal"
        return category.difference(row.behind) + word if row.behind else category.decided_by(row.values, first.values)

    def place(self, category: Category, row: Ranked, first: Ranked) -> str:
        """The place of a run, and by how much it is behind the first; "" for one that waits."""
        behind = self.behind(category, row, first, " behind")
        return f"{row.place}, {behind}" if behind else str(row.place or "")

    def shown_name(self, player: str) -> str:
        """A player's name in a table, with the earlier player whose name looks like it."""
        first = self.ranking.judged.alike.get(player)
        return shown_text(player, _MAX_NAME) + (f" (not {shown_text(first, _MAX_NAME)})" if first else "")

    def player_link(self, player: str, up: str = "") -> Content:
        return tag("a", self.shown_name(player), href=f"{up}{player_page(player)}.html") if player else ""

    def run_cells(self, run: Run, *results: Content, timed: bool = True, mark: Content = None) -> tuple[Content, ...]:
        """Cells of a run, for heads that end in RUN_HEADS.

        ``timed``: with its medal, which is for the time; ``mark``: before the player's name.
        """
        gold = f"{run.gold} of {run.entry.all_gold}"
        medal = medal_mark(run.medal if timed else "")
        about = made_text(run), gold, run.day, medal, self.run_link(run, UP)
        others = (
            tag("span", f" with {shown_text(run.co_authors, _MAX_NAME)}", class_="with") if run.co_authors else None
        )
        summary = tag("summary", "Waits" if run.waits else "Remark")
        note = tag("details", summary, run.remark, class_="note") if run.remark else None
        player = self.player_link(run.player, UP)
        linked = self.run_link(run, UP, str(results[0]))
        return joined(mark, player, others, note), linked, *results[1:], self.watch_link([run], UP), *about

    def shown_value(self, category: Category, run: Run) -> str:
        """The number that ranks a run, as text; "" if it is not in the category."""
        values = self.ranking.values(category, run)
        return category.text(values[0]) if values else ""

    def placed(self, digest: str, ladder: str) -> list[Ranked]:
        """The runs with a place in the first category of a ladder, except those far behind."""
        rows = self.ranking.tables.get(digest, {}).get((ladder, self.main), [])
        return [row for row in rows if row.place and not row.is_far]

    def counts_of(self, digest: str) -> str:
        """The numbers of a level's runs and players, over all ladders and categories."""
        runs = self.ranking.by_level.get(digest, [])
        players = {run.player for run in runs}
        return f"{counted(len(runs), 'run')} by {counted(len(players), 'player')}" if runs else "no run yet"

    def best_results(self, digest: str) -> list[Content]:
        """The best number and its player in the first category of each ladder with runs."""
        firsts: list[Content] = []
        for ladder in self.ranking.ladders:
            if first := next(iter(self.placed(digest, ladder)), None):
                name = ladder.capitalize() if len(self.ranking.ladders) > 1 else self.main.name
                result = tag("b", self.main.measured(first.values[0]))
                firsts.append(joined(tag("span", name), " ", result, " ", self.player_link(first.run.player)))
        return firsts

    def of_both(self) -> str:
        """A caption's addition if there are two ladders."""
        return "; runs and players are those of both ladders" if len(self.ranking.ladders) > 1 else ""


def player_page(player: str) -> str:
    """The file of a player's page, without its ending: an untrusted name never becomes a path."""
    return f"players/{sha256(player.encode('utf-8', 'replace')).hexdigest()[:16]}"


def linked_level(entry: Entry, up: str = "") -> Markup:
    return tag("a", shown_text(entry.title, _MAX_NAME), href=up + page_name(entry.digest))


def card(entry: Entry, *facts: Content) -> Markup:
    """A level with its picture, both links, and lines about it. For a page in the board's own folder."""
    image = tag("img", src=picture_name(entry.digest), alt="", **PICTURE_SIZE, loading="lazy")
    number = tag("span", f"Level {entry.number}", class_="number") if entry.number else None
    lines = (tag("p", fact, class_="facts") for fact in facts if fact)
    return tag("li", image, tag("h3", number, linked_level(entry)), *lines, class_="card")


def cards(caption: str, contents: Iterable[Content]) -> Markup:
    return joined(tag("p", caption, class_="faint"), tag("ul", *contents, class_="cards"))


def made_text(run: Run) -> Markup:
    """The provenance of a run; a long text is folded."""
    if len(run.made) <= LONG_CELL:
        return tag("span", run.made or "unknown", class_="made")
    return tag("details", tag("summary", "Assisted" if run.assisted else "Played"), run.made, class_="note made")


def stack(*lines: Content) -> Markup:
    """Lines in one cell of a table, without empty ones."""
    return tag("div", *(tag("div", line) for line in lines if line), class_="stack")


def _stem(run: Run) -> str:
    """The stem of the file in ``replays`` with a run, derived from the file's content."""
    author = run.entry.named.author
    facts = run.digest, str(run.record), run.player, run.entry.title, author, run.made, run.co_authors, run.level
    return sha256("\0".join(facts).encode("utf-8", "replace")).hexdigest()[:16]
