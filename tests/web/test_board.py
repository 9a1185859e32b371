"""The board: only inputs are believed, all else is refused or shown as what it is, and no text becomes markup."""

import os
import re
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import UTC, datetime
from html import escape
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import numpy as np
import pytest
from click.testing import CliRunner

from ninja_game.board import collect
from ninja_game.board.categories import FASTEST, HIGHEST, Category
from ninja_game.board.collect import MAX_RECORDS
from ninja_game.board.copies import Near
from ninja_game.board.judge import Keeping, judge
from ninja_game.board.ranking import Ranking
from ninja_game.board.report import DATE, read_board
from ninja_game.board.runs import ASSISTED, PLAYED, RunKey, ValidatedRuns
from ninja_game.cli.main import cli
from ninja_game.errors import FileError
from ninja_game.files.bundled import bundled_replays, data_folder
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import parse_replay, write_replay
from ninja_game.levels.published import published_levels
from ninja_game.runs.compare import aligned
from ninja_game.runs.run import record_replay
from ninja_game.web.board.charts import paths, speed_and_keys
from ninja_game.web.board.pages import BoardPages
from ninja_game.web.board.parts import player_page
from ninja_game.web.pages.frame import POLICY, tag
from ninja_game.web.pages.gallery import page_name
from tests.support.board import DIGEST, HOSTILE, Tags, put, slow_walk, taken_in_earlier, words_of
from tests.support.forgeries import FORGERIES, GOLD_LATER, PRACTISED, WALKING, record, replay
from tests.support.own_pack import PACK
from tests.support.samples import WALK, WALK_END
from tests.support.special_files import needs_special_files

BROKEN = """
Array.from(document.querySelectorAll(innerWidth > 704 ? "td, th" : "td")).filter((cell) => {
  const range = document.createRange();
  range.selectNodeContents(cell);
  const long = cell.querySelector(".text, .made, a") || (innerWidth < 704 && cell.matches("#splits td:nth-child(2)"));
  return !long && range.getBoundingClientRect().height > 36;
}).map((cell) => cell.textContent)
"""
"""Cells that have more than a line, and no long text, name or way of making; a narrow page breaks heads."""

ALL = "<caption>All runs"

SAID = """
Array.from(new Set(Array.from(document.querySelectorAll(".wide"))
  .filter((each) => each.querySelector("th:nth-child(7)"))
  .map((each) => getComputedStyle(each, "::before").content).filter((each) => each !== "none").map(JSON.parse)))
"""
"""What stands above tables of many columns: that they go on at the side of the page."""


def judged_by_file_dates(folder: Path, levels: Path) -> ValidatedRuns:
    """A folder judged with the times of its files as the dates of the ledger."""

    def date(key: RunKey, way: str) -> str:
        return datetime.fromtimestamp((folder / key[0]).lstat().st_mtime, UTC).strftime(DATE) if way else ""

    return judge(folder, published_levels(levels), Keeping(dates=date), jobs=1)


def why(folder: Path, levels: Path) -> str:
    found = judged_by_file_dates(folder, levels)
    assert found.runs == ()
    return " ".join(f"{each.kind} {each.why}" for each in found.rejected)


def test_runs_are_ranked_by_what_the_simulation_says(runs: Path, levels: Path) -> None:
    put(runs, "b/slow.txt", slow_walk(author="Bea"), day=1)
    put(runs, "a/fast.txt", replay(author="Ann"), day=2)
    put(runs, "c/record.txt", record(bytes(2) + WALKING), day=3)
    ranking = Ranking(judged_by_file_dates(runs, levels), published_levels(levels))
    table = ranking.tables[DIGEST][PLAYED, FASTEST]
    assert [(each.place, each.run.player, each.run.tick) for each in table] == [
        (1, "Ann", WALK_END), (2, "unknown (c/record.txt)", WALK_END + 2), (3, "Bea", WALK_END + 5),
    ]  # fmt: skip
    assert [each.run.score for each in ranking.tables[DIGEST][PLAYED, HIGHEST]] == [
        3600 + 80 - WALK_END - late for late in (0, 2, 5)
    ]
    assert [(each.run.player, [*each.gains.values()]) for each in ranking.records] == [
        ("Ann", [5.0, 5.0]), ("Bea", [None, None]),
    ]  # fmt: skip
    assert [(each.player, each.levels, each.ranks) for each in ranking.standings[PLAYED]] == [
        ("Ann", 1, [1]), ("Bea", 1, [3]), ("unknown (c/record.txt)", 1, [2]),
    ]  # fmt: skip
    (episode,) = ranking.shown.levels.episodes.values()
    assert ranking.episode(episode, (PLAYED, FASTEST))[0][:2] == ("Ann", WALK_END)


