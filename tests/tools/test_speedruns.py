"""The table of shortened speedruns: which runs it is about, and its figures."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.support.reference import require_reference
from tools.measure.speedruns import COUNT, chosen, print_table


def test_the_thirty_are_spread_over_all_levels_that_have_both_runs() -> None:
    require_reference()
    pairs = chosen()
    labels = [person.label for person, _ in pairs]
    assert len(pairs) == len(set(labels)) == COUNT
    assert labels == sorted(labels)
    assert labels[0] < "05"
    assert labels[-1] > "85"
    for person, tas in pairs:
        assert (person.source, tas.source, person.kind, tas.kind) == ("rta", "tas", "speedrun", "speedrun")
        assert (person.label, person.data) == (tas.label, tas.data)


def test_two_files_are_compared_after_the_same_time(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = {
        "new": [("00-0", 100, 90, [[0.0, 100], [1.0, 95], [9.0, 90]]), ("00-1", 50, 40, [[0.0, 50], [2.0, 48]])],
        "old": [("00-0", 100, 90, [[0.0, 100], [4.0, 99]]), ("00-1", 50, 40, [[0.0, 50]])],
    }
    files = [tmp_path / f"{name}.jsonl" for name in rows]
    for file, table in zip(files, rows.values(), strict=True):
        dicts = [{"level": a, "person": b, "tas": c, "course": d} for a, b, c, d in table]
        file.write_text("".join(json.dumps(row) + "\n" for row in dicts))
    print_table(files, 5.0)
    first = capsys.readouterr().out.splitlines()
    assert "| 00-0 | 100 | 90 | 95 | 5 | 99 | 1 |" in first
    assert first[-2:] == [
        "new: 2 of 2 shorter, median saving 3.5 ticks, mean 3.5, 0 at or below the tool-assisted length",
        "old: 1 of 2 shorter, median saving 0.5 ticks, mean 0.5, 0 at or below the tool-assisted length",
    ]
    print_table(files[:1], 60.0)
    assert "1 at or below" in capsys.readouterr().out
