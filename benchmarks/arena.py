"""An arena of any size, for measuring what the game's grid of 33 x 25 cells cannot show: cost against numbers.

The loose grid is the game's (`ninja_game/sim/grid.py`): each object in the doubly linked list of the cell that holds
its centre, a query looks at nine. Beside it, written for the comparison, the "normal" grid: each object in every cell
that its box touches, a query looks at the cells that it touches itself. And no grid at all.

Cells have side 1, objects are circles of radius RADIUS; index 0 is nobody, and a ring of empty cells surrounds the
``columns`` x ``columns`` that are used. The functions run interpreted or compiled, like the rules.
"""

from __future__ import annotations

from typing import Any

from ninja_game.sim.schema.declare import fast, kernel

RADIUS = 0.4
REACH = 0.8  # two circles touch when their centres are nearer


# --- the loose grid ---


@fast
def cell_of(columns: int, x: float, y: float) -> int:
    """The cell that holds a point of the arena."""
    return (int(y) + 1) * (columns + 2) + int(x) + 1


@fast
def link(heads: Any, nexts: Any, prevs: Any, slot: int, cell: int) -> None:
    """Insert at the head of a cell's list."""
    head = heads[cell]
    prevs[slot] = 0
    nexts[slot] = head
    if head:
        prevs[head] = slot
    heads[cell] = slot


@fast
def unlink(heads: Any, nexts: Any, prevs: Any, slot: int, cell: int) -> None:
    if prevs[slot]:
        nexts[prevs[slot]] = nexts[slot]
    else:
        heads[cell] = nexts[slot]
    if nexts[slot]:
        prevs[nexts[slot]] = prevs[slot]


@kernel
def loose_build(columns: int, x: Any, y: Any, heads: Any, nexts: Any, prevs: Any, cells: Any) -> None:
    for slot in range(1, len(x)):
        cells[slot] = cell_of(columns, x[slot], y[slot])
        link(heads, nexts, prevs, slot, cells[slot])


@kernel
def loose_move(
    columns: int, x: Any, y: Any, dx: Any, dy: Any, heads: Any, nexts: Any, prevs: Any, cells: Any, rounds: int
) -> int:
    """Move all objects back and forth and file again those whose cell changed; how many that were."""
    changed = 0
    for number in range(rounds):
        sign = 1.0 - 2.0 * (number & 1)
        for slot in range(1, len(x)):
            x[slot] += sign * dx[slot]
            y[slot] += sign * dy[slot]
            cell = cell_of(columns, x[slot], y[slot])
            if cell != cells[slot]:
                unlink(heads, nexts, prevs, slot, cells[slot])
                link(heads, nexts, prevs, slot, cell)
                cells[slot] = cell
                changed += 1
    return changed


@fast
def touched(x: Any, y: Any, nexts: Any, slot: int, qx: float, qy: float) -> int:
    """How many of a list, from ``slot`` on, touch the circle at (qx, qy)."""
    count = 0
    while slot:
        dx = x[slot] - qx
        dy = y[slot] - qy
        if dx * dx + dy * dy < REACH * REACH:
            count += 1
        slot = nexts[slot]
    return count


@fast
def nine_cells(columns: int, x: Any, y: Any, heads: Any, nexts: Any, qx: float, qy: float) -> int:
    """How many objects touch the circle at (qx, qy): its own cell and the eight around it."""
    cell = cell_of(columns, qx, qy)
    count = 0
    for row in range(-1, 2):
        for column in range(-1, 2):
            count += touched(x, y, nexts, heads[cell + row * (columns + 2) + column], qx, qy)
    return count


@kernel
def loose_queries(columns: int, x: Any, y: Any, heads: Any, nexts: Any, qx: Any, qy: Any) -> int:
    """Hits of all queries by nine cells."""
    count = 0
    for k in range(len(qx)):
        count += nine_cells(columns, x, y, heads, nexts, qx[k], qy[k])
    return count


# --- no grid ---


@kernel
def brute_queries(x: Any, y: Any, qx: Any, qy: Any) -> int:
    """Hits of all queries by asking every object."""
    count = 0
    for k in range(len(qx)):
        for slot in range(1, len(x)):
            dx = x[slot] - qx[k]
            dy = y[slot] - qy[k]
            if dx * dx + dy * dy < REACH * REACH:
                count += 1
    return count


@kernel
def brute_pairs(x: Any, y: Any, found: Any) -> int:
    """Touching pairs among all n (n - 1) / 2; as many as fit are written to ``found`` (pairs x 2)."""
    count = 0
    for first in range(1, len(x)):
        for second in range(first + 1, len(x)):
            dx = x[first] - x[second]
            dy = y[first] - y[second]
            if dx * dx + dy * dy < REACH * REACH:
                if count < len(found):
                    found[count, 0] = first
                    found[count, 1] = second
                count += 1
    return count


# --- all pairs by five cells ---


@fast
def pairs_with(x: Any, y: Any, nexts: Any, first: int, second: int, found: Any, count: int) -> int:
    """Note the pairs of ``first`` with a list from ``second`` on; the new count."""
    while second:
        dx = x[first] - x[second]
        dy = y[first] - y[second]
        if dx * dx + dy * dy < REACH * REACH:
            if count < len(found):
                found[count, 0] = first
                found[count, 1] = second
            count += 1
        second = nexts[second]
    return count


@kernel
def five_cell_pairs(columns: int, x: Any, y: Any, heads: Any, nexts: Any, cells: Any, found: Any) -> int:
    """Touching pairs, each exactly once, as ``brute_pairs``.

    Each object asks those behind it in its own list and all of four neighbours: right, and the three below. A pair in
    two cells is found from one of them only, since of two opposite neighbours one is asked (tutorial, section 3).
    """
    count = 0
    below = columns + 2
    for first in range(1, len(x)):
        cell = cells[first]
        count = pairs_with(x, y, nexts, first, nexts[first], found, count)
        count = pairs_with(x, y, nexts, first, heads[cell + 1], found, count)
        for neighbour in range(cell + below - 1, cell + below + 2):
            count = pairs_with(x, y, nexts, first, heads[neighbour], found, count)
    return count


# --- bullets ---


@kernel
def bullets(
    columns: int, x: Any, y: Any, heads: Any, nexts: Any, prevs: Any, cells: Any, vx: Any, vy: Any, first: int,
    filed: int, rounds: int,
) -> int:  # fmt: skip
    """Fly the objects from slot ``first`` on, back and forth, each asking nine cells what it hits; how many hits.

    ``filed``: they are in the grid themselves and are filed again; else they only read it.
    """
    hits = 0
    for number in range(rounds):
        sign = 1.0 - 2.0 * (number & 1)
        for slot in range(first, len(x)):
            x[slot] += sign * vx[slot]
            y[slot] += sign * vy[slot]
            if filed:
                cell = cell_of(columns, x[slot], y[slot])
                if cell != cells[slot]:
                    unlink(heads, nexts, prevs, slot, cells[slot])
                    link(heads, nexts, prevs, slot, cell)
                    cells[slot] = cell
            hits += nine_cells(columns, x, y, heads, nexts, x[slot], y[slot])
    return hits
