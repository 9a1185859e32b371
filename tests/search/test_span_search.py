"""A span search in the background: live results, the end, what goes wrong."""

import inspect
import sys
import time
from collections.abc import Callable
from threading import Event, Thread
from time import process_time, thread_time
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from ninja_game import ArgumentError, Simulation, parse_level
from ninja_game.backend.memories import compiled_available
from ninja_game.runs.run import record_replay
from ninja_game.search import solve as solve_module
from ninja_game.search.formula import background
from ninja_game.search.formula.background import RunSearch, SpanSearch
from ninja_game.search.formula.language import FormulaError
from ninja_game.search.formula.task import SpanResult, SpanTask
from ninja_game.search.task import Task
from tests.support.waiting import LONGEST

LEVEL = parse_level("0" * 713 + "|5^100,566!11^200,564,170,564!0^140,566!12^400,400")
WAITING = bytes([0] * 6 + [2] * 60)  # stands for six ticks, then runs over gold and switch into the exit


def task(**changes: object) -> SpanTask:
    given: dict[str, Any] = {"first": 0, "last": 30, "goal": "x > 130", **changes}
    return SpanTask(LEVEL, WAITING, **given)


def until_found(search: SpanSearch) -> SpanResult:
    deadline = time.monotonic() + LONGEST
    while not search.results:
        assert time.monotonic() < deadline
        assert not search.done, search.problem
        time.sleep(0.005)
    return search.results[0]


def test_results_show_while_it_goes_on_and_stay_after_the_end() -> None:
    search = SpanSearch(task())
    assert (search.results, search.done, search.seconds) == ((), False, 0.0)
    search.start()
    first = until_found(search)
    before = search.done
    run = Simulation(LEVEL)
    for keys in first.inputs:
        run.step_keys(keys)
    assert run.ninja.x > 130
    assert search.ticks_run > 0
    search.cancel()
    search.finish(LONGEST)
    assert (before, search.done) == (False, True)
    assert search.results[0] <= first
    assert list(search.results) == sorted(search.results)
    assert search.problem == ""
    assert search.seconds > 0


def test_it_ends_by_itself_after_its_time_or_when_all_is_tried() -> None:
    timed = SpanSearch(task(), seconds=0.05)
    untimed = SpanSearch(task(last=12, goal=""), "exhaustive", every=12)
    for search in (timed, untimed):
        search.start()
        search.start()
        search.finish(LONGEST)
        assert (search.done, search.problem) == (True, "")
    assert timed.seconds >= 0.05
    assert [result.ticks for result in untimed.results] == [12], "nobody ended it, and it has no limit"


def test_what_cannot_be_searched_is_said() -> None:
    with pytest.raises(FormulaError):
        SpanSearch(task(goal="x >"))
    with pytest.raises(ArgumentError, match="expected 'auto', 'local'"):
        SpanSearch(task(), "magic")
    with pytest.raises(ArgumentError, match="object 1 is of kind exit"):
        SpanSearch(task(goal="taken(1)"))
    for search in (SpanSearch(task(first=60, last=70)), SpanSearch(task(), "exhaustive")):
        search.start()
        search.finish(LONGEST)
        assert search.done
        assert search.problem
        assert not search.results


def test_it_is_over_at_once_where_it_is_cancelled_while_kernels_are_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    compiled, asked = Event(), Event()

    def slow(_: SpanTask, report: Callable[[int, tuple[SpanResult, ...]], bool], **__: object) -> None:
        assert compiled.wait(60.0)
        assert not report(1, (SpanResult(1.0, 1, np.zeros(1, np.uint8)),))
        asked.set()

    monkeypatch.setattr(background, "search_span", slow)
    search = SpanSearch(task())
    search.start()
    before = search.done
    search.cancel()
    assert (before, search.done) == (False, True)
    search.finish(60.0)
    compiled.set()
    assert asked.wait(60.0)
    assert (search.results, search.ticks_run, search.seconds) == ((), 0, 0.0)


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_the_interpreter_is_free_for_a_window_meanwhile() -> None:
    """The search works on while this thread keeps the interpreter for itself, as a window does that draws."""
    search = SpanSearch(task(last=60), jobs=1)
    search.start()
    until_found(search)
    interval, worked, deadline = sys.getswitchinterval(), 0.0, time.monotonic() + 120
    sys.setswitchinterval(1.0)  # nothing takes the interpreter away from this thread meanwhile
    try:
        while worked < 0.02:
            assert time.monotonic() < deadline, worked
            time.sleep(0.001)
            before, end = process_time() - thread_time(), thread_time() + 0.003
            while thread_time() < end:
                pass
            worked += process_time() - thread_time() - before
    finally:
        sys.setswitchinterval(interval)
        search.cancel()
        search.finish(LONGEST)


def test_what_a_run_gains_by_its_own_route_stays_beside_faster_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two searches: of the run alone, and with those beside it that reach the exit."""
    slow, fast = bytes(40) + WAITING, WAITING[6:]
    asked: list[tuple[bytes, tuple[bytes, ...]]] = []

    def solve(wanted: Task, *, on_better: Callable[..., None], **_: object) -> None:
        asked.append((wanted.first, wanted.others))
        shortened = wanted.first[20:] if not wanted.others else wanted.others[0]
        for keys in (wanted.first, shortened):
            on_better(record_replay(LEVEL, keys))

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    dead_end = bytes(30)
    search = RunSearch(SpanTask(LEVEL, slow, 0, len(slow), "won", others=(dead_end, fast)))
    search.start()
    search.finish(LONGEST)
    assert not search.problem
    assert sorted(asked) == sorted([(slow, ()), (slow, (fast,))])
    assert search.own is not None
    best, second = search.results
    assert (best.own_route, second.own_route) == (False, True)
    assert (search.own.ticks - best.ticks, search.own.ticks - second.ticks) == (46, 20)


def test_results_that_are_no_longer_shown_are_forgotten() -> None:
    search = SpanSearch(task())
    one, two = (SpanResult(1.0, 60, np.full(60, keys, np.uint8), bytes([keys]) * 60) for keys in (2, 3))
    assert search._without_idle_keys((one, two), 60.0) != ()
    search._without_idle_keys((two,), 60.0)
    assert list(search._tidy) == [two.inputs]


def test_the_solver_is_compiled_once_however_many_searches_start() -> None:
    # In a copy of the module: a search of an earlier test may still compile in the one that all share.
    copied = ModuleType(solve_module.__name__)
    exec(inspect.getsource(solve_module), vars(copied))
    begun, go_on = [], Event()

    class Slow:
        def __init__(self, *_: object) -> None:
            begun.append(self)

        def compile(self) -> None:
            go_on.wait(60.0)

    vars(copied)["_Job"] = Slow
    threads = [Thread(target=copied.compile_solver) for _ in range(2)]
    for thread in threads:
        thread.start()
    while not begun:
        time.sleep(0.001)
    time.sleep(0.02)
    go_on.set()
    for thread in threads:
        thread.join()
    assert len(begun) == 2, "one for a way to the exit, one with all gold"
