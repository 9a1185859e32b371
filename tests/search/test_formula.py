"""Search under direction: formulas, what their names mean, and keys for a span of a run."""

import json
import re
import warnings
from dataclasses import replace
from itertools import combinations, pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from hypothesis import given, strategies as st

from ninja_game import ArgumentError, Simulation, parse_level
from ninja_game.backend.memories import compiled_available
from ninja_game.batch.batch import Batch
from ninja_game.cli.main import cli
from ninja_game.formats.load import load_replays
from ninja_game.search.formula import methods
from ninja_game.search.formula.language import FormulaError, parse_measure, parse_truth
from ninja_game.search.formula.leg import LegSearch
from ninja_game.search.formula.methods import count_ways, search_span
from ninja_game.search.formula.names import FACTS, NAMES, SPAN_NAMES, difference_from, view_of
from ninja_game.search.formula.task import (
    MAX_SPAN,
    SAME_ROUTE_PX,
    SpanResult,
    SpanTask,
    SpanWorlds,
    distinct_routes,
    score_text,
    target_of,
)
from ninja_game.search.searching import Search
from ninja_game.sim.digest import state_digest
from ninja_game.sim.inputs import with_press_bits
from tests.support.samples import unclaimed_text
from tests.support.slow import COMPILED_OR_SLOW

TEXT = "0" * 713 + "|5^100,566!11^200,564,170,564!0^140,566!12^400,400"
LEVEL = parse_level(TEXT)
WAITING = bytes([0] * 6 + [2] * 60)  # stands for six ticks, then runs over gold and switch into the exit


def at_ten_ticks() -> Batch:
    """Three worlds after ten ticks: standing, going left, going right."""
    batch = Batch(LEVEL, 3, memory="plain")
    batch.run([[0, 1, 2]] * 10)
    return batch


def test_only_ticks_that_were_run_are_counted() -> None:
    worlds = SpanWorlds(SpanTask(LEVEL, WAITING, 6, 60, goal="vx > 0"), 2, memory="plain")
    worlds.try_all(np.full((54, 2), 2, np.uint8))
    assert worlds.ticks_run == 6 + 2 * 1


# --- Formulas ---

numbers = st.floats(0, 100, allow_nan=False).map(lambda value: f"{value:.3f}")


def formulas() -> st.SearchStrategy[str]:
    """Truths and numbers that Python understands too."""
    values = st.recursive(
        numbers | st.sampled_from(["x", "y", "vx", "gold"]),
        lambda part: st.builds("({} {} {})".format, part, st.sampled_from("+-*"), part)
        | st.builds("-{}".format, part)
        | st.builds("max({}, abs({}))".format, part, part),
        max_leaves=6,
    )  # fmt: skip
    comparisons = st.builds("{} {} {}".format, values, st.sampled_from(["<", "<=", ">", ">=", "==", "!="]), values)
    return st.recursive(
        comparisons,
        lambda part: st.builds("({} {} {})".format, part, st.sampled_from(["and", "or"]), part)
        | st.builds("(not {})".format, part),
        max_leaves=4,
    )  # fmt: skip


@given(formulas())
def test_a_formula_means_what_it_means_in_python(text: str) -> None:
    batch = at_ten_ticks()
    found = parse_truth(text, NAMES, FACTS).value(view_of(batch))
    for index, ((x, y), vx) in enumerate(zip(batch.positions.tolist(), batch.velocities()[:, 0].tolist(), strict=True)):
        names = {"x": x, "y": y, "vx": vx, "gold": int(batch.gold[index]), "max": max, "abs": abs}
        assert bool(np.broadcast_to(found, 3)[index]) == bool(eval(text, {"__builtins__": {}}, names)), index


@given(formulas())
def test_the_margin_is_positive_only_where_the_formula_is_true(text: str) -> None:
    view, formula = view_of(at_ten_ticks()), parse_truth(text, NAMES, FACTS)
    value, margin = np.broadcast_to(formula.value(view), 3), np.broadcast_to(formula.margin(view), 3)
    assert not (margin[value == 0] > 0).any()
    assert not (margin[value > 0] < 0).any()


