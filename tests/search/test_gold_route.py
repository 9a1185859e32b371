"""All gold of a level, in an order that leaves a way to the rest and to the exit."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from zlib import crc32

import numpy as np
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.formats.load import parse_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import Level

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from ninja_game.search import gold_beam
from ninja_game.search.best_first import OTHER_ENDS
from ninja_game.search.certificate import verified_run
from ninja_game.search.gold_beam import GoldBeam
from ninja_game.search.heuristics import Heuristics
from ninja_game.search.legs import UNBOUNDED, Checkpoint, Frontier, Leg
from ninja_game.search.local_search import LocalSearch
from ninja_game.search.nodes import Resolution, open_start
from ninja_game.search.route import ROUTE_LEGS, Route
from ninja_game.search.searching import Search
from ninja_game.search.solve import solve
from ninja_game.search.task import COOLING, FIRST_RUN_SEARCHES, OTHER_ROUTES, Progress, Task, obstacle
from tests.support.recorded import hold_against

SEARCHES = Path(__file__).parent.parent / "golden" / "searches.txt"

COLUMN = 23
FLOOR = 566

LINES = parse_level_string(
    "0" * 713
    + "|5^396,566!11^700,564,100,564!"
    + "!".join(f"0^{x},{y}" for x in (60, 72, 84, 690, 702, 714) for y in (520, 560))
    + "!"
    + "!".join(f"0^{x},500" for x in range(300, 492, 24))
)
"""Twenty pieces in three groups: both ends of the floor, and a line in the air between them."""

PIT = parse_level_string(
    ("0" * (COLUMN - 5) + "11111") * 20
    + ("0" * COLUMN) * 3
    + ("0" * (COLUMN - 5) + "11111") * 8
    + "|5^36,446!11^504,564,540,564!0^530,500!0^700,440!0^740,440!0^200,440"
)
"""A pit that nobody leaves, with the switch, the exit and a piece of gold; more gold on both of its sides."""

BEHIND_A_DOOR = parse_level_string(
    ("0" * 10 + "1" * 12 + "0") * 10
    + "0" * COLUMN * 21
    + "|5^60,566!11^100,566,130,566!9^36,566,0,0,10,23,1,0,0!0^400,566!0^200,566"
)
"""Gold on both sides of a locked door, the switch behind the ninja, the exit near it."""

KEY_AT_THE_LEFT = parse_level_string(
    ("0" * 10 + "1" * 12 + "0") * 10
    + "0" * COLUMN * 21
    + "|5^130,566!11^400,566,160,566!9^36,566,0,0,10,23,1,0,0!0^100,566!0^80,566"
)
"""A locked door between the ninja and the exit, its switch at the left end of a low corridor, gold on the way."""

ONE_WAY = parse_level_string(
    ("1" * (COLUMN - 2) + "00") * 31
    + "|5^300,566!11^700,566,60,566!7^396,540,0!7^396,564,0!0^340,566!0^600,566!0^640,566"
)
"""A corridor that is passed to the right only, by one-way platforms; the exit's switch is at its left end."""

KEY_AT_THE_RIGHT = parse_level_string(
    ("0" * 10 + "1" * 12 + "0") * 10 + "0" * COLUMN * 21 + "|5^400,566!11^60,566,430,566!9^750,566,0,0,10,23,1,0,0"
)
"""The exit in a low corridor, closed by a locked door; the exit's switch on the way from the ninja to the door's."""

WALLED_IN = parse_level_string(
    "0" * COLUMN * 20 + "1" * COLUMN + "0" * COLUMN * 10 + "|5^60,566!11^400,566,330,566!0^200,566!0^700,300"
)
"""A piece of gold behind a wall from top to bottom."""


TWO_KEYS = parse_level_string(
    "0" * 713 + "|5^100,566!11^36,36,60,36!9^160,566,0,0,3,1,1,0,0!9^500,566,0,0,4,1,1,0,0!0^130,36"
)
"""The switches of two locked doors on the floor, the near one on the way to the far one."""


def all_gold(level: Level) -> int:
    """How much gold a level holds."""
    return sum(record.kind == GOLD for record in level.objects)


@pytest.mark.parametrize("level", [LINES, PIT, BEHIND_A_DOOR, ONE_WAY], ids=["lines", "pit", "door", "one-way"])
def test_all_gold_is_collected_before_the_exit(level: Level) -> None:
    run = solve(Task(level, gold=-1, work=3_000_000))
    assert run is not None
    assert verified_run(level, run.inputs, gold=all_gold(level)).gold == all_gold(level)


