"""What stands indented in a replay text besides its inputs: a level, and waypoints."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ninja_game.errors import ReplayError
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.lines import Line
from ninja_game.formats.numbers import NAN
from ninja_game.sim.level import Level


class Waypoint(NamedTuple):
    """Where the ninja is after a tick: px, and its state by name."""

    tick: int
    x: float
    y: float
    state: str


def read_level(lines: Sequence[Line], file: str) -> tuple[Level | None, str, str]:
    """The embedded ASCII level (None without one), its name and author. Raises LevelError with the replay's line."""
    if not lines:
        return None, "", ""
    text = [""] * lines[-1][0]
    for number, line in lines:
        text[number - 1] = line
    read = parse_ascii_level("\n".join(text), file=file)
    level = read.level
    # With one and the same NaN everywhere a replay equals the one that was written.
    one_nan = [tuple(NAN if math.isnan(value) else value for value in record.values) for record in level.objects]
    records = [record._replace(values=values) for record, values in zip(level.objects, one_nan, strict=True)]
    return Level(level.tiles, tuple(records)), read.name, read.author


def read_waypoints(lines: Sequence[Line], file: str) -> tuple[Waypoint, ...]:
    """The waypoints of a replay, a line each: tick, x, y, state. Raises ReplayError with the line."""
    waypoints: list[Waypoint] = []
    for number, line in lines:
        words = line.split()
        try:
            tick, x, y, state = words
            waypoint = Waypoint(int(tick), float(x), float(y), state)
        except ValueError:
            expected = "tick, x, y and state, such as 39 166.5 563.0 jumping"
            raise ReplayError("not a waypoint", file, number, 3, repr(line.strip()[:40]), expected) from None
        if waypoint.tick <= (waypoints[-1].tick if waypoints else -1):
            raise ReplayError("waypoints out of order", file, number, 3, words[0], "ticks that grow")
        waypoints.append(waypoint)
    return tuple(waypoints)
