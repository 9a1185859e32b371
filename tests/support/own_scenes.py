"""Little levels of our own, each for a rule that random play seldom meets; they have golden digests too."""

import math
from typing import NamedTuple

from ninja_game.sim.kinds import (
    DOOR,
    DRONE,
    EXIT,
    FLOOR_GUARD,
    GOLD,
    LAUNCH_PAD,
    LAUNCHER,
    MINE,
    NINJA,
    ONE_WAY,
    THWUMP,
    TURRET,
)
from ninja_game.sim.level import ROWS, Level, ObjectSpec

RIGHT = bytes([2])
STILL = bytes([0])
SMALLEST = 9  # columns and rows of the room in which a scene plays, from the upper left corner


class Scene(NamedTuple):
    """A scene: what it shows, its level, its inputs."""

    name: str
    level: Level
    inputs: bytes


def room(tiles: dict[tuple[int, int], int], *records: ObjectSpec) -> Level:
    """A room of 9 x 9 cells in rock, with these tiles by (column, row) in it."""
    ids = [1] * (31 * ROWS)
    for column in range(1, SMALLEST + 1):
        for row in range(1, SMALLEST + 1):
            ids[(column - 1) * ROWS + row - 1] = tiles.get((column, row), 0)
    return Level(tuple(ids), records)


def ninja(x: float = 60.0, y: float = 230.0) -> ObjectSpec:
    """The ninja; by default on the floor near the left wall."""
    return ObjectSpec(NINJA, (x, y))


STAIRCASE = {(column, row): 1 for column in range(1, 5) for row in range(5 + column, 10)} | {(1, 6): 1}
SLOPE = STAIRCASE | {(2, 6): 2, (3, 7): 2, (4, 8): 2, (5, 9): 2}
"""A slope down to the right, from the second column to the floor."""

