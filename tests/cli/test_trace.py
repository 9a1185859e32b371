"""`ninja-game trace`: tables, digests, and differences that explain themselves."""

import csv
import io
import json
import os
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from ninja_game import parse_level, trace_level
from ninja_game.cli.main import cli
from ninja_game.cli.trace import HOW_TO_KEEP
from ninja_game.formats.n14.demo import write_demo
from ninja_game.runs.trace import trace_digests
from ninja_game.sim.inputs import Demo
from tests.support.memories import BOTH
from tests.support.samples import SPIKED, WALK, WALK_END, replay_of_walk, running, write_records
from tests.support.special_files import needs_special_files


def trace(*words: str | Path) -> Result:
    """`ninja-game trace WORDS…` on the plain memory."""
    return CliRunner().invoke(cli, ["trace", "--memory", "plain", *map(str, words)])


@pytest.fixture
def two(tmp_path: Path) -> Path:
    """Two recordings: one reaches the exit, one dies on a mine."""
    return write_records(tmp_path / "two.txt", ("Walk", WALK, running(WALK_END)), ("Mine", SPIKED, running(60)))


@pytest.mark.parametrize("memory", BOTH)
def test_table_has_every_tick_with_velocity_state_and_events(memory: str, two: Path) -> None:
    rows = list(csv.DictReader(trace(two, "--record", "0", "--memory", memory).stdout.splitlines()))
    assert [int(row["tick"]) for row in rows] == list(range(WALK_END + 1))
    assert {row["kind"] for row in rows} == {"ninja"}
    assert float(rows[5]["vx"]) == float(rows[5]["x"]) - float(rows[5]["prev_x"]) > 0
    assert "won" in rows[WALK_END]["events"].split()
    assert rows[WALK_END]["gold"] == "1"


