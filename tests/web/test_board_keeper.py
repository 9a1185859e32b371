"""What the keeper of a board decides: runs that do not count, and runs on the other ladder; and the dates of runs."""

import json
import re
from pathlib import Path
from random import Random
from unittest.mock import Mock

import pytest
from click.testing import CliRunner

from ninja_game.board import judge
from ninja_game.cli.main import cli
from ninja_game.formats.replay.provenance import Provenance
from tests.support.board import DIGEST, HOSTILE, board, put, slow_walk, taken_in_earlier
from tests.support.forgeries import WALKING, record, replay


def output_of(runs: Path, levels: Path, *words: str) -> str:
    """The error of a command on the board that goes wrong."""
    result = CliRunner().invoke(cli, ["board", str(runs), "--levels", str(levels), "--jobs", "1", *words])
    assert (result.exit_code, "Traceback" in result.output) == (2, False), result.output
    return result.stderr


@pytest.fixture
def ledger(runs: Path, levels: Path, tmp_path: Path) -> Path:
    """The ledger of a board of two played runs, the first one by Ann, and an assisted one."""
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    put(runs, "tool.txt", replay(bytes(3) + bytes([2] * 30), author="Tool", made=Provenance(edits=3)))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    return data


def level_page(site: Path) -> str:
    return (site / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8")


def test_a_run_is_rejected_with_its_reason_until_the_line_is_deleted(
    ledger: Path, runs: Path, levels: Path, tmp_path: Path
) -> None:
    site, reason = tmp_path / "site", f"spliced {HOSTILE}"
    words = "--json", str(ledger), "--site", str(site)
    output = board(runs, levels, *words, "--reject", "ann.txt", "--reason", reason)
    assert "moderated: ann.txt: rejected by the keeper on 20" in output
    assert "rejected: 1 by the keeper" in output
    page = (site / "board" / "rejected.html").read_text("utf-8")
    assert "<b>Rejected by the keeper</b>" in page
    assert ": spliced &lt;script&gt;" in page
    assert "<script>document" not in page
    assert ">Ann<" not in level_page(site)
    assert board(runs, levels, "--check", str(ledger)).startswith("nothing has changed")
    put(runs, "eve.txt", replay(author="Eve"))
    assert "copy: eve.txt: a copy of an earlier run by Ann" in board(runs, levels, "--json", str(ledger))
    put(runs, "ann.txt", (runs / "ann.txt").read_text("utf-8")).rename(runs / "again.txt")
    assert "moderated: again.txt: rejected by the keeper on 20" in board(runs, levels, "--json", str(ledger))
    (runs / "again.txt").rename(runs / "ann.txt")
    board(runs, levels, "--json", str(ledger))
    data = json.loads(ledger.read_text("utf-8"))
    assert [row["file"] for row in data.pop("decisions")] == ["ann.txt"]
    ledger.write_text(json.dumps(data), "utf-8")
    board(runs, levels, *words)
    assert ">Ann<" in level_page(site)
    (row,) = (each for each in json.loads(ledger.read_text("utf-8"))["runs"] if each["file"] == "ann.txt")
    assert row["added"] == "2026-01-31T12:00:00Z"


def test_a_run_is_moved_to_the_other_ladder(ledger: Path, runs: Path, levels: Path, tmp_path: Path) -> None:
    site = tmp_path / "site"
    words = "--json", str(ledger), "--site", str(site)
    board(runs, levels, *words, "--ladder", "ann.txt", "assisted", "--reason", "frame by frame")
    played, assisted = (
        level_page(site).partition(f"<h2>Fastest; Highest score, {ladder}</h2>")[2].partition("</section>")[0]
        for ladder in ("played", "assisted")
    )
    assert (">Ann<" in played, ">Ann<" in assisted, ">Bea<" in played) == (False, True, True)
    remark = "moved to assisted by the keeper on 20"
    assert remark in assisted
    pages = [each.read_text("utf-8") for each in (site / "replays").glob("*.html")]
    assert [": frame by frame<" in each for each in pages if remark in each] == [True]
    board(runs, levels, *words, "--ladder", "ann.txt", "played")
    assert ">Ann<" in level_page(site).partition("<h2>Fastest; Highest score, played")[2].partition("</section>")[0]
    assert len(json.loads(ledger.read_text("utf-8"))["decisions"]) == 1


def test_many_files_are_decided_on_at_once(ledger: Path, runs: Path, levels: Path) -> None:
    """By name, by folder and by player; a name that is both is that of the file."""
    put(runs, "old/ann.txt", slow_walk(40, author="Old"))
    put(runs, "old/bea/2.txt", slow_walk(60, author="ann.txt"))
    words = "--json", str(ledger)
    moved_now = board(runs, levels, *words, "--ladder", "old/", "assisted", "--ladder", "BEA", "assisted").splitlines()
    assert moved_now[:2] == ["ranked as assisted: 2 runs of old/", "ranked as assisted: 1 run of BEA"]
    rejected = "--reject", "ann.txt", "--reject", "tool.txt", "--reason", "spliced"
    board(runs, levels, *words, *rejected)
    decided = {row["file"]: row["what"] for row in json.loads(ledger.read_text("utf-8"))["decisions"]}
    moved = dict.fromkeys(("old/ann.txt", "old/bea/2.txt", "bea.txt"), "assisted")
    assert decided == moved | dict.fromkeys(("ann.txt", "tool.txt"), "rejected")
    for name in ("ol/", "nn", "/"):
        assert "no run of the ledger" in output_of(runs, levels, *words, "--ladder", name, "played")


@pytest.mark.parametrize(
    "words, error",
    [
        (["--reject", "ann.txt"], "--reject: say why with --reason"),
        (["--reject", "ann.txt", "--reason", " "], "--reject: say why with --reason"),
        (["--reject", "ann.txt", "--reason", "x" * 301], "at most 300 characters"),
        (["--reject", "dee.txt", "--reason", "x"], "in that file, or by that player; there are: ann.txt, bea.txt"),
        (["--ladder", "dee.txt", "assisted"], "in that file, or by that player; there are: ann.txt, bea.txt"),
        (["--reject", "old/", "--reason", "x"], "in that folder, or by that player; there are: ann"),
        (["--ladder", "ann.txt", "other"], "'other' is not one of"),
    ],
)
def test_a_decision_that_cannot_be_written_is_named(
    words: list[str], error: str, ledger: Path, runs: Path, levels: Path
) -> None:
    before = ledger.read_bytes()
    assert error in " ".join(output_of(runs, levels, "--json", str(ledger), *words).split())
    assert ledger.read_bytes() == before
    if error.startswith("no run"):
        assert "name the ledger" in output_of(runs, levels, *words)


def test_a_decision_of_another_kind_is_a_wrong_row(ledger: Path, runs: Path, levels: Path) -> None:
    board(runs, levels, "--json", str(ledger), "--ladder", "ann.txt", "assisted")
    text = ledger.read_text("utf-8")
    ledger.write_text(text.replace('"what": "assisted"', '"what": "banned"'), "utf-8")
    assert "row 1 of 'decisions': 'what' is no decision" in output_of(runs, levels, "--json", str(ledger))


def test_dates_of_an_older_board_are_kept(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Runs come into the ledger with real dates: the record's history is of these, and the first owns the run."""
    data, dates, site = tmp_path / "board.json", tmp_path / "dates.csv", tmp_path / "site"
    put(runs, "a/new.txt", replay(author="Ann"))
    put(runs, "b.txt", slow_walk(author="Bea"))
    put(runs, "cid.txt", replay(author="Cid"))
    board(runs, levels, "--json", str(data))
    dates.write_text("File, date\na/new.txt,2021-05-06\nb.txt,2020-03-04T10:00:00Z\ncid.txt, 2022-01-01\n", "utf-8")
    words = "--json", str(data), "--site", str(site)
    assert "copy: cid.txt: a copy of the run by Ann" in board(runs, levels, *words, "--dates", str(dates))
    for _ in range(2):
        page = level_page(site)
        progression = page.partition('id="records"')[2].partition("</table>")[0]
        assert "0.700 2020-03-04" in progression
        assert [each in progression for each in ("<td>2021-05-06</td>", "<td>2020-03-04 10:00 UTC</td>")] == [
            True,
            True,
        ]
        board(runs, levels, *words)
    dates.write_text("cid.txt,2019-01-01\n", "utf-8")
    assert "copy: a/new.txt: a copy of the run by Cid" in board(runs, levels, *words, "--dates", str(dates))


def test_a_date_of_an_older_board_makes_no_near_copy(runs: Path, levels: Path, tmp_path: Path) -> None:
    """A run of the same moment is marked, and keeps its place; one that comes in later waits, as ever."""
    data, dates = tmp_path / "board.json", tmp_path / "dates.csv"
    dates.write_text("ann.txt,2020-03-04\n", "utf-8")
    put(runs, "ann.txt", slow_walk(40, author="Ann"))
    put(runs, "bob.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Bob"))
    words = "--json", str(data)
    for more in (("--dates", str(dates)), (), ("--dates", str(dates))):
        board(runs, levels, *words, *more)
        ann, bob = json.loads(data.read_text("utf-8"))["runs"]
        assert (ann["added"], ann["taken"], "near" in bob) == ("2020-03-04T00:00:00Z", bob["added"], False), more
    data.write_text(data.read_text("utf-8").replace(bob["added"], "2026-01-31T12:00:00Z"), "utf-8")
    put(runs, "cid.txt", replay(bytes(40) + WALKING[:-6] + b"\0" + WALKING, author="Cid"))
    board(runs, levels, *words)
    rows = json.loads(data.read_text("utf-8"))["runs"]
    assert [(row["file"], "near" in row) for row in rows] == [("ann.txt", False), ("bob.txt", False), ("cid.txt", True)]
    data.write_text(data.read_text("utf-8").replace('"taken": "2026', '"taken": "x'), "utf-8")
    assert "not a date" in output_of(runs, levels, *words)


@pytest.mark.parametrize(
    "text, error",
    [
        ("ann.txt", "row 1: no date of a file"),
        ("ann.txt,2020-01-01\nFILE,DATE", "row 2: no date of a file"),
        ("ann.txt,soon", "row 1: no date of a file"),
        ("ann.txt,2999-01-01", "row 1: no date of a file"),
        ("ann.txt,2020-01-01,x", "row 1: no date of a file"),
        ("ann.txt,2020-01-01\nann.txt,2020-01-02", "row 2: no date of a file"),
        ("dee.txt,2020-01-01", "a file that is not among the runs; found dee.txt"),
        ("\0", "row 1: no date of a file"),
    ],
)
def test_a_row_of_dates_that_is_wrong_is_named(
    text: str, error: str, ledger: Path, runs: Path, levels: Path, tmp_path: Path
) -> None:
    before = ledger.read_bytes()
    (tmp_path / "dates.csv").write_text(text, "utf-8")
    assert error in " ".join(
        output_of(runs, levels, "--json", str(ledger), "--dates", str(tmp_path / "dates.csv")).split()
    )
    assert ledger.read_bytes() == before


def test_a_batch_is_one_entry_of_the_feed(
    runs: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "b.txt", replay(author="Bot", made=Provenance(edits=7)))
    for most, entries in ((2, 2), (1, 1)):
        monkeypatch.setattr("ninja_game.web.board.first_page.MAX_OF_A_MOMENT", most)
        board(runs, levels, "--json", str(tmp_path / "board.json"), "--site", str(tmp_path / "site"))
        feed = (tmp_path / "site" / "board" / "feed.xml").read_text("utf-8")
        assert feed.count("<entry>") == entries
    assert "<title>2 runs with records came in together</title>" in feed


def test_a_run_without_an_author_is_a_player_of_its_own(runs: Path, levels: Path, tmp_path: Path) -> None:
    """One that nobody signed stopped the whole board, and all of them were one player."""
    put(runs, "a.txt", replay())
    put(runs, "b.txt", slow_walk(author="\u200b"))
    put(runs, "searched.txt", replay(bytes(3) + bytes([2] * 30), made=Provenance(edits=3)))
    board(runs, levels, "--json", str(data := tmp_path / "board.json"))
    players = [row["player"] for row in json.loads(data.read_text("utf-8"))["runs"]]
    assert players == ["unknown (a.txt)", "unknown (b.txt)", "unknown (searched.txt)"]
    words = ["board", str(runs), "--levels", str(levels), "--site", str(tmp_path / "site"), "--jobs", "1"]
    printed = (
        "3 runs by unknown players; name their players with: ninja-game convert FILE OUT --to replay --author NAME"
    )
    assert printed in CliRunner().invoke(cli, words).stderr
    assert printed in (tmp_path / "site" / "board" / "players.html").read_text("utf-8")
    assert board(runs, levels, "--check", str(data)).startswith("nothing has changed")
    assert "moderated: a.txt" in board(runs, levels, "--json", str(data), "--reject", "a.txt", "--reason", "whose?")


_STRINGS = "", " ", "\u200b", "\ud800", "unknown (ann.txt)", "x" * 1000, HOSTILE, "rejected"
ODD: tuple[object, ...] = (*_STRINGS, None, 7, [], {}, True)


@pytest.mark.parametrize("part", ["runs", "rejected", "withdrawn", "decisions"])
def test_no_value_in_a_ledger_stops_a_board_by_a_traceback(part: str, ledger: Path, runs: Path, levels: Path) -> None:
    put(runs, "cid.txt", replay(author="Cid"))
    put(runs, "nobody.txt", slow_walk(7, author=""))
    put(runs, "gone.txt", slow_walk(8, author="Gone"))
    board(runs, levels, "--json", str(ledger), "--reject", "bea.txt", "--reason", "spliced")
    (runs / "gone.txt").unlink()
    board(runs, levels, "--json", str(ledger))
    whole = json.loads(ledger.read_text("utf-8"))
    random = Random(part)
    assert whole[part], part
    for _ in range(12):
        data = json.loads(json.dumps(whole))
        row = random.choice(data[part])
        for name in random.sample(sorted(row), 2):
            row[name] = random.choice(ODD)
        ledger.write_text(json.dumps(data), "utf-8")
        words = "--levels", str(levels), "--check", str(ledger), "--jobs", "1"
        result = CliRunner().invoke(cli, ["board", str(runs), *words])
        assert result.exit_code in (0, 1, 2), (data[part], result.output)
        assert result.exception is None or isinstance(result.exception, SystemExit), (row, result.exception)


def test_a_decision_is_of_the_run_that_a_file_holds_now(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "a.txt", replay(author="Ann"))
    board(runs, levels, "--json", str(ledger := tmp_path / "board.json"))
    put(runs, "a.txt", slow_walk(author="Ann"))
    put(runs, "first.txt", replay(author="Ann"))
    printed = board(runs, levels, "--json", str(ledger), "--reject", "a.txt", "--reason", "spliced")
    assert re.findall("^moderated: [a-z.]+", printed, flags=re.MULTILINE) == ["moderated: a.txt"]
    assert "1 run by 1 player" in printed
    board(runs, levels, "--json", str(ledger), "--ladder", "a.txt", "assisted")
    assert [row["what"] for row in json.loads(ledger.read_text("utf-8"))["decisions"]] == ["assisted"]


def test_of_the_same_runs_that_came_in_together_none_is_a_copy(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "mbd.txt", replay(author="mbd"))
    put(runs, "tas.txt", replay(author="tas"))
    put(runs, "tas-2.txt", replay(author="tas"))
    words = "--json", str(data := tmp_path / "board.json"), "--site", str(site := tmp_path / "site")
    assert board(runs, levels, *words).splitlines()[0] == "copy: tas.txt: the same run as tas-2.txt"
    rows = json.loads(data.read_text("utf-8"))["runs"]
    assert [row["player"] for row in rows] == ["mbd", "tas"]
    page = level_page(site)
    assert page.count('class="place gold">1<') == 2
    assert "the same run as that by mbd in mbd.txt, which came in together with it" in page
    assert "the same run as that by tas in tas-2.txt, which came in together with it" in page
    put(runs, "eve.txt", replay(author="Eve"))
    taken = re.sub('"added": "[^"]*"', '"added": "2026-01-31T12:00:00Z"', data.read_text("utf-8"))
    data.write_text(taken, "utf-8")
    assert "copy: eve.txt: a copy of the run by mbd" in board(runs, levels, *words)
    board(runs, levels, *words, "--reject", "mbd.txt", "--reason", "one")
    board(runs, levels, *words, "--reject", "tas-2.txt", "--reason", "other")
    assert len(json.loads(data.read_text("utf-8"))["decisions"]) == 2


def test_an_assisted_run_that_names_whose_it_was_does_not_wait(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", slow_walk(40, author="Ann"))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    near = bytes(40) + WALKING[:-8] + b"\0" + WALKING
    edited, alone = Provenance(edits=3), Provenance(played=True)
    sent = {
        "begun": (edited._replace(begun_by="ANN"), ()), "with": (edited, ("Bob", "ann")), "nobody": (edited, ()),
        "other": (edited._replace(begun_by="Dee"), ("Bob",)), "played": (alone, ("Ann",)),
    }  # fmt: skip
    for number, (name, (made, names)) in enumerate(sent.items()):
        keys = near[: 50 + number] + b"\0" + near[50 + number :]
        put(runs, f"{name}.txt", replay(keys, author=f"X{name}", made=made, co_authors=names))
    for _ in range(2):
        printed = board(runs, levels, "--json", str(data), "--site", str(tmp_path / "site"))
        waiting = "--confirm nobody.txt --confirm other.txt --confirm played.txt"
        assert printed.endswith(f"3 wait for confirmation: {waiting}\n"), printed
    assert "of the run by Ann in ann.txt, who is named as its origin" in level_page(tmp_path / "site")
    put(runs, "nobody.txt", (runs / "nobody.txt").read_text("utf-8").replace("edited 3", "edited 3 from a run by Ann"))
    printed = board(runs, levels, "--json", str(data))
    assert printed.endswith("2 wait for confirmation: --confirm other.txt --confirm played.txt\n"), printed


def test_what_no_keyboard_can_do_is_put_on_the_assisted_ladder(runs: Path, levels: Path, tmp_path: Path) -> None:
    """A demo of N that does not say how it was made; and it stays there, in whatever file it is."""
    put(runs, "demo.txt", record(bytes([4]) + WALKING))
    put(runs, "slow.txt", record(bytes([4]) + WALKING[:-3]))
    ledger, site = tmp_path / "board.json", tmp_path / "site"
    words = "--json", str(ledger), "--site", str(site)
    assert "refused: demo.txt: no keyboard can do that: in tick 0" in board(runs, levels, *words)
    assert "--ladder FILE assisted" in (site / "board" / "rejected.html").read_text("utf-8")
    for name, ladder in (("demo.txt", "played"), ("slow.txt", "assisted")):
        assert "no run of the ledger in that file" in output_of(runs, levels, *words, "--ladder", name, ladder)
    for more in (("--ladder", "demo.txt", "assisted", "--reason", "tools"), ()):
        printed = board(runs, levels, *words, *more)
        assert ("refused: demo.txt" in printed, "1 run by 1 player" in printed) == (False, True)
        remark = "the jump key is down and was never pressed; moved to assisted by the keeper on 20"
        assert (remark in level_page(site), ">0.600<" in level_page(site)) == (True, True)
    (row,) = json.loads(ledger.read_text("utf-8"))["runs"]
    assert (row["file"], row["tick"]) == ("demo.txt", len(WALKING) + 1)
    printed = board(runs, levels, *words, "--reject", "demo.txt", "--reason", "whose?")
    assert ("moderated: demo.txt" in printed, "0 runs" in printed) == (True, True)
    data = json.loads(ledger.read_text("utf-8"))
    ledger.write_text(json.dumps(data | {"decisions": []}), "utf-8")
    assert "refused: demo.txt: no keyboard" in board(runs, levels, *words)


def test_a_decision_judges_the_runs_once(
    ledger: Path, runs: Path, levels: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    judged = Mock(side_effect=judge._episodes)
    monkeypatch.setattr(judge, "_episodes", judged)
    printed = board(runs, levels, "--json", str(ledger), "--reject", "ann.txt", "--reason", "spliced")
    assert ("moderated: ann.txt" in printed, judged.call_count) == (True, 1)
