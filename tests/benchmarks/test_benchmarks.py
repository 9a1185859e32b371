"""The tools around benchmarks: the history notices a changed result, charts are saved, signatures sign everything."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from benchmarks.charts import Chart
from ninja_game.formats.load import load_replays
from ninja_game.runs.benchmark import corpus_digest, signature
from tests.support.samples import WALK, running, write_records
from tools.measure.record_benchmark import COLUMNS, append, machine_kind


def row(**changes: Any) -> dict[str, Any]:
    """A row of the history."""
    return dict.fromkeys(COLUMNS, 1) | {"corpus": "c", "signature": "s"} | changes


def test_a_changed_signature_of_the_same_runs_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "here" / "machine.csv"
    assert append(row(), path)
    assert append(row(), path)
    assert append(row(corpus="other", signature="t"), path)
    assert not append(row(signature="u"), path)
    lines = path.read_text().splitlines()
    assert lines[0] == ",".join(COLUMNS)
    assert len(lines) == 5


def test_the_kind_of_machine_is_a_file_name() -> None:
    assert machine_kind().replace(".", "").replace("-", "").isalnum()


def test_the_signature_follows_the_runs_and_the_corpus_the_inputs(tmp_path: Path) -> None:
    one = load_replays(write_records(tmp_path / "one.txt", ("Walk", WALK, running(9))))
    same = load_replays(write_records(tmp_path / "two.txt", ("Name", WALK, running(9))))
    other = load_replays(write_records(tmp_path / "three.txt", ("Walk", WALK, running(8))))
    assert signature(one) == signature(same) != signature(other)
    assert corpus_digest(one) == corpus_digest(same) != corpus_digest(other)


def test_a_chart_is_saved_as_csv_and_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    chart = Chart("cost", "Cost", "objects", "ns")
    chart.add("a", 10, 1.25)
    chart.add("b", 100, 123456.789)
    chart.save(tmp_path)
    assert (tmp_path / "cost.csv").read_text() == "series,objects,ns\na,10,1.25\nb,100,123460.0\n"
    assert "123,457 ns" in capsys.readouterr().out
