"""`ninja-game board ask`: what a board knows, for people and for bots."""

import json
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.play.replay.paths import paths_picture
from ninja_game.ui.theme import PALETTES, RUN_COLOURS
from tests.support.board import HOSTILE, put, slow_walk, taken_in_earlier
from tests.support.forgeries import WALKING, replay
from tests.support.samples import WALK, WALK_END


@pytest.fixture
def folder(runs: Path) -> Path:
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    put(runs, "cid.txt", replay(bytes(8) + WALKING + b"\2", author=HOSTILE))
    return runs


def ask(folder: Path, pack: Path, *words: str) -> tuple[int, str]:
    result = CliRunner().invoke(cli, ["board", "ask", str(folder), *words, "--levels", str(pack), "--jobs", "1"])
    return result.exit_code, result.stdout or result.stderr


def answer(folder: Path, pack: Path, *words: str) -> list[dict[str, object]]:
    code, text = ask(folder, pack, *words, "--json")
    assert code == 0, text
    found: list[dict[str, object]] = json.loads(text)
    return found


def test_a_level_with_assisted_runs_alone_says_so(runs: Path, levels: Path) -> None:
    put(runs, "bot.txt", replay(author="Bot", made=Provenance(edits=3)))
    code, text = ask(runs, levels, "rank", "Walk")
    assert (code, "on Walk yet; assisted: 1, with --assisted" in text) == (2, True), text


def test_a_faster_assisted_run_is_reported(folder: Path, levels: Path, tmp_path: Path) -> None:
    put(folder, "cid.txt", slow_walk(3, author="Cid"))
    (folder / "ann.txt").unlink()
    put(folder, "bot.txt", replay(bytes(2) + WALKING + b"\2", author="Bot", made=Provenance(edits=3)))
    for what in (["rank"], ["best"], ["trace", "-o", str(tmp_path / "out.png")]):
        assert ask(folder, levels, what[0], "Walk", *what[1:])[1].endswith("\nassisted: 0.625 by Bot (--assisted)\n")
    for words in (["Bea"], ["--assisted"]):
        assert "by Bot (" not in ask(folder, levels, "rank", "Walk", *words)[1]
    assert len(answer(folder, levels, "rank", "Walk")) == 2
    put(folder, "ann.txt", replay(author="Ann"))
    assert "by Bot (" not in ask(folder, levels, "rank", "Walk")[1]


def test_players_of_both_ladders_are_compared(folder: Path, levels: Path) -> None:
    put(folder, "tool.txt", replay(bytes(3) + WALKING + b"\2", author="Ann", made=Provenance(edits=3)))
    put(folder, "bot.txt", replay(bytes(4) + WALKING + b"\2", author="Bot", made=Provenance(edits=3)))
    code, text = ask(folder, levels, "splits", "Walk", "Ann", "Bot", "Ann, assisted")
    head = next(line for line in text.splitlines() if line.startswith("split"))
    assert (code, text.splitlines()[0][:11], head.endswith("Bot, assisted  Ann, assisted")) == (0, "Ann, played", True)
    lines = ask(folder, levels, "rank", "Walk", "Bot", "Bea")[1].splitlines()
    assert [each[:24] for each in lines] == [
        "00-0 Walk, fastest, play",
        "2. Bot, assisted: 0.675 ",
        "2. Bea, played: 0.700 (2",
    ]
    assert [row["ladder"] for row in answer(folder, levels, "rank", "Walk", "Bot", "Bea")] == ["assisted", "played"]


def test_a_faster_run_that_waits_is_reported(runs: Path, levels: Path, tmp_path: Path) -> None:
    put(runs, "ann.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Ann"))
    put(runs, "bob.txt", slow_walk(90, author="Bob"))
    taken_in_earlier(runs, levels, data := tmp_path / "board.json")
    put(runs, "better.txt", slow_walk(40, author="Bob"))
    code, text = ask(runs, levels, "rank", "Walk", "--ledger", str(data))
    assert code == 0
    assert [line.partition(": ")[0] for line in text.splitlines()[1:]] == ["1. Ann", "2. Bob", "-. Bob"]
    assert "; note: waits for confirmation, " in text.splitlines()[-1]
    rows = answer(runs, levels, "rank", "Walk", "--ledger", str(data))
    assert [(row["counts"], "confirmed" in row) for row in rows] == [(True, False)] * 2 + [(False, False)]


