"""The program that measures an agent: its table, and what is wrong with the words that it is given."""

import csv
import io
import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from examples.evaluate import as_csv, as_json, as_text, main
from ninja_game.backend.kernel_cache import before_compiling
from ninja_game.learn.evaluation import Evaluation, LevelResult


def test_the_command_writes_the_table(tmp_path: Path) -> None:
    words = ["random", "--levels", "00-0-first-steps", "--levels", str(tmp_path / "near.nlevel")]
    (tmp_path / "near.nlevel").write_text("0" * 713 + "|5^100,566!11^260,564,230,564\n")
    words += ["--episodes", "2", "--time-limit", "40", "--memory", "plain"]
    shown = CliRunner().invoke(main, words)
    assert shown.exit_code == 0, shown.output
    assert before_compiling  # says so before anything is compiled
    assert [line.split()[0] for line in shown.stdout.splitlines()] == ["level", "00-0-first-steps", "near", "random:"]
    out = tmp_path / "random.json"
    assert CliRunner().invoke(main, [*words, "--json", "-o", str(out)]).exit_code == 0
    assert [row["episodes"] for row in json.loads(out.read_text())["results"]] == [2, 2]
    assert CliRunner().invoke(main, [*words, "--csv"]).stdout.startswith("agent,level,episodes,passed")


@pytest.mark.parametrize("wrong", [["nobody"], ["random", "--levels", "nowhere"], ["random", "-o", "."]])
def test_the_command_says_what_is_wrong(wrong: list[str]) -> None:
    result = CliRunner().invoke(main, wrong)
    assert (result.exit_code > 0, result.stdout) == (True, "")
    assert isinstance(result.exception, SystemExit)


def test_tables_say_the_same_in_every_form() -> None:
    rows = [LevelResult("a", 10, 9, 1, 0, 310.0, 1.5, 0.9), LevelResult("b", 10, 0, 4, 6, float("nan"), 0.0, -0.4)]
    made = Evaluation("me", "0" * 64, 1, 0.25, 7, 2000, rows)
    text = as_text(made).splitlines()
    assert text[1].split() == ["a", "9/10", "1", "0", "310", "1.5", "0.90"]
    assert text[2].split() == ["b", "0/10", "4", "6", "-", "0.0", "-0.40"]
    assert text[3].startswith("me: 9 of 20 episodes passed (45.0%), 1 of 2 levels in 90 %")
    found = json.loads(as_json(made))
    assert (found["agent"], found["seed"], found["count_passed"]) == ("me", 1, 1)
    assert [row["ticks"] for row in found["results"]] == [310.0, None]
    read = list(csv.DictReader(io.StringIO(as_csv(made))))
    assert [(row["level"], row["passed"], row["ticks"], row["rate"]) for row in read] == [
        ("a", "9", "310.0", "0.9"),
        ("b", "0", "", "0.0"),
    ]
