"""Our environments beside others: each has its row, and what is not installed is named."""

import pytest

from benchmarks import beside
from ninja_game.backend.memories import compiled_available


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_what_is_there_is_measured_and_what_is_not_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> None:
        raise ModuleNotFoundError("No module named 'other'")

    monkeypatch.setattr(beside, "MANY", 16)
    rows = {"one": (beside.ours(False), 1, 4), "many": (beside.ours(True), 16, 4), "other": (missing, 1, 1)}
    monkeypatch.setattr(beside, "ROWS", rows)
    lines = beside.table(seconds=0.01, rounds=2).splitlines()
    assert [line.split(" | ")[0] for line in lines[4:6]] == ["| one", "| many"]
    assert all(float(line.split(" | ")[1].replace(",", "")) > 0.0 for line in lines[4:6])
    assert lines[-1] == "other: not measured, ModuleNotFoundError: No module named 'other'"
