"""The editor killed at random moments: a short run of the trial in tools/soak/editor_kills.py."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tools.soak.editor_kills import Said, kill_test, seconds_lost


@pytest.mark.skipif(sys.platform == "win32", reason="children are forked")
def test_a_killed_editor_loses_only_its_last_moments(tmp_path: Path) -> None:
    # Two seconds are the promise; tests run on machines that are busy with others.
    _, wrong = kill_test(2, 7, tmp_path, most=8.0)
    assert not wrong


def test_the_trial_sees_what_is_lost(tmp_path: Path) -> None:
    said = Said()
    said.note([("drawn", "a", 10**9), ("drawn", "b", 3 * 10**9)])
    assert seconds_lost(tmp_path, said, 6 * 10**9) == 5.0
