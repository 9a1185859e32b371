"""Whose folder a run is from: one in a player's name from another folder waits, until the keeper says whose it is."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.formats.replay.text import parse_replay, write_episode
from tests.support.board import DIGEST, board, put, slow_walk, taken_in_earlier, words_of
from tests.support.forgeries import GOLD_LATER, WALKING, replay

OTHERS = "the other runs by Ann are from ann/"
TO_CONFIRM = re.compile(r"--confirm (\S+)")


@pytest.fixture
def ledger(runs: Path, levels: Path, tmp_path: Path) -> Path:
    """The ledger of a board to which two players, and one without a folder, have sent runs."""
    put(runs, "ann/a.txt", slow_walk(50, author="Ann"))
    put(runs, "mallory/a.txt", slow_walk(90, author="Mallory"))
    put(runs, "flat.txt", slow_walk(120, author="Flat"))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    return data


def waiting(printed: str) -> list[str]:
    return TO_CONFIRM.findall(printed)


def rows(data: Path, part: str = "runs") -> dict[str, dict[str, object]]:
    return {row["file"]: row for row in json.loads(data.read_text("utf-8"))[part]}


@pytest.mark.parametrize("file", ["mallory/b.txt", "new/b.txt", "b.txt", "mallory/ann/b.txt", "Ann/b.txt"])
@pytest.mark.parametrize("author", ["Ann", "ANN", "a\u200bnn"])
def test_a_run_in_anothers_name_waits_and_says_why(
    file: str, author: str, ledger: Path, runs: Path, levels: Path, tmp_path: Path
) -> None:
    put(runs, file, replay(author=author))
    check = CliRunner().invoke(cli, ["board", str(runs), "--levels", str(levels), "--check", str(ledger)])
    assert (check.exit_code, f"new: {file}: Ann passes" in check.output, OTHERS in check.output) == (0, True, True)
    site = tmp_path / "site"
    for _ in range(2):
        assert waiting(board(runs, levels, "--json", str(ledger), "--site", str(site))) == [file]
    assert OTHERS in (site / "board" / "waiting.html").read_text("utf-8")
    level = words_of((site / "board" / "levels" / f"{DIGEST[:16]}.html").read_text("utf-8"))
    assert "Better, and waiting: Ann 0.575 with 1 gold." in level
    assert board(runs, levels, "--check", str(ledger)).startswith("nothing has changed")


def test_a_player_with_two_folders_is_asked_once(ledger: Path, runs: Path, levels: Path) -> None:
    words = "--json", str(ledger)
    put(runs, "desk/a.txt", slow_walk(30, author="Ann"))
    put(runs, "desk/b.txt", slow_walk(25, author="Ann"))
    assert waiting(board(runs, levels, *words)) == ["desk/a.txt", "desk/b.txt"]
    assert waiting(board(runs, levels, *words, "--confirm", "desk/b.txt")) == []
    put(runs, "desk/c.txt", replay(author="Ann"))
    for _ in range(2):
        assert waiting(board(runs, levels, *words)) == []
    assert OTHERS not in board(runs, levels, "--check", str(ledger))
    # Mallory's folder is not one of hers by that.
    put(runs, "mallory/b.txt", slow_walk(3, author="Ann"))
    assert waiting(board(runs, levels, *words)) == ["mallory/b.txt"]


@pytest.mark.parametrize(
    "file, author", [("ann/b.txt", "Ann"), ("new/b.txt", "New"), ("flat/b.txt", "Flat"), ("ann/bob/b.txt", "Ann")]
)
def test_nobody_else_is_asked(file: str, author: str, ledger: Path, runs: Path, levels: Path) -> None:
    put(runs, file, replay(author=author))
    assert waiting(board(runs, levels, "--json", str(ledger))) == []


def test_folders_that_many_share_are_no_players(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Such as those of a board with a folder for each level."""
    for number, name in enumerate(("Ann", "Bea")):
        put(runs, f"walk/{name}.txt", slow_walk(50 + 9 * number, author=name))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    put(runs, "other/Ann.txt", replay(author="Ann"))
    assert waiting(board(runs, levels, "--json", str(data))) == []


