"""Slopes that set themselves: where rock that is drawn has a corner or steps, its tiles become slopes."""

from __future__ import annotations

from ninja_game.editor.brush import EMPTY, FAMILIES, FULL, QUARTERS
from ninja_game.editor.draft import Cell, Draft, Tiles, changed_cells, is_inside

_SLOPES = {family.key: family.tiles for family in FAMILIES if family.key in "12367"}
_STEEP, _GENTLE = ("2", "6"), ("3", "7")
"""Families of the thin and the thick end of a slope of 67° and of 22°; "1": 45°."""
_SOFT = {FULL, *(tile for tiles in _SLOPES.values() for tile in tiles)}
"""Tiles that are rock whose shape is found; other ones stay as they are."""
_AIR = dict(zip(((1, 1), (-1, 1), (1, -1), (-1, -1)), range(len(QUARTERS)), strict=True))
"""The quarter of a slope by the sides, right or left and below or above, where it has air."""
_LONGEST = 4
"""Steps that are longer, or end on both sides farther apart, are all alike."""


def sloped(before: Draft, after: Draft) -> Draft:
    """The draft after a stroke of full or empty tiles, with slopes at corners of the rock near what changed.

    Steps of one cell become slopes of 45°, longer ones end in a slope of 22° or 67°; other corners are cut at 45°.
    """
    near = _around(changed_cells(before, after), _LONGEST - 1)
    tiles: Tiles = dict.fromkeys(near, FULL)
    for cell in _around(near, 1):
        if after.tile(cell) in _SOFT:
            tiles |= {place: tile for place, tile in _corner(after, cell).items() if place in near}
    return after.with_tiles({cell: tile for cell, tile in tiles.items() if after.tile(cell) in _SOFT})


def _around(cells: list[Cell] | set[Cell], reach: int) -> set[Cell]:
    steps = range(-reach, reach + 1)
    return {(x + i, y + j) for x, y in cells for i in steps for j in steps if is_inside((x + i, y + j))}


def _corner(draft: Draft, cell: Cell) -> Tiles:
    """The slope of a cell with air on two sides that meet, and the thick end behind it, if it has one."""
    column, row = cell

    def rock(i: int, j: int) -> bool:
        return draft.tile((column + i, row + j)) != EMPTY

    open_x, open_y = [i for i in (-1, 1) if not rock(i, 0)], [j for j in (-1, 1) if not rock(0, j)]
    if len(open_x) != 1 or len(open_y) != 1:
        return {}
    (dx,), (dy,) = open_x, open_y
    quarter = _AIR[dx, dy]
    # How many cells wide and high the step is that ends here: behind it the rock rises, or goes on, or ends (0).
    wide = next((n for n in range(1, _LONGEST) if rock(-dx * n, dy) and rock(-dx * n, 0)), _LONGEST)
    high = next((n for n in range(1, _LONGEST) if rock(dx, -dy * n) and rock(0, -dy * n)), _LONGEST)
    wide *= all(rock(-dx * n, 0) for n in range(1, wide))
    high *= all(rock(0, -dy * n) for n in range(1, high))
    if wide > high == 1:
        thin, thick, behind = *_GENTLE, (column - dx, row)
    elif high > wide == 1:
        thin, thick, behind = *_STEEP, (column, row - dy)
    else:
        return {cell: _SLOPES["1"][quarter]}
    return {cell: _SLOPES[thin][quarter], behind: _SLOPES[thick][quarter]}