def test_after_a_table_a_terminal_tells_what_is_shorter(two: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shown = io.StringIO()
    monkeypatch.setattr(shown, "isatty", lambda: True, raising=False)
    monkeypatch.setattr("ninja_game.cli.trace.data_output", lambda: shown)
    assert trace(two).stderr.endswith(f"{HOW_TO_KEEP}\n")
    assert len(shown.getvalue().splitlines()) > WALK_END, "all of it, as promised"
    monkeypatch.undo()
    assert "--digests" not in trace(two).stderr


def test_objects_get_rows_of_their_own(two: Path) -> None:
    rows = list(csv.DictReader(trace(two, "--record", "0", "--objects").stdout.splitlines()))
    assert [(row["id"], row["kind"]) for row in rows[:3]] == [("", "ninja"), ("1", "exit"), ("2", "gold")]
    assert [row["s"] for row in rows if row["kind"] == "gold"][-1] == "0", "collected"


@pytest.mark.parametrize("words, ticks", [((), 24), (("--after", "150"), 174), (("--ticks", "7"), 7)])
def test_length_can_be_chosen(words: tuple[str, ...], ticks: int, two: Path) -> None:
    result = trace(two, "--record", "0", "--digests", *words)
    assert json.loads(result.stdout)["ticks"] == ticks


def test_digests_are_those_of_the_whole_run(two: Path) -> None:
    digests = [json.loads(line) for line in trace(two, "--digests", "--ticks", "40").stdout.splitlines()]
    assert [(each["file"], each["record"], each["name"]) for each in digests] == [
        (str(two), 0, "Walk"), (str(two), 1, "Mine"),
    ]  # fmt: skip
    run = trace_level(parse_level(SPIKED), bytes([2] * 40), memory="plain")
    expected = trace_digests(run)
    assert digests[1]["ninja_sha256"] == expected.ninja_sha256
    assert digests[1]["run_sha256"] == expected.run_sha256
    assert digests[1]["objects"] == {"1": expected.objects[1], "2": expected.objects[2]}


@pytest.mark.parametrize("name", ["run.csv", "run.npz"])
def test_trace_against_its_own_file_is_equal(name: str, two: Path, tmp_path: Path) -> None:
    path = tmp_path / name
    assert trace(two, "--objects", "-o", path).exit_code == 0
    result = trace(two, "--against", path)
    assert (result.exit_code, result.stdout) == (0, f"2 of 2 equal to {path}\n")


def test_difference_names_tick_thing_field_and_section(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    source = tmp_path / "scene.replay.txt"
    source.write_text(replay_of_walk())
    assert trace(source, "--objects", "-o", path).exit_code == 0
    lines = path.read_text().splitlines(keepends=True)
    at = next(number for number, line in enumerate(lines) if ",3,,2,gold," in line)
    lines[at] = lines[at].replace("gold,115.0", "gold,116.0")
    path.write_text("".join(lines))
    result = trace(source, "--against", path)
    assert result.exit_code == 1
    assert "walk: tick 3: object 2 (gold): x is 115.0, expected 116.0" in result.stdout


def test_section_of_the_specification_is_reported(two: Path, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    assert trace(two, "-o", path).exit_code == 0
    scene = tmp_path / "scene.txt"
    scene.write_text(two.read_text().replace("#test#", "#objects 8.12#").replace("^100,", "^101,"))
    result = trace(scene, "--against", path)
    assert result.exit_code == 1
    assert "tick 0: ninja: x is " in result.stdout
    assert "(specification: objects 8.12)" in result.stdout


@needs_special_files
def test_a_pipe_is_no_trace_to_compare_with(two: Path, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    result = trace(two, "--against", tmp_path / "pipe")
    assert (result.exit_code, "only a regular file is read; found a pipe" in result.stderr) == (2, True)


@pytest.mark.parametrize("name", ["out.csv", "out.npz"])
def test_recordings_are_not_written_over(name: str, two: Path, tmp_path: Path) -> None:
    source = tmp_path / name
    source.write_bytes(two.read_bytes())
    result = trace(source, "-o", source)
    assert result.exit_code == 2
    assert "read by the same command" in result.stderr
    assert source.read_bytes() == two.read_bytes()


def test_a_name_that_is_not_text_is_written_as_far_as_it_can_be(tmp_path: Path) -> None:
    replay, table = tmp_path / "a.replay.txt", tmp_path / "run.csv"
    replay.write_text(replay_of_walk(name="a\0\ud800,b"))
    assert trace(replay, "-o", table).exit_code == 0
    assert "a\0?,b" in table.read_text()
    assert trace(replay, "--against", table).exit_code == 0


def test_numpy_file_keeps_every_bit(two: Path, tmp_path: Path) -> None:
    assert trace(two, "--objects", "-o", tmp_path / "run.npz").exit_code == 0
    with np.load(tmp_path / "run.npz") as arrays:
        run = trace_level(parse_level(WALK), bytes([2] * (WALK_END + 1)), memory="plain")
        assert arrays["ninja_0"].tobytes() == run.ninja.tobytes()
        assert arrays["objects_0"].tobytes() == run.objects.tobytes()


@pytest.mark.parametrize(
    "words",
    [
        ("--ticks", "5", "--after", "5"), ("--record", "9"), ("--ticks", "0"), ("--digests", "-o", "x.csv"),
        ("--digests", "--against", "two.txt"), ("--against", "two.txt", "-o", "x.csv"),
    ],
)  # fmt: skip
def test_wrong_usage(words: tuple[str, ...], two: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(two.parent)
    assert trace(two, *words).exit_code == 2
    assert list(two.parent.iterdir()) == [two]


def test_against_something_else_names_the_file(two: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.csv"
    other.write_text("file,and,other,columns\n")
    result = trace(two, "--against", other)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"ninja-game: {other}:1: this is not a trace")


def test_two_runs_of_one_file_are_compared(two: Path) -> None:
    result = trace(two, "--record", "1", "--against", two, "--against-record", "0", "--ticks", "20")
    assert result.exit_code == 1
    assert "two.txt:1 Mine: tick 0: object 1: kind is mine, expected exit" in result.stdout
    assert trace(two, "--record", "1", "--against", two).exit_code == 0
    assert trace(two, "--against", two, "--against-record", "7").exit_code == 2
    assert trace(two, "--against-record", "1").exit_code == 2


def test_rows_tell_file_and_keys(two: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.txt"
    other.write_text(two.read_text().replace(running(60), write_demo(Demo(bytes([0, 12, 5, 1]), 4))))
    rows = list(csv.DictReader(trace(two, other).stdout.splitlines()))
    assert {(row["file"], row["record"]) for row in rows} == {
        (str(path), record) for path in (two, other) for record in "01"
    }
    jumping = [row["keys"] for row in rows if (row["file"], row["record"]) == (str(other), "1")]
    assert jumping == ["", "J!", "LJ", "L", "L"]


@pytest.mark.parametrize("name", ["all.csv", "all.npz"])
def test_equal_record_numbers_of_two_files_are_kept_apart(name: str, two: Path, tmp_path: Path) -> None:
    other = write_records(tmp_path / "other.txt", ("Still", WALK, running(3)))
    assert trace(two, other, "-o", tmp_path / name).exit_code == 0
    result = trace(two, other, "--against", tmp_path / name)
    assert (result.exit_code, result.stdout.splitlines()[-1]) == (0, f"3 of 3 equal to {tmp_path / name}")


def test_a_recording_without_level_is_traced_on_the_given_one(tmp_path: Path) -> None:
    (tmp_path / "demo.txt").write_text(f"$Walk#me#test##{running(WALK_END)}#\n")
    (tmp_path / "walk.txt").write_text(WALK)
    assert trace(tmp_path / "demo.txt", "--digests").exit_code == 2
    result = trace(tmp_path / "demo.txt", "--digests", "--level", tmp_path / "walk.txt")
    assert json.loads(result.stdout)["ticks"] == WALK_END + 1


def test_a_folder_of_levels_has_no_recordings(tmp_path: Path) -> None:
    (tmp_path / "level.txt").write_text(WALK)
    result = trace(tmp_path)
    assert result.exit_code == 2
    assert f"{tmp_path}: no recordings here" in result.stderr
    assert "None" not in result.stderr


def test_a_record_that_is_not_there_writes_no_heads_of_columns(two: Path) -> None:
    result = trace(two, "--record", "99")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "no record 99" in result.stderr
