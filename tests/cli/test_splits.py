"""`ninja-game splits` and `ninja-game compare`: tables for people and programs, pictures, and errors that say where."""

import csv
import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from PIL import Image

from ninja_game.cli.main import cli
from ninja_game.formats.n14.demo import write_demo
from ninja_game.sim.inputs import Demo
from tests.support.samples import SPIKED, running, write_records

WALK = "0" * 713 + "|5^100,566!11^200,564,170,564!0^140,566"
WALK_END = 34
LATER = write_demo(Demo(bytes([0] * 4 + [2] * 60), 64.0))


def called(*words: str | Path | int) -> Result:
    return CliRunner().invoke(cli, list(map(str, words)))


@pytest.fixture
def runs(tmp_path: Path) -> Path:
    """Two recordings of one level, the second four ticks later, and one that dies in another."""
    walk, late, dead = ("Walk", WALK, running(40)), ("Late", WALK, LATER), ("Mine", SPIKED, running(60))
    return write_records(tmp_path / "three.txt", walk, late, dead)


def test_every_level_has_a_table_with_its_best_run_first(runs: Path) -> None:
    result = called("splits", runs)
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0] == f"Walk: exit in tick {WALK_END}, 0.850 s, 1 gold"
    assert [line.split()[-1] for line in lines[2:5]] == ["+4"] * 3
    assert f"sum of best: tick {WALK_END}, {WALK_END / 40:.3f} s" in lines
    assert any(line.startswith("Mine: dead") for line in lines)


def test_json_and_csv_hold_the_same(runs: Path) -> None:
    table, other = json.loads(called("splits", runs, "--format", "json").stdout)
    rows = list(csv.DictReader(called("splits", runs, "--format", "csv").stdout.splitlines()))
    assert [run["name"] for run in table["runs"]] == ["Walk", "Late"]
    assert [run["outcome"] for run in other["runs"]] == ["dead"]
    late = [row for row in rows if row["name"] == "Late"]
    assert [int(row["tick"]) for row in late] == [split["ticks"][1] for split in table["splits"]]
    assert [row["behind"] for row in late] == ["4", "4", "4"]
    assert table["sum_of_best_tick"] == WALK_END


def test_gold_can_be_left_out_and_the_best_be_given(runs: Path, tmp_path: Path) -> None:
    slow = write_records(tmp_path / "slow.txt", ("Slow", WALK, LATER))
    (table,) = [
        each
        for each in json.loads(called("splits", runs, "--no-gold", "--against", slow, "--format", "json").stdout)
        if len(each["runs"]) > 1
    ]
    assert [run["name"] for run in table["runs"]] == ["Slow", "Walk", "Late"]
    assert [split["event"] for split in table["splits"]] == ["exit-opened", "won"]
    first, *others = (split["ticks"] for split in table["splits"])
    assert first[0] - first[1] == 4
    assert first[0] == first[2]
    assert others


def test_comparison_of_two_records_of_a_file(runs: Path) -> None:
    result = called("compare", runs, runs, "--record", 0, "--against-record", 1)
    assert result.exit_code == 0, result.output
    assert "A: Walk, 35 ticks" in result.stdout
    assert "first other keys: tick 0" in result.stdout
    assert [line.split()[-1] for line in result.stdout.splitlines() if line.startswith("exit ")] == ["+4"]
    same = called("compare", runs, runs, "--record", 0, "--against-record", 0)
    assert "the runs are equal" in same.stdout


def test_comparison_for_programs(runs: Path) -> None:
    words = "compare", runs, runs, "--record", 0, "--against-record", 1
    found = json.loads(called(*words, "--format", "json").stdout)
    rows = list(csv.reader(called(*words, "--format", "csv").stdout.splitlines()))
    assert rows[0] == found["columns"]
    assert [[str(cell) for cell in row] for row in [*found["splits"], *found["places"]]] == rows[1:]
    assert found["splits"][-1][-1] == 4


@pytest.mark.parametrize("words", [("splits",), ("compare", "--record", "0", "--against-record", "1")])
def test_picture_shows_the_runs(words: tuple[str, ...], runs: Path, tmp_path: Path) -> None:
    out = tmp_path / "paths.png"
    files = [runs] * (1 + (words[0] == "compare"))
    assert called(*words, *files, "--picture", out).exit_code == 0
    with Image.open(out) as image:
        assert image.size == (1584, 1500)
        colours = {pixel for _, pixel in image.convert("RGB").getcolors(1 << 20) or []}
    assert {(0, 0x72, 0xB2), (0xD5, 0x5E, 0)} <= colours
    before = runs.read_bytes()
    assert called(*words, *files, "--picture", runs).exit_code == 2
    assert runs.read_bytes() == before


def test_what_cannot_be_compared_is_said(runs: Path, tmp_path: Path) -> None:
    other = called("compare", runs, runs, "--record", 0, "--against-record", 2)
    assert other.exit_code == 2
    assert "different levels" in other.stderr
    assert "choose one with --record" in called("compare", runs, runs).stderr
    elsewhere = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(40)))
    mine = write_records(tmp_path / "mine.txt", ("Mine", SPIKED, running(60)))
    wrong = called("splits", elsewhere, "--against", mine)
    assert wrong.exit_code == 2
    assert "another level" in wrong.stderr
    broken = tmp_path / "broken.txt"
    broken.write_text("nothing")
    both = called("splits", elsewhere, broken)
    assert both.exit_code == 2
    assert "Walk" in both.stdout
    assert str(broken) in both.stderr
