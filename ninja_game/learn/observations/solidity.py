"""Where a level is solid, as pictures of points: what parts make their tables of."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.learn.observations.part import Setting
from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.memory.declare import entry_point
from ninja_game.sim.rules import GRID_COLUMNS, GRID_ROWS, WORLD_HEIGHT, WORLD_WIDTH

FINE = 8
"""Points across a cell by which distances are measured: their error is below 3 px, the points' distance."""


def solidity(
    setting: Setting, number: int, across: int, down: int, spacing: tuple[float, float] | None = None
) -> NDArray[np.uint8]:
    """A level in (down, across) points, each in the middle of its share of the world, or so many px apart; 1: solid."""
    points = np.zeros((down, across), np.uint8)
    wide, high = spacing or (WORLD_WIDTH / across, WORLD_HEIGHT / down)
    setting.kernel(mark_solid)(setting.maps, number, wide, high, points)
    return points


@entry_point
def mark_solid(maps: Any, number: int, wide: float, high: float, points: Any) -> None:
    """Mark the points that are solid, ``wide`` and ``high`` px apart."""
    for row in range(len(points)):
        for column in range(len(points[row])):
            if solid_at(maps[number], (column + 0.5) * wide, (row + 0.5) * high):
                points[row, column] = 1


def surface_distances(setting: Setting, number: int, reach: float) -> NDArray[np.float64]:
    """Of every cell (25, 33) how far its centre is from the nearest surface, px, at most ``reach``; within below 0.

    What is outside the world counts as solid.
    """
    spacing = WORLD_WIDTH / GRID_COLUMNS / FINE
    margin = int(reach / spacing)
    points = np.pad(solidity(setting, number, GRID_COLUMNS * FINE, GRID_ROWS * FINE), margin, constant_values=1)
    centres = solidity(setting, number, GRID_COLUMNS, GRID_ROWS)
    offsets = (np.arange(2 * margin) - margin + 0.5) * spacing
    far = np.sqrt(offsets * offsets + (offsets * offsets)[:, np.newaxis])
    distances = np.full((GRID_ROWS, GRID_COLUMNS), reach)
    for row, column in np.ndindex(*distances.shape):
        top, left = row * FINE + FINE // 2, column * FINE + FINE // 2
        within = centres[row, column]
        others = far[points[top : top + 2 * margin, left : left + 2 * margin] != within]
        nearest = min(reach, others.min()) if others.size else reach
        distances[row, column] = -nearest if within else nearest
    return distances
