"""Our own replays and crowded levels show what they showed when the golden files were written (tests/golden)."""

from __future__ import annotations

import pytest

from tests.support.golden_runs import FILES, difference, golden_rows
from tests.support.memories import BOTH


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("file", FILES)
def test_every_golden_run_is_the_same_in_every_object(file: str, memory: str) -> None:
    golden = golden_rows(file)
    rows = [run.row(memory) for run in FILES[file]()]
    wrong = [text for row in rows if (text := difference(row, golden.get(row["name"])))]
    assert not wrong, f"{len(wrong)} of {len(rows)} runs differ:\n" + "\n".join(wrong[:20])
    assert golden.keys() == {row["name"] for row in rows}, "golden rows without a run: write them anew"
