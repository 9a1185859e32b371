"""The solver's parts: macros, distance fields, switch states, mutations."""

import numpy as np
import pytest

from ninja_game.backend.memories import compiled, compiled_available
from ninja_game.batch.batch import Batch
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.kinds import DOOR, EXIT
from ninja_game.sim.level import Level

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from ninja_game.backend.plain import PlainWorlds
from ninja_game.search.certificate import verified_run
from ninja_game.search.heuristics import POINTS, UNREACHED, Heuristics, open_mask, open_masks, point_at
from ninja_game.search.legs import short_tour
from ninja_game.search.local_search import (
    LocalCounters,
    LocalSearch,
    cut,
    mutate,
    overwrite,
    score_of,
    shift_boundary,
    shift_pulse,
    stretch,
    try_run,
)
from ninja_game.search.macros import PRESSED, PRESSED_AGAIN, RELEASED, action_code, action_inputs
from ninja_game.search.nodes import (
    CHUNK,
    Link,
    Resolution,
    TableEntry,
    back_up_values,
    clear,
    keep_state,
    load_state,
    new_arrays,
    open_start,
    ticks_at_once,
    zeroed,
)
from ninja_game.search.searching import Search
from ninja_game.search.states import state_key, switch_state_of
from ninja_game.sim.inputs import KEY_RIGHT, with_press_bits
from tests.support.heavy import heavy_level
from tests.support.own_fields import own_fields_only

OPEN = "0" * 713 + "|"
CORRIDOR = ("0" * 10 + "1" * 12 + "0") * 10 + "0" * 23 * 21


def heuristics_of(text: str) -> Heuristics:
    """The distance fields of a level."""
    level: Level = parse_level_string(text)
    start = open_start(level, box=False)
    return Heuristics(start.maps, start.worlds)


@pytest.mark.parametrize(
    "direction, mode, held, inputs",
    [
        (1, RELEASED, 1, [2, 2, 2]),
        (-1, PRESSED, 0, [13, 5, 5]),
        (0, PRESSED, 1, [4, 4, 4]),
        (1, PRESSED_AGAIN, 1, [2, 14, 6]),
    ],
)
def test_an_action_says_its_inputs(direction: int, mode: int, held: int, inputs: list[int]) -> None:
    assert action_inputs(action_code(direction, mode, held, 3)) == bytes(inputs)


def test_triggers_are_put_where_the_key_goes_down() -> None:
    assert with_press_bits(b"\x04\x0c\x00\x06\x06") == b"\x0c\x04\x00\x0e\x06"


def test_the_field_leads_to_the_switch_and_then_to_the_exit() -> None:
    heuristics = heuristics_of(OPEN + "5^100,300!11^700,300,400,300")
    before, after = heuristics.field(0, 100.0, 300.0), heuristics.field(1, 400.0, 300.0)
    assert before[point_at(100, 300)] > before[point_at(250, 300)] > before[point_at(400, 300)] > 0
    assert after[point_at(400, 300)] > after[point_at(700, 300)] == 0


def test_a_wall_is_walked_around() -> None:
    walled = "0" * 23 * 10 + "0" + "1" * 22 + "0" * 23 * 20 + "|5^100,300!11^700,300,400,300"
    here = point_at(200, 500)
    assert (
        heuristics_of(walled).field(0, 100.0, 300.0)[here]
        > heuristics_of(OPEN + walled.split("|")[1]).field(0, 0, 0)[here]
    )


def test_a_locked_door_sends_to_its_switch_first() -> None:
    heuristics = heuristics_of(CORRIDOR + "|5^200,566!11^400,566,330,566!9^60,566,0,0,10,23,1,0,0")
    closed, opened = heuristics.field(0, 200.0, 566.0), heuristics.field(0b10, 60.0, 566.0)
    assert closed[point_at(60, 566)] < closed[point_at(200, 566)] < UNREACHED
    assert opened[point_at(200, 566)] < opened[point_at(60, 566)]


