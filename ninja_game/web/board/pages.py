"""The pages of a board: all of them, and those of levels, episodes, and runs that do not count."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from shlex import quote

from ninja_game.board.categories import HIGHEST
from ninja_game.board.collect import is_in
from ninja_game.board.memo import Memo
from ninja_game.board.ranking import Ranking
from ninja_game.board.runs import REJECTED_KINDS, Run, RunKey
from ninja_game.errors import FileError
from ninja_game.files.reading import SUFFIXES
from ninja_game.files.shown_text import shown_text
from ninja_game.formats.run_time import seconds_text
from ninja_game.sim.rules import LIFETIME
from ninja_game.web.board.first_page import FEED, FirstPage
from ninja_game.web.board.level_pages import ROWS_SHOWN, LevelPages
from ninja_game.web.board.parts import EPISODES, HOW_TO_CONFIRM, NEAR, Parts, card, linked_level, stack
from ninja_game.web.board.player_pages import PlayerPages
from ninja_game.web.pages.frame import REPLAYS, Content, joined, page, section, table, tag
from ninja_game.web.pages.gallery import BOARD

MAX_FILE_NAME = 24  # characters of a name of a file

HOW_TO_MOVE = (
    "What no keyboard can do was made by tools. The keeper ranks it so with: "
    "ninja-game board FOLDER --json board.json --ladder FILE assisted, or all unknown ones by its rules."
)


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
        self.parts = Parts(out, ranking, memo, address=address)
        self.ranking = ranking
        self._players_with_runs = {run.player for run in ranking.judged.runs}

    def write(self) -> None:
        parts = self.parts
        levels, players = LevelPages(parts), PlayerPages(parts)
        first_page = FirstPage(parts, players)
        for entry in self.ranking.shown.entries.values():
            levels.write_level(entry)
        players.write()
        self._levels()
        self._rejected()
        if episodes := self._episodes():
            parts.pages.write(EPISODES[0], page(EPISODES[1], tag("p", EPISODE_NUMBERS), *episodes, links=parts.top))
        parts.pages.write("index.html", first_page.page())
        parts.pages.write(FEED, first_page.feed())
        # Last: if the disk is full, the earlier pages are still complete.
        for folder in ("players", "levels", "pictures"):
            parts.pages.clear(folder)
        parts.pages.finish()

    def _levels(self) -> None:
        parts = self.parts
        rows = [
            (card(entry, parts.counts_of(digest), *parts.best_results(digest)),)
            for digest, entry in self.ranking.shown.entries.items()
        ]
        caption = f"In playing order; who is first, in {parts.main.name}{parts.of_both()}"
        parts.write_table("levels", "Levels", caption, (), rows)

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
        parts = self.parts
        rejected = self.ranking.judged.rejected
        order = list(REJECTED_KINDS)
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
            about = (tag("p", NEAR), tag("p", HOW_TO_CONFIRM))
            caption = "Runs without a place"
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


def _file(name: str, record: int) -> Content:
    """A file, and the record in it; a long name is folded."""
    text = f"{name}, record {record}" if record else name
    short = shown_text(text, MAX_FILE_NAME)
    return tag("details", tag("summary", short), text, class_="note") if short != text else text
