"""Real time as ticks."""

from __future__ import annotations

from ninja_game.sim.rules import TICK_MS

LONGEST_MS = 2000
"""More than this in one picture is a stall: it counts as one tick and is not caught up."""


class RunClock:
    """Counts real time and says how many ticks are due; the remainder is kept.

    >>> clock = RunClock()
    >>> [clock.ticks_due(ms) for ms in (24, 1, 60, 5000)]
    [0, 1, 2, 1]
    """

    def __init__(self) -> None:
        self.remainder = 0
        self.tick_ms = TICK_MS

    def reset(self) -> None:
        """Start afresh: when play starts, on unpausing, on starting a replay."""
        self.remainder = 0

    def ticks_due(self, real_ms: int, tick_ms: int = TICK_MS) -> int:
        """How many ticks to run now that ``real_ms`` have passed; ``tick_ms``: real ms a tick."""
        self.tick_ms = tick_ms
        time = real_ms + self.remainder
        if time > LONGEST_MS:
            time = tick_ms
        due, self.remainder = divmod(time, tick_ms)
        return due

    @property
    def fraction(self) -> float:
        """How much of the next tick has passed, 0…1: where between two ticks to draw."""
        return min(1.0, self.remainder / self.tick_ms)
