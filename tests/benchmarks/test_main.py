"""The benchmark: all figures are there, the history notices a changed result, signatures sign everything."""

import json
from pathlib import Path
from typing import Any

import pytest

from benchmarks import speed
from benchmarks.__main__ import COLUMNS, append, machine_kind, main
from benchmarks.charts import Chart
from benchmarks.speed import corpus_digest, signature
from ninja_game.backend.memories import compiled_available
from ninja_game.formats.load import load_replays
from tests.support.samples import WALK, running, write_records


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_json_has_the_figures_that_programs_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(speed, "ROUND_SECONDS", 0.01)
    monkeypatch.setattr(speed, "_first_tick", lambda _: 0.1)
    path = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(23)))
    assert main([str(path), "--quick", "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    names = "plain_ticks_per_s", "compiled_ticks_per_s", "load_us", "save_us", "restore_us", "state_bytes"
    assert all(figures[name] > 0 for name in names)
    assert figures["compile_s"] is None


def test_without_numba_the_plain_figures_remain(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(speed, "ROUND_SECONDS", 0.01)
    monkeypatch.setattr(speed, "compiled_available", lambda: False)
    path = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(23)))
    assert main([str(path)]) == 0
    shown = capsys.readouterr().out
    assert "plain memory" in shown
    assert "compiled" not in shown


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_scaling_writes_a_table_for_each_chart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from benchmarks import charts

    monkeypatch.setattr(charts, "ROUND_SECONDS", 0.0001)
    monkeypatch.setattr(charts, "ROUNDS", 1)
    path = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(23)))
    assert main([str(path), "--scaling", str(tmp_path / "charts"), "--only", "ray"]) == 0
    lines = (tmp_path / "charts" / "ray-against-length.csv").read_text().splitlines()
    assert lines[0] == "series,cells crossed,ns a ray"
    assert len(lines) > 10


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