def test_a_part_of_the_gold_will_do_where_that_is_asked_for() -> None:
    run = solve(Task(LINES, gold=5, work=2_000_000))
    assert run is not None
    assert verified_run(LINES, run.inputs, gold=5).gold >= 5


def test_a_front_keeps_the_earliest_moments_and_one_of_each_state_of_the_enemies() -> None:
    frontier = Frontier(0, 0)
    for tick in (5, 3, 9, 1, 7):
        routines = b"in flight" if tick == 9 else b"waiting"
        frontier.add(Checkpoint(np.zeros(1, np.int64), tick, 0, 0, (0.0, 0.0), routines), 3)
    assert [checkpoint.tick for checkpoint in frontier.checkpoints] == [1, 3, 9]


def test_doors_are_opened_one_by_one_also_when_the_exit_is_open() -> None:
    """The exit's switch is beside the ninja, the door's at the left end, the exit behind the door at the right."""
    start = open_start(KEY_AT_THE_LEFT, box=False)
    heuristics = Heuristics(start.maps, start.worlds)
    assert [heuristics.may_leave(mask, 130.0, 566.0) for mask in (0, 1, 2, 3)] == [False, False, False, True]
    route = Route(Search(start, heuristics, nodes=50_000), gold=0, seed=1)
    runs = [route.step(lambda _: False) for _ in range(4)]
    assert any(runs)
    assert {mask for _, mask in route.frontiers} >= {1, 3}


def test_a_piece_from_which_no_way_leads_to_others_comes_last() -> None:
    start = open_start(ONE_WAY, box=False)
    route = Route(Search(start, Heuristics(start.maps, start.worlds), nodes=50_000), gold=3, seed=1)
    route.urgency[1] = 1.0
    assert route._target(next(iter(route.frontiers.values()))) == 0


def test_a_leg_to_a_certain_switch_does_not_end_at_another_on_the_way() -> None:
    start = open_start(TWO_KEYS, box=False)
    heuristics = Heuristics(start.maps, start.worlds)
    far = next(1 << bit for bit, switch in enumerate(heuristics.switches) if switch.switch_x == 500.0)
    search = Search(start, heuristics, nodes=50_000)
    root = search.checkpoint(None, b"")

    def ends(wanted: int) -> list[int]:
        field = partial(heuristics.field_to, (500.0, 566.0))
        leg = Leg([root], UNBOUNDED, 0, UNBOUNDED, 4, 0, field, wanted)
        search.begin_leg(leg, Resolution(), seed=1, bound=0)
        search.run_leg(300_000, lambda _: False, part=1_000)
        return [end.mask & far for end in search.ends()]

    assert not any(ends(wanted=0))
    found = ends(wanted=far)
    assert found.count(far) >= 4
    assert found.count(0) <= OTHER_ENDS


def test_a_frontier_is_searched_finer_and_finer(monkeypatch: pytest.MonkeyPatch) -> None:
    start = open_start(PIT, box=False)
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=50_000)
    begun: list[Resolution] = []
    monkeypatch.setattr(search, "begin_leg", lambda _, resolution, **__: begun.append(resolution))
    monkeypatch.setattr(search, "run_leg", lambda *_, **__: None)
    monkeypatch.setattr(search, "ends", list)
    route = Route(search, gold=1, seed=1)
    for _ in range(8):
        route.step(lambda _: False)
    resolutions = [resolution for resolution, _ in ROUTE_LEGS]
    assert begun == [*resolutions, *resolutions[-1:] * 2]


def test_the_exit_is_opened_last() -> None:
    """A frontier with an open exit to which there is no way is searched later than the one with a closed exit."""
    start = open_start(KEY_AT_THE_RIGHT, box=False)
    route = Route(Search(start, Heuristics(start.maps, start.worlds), nodes=50_000), gold=0, seed=1)
    for _ in range(2):
        assert not route.step(lambda _: False)
    assert [route.frontiers[0, mask].tries for mask in (0, 1)] == [2, 0]


