"""The "normal" grid, for comparison with the loose one: each object in every cell that its box touches.

An object has up to four entries, 4 * slot … 4 * slot + 3, in doubly linked lists of entries. A query looks at the up to
four cells that its own box touches, and must not count an object twice: a stamp on each object tells.
"""

from __future__ import annotations

from typing import Any

from benchmarks.arena import RADIUS, REACH, cell_of, link, unlink
from ninja_game.sim.schema.declare import fast, kernel


@fast
def file_box(columns: int, x: Any, y: Any, heads: Any, nexts: Any, prevs: Any, low: Any, high: Any, slot: int) -> None:
    """Enter an object in the cells that its box touches."""
    low[slot] = cell_of(columns, x[slot] - RADIUS, y[slot] - RADIUS)
    high[slot] = cell_of(columns, x[slot] + RADIUS, y[slot] + RADIUS)
    width = (high[slot] - low[slot]) % (columns + 2)
    entry = 4 * slot
    row = low[slot]
    while row <= high[slot]:
        for cell in range(row, row + width + 1):
            link(heads, nexts, prevs, entry, cell)
            entry += 1
        row += columns + 2


@fast
def unfile_box(columns: int, heads: Any, nexts: Any, prevs: Any, low: Any, high: Any, slot: int) -> None:
    """Take an object out of all its cells."""
    width = (high[slot] - low[slot]) % (columns + 2)
    entry = 4 * slot
    row = low[slot]
    while row <= high[slot]:
        for cell in range(row, row + width + 1):
            unlink(heads, nexts, prevs, entry, cell)
            entry += 1
        row += columns + 2


@kernel
def normal_build(columns: int, x: Any, y: Any, heads: Any, nexts: Any, prevs: Any, low: Any, high: Any) -> None:
    for slot in range(1, len(x)):
        file_box(columns, x, y, heads, nexts, prevs, low, high, slot)


@kernel
def normal_move(
    columns: int, x: Any, y: Any, dx: Any, dy: Any, heads: Any, nexts: Any, prevs: Any, low: Any, high: Any, rounds: int
) -> int:
    """Move all objects back and forth and file again those whose cells changed; how many that were."""
    changed = 0
    for number in range(rounds):
        sign = 1.0 - 2.0 * (number & 1)
        for slot in range(1, len(x)):
            x[slot] += sign * dx[slot]
            y[slot] += sign * dy[slot]
            first = cell_of(columns, x[slot] - RADIUS, y[slot] - RADIUS)
            last = cell_of(columns, x[slot] + RADIUS, y[slot] + RADIUS)
            if first != low[slot] or last != high[slot]:
                unfile_box(columns, heads, nexts, prevs, low, high, slot)
                file_box(columns, x, y, heads, nexts, prevs, low, high, slot)
                changed += 1
    return changed


@kernel
def normal_queries(columns: int, x: Any, y: Any, heads: Any, nexts: Any, stamps: Any, qx: Any, qy: Any) -> int:
    """Hits of all queries, each by the cells that it touches."""
    count = 0
    for k in range(len(qx)):
        first = cell_of(columns, qx[k] - RADIUS, qy[k] - RADIUS)
        last = cell_of(columns, qx[k] + RADIUS, qy[k] + RADIUS)
        width = (last - first) % (columns + 2)
        stamps[0] += 1
        row = first
        while row <= last:
            for cell in range(row, row + width + 1):
                entry = heads[cell]
                while entry:
                    slot = entry >> 2
                    if stamps[slot] != stamps[0]:
                        stamps[slot] = stamps[0]
                        dx = x[slot] - qx[k]
                        dy = y[slot] - qy[k]
                        if dx * dx + dy * dy < REACH * REACH:
                            count += 1
                    entry = nexts[entry]
            row += columns + 2
    return count
