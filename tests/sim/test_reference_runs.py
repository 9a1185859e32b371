"""Recordings, random runs, their aftermath and the crowded levels of the reference data, on both memories."""

import pytest

from tests.support import reference
from tests.support.comparing import digest_difference, run_difference, trace_of
from tests.support.slow import COMPILED_OR_SLOW

PARTS = 8  # each table is tested in parts, so that two processes share the work

pytestmark = pytest.mark.parametrize("part", range(PARTS))


@pytest.mark.parametrize("memory", COMPILED_OR_SLOW)
def test_recordings_are_exact_in_outcome_tick_gold_positions_and_states(part: int, memory: str) -> None:
    reference.require_reference()
    report([run_difference(row, memory) for row in reference.recordings()[part::PARTS]])


@pytest.mark.parametrize("memory", COMPILED_OR_SLOW)
def test_random_runs_are_exact_in_outcome_tick_gold_positions_and_states(part: int, memory: str) -> None:
    reference.require_reference()
    report([run_difference(row, memory) for row in reference.random_runs()[part::PARTS]])


@pytest.mark.parametrize("memory", COMPILED_OR_SLOW)
def test_the_aftermath_is_exact_in_every_object(part: int, memory: str) -> None:
    reference.require_reference()
    tables = {"recordings": reference.recordings(), "random_runs": reference.random_runs()}
    found = []
    for row in reference.aftermath()[part::PARTS]:
        run = tables[row.table][row.row]
        trace = trace_of(run.data, run.demo, row.ticks, memory)
        name = f"{row.table} {row.row} ({run.label})"
        found.append(digest_difference(trace, name, row.ninja_sha256, row.run_sha256, row.objects))
    report(found)


@pytest.mark.parametrize("memory", COMPILED_OR_SLOW)
def test_crowded_levels_are_exact_in_every_object(part: int, memory: str) -> None:
    reference.require_reference()
    found = []
    for row in reference.fuzz()[part::PARTS]:
        trace = trace_of(row.data, row.demo, row.ticks, memory)
        found.append(digest_difference(trace, row.name, row.ninja_sha256, row.run_sha256, row.objects))
    report(found)


def report(found: list[str]) -> None:
    """Fail with every difference; the first ones say enough."""
    wrong = [difference for difference in found if difference]
    assert not wrong, f"{len(wrong)} of {len(found)} runs differ:\n" + "\n".join(wrong[:20])
