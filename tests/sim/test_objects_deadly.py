"""What kills, how, and what the death tells: one sentence of docs/rules/objects.md a test."""

from math import hypot

import pytest

from ninja_game.runs.deaths import SELF, death_text, killer_of
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, LAUNCH_PAD, LAUNCHER, MINE, THWUMP, TURRET
from ninja_game.sim.level import ObjectSpec
from ninja_game.simulation import EventView, Simulation
from tests.support.room_runs import FLOOR, Play, the, until, wait

RIGHT, DOWN, LEFT, UP = 0.0, 1.0, 2.0, 3.0
ZAP, LASER, CHAINGUN = 0.0, 1.0, 2.0


def drone(x: float, y: float, weapon: float, *, seeker: float = 0.0, direction: float = LEFT) -> ObjectSpec:
    """A drone that goes straight on as long as it can."""
    return ObjectSpec(DRONE, (x, y, 2.0, seeker, weapon, direction))


def assert_killed(
    run: Simulation, death: EventView, killer: int | None, cause: str, name: str = SELF, *, text: str = ""
) -> None:
    """The ninja is dead, by this object (None: by nobody) and this cause; the statistics count it by this name.

    ``text``: its words, where they are not those of killer or cause.
    """
    assert (death.object_id, death.cause, killer_of(run.world)) == (killer, cause, name)
    assert (run.outcome, run.ninja.state) == ("dead", "dead")
    w = run.world
    assert death_text(w.events[: w.event_count], w.ninja, w.objects) == (
        text or (cause if killer is None else f"{name} {killer}")
    )


def test_a_mine_kills_within_14_px_and_is_gone(play: Play) -> None:
    run = play(ObjectSpec(MINE, (60.0, 60.0)), ObjectSpec(MINE, (100.0, FLOOR)))
    death = until(run, "died", right=True)
    assert_killed(run, death, 2, "explosive", "mine")
    assert (death.x, death.y) == (100.0, FLOOR)
    assert death.dx == run.ninja.x - 100.0, "away from the mine, as far as he was from it"
    assert hypot(death.dx, death.dy) < 14.0
    assert [event.name for event in run.events] == ["died", "mine-exploded"]
    assert [the(run, 1).status, the(run, 2).status] == [1, 0]


def test_a_floor_guard_runs_at_who_enters_its_row_and_kills(play: Play) -> None:
    run = play(ObjectSpec(FLOOR_GUARD, (200.0, FLOOR, 1.0)))
    started = until(run, "guard-started")
    assert (started.object_id, started.dx) == (1, -1.0)
    x = the(run, 1).x
    run.step()
    assert the(run, 1).x == x - 5.142857142857142
    death = until(run, "died")
    assert_killed(run, death, 1, "electric", "floor guard")
    assert death.dx < -9.0, "away from the guard"
    assert hypot(death.dx, death.dy) == pytest.approx(10.0)


def test_a_thwump_falls_on_who_comes_below_and_rises_slowly(play: Play) -> None:
    run = play(ObjectSpec(THWUMP, (180.0, 60.0, DOWN)))
    fell = until(run, "thwump-fell", right=True)
    assert (fell.object_id, fell.dx, fell.dy) == (1, 0.0, 1.0)
    assert run.ninja.x > 180.0 - 38.0 - 5.0
    y = the(run, 1).y
    run.step(left=True)
    assert the(run, 1).y == y + 4.285714285714286
    landed = until(run, "thwump-landed", left=True)
    assert (landed.object_id, landed.dx, landed.dy) == (1, 0.0, 1.0)
    y = the(run, 1).y
    run.step(left=True)
    assert the(run, 1).y == y - 1.7142857142857142


@pytest.mark.parametrize(
    "direction, x, y, impulse",
    [
        (DOWN, 60.0, 203.0, (0.0, 6.0)),
        (UP, 60.0, 250.0, (0.0, -8.0)),
        (RIGHT, 43.0, FLOOR, (8.0, -4.0)),
        (LEFT, 77.0, FLOOR, (-8.0, -4.0)),
    ],
)
def test_the_leading_face_of_a_thwump_kills_and_throws_off(
    play: Play, direction: float, x: float, y: float, impulse: tuple[float, float]
) -> None:
    run = play(ObjectSpec(THWUMP, (x, y, direction)))
    death = until(run, "died")
    assert_killed(run, death, 1, "electric", "thwump")
    assert (death.dx, death.dy) == impulse


def test_the_other_faces_of_a_thwump_only_push(play: Play) -> None:
    run = play(ObjectSpec(THWUMP, (110.0, FLOOR, RIGHT)))
    assert "died" not in wait(run, 60, right=True)
    assert run.ninja.x == 110.0 - 9.0 - 10.0


