"""`ninja-game verify`: outcomes, claims, exit codes, and the fields that programs read."""

import json
import os
import re
import signal
import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game import parse_level, run_level
from ninja_game.backend.memories import compiled_available
from ninja_game.cli.main import cli
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.sim.rules import RULES_VERSION
from tests.support.samples import NO_NINJA, SPIKED, WALK, WALK_END, replay_of_walk, running, write_records
from tests.support.slow import the_rest_is_slow


def verify(*words: str | Path, memory: str = "plain") -> Result:
    """`ninja-game verify WORDS…`, in threads: processes would take longer than all that they are to do."""
    return CliRunner().invoke(cli, ["verify", "--memory", memory, "--workers", "threads", *map(str, words)])


@pytest.fixture
def walk(tmp_path: Path) -> Path:
    """A file with one recording that reaches the exit."""
    return write_records(tmp_path / "walk.txt", ("Walk", WALK, running(WALK_END)))


@pytest.fixture
def three(tmp_path: Path) -> Path:
    """A file with recordings that reach the exit, die, and just end."""
    records = ("Walk", WALK, running(WALK_END)), ("Mine", SPIKED, running(60)), ("Short", WALK, running(9))
    return write_records(tmp_path / "three.txt", *records)


def test_passing_run_is_good(walk: Path) -> None:
    result = verify(walk)
    assert result.exit_code == 0
    assert result.stdout.splitlines()[-1] == f"1 run of {WALK_END + 1} ticks: 1 exit; none failed"


def test_json_has_the_fields_that_programs_read(walk: Path) -> None:
    verdict = json.loads(verify(walk, "--json").stdout)
    run = run_level(parse_level(WALK), bytes([2] * (WALK_END + 1)), memory="plain")
    assert verdict == {
        "file": str(walk),
        "record": 0,
        "name": "Walk",
        "author": "me",
        "level_digest": level_digest(parse_level(WALK)),
        "level_name": "",
        "body": "circle",
        "rules": RULES_VERSION,
        "outcome": "exit",
        "end_tick": WALK_END,
        "gold": 1,
        "score_ticks": 3600 + 80 - WALK_END,
        "ticks": WALK_END + 1,
        "xy_sha256": sha256(run.positions.astype("<f8").tobytes()).hexdigest(),
        "possible_by_keyboard": True,
        "in_time": True,
        "practice": False,
        "complete": True,
        "made": "",
        "assisted": None,
        "co_authors": "",
        "episode": "",
        "lifetime": 3600,
    }


def test_runs_that_do_not_reach_the_exit_fail(three: Path) -> None:
    result = verify(three, "--json")
    assert result.exit_code == 1
    verdicts = [json.loads(line) for line in result.stdout.splitlines()]
    assert [(verdict["outcome"], verdict["score_ticks"]) for verdict in verdicts] == [
        ("exit", 3680 - WALK_END), ("dead", None), ("running", None),
    ]  # fmt: skip
    assert (verdicts[2]["end_tick"], verdicts[2]["ticks"]) == (-1, 10)


def test_quiet_shows_failures_only(three: Path) -> None:
    lines = verify(three, "--quiet").stdout.splitlines()
    assert len(lines) == 5
    assert re.search(r"does not reach the exit: dead in tick \d+: mine \d", lines[1])
    assert "Walk" not in lines[0]


def test_replay_of_ours_that_tells_the_truth_is_good(tmp_path: Path) -> None:
    (tmp_path / "walk.replay.txt").write_text(replay_of_walk())
    assert verify(tmp_path).exit_code == 0


@pytest.mark.parametrize(
    "claim, message",
    [
        ({"gold": 2}, "tick 23: gold is 1, the replay says 2"),
        ({"outcome": "dead"}, "tick 23: outcome is exit, the replay says dead"),
        ({"digest": "0" * 64}, "tick 23: digest is"),
        ({"rules": 99}, "recorded under rules 99"),
        ({"body": "box"}, "tick 23: digest is"),
    ],
)
def test_replay_of_ours_that_lies_fails(claim: dict[str, object], message: str, tmp_path: Path) -> None:
    (tmp_path / "walk.replay.txt").write_text(replay_of_walk(**claim))
    result = verify(tmp_path)
    assert result.exit_code == 1
    assert message in result.stdout


def test_replay_that_says_it_dies_is_good_when_it_does(tmp_path: Path) -> None:
    level = parse_level(SPIKED)
    end = run_level(level, bytes([2] * 60), memory="plain").end_tick
    inputs = bytes([2] * end)
    text = replay_of_walk(level=level, inputs=inputs, final_tick=end, outcome="dead", gold=0, digest="")
    (tmp_path / "mine.replay.txt").write_text(text)
    result = verify(tmp_path, "--json")
    assert result.exit_code == 0
    assert json.loads(result.stdout)["outcome"] == "dead"