@pytest.mark.parametrize("level", ["Walk", "walk", "00-0", "wal", "00-0-LEVEL"])
def test_a_level_is_ranked(level: str, folder: Path, levels: Path) -> None:
    code, text = ask(folder, levels, "rank", level)
    assert code == 0
    head, first, second, third = text.splitlines()
    assert head == "00-0 Walk, fastest, played:"
    assert first == f"1. Ann: 0.575 ({WALK_END} ticks, 1 gold, unknown)"
    assert second.startswith("2. Bea: 0.700")
    assert "\u202e" not in third
    assert [row["ticks"] for row in answer(folder, levels, "rank", level)] == [WALK_END, WALK_END + 5, WALK_END + 8]


@pytest.mark.parametrize("category", ["highest score", "Score"])
def test_the_best_and_a_players_run(category: str, folder: Path, levels: Path) -> None:
    assert [row["player"] for row in answer(folder, levels, "best", "Walk")] == ["Ann"]
    (row,) = answer(folder, levels, "rank", "Walk", "BEA", "--category", category)
    assert (row["place"], row["score"], row["file"]) == (2, 3680 - WALK_END - 5, "bea.txt")


def test_remarks_stand_beside_the_runs(runs: Path, levels: Path) -> None:
    put(runs, "ann.txt", slow_walk(40, author="Ann"))
    put(runs, "bob.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="\u0410nn"))
    near = "64 of its 65 ticks have the inputs of the run by Ann in ann.txt"
    remark = f"{near}; the player's name looks like Ann and is another one"
    assert [row["remark"] for row in answer(runs, levels, "rank", "Walk")] == ["", remark]
    lines = ask(runs, levels, "rank", "Walk")[1].splitlines()
    assert [line.partition("; note: ")[2] for line in lines] == ["", "", remark]


def test_inputs_are_counted(folder: Path, levels: Path) -> None:
    (row,) = answer(folder, levels, "inputs", "Walk", "Bea")
    counted = {key: row[key] for key in ("left", "right", "neither", "jump", "strokes", "longest", "presses", "jumps")}
    right = WALK_END + 1
    assert counted == {
        "left": 0, "right": right, "neither": 5, "jump": 0, "strokes": 2, "longest": right, "presses": 1, "jumps": 0,
    }  # fmt: skip


def test_splits_pictures_and_films(folder: Path, levels: Path, tmp_path: Path) -> None:
    code, text = ask(folder, levels, "splits", "Walk", "Ann", "Bea")
    assert (code, "\nexit " in text, "+5" in text) == (0, True, True), text
    ((event, *_),) = (
        [row["event"], row] for row in json.loads(ask(folder, levels, "splits", "Walk", "--json")[1])["splits"][-1:]
    )
    assert event == "won"
    for what, name, mark in (("trace", "out.png", b"\x89PNG"), ("film", "out.gif", b"GIF8")):
        code, text = ask(folder, levels, what, "Walk", "Ann", "Bea", "-o", str(tmp_path / name))
        assert code == 0, text
        assert (tmp_path / name).read_bytes().startswith(mark)
    assert ask(folder, levels, "trace", "Walk")[0] == 2


def test_a_film_numbers_its_runs_as_a_picture_does(
    folder: Path, levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    films = Mock(side_effect=lambda _, path: path.touch())
    monkeypatch.setattr("ninja_game.play.replay.film.write_film", films)
    assert ask(folder, levels, "film", "Walk", "-o", str(tmp_path / "out.gif"))[0] == 0
    (film,) = films.call_args.args[0]
    assert (len(film.ghosts), film.colours) == (2, (1, 2))


def test_the_first_path_is_on_top() -> None:
    path = np.array([[100.0, 300.0], [700.0, 300.0]])
    picture = paths_picture(parse_level_string(WALK), [("Ann", path), ("Bea", path)], PALETTES["classic"], 792)
    assert picture.get_at((400, 300)) == RUN_COLOURS[0]


@pytest.mark.parametrize(
    "words, reply",
    [
        (["rank", "nothing"], "is no level of the board; it has 3: 00-0 Walk, Spiked, <script>"),
        (["rank", "wlak"], "; do you mean Walk?"),
        (["rank", "a"], "is several levels"),
        (["rank", "Spiked"], "nobody has a run"), (["rank", "Walk", "Zed"], "has no run there; players: Ann"),
        (["rank", "Walk", "--category", "x"], "there are Fastest"),
        (["rank", "Walk", "--category", "EST"], "is several categories: Fastest, Highest score"),
        (["rank", "Walk", "--assisted"], "on Walk yet; played: 3, without --assisted"),
    ],
)  # fmt: skip
def test_what_there_is_not_is_named(words: list[str], reply: str, folder: Path, levels: Path) -> None:
    code, text = ask(folder, levels, *words)
    assert (code, reply in text) == (2, True), text


def test_a_board_remembers_its_rules(folder: Path, levels: Path, tmp_path: Path) -> None:
    (rules := tmp_path / "board.toml").write_text('[[category]]\nname = "Slow"\nrank = ["-ticks"]\n', "utf-8")
    words = ["board", str(folder), "--levels", str(levels), "--jobs", "1"]
    for more, reply in ((["--rules", str(rules)], "00-0 Walk, slow, played:"), ([], "00-0 Walk, fastest, played:")):
        assert CliRunner().invoke(cli, [*words, *more]).exit_code == 0
        for _ in range(2):
            assert reply in CliRunner().invoke(cli, ["board", "ask", str(folder), "rank", "Walk"]).output


def test_a_board_remembers_its_levels(folder: Path, levels: Path) -> None:
    """Without --levels, ask is about those of the last board on the folder."""
    words = ["board", "ask", str(folder), "rank", "Walk"]
    assert "is no level of the board" in CliRunner().invoke(cli, words).stderr
    for pack, reply in ((["--levels", str(levels)], "1. Ann: 0.575"), ([], "is no level of the board")):
        assert CliRunner().invoke(cli, ["board", str(folder), *pack, "--jobs", "1"]).exit_code == 0
        for _ in range(2):
            assert reply in CliRunner().invoke(cli, words).output


def test_a_check_and_a_keeper_go_by_the_levels_and_rules_of_the_last_board(
    folder: Path, levels: Path, tmp_path: Path
) -> None:
    """A check without --levels refused all runs; a decision without --rules gave the board the usual ones."""
    (rules := tmp_path / "board.toml").write_text('[[category]]\nname = "Slow"\nrank = ["-ticks"]\n', "utf-8")
    data, words = str(tmp_path / "board.json"), ["board", str(folder), "--jobs", "1"]
    own = ["--levels", str(levels), "--rules", str(rules), "--json", data]
    assert CliRunner().invoke(cli, [*words, *own]).exit_code == 0
    reject = ["--json", data, "--reject", "ann.txt", "--reason", "spliced"]
    for more in (["--check", data], reject, ["--check", data]):
        result = CliRunner().invoke(cli, [*words, *more])
        assert (result.exit_code, "other-level" in result.output) == (0, False), result.output
    asked = CliRunner().invoke(cli, ["board", "ask", str(folder), "rank", "Walk"])
    assert asked.output.startswith("00-0 Walk, slow, played:\n1. <script>"), asked.output


def test_a_board_remembers_its_ledger(runs: Path, levels: Path, tmp_path: Path) -> None:
    """Without --ledger ask is about that of the last --json, so that it credits nobody whom the pages do not."""
    put(runs, "z.txt", replay(author="Zed"))
    words = ["board", "ask", str(runs), "rank", "Walk", "--jobs", "1"]
    result = CliRunner().invoke(cli, [*words, "--levels", str(levels)])
    assert "no ledger: of two equal runs the first by file name is the original" in result.stderr
    taken_in_earlier(runs, levels, tmp_path / "board.json")
    put(runs, "a.txt", replay(author="Thief"))
    for more in ([], ["--again"], ["--site", str(tmp_path / "site")]):
        result = CliRunner().invoke(cli, words)
        assert result.stdout.splitlines()[1:] == ["1. Zed: 0.575 (23 ticks, 1 gold, unknown) 2026-01-31"]
        assert result.stderr == ""
        assert CliRunner().invoke(cli, ["board", str(runs), "--levels", str(levels), *more]).exit_code == 0


def test_who_has_no_run_is_shown_near_names_once(folder: Path, levels: Path) -> None:
    put(folder, "tool.txt", replay(bytes(3) + WALKING + b"\2", author="Ann", made=Provenance(edits=3)))
    assert ask(folder, levels, "best", "Walk", "Anne")[1].endswith("'Anne' has no run there; players: Ann\n")
    code, text = ask(folder, levels, "best", "Walk", "Zoe")
    assert (code, text.count("Ann"), text.count("Bea")) == (2, 1, 1)