def test_a_turret_aims_waits_and_shoots_who_stands_still(play: Play) -> None:
    run = play(ObjectSpec(TURRET, (200.0, 60.0)))
    locked = until(run, "turret-locked")
    assert (locked.x, locked.y) == (the(run, 1).x, the(run, 1).y), "the crosshair stands still now"
    tick = run.tick
    death = until(run, "died")
    assert run.tick == tick + 10
    assert_killed(run, death, 1, "hard bullet", "gauss turret")
    assert hypot(death.dx, death.dy) == pytest.approx(8.0)
    assert [event.name for event in run.events] == ["turret-fired", "died"]


def test_a_rocket_follows_the_ninja_and_explodes_on_him(play: Play) -> None:
    run = play(ObjectSpec(LAUNCHER, (200.0, 60.0)))
    launched = until(run, "rocket-launched")
    assert (launched.object_id, launched.x, launched.y) == (1, 200.0, 60.0)
    assert the(run, 1).status == 2
    death = until(run, "died")
    assert_killed(run, death, 1, "explosive", "homing rocket")
    assert hypot(death.dx, death.dy) < 10.0, "its tip was inside him"
    assert [event.name for event in run.events] == ["died", "rocket-exploded"]
    assert the(run, 1).status == 0


def test_a_rocket_explodes_at_a_tile(play: Play) -> None:
    run = play(ObjectSpec(LAUNCHER, (204.0, 160.0)))
    exploded = until(run, "rocket-exploded", right=True)
    assert run.outcome == "running"
    assert exploded.y >= 240.0, "in the floor, past which it could not turn"


def test_a_zap_drone_kills_by_touch(play: Play) -> None:
    run = play(drone(204.0, 228.0, ZAP))
    x = the(run, 1).x
    wait(run, 2)
    assert the(run, 1).x == x - 1.7142857142857142
    death = until(run, "died")
    assert_killed(run, death, 1, "electric", "zap drone")
    assert hypot(death.dx, death.dy) == pytest.approx(10.0)


def test_a_seeker_chases_at_twice_the_speed(play: Play) -> None:
    run = play(drone(204.0, 228.0, ZAP, seeker=1.0))
    assert until(run, "chase-started").object_id == 1
    x = the(run, 1).x
    run.step()
    assert the(run, 1).x == x - 2 * 1.7142857142857142


def test_a_laser_drone_warns_for_30_ticks_then_burns(play: Play) -> None:
    run = play(drone(204.0, 60.0, LASER))
    assert until(run, "laser-charging").object_id == 1
    tick = run.tick
    on = until(run, "laser-on")
    assert run.tick == tick + 30
    assert (on.x, on.y) == (the(run, 1).x, the(run, 1).y)
    death = until(run, "died")
    assert_killed(run, death, 1, "laser", "laser drone")
    assert hypot(death.dx, death.dy) == pytest.approx(6.0)
    assert [event.name for event in run.events] == ["laser-off", "died"]


def test_a_laser_beam_stays_where_it_was_aimed(play: Play) -> None:
    run = play(drone(204.0, 60.0, LASER))
    until(run, "laser-charging")
    seen = wait(run, 130, right=True)
    assert {"laser-on", "laser-off"} <= seen
    assert "died" not in seen


def test_a_chaingun_drone_winds_up_for_35_ticks_then_shoots_every_sixth(play: Play) -> None:
    run = play(drone(204.0, 60.0, CHAINGUN))
    assert until(run, "chaingun-charging").object_id == 1
    tick = run.tick
    on = until(run, "chaingun-on")
    assert run.tick == tick + 35
    assert hypot(on.dx, on.dy) == pytest.approx(1.0)
    tick = run.tick
    until(run, "chaingun-shot")
    assert run.tick == tick + 6
    death = until(run, "died")
    assert_killed(run, death, 1, "bullet", "chaingun drone")
    assert hypot(death.dx, death.dy) == pytest.approx(5.0, abs=0.3)


def test_a_hard_fall_kills_and_nobody_did_it(play: Play) -> None:
    run = play(ObjectSpec(LAUNCH_PAD, (60.0, 87.0, 0.0, 1.0)), y=95.0)
    assert_killed(run, until(run, "died"), None, "fall", text="floor at 7.098 px/tick, over 7.000")


def test_a_push_out_of_a_tile_of_9_px_crushes(play: Play) -> None:
    run = play(tiles={(3, 5): 1}, x=84.0, y=131.85)
    death = until(run, "died")
    assert_killed(run, death, None, "crushed")
    assert (death.dx, death.dy) == (0.0, 0.0)
