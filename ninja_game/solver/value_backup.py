"""What a search has learned: how many ticks it is from each place it knows to the exit.

The macros that were played link the entries of its table; values spread backwards over them from the exit. A finer
search takes the values as its estimates and so looks only where good runs pass.
"""

from __future__ import annotations

from typing import Any

from ninja_game.sim.memory.declare import entry_point

UNKNOWN = 1.0e9


@entry_point
def back_up_values(table: Any, links: Any, count: int, sweeps: int) -> int:
    """Set ``value`` of all entries to the least ticks to the exit over the first ``count`` links; the sweeps made.

    Places that count as the same are not quite the same, so values are estimates, on the whole too low.
    """
    for slot in range(len(table)):
        table[slot].value = UNKNOWN
    for sweep in range(sweeps):
        changed = False
        for index in range(count - 1, -1, -1):
            link = links[index]
            value = 0.0 + link.ticks
            if link.target >= 0:
                value += table[link.target].value
            if value < table[link.source].value - 0.5:
                table[link.source].value = value
                changed = True
        if not changed:
            return sweep + 1
    return sweeps
