"""Division as IEEE 754 has it, for the few degenerate places where the specification wants ±∞ and NaN (world.md §0)."""

from __future__ import annotations

from ninja_game.sim.memory import fast
from ninja_game.sim.rules import INF, NAN


@fast
def div(a: float, b: float) -> float:
    """Give a / b, with x/0 = ±∞ (by the sign of x) and 0/0 = NaN. The sign of a zero never matters."""
    if b == 0.0:
        if a > 0.0:
            return INF
        if a < 0.0:
            return -INF
        return NAN
    return a / b
