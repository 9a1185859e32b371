"""The cells of a level that is being made: what is solid, mirrored as it is drawn, and what follows from that."""

from __future__ import annotations

from collections.abc import Iterator

from ninja_game.sim.level import COLUMNS, ROWS

Cell = tuple[int, int]
"""Column 1…31, row 1…23."""

MIDDLE = (COLUMNS + 1) // 2


def mirrored(cell: Cell) -> Cell:
    """The cell on the other side of the middle column."""
    return COLUMNS + 1 - cell[0], cell[1]


def inside(cell: Cell) -> bool:
    """Whether a cell is one of the level, not of its border."""
    return 1 <= cell[0] <= COLUMNS and 1 <= cell[1] <= ROWS


class Board:
    """Solid cells. ``fill`` and ``clear`` do the same at the mirrored place, unless ``one_sided``."""

    def __init__(self) -> None:
        self.cells: set[Cell] = set()
        self.stones: dict[Cell, str] = {}  #: single tiles with a shape of their own

    def fill(self, column: int, row: int, width: int, height: int, *, one_sided: bool = False) -> None:
        """Make a rectangle solid."""
        self.cells |= set(_both(column, row, width, height, one_sided))

    def clear(self, column: int, row: int, width: int, height: int, *, one_sided: bool = False) -> None:
        """Make a rectangle empty."""
        self.cells -= set(_both(column, row, width, height, one_sided))

    def solid(self, cell: Cell) -> bool:
        """Whether a cell is solid; the border is."""
        return cell in self.cells or not inside(cell)

    def free(self, column: int, row: int, width: int, height: int) -> bool:
        """Whether a rectangle is empty."""
        return not any(self.solid(cell) for cell in _both(column, row, width, height, one_sided=True, outside=True))

    def pieces(self) -> list[list[Cell]]:
        """The connected groups of solid cells that do not touch the border, each sorted, in reading order."""
        left, found = set(self.cells), []
        for first in sorted(self.cells):
            if first in left:
                group = flood(first, left)
                left -= group
                if all(1 < c < COLUMNS and 1 < r < ROWS for c, r in group):
                    found.append(sorted(group))
        return found


def _both(
    column: int, row: int, width: int, height: int, one_sided: bool, outside: bool = False
) -> Iterator[Cell]:  # fmt: skip
    for cell in ((c, r) for c in range(column, column + width) for r in range(row, row + height)):
        if outside or inside(cell):
            yield cell
            if not one_sided:
                yield mirrored(cell)


def flood(first: Cell, within: set[Cell]) -> set[Cell]:
    """The cells of a set that are connected with one of them by their sides."""
    return set(steps_from(first, within))


def steps_from(first: Cell, within: set[Cell]) -> dict[Cell, int]:
    """How many steps from cell to cell of a set lead from one of them to each that can be reached."""
    steps, front = {first: 0}, [first]
    for cell in front:
        for there in neighbours(cell):
            if there in within and there not in steps:
                steps[there] = steps[cell] + 1
                front.append(there)
    return steps


def neighbours(cell: Cell) -> tuple[Cell, ...]:
    """The four cells beside a cell."""
    column, row = cell
    return (column + 1, row), (column, row + 1), (column - 1, row), (column, row - 1)
