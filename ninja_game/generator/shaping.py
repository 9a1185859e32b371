"""Tiles for solid cells: stairs become slopes, other corners slopes or curves, all of a level in one style."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random
from typing import NamedTuple

from ninja_game.generator.scene import Board, Cell, inside
from ninja_game.sim.level import COLUMNS, ROWS

CORNERS = (-1, -1), (1, -1), (-1, 1), (1, 1)
"""Where a corner points to: up left, up right, down left, down right."""

OUTER = {"slope": "sawq", "round": "KJIU"}
"""Tiles of a stone's outer corner, in the order of ``CORNERS``."""
INNER = {"slope": "qwas", "round": "uijk"}
"""Tiles in a hollow corner."""
LONG = {"flat": ("fF", "dD", "rR", "eE"), "steep": ("hH", "gG", "yY", "tT")}
"""Tiles of a long slope at an outer corner: the tip, the one behind it."""


class Style(NamedTuple):
    """What becomes of outer corners above and below, and of hollow ones; "": nothing. ``ends``: of thin platforms."""

    above: str
    below: str
    hollow_above: str
    hollow_below: str
    ends: bool


STYLES = (
    Style("", "slope", "slope", "slope", True),
    Style("slope", "slope", "slope", "", True),
    Style("round", "round", "round", "round", False),
    Style("slope", "slope", "slope", "slope", False),
    Style("round", "slope", "", "round", True),
    Style("flat", "slope", "slope", "slope", True),
    Style("slope", "steep", "round", "round", True),
    Style("steep", "flat", "slope", "", True),
    Style("", "round", "round", "round", True),
    Style("flat", "flat", "slope", "slope", True),
)


def shaped(board: Board, style: Style) -> dict[Cell, str]:
    """The tile of every cell that is not empty."""
    tiles = dict.fromkeys(board.cells, "#")
    for cell in sorted(board.cells):
        tiles.update(_outer(board, cell, style))
    for cell in sorted((c, r) for c in range(1, COLUMNS + 1) for r in range(1, ROWS + 1)):
        if cell not in tiles:
            tiles.update(_inner(board, cell, style, tiles))
    return tiles


def _outer(board: Board, cell: Cell, style: Style) -> Iterator[tuple[Cell, str]]:
    """The tiles of a cell that is an outer corner or the end of a thin platform."""
    column, row = cell
    if style.ends and not board.solid((column, row - 1)) and not board.solid((column, row + 1)):
        for dx, tile in ((-1, "w"), (1, "q")):
            long = board.solid((column - dx, row)) and board.solid((column - 2 * dx, row))
            if long and not board.solid((column + dx, row)):
                yield cell, tile
    for number, (dx, dy) in enumerate(CORNERS):
        open_ = not (board.solid((column + dx, row)) or board.solid((column, row + dy)))
        backed = board.solid((column - dx, row)) and board.solid((column, row - dy))
        stair = board.solid((column + dx, row - dy)) or board.solid((column - dx, row + dy))
        shape = "slope" if stair else style.above if dy < 0 else style.below
        if not (open_ and backed and shape) or board.solid((column + dx, row + dy)):
            continue
        if shape in OUTER:
            yield cell, OUTER[shape][number]
            continue
        thin, thick = tuple(LONG[shape][number])
        second = (column - dx, row) if shape == "flat" else (column, row - dy)
        # Room for the slope of the other end.
        beyond = [(column - k * dx, row) if shape == "flat" else (column, row - k * dy) for k in (2, 3)]
        # Where the next cell is not a plain side of the stone, a short slope.
        side = (second[0], row + dy) if shape == "flat" else (column + dx, second[1])
        under = (second[0], row - dy) if shape == "flat" else (column - dx, second[1])
        if inside(second) and all(map(board.solid, beyond)) and board.solid(under) and not board.solid(side):
            yield from ((cell, thin), (second, thick))
        else:
            yield cell, OUTER["slope"][number]


def _inner(board: Board, cell: Cell, style: Style, tiles: dict[Cell, str]) -> Iterator[tuple[Cell, str]]:
    """The tile that fills a hollow corner between full ones."""
    column, row = cell
    for number, (dx, dy) in enumerate(CORNERS):
        stair = not (board.solid((column + dx, row - dy)) and board.solid((column - dx, row + dy)))
        shape = "slope" if stair else style.hollow_above if dy < 0 else style.hollow_below
        beside = (column + dx, row), (column, row + dy)
        full = all(tiles.get(each) == "#" or not inside(each) for each in beside)
        room = not (board.solid((column - dx, row)) or board.solid((column, row - dy)))
        if shape and full and room:
            yield cell, INNER[shape][number]


def chosen_style(board: Board, rng: Random, least: int, most: int) -> dict[Cell, str] | None:
    """Tiles in a style by which ``least`` to ``most`` of them have a shape; None if no style does."""
    styles = list(STYLES)
    rng.shuffle(styles)
    for style in styles:
        tiles = shaped(board, style)
        if least <= sum(tile != "#" for tile in tiles.values()) <= most:
            return tiles
    return None
