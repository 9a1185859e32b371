"""A level at one moment of its editing."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

Cell = tuple[int, int]
"""Column 1…31, row 1…23."""

Tiles = dict[Cell, int]


@dataclass(frozen=True)
class Draft:
    """A level and what its file says about it. It never changes: every operation gives another draft."""

    level: Level
    name: str = ""
    author: str = ""
    comment: str = ""
    teaches: str = ""
    says: str = ""

    @property
    def objects(self) -> tuple[ObjectSpec, ...]:
        return self.level.objects

    def tile(self, cell: Cell) -> int:
        """The tile of a cell; a full one in the border."""
        return self.level.tile(*cell) if is_inside(cell) else 1

    def with_tiles(self, tiles: Tiles) -> Draft:
        """Other tiles in some cells; what lies outside the level is left out."""
        ids = list(self.level.tiles)
        for (column, row), tile in tiles.items():
            if is_inside((column, row)):
                ids[(column - 1) * ROWS + row - 1] = tile
        return replace(self, level=Level(tuple(ids), self.objects)) if tiles else self

    def with_objects(self, objects: tuple[ObjectSpec, ...]) -> Draft:
        return replace(self, level=Level(self.level.tiles, objects))


def changed_cells(before: Draft, after: Draft) -> list[Cell]:
    old, new = before.level.tiles, after.level.tiles
    changed = (index for index in range(COLUMNS * ROWS) if old[index] != new[index]) if old != new else ()
    return [(index // ROWS + 1, index % ROWS + 1) for index in changed]


def is_inside(cell: Cell) -> bool:
    """Whether a cell has a tile of the level's own: the border has not."""
    return 1 <= cell[0] <= COLUMNS and 1 <= cell[1] <= ROWS


def cell_of(x: float, y: float) -> Cell:
    """Column and row of the cell that holds a point, the border's 0 and 32, 24 included.

    >>> cell_of(24, 47.5)
    (1, 1)
    """
    return int(x // 24), int(y // 24)
