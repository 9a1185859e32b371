"""`ninja-game verify` on archives: reports, checkpoint logs, workers, clusters."""

import json
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game.cli.main import cli
from tests.support.samples import SPIKED, WALK, WALK_END, running, write_records


def verify(*words: str | Path) -> Result:
    """`ninja-game verify --memory plain --workers threads WORDS…`."""
    return CliRunner().invoke(cli, ["verify", "--memory", "plain", "--workers", "threads", *map(str, words)])


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    """A folder of two good recordings, a bad one, and rubbish."""
    folder = tmp_path / "archive"
    folder.mkdir()
    write_records(folder / "a.txt", ("Walk", WALK, running(WALK_END)), ("Mine", SPIKED, running(60)))
    write_records(folder / "b.txt", ("Walk", WALK, running(WALK_END)))
    (folder / "c.txt").write_text("nonsense")
    return folder


def test_a_report_in_json_has_results_and_summary(archive: Path, tmp_path: Path) -> None:
    result = verify(archive, "-q", "--report", tmp_path / "report.json")
    assert result.exit_code == 2
    report = json.loads((tmp_path / "report.json").read_text())
    assert [entry.get("outcome", "unreadable") for entry in report["results"]] == ["exit", "dead", "exit", "unreadable"]
    assert report["summary"]["recordings"] == 3
    assert report["summary"]["failed"] == report["summary"]["unreadable"] == 1
    assert report["summary"]["outcomes"] == {"dead": 1, "exit": 2}


def test_a_report_is_else_the_table_of_the_terminal(archive: Path, tmp_path: Path) -> None:
    result = verify(archive, "--report", tmp_path / "report.txt")
    lines = (tmp_path / "report.txt").read_text().splitlines()
    assert [line for line in lines if not line.startswith("??")] == result.stdout.splitlines()
    assert sum(line.startswith("??") for line in lines) == 1


def test_resuming_tells_the_same(archive: Path, tmp_path: Path) -> None:
    log = tmp_path / "log"
    first = verify(archive, "--resume", log, "--jobs", "2")
    again = verify(archive, "--resume", log)
    assert first.stdout == again.stdout == verify(archive).stdout
    assert len(log.read_text().splitlines()) == 1 + 3


def test_a_file_that_is_not_a_journal_is_left_alone(archive: Path, tmp_path: Path) -> None:
    (tmp_path / "notes").write_text("mine\n")
    result = verify(archive, "--resume", tmp_path / "notes")
    assert result.exit_code == 2
    assert "not a checkpoint log" in result.stderr
    assert (tmp_path / "notes").read_text() == "mine\n"


def test_a_cluster_without_dask_is_an_error_in_words(archive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    result = verify(archive, "--cluster", "tcp://127.0.0.1:1")
    assert result.exit_code == 2
    assert "ninja-game[cluster]" in result.stderr or "tools/dev.py run" in result.stderr
