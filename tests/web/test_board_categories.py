"""Ladders and categories: what runs are ranked by, as a text states it, and what is wrong with such a text."""

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game.board.categories import DEFAULT_CATEGORIES, FASTEST, MAX_CATEGORIES, RUN_NUMBERS, Category, read_rules
from ninja_game.board.judge import Keeping, judge
from ninja_game.board.ranking import Ranking
from ninja_game.board.runs import ASSISTED, PLAYED
from ninja_game.cli.main import cli
from ninja_game.errors import NinjaGameError
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.levels.published import published_levels
from ninja_game.web.board.pages import BoardPages
from ninja_game.web.board.parts import UNKNOWN_ORIGIN
from ninja_game.web.pages.gallery import path_data
from tests.support.board import DIGEST, Tags, board, put, slow_walk
from tests.support.forgeries import GOLD_LATER, WALKING, record, replay
from tests.support.samples import WALK_END

SEARCHED = Provenance(edits=3, searches=("improve",), begun_by="Ann")
TEMPLATE = Path("docs/board-template/board.toml")


def filed(folder: Path, text: str) -> Path:
    return put(folder, "board.toml", text)


def category(name: str = "A", **more: object) -> str:
    keys = {"name": name, "rank": ["ticks"]} | more
    return "[[category]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())


