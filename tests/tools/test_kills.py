"""A process killed at any moment loses nothing that it has called saved (`tools/soak/kills.py` does more of this)."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tools.soak.kills import Drawing, kill_test


@pytest.mark.slow
@pytest.mark.parametrize("what, kills, least", [("records", 10, 1), ("tas", 30, 100), ("editor", 2, 1)])
def test_killed_processes_lose_nothing(
    what: str, kills: int, least: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if what == "editor" and sys.platform == "win32":
        pytest.skip("children are forked")
    # Two seconds are the promise; tests run on machines that are busy with others.
    monkeypatch.setattr(Drawing, "most", 8.0)
    told, wrong = kill_test(kills, 7, tmp_path, what=what)
    assert not wrong
    assert told > least


def test_the_trial_sees_what_is_lost(tmp_path: Path) -> None:
    said = [("edited", "a", 10**9), ("edited", "b", 3 * 10**9)]
    assert list(Drawing(tmp_path).losses(tmp_path, said, 6 * 10**9)) == ["5.00 s lost"]
