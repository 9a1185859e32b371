"""What a run costs, and what is refused: by work, which no machine and no memory changes."""

import json
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from ninja_game import run_level
from ninja_game.backend import memories
from ninja_game.backend.memories import open_worlds
from ninja_game.backend.worlds import Worlds
from ninja_game.budget import PAGE_BUDGET, PAGE_TICK_COST, RUN_BUDGET, TURN_WORK, affordable_ticks, tick_cost
from ninja_game.cli.main import cli
from ninja_game.errors import BudgetError, LevelError
from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.load import load_replays, parse_level
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.runs import compare
from ninja_game.runs.compare import aligned
from ninja_game.runs.run import record_replay
from ninja_game.runs.splits import run_splits
from ninja_game.runs.trace import Difference, first_difference, trace_level, trace_recording
from ninja_game.runs.verify import verify_recording
from ninja_game.search.certificate import named_replay, save_replay, verified_run
from ninja_game.sim.inputs import MAX_DEMO_TICKS, Demo
from ninja_game.sim.kinds import NO_KIND
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.simulation import Simulation
from ninja_game.web.services import PageServices
from tests.support.heavy import heavy_level
from tests.support.memories import BOTH
from tests.support.reference import recordings
from tests.support.samples import WALK, WALK_END, running, write_records

CROWD = heavy_level(90)  # a tick of it costs a hundred and one


def recording(level: Level, ticks: int) -> Recording:
    return Recording(level, Replay.of_inputs(bytes(ticks), level, name="run"), file="run.txt", record=3)


def command(*words: object) -> Result:
    return CliRunner().invoke(cli, [str(word) for word in words])


def test_what_creates_nothing_costs_nothing() -> None:
    assert tick_cost(CROWD) == 10 + 91
    assert tick_cost(Level(CROWD.tiles, (*CROWD.objects, ObjectSpec(NO_KIND, ()), ObjectSpec(99, ())))) == 10 + 91


@pytest.mark.parametrize("memory", BOTH)
def test_a_run_that_is_not_over_when_its_budget_is_gets_refused_on_both_memories(memory: str) -> None:
    assert run_level(CROWD, bytes(9), memory=memory, budget=9 * 101).ticks == 9
    with pytest.raises(BudgetError) as caught:
        run_level(CROWD, bytes(10), memory=memory, budget=9 * 101)
    assert str(caught.value) == (
        "the run costs too much work; found 10 ticks of 101 each, not over after 9; expected at most 909; "
        "shorten its inputs if they go on after its end; --budget 1010 lets it run"
    )


def test_a_run_that_ends_in_time_passes_whatever_its_text_goes_on_to_say() -> None:
    inputs = bytes([2]) * 1_000_000
    result = run_level(parse_level(WALK), inputs, memory="plain", budget=100 * tick_cost(parse_level(WALK)))
    assert (result.outcome, result.end_tick) == ("exit", WALK_END)


@pytest.mark.parametrize(
    "path",
    [
        lambda each: verify_recording(each, "plain", budget=1000),
        lambda each: trace_recording(each, memory="plain", budget=1000),
        lambda each: trace_recording(each, ticks=40, memory="plain", budget=1000),
        lambda each: run_splits(each, budget=1000),
        lambda each: record_replay(each.level, each.inputs, budget=1000),
    ],
)
def test_every_path_refuses_what_costs_too_much(path: Callable[[Recording], object]) -> None:
    with pytest.raises(BudgetError, match=r"--budget \d+ lets it run"):
        path(recording(CROWD, 50))


@pytest.mark.parametrize("name", ["verify", "trace", "splits", "compare", "record", "convert"])
def test_commands_name_the_run_and_the_option_that_lets_it_pass(tmp_path: Path, name: str) -> None:
    level = write_level_string(CROWD, exact=True)
    file = write_records(tmp_path / "runs.txt", ("one", level, running(20)), ("two", level, running(20)))
    words = {
        "compare": [file, file, "--record", 0, "--against-record", 1],
        "record": [file, "--record", 1, "-o", tmp_path / "out.txt"],
        "convert": [file, tmp_path / "out", "--to", "replay"],
    }.get(name, [file])
    refused = command(name, *words, "--budget", 500)
    assert refused.exit_code == 2
    assert "runs.txt" in refused.output
    assert "record " in refused.output
    assert "--budget" in refused.output
    assert "costs too much" not in command(name, *words).output


def test_resumed_verification_knows_another_budget(tmp_path: Path) -> None:
    file = write_records(tmp_path / "runs.txt", ("one", write_level_string(CROWD, exact=True), running(20)))
    log = tmp_path / "log"
    assert "1 unreadable" in command("verify", file, "--resume", log, "--budget", 500).output
    assert "1 unreadable" not in command("verify", file, "--resume", log).output


def test_honest_runs_are_far_below_the_budget() -> None:
    """All 1,108 reference recordings and all of our certificates: a fiftieth of it at most."""
    runs = [(parse_level(row.data), parse_demo(row.demo).end + 1) for row in recordings()]
    runs += [(each.level, each.ticks) for path in bundled_replays() for each in load_replays(path)]
    assert max(ticks * tick_cost(level) for level, ticks in runs) < RUN_BUDGET / 50


def test_the_longest_recording_that_n_makes_is_paid_for_on_the_largest_level() -> None:
    assert affordable_ticks(heavy_level()) > MAX_DEMO_TICKS