def test_names_mean_what_a_simulation_shows() -> None:
    batch, run = at_ten_ticks(), Simulation(LEVEL)
    for _ in range(10):
        run.step_keys(2)
    view = view_of(batch)
    assert float(view["x"]()[2]) == run.ninja.x
    assert float(view["vx"]()[2]) == run.ninja.vx
    assert float(view["distance"](100.0, 566.0)[2]) == run.ninja.x - 100
    assert view["tick"]().tolist() == [9, 9, 9]
    batch.run([[0, 0, 2]] * 60, stop=True)
    for text, expected in {"taken(2)": [0, 0, 1], "opened(1)": [0, 0, 1], "won": [0, 0, 1], "dead": [0, 0, 0]}.items():
        assert parse_truth(text, NAMES, FACTS).value(view).tolist() == expected, text
    assert view["object_x"](3.0).tolist() == [400] * 3


@pytest.mark.parametrize(
    "text, column, message",
    [
        ("x >", 4, "not a formula; found the end"),
        ("", 1, "not a formula; found the end"),
        ("x > 3 4", 7, "not a formula; found '4'"),
        ("__import__(x)", 1, "an unknown name; found '__import__(x)'"),
        ("import os", 1, "not a formula"),
        ("x > 1; y", 6, "a character that no formula has; found ';'"),
        ("taken(2", 6, "not a formula; found '(2'"),
        ("taken", 1, "'taken' with 0 numbers; found 'taken'; expected taken(number)"),
        ("taken(1, 2)", 1, "'taken' with 2 numbers"),
        ("x and y > 1", 1, "a number beside"),
        ("(x > 1) + 2", 2, "true or false where a number belongs"),
        ("  x.real > 1", 3, "not a part of a formula; found 'x.real'"),
        ("x in y", 1, "an unknown comparison"),
        ("1j > x", 1, "not a part of a formula; found '1j'"),
        ("True", 1, "not a part of a formula"),
        ("-" * 50 + "x > 1", 40, "too many brackets"),
        ("(" * 500, 201, "not a formula"),
        ("x", 0, "a number, neither true nor false; found 'x'"),
        ("x" * 2000, 0, "a formula that is too long"),
    ],
)
def test_what_is_not_a_formula_is_named_with_its_place(text: str, column: int, message: str) -> None:
    with pytest.raises(FormulaError) as caught:
        parse_truth(text, NAMES, FACTS)
    assert message in str(caught.value)
    assert caught.value.column == column


def test_python_warns_of_no_formula() -> None:
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        parse_truth("1<2and 1<2", NAMES, FACTS)
    assert not warned


def test_comparisons_in_a_row_hold_together() -> None:
    view = view_of(at_ten_ticks())
    chained, joined = (parse_truth(text, NAMES, FACTS) for text in ("90 < x < 110", "90 < x and x < 110"))
    assert chained.value(view).tolist() == joined.value(view).tolist() == [1, 1, 1]
    assert chained.margin(view).tolist() == joined.margin(view).tolist()


@given(st.text("xyvtick<>=!()+-*/ 0123.andornot,_$", max_size=40))
def test_any_text_is_a_formula_or_one_of_our_errors(text: str) -> None:
    for parse in (parse_truth, parse_measure):
        try:
            formula = parse(text, NAMES, FACTS)
        except FormulaError:
            continue
        with np.errstate(all="ignore"):
            formula.value(view_of(at_ten_ticks()))


def test_an_unknown_object_is_named() -> None:
    view = view_of(at_ten_ticks())
    wrong = {"taken(9)": "no object 9", "taken(1)": "object 1 is of kind exit", "opened(0.5)": "no object 0.5"}
    for text, message in wrong.items():
        with pytest.raises(ArgumentError, match=message):
            parse_truth(text, NAMES, FACTS).value(view)


# --- Spans ---


