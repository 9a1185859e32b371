"""Splits of runs, and the comparison of two runs place by place."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from ninja_game import ArgumentError, parse_level
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.formats.replay.text import Replay
from ninja_game.runs.compare import NEAR_DISTANCE, aligned, compare_runs, each_second
from ninja_game.runs.run import run_level
from ninja_game.runs.splits import best_run, run_splits, split_table, sum_of_best
from ninja_game.simulation import Simulation
from tests.support.samples import SPIKED, WALK_END, replay_of_walk

LEVEL = "0" * 713 + "|5^100,566!11^200,564,170,564!0^140,566"
"""Holding right leads over gold and the switch into the exit."""

WALKED = parse_replays(replay_of_walk())[0]
CERTIFICATES = sorted((Path(__file__).resolve().parent.parent / "pack").glob("**/*.replay.txt"))


def walk(waiting: int, *, at: int = 0, level: str = LEVEL) -> Recording:
    """The walk to the right, with this many ticks without a key from tick ``at`` on."""
    inputs = bytes([2] * at + [0] * waiting + [2] * 60)
    on = parse_level(level)
    return Recording(on, Replay.of_inputs(inputs, on, name="walk"))


def test_a_run_notes_gold_the_switch_and_its_end() -> None:
    found = run_splits(WALKED)
    assert [(split.event, split.object_id) for split in found.splits] == [
        ("gold-taken", 2), ("exit-opened", 1), ("won", None),
    ]  # fmt: skip
    assert (found.outcome, found.ticks, found.gold, found.splits[-1].tick) == ("exit", WALK_END + 1, 1, WALK_END)
    assert [split.name for split in found.splits] == ["gold 2", "switch of exit 1", "exit"]


def test_a_death_is_a_split_whoever_killed() -> None:
    found = run_splits(walk(0, level=SPIKED))
    assert (found.outcome, found.splits[-1].key) == ("dead", ("died", None, 0))
    assert found.death == "mine 1"


@pytest.mark.parametrize("waiting", [0, 1000, 1024 - WALK_END - 1])
def test_both_memories_note_the_same_splits_also_where_they_look_ahead_again(waiting: int) -> None:
    for run in (walk(waiting), walk(waiting, level=SPIKED), walk(waiting, at=70)):
        plain, compiled = (run_splits(run, memory=memory) for memory in ("plain", "compiled"))
        assert plain.splits
        assert (plain.splits, plain.outcome, plain.death) == (compiled.splits, compiled.outcome, compiled.death)
        assert np.array_equal(plain.positions, compiled.positions)
        assert np.array_equal(plain.positions, run_level(run.level, run.inputs).positions)


def test_a_pass_that_kills_in_the_same_tick_has_no_death() -> None:
    on = parse_level("0" * 713 + "|5^100,40!11^100,584,100,60")
    fall = Recording(on, Replay.of_inputs(bytes(120), on, name="fall"))
    simulation = Simulation(on)
    while simulation.outcome == "running":
        simulation.step_keys(0)
    assert [event.name for event in simulation.events] == ["won", "died"]
    assert [split.event for split in run_splits(fall).splits] == ["exit-opened", "won"]


def test_table_measures_every_run_against_the_best_one() -> None:
    runs = [run_splits(walk(7)), run_splits(walk(0)), run_splits(walk(3, level=SPIKED))]
    best = best_run(runs)
    assert best is runs[1], "the shortest to the exit; not the one that died earlier"
    rows = split_table(runs[:2], best)
    assert [row.ticks[0] - row.ticks[1] for row in rows if row.ticks[0] and row.ticks[1]] == [7, 7, 7]
    assert sum_of_best(rows) == best.splits[-1].tick
    assert rows[0].best_segment == rows[0].ticks[1], "a segment is never slower than the run itself"


def test_sum_of_best_takes_every_segment_from_the_run_that_is_fastest_there() -> None:
    early, late = run_splits(walk(5)), run_splits(walk(4, at=17))
    rows = split_table([early, late], late)
    segments = [row.best_segment or 0 for row in rows]
    points = [0, *(split.tick for split in late.splits)]
    others = [0, *(split.tick for split in early.splits)]
    expected = [min(points[k + 1] - points[k], others[k + 1] - others[k]) for k in range(len(rows))]
    assert segments == expected
    assert sum_of_best(rows) == sum(expected) < min(early.ticks, late.ticks) - 1


def test_what_the_best_run_leaves_out_does_not_end_a_segment_of_another() -> None:
    best, other = run_splits(walk(5)), run_splits(walk(6))
    early, *late = other.splits
    faster = [each._replace(tick=each.tick - 3) for each in late]
    rows = split_table([best, replace(other, splits=(early, early._replace(object_id=99), *faster))], best)
    assert sum_of_best(rows) == best.splits[-1].tick - 3


def test_splits_that_only_another_run_reaches_come_last_and_have_no_segment() -> None:
    nowhere, there = run_splits(replace(walk(0), replay=Replay.of_inputs(bytes(3), walk(0).level))), run_splits(walk(0))
    rows = split_table([nowhere, there], nowhere)
    assert [row.ticks for row in rows] == [(None, split.tick) for split in there.splits]
    assert [row.best_segment for row in rows] == [None, None, None]


def test_comparison_tells_the_first_difference_and_the_lead_everywhere() -> None:
    found = compare_runs(walk(0), walk(6, at=5))
    assert found.first_keys == 5
    assert found.first_place == 6, "keys act on the velocity, which moves the ninja in the next tick"
    assert [lead.at for lead in found.splits] == ["gold 2", "switch of exit 1", "exit"]
    # Besides the six ticks it has to gather speed again.
    assert [lead.ahead for lead in found.splits] == [6, 7, 7]
    assert {lead.ahead for lead in found.places if lead.tick < 5} == {0}
    assert found.places[-1].ahead == found.splits[-1].ahead


@pytest.mark.parametrize("path", CERTIFICATES[:4], ids=lambda path: path.name)
def test_a_run_is_level_with_itself(path: Path) -> None:
    (recording,) = load_replays(path)
    found = compare_runs(recording, recording)
    assert (found.first_keys, found.first_place) == (None, None)
    assert {lead.ahead for lead in (*found.splits, *found.places)} == {0}
    assert len(found.places) == len(found.positions[0])
    assert [lead.tick % 40 for lead in each_second(found.places)] == [0] * ((len(found.places) - 1) // 40)


def test_runs_of_different_levels_are_refused() -> None:
    with pytest.raises(ArgumentError, match="different levels"):
        compare_runs(walk(0), walk(0, level=SPIKED))


def test_runs_that_are_too_long_are_refused() -> None:
    with pytest.raises(ArgumentError, match="too long"):
        aligned(np.zeros((20_000, 2)), np.zeros((20_000, 2)))


@given(st.integers(1, 30), st.integers(0, 30), st.integers(0, 20))
def test_a_pause_is_found_wherever_it_is(before: int, after: int, pause: int) -> None:
    way = np.stack([np.arange(before + after) * 5.0, np.zeros(before + after)], axis=1)
    paused = np.concatenate([way[:before], np.repeat(way[before - 1 : before], pause, axis=0), way[before:]])
    partner = aligned(way, paused)
    assert (partner[: before - 1] == np.arange(before - 1)).all()
    assert (partner[before:] == np.arange(before, before + after) + pause).all()


@given(st.lists(st.tuples(st.floats(0, 800), st.floats(0, 600)), min_size=1, max_size=12), st.data())
def test_alignment_goes_forwards_and_only_pairs_what_is_near(
    points: list[tuple[float, float]], data: st.DataObject
) -> None:
    ours = np.array(points)
    theirs = np.array(data.draw(st.lists(st.sampled_from(points), min_size=1, max_size=12)))
    partner = aligned(ours, theirs)
    found = partner[partner >= 0]
    assert (np.diff(found) >= 0).all()
    assert all(np.hypot(*(ours[i] - theirs[j])) <= NEAR_DISTANCE for i, j in enumerate(partner) if j >= 0)


def test_positions_are_those_of_the_run() -> None:
    found = compare_runs(walk(2), walk(0))
    recording = walk(2)
    run = run_level(recording.level, recording.inputs, memory="plain")
    assert found.positions[0].tobytes() == run.positions.tobytes()
