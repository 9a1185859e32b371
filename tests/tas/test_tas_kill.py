"""A TAS editor killed at any moment loses at most its last edit (`tools/soak/tas_kills.py` does more of this)."""

from __future__ import annotations

from pathlib import Path

from tools.soak.tas_kills import kill_test


def test_a_killed_tas_editor_loses_at_most_its_last_edit(tmp_path: Path) -> None:
    told, wrong = kill_test(30, 1, tmp_path)
    assert wrong == []
    assert told > 100