def searched(task: SpanTask, *, rounds: int = 30, **options: object) -> tuple[SpanResult, ...]:
    """A search of this many reports, on the plain memory where none is asked for."""
    reports: list[int] = []

    def report(ticks: int, _: tuple[SpanResult, ...]) -> bool:
        reports.append(ticks)
        return len(reports) < rounds

    return search_span(task, report, **{"memory": "auto", **options})  # type: ignore[arg-type]


def outcome_of(inputs: bytes) -> tuple[str, int]:
    run = Simulation(LEVEL)
    for keys in inputs:
        run.step_keys(keys)
        if run.outcome != "running":
            break
    return run.outcome, run.tick


@pytest.mark.parametrize("method", ["local", "beam", "auto"])
def test_the_goal_is_reached_earlier_than_in_the_run(method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if method != "auto":
        monkeypatch.setattr(methods, "beam" if method == "local" else "change", None)
    task = SpanTask(LEVEL, WAITING, 0, 40, goal="x > 130")
    best = searched(task, method=method)[0]
    run = Simulation(LEVEL)
    places = []
    for keys in best.inputs:
        run.step_keys(keys)
        places.append(run.ninja.x)
    assert [x > 130 for x in places] == [False] * (len(places) - 1) + [True]
    assert len(best.inputs) == best.ticks == best.score < 24


def test_the_exhaustive_search_finds_the_best_there_is() -> None:
    task = SpanTask(LEVEL, WAITING, 10, 22, measure="y", least=True)
    best = searched(task, rounds=10**6, method="exhaustive", every=4)[0]
    heights = []
    for choice in product([0, 1, 2, 4, 5, 6], repeat=3):
        run = Simulation(LEVEL)
        for keys in with_press_bits([*WAITING[:10], *(keys for keys in choice for _ in range(4))]):
            run.step_keys(keys)
        heights.append(run.ninja.y)
    assert best.score == min(heights)


def test_the_rest_of_the_run_follows_and_must_reach_the_exit() -> None:
    before = outcome_of(WAITING)
    best = searched(SpanTask(LEVEL, WAITING, 0, 30, goal="x > 120", rest=True))[0]
    after = outcome_of(best.inputs)
    assert after == ("exit", int(best.score))
    assert after[1] < before[1]


@pytest.mark.parametrize("memory", COMPILED_OR_SLOW)
def test_exactly_the_same_state_is_reached_sooner_and_the_rest_follows(memory: str) -> None:
    """It stands still for six ticks."""
    task = SpanTask(LEVEL, WAITING, 0, 20, goal="difference(19) == 0", rest=True)
    best = searched(task, memory=memory, method="local", rounds=3 if memory == "plain" else 30)[0]
    assert outcome_of(best.inputs) == ("exit", int(best.score)) == ("exit", outcome_of(WAITING)[1] - 20 + best.ticks)
    assert best.ticks < 20
    runs = Simulation(LEVEL), Simulation(LEVEL)
    for run, inputs in zip(runs, (WAITING[:20], best.inputs[: best.ticks]), strict=True):
        for keys in inputs:
            run.step_keys(keys)
    assert state_digest(runs[0].world) == state_digest(runs[1].world)


def test_the_difference_is_that_of_place_and_velocity_until_all_is_the_same() -> None:
    batch = at_ten_ticks()
    difference = difference_from(LEVEL, bytes([2] * 12), batch)
    right, x = Simulation(LEVEL), batch.positions[:, 0]
    for _ in range(10):
        right.step_keys(2)
    away = 1 + np.abs(x - right.ninja.x) + np.abs(batch.velocities()[:, 0] - right.ninja.vx)
    assert difference(9.0).tolist() == pytest.approx([away[0], away[1], 0])
    for text, message in {"difference(12)": "the run has ticks 0 to 11", "difference(x)": "is a plain number"}.items():
        with pytest.raises(ArgumentError, match=message):
            parse_measure(text, SPAN_NAMES, FACTS).value({**view_of(batch), "difference": difference})


def test_the_same_place_in_another_world_is_a_difference() -> None:
    batch = Batch(LEVEL, 2, memory="plain")
    batch.run([[0, 0]] * 6)
    batch.world(1).objects[2].is_open = 1
    batch.copy([1], [1])
    assert difference_from(LEVEL, WAITING, batch)(5.0).tolist() == [0, 1]


def test_the_same_seed_finds_the_same() -> None:
    task = SpanTask(LEVEL, WAITING, 0, 30, measure="vx - y / 10")
    first, second = (searched(task, rounds=12, seed=3) for _ in range(2))
    assert [(each.score, each.keys.tolist()) for each in first] == [(each.score, each.keys.tolist()) for each in second]


@pytest.mark.parametrize("measure", ["1 / (x - x)", "0 / 0", "-1 / 0"])
def test_what_has_no_value_is_no_result(measure: str) -> None:
    for least in (False, True):
        assert not searched(SpanTask(LEVEL, WAITING, 0, 10, measure=measure, least=least), rounds=2)


def test_results_are_different_ways_and_sorted() -> None:
    found = searched(SpanTask(LEVEL, WAITING, 0, 30, measure="abs(vx) + abs(vy)"))
    assert list(found) == sorted(found)
    assert len(found) > 1
    for one, other in combinations(found, 2):
        assert np.abs(one.path - other.path).max() > SAME_ROUTE_PX
    assert len(searched(SpanTask(LEVEL, WAITING, 0, 30, goal="x > 110"))) == 1, "the way is straight"


def test_of_one_way_and_of_what_is_beaten_the_best_stands() -> None:
    def result(score: float, ticks: int, lift: float, gold: int = 0) -> SpanResult:
        path = np.column_stack([np.arange(ticks) * 4.0, np.full(ticks, lift)])
        return SpanResult(score, ticks, np.zeros(ticks, np.uint8), gold=gold, path=path)

    best, alike, later, higher = result(30, 30, 0), result(31, 31, 9), result(36, 36, 0), result(37, 37, 30)
    much_later, richer = result(45, 45, 0), result(40, 31, 0, gold=1)
    assert distinct_routes([much_later, higher, alike, richer, later, best], measured=False) == [
        best, higher, richer, much_later
    ]  # fmt: skip
    assert distinct_routes([much_later, higher, alike, best], measured=True) == [best]
    sooner = result(50, 20, 60)
    assert distinct_routes([sooner, best], measured=True) == [best, sooner], "it is there before"


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"first": 5, "last": 5}, "expected a later tick"),
        ({"last": 9000}, "at most 4000"),
        ({"first": 900, "last": 950}, "the run ends in tick 65"),
        ({"rest": True, "measure": "vx"}, "its length is the measure"),
    ],
)
def test_a_span_that_is_none_is_refused(changes: dict[str, object], message: str) -> None:
    with pytest.raises(ArgumentError, match=message):
        SpanTask(**{"level": LEVEL, "inputs": WAITING, "first": 0, "last": 30, **changes})  # type: ignore[arg-type]