def test_a_record_says_by_how_much_it_is_better(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"), day=1)
    put(runs, "b.txt", replay(author="Bea"), day=2)
    BoardPages(tmp_path / "site", Ranking(judged_by_file_dates(runs, levels), published_levels(levels))).write()
    page = (tmp_path / "site" / "board" / "index.html").read_text("utf-8")
    newest = page.partition("<h2>Newest records")[2].partition("<section")[0]
    first, second = (words_of(each) for each in newest.split("<li")[1:3])
    assert "Fastest 0.575 s better by 0.125 Highest score 91.425 points better by 0.125" in first
    assert "Fastest 0.700 s first Highest score 91.300 points first" in second
    assert "<table" not in newest, "a new record fills one card"
    assert re.findall(">([0-9-]{10})<", newest) == ["1970-01-03", "1970-01-02"]
    neat = Category("Neat", ("gold", "ticks"))
    BoardPages(
        tmp_path / "neat", Ranking(judged_by_file_dates(runs, levels), published_levels(levels), (neat,))
    ).write()
    page = (tmp_path / "neat" / "board" / "index.html").read_text("utf-8")
    assert re.findall("Neat 1 gold (better by ticks|first)", words_of(page)) == ["better by ticks", "first"]
    level = (tmp_path / "neat" / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    assert "<td>ticks</td>" in level.partition('id="records"')[2]


def test_who_has_only_assisted_runs_is_among_the_players_too(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "b.txt", replay(author="Bot", made=Provenance(edits=7)))
    pages = board_of(runs, levels, tmp_path / "site")
    index, played, assisted = ((pages / f"{name}.html").read_text("utf-8") for name in ("index", "players", "assisted"))
    for ladder, player in (("played", "Ann"), ("assisted", "Bot")):
        assert f">{player}</a>" in index.partition(f"<h2>Players, {ladder}</h2>")[2].partition("</table>")[0]
    assert '<p><a href="assisted.html">Players, assisted</a></p>' in played
    assert '<p><a href="players.html">Players, played</a></p>' in assisted


def test_runs_of_both_ladders_stand_side_by_side(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", slow_walk(author="Ann"))
    level = board_of(runs, levels, tmp_path / "site") / "levels" / f"{DIGEST[:16]}.html"
    page = level.read_text("utf-8")
    assert (page.count('class="way"'), 'id="splits"' in page) == (2, False), "a path for one run: line and legend"
    put(runs, "bot.txt", replay(author="Bot", made=Provenance(edits=7)))
    board_of(runs, levels, tmp_path / "site")
    page = level.read_text("utf-8")
    splits = page.partition('<section id="splits">')[2]
    heads = [words_of(head) for head in re.findall('<th scope="col">(.*?)</th>', splits)]
    assert heads == ["No.", "Split", "Bot, assisted", "Fastest segment", "Ann"]
    assert "<caption>Seconds; later than Bot, assisted: +;" in splits
    assert "<td>+0.125</td>" in splits, "from the fastest, which is not the first in the picture"
    (path,) = (each for each in (tmp_path / "site" / "replays").glob("*.html") if "<dd>edited" in each.read_text())
    assert "#splits" in path.read_text("utf-8")


def test_a_batch_is_one_row_of_the_first_page(
    runs: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "b.txt", replay(author="Bot", made=Provenance(edits=7)))
    for most, rows, noted in ((2, 2, False), (1, 1, True)):
        monkeypatch.setattr("ninja_game.web.board.first_page.MAX_OF_A_MOMENT", most)
        index = (board_of(runs, levels, tmp_path / f"{most}") / "index.html").read_text("utf-8")
        newest = index.partition("<h2>Newest records")[2].partition("</tbody>")[0]
        count = newest.partition("</ul>")[0].count("<li ") if not noted else newest.count("<tr>") - 1
        assert (count, "2 runs with records came in together" in newest) == (rows, noted)
    assert index.index("<h2>Newest") < index.index("<h2>Players, played")
    assert "UTC" not in index, "nobody knows a date"
    for text in ('<a href="levels.html">1 level</a>', "<td>2 players</td>"):
        assert text in newest


def test_levels_have_the_best_of_each_ladder(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "b.txt", replay(author="Bot", made=Provenance(edits=7)))
    site = board_of(runs, levels, tmp_path / "site")
    page = (site / "levels.html").read_text("utf-8")
    assert "2 runs by 2 players Played 0.700 s Ann Assisted 0.575 s Bot" in words_of(page)
    assert "those of both ladders" in page


def test_levels_whose_records_were_not_beaten_go_by_how_close_the_second_is(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "b.txt", replay(level=GOLD_LATER, author="Bea"))
    page = (board_of(runs, levels, tmp_path / "one") / "index.html").read_text("utf-8")
    assert "Most contested" not in page, "nobody is second, and no record was beaten"
    newest = page.partition("<h2>Levels of the newest runs")[2]
    assert newest.count("<img") == 2, "there are levels with pictures even so"
    put(runs, "c.txt", replay(bytes(8) + WALKING + b"\2", GOLD_LATER, author="Ann"))
    put(runs, "d.txt", replay(author="Bea"))
    page = (board_of(runs, levels, tmp_path / "site") / "index.html").read_text("utf-8")
    contested = words_of(page.partition("<h2>Most cont")[2])
    assert "By how close the second is, in Fastest" in contested
    assert "beaten" not in contested
    assert re.findall("second ([0-9.]+) behind", contested) == ["0.125", "0.200"]
    for name, wait in (("e.txt", 9), ("f.txt", 10)):
        walk = replay(bytes(wait) + WALKING + b"\2", GOLD_LATER, author=name, made=Provenance(edits=3))
        put(runs, name, walk)
    page = (board_of(runs, levels, tmp_path / "site") / "index.html").read_text("utf-8")
    spreads = re.findall("(played|assisted): second ([0-9.]+) behind", words_of(page.partition("<h2>Most cont")[2]))
    assert spreads == [("played", "0.200"), ("assisted", "0.025"), ("played", "0.125")], "the closest of all ladders"


def test_the_most_contested_levels_are_in_the_order_of_their_count(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Records of both ladders and all categories, without the first entry of each."""
    for name, level, waits, made in (
        ("a", WALK, (9, 5, 0), Provenance(played=True)), ("b", GOLD_LATER, (9, 0), Provenance(played=True)),
        ("c", GOLD_LATER, (8, 5, 2), Provenance(edits=3)),
    ):  # fmt: skip
        for number, wait in enumerate(waits):
            walk = replay(bytes(wait) + WALKING + b"\2", level, author=f"P{number}", made=made)
            put(runs, f"{name}{number}.txt", walk)
    days = {f"{name}{number}.txt": f"2026-01-0{number + 1}T12:00:00Z" for name in "abc" for number in range(3)}
    shown = published_levels(levels)
    judged = judge(runs, shown, Keeping(dates=lambda key, _: days[key[0]]), jobs=1)
    BoardPages(tmp_path / "site", Ranking(judged, shown)).write()
    page = (tmp_path / "site" / "board" / "index.html").read_text("utf-8").partition("<h2>Most cont")[2]
    assert "By how often records were beaten, of all categories and ladders; results are" in page
    assert re.findall("([0-9]+) records beaten", page) == ["6", "4"]


def test_a_list_shows_levels_with_their_numbers_and_pictures(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Also those of a file of N, where the number is the comment."""
    put(runs, "a.txt", replay(author="Ann"))
    (file := tmp_path / "levels.txt").write_text(f"$Walk#metanet#18-2#{WALK}#\n", "utf-8")
    page = (board_of(runs, file, tmp_path / "site") / "levels.html").read_text("utf-8")
    assert "Level 18-2" in page
    (source,) = re.findall('<img src="([^"]+)"', page)
    assert (tmp_path / "site" / "board" / source).read_bytes().startswith(b"\x89PNG")
    result = CliRunner().invoke(cli, ["board", "ask", str(runs), "rank", "18-2", "--levels", str(file), "--jobs", "1"])
    assert result.stdout.startswith("18-2 Walk, fastest, played:"), result.output


def test_a_level_tells_in_which_second_time_goes(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", slow_walk(20, author="Ann"))
    put(runs, "b.txt", slow_walk(26, author="Bea"))
    page = (board_of(runs, levels, tmp_path / "site") / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    part = page.partition("<h2>Where time goes</h2>")[2].partition("</section>")[0]
    assert re.findall("<p>([^<]+)</p>", part) == ["Bea loses most between 0 s and 1 s of Ann: 0.150 s."]
    assert re.findall("<td>([^<]+)</td>", part) == ["1 s", "+0.150"]
    put(runs, "tas.txt", replay(bytes(18) + WALKING + b"\2", author="TAS", made=Provenance(edits=7)))
    page = (board_of(runs, levels, tmp_path / "site") / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    lost = ("Ann", "0.050"), ("Bea", "0.200")
    races = page.partition("<h2>Any two of the first")[2].partition("</table>")[0]
    assert re.findall("#watch=[0-9a-f]{16}-([0-9]),[0-9a-f]{16}-([0-9])", races) == [
        ("0", "1"), ("0", "2"), ("1", "0"), ("1", "2"), ("2", "0"), ("2", "1"),
    ], "in the colours of the picture"  # fmt: skip
    noted = [f"{name} loses most between 0 s and 1 s of TAS, assisted: {time} s." for name, time in lost]
    assert re.findall("<p>([^<]+)</p>", page.partition("<h2>Where time goes</h2>")[2]) == noted


def test_how_a_run_was_made_is_shown_once(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", replay(bytes(8) + WALKING + b"\2", author="Bea", made=Provenance(played=True)))
    page = (board_of(runs, levels, tmp_path / "site") / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    assert (set(re.findall('class="made">([^<]+)<', page)), 'class="note"' in page) == ({"unknown", "played"}, False)


def test_a_player_sees_the_places_of_all_categories(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    site = board_of(runs, levels, tmp_path / "site")
    (page,) = (
        text for text in map(Path.read_text, (site / "players").glob("*.html")) if "<title>Bea" in text and ALL in text
    )
    assert re.findall("<div>([^<]+)</div>", page) == ["Fastest: 2, 0.125 behind", "Highest score: 2, 0.125 behind"]


def test_what_decides_between_runs_with_one_number_is_said(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"), day=1)
    put(runs, "b.txt", slow_walk(author="Bea"), day=2)
    categories = Category("Neat", ("gold", "ticks")), Category("Gold", ("gold",))
    ranking = Ranking(judged_by_file_dates(runs, levels), published_levels(levels), categories)
    BoardPages(tmp_path / "site", ranking).write()
    (page,) = (
        each
        for each in map(Path.read_text, (tmp_path / "site").rglob("*.html"))
        if "<title>Bea -" in each and ALL in each
    )
    assert re.findall("<div>([^<]+)</div>", page) == ["Neat: 2, same value, slower", "Gold: 1, equal, later in"]
    level = (tmp_path / "site" / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    assert re.findall("<td>(same[^<]*|equal[^<]*)<", level) == ["same value, slower", "equal, later in"]
    (folder,) = {run.folder for run in ranking.judged.runs}
    assert not folder.known, "nothing of a run is kept when its pages are written"


def test_splits_lead_to_numbers_in_the_picture(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    page = (board_of(runs, levels, tmp_path / "site") / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    splits = page.partition('id="splits"')[2].partition("</table>")[0]
    assert re.findall('<td><a href="#place-([0-9])">[0-9]</a></td><td>([^<]+)', splits) == [
        ("1", "gold 2"), ("2", "switch of exit 1"), ("3", "exit"),
    ]  # fmt: skip
    marks = re.findall('<circle cx="([0-9]+)"[^>]*></circle><text[^>]*>([0-9])<', page)
    assert [number for _, number in marks] == ["1", "2", "3"]
    assert marks[0][0] == "115"
    assert re.findall('<g id="place-([0-9])" class="mark', page) == ["1", "2", "3"]


def test_a_number_that_would_cover_another_one_waits_for_its_link() -> None:
    drawn = paths("a.png", [("Ann", "M0 0")], [(50, 50), (55, 60), (80, 50)])
    assert re.findall('id="(place-[0-9])" class="([^"]+)"', drawn) == [
        ("place-1", "mark"), ("place-2", "mark covered"), ("place-3", "mark"),
    ]  # fmt: skip


def test_a_time_leads_to_its_run_and_file_to_the_replay(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    site = tmp_path / "site"
    page = (board_of(runs, levels, site) / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    (stem,) = (each.stem for each in (site / "replays").glob("*.txt"))
    address = f"../../replays/{stem}"
    assert f'<a href="{address}.html" aria-label="0.575: Ann on Walk">0.575</a>' in page
    assert f'<a href="{address}.txt" download aria-label="File: Ann on Walk">File</a>' in page
    run = (site / "replays" / f"{stem}.html").read_text("utf-8")
    assert re.search('<a href="../board/players/[0-9a-f]{16}.html">All runs of the player</a>', run)


def test_a_better_time_goes_down_and_a_better_score_up(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"), day=1)
    put(runs, "b.txt", replay(author="Ann"), day=2)
    BoardPages(tmp_path / "site", Ranking(judged_by_file_dates(runs, levels), published_levels(levels))).write()
    page = (tmp_path / "site" / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    for title, better in (("fell: Fastest", 1), ("rose: Highest score", -1)):
        chart = page.partition(f"How the record {title}")[2].partition("</svg>")[0]
        first, last = map(float, re.findall('cy="([0-9.]+)"', chart))
        assert (last - first) * better > 100, title


def test_tables_of_a_level_have_no_empty_column_and_fold_remarks(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", slow_walk(40, author="Ann"))
    put(runs, "bob.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Bob"), day=1)
    put(runs, "cid.txt", slow_walk(90, author="Cid"), day=2)
    shown, slowest = published_levels(levels), Category("Slowest", ("-ticks",))
    ranking = Ranking(judged_by_file_dates(runs, levels), shown, (FASTEST, HIGHEST, slowest))
    BoardPages(tmp_path / "site", ranking).write()
    page = (tmp_path / "site" / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    tables = page.split("<caption>Best run of each player</caption>")[1:]
    heads = [re.findall("<th [^>]*>([^<]+)", each.partition("</thead>")[0]) for each in tables]
    others = ["Watch", "Made", "Gold", "Date", "File"]
    assert heads == [["Place", "Player", *units, "Behind", *others] for units in (["Time", "Score"], ["Time"])], (
        "same order, once"
    )
    contents = page.partition('aria-label="On this page"')[2].partition("</nav>")[0]
    assert re.findall('<a href="#([^"]+)">([^<]+)</a>', contents) == [("records", "Records"), ("splits", "Splits")]
    leaders = re.findall('<li class="card leader">(.*?)</li>', page)
    assert [re.findall('href="(#[^"]+)"', each) for each in leaders] == [["#ranks-1"], ["#ranks-1"], ["#ranks-2"]]
    for text, leader in zip(
        ("Fastest 1.575 s Ann", "Highest score 90.425 points Ann", "Slowest 2.825 s Cid"), leaders, strict=True
    ):
        assert words_of(leader).startswith(text)
    assert re.findall('<section id="([^"]+)">', page) == ["ranks-1", "ranks-2", "records", "races", "splits"]
    picture, parts = page.partition("<main")[2].partition("<section")[::2]
    assert ('class="paths"' in picture, "<img" in picture, 'class="paths"' in parts) == (True, False, False)
    assert "How the other records went" not in page, "one record was beaten"
    remark_text = "<summary>Remark</summary>64 of its 65 ticks have the inputs of the run by Ann in ann.txt, "
    assert [each.count(remark_text) for each in tables] == [1, 1], "folded"
    assert "Sum of the fastest segments, each from the row above: 1.575 s." in page
    assert re.findall("<td>([^<]+)</td>", tables[0].partition(">Bob<")[2])[1] == "0.025"


def test_categories_stand_in_the_order_of_the_rules(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Also where two with another one between them share a table."""
    for wait, edits in ((4, 0), (7, 0), (5, 3), (9, 3)):
        made = Provenance(played=not edits, edits=edits)
        put(runs, f"{wait}.txt", replay(bytes(wait) + WALKING + b"\2", author=f"P{wait}", made=made))
    categories = FASTEST, Category("Slowest", ("-ticks",)), Category("Any", ("ticks",)), HIGHEST
    shown = published_levels(levels)
    BoardPages(tmp_path, Ranking(judge(runs, shown, jobs=1), shown, categories)).write()
    page = (tmp_path / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    leaders = re.findall('<li class="card leader"><a href="#(ranks-[0-9])">([^<]+)', page)
    names, tables = ["Fastest", "Slowest", "Any", "Highest score"], [1, 2, 1, 1]
    assert leaders == [
        (f"ranks-{table + more}", f"{name}, {ladder}")
        for more, ladder in ((0, PLAYED), (2, ASSISTED))
        for name, table in zip(names, tables, strict=True)
    ]
    first = page.partition('id="ranks-1"')[2].partition("</thead>")[0]
    assert re.findall("<th [^>]*>([^<]+)", first)[2:5] == ["Time", "Score", "Behind"], "each number once"


def test_the_sum_of_segments_is_not_slower_than_the_fastest_run(runs: Path, tmp_path: Path) -> None:
    """Which is assisted here, and leaves gold out that the first of those played takes."""
    level = "0" * 713 + "|5^100,566!11^220,564,190,564!0^130,530!0^115,566"
    (folder := tmp_path / "pack").mkdir()
    text = write_ascii_level(parse_level_string(level), name="Gold")
    (folder / "gold.txt").write_text(text, "utf-8")
    put(runs, "fast.txt", replay(bytes([2] * 41), level, author="Fast", made=Provenance(edits=3)))
    put(runs, "gold.txt", replay(bytes([2] * 6 + [14, 6, 6] + [2] * 38), level, author="Gold"))
    put(runs, "late.txt", replay(bytes(5) + bytes([2] * 3 + [14, 6] + [2] * 42), level, author="Late"))
    pages = board_of(runs, folder, tmp_path / "site") / "levels"
    (page,) = (each.read_text("utf-8") for each in pages.glob("*.html") if "-runs" not in each.name)
    assert "All runs: 3" in page
    fastest, *_ = re.findall('aria-label="([0-9.]+): Fast on', page)
    (total,) = re.findall("each from the row above: ([0-9.]+) s", page)
    assert float(total) <= float(fastest)
    kinds = re.findall(r'#place-[0-9]+">[0-9]+</a></td><td>([a-z ]+[a-z])', page)
    assert kinds[:3] == ["gold", "switch of exit", "exit"], "the rows of the fastest"


def test_medals_follow_from_the_par_times(runs: Path) -> None:
    certificates = [path for path in bundled_replays() if ".exit." in path.name][:3]
    for path in certificates:
        put(runs, path.name, path.read_text("utf-8"))
    pack = published_levels(data_folder("levels")) if data_folder("levels").is_dir() else pytest.skip("no levels")
    ranking = Ranking(judge(runs, pack, jobs=1), pack)
    assert ranking.standings[ASSISTED][0].medals["author"] == len(certificates)


def test_a_player_has_one_row_a_table_the_best_one(runs: Path, levels: Path) -> None:
    for wait in (7, 3, 5):
        put(runs, f"{wait}.txt", slow_walk(wait, author=" Ann  "))
    ranking = Ranking(judged_by_file_dates(runs, levels), published_levels(levels))
    (ranked,) = ranking.tables[DIGEST][PLAYED, FASTEST]
    assert (ranked.run.player, ranked.run.tick) == ("Ann", WALK_END + 3)


def test_a_replay_may_leave_out_a_level_that_counts(runs: Path, levels: Path) -> None:
    parsed = parse_replay(replay(author="Ann"))
    put(runs, "a.txt", write_replay(replace(parsed, level=None, level_digest=DIGEST)))
    assert len(judged_by_file_dates(runs, levels).runs) == 1
    put(runs, "a.txt", write_replay(replace(parsed, level=None, level_digest="0" * 64)))
    assert "holds no level" in why(runs, levels)


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forgery_is_refused_with_its_reason(name: str, runs: Path, levels: Path) -> None:
    text, field = FORGERIES[name]
    field = {
        "possible_by_keyboard": "no keyboard can do that: in tick ",
        "complete": "the demo is cut off: it claims ",
        "in_time": "it takes longer than the level gives",
    }.get(field, field)
    put(runs, "forged.txt", text)
    # A path in a replay is not followed at all.
    expected = "holds no level" if "\nlevel: " in text else field
    # A false outcome is named, a true one has a sentence.
    assert expected in why(runs, levels).replace("only runs that reach the exit count", "outcome")


def big(folder: Path) -> None:
    with (folder / "big.replay.txt").open("wb") as file:
        file.truncate(100 * 2**20)


def link_out(folder: Path) -> None:
    secret = folder.parent / "secret.txt"
    secret.write_text(replay(author="secret"), "utf-8")
    (folder / "run.txt").symlink_to(secret)


def folder_link_out(folder: Path) -> None:
    outside = folder.parent / "outside"
    put(outside, "run.txt", replay(author="secret"))
    (folder / "inside").symlink_to(outside)


def takes_in(folder: Path) -> None:
    put(folder, "part.inputs", "R*30")
    put(folder, "run.txt", re.sub(r"inputs:\n", "inputs:\n  include part.inputs\n", replay()))


def pipe(folder: Path) -> None:
    os.mkfifo(folder / "run.txt")


def records(folder: Path) -> None:
    put(folder, "many.txt", record() * (MAX_RECORDS + 1))


TRICKS: dict[str, tuple[Callable[[Path], object] | str, str]] = {
    "a file of 100 MB": (big, "too large"),
    "a thousand million ticks": (replay().replace("inputs:\n", "inputs:\n  R*999999999\n"), "not an input run"),
    "a million million ticks in a demo": (record(demo="1000000000000:0"), "costs too much work"),
    "a final tick of ten to the ninth": (re.sub(r"final-tick: \d+", "final-tick: 999999999", replay()), "too long"),
    "too many records": (records, "recordings in one file"),
    "a link to a file elsewhere": (link_out, "a link"),
    "a link to a folder elsewhere": (folder_link_out, "a link"),
    "a file that takes in another one": (takes_in, "takes in no file"),
    "a pipe": (pipe, "a pipe"),
    "nothing": ("", "no recording"),
    "zero bytes": ("ninja-game replay 3\0", "zero byte"),
    "a level": (write_ascii_level(parse_level_string(WALK)), "no recording"),
    "inputs that are cut": (re.sub(r"(inputs:\n  )\S+", r"\1R*5", replay()), "the replay says"),
}


@pytest.mark.parametrize(
    "trick", [pytest.param(trick, marks=needs_special_files) if trick == "a pipe" else trick for trick in TRICKS]
)
def test_a_trick_is_refused_with_its_reason(trick: str, runs: Path, levels: Path) -> None:
    make, words = TRICKS[trick]
    start = time.process_time()
    if callable(make):
        make(runs)
    else:
        put(runs, "run.txt", make)
    assert words in why(runs, levels)
    assert time.process_time() - start < 10


def test_what_no_keyboard_can_do_counts_on_the_ladder_of_tools(runs: Path, levels: Path) -> None:
    """Marked there, and refused where nobody says that a tool made it."""
    keys = b"\4" + WALKING + b"\2"
    for name, made in (("played", Provenance(played=True)), ("tool", Provenance(edits=3)), ("unknown", Provenance())):
        put(runs, f"{name}.txt", replay(keys, author="\u0410nn", made=made))
    found = judged_by_file_dates(runs, levels)
    (run,) = found.runs
    noted = "no keyboard can do that: in tick 0 (jump down) the jump key is down and was never pressed"
    mixed = "letters of the player's name look like those of another script"
    assert (run.file, run.ladder, run.remark) == ("tool.txt", ASSISTED, f"{mixed}; {noted}")
    assert [each.kind for each in found.rejected] == ["refused", "refused"]


def test_copies_are_named_and_the_first_one_counts(runs: Path, levels: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"), day=1)
    put(runs, "again.txt", replay(author="Ann").replace("name: walk", "name: other"), day=2)
    put(runs, "bob.txt", replay(author="Bob"), day=3)
    put(runs, "cid.txt", replay(WALKING + b"\6", author="Cid"), day=4)
    found = judged_by_file_dates(runs, levels)
    assert [run.player for run in found.runs] == ["Ann"]
    assert [(each.file, each.kind, each.why) for each in found.rejected] == [
        ("again.txt", "copy", "the same run as ann.txt"),
        ("bob.txt", "copy", "a copy of the run by Ann in ann.txt"),
        ("cid.txt", "copy", "a copy of the run by Ann in ann.txt"),
    ]


def test_a_run_that_goes_most_of_somebody_elses_way_says_so(runs: Path, levels: Path) -> None:
    put(runs, "ann.txt", slow_walk(40, author="Ann"), day=1)
    put(runs, "bob.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Bob"), day=2)
    remarks = [run.remark for run in judged_by_file_dates(runs, levels).runs]
    assert remarks == ["", "64 of its 65 ticks have the inputs of the run by Ann in ann.txt"]


def test_a_near_copy_has_no_place_until_somebody_confirms_it(runs: Path, levels: Path, tmp_path: Path) -> None:
    data, shown = tmp_path / "board.json", published_levels(levels)
    put(runs, "ann.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Ann"))
    taken_in_earlier(runs, levels, data)
    put(runs, "bob.txt", slow_walk(40, author="Bob"))
    put(runs, "cid.txt", slow_walk(60, author="Cid"))
    found = []
    bob, confirmed = '"file": "bob.txt"', '"confirmed": true'
    for old, new in ((bob, bob), (bob, f"{bob}, {confirmed}"), (confirmed, '"confirmed": false')):
        data.write_text(data.read_text("utf-8").replace(old, new, 1), "utf-8")
        assert check(runs, levels, "--json", str(data), "--site", str(tmp_path / "site"))[0] == 0
        assert check(runs, levels, "--check", str(data))[1].startswith("nothing has changed")
        ranking = Ranking(judge(runs, shown, Keeping(read_board(data, datetime.now(UTC))), jobs=1), shown)
        places = [(each.place, each.run.player) for each in ranking.tables[DIGEST][PLAYED, FASTEST]]
        records = [run.player for run in ranking.history[DIGEST, (PLAYED, FASTEST)]]
        found.append((places, records))
        assert [each.player for each in ranking.standings[PLAYED] if each.records[FASTEST]] == [places[0][1]]
    doubted = [(1, "Ann"), (2, "Cid"), (0, "Bob")], ["Ann"]
    assert found == [doubted, ([(1, "Bob"), (2, "Ann"), (3, "Cid")], ["Ann", "Bob"]), doubted]


def test_a_faster_near_copy_is_reported_and_confirmed_by_a_command(runs: Path, levels: Path, tmp_path: Path) -> None:
    data = tmp_path / "board.json"
    put(runs, "ann.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Ann"))
    put(runs, "bob.txt", slow_walk(90, author="Bob"))
    taken_in_earlier(runs, levels, data)
    put(runs, "better.txt", slow_walk(40, author="Bob"))
    waits = "Better, and waiting: Bob 1.575 with 1 gold."
    command, site = ("--json", str(data), "--site", str(tmp_path / "site")), tmp_path / "site" / "board"
    code, text = check(runs, levels, *command)
    assert (code, text.partition("; rejected: ")[2]) == (0, "none; 1 waits for confirmation: --confirm better.txt\n")
    level, rejected, waiting = (
        (site / name).read_text("utf-8") for name in (f"levels/{DIGEST[:16]}.html", "rejected.html", "waiting.html")
    )
    assert (waits in level, ">Waiting: 1</a>" in rejected, ">Waiting: 1</a>" in level) == (True, True, False)
    player = (site / f"{player_page('Bob')}.html").read_text("utf-8")
    assert [page.count('<a href="../waiting.html">1 run waits</a>') for page in (level, player)] == [1, 1]
    assert "<div>better.txt</div>" in waiting
    for does in ("--confirm better.txt", "--reject better.txt --reason 'not confirmed'"):
        assert f"<code>ninja-game board {runs.name} --json board.json {escape(does)}</code>" in waiting
    both = re.search(r'<a href="../play.html#watch=(\w+),(\w+)"[^>]*>Watch with Ann</a>', waiting)
    assert both, "a link shows it beside the run that it resembles"
    authors = [(site.parent / "replays" / f"{stem}.txt").read_text("utf-8") for stem in both.groups()]
    assert ["author: Bob" in authors[0], "author: Ann" in authors[1]] == [True, True]
    words = "board", str(runs), "--levels", str(levels), "--json", str(data), "--confirm", "nobody.txt"
    answered = CliRunner().invoke(cli, words)
    assert (answered.exit_code, "that waits; there are: better.txt" in answered.stderr) == (2, True)
    assert check(runs, levels, "--confirm", "better.txt")[0] == 2
    assert check(runs, levels, *command, "--confirm", "better.txt")[0] == 0
    assert check(runs, levels, *command)[1].endswith("; rejected: none\n")
    level = (site / f"levels/{DIGEST[:16]}.html").read_text("utf-8")
    assert (waits in level, ">confirmed by the keeper; " in level) == (False, True)
    assert not (site / "waiting.html").exists()
    assert "Waiting" not in (site / "rejected.html").read_text("utf-8")
    assert '"confirmed": true' in data.read_text("utf-8")


def test_a_near_copy_stays_one_where_the_first_run_is_withdrawn_and_comes_back(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    """Hers comes back in a file whose name is after that of its near copy."""
    data, shown = tmp_path / "board.json", published_levels(levels)
    hers = replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Ann")
    put(runs, "ann.txt", hers)
    taken_in_earlier(runs, levels, data)
    put(runs, "hal.txt", slow_walk(40, author="Hal"))

    def ranked() -> list[tuple[int, str, str]]:
        assert check(runs, levels, "--json", str(data), "--site", str(tmp_path / "site"))[0] == 0
        assert check(runs, levels, "--check", str(data))[1].startswith("nothing has changed")
        ranking = Ranking(judge(runs, shown, Keeping(read_board(data, datetime.now(UTC))), jobs=1), shown)
        assert "Hal" not in {each.run.player for each in ranking.records}
        return [(each.place, each.run.player, each.run.remark) for each in ranking.tables[DIGEST][PLAYED, FASTEST]]

    first, (_, _, remark_text) = ranked()
    assert (first, "the run by Ann in ann.txt" in remark_text) == ((1, "Ann", ""), True)
    (runs / "ann.txt").unlink()
    assert ranked() == [(0, "Hal", f"{remark_text} (found earlier)")]
    (runs / "hal.txt").rename(runs / "again.txt")
    assert ranked() == [(0, "Hal", f"{remark_text} (found earlier)")], "another file is no way out"
    put(runs, "z.txt", hers)
    for _ in range(2):
        assert ranked() == [(1, "Ann", ""), (0, "Hal", remark_text.replace("ann.txt", "z.txt"))]


def test_of_two_runs_of_one_moment_the_later_file_is_marked_and_keeps_its_place(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    """Nobody knows which was first; here the other one is on the other ladder, too."""
    data, pages = tmp_path / "board.json", tmp_path / "site" / "board"
    put(runs, "a-tas.txt", slow_walk(40, author="Bot").replace("outcome:", "made: edited 3\noutcome:"))
    put(runs, "me.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Me"))
    assert check(runs, levels, "--json", str(data), "--site", str(tmp_path / "site"))[0] == 0
    assert '"near"' not in data.read_text("utf-8")
    level, all_levels, index = (
        (pages / name).read_text("utf-8") for name in (f"levels/{DIGEST[:16]}.html", "levels.html", "index.html")
    )
    assert "Fastest, played 1.600 s Me" in words_of(level)
    assert "of the run by Bot in a-tas.txt, of the same moment" in level
    assert ">Me</a>" in all_levels
    assert "Fastest, played 1.600 s first" in words_of(index)
    texts = [path.read_text("utf-8") for path in pages.glob("players/*.html")]
    (mine,) = (text for text in texts if "<title>Me -" in text and "<caption>All runs" in text)
    assert "First in Fastest 1 Total of ranks 1" in words_of(mine)


def test_a_near_copy_alone_on_its_ladder_is_nowhere_first(runs: Path, levels: Path, tmp_path: Path) -> None:
    data, pages = tmp_path / "board.json", tmp_path / "site" / "board"
    put(runs, "z.txt", slow_walk(40, author="Bot").replace("outcome:", "made: edited 3\noutcome:"))
    taken_in_earlier(runs, levels, data)
    put(runs, "me.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Me"))
    check(runs, levels, "--json", str(data), "--site", str(tmp_path / "site"))
    level, all_levels = ((pages / name).read_text("utf-8") for name in (f"levels/{DIGEST[:16]}.html", "levels.html"))
    waits = '<p class="facts"><a href="../waiting.html">1 run waits</a></p>'
    assert f'<li class="card leader"><a href="#ranks-1">Fastest, played</a>{waits}</li>' in level
    assert ">Me</a>" not in all_levels
    (mine,) = (text for path in pages.glob("players/*.html") if "<title>Me -" in (text := path.read_text("utf-8")))
    assert "Played Runs 1 Levels 0 1 run waits All runs" in words_of(mine)


def test_a_clean_run_goes_before_the_players_own_near_copy(runs: Path, levels: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bob.txt", slow_walk(author="Bob"))
    judged, shown = judged_by_file_dates(runs, levels), published_levels(levels)
    ann, bob = judged.runs
    near = replace(ann, player="Bob", near="nearly Ann's", file="near.txt")
    table = Ranking(replace(judged, runs=(ann, bob, near)), shown).tables[DIGEST][PLAYED, FASTEST]
    assert [(each.place, each.run.file, each.behind) for each in table] == [(1, "ann.txt", 0), (2, "bob.txt", 5)]


def test_who_played_a_record_of_n_is_unknown(runs: Path, levels: Path) -> None:
    """It names the maker of the level; two in one file need not be by one player. One of ours says how it was made."""
    put(runs, "a.txt", record(bytes(2) + WALKING) + record(bytes(3) + WALKING))
    put(runs, "b.txt", record(bytes(4) + WALKING))
    put(runs, "c.txt", record(bytes(5) + WALKING).replace("#test#", "#test [made: played]#"))
    assert [run.player for run in judged_by_file_dates(runs, levels).runs] == [
        "unknown (a.txt)", "unknown (a.txt, record 1)", "unknown (b.txt)", "me",
    ]  # fmt: skip


def test_a_near_copy_shares_no_place(runs: Path, levels: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    judged, shown = judged_by_file_dates(runs, levels), published_levels(levels)
    (ann,) = judged.runs
    bob, cid = (
        replace(ann, player=player, near=near, file=f"{player.lower()}.txt")
        for player, near in (("Bob", "nearly Ann's"), ("Cid", ""))
    )
    for given, places in (((ann, bob, cid), [(1, "Ann"), (1, "Cid"), (0, "Bob")]), ((bob,), [(0, "Bob")])):
        table = Ranking(replace(judged, runs=given), shown).tables[DIGEST][PLAYED, FASTEST]
        assert [(each.place, each.run.player) for each in table] == places


def test_a_time_that_the_run_does_not_have_is_refused_under_its_players_name(
    runs: Path, levels: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parsed = Mock(side_effect=parse_replay)
    monkeypatch.setattr(collect, "parse_replay", parsed)
    put(runs, "dee.txt", re.sub(r"final-tick: \d+", "final-tick: 9", replay(author="Dee")))
    put(runs, "eve.txt", re.sub(r"(inputs:\n  )\S+", r"\1R*40", replay(author="Eve")))
    put(runs, "notes.txt", "notes")
    found = judged_by_file_dates(runs, levels)
    assert [(each.kind, each.player, each.why.partition(";")[0]) for each in found.rejected] == [
        ("refused", "Dee", f"tick {WALK_END}: the run ends here (exit)"),
        ("refused", "Eve", "inputs after the final tick"),
        ("unreadable", "", "line 1: no recording"),
    ]
    assert parsed.call_count == 2, "each is parsed once"


def test_medals_stand_where_the_time_ranks_and_every_record_that_fell_is_reported(
    runs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.board.copies.near_to_another", lambda *_: None)
    (recording,) = load_replays(PACK / "certificates" / "00-2-wall-to-wall.exit.replay.txt")
    for number, inputs in enumerate((b"\0" + recording.inputs, recording.inputs)):
        put(
            runs,
            f"{number}.txt",
            write_replay(record_replay(recording.level, inputs, author=f"Ann {number}")),
            day=1 + number,
        )
    judged, shown = judged_by_file_dates(runs, PACK), published_levels(PACK)
    BoardPages(tmp_path / "site", Ranking(judged, shown)).write()
    pages = [path.read_text("utf-8") for path in (tmp_path / "site" / "board" / "levels").glob("*.html")]
    (page,) = (each for each in pages if "Watch the first 2 together" in each)
    BoardPages(tmp_path / "other", Ranking(judged, shown, (HIGHEST,))).write()
    texts = page, (tmp_path / "other" / "board" / page_name(level_digest(recording.level))).read_text("utf-8")
    names = "Fastest; Highest score", "Highest score"
    both, highest = (
        text.partition(f"<h2>{name}</h2>")[2].partition("</table>")[0] for text, name in zip(texts, names, strict=True)
    )
    assert ("medal" in both, "medal" in highest, "Ann 1" in highest) == (True, False, True)
    assert re.findall("How the record (f?r?[eo][ls][le]: [^<]+)", page) == ["fell: Fastest", "rose: Highest score"]
    assert "Fastest: Watch the first 2 together" in words_of(page)


def test_the_later_one_of_two_names_that_look_alike_is_marked_everywhere(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    later = "\u0410nn"
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author=later))
    put(runs, "c.txt", replay(author=later, gold=77))
    board = board_of(runs, levels, tmp_path / "site")
    marked = f"{later} (not Ann)"
    level = (board / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    legend = level.partition('class="level"')[2]
    assert [f"{before}{marked}<" in legend for before in ("</svg> ", '<span class="name">')] == [True, True]
    assert all(marked in (board / f"{name}.html").read_text("utf-8") for name in ("rejected", "players"))
    assert later not in re.sub(re.escape(marked), "", (board / "rejected.html").read_text("utf-8"))


@pytest.mark.parametrize("sure", [True, False])
def test_a_run_that_shares_the_path_alone_is_marked_and_keeps_its_place(
    runs: Path, levels: Path, monkeypatch: pytest.MonkeyPatch, *, sure: bool
) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"), day=1)
    put(runs, "b.txt", replay(author="Bea"), day=2)
    near = Near([0], "9 of 9 are those of", sure)
    monkeypatch.setattr("ninja_game.board.copies.near_to_another", lambda *compared: near if compared[3] else None)
    judged = judged_by_file_dates(runs, levels)
    table = Ranking(judged, published_levels(levels)).tables[DIGEST][PLAYED, FASTEST]
    assert [(each.place, each.run.player) for each in table] == (
        [(1, "Ann"), (0, "Bea")] if sure else [(1, "Bea"), (2, "Ann")]
    )
    (remark,) = (each.run.remark for each in table if each.run.player == "Bea")
    assert remark.startswith("9 of 9 are those of the run by Ann in a.txt")
    assert ("doubtful" in remark) is not sure


def test_levels_without_a_number_show_none(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    page = (board_of(runs, levels / "00-0-level.txt", tmp_path / "site") / "levels.html").read_text("utf-8")
    assert "Level " not in page
    assert ("Episodes<" in page, (tmp_path / "site" / "board" / "episodes.html").exists()) == (False, False)


def test_levels_and_the_first_page_count_the_same_players(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea").replace("outcome:", "made: edited 3\noutcome:"))
    board = board_of(runs, levels, tmp_path / "site")
    assert "2 runs by 2 players" in (board / "index.html").read_text("utf-8")
    walk = (board / "levels.html").read_text("utf-8").partition(">Walk</a>")[2]
    assert words_of(walk).startswith("2 runs by 2 players")


def test_the_page_of_a_run_says_where_it_stands(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    board = board_of(runs, levels, tmp_path / "site")
    first, second = sorted((path.read_text("utf-8") for path in (board.parent / "replays").glob("*.html")), key=len)
    assert "<dt>Fastest</dt><dd>place 1</dd>" in first
    assert "<dt>Fastest</dt><dd>place 2, 0.125 behind</dd>" in second
    assert "<dt>Keys</dt><dd>1 press, 0 jumps</dd>" in second
    assert "<dt>Gold</dt><dd>1 of 1</dd>" in second
    assert (first.count(">Watch with "), second.count(">Watch with Ann</a>")) == (0, 1)
    assert f"../board/levels/{DIGEST[:16]}.html#splits" in first


def test_of_the_records_of_one_moment_the_first_page_has_the_last_of_a_level(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    """A board that is filled at once: no record fell, and no level is that of the week."""
    for wait in (9, 5, 2):
        put(runs, f"{9 - wait}.txt", slow_walk(wait, author=f"Ann {wait}"))
    check(runs, levels, "--json", str(tmp_path / "board.json"), "--site", str(tmp_path / "site"))
    page = (tmp_path / "site" / "board" / "index.html").read_text("utf-8")
    newest = page.partition("<h2>Newest records")[2].partition("</table>")[0]
    assert words_of(newest).count("Fastest 0.625 s first Highest score 91.375 points first") == 1
    assert newest.partition("</ul>")[0].count("<li") == 1
    assert "Level of the week" not in page
    level = (tmp_path / "site" / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    assert "How the record" not in level, "of one moment there is one record"
    players = page.partition("<h2>Players</h2>")[2].partition("</thead>")[0]
    assert re.findall("<th[^>]*>(?:<span[^>]*>)?([^<]+)", players)[3:] == ["First, Fastest", "First, Highest score"], (
        "no medals: these levels have no par times"
    )


def test_the_page_of_a_run_shows_its_path(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    board = board_of(runs, levels, tmp_path / "site")
    (page,) = (board.parent / "replays").glob("*.html")
    found = Tags(page.read_text("utf-8")).found
    (picture,) = (attributes["href"] for name, attributes in found if name == "image")
    assert (page.parent / str(picture)).is_file()
    assert str(next(each["d"] for _, each in found if each.get("class") == "way")).startswith("M100 566l")


def test_two_runs_are_aligned_once_for_all_pages_of_their_level(
    runs: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    counting = Mock(wraps=aligned)
    monkeypatch.setattr("ninja_game.web.board.level_pages.aligned", counting)
    board = board_of(runs, levels, tmp_path / "site")
    pages = [*(board / "levels").glob(f"{DIGEST[:16]}.html"), *(board.parent / "replays").glob("*.html")]
    assert sum("<h2>Where time goes</h2>" in page.read_text("utf-8") for page in pages) == 2
    assert counting.call_count == 1


def test_runs_too_long_to_align_have_no_heading_of_where_time_goes(
    runs: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    monkeypatch.setattr("ninja_game.web.board.level_pages.MAX_ALIGNED_TICKS", WALK_END)
    board = board_of(runs, levels, tmp_path / "site")
    pages = [path.read_text("utf-8") for path in board.parent.rglob("*.html")]
    assert [sum(f"<h2>{title}</h2>" in page for page in pages) for title in ("Splits", "Where time goes")] == [3, 0]


def test_the_page_of_a_run_shows_its_speed_keys_and_splits(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    board = board_of(runs, levels, tmp_path / "site")
    pages = [path.read_text("utf-8") for path in sorted((board.parent / "replays").glob("*.html"))]
    (ann,) = (page for page in pages if "<title>Ann on" in page)
    (bea,) = (page for page in pages if "<title>Bea on" in page)
    assert "Where time goes" not in ann, "it is the record"
    assert "Time Speed 1 gold 2 0.000 0.00 2 switch of exit 1 0.350 1.95 3 exit 0.575 3.06" in words_of(ann)
    later = "Later than Ann 1 gold 2 0.000 0.00 +0.000 2 switch of exit 1 0.475 1.95 +0.125 3 exit 0.700 3.06 +0.125"
    assert later in words_of(bea)
    assert "Seconds by which each is later where Ann is then" in bea
    assert "Fastest at 0.700 s: 3.06 px per tick; " in bea
    drawn = bea.partition("<h2>Speed and keys")[2].partition("</svg>")[0]
    assert 'aria-label="Speed and keys from 0.000 s to 0.725 s, at most 3.1 px per tick"' in drawn


def test_the_page_of_a_run_that_presses_in_every_tick_for_minutes_is_no_larger(levels: Path) -> None:
    keys = bytes(range(8)) * 2000
    drawn = speed_and_keys(np.linspace(0, 12.3, len(keys)), keys, range(0, len(keys), 300))
    assert len("".join(drawn)) < 80_000
    assert [re.findall("px per tick|to ([0-9.]+) s", each) for each in drawn][-1][0] == "400.000"


def test_a_player_sees_where_most_could_be_won(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", replay(level=GOLD_LATER, author="Ann"))
    put(runs, "c.txt", slow_walk(4, author="Bea"))
    put(runs, "d.txt", replay(bytes(9) + WALKING + b"\2", GOLD_LATER, author="Bea"))
    players = board_of(runs, levels, tmp_path / "site") / "players"
    (page,) = (text for path in players.glob("*-gains.html") if "<title>Bea" in (text := path.read_text("utf-8")))
    assert re.findall(r"<td>(0\.[0-9]{3})</td><td>2</td>", page) == ["0.225", "0.100"], "the most first"
    assert page.count("Watch both: Bea on") == 2
    names = [path.name for path in players.glob("*-gains.html")]
    links = [each for path in players.glob("*.html") for each in re.findall("[0-9a-f]+-gains.html", path.read_text())]
    assert {*names} == {*links}
    assert len(names) == 1, "Ann is first everywhere"


def test_a_board_of_one_level_has_its_name_the_newest_runs_and_how_to_send_one(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    put(runs, f"{'c' * 60}.txt", "nothing")
    board = board_of(runs, levels / "00-0-level.txt", tmp_path / "site")
    page = (board / "index.html").read_text("utf-8")
    assert "<title>Board: Walk -" in page
    assert '<p class="lead">2 runs by 2 players on 1 level.</p>' in page
    contents = page.partition('aria-label="On this page"')[2].partition("</nav>")[0]
    assert re.findall(">([^<]+)</a>", contents) == ["Newest records", "Newest runs", "Send a run", "Players"]
    newest = page.partition("<h2>Newest runs")[2].partition("</table>")[0]
    assert re.findall(">([^<]+)</a>", newest) == ["Walk", "Watch", "Bea", "0.700", "Walk", "Watch", "Ann", "0.575"]
    rejected = (board / "rejected.html").read_text("utf-8")
    assert f"<summary>{'c' * 24}...</summary>{'c' * 60}.txt</details>" in rejected


@pytest.mark.parametrize("width", [360, 1100, 1400])
def test_no_number_and_no_date_is_broken(width: int, chromium: Any, runs: Path, levels: Path, tmp_path: Path) -> None:
    """Only long texts have more than a line, also beside a remark; and no column of any table is cut."""
    for number in range(5):
        put(runs, f"more-{number}.txt", slow_walk(90 + number, author=f"Somebody of a long Name {number}"))
    put(runs, "ann.txt", slow_walk(40, author="Ann"))
    made = Provenance(searches=("improve",), begun_by="unknown (a-person-whose-name-is-long.txt)")
    put(runs, "tool.txt", replay(author="Tool", made=made))
    put(runs, "bob.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Bob"))
    now = "2026-01-31T12:00:00Z"
    shown = published_levels(levels)
    BoardPages(tmp_path / "site", Ranking(judge(runs, shown, Keeping(dates=lambda *_: now), jobs=1), shown)).write()
    page = chromium.new_page(viewport={"width": width, "height": 844})
    for name in ("index", f"levels/{DIGEST[:16]}", "levels", "players"):
        page.goto((tmp_path / "site" / "board" / f"{name}.html").as_uri())
        broken = page.evaluate(BROKEN)
        assert broken == [], name
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        explained = width < 700 and "/" in name  # the others have at most six columns
        wide = "Array.from(document.querySelectorAll('.wide'), (each) => each.scrollWidth - each.clientWidth)"
        assert not any(page.evaluate(wide)), name
        assert page.evaluate(SAID) == ["More of a run: on its page, where its time leads"] * explained, name
    page.close()


@pytest.mark.parametrize("width", [360, 1280])
def test_tables_with_five_categories_fit(width: int, chromium: Any, runs: Path, levels: Path, tmp_path: Path) -> None:
    """Why a run does not count is seen at once, and a place in a category has no line for each of its words."""
    put(runs, "ann/a.txt", slow_walk(40, author="Ann"))
    put(runs, "tool.txt", replay(author="Tool", made=Provenance(searches=("improve",))))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    put(runs, f"somebody/{'long-' * 9}name.txt", slow_walk(90, author="Ann"))
    put(runs, f"wrong/{'long-' * 9}name.txt", replay(gold=44, author="W" * 60))
    put(runs, "copy.txt", slow_walk(40, author="Somebody with a long name"))
    site = tmp_path / "site"
    check(runs, levels, "--json", str(data), "--site", str(site), "--rules", "docs/board-template/board.toml")
    page = chromium.new_page(viewport={"width": width, "height": 844})
    for name in ("rejected", "waiting", player_page("Ann"), *(["players", "assisted"] if width > 700 else [])):
        page.goto((site / "board" / f"{name}.html").as_uri())
        over = "Array.from(document.querySelectorAll('.wide'), (each) => each.scrollWidth - each.clientWidth)"
        assert not any(page.evaluate(over)), name
        narrow = "Math.min(999, ...Array.from(document.querySelectorAll('.stack, .why'), (each) => each.clientWidth))"
        assert page.evaluate(narrow) > 100, name
    page.close()


def test_what_does_not_count_is_said_in_plain_words(runs: Path, levels: Path) -> None:
    put(runs, "other.txt", replay(level=f"{WALK}!0^400,100", level_name="My <b>cave</b>"))
    put(runs, "slow.txt", replay(made=Provenance(played=True, assists=("slow motion",))))
    found = judged_by_file_dates(runs, levels).rejected
    assert [each.kind for each in found] == ["refused", "practice"]
    assert found[0].why.startswith("'My <b>cave</b>' is not one of the levels that count; its level_digest begins")
    assert found[1].why == "it was played (slow motion): runs with such help do not count"
    (runs / "slow.txt").unlink()
    put(runs, "box.txt", replay(gold=3).replace("body: circle", "body: box"))
    put(runs, "other.txt", replay(WALKING[:-20], outcome="running"))
    found = judged_by_file_dates(runs, levels).rejected
    assert [each.why for each in found] == ["the box body does not count here", "only runs that reach the exit count"]


def board_of(runs: Path, levels: Path, out: Path) -> Path:
    shown = published_levels(levels)
    BoardPages(out, Ranking(judge(runs, shown, jobs=1), shown)).write()
    return out / "board"


@pytest.fixture
def hostile(runs: Path, levels: Path, tmp_path: Path) -> Path:
    """A board of hostile names: of files, players, runs, levels."""
    put(runs, "ann.txt", replay(author=HOSTILE, name=HOSTILE))
    put(runs, "later.txt", replay(bytes(3) + WALKING + b"\2", author="javascript:alert(1)"))
    put(runs, "<img src=x onerror=alert(1)>.txt", replay(author=HOSTILE, made=PRACTISED))
    put(runs, "bad.txt", replay(author=HOSTILE, gold=77))
    put(runs, "worse.txt", "<script>alert(1)</script>")
    return board_of(runs, levels, tmp_path / "site")


def test_no_text_becomes_markup(hostile: Path) -> None:
    pages = sorted(hostile.rglob("*.html"))
    assert len(pages) == 5 + 3 + 2 + 3, (
        "with all runs of the level, the records of the one player, and what the other one could win"
    )
    for path in pages:
        tags = Tags(path.read_text("utf-8")).found
        assert [each for each in tags if each[0] == "script"] == [
            ("script", {"src": os.path.relpath(hostile / "search.js", path.parent), "defer": None})
        ]
        assert ("meta", {"http-equiv": "Content-Security-Policy", "content": POLICY}) in tags
        for _, attributes in tags:
            assert not any(name.startswith("on") or name == "style" for name in attributes)
            for name in ("href", "src"):
                assert re.fullmatch(r"[\w./#=&,-]*", attributes.get(name) or "")


@pytest.mark.parametrize(
    "address", ["javascript:alert(1)", "//example.org/", "data:text/html,x", "a b", "a?b", "\\\\x"]
)
def test_no_address_leads_out_of_the_pages(address: str) -> None:
    with pytest.raises(ValueError, match="not an address"):
        tag("a", "x", href=address)


def test_every_link_of_the_board_leads_to_a_file(hostile: Path) -> None:
    (hostile.parent / "play.html").write_text("the page with the game")
    watched = set()
    for path in hostile.rglob("*.html"):
        for _, attributes in Tags(path.read_text("utf-8")).found:
            address, _, fragment = (attributes.get("href") or attributes.get("src") or "").partition("#")
            assert (path.parent / address).resolve().exists(), (path, attributes)
            if fragment.startswith("watch="):
                names = fragment.removeprefix("watch=").split(",")
                watched |= {name.partition("-")[0] for name in names}  # behind it: its colour
    replays = {path.stem: path for path in (hostile.parent / "replays").iterdir()}
    assert watched == set(replays)
    for path in replays.values():
        parsed = parse_replay(path.read_text("utf-8"))
        assert parsed.level is not None
        assert parsed.outcome == "exit"


def test_pages_are_written_again_but_never_over_something_else(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "run.txt", replay(author="Ann"))
    board = board_of(runs, levels, tmp_path / "site")
    first = {path.relative_to(board): path.read_bytes() for path in board.rglob("*.*")}
    (board / "players" / "0000000000000000.html").write_text("a player who has gone")
    board_of(runs, levels, tmp_path / "site")
    assert {path.relative_to(board): path.read_bytes() for path in board.rglob("*.*")} == first
    (tmp_path / "other" / "board").mkdir(parents=True)
    (tmp_path / "other" / "board" / "mine.txt").write_text("mine")
    with pytest.raises(FileError, match="not a folder of pages"):
        board_of(runs, levels, tmp_path / "other")


def check(runs: Path, levels: Path, *more: str) -> tuple[int, str]:
    result = CliRunner().invoke(cli, ["board", str(runs), "--levels", str(levels), "--jobs", "1", *more])
    return result.exit_code, result.stdout


def test_check_tells_what_a_change_does(runs: Path, levels: Path, tmp_path: Path) -> None:
    data = tmp_path / "board.json"
    put(runs, "bea.txt", slow_walk(author="Bea"))
    put(runs, "bad.txt", replay(gold=77))
    assert check(runs, levels, "--json", str(data))[0] == 0
    code, text = check(runs, levels, "--check", str(data))
    assert (code, text.splitlines()[0]) == (0, "nothing has changed: 1 run by 1 player on 1 level; rejected: 1 refused")
    put(runs, "ann.txt", replay(author="A`nn"), day=2)
    code, text = check(runs, levels, "--check", str(data))
    assert code == 0
    achieved = "Fastest: place 1 of 2; Highest score: place 1 of 2"
    assert f"new: ann.txt: A'nn passes Walk in 0.575 s with 1 gold; {achieved}" in text
    put(runs, "cid.txt", replay(WALKING[:-3], author="Cid"))
    (runs / "bea.txt").unlink()
    code, text = check(runs, levels, "--check", str(data))
    assert code == 1
    assert "refused: cid.txt: only runs that reach the exit count" in text
    gone = "gone: bea.txt: Bea on Walk; first now: Fastest A'nn, 0.575; Highest score A'nn, 91.425\n"
    assert gone in text
    for lines in (1, 0):
        assert check(runs, levels, "--json", str(data))[1].count(gone) == lines
    (runs / "ann.txt").unlink()
    assert "gone: ann.txt: A'nn on Walk; first now: nobody\n" in check(runs, levels, "--check", str(data))[1]


def test_check_refuses_a_changed_run(runs: Path, levels: Path, tmp_path: Path) -> None:
    data = tmp_path / "board.json"
    put(runs, "bea.txt", replay(author="Bea"))
    check(runs, levels, "--json", str(data))
    put(runs, "bea.txt", replay(author="Mallory"))
    code, text = check(runs, levels, "--check", str(data))
    assert (code, text.splitlines()[0].partition(" passes")[0]) == (1, "changed: bea.txt: Mallory")


@pytest.mark.parametrize(
    "text", ["", "{}", "[]", '{"version": 2}', '{"version": 1, "runs": [1], "rejected": []}', "[" * 99_999]
)
def test_check_against_something_else_is_an_error(text: str, runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "bea.txt", replay())
    path = put(tmp_path, "other.json", text)
    assert check(runs, levels, "--check", str(path))[0] == 2


def test_how_a_record_moved_shows_the_ten_newest_steps(
    runs: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.board.copies.near_to_another", lambda *_: None)
    for number in range(12):
        put(runs, f"{number}.txt", slow_walk(12 - number, author=f"Ann {number}"), day=1 + number)
    BoardPages(tmp_path / "site", Ranking(judged_by_file_dates(runs, levels), published_levels(levels))).write()
    texts = (path.read_text("utf-8") for path in (tmp_path / "site" / "board" / "levels").glob("*.html"))
    (page,) = (text for text in texts if "How the record" in text)
    steps = page.partition("How the record fell")[2].partition("Newest first")[2].partition("</table>")[0]
    days = [*dict.fromkeys(re.findall("1970-01-[0-9]{2}", steps))]
    assert days == [f"1970-01-{day:02d}" for day in range(13, 3, -1)]
