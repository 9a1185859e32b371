"""`ninja-game bench`: all figures are there and are numbers; how large they are is no matter for tests."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game.backend.memories import compiled_available
from ninja_game.cli.main import cli
from ninja_game.runs import benchmark
from tests.support.samples import WALK, running, write_records


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_json_has_the_figures_that_programs_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benchmark, "ROUND_SECONDS", 0.01)
    monkeypatch.setattr(benchmark, "_first_tick", lambda _: 0.1)
    path = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(23)))
    result = CliRunner().invoke(cli, ["bench", str(path), "--quick", "--json"])
    assert result.exit_code == 0, result.stderr
    figures = json.loads(result.stdout)
    names = "plain_ticks_per_s", "compiled_ticks_per_s", "load_us", "save_us", "restore_us", "state_bytes"
    assert all(figures[name] > 0 for name in names)
    assert figures["compile_s"] is None


def test_without_numba_the_plain_figures_remain(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(benchmark, "ROUND_SECONDS", 0.01)
    monkeypatch.setattr(benchmark, "compiled_available", lambda: False)
    path = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(23)))
    result = CliRunner().invoke(cli, ["bench", str(path)])
    assert result.exit_code == 0, result.stderr
    assert "plain memory" in result.stdout
    assert "compiled" not in result.stdout


def test_no_recordings_is_an_error_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.files.resources.bundled_replays", list)
    result = CliRunner().invoke(cli, ["bench"])
    assert result.exit_code == 2
    assert result.stderr.startswith("ninja-game: the game's own replays are not here")
