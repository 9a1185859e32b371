"""The score of a run, and its time in seconds, as the whole program shows them."""

from __future__ import annotations

from ninja_game.sim.rules import GOLD_BONUS, LIFETIME, TICK_MS


def level_score(gold: int, exit_tick: int) -> int:
    """Score of a passed level in ticks: ``gold`` pieces taken, exit touched in tick ``exit_tick`` (from 0).

    >>> level_score(3, 600)
    3240
    """
    return LIFETIME + GOLD_BONUS * gold - exit_tick


def seconds_text(ticks: int) -> str:
    """Ticks as seconds with three decimals (game.md §1.3), for all times of runs.

    The time of a run, and its length in ticks, is the tick of the exit contact or death; without either, all ticks that
    were run. So it is 90 s, plus 2 s per piece of gold, minus the score.

    >>> seconds_text(3600), seconds_text(1), seconds_text(10176)
    ('90.000', '0.025', '254.400')
    """
    whole, rest = divmod(ticks * TICK_MS, 1000)
    return f"{whole}.{rest:03d}"


def rounded_text(ticks: int) -> str:
    """Ticks as seconds with one decimal, rounded up: a clock that runs down.

    >>> rounded_text(1), rounded_text(3600), rounded_text(943)
    ('0.1', '90.0', '23.6')
    """
    return f"{-(-ticks * TICK_MS // 100) / 10:.1f}"


def time_text(end_tick: int) -> str:
    return f"{end_tick} ticks ({seconds_text(end_tick)} s)"
