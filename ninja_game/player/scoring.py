"""Lifetime and score (game.md §1.1-§1.4). All times are ticks of 25 ms, whatever the speed of play."""

from __future__ import annotations

from ninja_game.sim.rules import GOLD_BONUS, LIFETIME, TICK_MS


def level_score(gold: int, exit_tick: int) -> int:
    """Score of a passed level in ticks: ``gold`` pieces taken, exit touched in tick ``exit_tick`` (from 0).

    >>> level_score(3, 600)
    3240
    """
    return LIFETIME + GOLD_BONUS * gold - exit_tick


def seconds_text(ticks: int) -> str:
    """Ticks as seconds with three decimals (game.md §1.3).

    >>> seconds_text(3600), seconds_text(1), seconds_text(10176)
    ('90.000', '0.025', '254.400')
    """
    whole, rest = divmod(ticks * TICK_MS, 1000)
    return f"{whole}.{rest:03d}"
