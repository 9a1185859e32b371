"""What the board's pages are made of: links to runs, players and levels, and tables of any length."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from ninja_game.files.shown_text import shown_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.player.catalogue import Entry
from ninja_game.web.board.charts import paths
from ninja_game.web.board.ranking import Ranking
from ninja_game.web.board.rules import Category
from ninja_game.web.board.runs import Run
from ninja_game.web.pages.frame import GAME, REPLAYS, Content, Markup, Pages, joined, page, table, tag
from ninja_game.web.pages.gallery import BOARD, medal_mark, page_name, picture_name, run_page, watch_address
from ninja_game.web.pages.memo import Memo

PER_PAGE = 100
"""Rows of a table that goes on on another page: a page has at most 100 KB."""

LONGEST_NAME = 40  # characters of a name in a table

UP = "../"
RUN_HEADS = ("Watch", "Share", "Medal", "Gold", "Made", "Date", "Remark")
LINKS = [
    ("index.html", "Board"), ("players.html", "Players"), ("levels.html", "Levels"), ("episodes.html", "Episodes"),
    ("rejected.html", "Rejected"),
]  # fmt: skip


class Parts:
    """A board that is written into ``out/board/``. ``up``: the way from a page to that folder, "" or UP.

    ``address``: where ``out`` will be, if that is known.
    """

    def __init__(
        self, out: Path, ranking: Ranking, game: str = GAME, memo: Memo | None = None, *, address: str = ""
    ) -> None:
        self.pages = Pages(out, BOARD, memo)
        self.ranking = ranking
        self.entries = ranking.shown.entries
        self.part_name = ranking.part_name
        self.main = ranking.categories[0]
        self.game = f"../{game}"
        self.site = address and f"{address}{BOARD}/"
        assisted = [("assisted.html", "Assisted")] if len(ranking.ladders) > 1 else []
        self.links = [(self.game, "Play"), *LINKS[:2], *assisted, *LINKS[2:]]
        self.deeper = [(UP + address, name) for address, name in self.links]
        self.stems = {run.key: _stem(run) for run in ranking.judged.runs}

    def list(
        self, name: str, title: str, caption: str, heads: Sequence[str], rows: Sequence[Any], *before: Content,
        cells: Callable[[Any], tuple[Content, ...]] = tuple,
    ) -> None:  # fmt: skip
        """A table on as many pages as it takes. ``rows``: plain values, of which ``cells`` makes what is shown."""
        up, links = (UP, self.deeper) if "/" in name else ("", self.links)
        parts = [rows[first : first + PER_PAGE] for first in range(0, len(rows), PER_PAGE)] or [()]
        names = [f"{name}{f'-{number}' if number > 1 else ''}.html" for number in range(1, len(parts) + 1)]
        turns = [
            tag("a", f"Page {number}", href=up + each, aria_label=f"{title}, page {number} of {len(names)}")
            for number, each in enumerate(names, 1)
        ]
        for number, (file, part) in enumerate(zip(names, parts, strict=True)):
            lead = () if number else before
            others = joined(*(joined(each, " ") for each in turns if each is not turns[number]))
            more = tag("p", others, class_="pages") if others else None

            def content(part: Sequence[Any] = part, lead: Sequence[Content] = lead, more: Content = more) -> str:
                return page(title, *lead, table(caption, heads, map(cells, part)), more, up=up, links=links)

            self.pages.make(file, [title, caption, heads, part, lead, more, links], content)

    def watch(self, runs: Sequence[Run], up: str, text: str = "Watch") -> Markup:
        """A link that watches a run, the others as ghosts."""
        address = watch_address(up + self.game, *(self.stems[run.key] for run in runs))
        return tag("a", text, href=address, aria_label=f"{text}: {runs[0].player} on {runs[0].entry.title}")

    def leads(self, run: Run, up: str) -> tuple[Markup, Markup]:
        """Links that watch a run and that lead to its page."""
        address, said = f"{up}../{REPLAYS}/{self.stems[run.key]}.html", f"Share: {run.player} on {run.entry.title}"
        return self.watch([run], up), tag("a", "Share", href=address, aria_label=said)

    def run_page(self, run: Run) -> None:
        stem, title = self.stems[run.key], f"{self.name(run.player)} on {run.entry.title}"
        facts = [("Time", f"{seconds_text(run.tick)} s"), ("Score", seconds_text(run.score)), ("Gold", str(run.gold)),
                 ("Medal", run.medal), ("Made", run.made or "unknown"), ("Date", run.day)]  # fmt: skip
        about = run.entry, stem, title, facts, BOARD, self.game, self.links, self.site

        def content() -> str:
            picture = f"{UP}{BOARD}/{picture_name(run.level)}"
            return run_page(*about, paths(picture, [(self.name(run.player), run.path)]))

        self.pages.make_replay(f"{stem}.html", [title, *facts, self.links, self.site], content)

    def name(self, player: str) -> str:
        """A player's name in a table, and whose it is not where it looks like one that was there before."""
        first = self.ranking.judged.alike.get(player)
        return shown_text(player, LONGEST_NAME) + (f" (not {shown_text(first, LONGEST_NAME)})" if first else "")

    def player_link(self, player: str, up: str = "") -> Content:
        return tag("a", self.name(player), href=f"{up}{player_page(player)}.html") if player else ""

    def run(self, run: Run, *results: Content, timed: bool = True) -> tuple[Content, ...]:
        """Cells of a run, for heads that end in RUN_HEADS. ``timed``: with its medal, which is of the time."""
        about = medal_mark(run.medal if timed else ""), run.gold, run.made or "unknown", run.day, run.remark
        others = f" with {shown_text(run.co_authors, LONGEST_NAME)}" if run.co_authors else None
        return (joined(self.player_link(run.player, UP), others), *results, *self.leads(run, UP), *about)

    def value(self, category: Category, run: Run) -> str:
        """The number that a run is ranked by."""
        values = self.ranking.values(category, run)
        return category.text(values[0]) if values else ""


def player_page(player: str) -> str:
    """The file of a player's page, without its ending: an untrusted name never becomes a path."""
    return f"players/{sha256(player.encode('utf-8', 'replace')).hexdigest()[:16]}"


def level_link(entry: Entry, up: str = "") -> Markup:
    return tag("a", shown_text(entry.title, LONGEST_NAME), href=up + page_name(entry.digest))


def signed(ticks: int) -> str:
    """How much later, in seconds."""
    return ("-" if ticks < 0 else "+") + seconds_text(abs(ticks))


def _stem(run: Run) -> str:
    """The stem of the file in ``replays`` with a run: of all that the file holds."""
    named = run.entry.named
    told = run.digest, str(run.record), run.player, run.entry.title, named.author, run.made, run.co_authors
    return sha256("\0".join((*told, run.level)).encode("utf-8", "replace")).hexdigest()[:16]
