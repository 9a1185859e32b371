"""What can be picked up, opened, stood on or jumped from: one sentence of docs/rules/objects.md a test."""

import pytest

from ninja_game.sim.kinds import BOUNCE_BLOCK, DOOR, EXIT, GOLD, LAUNCH_PAD, ONE_WAY
from ninja_game.sim.level import ObjectSpec
from tests.support.room_runs import FLOOR, Play, the, until, wait

DOWN, UP = 1.0, 3.0


def door(x: float, y: float, *, trap: float = 0.0, locked: float = 0.0) -> ObjectSpec:
    """A door between columns 5 and 6 of the floor's row, at x = 144; (x, y) is its switch."""
    return ObjectSpec(DOOR, (x, y, 0.0, trap, 5.0, 9.0, locked, 0.0, 0.0))


BEFORE_THE_DOOR = 144.0 - 10.0


def test_gold_is_taken_within_16_px_and_adds_one(play: Play) -> None:
    run = play(ObjectSpec(GOLD, (100.0, FLOOR)))
    before = run.ninja.x
    while not run.gold:
        before = run.ninja.x
        run.step(right=True)
    assert before <= 84.0 < run.ninja.x
    assert [(event.name, event.object_id, event.x) for event in run.events] == [("gold-taken", 1, 100.0)]
    assert the(run, 1).status == 0
    wait(run, 20, left=True)
    wait(run, 40, right=True)
    assert run.gold == 1


def test_the_exit_passes_the_level_only_after_its_switch(play: Play) -> None:
    run = play(ObjectSpec(EXIT, (120.0, FLOOR, 200.0, FLOOR)))
    opened = until(run, "exit-opened", right=True)
    assert run.ninja.x > 140.0, "the closed exit let him pass"
    assert (opened.object_id, opened.x) == (1, 200.0)
    assert the(run, 1).status == 1
    until(run, "won", left=True)
    assert run.outcome == "exit"
    assert run.ninja.state == "celebrating"


def test_an_automatic_door_opens_for_the_ninja_and_closes_behind_him(play: Play) -> None:
    run = play(door(0.0, 0.0))
    assert until(run, "door-opened", right=True).object_id == 1
    until(run, "door-closed", right=True)
    assert run.ninja.x > 164.0
    wait(run, 8)
    assert not wait(run, 60) & {"door-opened", "door-closed"}


def test_a_locked_door_stays_shut_until_its_switch_is_touched_then_open_for_good(play: Play) -> None:
    run = play(door(60.0, 130.0, locked=1.0))
    wait(run, 60, right=True)
    assert run.ninja.x == BEFORE_THE_DOOR
    run = play(door(90.0, FLOOR, locked=1.0))
    until(run, "lock-opened", right=True)
    wait(run, 60, right=True)
    wait(run, 60, left=True)
    assert run.ninja.x < BEFORE_THE_DOOR


def test_a_trap_door_closes_when_its_switch_is_touched(play: Play) -> None:
    run = play(door(60.0, 130.0, trap=1.0))
    wait(run, 80, right=True)
    assert run.ninja.x > 144.0, "it was open before"
    run = play(door(90.0, FLOOR, trap=1.0))
    until(run, "trap-closed", right=True)
    wait(run, 80, right=True)
    assert run.ninja.x == BEFORE_THE_DOOR


def test_a_launch_pad_throws_upwards_twice_as_hard_as_sideways(play: Play) -> None:
    for normal, velocity in (((0.0, -1.0), (0.0, -10.285714285714285)), ((1.0, 0.0), (5.142857142857142, 0.0))):
        run = play(ObjectSpec(LAUNCH_PAD, (60.0, FLOOR + 4.0, *normal)))
        launched = until(run, "launched")
        assert (launched.object_id, launched.dx, launched.dy) == (1, *velocity)


def test_a_one_way_platform_holds_who_comes_from_its_face_and_nobody_else(play: Play) -> None:
    above = 180.0 - 12.0 - 10.0
    run = play(ObjectSpec(ONE_WAY, (60.0, 180.0, UP)), y=60.0)
    until(run, "landed")
    wait(run, 20)
    assert run.ninja.y == above
    run = play(ObjectSpec(ONE_WAY, (60.0, 180.0, DOWN)), y=60.0)
    until(run, "landed")
    assert run.ninja.y == FLOOR


def test_a_bounce_block_is_pushed_and_falls_asleep_when_it_is_left_alone(play: Play) -> None:
    run = play(ObjectSpec(BOUNCE_BLOCK, (110.0, FLOOR)))
    assert until(run, "block-woken", right=True).object_id == 1
    x = run.ninja.x
    wait(run, 10, right=True)
    assert the(run, 1).x > 110.0
    assert the(run, 1).status == 1
    assert run.ninja.x > x
    wait(run, 25, left=True)
    wait(run, 100)
    assert the(run, 1).status == 0
    assert the(run, 1).x == pytest.approx(110.0, abs=2.0)