def test_a_span_after_the_end_and_too_many_ways_are_refused() -> None:
    with pytest.raises(ArgumentError, match="over before tick 60"):
        searched(SpanTask(LEVEL, WAITING, 60, 66, goal="x > 1"))
    with pytest.raises(ArgumentError, match="a choice every 5 ticks has few enough"):
        count_ways(SpanTask(LEVEL, WAITING, 0, 40), 1)


# --- The command ---


def called(*words: str | Path | float) -> Result:
    return CliRunner().invoke(cli, ["search", *map(str, words)])


@pytest.fixture
def run(tmp_path: Path) -> Path:
    path = tmp_path / "run.inputs.txt"
    path.write_text(unclaimed_text(TEXT, ".*6 R*60", headers="author: A. Player\n"))
    return path


def test_command_writes_the_best_run_and_keeps_its_author(run: Path, tmp_path: Path) -> None:
    out = tmp_path / "best.replay.txt"
    result = called(run, "--from", 0, "--to", 30, "--goal", "x > 120", "--rest", "--seconds", 1.5, "-o", out)
    assert result.exit_code == 0, result.output
    (recording,) = load_replays(out)
    assert (recording.author, recording.replay.level_author) == ("A. Player", ""), "who made the level is not known"
    assert f"exit in tick {recording.ticks - 1}: " in result.stdout
    assert recording.ticks < outcome_of(WAITING)[1]
    before = run.read_text()
    assert called(run, "--from", 0, "--to", 30, "--goal", "x > 120", "--seconds", 1, "-o", run).exit_code == 2
    assert run.read_text() == before


