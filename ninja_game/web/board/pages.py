"""The board's pages: newest records, players, episodes, a table a level, and what does not count."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

from ninja_game.errors import FileError
from ninja_game.files.reading import SUFFIXES
from ninja_game.files.shown_text import shown_text
from ninja_game.formats.pack.pars import MEDALS
from ninja_game.formats.run_time import seconds_text
from ninja_game.player.catalogue import Entry
from ninja_game.web.board.ranking import FASTEST, HIGHEST, Ranked, Ranking
from ninja_game.web.board.report import summary
from ninja_game.web.board.runs import Rejected, Run
from ninja_game.web.pages.frame import REPLAYS, Content, Markup, Pages, joined, page, section, table, tag
from ninja_game.web.pages.gallery import BOARD, medal_mark, write_levels
from ninja_game.web.pages.published import page_name, shared_name, shared_text, watch_address

NEWEST, LEADING, TOGETHER = 40, 25, 4
"""Rows of the newest records and of the players on the first page; runs that are watched together."""

LONGEST_NAME = 40
"""Characters of a name in a table."""

HEADS = {FASTEST: "Fastest", HIGHEST: "Highest score"}
LINKS = [
    ("index.html", "Board"), ("players.html", "Players"), ("episodes.html", "Episodes"), ("rejected.html", "Rejected"),
]  # fmt: skip
WHY_REJECTED = {
    "practice": "Practice runs",
    "copy": "Copies of runs",
    "refused": "Runs that do not count",
    "unreadable": "Files that are not runs",
}


def check_site(out: Path, folder: Path) -> None:
    """Raise FileError where the pages in ``out`` would be written into the folder of runs, or around it."""
    for written in (out / BOARD, out / REPLAYS):
        if _is_in(written, folder) or _is_in(folder, written):
            what = f"the pages would be written into {written.name!r}, and the runs are read there"
            raise FileError(what, str(out), found=str(folder), hint="choose another folder for the pages")


def check_ledger(data: Path, folder: Path) -> None:
    """Raise FileError where the ledger would be read as a run the next time."""
    if _is_in(data, folder) and data.name.lower().endswith(SUFFIXES):
        raise FileError("the board would be read as a run", str(data), hint="choose a name that ends in .json")


def _is_in(path: Path, folder: Path) -> bool:
    """Whether a path, of something that may not be there yet, is a folder or leads into it; links are followed."""
    place = path.resolve()
    return folder.exists() and any(each.exists() and each.samefile(folder) for each in (place, *place.parents))


class BoardPages:
    """Writes the pages of a ranking into ``out/board/``, and its runs into ``out/replays/``.

    ``game``: name of the page with the game in ``out``. Raises FileError where ``out/board`` holds something else.
    """

    def __init__(self, out: Path, ranking: Ranking, game: str = "index.html") -> None:
        self.pages = Pages(out, BOARD)
        self.ranking = ranking
        self.game = f"../{game}"
        self.links = [(self.game, "Play"), *LINKS, ("levels.html", "Levels")]
        self.stems: dict[tuple[str, int], str] = {}

    def write(self) -> None:
        for run in self.ranking.judged.runs:
            text = shared_text(run.replay, run.entry.named.level)
            self.stems[run.key] = shared_name(text)
            self.pages.write_replay(self.stems[run.key], text)
        for standing in self.ranking.standings:
            self.pages.write(_player_page(standing.player), self._player(standing.player))
        links = [(self.game, "Play"), *LINKS]
        write_levels(self.pages, self.ranking.shown, self.game, "levels.html", links, self._level)
        self.pages.write("index.html", self._first())
        self.pages.write("players.html", page("Players", self._players(len(self.ranking.standings)), links=self.links))
        self.pages.write("episodes.html", page("Episodes", *self._episodes(), links=self.links))
        self.pages.write("rejected.html", page("Rejected", *self._rejected(), links=self.links))
        self.pages.clear("players")

    # --- parts of several pages ---

    def _watch(self, runs: Sequence[Run], up: str, text: str) -> Markup:
        """A link that watches a run, the others as ghosts."""
        address = watch_address(f"{up}{self.game}", *(self.stems[run.key] for run in runs))
        names = f"{runs[0].player} on {runs[0].entry.title}"
        return tag("a", text, href=address, aria_label=f"{text}: {names}")

    @staticmethod
    def _name(player: str, up: str = "") -> Markup:
        return tag("a", shown_text(player, LONGEST_NAME), href=up + _player_page(player))

    @staticmethod
    def _entry(entry: Entry, up: str = "") -> Markup:
        return tag("a", shown_text(entry.title, LONGEST_NAME), href=up + page_name(entry.digest))

    # --- the pages ---

    def _first(self) -> str:
        rows = [
            (
                self._entry(record.run.entry), self._watch([record.run], "", "Watch"), HEADS[record.kind],
                self._name(record.run.player), _value(record.kind, record.run),
                _gain(record.kind, record.run, record.before), record.run.day,
            )
            for record in self.ranking.records[:NEWEST]
        ]  # fmt: skip
        heads = ("Level", "", "Record", "Player", "Result", "Better by", "Date")
        newest = section("Newest records", table("Newest first", heads, rows)) if rows else None
        leading = section("Players", self._players(LEADING))
        lead = tag("p", f"{self.ranking.shown.name}: {summary(self.ranking.judged)}.", class_="lead")
        said = "Every run was simulated again: times, gold and scores are the result of its inputs."
        return page("Board", lead, tag("p", said), newest, leading, links=self.links)

    def _players(self, most: int) -> Markup:
        heads = ("Player", "Levels", "Runs", "Fastest", "Highest", *(medal.capitalize() for medal in MEDALS))
        rows: list[tuple[Content, ...]] = [
            (self._name(each.player), each.levels, each.runs, *each.records.values(), *each.medals.values())
            for each in self.ranking.standings[:most]
        ]
        return table("By levels led, then by levels passed", heads, rows)

    def _player(self, player: str) -> str:
        rows = []
        for fastest, highest in self.ranking.of_player(player):
            entry = (fastest or highest).run.entry  # type: ignore[union-attr]
            cells = *self._cells(FASTEST, fastest), *self._cells(HIGHEST, highest)
            rows.append((entry.episode, self._entry(entry, "../"), *cells))
        heads = ("", "Level", "Time", "Place", "", "", "Score", "Place", "")
        links = [(f"../{address}", name) for address, name in self.links]
        return page(player, table("Best run of each level", heads, rows), up="../", links=links)

    def _cells(self, kind: str, ranked: Ranked | None) -> tuple[Content, ...]:
        """Result and place of a player in a table, the medal, and a link to the run."""
        medal = kind == FASTEST
        if ranked is None:
            return ("", "", "", "") if medal else ("", "", "")
        run = ranked.run
        marks = (medal_mark(run.medal),) if medal else ()
        return _value(kind, run), ranked.place, *marks, self._watch([run], "../", "Watch")

    def _level(self, entry: Entry) -> Content:
        """The tables of a level, for its page."""
        tables = self.ranking.tables.get(entry.digest)
        if not tables:
            return section("Runs", tag("p", "Nobody has passed this level here yet."))
        return joined(*(self._table(kind, ranked) for kind, ranked in tables.items()))

    def _table(self, kind: str, ranked: Sequence[Ranked]) -> Markup:
        rows: list[tuple[Content, ...]] = [
            (
                each.place, self._name(each.run.player, "../"), _value(kind, each.run),
                self._watch([each.run], "../", "Watch"), medal_mark(each.run.medal), each.run.gold, each.run.day,
                each.run.remark,
            )
            for each in ranked
        ]  # fmt: skip
        heads = ["Place", "Player", "Score" if kind == HIGHEST else "Time", "", "", "Gold", "Date", "Remark"]
        if not any(each.run.remark for each in ranked):
            rows, heads = [row[:-1] for row in rows], heads[:-1]
        first = [each.run for each in ranked[:TOGETHER]]
        together = tag("p", self._watch(first, "../", f"Watch the first {len(first)} together"))
        return section(HEADS[kind], together if len(first) > 1 else None, table("Best run of each player", heads, rows))

    def _episodes(self) -> list[Content]:
        found: list[Content] = []
        for number, episode in sorted(self.ranking.shown.levels.episodes.items()):
            rows = [
                (place, self._name(player), f"{seconds_text(ticks)} s", ", ".join(map(_time, runs)))
                for place, (player, ticks, runs) in enumerate(self.ranking.episode(episode), 1)
            ]
            levels = [joined(", " if place else "", self._entry(each)) for place, each in enumerate(episode.levels)]
            heads = ("Place", "Player", "Sum", "Levels")
            best = table("Sum of the best times of all its levels", heads, rows) if rows else tag("p", "No player yet.")
            found.append(section(f"Episode {number:02d}: {episode.name}", tag("p", *levels), best))
        return found or [tag("p", "These levels have no episodes.")]

    def _rejected(self) -> list[Content]:
        rejected = self.ranking.judged.rejected
        counts = Counter(each.kind for each in rejected)
        found: list[Content] = []
        for kind, title in WHY_REJECTED.items():
            rows = [
                (_place(each), shown_text(each.player, LONGEST_NAME), shown_text(each.level, LONGEST_NAME), each.why)
                for each in rejected
                if each.kind == kind
            ]
            if rows:
                listed = table("None of them is ranked", ("File", "Player", "Level", "Why"), rows)
                found.append(section(f"{title} ({counts[kind]})", listed))
        return found or [tag("p", "Every file of the folder is a run that counts.")]


def _player_page(player: str) -> str:
    """The file of a player's page: an untrusted name never becomes a path."""
    return f"players/{sha256(player.encode('utf-8', 'replace')).hexdigest()[:16]}.html"


def _place(rejected: Rejected) -> str:
    return rejected.file + (f", record {rejected.record}" if rejected.record else "")


def _time(run: Run) -> str:
    return seconds_text(run.tick)


def _value(kind: str, run: Run) -> str:
    return seconds_text(run.score if kind == HIGHEST else run.tick)


def _gain(kind: str, run: Run, before: Run | None) -> str:
    if before is None:
        return "first"
    return seconds_text(run.score - before.score if kind == HIGHEST else before.tick - run.tick)