def test_gold_that_was_never_collected_is_reported() -> None:
    progress: list[Progress] = []
    assert solve(Task(WALLED_IN, gold=-1, work=2_000_000), report=progress.append) is None
    assert (progress[-1].gold, progress[-1].untaken) == (1, (3,))
    why = obstacle(WALLED_IN, WALLED_IN.gold, progress[-1])
    assert why.sentence == "1 at most were collected at once, never gold at 29,12 (700,300px, object 3)"
    assert [WALLED_IN.objects[number].kind for number in why.records] == [GOLD]
    both = tuple(number for number, spec in enumerate(WALLED_IN.objects) if spec.kind == GOLD)
    several = obstacle(WALLED_IN, WALLED_IN.gold, replace(progress[-1], gold=0, untaken=both))
    assert several.sentence == (
        "0 at most were collected at once, never "
        "gold at 8,23 (200,566px, object 2), gold at 29,12 (700,300px, object 3)"
    )
    assert several.records == both
    every = obstacle(WALLED_IN, WALLED_IN.gold, replace(progress[-1], untaken=()))
    assert every.sentence == "1 at most were collected at once, each piece now and then"
    assert [WALLED_IN.objects[number].kind for number in every.records] == [GOLD, GOLD]


_PIT = ".........#..#"
IN_A_PIT = {19: ".........#vv#", **dict.fromkeys((20, 21, 22), _PIT), 23: "..@.o....#o.#....x.X"}
"""One-way platforms lead down to gold, from which no way leads back."""


def test_gold_from_which_no_way_leads_on_is_reported() -> None:
    picture = [f"|{IN_A_PIT.get(row, ''):.<31}|" for row in range(1, 24)]
    level = parse_level("\n".join(["ninja-game level 1", *picture]))
    assert solve(Task(level, work=2_000_000))
    progress: list[Progress] = []
    assert solve(Task(level, gold=-1, work=2_000_000), report=progress.append) is None
    why = obstacle(level, level.gold, progress[-1])
    assert why.sentence.startswith("gold at 11,23 (object 4): the last gold of all: no way from there"), why
    assert [level.objects[number].values[:2] for number in why.records] == [(276.0, 564.0)]
    many = obstacle(level, level.gold, replace(progress[-1], last=(4, 5, 4, 5)))
    assert many.names.endswith(" and 1 more")


UNTOUCHED, UNREACHED = "the solver never touched its switch", "the solver never reached it, although it was open"
FAR_SWITCH = {3: "." * 27 + "x", 23: "..@............X"}
FAR_EXIT = {3: "." * 27 + "X", 23: "..@........x"}
WALLED = "." * 19 + "#"
BEHIND_A_LOCK = {
    **dict.fromkeys(range(1, 23), WALLED), 9: "........###........#", 10: "........#&#........#",
    11: "........###........#", 23: "..@......................x.X",
}  # fmt: skip


@pytest.mark.parametrize(
    "rows, lines, reason",
    [
        (FAR_SWITCH, "", f"exit at 16,23 (object 1): {UNTOUCHED}"),
        (FAR_EXIT, "", f"exit at 28,3 (object 1): {UNREACHED}"),
        (
            BEHIND_A_LOCK, "locked door 20,23 left switch 10,10",
            f"exit at 28,23 (object 1), locked door at 20,23 (object 2): {UNTOUCHED}",
        ),
    ],
)  # fmt: skip
def test_what_keeps_a_run_from_the_exit_is_reported(rows: dict[int, str], lines: str, reason: str) -> None:
    picture = [f"|{rows.get(row, ''):.<31}|" for row in range(1, 24)]
    level = parse_level("\n".join(["ninja-game level 1", *picture, lines]))
    progress: list[Progress] = []
    assert solve(Task(level, work=2_000_000), report=progress.append) is None
    assert obstacle(level, 0, progress[-1]).sentence == reason


def test_a_run_may_go_from_switch_to_switch_without_gold() -> None:
    start = open_start(BEHIND_A_DOOR, box=False)
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=50_000)
    route = Route(search, gold=0, seed=1)
    runs = [route.step(lambda _: False) for _ in range(8)]
    assert verified_run(BEHIND_A_DOOR, next(filter(None, runs))).end_tick > 0
    assert len({mask for _, mask in route.frontiers}) > 1


@pytest.fixture(scope="module")
def first() -> Replay:
    """The first run with all gold of LINES that comes."""
    run = solve(Task(LINES, gold=-1, work=20_000_000, first_only=True))
    assert run
    return run


def beam_of(first: Replay) -> GoldBeam:
    """A beam search from a run of LINES."""
    start = open_start(LINES, box=False)
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=50_000)
    return GoldBeam(search, first.inputs, seed=1)