def test_command_with_the_rest_finds_only_what_is_sooner_than_the_run(tmp_path: Path) -> None:
    run, out = tmp_path / "run.inputs.txt", tmp_path / "sooner.replay.txt"
    run.write_text(unclaimed_text(TEXT, "R*60"))
    result = called(run, "--from", 0, "--to", 10, "--goal", "tick == 9", "--rest", "--seconds", 0.5, "-o", out)
    assert (result.exit_code, out.exists()) == (1, False), result.output
    assert result.stdout.startswith("nothing sooner was found; ")


@pytest.mark.parametrize("last, text", [(40, "\n"), (0, "; --to {} includes it\n")])
def test_command_says_that_nothing_is_sooner_than_the_run(tmp_path: Path, last: int, text: str) -> None:
    run = tmp_path / "run.inputs.txt"
    run.write_text(unclaimed_text(TEXT, "R*60"))
    end = outcome_of(bytes([2] * 60))[1] - 1
    result = called(run, "--from", 0, "--to", end + last, "--goal", "won", "--seconds", 0.5)
    assert result.exit_code == (0 if last else 1)
    line = f"nothing sooner than RUN, which reaches the goal in tick {end}{text.format(end + 1)}"
    assert result.stdout.endswith(line)


def test_command_keeps_the_end_of_a_span_exactly(run: Path, tmp_path: Path) -> None:
    out = tmp_path / "shorter.replay.txt"
    goal = "difference(19) == 0"
    result = called(run, "--from", 0, "--to", 20, "--goal", goal, "--rest", "--seconds", 1.5, "-o", out)
    assert result.exit_code == 0, result.output
    (recording,) = load_replays(out)
    assert recording.ticks < outcome_of(WAITING)[1]


def test_command_says_what_is_wrong(run: Path) -> None:
    assert (
        "--maximise and --minimise" in called(run, "--from", 0, "--to", 9, "--maximise", "x", "--minimise", "y").stderr
    )
    wrong = called(run, "--from", 0, "--to", 9, "--goal", "x >")
    assert wrong.exit_code == 2
    assert "ninja-game: goal, column 4: not a formula; found the end" in wrong.stderr
    number = called(run, "--from", 0, "--to", 9, "--maximise", "x > 3")
    assert "ninja-game: measure: true or false, no number; found 'x > 3'" in number.stderr
    assert "nothing to search for" in called(run, "--from", 0, "--to", 9).stderr
    assert "--every is for" in called(run, "--from", 0, "--to", 9, "--goal", "x > 1", "--every", 2).stderr
    none = called(run, "--from", 0, "--to", 9, "--goal", "x > 700", "--seconds", 0.3)
    assert none.exit_code == 1
    assert "not reached" in none.stdout
    assert re.search(r"closest: 5\d\d short after tick 8: (..\*9|R)", none.stdout), none.stdout


def test_the_page_explains_every_name() -> None:
    page = (Path(__file__).resolve().parents[2] / "docs" / "speedruns.md").read_text("utf-8")
    missing = [name for name in SPAN_NAMES if f"`{name}" not in page]
    assert json.dumps(missing) == "[]"


# --- How far it is to a fact that is not so ---

SWITCH_BEHIND = parse_level("0" * 713 + "|5^400,566!11^500,564,300,564!0^600,566!9^200,564,0,0,0,0,0,0,0!12^700,100")
"""The exit at the right, its switch at the left: the way is first to the left, then to the right."""


def margins(goal: str, keys: list[int], ticks: int) -> list[float]:
    """Of worlds that have held these keys."""
    worlds = SpanWorlds(SpanTask(SWITCH_BEHIND, bytes(200), 0, 200, goal=goal), len(keys))
    worlds.batch.run([keys] * ticks)
    found: list[float] = worlds.measured()[1].tolist()
    return found


