"""In which order a solver looks: coarse and greedy first, then finer, patient and varied searches, then local searches.

Amounts of work are in ticks of a climb; a tick of a search counts more, for its save-states and tables.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ninja_game.solver.search_run import Resolution

WORK_PER_SECOND = 3_000_000
"""What one thread is expected to do; plans are made with this number, never with the clock."""
SEARCH_COST = 2.0

FIND = (
    (Resolution(), 8_000_000),
    (Resolution(cell=8.0, speed=0.5, macro=8, weight=1.5), 12_000_000),
    (Resolution(cell=12.0, speed=1.0, macro=6, weight=1.2, visits=20, patience=12), 12_000_000),
    (Resolution(cell=12.0, speed=0.7, weight=2.0, visits=10), 16_000_000),
    (Resolution(cell=6.0, speed=0.5, macro=4, weight=2.0), 20_000_000),
    (Resolution(cell=9.0, speed=0.6, macro=6, weight=1.0, visits=4, patience=60), 30_000_000),
    (Resolution(cell=5.0, speed=0.4, macro=4, weight=3.0, visits=2), 40_000_000),
    (Resolution(cell=10.0, speed=0.4, macro=7, jitter=4, weight=1.2, visits=6, patience=25), 40_000_000),
)
"""Searches for a first run, with their ticks; then over again with other seeds."""

VARY = (
    Resolution(cell=8.0, speed=0.5, macro=8, weight=1.0),
    Resolution(cell=6.0, speed=0.35, macro=6, weight=1.0, slack=0.2, off_guide=0.3),
    Resolution(cell=8.0, speed=0.4, macro=6, jitter=3, weight=1.1),
    Resolution(cell=12.0, speed=0.4, macro=7, weight=1.0),
    Resolution(cell=10.0, speed=0.35, macro=9, weight=1.2),
    Resolution(cell=6.0, speed=0.5, macro=10, weight=1.1),
)
"""Searches for other routes. Those with ``slack`` (part of the best run's ticks) are guided by the search before."""
VARY_TICKS = 12_000_000

COOLING = (6.0, 4.0, 2.5, 1.2, 0.4)
"""Temperatures of a local search, one after the other."""


@dataclass(frozen=True)
class Shares:
    """How a solver's work is divided: until which part of all work it looks for other routes."""

    vary_until: float = 0.4
    first_climb: int = 8_000_000
    long_climb: int = 30_000_000


def find_order(job: int) -> Iterator[tuple[Resolution, int, int]]:
    """Resolution, ticks and seed number of one search for a first run after the other; each job begins elsewhere."""
    turn = job
    while True:
        resolution, ticks = FIND[turn % len(FIND)]
        yield resolution, ticks, turn
        turn += 1 if job == 0 else 3
