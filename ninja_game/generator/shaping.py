"""Tiles for painted rock: for each cell the tile that covers the paint best and fits the tiles beside it."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import CELL, STRIDE
from ninja_game.sim.schema.world_fields import TileMap

SAMPLES = 8  # samples per cell, across and down
_FULL = TILE_CHARS.index("#")
_UNUSUAL_COSTS = {".": 0, "#": 0, **dict.fromkeys('_]"[', 3), **dict.fromkeys("jkiuJKIU", 4)}
COSTS = np.array([_UNUSUAL_COSTS.get(tile, 1) for tile in TILE_CHARS])
"""Extra cost of each tile, in samples of a cell that it covers wrongly."""
AGREE = 1  # cost of a sample of a side that differs from the tile beside it
_ROUNDS = 12  # passes over all cells

Ink = NDArray[np.bool_]  # painted rock, one value per sample: (rows * SAMPLES, columns * SAMPLES)


@cache
def masks() -> Ink:
    """The samples of a cell that each tile covers: (tile, row, column)."""
    at = [(k + 0.5) * CELL / SAMPLES for k in range(SAMPLES)]
    tiles = TileMap()
    grids = []
    for tiles.ids[STRIDE + 1] in range(len(TILE_CHARS)):
        grids.append([[solid_at(tiles, x, y) for x in at] for y in at])
    return np.array(grids)


@cache
def _costs() -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Count samples that differ if one tile is above, or to the left of, another: (this one, the other)."""
    mask = masks()
    below = np.abs(mask[:, None, -1].astype(int) - mask[None, :, 0]).sum(2)
    right = np.abs(mask[:, None, :, -1].astype(int) - mask[None, :, :, 0]).sum(2)
    return below * AGREE, right * AGREE


def fitted(ink: Ink, *, even: bool) -> NDArray[np.int64]:
    """The number of the tile of each cell, (rows, columns); ``even``: mirrored at the middle column."""
    cells = ink.reshape(ROWS, SAMPLES, COLUMNS, SAMPLES).swapaxes(1, 2)[:, :, None]
    costs = (cells != masks()).sum((3, 4)) + COSTS
    costs[:, COLUMNS // 2, even * (masks() != masks()[:, :, ::-1]).any((1, 2))] += SAMPLES * SAMPLES
    below, right = _costs()
    best = np.full((ROWS + 2, COLUMNS + 2), _FULL)
    best[1:-1, 1:-1] = costs.argmin(2)
    odd = np.indices((ROWS, COLUMNS)).sum(0) % 2
    for number in range(_ROUNDS):  # alternating, like the squares of a chessboard
        sides = below[best[:-2, 1:-1]] + below.T[best[2:, 1:-1]]
        sides += right[best[1:-1, :-2]] + right.T[best[1:-1, 2:]]
        best[1:-1, 1:-1] = np.where(odd == number % 2, (costs + sides).argmin(2), best[1:-1, 1:-1])
    return best[1:-1, 1:-1]


def shaped(ink: Ink, *, even: bool) -> dict[tuple[int, int], str]:
    """The tile of every cell that is not empty; paint that is mirrored gives mirrored tiles."""
    tiles, other = fitted(ink, even=even), fitted(ink[:, ::-1], even=even)
    by_mask = {mask.tobytes(): tile for tile, mask in enumerate(masks())}
    turned = [by_mask[mask[:, ::-1].tobytes()] for mask in masks()]
    half = COLUMNS // 2 + 1
    tiles[:, half:] = np.array(turned)[other[:, ::-1]][:, half:]
    return {(c + 1, r + 1): TILE_CHARS[tiles[r, c]] for r in range(ROWS) for c in range(COLUMNS) if tiles[r, c]}