@pytest.mark.parametrize(
    "goal, better, worse", [("won", 1, 2), ("opened(1)", 1, 2), ("taken(2)", 2, 1), ("won and gold >= 0", 1, 2)]
)
def test_what_is_not_so_yet_is_nearer_on_the_right_way(goal: str, better: int, worse: int) -> None:
    left, still, right = margins(goal, [1, 0, 2], 15)
    by_keys = {1: left, 2: right}
    assert by_keys[worse] < still < by_keys[better] < 0.0


def test_behind_the_switch_the_way_leads_to_the_exit() -> None:
    worlds = SpanWorlds(SpanTask(SWITCH_BEHIND, bytes(200), 0, 200, goal="won"), 2)
    keys = np.array([[1, 1]] * 60 + [[1, 2]] * 20, np.uint8)
    worlds.batch.run(keys)
    assert set(worlds.batch.objects[:, 2]["is_open"].tolist()) <= {0, 1}
    away, back = worlds.measured()[1].tolist()
    assert away < back < 0.0
    assert worlds.measured()[1].min() > -4.0 * 5000


def test_a_search_from_a_run_that_stands_still_finds_switch_and_exit() -> None:
    task = SpanTask(SWITCH_BEHIND, bytes(10), 5, 305, goal="won")
    found = search_span(task, lambda ticks, found: not found and ticks < 10_000_000)
    assert found
    run = Simulation(SWITCH_BEHIND)
    for key in found[0].inputs:
        run.step_keys(key)
    assert run.outcome == "exit"


def test_the_nearest_miss_is_reported_ever_nearer_and_ends_where_it_says() -> None:
    """Nothing comes to the gold in 30 ticks; to the right of the ninja a mine kills what would be nearest to it."""
    level = parse_level("0" * 713 + "|5^100,566!0^400,566!12^150,566")
    task = SpanTask(level, bytes(40), 5, 35, goal="taken(1)")
    misses: list[SpanResult] = []
    assert not searched(task, rounds=8, report_miss=misses.append)
    ends = [each.missed_by for each in misses]
    assert None not in ends
    assert ends == sorted(ends, reverse=True)  # type: ignore[type-var]
    run = Simulation(level)
    for key in misses[-1].inputs:
        run.step_keys(key)
    assert run.outcome == "running"
    assert misses[-1].end[:2] == (run.ninja.x, run.ninja.y)
    assert not any(len(each.path) for each in misses), "a beam does not know it"
    px = 400 - run.ninja.x
    assert score_text(task, misses[-1]) == f"closest: {misses[-1].missed_by - 1:.0f} px after tick {run.tick - 1}"  # type: ignore[operator]
    assert px / 2 < misses[-1].missed_by < 2 * px  # type: ignore[operator]


def test_a_miss_says_which_part_of_the_goal_is_missing_and_how_far_it_is() -> None:
    level = parse_level("0" * 713 + "|5^100,566!0^400,566")
    task = SpanTask(level, bytes(40), 5, 35, goal="x > 90 and taken(1) and (y < 0 or tick > 3)")
    misses: list[SpanResult] = []
    assert not searched(task, rounds=4, report_miss=misses.append)
    missed = misses[-1].missed_by
    assert missed is not None
    assert [*misses[-1].missing] == [f"taken(1): {missed - 1:.0f} px"]
    assert score_text(task, misses[-1]).startswith(f"closest: taken(1): {missed - 1:.0f} px after tick ")
    task = SpanTask(LEVEL, bytes([2] * 20), 0, 20, goal="x < -100 and y < -10000")
    assert not searched(task, rounds=4, report_miss=misses.append)
    x, y = misses[-1].end[:2]
    assert [*misses[-1].missing] == [f"x < -100: {x + 100:.3g} short", f"y < -10000: {10000 + y:.3g} short"]


