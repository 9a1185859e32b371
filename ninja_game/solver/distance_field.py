"""How far it is to a place, in ticks, from anywhere in a level: a shortest-path field over points 6 px apart.

The field knows walls, mines, doors and the sides of one-way platforms, but nothing of gravity or jumps: it is a
guide, optimistic on the whole, not a promise.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.memory.declare import entry_point, fast

SPACING = 6.0
"""Px between points; cell sides (multiples of 24 px) lie on points, so that closing them closes a door."""
ACROSS = 133
DOWN = 101
POINTS = ACROSS * DOWN

CLEARANCE = 9.0
"""Px; a point is free if a circle of this radius about it is. A little less than the ninja, which slides along."""

UNREACHED = 1.0e9
MINE_COST = 12.0
"""How many times longer a step beside a mine counts: to be avoided, not impossible."""

RING_X = [1.0, 0.866, 0.5, 0.0, -0.5, -0.866, -1.0, -0.866, -0.5, 0.0, 0.5, 0.866]
RING_Y = [0.0, 0.5, 0.866, 1.0, 0.866, 0.5, 0.0, -0.5, -0.866, -1.0, -0.866, -0.5]

# Moves to the eight neighbours and what they cost (ticks): running and falling are faster than climbing.
MOVE_X = [1, 1, 0, -1, -1, -1, 0, 1]
MOVE_Y = [0, 1, 1, 1, 0, -1, -1, -1]
MOVE_TICKS = [1.45, 1.85, 1.2, 1.85, 1.45, 2.3, 1.9, 2.3]

Field = NDArray[np.float32]
Costs = NDArray[np.float32]
Blocks = NDArray[np.uint8]


@entry_point
def free_points(levels: Any, costs: Costs) -> None:
    """Set the cost factor of every point: 1 where the ninja fits among the tiles, 0 where it does not."""
    level = levels[0]
    for point in range(POINTS):
        x = SPACING * (point % ACROSS)
        y = SPACING * (point // ACROSS)
        free = 24.0 < x < 768.0 and 24.0 < y < 576.0 and not solid_at(level, x, y)
        if free:
            for k in range(12):
                if solid_at(level, x + CLEARANCE * RING_X[k], y + CLEARANCE * RING_Y[k]):
                    free = False
                    break
        costs[point] = 1.0 if free else 0.0


@entry_point
def spread(costs: Costs, blocked: Blocks, field: Field, queue: NDArray[np.int32], waiting: Blocks) -> None:
    """Lower ``field`` (ticks, UNREACHED where unknown) to the shortest way to the points that are set already.

    ``costs``: factor of a step onto a point, 0: impassable. ``blocked``: bit k of a point forbids its move k.
    ``queue``: room for POINTS + 1 indices.
    """
    room = POINTS + 1
    head = 0
    tail = 0
    for point in range(POINTS):
        waiting[point] = 0
        if field[point] < UNREACHED:
            queue[tail] = point
            tail += 1
            waiting[point] = 1
    while head != tail:
        point = queue[head]
        head = (head + 1) % room
        waiting[point] = 0
        column = point % ACROSS
        row = point // ACROSS
        for k in range(8):
            # The field spreads against the move: from where the move ends to where it starts.
            i = column - MOVE_X[k]
            j = row - MOVE_Y[k]
            if not (0 <= i < ACROSS and 0 <= j < DOWN):
                continue
            start = j * ACROSS + i
            if costs[start] == 0.0 or (blocked[start] >> k) & 1:
                continue
            value = np.float32(float(field[point]) + MOVE_TICKS[k] * float(costs[start]))
            if value < field[start] - np.float32(1e-3):
                field[start] = value
                if not waiting[start]:
                    waiting[start] = 1
                    queue[tail] = start
                    tail = (tail + 1) % room


@fast
def point_at(x: float, y: float) -> int:
    """Index of the point nearest to a place; places outside the world count as at its rim."""
    i = int((x + 3.0) / SPACING) if x > 0.0 else 0
    j = int((y + 3.0) / SPACING) if y > 0.0 else 0
    i = min(i, ACROSS - 1)
    j = min(j, DOWN - 1)
    return j * ACROSS + i


def widened(field: Field, steps: int = 3) -> Field:
    """The field with values also for impassable points beside passable ones (the ninja may rest between points)."""
    grid = field.reshape(DOWN, ACROSS).copy()
    for _ in range(steps):
        padded = np.pad(grid, 1, constant_values=UNREACHED)
        around = [padded[1 + dy : 1 + dy + DOWN, 1 + dx : 1 + dx + ACROSS] for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        nearest = np.minimum.reduce(around) + np.float32(2.0)
        grid = np.where(grid >= UNREACHED, np.minimum(nearest, UNREACHED), grid)
    return grid.reshape(-1)


def points_about(x: float, y: float, radius: float) -> list[int]:
    """All points nearer to a place than a radius (px)."""
    reach = int(radius / SPACING) + 1
    found = set()
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            point = point_at(x + i * SPACING, y + j * SPACING)
            dx, dy = SPACING * (point % ACROSS) - x, SPACING * (point // ACROSS) - y
            if dx * dx + dy * dy < radius * radius:
                found.add(point)
    return sorted(found)
