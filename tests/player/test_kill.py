"""A process killed at any moment loses nothing that it has called saved (`tools/soak/kills.py` does more of this)."""

from __future__ import annotations

from pathlib import Path

from tools.soak.kills import kill_test


def test_killed_processes_lose_nothing(tmp_path: Path) -> None:
    told, wrong = kill_test(10, 7, tmp_path)
    assert not wrong
    assert told > 0