def test_a_long_beam_reports_again_and_again_and_ends_when_it_is_asked_to(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(methods, "REPORT_TICKS", 20_000)
    task = SpanTask(LEVEL, bytes(MAX_SPAN), 0, MAX_SPAN, goal="x > 10000 and tick > 3000")
    ticks: list[int] = []

    def report(ticks_run: int, _: object) -> bool:
        ticks.append(ticks_run)
        return len(ticks) < 4

    search_span(task, report, method="beam")
    assert all(20_000 <= after - before < 40_000 for before, after in pairwise(ticks[:4]))
    assert ticks[-1] == ticks[3], "no tick more"


def test_the_run_as_it_was_begun_is_no_miss() -> None:
    task = SpanTask(LEVEL, bytes([2] * 20), 0, 20, goal="x > 10000")
    misses: list[SpanResult] = []
    assert not searched(task, rounds=4, report_miss=misses.append)
    assert not misses, "nothing goes farther than the key to the right"


def test_where_only_the_exit_is_missed_it_says_so() -> None:
    task = SpanTask(LEVEL, bytes(60), 0, 30, goal="x > 110", rest=True)
    misses: list[SpanResult] = []
    assert not searched(task, rounds=2, method="local", report_miss=misses.append)
    assert score_text(task, misses[-1]).endswith("but not the exit")


def test_nothing_is_near_to_a_fact_that_is_not_so() -> None:
    misses: list[SpanResult] = []
    assert not searched(SpanTask(LEVEL, bytes(40), 0, 5, goal="dead"), rounds=3, report_miss=misses.append)
    assert not misses


@pytest.mark.parametrize(
    "goal, slot", [("won", 0), ("taken( 2)", 3), ("opened(1)", 2), ("taken(2) and x > 1", None), ("x > 1", None)]
)
def test_a_goal_that_is_about_one_thing_has_a_target(goal: str, slot: int | None) -> None:
    assert target_of(SpanTask(SWITCH_BEHIND, bytes(9), 0, 9, goal=goal)) == slot


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_while_nothing_is_found_the_solver_gets_more_work_and_small_changes_little(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[int] = []
    rounds: list[int] = []

    def change(*arguments: Any) -> None:
        rounds.append(arguments[-1])
        arguments[2].going = len(rounds) < 2

    monkeypatch.setattr(methods, "beam", lambda *_, **__: None)
    monkeypatch.setattr(methods, "change", change)
    monkeypatch.setattr(Search, "run_leg", lambda _, budget, *__, **___: asked.append(budget))
    search_span(SpanTask(SWITCH_BEHIND, bytes(10), 5, 305, goal="won"), lambda *_: True)
    assert (max(asked[:6]), max(asked[6:])) == (2_000_000, 4_000_000)
    search_span(SpanTask(SWITCH_BEHIND, bytes(10), 5, 305, goal="x > 900"), lambda *_: True)
    assert rounds == [methods.ROUNDS_BESIDE_LEGS] * 2 + [methods.ROUNDS]


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@pytest.mark.parametrize("goal, last", [("won", 205), ("taken(2)", 130), ("opened(1)", 60), ("opened(3)", 140)])
def test_the_solver_leads_to_the_target_past_other_things(goal: str, last: int) -> None:
    """The switch and a piece of gold lie on its way, and do not end it."""
    things = "5^400,566!11^500,564,300,564!0^600,566!9^640,560,1,0,22,19,1,0,0!0^450,566"
    level = parse_level("0" * 713 + "|" + things)
    task = SpanTask(level, bytes(10), 5, last, goal=goal)
    target = target_of(task)
    assert target is not None
    found = LegSearch(task, target, seed=1).search(lambda _: False)
    assert found
    worlds = SpanWorlds(task, len(found))
    assert (worlds.try_all(np.stack(found, axis=1)).ticks > 0).all()
    assert not LegSearch(replace(task, last=9), target, seed=1).search(lambda _: False)
    asked: list[int] = []

    def over(ticks: int) -> bool:
        asked.append(ticks)
        return True

    assert not LegSearch(replace(task, last=9), target, seed=1).search(over)
    assert len(asked) <= 2, "no other search is begun"
