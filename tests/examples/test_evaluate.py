"""The program that measures an agent: its table, and what is wrong with the words that it is given."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from examples.evaluate import main


def test_the_command_writes_the_table(tmp_path: Path) -> None:
    words = ["random", "--levels", "00-0-first-steps", "--levels", str(tmp_path / "near.nlevel")]
    (tmp_path / "near.nlevel").write_text("0" * 713 + "|5^100,566!11^260,564,230,564\n")
    words += ["--episodes", "2", "--time-limit", "40", "--memory", "plain"]
    shown = CliRunner().invoke(main, words)
    assert shown.exit_code == 0, shown.output
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
