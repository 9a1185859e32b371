"""What of the level the mouse points at: a tick of the run, an object."""

from __future__ import annotations

from math import hypot

import numpy as np

from ninja_game.play.tas.level.paths import Positions, shown_span
from ninja_game.simulation import ObjectView, Simulation

_REACH = 16.0
"""px of the level within which an object is pointed at."""
_LEAP = 40.0
"""A drag goes to a nearer part of the run that is many ticks away only if it is nearer by more px than this."""


def nearest_tick(positions: Positions, x: float, y: float, cursor: int, *, dragged: bool = False) -> int:
    """The tick, of those whose path is shown, after which the ninja was nearest to a place, px of the level."""
    first, last = shown_span(cursor)
    shown = positions[first:last] if first < len(positions) else positions
    first = first if first < len(positions) else 0
    far = np.hypot(shown[:, 0] - x, shown[:, 1] - y)
    if dragged:
        far += np.minimum(np.abs(np.arange(len(far)) + first - cursor), _LEAP)
    return first + int(np.argmin(far))


def object_at(run: Simulation, x: float, y: float) -> ObjectView | None:
    """The object that is nearest to a place now, if it is near."""
    found = min(run.objects, key=lambda each: hypot(each.x - x, each.y - y), default=None)
    return found if found is not None and hypot(found.x - x, found.y - y) < _REACH else None
