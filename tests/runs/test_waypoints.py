"""Waypoints in replays: written once a second, read strictly, and where a run leaves them is named."""

from dataclasses import replace

import pytest

from ninja_game import (
    ArgumentError,
    Level,
    Replay,
    ReplayError,
    parse_replay,
    record_replay,
    verify_recording,
    write_replay,
)
from ninja_game.formats.recording import parse_replays
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import ObjectSpec

FLAT = Level(objects=(ObjectSpec(NINJA, (100.0, 566.0)),))


def running() -> Replay:
    """Two seconds of running to the right."""
    return record_replay(FLAT, bytes([2] * 80))


def problems(replay: Replay) -> tuple[str, ...]:
    """What verification says of a replay."""
    return tuple(map(str, verify_recording(parse_replays(write_replay(replay))[0], memory="plain").problems))


def test_a_waypoint_stands_at_the_end_of_every_second() -> None:
    assert [(waypoint.tick, waypoint.state) for waypoint in running().waypoints] == [(39, "running"), (79, "running")]
    assert parse_replay(write_replay(running())) == running()


def test_a_faithful_replay_has_no_problems() -> None:
    assert problems(running()) == ()


def test_the_first_missed_waypoint_and_field_are_named() -> None:
    first, second = running().waypoints
    moved = replace(running(), waypoints=(first, second._replace(y=500.0)))
    assert problems(moved) == ("tick 79: ninja: y is 566.0, the replay says 500.0 (agrees up to tick 39)",)


def test_other_inputs_are_noticed_where_they_lead_elsewhere() -> None:
    other = replace(running(), inputs=bytes([2] * 50 + [0] * 30), digest="")
    (problem,) = problems(other)
    assert problem.startswith("tick 79: ninja: x is ")


@pytest.mark.parametrize(
    "line, message",
    [
        ("x 1 2 running", "not a waypoint"),
        ("3 1 2", "not a waypoint"),
        ("1 1 2 running\n  1 1 2 running", "out of order"),
    ],
)
def test_a_broken_waypoint_is_named_with_its_line(line: str, message: str) -> None:
    text = write_replay(replace(running(), waypoints=(), level=None))
    text = text.removesuffix("end\n") + f"waypoints:\n  {line}\nend\n"
    with pytest.raises(ReplayError, match=message) as caught:
        parse_replay(text)
    assert caught.value.line > 0


def test_only_a_recording_is_verified() -> None:
    with pytest.raises(ArgumentError, match="recording is 'x'; expected a Recording"):
        verify_recording("x")  # type: ignore[arg-type]