def test_what_is_open_is_read_from_the_fields_that_exits_and_doors_have() -> None:
    text = (
        "0" * 713
        + "|5^100,566!11^700,300,140,566!11^600,300,400,300!9^160,566,0,0,10,23,1,0,0!9^220,566,0,1,10,23,0,0,0"
    )
    world = PlainWorlds([parse_level_string(text)], box=False)
    heuristics = heuristics_of(text)
    with own_fields_only():
        assert open_mask(world.world(), heuristics.slots) == 0
    with own_fields_only():
        for _ in range(60):
            world.step(KEY_RIGHT)
        seen = open_mask(world.world(), heuristics.slots)
    # The first exit's switch, the locked door and the trap door were run through, in the order of Heuristics.switches.
    assert seen == 0b1101


def test_a_one_way_platform_is_passed_from_its_back_only() -> None:
    """Columns 10 are full but for one cell, which a platform that faces left closes from the left."""
    wall = "0" * 23 * 10 + "1" * 22 + "0" + "0" * 23 * 20
    forward = heuristics_of(wall + "|5^60,566!11^700,566,600,566!7^276,564,2").field(0, 60.0, 566.0)
    backward = heuristics_of(wall + "|5^60,566!11^700,566,600,566!7^276,564,0").field(0, 60.0, 566.0)
    assert forward[point_at(60, 566)] >= UNREACHED
    assert backward[point_at(60, 566)] < UNREACHED


def keys_of(*keys: int) -> np.ndarray[tuple[int], np.dtype[np.uint8]]:
    """Inputs to edit."""
    return np.array(keys, np.uint8)


def test_cutting_and_stretching_move_what_follows() -> None:
    keys = keys_of(0, 1, 2, 3, 4)
    cut(keys, 5, 1, 2)
    assert keys.tolist() == [0, 3, 4, 4, 4]
    keys = keys_of(0, 1, 2, 3, 4)
    stretch(keys, 5, 1, 2)
    assert keys.tolist() == [0, 1, 1, 1, 2]


def test_boundaries_and_jumps_are_moved() -> None:
    keys = keys_of(1, 1, 2, 2, 2)
    assert shift_boundary(keys, 5, 0, 3, 1) == 2
    assert keys.tolist() == [1, 1, 1, 2, 2]
    keys = keys_of(1, 5, 5, 1, 1)
    assert shift_pulse(keys, 5, 0, 2) == 1
    assert keys.tolist() == [1, 1, 1, 5, 5]


def test_overwriting_stays_within_the_run() -> None:
    keys = keys_of(1, 1, 1)
    overwrite(keys, 3, -5, 2, 3, 2)
    overwrite(keys, 3, 2, 9, 4, 4)
    assert keys.tolist() == [2, 2, 5]


def test_random_mutations_leave_what_lies_before_and_make_keys_only() -> None:
    """The plain form of the compiled mutations; a mask on the random state keeps numbers small enough for Python."""
    counters = LocalCounters()
    counters.random = 12345
    for trial in range(500):
        keys = keys_of(*([2] * 10 + [6] * 10 + [1] * 10 + [5] * 10))
        before = keys.copy()
        tick = trial % 40
        counters.random &= (1 << 63) - 1
        first, shift = mutate(keys, 40, tick, counters)
        assert keys.max() <= 7
        assert abs(shift) <= 3
        assert shift <= 0 or keys[tick : 40 - shift].tolist() == before[tick + shift :].tolist()
        assert shift >= 0 or keys[tick - shift :].tolist() == before[tick : 40 + shift].tolist()
        first = max(first, 0)
        assert keys[: min(first, tick)].tolist() == before[: min(first, tick)].tolist()


def test_a_trial_run_ends_where_it_is_the_current_run_again() -> None:
    """Left and right at once are like neither, the same world while the ninja stands; each case lacks another thing."""
    level = parse_level_string(OPEN + "5^100,566!11^340,564,160,564")
    start = open_start(level, box=False)
    run = verified_run(level, bytes([0] * 8 + [2] * 100)).inputs
    runs, ticks = LocalSearch(start, run, gold=0, seed=1).runs, len(run)

    def ended(*, keys: int = 3, tick: int = 4, score: float = ticks - 0.5, words: int = 0) -> tuple[int, float]:
        memory = PlainWorlds([level], box=False)
        plain = start._replace(maps=memory.maps, worlds=[None, memory.world()], scratch=np.full(3, words))
        runs.counters[0].score = score
        runs.trial[:] = runs.current
        runs.trial[tick] = keys
        return try_run(plain, runs._replace(checkpoints=np.zeros((99, 3), np.int64)), 0, 0, ticks, 0)

    assert ended() == (8, ticks - 0.5)
    assert ended(tick=9) == (ticks, UNREACHED)  # lost a tick
    assert ended(words=1)[0] == ticks  # another state, at the same place
    assert ended(score=ticks)[0] == ticks  # how deep the current run ends is not known yet
    assert ended(keys=KEY_RIGHT)[0] == ticks - 1  # gained one


