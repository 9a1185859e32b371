"""Our own replays and crowded levels show what they showed when the golden files were written (tests/golden)."""

from typing import Any

import pytest

from ninja_game.runs.trace import RunTrace, trace_level
from tests.support import golden_runs
from tests.support.golden_runs import FILES, difference, first_place, golden_rows
from tests.support.memories import BOTH


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("file", FILES)
def test_every_golden_run_is_the_same_in_every_object(file: str, memory: str) -> None:
    golden = golden_rows(file)
    runs = {run.name: run for run in FILES[file]()}
    rows = [run.row(memory) for run in runs.values()]
    wrong = [text for row in rows if (text := difference(row, golden.get(row["name"])))]
    hint = "Is the change meant? Then `python3 tools/dev.py golden` and a new rules version (tests/golden/README.md)."
    name = wrong[0].partition(":")[0] if wrong else ""
    if name in golden:
        wrong.insert(0, f"{name}: {first_place(runs[name], memory, golden[name])}")
    assert not wrong, f"{len(wrong)} of {len(rows)} runs differ. {hint}\n" + "\n".join(wrong[:20])
    assert golden.keys() == {row["name"] for row in rows}, "golden rows without a run: write them again"


def test_a_failure_names_the_tick_the_object_and_the_field(monkeypatch: pytest.MonkeyPatch) -> None:
    def moved(*words: Any, **options: Any) -> RunTrace:
        trace = trace_level(*words, **options)
        trace.objects["x"][7, 0] += 1
        return trace

    monkeypatch.setattr(golden_runs, "trace_level", moved)
    run = next(FILES["replays"]())
    place = first_place(run, "plain", golden_rows("replays")[run.name])
    # Where there is no git, or HEAD has other golden files, the second must do.
    assert not place or place.startswith("tick 7: object 1 (gold): x is ")


def test_a_failure_names_the_second_the_object_and_what_is_wrong() -> None:
    row = next(row for row in golden_rows("crowded").values() if "drone" in row["objects"])
    before, _, after = row["objects"].partition("/drone:")
    number = before.rpartition(" ")[2]
    digits, rest = after[:14], after[14:]
    moved = digits[:5] + ("0" if digits[5] != "0" else "1") + digits[6:]
    wrong = {**row, "run": "", "objects": f"{before}/drone:{moved}{rest}"}
    assert difference(wrong, row) == (
        f"{row['name']}: ticks 40 to 79: object {number} (drone) place not as in the golden run"
    )
