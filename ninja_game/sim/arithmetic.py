"""Arithmetic of the original game: division by zero (world.md §0) and numbers used as flags (objects.md §2.1)."""

from __future__ import annotations

from ninja_game.sim.rules import INF, NAN
from ninja_game.sim.schema.declare import fast


@fast
def ieee_divide(a: float, b: float) -> float:
    """Give a / b, with x/0 = ±∞ (by the sign of x) and 0/0 = NaN. Replays never depend on the sign of a zero."""
    if b == 0.0:
        if a > 0.0:
            return INF
        if a < 0.0:
            return -INF
        return NAN
    return a / b


@fast
def is_set(value: float) -> bool:
    """Whether a flag of a record is set: any number but 0 and NaN sets it."""
    return value < 0.0 or value > 0.0


@fast
def canonical(value: float) -> float:
    """A number as traces write it: -0.0 as 0.0, every NaN as one NaN."""
    if value != value:
        return NAN
    return value + 0  # a whole number stays one