SCENES = (
    Scene("spawn-in-the-middle-of-rock", room({(3, 5): 1}, ninja(84.0, 131.85)), STILL * 20),
    Scene("spawn-in-an-odd-half-tile", room({(3, 5): 70}, ninja(80.0, 131.0)), RIGHT * 40),
    Scene("stand-on-a-tile-that-is-never-solid", room({(3, 9): -1}, ninja(84.0, 200.0)), RIGHT * 40),
    Scene("the-last-ninja-plays", room({}, ninja(60.0, 60.0), ninja(150.0, 230.0)), RIGHT * 30),
    Scene("a-ninja-without-place", room({}, ObjectSpec(NINJA, (60.0,)), ObjectSpec(GOLD, (48.0, 80.0))), RIGHT * 60),
    Scene("wrong-counts-make-inert-objects", room({}, ninja(), ObjectSpec(MINE, (80.0, 230.0, 1.0))), RIGHT * 40),
    Scene(
        "two-doors-on-one-side",
        room(
            {},
            ninja(),
            ObjectSpec(DOOR, (90.0, 230.0, 0.0, 0.0, 6.0, 9.0, 1.0, 0.0, 0.0)),
            ObjectSpec(DOOR, (110.0, 230.0, 0.0, 0.0, 6.0, 9.0, 1.0, 0.0, 0.0)),
        ),
        RIGHT * 90,
    ),
    Scene(
        "a-door-with-an-odd-flag",
        room({}, ninja(), ObjectSpec(DOOR, (90.0, 230.0, 2.0, 1.0, 5.0, 8.0, 0.0, 0.0, 0.0))),
        RIGHT * 90,
    ),
    Scene(
        "a-door-off-the-grid",
        room({}, ninja(), ObjectSpec(DOOR, (90.0, 230.0, 0.0, 0.0, 40.0, 9.0, 0.0, 0.0, 0.0))),
        RIGHT * 30,
    ),
    Scene("a-pad-without-number", room({}, ninja(), ObjectSpec(LAUNCH_PAD, (84.0, 234.0, math.nan, -1.0))), RIGHT * 40),
    Scene("onto-a-rising-thwump", room({}, ninja(84.0, 110.0), ObjectSpec(THWUMP, (84.0, 200.0, 3.0))), STILL * 60),
    Scene("a-thwump-that-faces-nowhere", room({}, ninja(), ObjectSpec(THWUMP, (120.0, 230.0, 7.0))), RIGHT * 60),
    Scene("a-one-way-faces-down", room({}, ninja(130.0, 60.0), ObjectSpec(ONE_WAY, (132.0, 132.0, 9.0))), STILL * 90),
    Scene("a-drone-closed-in", room(
        {(4, 5): 1, (6, 5): 1, (5, 4): 1, (5, 6): 1}, ninja(), ObjectSpec(DRONE, (132.0, 132.0, 0.0, 1.0, 0.0, 0.0))
    ), RIGHT * 60),
    Scene("drones-with-odd-directions", room({}, ninja(), *[
        ObjectSpec(DRONE, (60.0 + 24 * k, 60.0, float(k % 6), 0.0, 0.0, direction))
        for k, direction in enumerate((-1.0, -5.0, -4.0, 7.0, 0.5, math.nan, 1e20))
    ]), STILL * 80),
    Scene("seekers-with-odd-movements", room({}, ninja(200.0, 60.0), *[
        ObjectSpec(DRONE, (60.0, 60.0 + 24 * k, movement, 1.0, 0.0, 0.0))
        for k, movement in enumerate((-1.0, 0.5, 7.0, math.nan))
    ]), RIGHT * 80),
    Scene("guard-over-a-hole", room({}, ninja(200.0, 110.0), ObjectSpec(FLOOR_GUARD, (84.0, 110.0, 1.0))), RIGHT * 50),
    Scene("sight-past-a-corner", room({(3, 3): 1}, ninja(206.0, 230.0), ObjectSpec(TURRET, (62.0, 86.0))), STILL * 60),
    Scene("a-turret-off-the-grid", room({}, ninja(), ObjectSpec(TURRET, (-50.0, 230.0))), STILL * 120),
    Scene("a-rocket-from-off-the-grid", room({}, ninja(), ObjectSpec(LAUNCHER, (-60.0, 100.0))), STILL * 120),
    Scene("a-switch-opens-for-a-dead-ninja", room(
        {}, ninja(), ObjectSpec(EXIT, (96.0, 230.0, 84.0, 230.0)), ObjectSpec(MINE, (90.0, 230.0))
    ), RIGHT * 60),
    Scene("a-pad-brings-back-to-life", room(
        {}, ninja(), ObjectSpec(LAUNCH_PAD, (97.0, 234.0, 0.0, -1.0)), ObjectSpec(MINE, (93.25, 230.0))
    ), RIGHT * 90),
    Scene("off-a-slope-nobody-falls-to-death", room(
        SLOPE, ninja(60.0, 130.0), ObjectSpec(LAUNCH_PAD, (96.0, 176.0, 1.8, 1.8))
    ), STILL * 60),
    Scene("a-fall-just-too-hard", room(
        {}, ninja(60.0, 95.0), ObjectSpec(LAUNCH_PAD, (60.0, 87.0, 0.0, 1.0))
    ), STILL * 40),
    Scene("two-slopes-that-count-as-one-floor", room(
        {(5, 8): 3, (6, 7): 27} | dict.fromkeys(((6, 8), (7, 8), (8, 8), (9, 8), (5, 9), (4, 9)), 1), ninja(60.0, 150.0)
    ), RIGHT * 120),
    Scene("a-win-in-mid-launch", room(
        {}, ninja(), ObjectSpec(EXIT, (95.0, 214.8, 60.0, 230.0)), ObjectSpec(LAUNCH_PAD, (97.0, 234.0, 0.0, -1.0))
    ), RIGHT * 90),
    Scene("rocket-onto-the-target", room({}, ninja(132.0, 230.0), ObjectSpec(LAUNCHER, (132.0, 60.0))), STILL * 90),
)  # fmt: skip
"""All scenes."""
