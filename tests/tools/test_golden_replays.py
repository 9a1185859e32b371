"""Writing the golden files again: replays that are right stay as they are."""

from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.text import write_replay
from tests.support import golden_runs


def test_only_replays_that_are_not_right_are_written_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first, second = sorted(golden_runs.REPLAYS.glob("*.replay.txt"))[:2]
    text = first.read_bytes()
    right = load_replays(second)[0].replay
    assert right
    (tmp_path / first.name).write_bytes(text)
    named = replace(right, level_name="A name", level_author="Somebody", digest="0" * 64)
    (tmp_path / second.name).write_text(write_replay(named), "utf-8")
    monkeypatch.setattr(golden_runs, "REPLAYS", tmp_path)
    monkeypatch.setattr(golden_runs, "ROOT", tmp_path)
    monkeypatch.setattr(golden_runs, "FILES", {})
    golden_runs.write_golden_files()
    assert (tmp_path / first.name).read_bytes() == text
    assert load_replays(tmp_path / second.name)[0].replay == replace(named, digest=right.digest)
