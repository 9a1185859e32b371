"""The game's own advice on climbing, from what the ninja does at a wall."""

import pytest

from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.runs.advice import CLIMB, CLIMBED, Advice
from ninja_game.runs.message_queue import MessageQueue
from ninja_game.sim.rules import CELL
from ninja_game.simulation import Simulation

WELL = room_level(["#...#"] * 10 + ["#@..#"], ())


def climb(keys: str) -> tuple[list[str], float]:
    """The messages in a well with these keys, and the greatest height, px."""
    simulation, messages = Simulation(WELL), MessageQueue((), advice=Advice())
    seen, floor, height = [], simulation.world.ninja.y, 0.0
    for each in read_inputs([(1, keys)]).keys:
        simulation.step_keys(each)
        height = max(height, floor - simulation.world.ninja.y)
        if messages.on_tick(simulation.world) and messages.text:
            seen.append(messages.text)
    return seen, height


SLIP = ".*40 R*12 RJ*20 R*20 L*60 "


def test_who_slips_down_a_wall_twice_sees_what_the_keys_do_at_it() -> None:
    right, left = (CLIMB % names for names in (("{right}", "{left}"), ("{left}", "{right}")))
    assert climb(SLIP)[0] == []
    assert climb(SLIP * 2)[0] == [right]
    assert climb(SLIP * 2 + ".*500 " + SLIP * 2)[0] == [right, right], "it comes back"
    assert climb(2 * ".*40 L*12 LJ*20 L*20 R*60 ")[0] == [left]
    assert climb(SLIP + ".*40 RJ*30 .*40 " * 6)[0] == []


def test_help_with_walls_is_gone_once_the_climb_is_done() -> None:
    simulation, messages = Simulation(WELL), MessageQueue((), advice=Advice())
    for each in read_inputs([(1, SLIP * 2)]).keys:
        simulation.step_keys(each)
        messages.on_tick(simulation.world)
    assert messages.text
    floor = simulation.world.ninja.y
    for each in read_inputs([(1, "R*12 RJ*20 R*18 " + "RJ*20 R*8 " * 5)]).keys:
        simulation.step_keys(each)
        messages.on_tick(simulation.world)
        if not messages.text:
            break
    assert floor - simulation.world.ninja.y == pytest.approx(CLIMBED, abs=CELL), "not after so long, but there"


def test_climbing_as_the_hint_says_works_and_away_from_the_wall_first_does_not() -> None:
    _, once = climb(".*40 R*12 RJ*20 R*20")
    assert climb(".*40 R*12 RJ*20 R*18 " + "RJ*20 R*8 " * 6)[1] > once + 100, (
        "towards the wall, jump held at each touch"
    )
    assert climb(".*40 R*12 RJ*20 R*18 " + "L*3 LJ*20 L*30 ")[1] <= once, "away first: no jump at all"
    assert climb(".*40 R*12 RJ*20 R*18 J*20 L*20")[1] > once + 10, "jump alone"
