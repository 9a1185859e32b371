"""The solver: finds runs, shortens them, does the same for the same seed - and everything it says is played again."""

import gc
from functools import cache
from itertools import islice
from pathlib import Path

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import LevelError
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.level import Level

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from ninja_game.search import solve as solve_module
from ninja_game.search.certificate import (
    UnverifiedRunError,
    named_replay,
    rows_of,
    smooth_run,
    verified_run,
    without_idle_keys,
)
from ninja_game.search.heuristics import Heuristics
from ninja_game.search.nodes import open_start
from ninja_game.search.searching import Search
from ninja_game.search.solve import solve
from ninja_game.search.task import FIRST_RUN_SEARCHES, Progress, Task, plan_first_run
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED
from tests.support.reference import levels, require_reference

OPEN = "0" * 713 + "|"
WALK = parse_level_string(OPEN + "5^100,566!11^160,564,130,564!0^115,566!0^60,566")
"""Right over gold and switch into the exit; another piece of gold lies the other way."""
WALK_TICKS = 23  # end tick of the walk with the right key held all the time: there is no shorter run

COLUMN = 23
LEDGE = parse_level_string(
    "0" * COLUMN * 8 + ("0" * 20 + "111") * 2 + "0" * COLUMN * 21 + "|5^100,566!11^300,566,228,494"
)
"""The switch floats above a ledge of three tiles in the way: a jump up, then down to the exit."""

LOCKED = parse_level_string(
    ("0" * 10 + "1" * 12 + "0") * 10 + "0" * COLUMN * 21 + "|5^60,566!11^400,566,330,566!9^150,566,0,0,10,23,1,0,0"
)
"""A low corridor, closed at its right end by a locked door whose switch lies in the corridor."""

CLOSED_IN = parse_level_string("0" * COLUMN * 5 + "1" * COLUMN + "0" * COLUMN * 25 + "|5^60,566!11^400,566,330,566")
"""A wall from top to bottom between the ninja and everything else."""

SMALL_WORK = 300_000


def replayed(level: Level, run: Replay | None, body: str = "circle") -> Replay:
    """The run, after it has reached the exit on the plain memory just where it says."""
    assert run is not None
    result = run_level(level, run.inputs, body="box" if body == "box" else "circle", memory="plain")
    assert (result.outcome, result.end_tick, result.gold) == ("exit", run.end_tick, run.gold)
    return run


def test_the_shortest_walk_is_found() -> None:
    run = replayed(WALK, solve(Task(WALK, work=SMALL_WORK)))
    assert run.end_tick == WALK_TICKS


@pytest.mark.parametrize("level", [LEDGE, LOCKED], ids=["ledge", "locked door"])
def test_jumps_and_door_switches_are_found(level: Level) -> None:
    replayed(level, solve(Task(level, work=3_000_000)))


def test_the_box_is_solved_as_a_box() -> None:
    replayed(LEDGE, solve(Task(LEDGE, body="box", work=3_000_000)), "box")


def test_gold_is_fetched_first_where_it_is_asked_for() -> None:
    assert replayed(WALK, solve(Task(WALK, work=SMALL_WORK))).gold < 2
    run = replayed(WALK, solve(Task(WALK, gold=-1, work=2_000_000)))
    assert run.gold == 2
    assert run.end_tick > WALK_TICKS


def test_any_of_several_exits_will_do() -> None:
    two = parse_level_string(OPEN + "5^400,566!11^30,30,40,30!11^460,564,430,564")
    assert replayed(two, solve(Task(two, work=SMALL_WORK))).end_tick == WALK_TICKS


def test_there_is_no_run_where_nothing_leads_to_the_exit() -> None:
    assert solve(Task(CLOSED_IN, work=SMALL_WORK)) is None


@pytest.mark.parametrize("seed", [1, 2])
def test_one_job_and_one_seed_give_one_result(seed: int) -> None:
    first, again = (solve(Task(LEDGE, seed=seed, work=3_000_000)) for _ in range(2))
    assert replayed(LEDGE, first).inputs == replayed(LEDGE, again).inputs


def test_two_jobs_find_a_run_too() -> None:
    replayed(LEDGE, solve(Task(LEDGE, jobs=2, work=2_000_000)))


def test_a_dawdling_run_is_improved() -> None:
    dawdling = bytes([0] * 25 + [2] * 60)
    before = verified_run(WALK, dawdling)
    run = replayed(WALK, solve(Task(WALK, first=dawdling, work=SMALL_WORK)))
    assert run.end_tick < before.end_tick
    assert run.end_tick == WALK_TICKS


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_memory_of_a_solver_is_free_when_it_has_ended(jobs: int) -> None:
    gc.collect()
    gc.disable()
    try:
        assert solve(Task(WALK, work=SMALL_WORK, jobs=jobs))
        assert not [one for one in gc.get_objects() if isinstance(one, Search)]
    finally:
        gc.enable()


def test_every_job_makes_all_searches_for_a_first_run() -> None:
    for job in range(4):
        first = islice(plan_first_run(job), len(FIRST_RUN_SEARCHES))
        assert {(resolution, ticks) for resolution, ticks, _ in first} == set(FIRST_RUN_SEARCHES)


