"""Lookup of cells, and the loose grid: an object is in the list of one cell only (world.md §1, objects.md §2.2)."""

from __future__ import annotations

from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import CELL, GRID_COLUMNS, GRID_ROWS, HALF, STRIDE, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Header
from ninja_game.sim.schema.world_fields import World

Point = tuple[float, float]  # x and y: px of the world or of a screen, or parts of cells

Cell = tuple[int, int]  # column 1…31, row 1…23; 0 and 32, 24 are the border


@fast
def cell_at(x: float, y: float) -> int:
    """The grid index of the cell that holds a point; 0 outside the world and for NaN.

    A point on the line between two cells belongs to the right or lower one.
    """
    if 0.0 <= x < WORLD_WIDTH and 0.0 <= y < WORLD_HEIGHT:
        return int(y / CELL) * STRIDE + int(x / CELL) + (STRIDE + 1)
    return 0


@fast
def cell_index(column: float, row: float) -> int:
    """The grid index of cell (column, row) of the full grid; 0 if there is none, e.g. for fractions."""
    if 0.0 <= column < GRID_COLUMNS and 0.0 <= row < GRID_ROWS:
        i = int(column)
        j = int(row)
        if i == column and j == row:
            return j * STRIDE + i + (STRIDE + 1)
    return 0


@fast
def link(w: World, o: Header, cell: int) -> None:
    """Insert an object at the head of a cell's list (newest first)."""
    o.cell = cell
    if cell:
        head = w.heads[cell]
        o.prev = 0
        o.next = head
        if head:
            w.objects[head].prev = o.slot
        w.heads[cell] = o.slot


@fast
def unlink(w: World, o: Header) -> None:
    """Take an object out of its cell's list and clear its next link: a walk that is at it then ends (objects.md §3)."""
    if o.cell:
        if o.prev:
            w.objects[o.prev].next = o.next
        else:
            w.heads[o.cell] = o.next
        if o.next:
            w.objects[o.next].prev = o.prev
    o.next = 0
    o.prev = 0


@fast
def grid_insert(w: World, o: Header) -> None:
    """Put an object into the list of the cell that holds its centre."""
    link(w, o, cell_at(o.x, o.y))
    o.in_grid = 1


@fast
def grid_remove(w: World, o: Header) -> None:
    """Take an object out of the grid, if it is in it."""
    if o.in_grid:
        unlink(w, o)
        o.in_grid = 0


@fast
def grid_move(w: World, o: Header) -> int:
    """Move an object to the list of its present cell; 1 if the cell changed. In the same cell it keeps its place."""
    # This repeats cell_at: drones call it every tick, and a call of cell_at would slow the plain memory by 3 %.
    x = o.x
    y = o.y
    cell = 0
    if 0.0 <= x < WORLD_WIDTH and 0.0 <= y < WORLD_HEIGHT:
        cell = int(y / CELL) * STRIDE + int(x / CELL) + (STRIDE + 1)
    if cell == o.cell:
        return 0
    unlink(w, o)
    link(w, o, cell)
    return 1


def is_inside(cell: Cell) -> bool:
    """Whether a cell belongs to the level; border cells do not."""
    return 1 <= cell[0] <= COLUMNS and 1 <= cell[1] <= ROWS


def cell_of(x: float, y: float) -> Cell:
    """Column and row of the cell that holds a point, px.

    >>> cell_of(24, 47.5)
    (1, 1)
    """
    return int(x // CELL), int(y // CELL)


def middle_of(cell: Cell) -> tuple[float, float]:
    """A cell's middle, px."""
    return CELL * cell[0] + HALF, CELL * cell[1] + HALF
