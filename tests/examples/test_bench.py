"""The protocol: an agent is measured in every level, and a folder of results becomes a table and curves."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from examples import bench_report, measure
from examples.agents import RandomAgent
from examples.bench_report import RESAMPLES, interval, iqm, normalised
from ninja_game import __version__
from ninja_game.backend.memories import compiled_available
from ninja_game.errors import FileError
from tools import ROOT

fast = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


@fast
def test_every_level_has_its_episodes_and_the_seed_decides_them() -> None:
    agent = RandomAgent()
    first, again = (measure.measure(agent, "bench:test:0-5", episodes=3, seed=5) for _ in range(2))
    assert first["passed"].shape == (3, 6)
    assert all((first[name] == again[name]).all() for name in first)
    assert not (first["passed"] & first["dead"]).any()
    assert (first["ticks"] > 0).all()
    assert (first["ticks"] <= 2000).all()


@fast
def test_known_runs_set_the_par() -> None:
    assert (measure.pars("bench:test:0-5") > 0).all()
    assert len(measure.pars("transfer")) == 20


@pytest.mark.parametrize("name", measure.DIGESTS)
def test_the_levels_of_the_protocol_are_those_that_were_measured_in(name: str) -> None:
    """If this fails, results can no longer be compared: do not change the digest, give back the levels."""
    assert measure.levels_of(name).digest == measure.DIGESTS[name]
    assert f"| `{measure.DIGESTS[name]}` |" in (ROOT / "docs" / "ninjabench.md").read_text("utf-8")


def test_a_command_tells_the_digests() -> None:
    result = CliRunner().invoke(measure.main, ["--digests"])
    assert result.stdout.splitlines() == [f"{digest}  {name}" for name, digest in measure.DIGESTS.items()]


@fast
def test_the_command_writes_the_scores_of_every_grade(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    few = {"bench:test:0-5": 1, "bench:train:0-5": 1}
    monkeypatch.setattr(measure, "TASKS", few)
    out = tmp_path / "random-0.json"
    result = CliRunner().invoke(measure.main, ["random", "-o", str(out)])
    assert result.exit_code == 0, result.output
    found = json.loads(out.read_text())
    assert (found["agent"], found["track"], set(found["scores"])) == ("random", "sight", set(few))
    assert found["digests"] == {name: measure.levels_of(name).digest for name in few}
    assert (found["package"], found["command"][:27]) == (__version__, "python3 -m examples.measure")
    assert "cores" in found["machine"]
    for task, rows in found["levels"].items():
        passed = np.array(rows["passed"].split(), int)
        assert found["scores"][task]["hard"]["passed"] == passed[2::3].mean()
        assert len(rows["par"].split()) == 6
    assert all(0 <= row["par"] <= row["passed"] <= 1 for grades in found["scores"].values() for row in grades.values())
    refused = CliRunner().invoke(measure.main, ["search", "-o", str(out)])
    assert (refused.exit_code, "examples/evaluate.py" in refused.output) == (2, True)


def test_the_interquartile_mean_leaves_out_a_quarter_at_each_end() -> None:
    assert iqm([9, 1, 2, 3, 4, 5, 6, 100]) == 4.5
    assert iqm([[1, 3], [2, 4]]).tolist() == [2, 3]


def test_the_interval_holds_the_mean_and_narrows_with_more_runs() -> None:
    rng = np.random.default_rng(0)
    few, many = (rng.normal(0.5, 0.1, runs) for runs in (4, 40))
    (low, high), (near, far) = (interval(np.tile(scores, (RESAMPLES, 1))) for scores in (few, many))
    assert low < iqm(few) < high
    assert far - near < high - low
    assert interval(np.full((RESAMPLES, 5), 0.25)) == (0.25, 0.25)


def test_scores_are_0_by_chance_and_1_if_all_is_passed() -> None:
    chance = np.array([0.2, 0.0])
    passed = np.array([[0.2, 0.0], [1.0, 1.0], [0.6, 0.0]])
    assert normalised(passed, chance).round(9).tolist() == [0, 1, 0.25]


def test_levels_are_drawn_again_where_a_file_lists_them_all() -> None:
    """Of a run with one level in two passed: by 334 levels alone the share is known to some five points."""
    rows = " ".join("01"[n // 3 % 2] for n in range(1000))
    every = {"levels": {"bench:test": {"passed": rows}}}
    runs = [{"scores": {"bench:test": {grade: {"passed": 0.5} for grade in ("easy", "medium", "hard")}}}]
    assert (bench_report.redrawn(runs, "bench:test", "passed") == 0.5).all()
    again = bench_report.redrawn([runs[0] | every] * 2, "bench:test", "passed")
    assert again.shape == (RESAMPLES, 2, 3)
    assert (again[:, 0] == again[:, 1]).all()
    low, high = interval(again[..., 0])
    assert 0.43 < low < 0.46
    assert 0.54 < high < 0.57


@pytest.mark.parametrize(
    "level,grades",
    [("bench:train:easy", [0]), ("bench:train:hard:0-9", [2]), ("bench:train:0-9", [0, 1, 2]), ("train", []), ("", [])],
)
def test_the_gap_is_of_the_grades_that_were_learned_in(level: str, grades: list[int]) -> None:
    assert bench_report.learned_in({"training": {"level": level}}) == grades


def written(folder: Path, name: str, seed: int, passed: float, **changes: Any) -> Path:
    """Results of one run."""
    rows = {grade: {"passed": passed, "dead": 0.1, "par": passed / 2} for grade in ("easy", "medium", "hard", "all")}
    scores = dict.fromkeys(measure.TASKS, rows)
    curve = [[1e6, 60.0, 50.0, 0.1, 0.2], [2e6, 120.0, 100.0, 0.3, passed]]
    training = {"level": "bench:train:easy", "seed": seed, "curve": curve}
    run = {"format": 2, "agent": name, "track": "sight", "digests": measure.DIGESTS, "training": training}
    run |= {"scores": scores, **changes}
    path = folder / f"{name}-{seed}.json"
    path.write_text(json.dumps(run))
    return path


def test_a_folder_becomes_a_table_and_curves(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    written(tmp_path, "random", 0, 0.2, training={"seed": 0})
    for seed, passed in enumerate((0.5, 0.6, 0.7)):
        others = {} if seed != 1 else {"digests": {**measure.DIGESTS, "transfer": "of other levels"}}
        written(tmp_path, "ppo", seed, passed, **others)
    result = CliRunner().invoke(bench_report.main, [str(tmp_path), "--curves", str(tmp_path / "curves")])
    assert result.exit_code == 0, result.output
    rows = [line.strip("| ").split(" | ") for line in result.stdout.splitlines()]
    assert rows[2][:5] == ["sight", "ppo", "3*", "2.0M", "60.0 [50.0, 70.0]"]
    assert rows[2][9:] == ["+0.0 [+0.0, +0.0]", "60.0 [50.0, 70.0] (2 of 3 runs)"]
    assert rows[3] == ["sight", "random", "1*", "-", "20.0", "20.0", "20.0", "0.0", "10.0", "-", "20.0"]
    assert sorted(path.name for path in (tmp_path / "curves").iterdir()) == ["bench-minutes.png", "bench-steps.png"]


def test_runs_in_other_levels_are_refused(tmp_path: Path) -> None:
    written(tmp_path, "random", 0, 0.2)
    path = written(tmp_path, "ppo", 1, 0.2, digests={**measure.DIGESTS, "bench:test": "60eabd84"})
    with pytest.raises(FileError, match=r"other levels: bench:test.*60eabd84"):
        bench_report.load_results(tmp_path)
    assert path.exists()


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"format": 1}', '{"format": 2, "scores": {}}', "9" * 2**21])
def test_files_that_are_no_results_are_named(tmp_path: Path, content: str) -> None:
    written(tmp_path, "random", 0, 0.2)
    (tmp_path / "odd.json").write_text(content)
    result = CliRunner().invoke(bench_report.main, [str(tmp_path)])
    assert (result.exit_code, "odd.json" in result.output, "Traceback" in result.output) == (1, True, False)


def test_other_formats_and_missing_runs_are_reported(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="no results"):
        bench_report.load_results(tmp_path)
    path = written(tmp_path, "ppo", 0, 0.5)
    with pytest.raises(FileError, match="agent 'random'"):
        bench_report.table(bench_report.load_results(tmp_path))
    written(tmp_path, "ppo", 0, 0.5, format=1)
    with pytest.raises(FileError, match="another format"):
        bench_report.load_results(tmp_path)
    assert path.exists()


def test_the_table_of_the_page_is_made_of_the_results() -> None:
    made = bench_report.table(bench_report.load_results(ROOT / "benchmarks" / "results" / "ninjabench"))
    assert f"\n{made}\n" in (ROOT / "docs" / "ninjabench.md").read_text("utf-8")