def test_a_rocket_is_led_where_it_must_be() -> None:
    """The rocket must live till the end: its launcher stands in the corridor that leads to the exit."""
    require_reference()
    level = parse_level_string(next(row.data for row in levels() if row.label == "80-3"))
    start = open_start(level, box=False)
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=700_000)
    resolution, ticks = FIRST_RUN_SEARCHES[1]
    search.begin(resolution, seed=1, bound=0)
    while search.ticks < ticks and not search.best():
        search.run(1_000_000)
    best = search.best()
    assert best
    assert verified_run(level, best).end_tick < 700


TWO_WAYS = parse_level_string(OPEN + "5^400,566!11^760,564,730,564!11^340,564,370,564")
"""An exit far to the right, and one near by to the left."""


def test_a_run_that_is_given_need_not_keep_its_way() -> None:
    run = replayed(TWO_WAYS, solve(Task(TWO_WAYS, first=bytes([2] * 150), work=30_000_000)))
    assert run.end_tick == WALK_TICKS


def test_one_job_and_one_seed_improve_a_run_in_one_way() -> None:
    hesitant = bytes([0] * 10 + [2] * 30 + [0] * 30 + [2] * 100)
    first, again = (solve(Task(TWO_WAYS, first=hesitant, seed=3, work=14_000_000)) for _ in range(2))
    assert replayed(TWO_WAYS, first).inputs == replayed(TWO_WAYS, again).inputs


def test_every_better_run_is_reported_verified_and_shorter_than_the_last() -> None:
    runs: list[Replay] = []
    progress: list[Progress] = []
    best = solve(Task(LEDGE, work=3_000_000), report=progress.append, on_better=runs.append)
    assert best == runs[-1]
    ticks = [replayed(LEDGE, run).end_tick for run in runs]
    assert ticks == sorted(set(ticks), reverse=True)
    assert progress[-1].best == ticks[-1]
    assert progress[-1].ticks > 0


def test_jumps_trigger_only_where_the_key_goes_down() -> None:
    run = replayed(LEDGE, solve(Task(LEDGE, work=3_000_000)))
    held = 0
    for keys in run.inputs:
        assert bool(keys & JUMP_PRESSED) == bool(keys & JUMP_HELD and not held)
        held = keys & JUMP_HELD


def test_a_run_that_does_not_reach_the_exit_is_refused() -> None:
    with pytest.raises(UnverifiedRunError, match="does not reach the exit: still running after 5 ticks"):
        solve(Task(WALK, first=bytes(5), work=1000))
    with pytest.raises(UnverifiedRunError, match="collects 1 pieces of gold, 2 were asked for"):
        solve(Task(WALK, first=bytes([2] * 40), gold=2, work=1000))


def test_a_level_without_a_ninja_is_refused() -> None:
    with pytest.raises(LevelError, match="no ninja"):
        solve(Task(parse_level_string(OPEN), work=1000))


def test_the_replay_says_what_was_played() -> None:
    replay = named_replay(verified_run(WALK, bytes([2] * 40)), "solve", name="Walk")
    assert str(replay.made) == "searched (solve)"
    assert (replay.final_tick, replay.outcome, replay.gold) == (WALK_TICKS, "exit", 1)
    assert len(replay.inputs) == WALK_TICKS + 1


def test_keys_that_do_nothing_are_those_of_the_run_that_was_begun_with() -> None:
    # Left and right together stand still, as no key does; in the air a jump that is over makes no difference.
    begun = with_press_bits([0] * 8 + [6] * 3 + [2] * 40)
    junk = with_press_bits([3] * 4 + [0] * 4 + [6] * 3 + [2] * 4 + [6] * 2 + [2] * 34)
    assert without_idle_keys(WALK, junk, begun) == begun
    assert len(rows_of(without_idle_keys(WALK, junk, b""))) <= len(rows_of(begun))
    other = with_press_bits([2] * 4 + [3] * 5 + [2] * 20)
    kept = without_idle_keys(WALK, other, begun, first=6)
    assert (kept[:6], run_level(WALK, kept).positions.tolist()) == (
        other[:6],
        run_level(WALK, other).positions.tolist(),
    )


def test_smoothing_leaves_out_keys_that_do_nothing() -> None:
    fidgety = bytes(1 if tick % 7 == 3 else 2 for tick in range(60))
    run = verified_run(WALK, fidgety)
    smooth = verified_run(WALK, smooth_run(WALK, run.inputs))
    assert smooth.end_tick <= run.end_tick
    assert rows_of(smooth.inputs) == [(2, smooth.end_tick + 1)]


def test_it_is_known_whether_the_solver_is_compiled_on_this_machine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    solve_module.compile_solver()
    monkeypatch.setattr(solve_module, "compile_once", cache(lambda: None))
    assert solve_module.is_solver_compiled(), "by another process"
    monkeypatch.setattr("ninja_game.backend.kernel_cache.code_folder", lambda: tmp_path)
    monkeypatch.setattr("ninja_game.backend.kernel_cache.SHIPPED", tmp_path)
    assert not solve_module.is_solver_compiled()
    solve_module.compile_once()
    assert solve_module.is_solver_compiled(), "in this process, though nothing can be kept"