def test_a_run_with_gold_in_a_bad_order_gets_much_shorter(first: Replay) -> None:
    beam = beam_of(first)
    runs = [beam.search_depths(lambda _: False) for _ in range(4)]
    best = min(filter(None, runs), key=len)
    assert len(best) == beam.ticks
    assert verified_run(LINES, best, gold=all_gold(LINES)).end_tick < 0.85 * first.end_tick


def test_a_beam_keeps_checkpoints_of_different_velocities(first: Replay) -> None:
    """No enemy is there: only the velocities differ."""
    beam = beam_of(first)
    beam.search_depths(lambda _: False)
    frontiers = [frontier for frontiers in beam.depths.values() for frontier in frontiers.values()]
    assert max(len({checkpoint.variety for checkpoint in frontier.checkpoints}) for frontier in frontiers) > 5


def test_a_leg_that_finds_nothing_gets_more_work(first: Replay, monkeypatch: pytest.MonkeyPatch) -> None:
    """Legs of one tick find nothing; only because they are tried again does the run get shorter."""
    monkeypatch.setattr(gold_beam, "BEAM_TICKS", 1)
    monkeypatch.setattr(gold_beam, "EFFORTS", (1, 150_000))
    monkeypatch.setattr(gold_beam, "EXIT_FACTOR", 1_500_000)
    beam = beam_of(first)
    assert any(beam.search_depths(lambda _: False) for _ in range(4))


def test_shortening_a_run_with_gold_keeps_the_gold_and_is_the_same_every_time() -> None:
    first = solve(Task(BEHIND_A_DOOR, gold=-1, work=20_000_000, first_only=True))
    assert first
    task = Task(BEHIND_A_DOOR, gold=-1, first=first.inputs, work=2_000_000)
    better, again = solve(task), solve(task)
    assert better
    assert again
    assert better.inputs == again.inputs
    assert (better.gold, better.end_tick <= first.end_tick) == (all_gold(BEHIND_A_DOOR), True)


def test_a_search_forgets_those_before_it() -> None:
    """Also one that is guided, and so gets the table of the search before the last."""
    start = open_start(LINES, box=False)

    def searched(search: Search, seed: int, *, backed_up: bool = False) -> tuple[object, ...]:
        search.begin(Resolution(), seed=seed, bound=0, backed_up=backed_up)
        search.run(30_000)
        return search.best(), search.ticks, int(search.counters.entries)

    new, used = (Search(start, Heuristics(start.maps, start.worlds), nodes=50_000) for _ in range(2))
    for search in (new, used):
        searched(search, 1)  # makes the fields
    for seed in (4, 5):
        searched(used, seed, backed_up=True)
    assert [searched(new, seed, backed_up=seed == 3) for seed in (2, 3)] == [
        searched(used, seed, backed_up=seed == 3) for seed in (2, 3)
    ]


def lines_of_searches(first: Replay) -> Iterator[str]:
    """What searches with a seed did: each number depends on nearly every choice before it."""

    def state(search: Search) -> str:
        counters, best = search.counters, search.best() or b""
        return f"{search.ticks} ticks, {counters.entries} entries, run of {len(best)}: {crc32(best):08x}"

    start = open_start(LINES, box=False)
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=50_000)
    for number, resolution in enumerate((*(one for one, _ in FIRST_RUN_SEARCHES), *OTHER_ROUTES)):
        search.begin(resolution, seed=1, bound=0, backed_up=number > 0)
        search.run(60_000)
        yield f"search {number}: {state(search)}"
    for name, level in (("lines", LINES), ("pit", PIT), ("one-way", ONE_WAY), ("two keys", TWO_KEYS)):
        start = open_start(level, box=False)
        for gold in {0, level.gold}:
            search = Search(start, Heuristics(start.maps, start.worlds), nodes=50_000)
            route = Route(search, gold=gold, seed=1)
            for number in range(5):
                route.step(lambda _: False)
                yield f"{name}, gold {gold}, leg {number}: {state(search)}"
    beam = beam_of(first)
    for number in range(3):
        run = beam.search_depths(lambda _: False) or b""
        yield f"beam {number}: {state(beam.search)}, {beam.legs} legs, shorter run of {len(run)}: {crc32(run):08x}"
    local = LocalSearch(open_start(LINES, box=False), first.inputs, gold=LINES.gold, seed=1)
    for temperature in COOLING:
        local.run(60_000, temperature=temperature)
        yield f"local {temperature}: {local.played} ticks, run of {local.ticks}: {crc32(local.best()):08x}"


def test_searches_go_as_they_went(first: Replay) -> None:
    hold_against(SEARCHES, [*lines_of_searches(first)])