def test_a_state_that_finds_no_room_leaves_the_pool_as_it_was() -> None:
    memory = new_arrays(3)
    clear(memory)
    initial, words = np.zeros((2, 4 * CHUNK), np.int64)
    words[: 2 * CHUNK] = 1
    assert keep_state(words, initial, memory.nodes[0], memory)
    assert not keep_state(words, initial, memory.nodes[1], memory)
    words[CHUNK:] = 0
    assert keep_state(words, initial, memory.nodes[1], memory), "the last chunk was lost"
    load_state(words, initial, memory.nodes[0], memory)
    assert words.sum() == 2 * CHUNK


def test_a_search_looks_at_the_clock_often_where_states_are_large() -> None:
    start = open_start(heavy_level(1_500), box=False)
    assert ticks_at_once(start) < 60_000
    assert ticks_at_once(open_start(heavy_level(300), box=False)) == 1_000_000
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=40_000)
    search.begin(Resolution(cell=2.0, speed=0.1, macro=6, weight=1.0), seed=1, bound=0)
    search.run(1_000_000)
    assert 0 < search.ticks < 100_000


@pytest.mark.parametrize("memory", ["plain", "compiled"])
def test_values_spread_backwards_from_the_exit(memory: str) -> None:
    """Three entries in a row, 5 and 7 ticks apart, the last one 3 ticks from the exit; a fourth leads nowhere."""
    table, links = ([TableEntry() for _ in range(4)], [Link() for _ in range(3)])
    if memory == "compiled":
        table, links = zeroed(TableEntry, 4), zeroed(Link, 3)
    for link, (source, target, ticks) in zip(links, ((0, 1, 5), (1, 2, 7), (2, -1, 3)), strict=True):
        link.source, link.target, link.ticks = source, target, ticks
    settle = compiled(back_up_values) if memory == "compiled" else back_up_values
    assert settle(table, links, 3, 40) == 2
    assert [float(entry.value) for entry in table] == [15.0, 10.0, 3.0, UNREACHED]


def test_no_gold_to_fetch_leaves_no_fields() -> None:
    assert heuristics_of(OPEN + "5^100,300!11^700,300,400,300").tour_fields(0).shape == (1, POINTS)


def test_the_exit_is_not_out_of_reach_behind_a_closed_door() -> None:
    """From both of its sides: the switch of the exit is at the left, the door at x = 264."""
    heuristics = heuristics_of(CORRIDOR + "|5^60,566!11^100,566,130,566!9^36,566,0,0,10,23,1,0,0!0^400,566")
    home = heuristics.tour_fields(0)[-1]
    assert home[point_at(60, 566)] < home[point_at(400, 566)] < 1_000.0


def test_gold_is_approached_away_from_an_open_exit() -> None:
    """The straight way from the ninja to the gold leads over the exit's disc."""
    heuristics = heuristics_of(OPEN + "5^100,300!11^200,300,600,500!0^300,300")
    closed, opened = (heuristics.field_to(heuristics.gold_places[0], state, 100.0, 300.0) for state in (0, 1))
    here, on_exit = point_at(100, 300), point_at(204, 300)
    assert closed[on_exit] < 80.0 < opened[on_exit]
    assert opened[here] < closed[here] + 30.0


def test_gold_in_a_wall_is_collected_from_beside_it() -> None:
    wall = "0" * 23 * 10 + "1" * 22 + "0" + "0" * 23 * 20
    heuristics = heuristics_of(wall + "|5^60,566!11^200,566,100,566!0^264,300")
    assert heuristics.tour_fields(0)[0, point_at(60, 566)] < UNREACHED