def test_an_assisted_run_is_on_a_ladder_of_its_own(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", slow_walk(author="Ann"))
    put(runs, "bea.txt", replay(bytes(9) + WALKING + b"\2", author="Bea", made=Provenance(played=True)))
    put(runs, "tas.txt", replay(author="Ann", made=SEARCHED, co_authors=("<b>Eve</b>",)))
    shown = published_levels(levels)
    ranking = Ranking(judge(runs, shown, jobs=1), shown)
    tables = ranking.tables[DIGEST]
    assert [each.run.file for each in tables[PLAYED, FASTEST]] == ["ann.txt", "bea.txt"]
    assert [each.run.file for each in tables[ASSISTED, FASTEST]] == ["tas.txt"]
    assert [each.player for each in ranking.standings[ASSISTED]] == ["Ann"]
    board(runs, levels, "--site", str(tmp_path / "site"))
    page = (tmp_path / "site" / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")
    assert ">unknown</span></td>" in page, "marked"
    assert "edited 3, searched (improve) from a run by Ann" in page
    assert "with &lt;b&gt;Eve&lt;/b&gt;" in page
    assert "Fastest, assisted" in page
    assert (tmp_path / "site" / "board" / "assisted.html").exists()
    text = next((tmp_path / "site" / "replays").glob("*.txt"), None)
    assert text
    assert any("made: edited 3" in each.read_text("utf-8") for each in text.parent.iterdir())


def test_the_categories_of_the_template_rank_as_they_say(runs: Path, levels: Path) -> None:
    """Ann goes straight through the gold; Bea jumps over nothing and takes it later; the level's gold is one piece."""
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    put(runs, "cid.txt", replay(level=GOLD_LATER, author="Cid"))
    shown = published_levels(levels)
    categories = read_rules(TEMPLATE).categories
    assert [each.name for each in categories] == ["Any %", "Highest score", "All gold", "Low gold", "Fewest keys"]
    ranking = Ranking(judge(runs, shown, jobs=1), shown, categories)
    for (ladder, each), table in ranking.tables[DIGEST].items():
        assert (ladder, [ranked.run.player for ranked in table]) == (PLAYED, ["Ann", "Bea"]), each.name
    assert len(ranking.tables[DIGEST]) == len(categories)
    assert categories[3].text(0) == "0"
    assert categories[0].text(WALK_END) == f"{WALK_END / 40:.3f}"
    assert categories[1].text(-3657) == "91.425"
    gold_rate = Category("Gold a tick", ("-gold/ticks",))
    (fastest, *_) = gold_rate.values(ranking.judged.runs)
    assert fastest
    assert gold_rate.text(fastest[0]) == f"{1 / WALK_END:g}"
    assert not Category("Spent", ("-gold + ticks",)).greatest_first


def test_a_run_is_in_a_category_only_where_its_formula_holds(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", slow_walk(author="Ann"))
    put(runs, "bea.txt", replay(author="Bea"))
    others = category("B", rank=["-ticks"]) + category("C", rank=["1 / (gold - 1)"])
    given, *_ = read_rules(filed(tmp_path, category(when=f"ticks > {WALK_END}") + others))
    shown = published_levels(levels)
    tables = Ranking(judge(runs, shown, jobs=1), shown, given).tables[DIGEST]
    players = {each.name: [ranked.run.player for ranked in table] for (_, each), table in tables.items()}
    assert players == {"A": ["Ann"], "B": ["Ann", "Bea"]}, "where a number is not finite, a run is not of the category"


def test_the_first_of_a_table_holds_the_record_by_the_second_number_too(runs: Path, levels: Path) -> None:
    put(runs, "a.txt", slow_walk(author="Bea"))
    put(runs, "b.txt", replay(author="Ann"))
    shown, keys = published_levels(levels), Category("Fewest keys", ("presses", "ticks"))
    ranking = Ranking(judge(runs, shown, jobs=1), shown, (keys,))
    assert [row.run.player for row in ranking.tables[DIGEST][PLAYED, keys]] == ["Ann", "Bea"]
    assert ranking.history[DIGEST, (PLAYED, keys)][-1].player == "Ann"


def test_a_level_says_its_ladder_once_why_a_run_is_played_and_who_was_refused(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    put(runs, "ann.txt", slow_walk(author="Ann"))
    put(runs, "tas.txt", replay(author="Tas", made=SEARCHED, co_authors=("Eve",)))
    put(runs, "wrong.txt", replay(author="Ann", gold=44))
    put(runs, "other.txt", replay(author="Nobody", gold=44))
    shown, site = published_levels(levels), tmp_path / "site"
    BoardPages(site, ranking := Ranking(judge(runs, shown, jobs=1), shown)).write()
    level, rejected = (
        (site / "board" / name).read_text("utf-8") for name in (f"levels/{DIGEST[:16]}.html", "rejected.html")
    )
    assert "<h2>Fastest; Highest score, assisted</h2>" in level
    assert UNKNOWN_ORIGIN.format(PLAYED) in level, "Ann's run does not say how it was made"
    assert '<span class="with"> with Eve</span>' in level
    assert [f"{name}</a>, The walk" in rejected or f">{name}</a>" in rejected for name in ("Ann", "Nobody")] == [
        True, False,
    ]  # fmt: skip
    (assisted,) = (run for run in ranking.judged.runs if run.assisted)
    pages = [path.read_text("utf-8") for path in (site / "replays").glob("*.html")]
    assert ["<dt>With</dt><dd>Eve</dd>" in page for page in pages].count(True) == 1, assisted.co_authors


def test_a_board_has_the_name_of_its_rules(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    (levels / "pack.toml").unlink()
    rules = read_rules(filed(tmp_path, 'name = "Friday <races>"\n' + category()))
    shown = published_levels(levels)
    now = "2026-01-31T12:00:00Z"
    judged = judge(runs, shown, Keeping(dates=lambda *_: now), jobs=1)
    BoardPages(tmp_path / "named", Ranking(judged, shown, *rules)).write()
    BoardPages(tmp_path / "unnamed", Ranking(judged, shown, rules.categories)).write()
    named, plain = (tmp_path / folder / "board" for folder in ("named", "unnamed"))
    assert "<title>Friday &lt;races&gt; - ninja-game</title>" in (named / "index.html").read_text("utf-8")
    assert '"index.html">Friday &lt;races&gt;</a>' in (named / "players.html").read_text("utf-8")
    assert "<title>New records: Friday &lt;races&gt;</title>" in (named / "feed.xml").read_text("utf-8")
    assert "<title>Board: levels - ninja-game</title>" in (plain / "index.html").read_text("utf-8")
    assert '"index.html">Board</a>' in (plain / "players.html").read_text("utf-8")
    ids = [re.findall("<id>(.*?)</id>", (folder / "feed.xml").read_text("utf-8")) for folder in (named, plain)]
    assert ids[0] == ids[1], "a reader of feeds knows the entries again"


def test_rules_put_unknown_runs_on_the_assisted_ladder(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Also those that no keyboard can do; the keeper's decision goes first, and pages say which it is."""
    put(runs, "old.txt", replay(author="Old"))
    put(runs, "demo.txt", record(bytes([4]) + WALKING))
    put(runs, "ann.txt", replay(bytes(9) + WALKING + b"\2", author="Ann", made=Provenance(played=True)))
    rules, site = filed(tmp_path, 'unknown = "assisted"\n'), tmp_path / "site"
    assert read_rules(rules) == (DEFAULT_CATEGORIES, "", ASSISTED)
    words = "--json", str(tmp_path / "board.json"), "--site", str(site)
    page = site / "board" / "levels" / f"{DIGEST[:16]}.html"

    def played(*more: str) -> tuple[bool, ...]:
        board(runs, levels, *words, *more)
        table = page.read_text("utf-8").partition("<h2>Fastest; Highest score")[2].partition("</section>")[0]
        return *(f">{name}<" in table for name in ("Old", "unknown (demo.txt)", "Ann")), among("played")

    def among(ladder: str) -> bool:
        return UNKNOWN_ORIGIN.format(ladder).strip() in page.read_text("utf-8")

    assert played() == (True, False, True, True)
    assert played("--rules", str(rules)) == (False, False, True, False)
    assert (among("assisted"), ">unknown (demo.txt)<" in page.read_text("utf-8")) == (True, True)
    assert played("--rules", str(rules), "--ladder", "old.txt", "played") == (True, False, True, False)
    assert played() == (True, False, True, True)


BROKEN = {
    "name = 3\n" + category(): "not the name of a board", f"name = '{'x' * 41}'\n" + category(): "not the name",
    "": "1 to 12 tables [[category]], a name, unknown", "category = 3": "no categories",
    "x = 1\n" + category(): "no categories", "x = 1": "no categories",
    'unknown = "other"': "'unknown' is no ladder", "unknown = [3]\n" + category(): "'unknown' is no ladder",
    "[[category": "no TOML", category() * (MAX_CATEGORIES + 1): "no categories", category() * 2: "two categories",
    category(rank=[]): "list of formulas", category(rank=[3]): "list of formulas", category(rank="ticks"): "wrong type",
    category(name=""): "empty or too long", category(name="x" * 41): "empty or too long",
    category(order=3): "not the keys",
    category(when="ticks >"): "category 1, column 8: not a formula", category(when="ticks"): "neither true nor false",
    category(rank=["ticks > 3"]): "true or false", category(rank=["x"]): "an unknown name",
    category(rank=["__import__('os')"]): "a character that no formula has", category(rank=["(" * 999]): "formula",
    category(episodes=1): "wrong type", "[[category]]\nname = 'A'": "not the keys",
    "[category]\nname = 'A'\nrank = ['ticks']": "no categories",
}  # fmt: skip


@pytest.mark.parametrize("text", BROKEN)
def test_broken_categories_are_named(text: str, tmp_path: Path) -> None:
    with pytest.raises(NinjaGameError) as caught:
        read_rules(filed(tmp_path, text))
    assert BROKEN[text] in str(caught.value)
    assert "board.toml" in str(caught.value)


def test_categories_of_a_mebibyte_are_too_many(tmp_path: Path, levels: Path, runs: Path) -> None:
    path = filed(tmp_path, "#" * 2**20 + "#")
    result = CliRunner().invoke(cli, ["board", str(runs), "--levels", str(levels), "--rules", str(path)])
    assert (result.exit_code, "too large" in result.output) == (2, True)


def test_every_name_of_a_formula_is_in_the_documents() -> None:
    text = Path("docs/board.md").read_text("utf-8")
    assert all(f"`{name}`" in text for name in RUN_NUMBERS)


def test_no_record_depends_on_the_clock(runs: Path, levels: Path, tmp_path: Path) -> None:
    """The level of the week, the feed and the records follow from the ledger."""
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    put(runs, "cid.txt", replay(level=GOLD_LATER, author="Cid"))
    shown = published_levels(levels)
    days = {"ann.txt": "2026-01-02T12:00:00Z", "bea.txt": "2026-01-01T12:00:00Z", "cid.txt": "2025-12-20T12:00:00Z"}
    ranking = Ranking(judge(runs, shown, Keeping(dates=lambda key, _: days[key[0]]), jobs=1), shown, DEFAULT_CATEGORIES)
    assert ranking.level_of_the_week == (DIGEST, 2, 2)
    assert [(each.run.player, [*each.gains.values()]) for each in ranking.records] == [
        ("Ann", [5.0, 5.0]), ("Bea", [None, None]), ("Cid", [None, None]),
    ]  # fmt: skip
    assert ranking.contested[0] == DIGEST


def test_the_feed_is_atom_and_leads_to_levels(runs: Path, levels: Path, tmp_path: Path) -> None:
    name = "<b>\x1b\u202e&\ud800"
    put(
        runs,
        "ann.txt",
        replay(author="Ann").replace("author: Ann", f"author: {name.encode('utf-8', 'replace').decode()}"),
    )
    board(runs, levels, "--site", str(tmp_path / "site"), "--json", str(tmp_path / "board.json"))
    feed = ET.fromstring((tmp_path / "site" / "board" / "feed.xml").read_text("utf-8"))
    atom = "{http://www.w3.org/2005/Atom}"
    (entry,) = feed.findall(f"{atom}entry")
    for element in (feed, entry):
        assert all(element.findtext(f"{atom}{each}") for each in ("id", "title", "updated"))
    (link,) = entry.findall(f"{atom}link")
    assert (tmp_path / "site" / "board" / link.attrib["href"]).exists()
    board(runs, levels, "--site", str(tmp_path / "site"), "--json", str(tmp_path / "board.json"))
    again = ET.fromstring((tmp_path / "site" / "board" / "feed.xml").read_text("utf-8"))
    assert again.findtext(f"{atom}entry/{atom}id") == entry.findtext(f"{atom}id")


def test_the_feed_says_who_a_name_is_not(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "b.txt", replay(bytes(2) + WALKING + b"\2", author="\u0410nn"))
    board(runs, levels, "--site", str(tmp_path / "site"), "--json", str(tmp_path / "board.json"))
    feed = ET.fromstring((tmp_path / "site" / "board" / "feed.xml").read_text("utf-8"))
    atom = "{http://www.w3.org/2005/Atom}"
    newest = feed.find(f"{atom}entry")
    assert newest is not None
    name = newest.findtext(f"{atom}author/{atom}name")
    assert name == "\u0410nn (not Ann)"
    result = "Fastest: 0.625 s, first; Highest score: 91.375 points, first"
    assert newest.findtext(f"{atom}title") == f"{name}, Walk, {result}"


def test_long_lists_go_on_on_other_pages(
    runs: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.web.board.parts.PER_PAGE", 3)
    for wait in range(3, 10):
        put(runs, f"{wait}.txt", slow_walk(wait, author="Ann"))
    board(runs, levels, "--site", str(tmp_path / "site"))
    pages = sorted((tmp_path / "site" / "board" / "levels").glob("*-runs*.html"))
    assert [path.name.partition("-runs")[2] for path in pages] == ["-2.html", "-3.html", ".html"]
    rows = [path.read_text("utf-8").count("<tr>") - 1 for path in pages]
    assert rows == [3, 1, 3]
    for path in pages:
        links = [attributes.get("href") for name, attributes in Tags(path.read_text("utf-8")).found if name == "a"]
        assert len([link for link in links if link and "-runs" in link]) == 2
    bad = [put(runs, f"bad{number}.txt", "nothing") for number in range(4)]
    for files in (["rejected-2.html", "rejected.html"], ["rejected.html"]):
        board(runs, levels, "--site", str(tmp_path / "site"))
        assert sorted(path.name for path in (tmp_path / "site" / "board").glob("rejected*")) == files
        bad[0].unlink(missing_ok=True)


def test_a_path_has_no_more_points_than_it_needs() -> None:
    import numpy as np

    straight = np.array([[24.0 + 5 * tick, 36.0] for tick in range(4000)])
    assert len(path_data(straight)) < 5000
    assert path_data(straight[:1]) == "M24 36"
