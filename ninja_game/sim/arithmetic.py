"""Numbers as the original has them: division by zero (world.md §0), flags (objects.md §2.1)."""

from __future__ import annotations

from ninja_game.sim.memory.declare import fast
from ninja_game.sim.rules import INF, NAN


@fast
def ieee_divide(a: float, b: float) -> float:
    """Give a / b, with x/0 = ±∞ (by the sign of x) and 0/0 = NaN. The sign of a zero never matters."""
    if b == 0.0:
        if a > 0.0:
            return INF
        if a < 0.0:
            return -INF
        return NAN
    return a / b


@fast
def is_set(value: float) -> bool:
    """A flag: any number but 0 and NaN."""
    return value < 0.0 or value > 0.0


@fast
def canonical(value: float) -> float:
    """A number as traces write it: no -0.0, one NaN."""
    if value != value:
        return NAN
    return value + 0.0