@pytest.mark.slow
def test_the_costliest_run_takes_seconds_of_the_processor(tmp_path: Path) -> None:
    """Where the rules are compiled; a generous limit, in time of the processor."""
    pytest.importorskip("numba")
    level = heavy_level()
    run_level(level, bytes(2), memory="compiled")
    before = time.process_time()
    with pytest.raises(BudgetError):
        verify_recording(recording(level, 999_999), "compiled")
    assert time.process_time() - before < 20
    file = tmp_path / "run.txt"
    text = write_level_string(level, exact=True)
    file.write_text(f"$run#me##{text}#{write_demo(Demo(bytes(30), 30.0))}#", "utf-8")
    assert json.loads(command("verify", file, "--json").output)["ticks"] == 31


@pytest.fixture
def ticks_run(monkeypatch: pytest.MonkeyPatch) -> Callable[[], int]:
    """How many ticks have been simulated for whole runs and traces."""
    opened: list[Worlds] = []

    def opening(*words: Any, **options: Any) -> Worlds:
        opened.append(open_worlds(*words, **options))
        return opened[-1]

    for module in ("run", "trace"):
        monkeypatch.setattr(f"ninja_game.runs.{module}.open_worlds", opening)
    return lambda: sum(memory.tick() for memory in opened)


GOLD_AT_THE_START = "0" * 713 + "|5^100,566!0^104,566!0^108,566"


@pytest.mark.parametrize("ticks, in_time", [(3599, True), (3759, True), (3760, False), (9000, False)])
def test_a_run_is_judged_by_running_it_once_whether_it_is_in_time_or_not(
    ticks: int, in_time: bool, ticks_run: Callable[[], int]
) -> None:
    assert verify_recording(recording(parse_level(GOLD_AT_THE_START), ticks), "plain").in_time == in_time
    assert ticks_run() == ticks


@pytest.mark.parametrize("ticks", [10, 1000])
def test_a_recording_is_traced_by_running_it_once(ticks: int, ticks_run: Callable[[], int]) -> None:
    assert len(trace_recording(recording(parse_level(WALK), ticks), memory="plain").ninja) == ticks
    assert ticks_run() == ticks


def test_a_trace_ends_with_the_run_and_what_was_asked_for_behind_it() -> None:
    walk = recording(parse_level(WALK), 0)
    walk = replace(walk, replay=replace(walk.replay, inputs=bytes([2] * 1000), final_tick=999))
    whole = trace_level(walk.level, bytes([2] * 300), memory="plain", events=True)
    for after in (0, 250):
        part = trace_recording(walk, after=after, memory="plain", events=True)
        ticks = WALK_END + 1 + after
        assert first_difference(part, whole) == Difference(ticks, "run", "number of ticks", ticks, 300)


def test_the_run_of_a_search_is_verified_and_written_by_running_it_once(
    tmp_path: Path, ticks_run: Callable[[], int]
) -> None:
    run = verified_run(parse_level(WALK), bytes([2] * 60))
    save_replay(tmp_path / "run.txt", named_replay(run, "solve", name="Walk"))
    assert ticks_run() == WALK_END + 1


def test_runs_of_very_different_lengths_are_not_compared_place_by_place(monkeypatch: pytest.MonkeyPatch) -> None:
    np = pytest.importorskip("numpy")
    monkeypatch.setattr(compare, "MAX_TOGETHER", 100)
    assert aligned(np.zeros((90, 2)), np.zeros((10, 2))).tolist()[-1] == 9
    with pytest.raises(Exception, match="runs of 91 and 10 ticks are too long"):
        aligned(np.zeros((91, 2)), np.zeros((10, 2)))


def test_a_page_judges_no_more_than_its_one_thread_can(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.web.services.PAGE_BUDGET", PAGE_BUDGET // 20)
    crowd = heavy_level(3000)
    ticks = PAGE_BUDGET // 20 // tick_cost(crowd) + 1
    file = write_records(tmp_path / "runs.txt", ("one", write_level_string(crowd, exact=True), running(ticks)))
    services = PageServices.__new__(PageServices)
    (verdict,) = map(json.loads, filter(None, services.verdicts("runs.txt", file.read_bytes())))
    assert "costs too much work" in verdict["unreadable"]
    assert "`ninja-game verify` judges it on a desktop" in verdict["unreadable"]


def test_a_page_pauses_between_small_slices_of_a_run(tmp_path: Path, ticks_run: Callable[[], int]) -> None:
    crowd, ticks = heavy_level(400), 600
    file = write_records(tmp_path / "runs.txt", ("one", write_level_string(crowd, exact=True), running(ticks)))
    slices, before = [], ticks_run()
    for text in PageServices.__new__(PageServices).verdicts("runs.txt", file.read_bytes()):
        slices.append(ticks_run() - before)
        before += slices[-1]
        verdict = text
    assert verdict is not None
    assert json.loads(verdict)["ticks"] == ticks + 1
    assert sum(slices) >= ticks
    assert max(slices) * tick_cost(crowd) <= TURN_WORK


@pytest.mark.parametrize("name", ["", ".", "..", "a\0b", "\ud800", "x" * 300])
def test_a_page_says_which_names_no_file_can_have(name: str) -> None:
    (text,) = filter(None, PageServices.__new__(PageServices).verdicts(name, b"x"))
    assert "no file can have this name" in json.loads(text)["unreadable"]


def test_a_level_whose_pictures_would_hold_a_page_is_opened_on_a_desktop_only(monkeypatch: pytest.MonkeyPatch) -> None:
    Simulation(heavy_level(3000), memory="plain")
    monkeypatch.setattr(memories, "_MAX_TICK_COST", PAGE_TICK_COST)
    Simulation(heavy_level(400), memory="plain")
    with pytest.raises(LevelError, match=r"too many objects for a page.*play it on a desktop"):
        Simulation(heavy_level(3000), memory="plain")