def test_unreadable_files_do_not_stop_the_rest(walk: Path, tmp_path: Path) -> None:
    broken = tmp_path / "broken.replay.txt"
    broken.write_text("ninja-game replay 3\nnonsense\n")
    result = verify(tmp_path)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"ninja-game: {broken}:2")
    assert f"1 run of {WALK_END + 1} ticks: 1 exit; none failed; 1 unreadable" in result.stdout


def test_level_without_ninja_is_named_with_its_record(tmp_path: Path) -> None:
    path = write_records(tmp_path / "a.txt", ("Walk", WALK, running(WALK_END)), ("None", NO_NINJA, running(5)))
    result = verify(path)
    assert result.exit_code == 2
    assert f"ninja-game: {path}:2: record 1: " in result.stderr


def test_levels_in_a_folder_of_recordings_are_skipped(walk: Path, tmp_path: Path) -> None:
    write_records(tmp_path / "levels.txt", ("Only a level", WALK, ""))
    assert verify(tmp_path).exit_code == 0
    assert verify(tmp_path / "levels.txt").exit_code == 2


def test_many_runs_come_in_order_from_several_workers(tmp_path: Path) -> None:
    path = write_records(tmp_path / "many.txt", *((f"run {k}", WALK, running(WALK_END)) for k in range(100)))
    result = verify(path, "--json", "--jobs", "2")
    assert [json.loads(line)["record"] for line in result.stdout.splitlines()] == list(range(100))
    assert result.exit_code == 0


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_memories_agree_in_every_tick(three: Path) -> None:
    plain, compiled = (verify(three, "--json", memory=memory).stdout for memory in ("plain", "compiled"))
    assert plain == compiled
    assert verify(three, "--json", memory="both").stdout == plain


@pytest.mark.skipif(compiled_available(), reason="Numba is installed")
def test_compiled_memory_without_numba_is_an_error_in_words(walk: Path) -> None:
    result = verify(walk, memory="compiled")
    assert result.exit_code == 2
    assert "Numba" in result.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="a terminal's Ctrl-C is another thing there")
def test_interrupt_ends_the_program_and_its_workers(tmp_path: Path) -> None:
    path = write_records(tmp_path / "many.txt", *((f"run {k}", WALK, running(9)) for k in range(20_000)))
    words = [sys.executable, "-m", "ninja_game", "verify", "--memory", "plain", "--jobs", "2", "--json", str(path)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True) as program:
        assert program.stdout
        program.stdout.readline()
        os.killpg(program.pid, signal.SIGINT)
        _, errors = program.communicate(timeout=60)
    assert program.returncode == 130
    # A slow machine has said how far it was.
    assert errors.decode().splitlines()[-1] == "ninja-game: interrupted"


def test_no_file_is_wrong_usage(tmp_path: Path) -> None:
    assert verify().exit_code == 2
    assert verify(tmp_path).exit_code == 2, "an empty folder"


@pytest.mark.parametrize("closed", the_rest_is_slow(["<&- >&- 2>&-", ">&-", "2>&-"], 2))
@pytest.mark.parametrize("name, code", [("good.txt", 0), ("bad.txt", 1), ("missing.txt", 2)])
def test_closed_outputs_change_no_exit_code(tmp_path: Path, name: str, code: int, closed: str) -> None:
    workers = "processes" if (name, closed) == ("bad.txt", "<&- >&- 2>&-") else "threads"
    write_records(tmp_path / "good.txt", ("Walk", WALK, running(WALK_END)))
    write_records(tmp_path / "bad.txt", ("Short", WALK, running(9)))
    words = f"{sys.executable} -P -m ninja_game verify --memory plain --workers {workers} {name}"
    assert subprocess.run(["/bin/sh", "-c", f"{words} {closed}"], cwd=tmp_path, check=False).returncode == code


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full disk to try")
def test_errors_that_cannot_be_written_change_no_exit_code(tmp_path: Path) -> None:
    words = f"{sys.executable} -P -m ninja_game verify --memory plain nowhere.txt"
    assert subprocess.run(["/bin/sh", "-c", f"{words} 2>/dev/full"], cwd=tmp_path, check=False).returncode == 2


def test_one_record_of_a_file_is_judged(three: Path) -> None:
    result = verify(three, "--record", "1", "--json")
    (verdict,) = map(json.loads, result.stdout.splitlines())
    assert (verdict["record"], verdict["outcome"]) == (1, "dead")
    missing = verify(three, "--record", "7")
    assert missing.exit_code == 2
    assert "three.txt: no record 7" in missing.output
