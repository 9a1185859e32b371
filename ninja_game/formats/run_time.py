"""The time of a run, in seconds: how all of the program shows it."""

from __future__ import annotations

from ninja_game.sim.rules import TICK_MS


def seconds_text(ticks: int) -> str:
    """Ticks as seconds with three decimals: the one way in which a time is shown (game.md §1.3).

    The time of a run, and its length in ticks, is the tick of the exit contact or the death; of one that has neither
    all ticks that were run. So it is 90 s and two for each piece of gold less the score.

    >>> seconds_text(3600), seconds_text(1), seconds_text(10176)
    ('90.000', '0.025', '254.400')
    """
    whole, rest = divmod(ticks * TICK_MS, 1000)
    return f"{whole}.{rest:03d}"
