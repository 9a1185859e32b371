"""Searches along a known run: what is like it, what is behind it, and spans of it that get shorter."""

from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch
from zlib import crc32

import numpy as np
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.backend.plain import PlainWorlds
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.level import Level

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from ninja_game.runs.run import run_level
from ninja_game.search.certificate import verified_run
from ninja_game.search.formula.leg import OtherRoutes
from ninja_game.search.formula.methods import search_span
from ninja_game.search.formula.task import SpanTask
from ninja_game.search.heuristics import UNREACHED, Heuristics
from ninja_game.search.known_run import nearest_row
from ninja_game.search.nodes import Resolution, open_start
from ninja_game.search.spans import RunShortener, SpanSearches, SpanSettings, draw_settings
from tests.support.recorded import hold_against

LEVEL = parse_level_string("0" * 713 + "|5^100,566!11^700,564,300,564!0^200,566")
"""Right over a piece of gold and the switch to the exit."""
STANDING = bytes([2] * 20 + [0] * 30 + [2] * 220)  # stops on the way: a span of it can be better
FINENESS = SpanSettings(Resolution(cell=4.0, speed=0.35, macro=3, jitter=5), 8.0, 64.0, 0.9, 2.0)


def searches(inputs: bytes = STANDING, *, gold: int = 0, level: Level = LEVEL) -> SpanSearches:
    start = open_start(level, box=False)
    made = SpanSearches(start, Heuristics(start.maps, start.worlds), gold=gold)
    made.follow(verified_run(level, inputs).inputs)
    return made


def never(_: int) -> bool:
    return False


def test_a_moment_of_the_run_is_noted_and_is_most_like_itself() -> None:
    run = searches(bytes([2] * 300)).run._replace(place_price=1.2, speed_price=8.0)
    memory, ticks = PlainWorlds([LEVEL], box=False), len(run.keys)
    for tick in range(ticks):
        w = memory.world()
        n = w.ninja
        assert run.moves[tick].tolist() == [n.x, n.y, n.x - n.prev_x, n.y - n.prev_y]
        assert nearest_row(run, w, int(run.masks[tick])) == (tick, float(ticks - tick))
        assert nearest_row(run, w, 1 - int(run.masks[tick]))[1] > ticks - tick
        memory.step(int(run.keys[tick]))
    assert (run.masks[0], run.masks[-1]) == (0, 1)


def test_what_lacks_gold_or_is_far_from_the_run_is_not_like_it() -> None:
    with_gold, without = searches(gold=1), searches()
    w = PlainWorlds([LEVEL], box=False).world()
    w.tick = 100
    w.ninja.x = float(with_gold.run.moves[100][0])
    assert nearest_row(with_gold.run, w, 0) == (-1, UNREACHED)
    assert nearest_row(without.run, w, 0)[0] > 0
    w.ninja.y -= 200
    assert nearest_row(without.run, w, 0) == (-1, UNREACHED)


def test_a_span_gets_shorter_and_the_rest_is_joined_to_it() -> None:
    known = searches()
    before = verified_run(LEVEL, STANDING)
    found = known.search(10, 60, FINENESS, seed=1, ticks=2_000_000, spend=never)
    assert found is not None
    after = verified_run(LEVEL, found)
    assert after.end_tick < before.end_tick
    assert found[:10] == before.inputs[:10]
    assert after.inputs == found


def test_a_run_of_ten_minutes_is_searched_too() -> None:
    """Longer than there are rows in an action, and than there are buckets."""
    long = bytes([0] * 33_000) + STANDING
    known = searches(long)
    for first in (32_990, 33_010):
        found = known.search(first, first + 50, FINENESS, seed=1, ticks=1_000_000, spend=never)
        assert found is not None
        assert found[:first] == long[:first]
        assert verified_run(LEVEL, found).end_tick < verified_run(LEVEL, long).end_tick - 10


def test_nothing_is_found_in_a_span_that_cannot_be_better() -> None:
    assert searches(bytes([2] * 300)).search(100, 140, FINENESS, seed=1, ticks=300_000, spend=never) is None


def lines_of_searches() -> Iterator[str]:
    """What searches along a run did: it depends on nearly every choice."""
    random = np.random.default_rng(1)
    for number in range(8):
        made = searches(gold=number % 2)
        run = made.search(10 + number, 60, draw_settings(random), seed=5, ticks=100_000, spend=never) or b""
        counters = made._search.counters
        yield f"span {number}: {counters.ticks} ticks, {counters.entries} entries, run of {len(run)}: {crc32(run):08x}"


def test_searches_go_as_they_went_and_work_ends_when_it_is_over() -> None:
    hold_against(Path(__file__).parent.parent / "golden" / "span-searches.txt", [*lines_of_searches()])
    assert searches().shorter(STANDING, seed=1, spend=lambda _: True) is None


@pytest.mark.parametrize("gold", [0, 1])
def test_the_shortener_submits_ever_shorter_runs_with_their_gold(gold: int) -> None:
    start = open_start(LEVEL, box=False)
    submitted: list[bytes] = []
    spent = 0

    def spend(_: int, cost: float) -> bool:
        nonlocal spent
        spent += int(cost)
        return spent > 3_000_000

    heuristics = Heuristics(start.maps, start.worlds)
    shortener = RunShortener(start, heuristics, gold=gold, seed=1, submit=submitted.append, spend=spend)
    best = shortener.search_spans(verified_run(LEVEL, STANDING).inputs, 2_000_000)
    assert len(best) == len(submitted[-1])
    ticks = [verified_run(LEVEL, run, gold=gold).end_tick for run in submitted]
    assert ticks == sorted(set(ticks), reverse=True)
    assert ticks[-1] < verified_run(LEVEL, STANDING).end_tick - 20


def test_a_way_to_the_exit_is_found_along_a_run_beside() -> None:
    """Runs that do not reach the exit are left out; the result is not of the own route."""
    task = SpanTask(LEVEL, STANDING, 15, len(STANDING), "won", others=(bytes(80), bytes([2] * 240)))
    routes, own = OtherRoutes(task, seed=1), verified_run(LEVEL, STANDING).ticks
    keys = next(keys for keys in (routes.search(never) for _ in range(20)) if keys)[0].tobytes()
    assert run_level(LEVEL, STANDING[:15] + keys).outcome == "exit"
    assert run_level(LEVEL, STANDING[:15] + keys).ticks < own - 20
    results = search_span(task, lambda _, ways: all(way.own_route for way in ways))
    assert any(not way.own_route and way.ticks < own - 35 for way in results)
    right = bytes([2] * 240)
    routes = OtherRoutes(SpanTask(LEVEL, right[:30] + STANDING, 30, 90, "won", others=(right,)), seed=1)
    with patch.object(routes._searches, "search", return_value=None) as search:
        routes.search(never)
    assert search.call_args.args[:2] == (30, verified_run(LEVEL, right).ticks), "to where the run beside has won"