def test_of_a_board_that_is_filled_at_once_no_run_waits_and_the_odd_one_says_so(
    runs: Path, levels: Path, tmp_path: Path
) -> None:
    data = tmp_path / "board.json"
    for wait in (40, 50):
        put(runs, f"ann/{wait}.txt", slow_walk(wait, author="Ann"))
    put(runs, "mallory/a.txt", slow_walk(90, author="Mallory"))
    put(runs, "mallory/b.txt", replay(author="Ann"))
    words = "--json", str(data), "--site", str(tmp_path / "site")
    level = tmp_path / "site" / "board" / "levels" / f"{DIGEST[:16]}.html"
    for more, remarks in (((), True), ((), True), (("--confirm", "mallory/b.txt"), False), ((), False)):
        assert waiting(board(runs, levels, *words, *more)) == []
        assert (OTHERS in level.read_text("utf-8")) == remarks, more


def test_a_confirmation_takes_in_a_new_run(ledger: Path, runs: Path, levels: Path) -> None:
    """The command that the last line of --check names is enough, for a near copy too."""
    put(runs, "mallory/b.txt", replay(author="Ann"))
    put(runs, "near/b.txt", replay(bytes(50) + WALKING[:-8] + b"\0" + WALKING, author="Bea"))
    printed = board(runs, levels, "--check", str(ledger))
    assert waiting(printed) == ["mallory/b.txt", "near/b.txt"]
    words = [word for name in waiting(printed) for word in ("--confirm", name)]
    assert waiting(board(runs, levels, "--json", str(ledger), *words)) == []
    assert [rows(ledger)[name]["confirmed"] for name in waiting(printed)] == [True, True]
    before = ledger.read_bytes()
    command = ["board", str(runs), "--levels", str(levels), "--json", str(ledger), "--confirm", "ann/a.txt"]
    result = CliRunner().invoke(cli, command)
    assert (result.exit_code, "that waits; there are: none" in result.stderr) == (2, True)
    assert ledger.read_bytes() == before


@pytest.mark.parametrize("name", ["Ann", "mallory/"])
def test_only_a_file_is_confirmed(name: str, ledger: Path, runs: Path, levels: Path) -> None:
    put(runs, "mallory/b.txt", replay(author="Ann"))
    command = ["board", str(runs), "--levels", str(levels), "--json", str(ledger), "--confirm", name]
    result = CliRunner().invoke(cli, command)
    assert (result.exit_code, "that waits; there are: mallory/b.txt" in result.stderr) == (2, True)


def test_a_run_by_somebody_else_is_not_the_players_any_more(
    ledger: Path, runs: Path, levels: Path, tmp_path: Path
) -> None:
    """Who made it may send it in the right name then, as no copy of it."""
    put(runs, "mallory/b.txt", replay(author="Ann"))
    words = "--json", str(ledger), "--site", str(site := tmp_path / "site")
    taken_in_earlier(runs, levels, ledger)
    put(runs, "mallory/c.txt", replay(author="Mallory"))
    assert "copy: mallory/c.txt: a copy of the run by Ann in mallory/b.txt" in board(runs, levels, *words)
    printed = board(runs, levels, *words, "--disown", "mallory/b.txt", "--reason", "forged")
    assert re.search(r"moderated: mallory/b.txt: not by Ann: rejected by the keeper on [-\d]+: forged\n", printed), (
        printed
    )
    assert (waiting(printed), "copy: " in printed) == ([], False)
    assert ">Ann<" not in (site / "board" / "rejected.html").read_text("utf-8")
    assert rows(ledger)["mallory/c.txt"]["player"] == "Mallory"
    (runs / "mallory" / "b.txt").unlink()
    for _ in range(2):
        assert "copy: " not in board(runs, levels, *words)
    put(runs, "ann/b.txt", replay(author="Ann"))
    assert "moderated: ann/b.txt: not by Ann" in board(runs, levels, *words)


def test_an_episode_in_anothers_name_is_in_no_sum(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann/a.txt", replay(bytes(9) + WALKING + b"\2", GOLD_LATER, author="Ann"))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    put(runs, "mallory/b.txt", write_episode([parse_replay(replay(author="Ann"))]))
    words = "--json", str(data), "--site", str(tmp_path / "site")
    for more, sums in (((), 0), (("--confirm", "mallory/b.txt"), 4)):
        board(runs, levels, *words, *more)
        page = (tmp_path / "site" / "board" / "episodes.html").read_text("utf-8")
        assert (page.count("Fastest: sum of the best") + page.count("Fastest: in one recording")) == sums, more