def key_after(text: str, ticks: int, resolution: Resolution) -> int:
    """The key of the moment after this many ticks without keys; the ninja stands still."""
    level = parse_level_string(text)
    start = open_start(level, box=False)
    goal = Search(start, Heuristics(start.maps, start.worlds), nodes=100).goal
    memory = PlainWorlds([level], box=False)
    for _ in range(ticks):
        memory.step(0)
    return state_key(memory.world(), goal, 0, 0, resolution)


def test_enemies_that_are_near_tell_moments_apart() -> None:
    """A drone goes back and forth beside the ninja, or far from it."""
    near, far = (OPEN + f"5^100,566!11^700,566,600,566!6^{x},564,3,0,0,0" for x in (180, 540))
    quiet, watchful = Resolution(), Resolution(enemy_cell=24.0)
    assert key_after(near, 2, quiet) == key_after(near, 30, quiet)
    assert key_after(near, 2, watchful) != key_after(near, 30, watchful)
    assert key_after(far, 2, watchful) == key_after(far, 30, watchful) == key_after(far, 2, quiet)


def test_a_tour_goes_to_the_far_end_first_and_back() -> None:
    """Stops on a line, the start at 42, the end at 0."""
    places = np.array([10.0, 20.0, 30.0, 40.0, 50.0])
    between = np.abs(places[:, None] - places[None, :])
    tour = short_tour(np.abs(places - 42.0), between, places)
    assert tour == [4, 3, 2, 1, 0]


def test_a_tour_heeds_what_lies_only_downhill() -> None:
    """Three stops one above the other: falling costs 1 a stop, climbing 100."""
    heights = np.array([2, 0, 1])
    steps = heights[None, :] - heights[:, None]
    between = np.where(steps > 0, 100.0 * steps, -1.0 * steps)
    assert short_tour(np.array([5.0, 5.0, 5.0]), between, np.zeros(3)) == [0, 2, 1]


def test_of_two_runs_to_the_exit_in_the_same_tick_the_deeper_one_scores_better() -> None:
    world = PlainWorlds([parse_level_string(OPEN + "5^100,300!11^400,300,200,300")], box=False).world()
    exit_ = next(o for o in world.objects if o.kind == EXIT)
    exit_.is_open = 1
    world.tick = 100
    scores = []
    for distance in (0.0, 11.0, 22.0):
        world.ninja.x = exit_.x - distance
        scores.append(score_of(world))
    assert scores == [100.0 - 0.99, 100.0 - 0.99 / 2, 100.0]


def test_states_that_differ_in_a_tenth_switch_are_told_apart() -> None:
    """Twelve trap doors and the exit's switch along the floor: each that is touched makes another switch state."""
    doors = "!".join(f"9^{100 + 24 * k},566,0,1,{3 + k},1,0,0,0" for k in range(12))
    level = parse_level_string(OPEN + f"5^60,566!11^700,566,600,566!{doors}")
    start = open_start(level, box=False)
    search = Search(start, Heuristics(start.maps, start.worlds), nodes=100, along=True)
    memory = PlainWorlds([level], box=False)
    states_of: dict[int, set[int]] = {}
    for _ in range(150):
        memory.step(KEY_RIGHT)
        state = switch_state_of(memory.world(), search.goal, search.counters, 0)
        key = state_key(memory.world(), search.goal, state, 0, Resolution(cell=1000.0, speed=100.0))
        states_of.setdefault(key, set()).add(state)
    assert len(set.union(*states_of.values())) == 14
    assert all(len(states) == 1 for states in states_of.values())


def test_the_switch_states_of_many_worlds_are_those_of_each() -> None:
    level = parse_level_string(
        OPEN + "5^100,566!11^400,566,124,566!9^300,564,0,0,12,22,1,0,0!9^500,564,1,1,20,22,0,0,0"
    )
    batch = Batch(level, 3)
    slots = [slot for slot in range(1, len(batch.objects[0])) if batch.objects[0, slot]["kind"] in (EXIT, DOOR)]
    batch.run([[0, KEY_RIGHT, KEY_RIGHT * (tick < 20)] for tick in range(120)])
    states = open_masks(batch.objects, np.array(slots)).tolist()
    assert states == [open_mask(batch.world(index), np.array(slots)) for index in range(3)]
    assert len({*states}) > 1
