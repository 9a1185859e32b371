"""Parts of the game's own tick, called alone and often: the ninja's query, and rays; beside them the naive ways."""

from __future__ import annotations

from typing import Any

from ninja_game.sim.collision.ray_shapes import ray_tile
from ninja_game.sim.collision.rays import cast_ray
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import cell_at
from ninja_game.sim.objects.dispatch import touch, touch_objects
from ninja_game.sim.rules import DOWN, RIGHT, SOLID, STRIDE
from ninja_game.sim.schema.declare import kernel
from ninja_game.sim.world import step


@kernel
def count_ticks(maps: Any, worlds: Any, index: int, inputs: Any) -> int:
    """Run world ``index`` in level ``index`` to its end or that of ``inputs``, without a record; the ticks run."""
    tiles = maps[index]
    w = worlds[index]
    for tick in range(len(inputs)):
        step(tiles, w, int(inputs[tick]))
        if w.outcome:
            return tick + 1
    return len(inputs)


@kernel
def query_nine_cells(worlds: Any, rounds: int) -> int:
    """The ninja's collision query, again and again."""
    w = worlds[0]
    for _ in range(rounds):
        touch_objects(w)
    return int(w.gold)


@kernel
def query_every_thing(worlds: Any, rounds: int) -> int:
    """The same contacts without a grid: every filed thing is asked."""
    w = worlds[0]
    for _ in range(rounds):
        for slot in range(1, w.slots_used):
            if w.objects[slot].in_grid:
                touch(w, w.objects[slot])
    return int(w.gold)


@kernel
def cast_along_cells(maps: Any, worlds: Any, x: float, y: float, dx: float, dy: float, rounds: int) -> float:
    """The game's ray: from cell to cell by their edges; where it stops, px to the right of its start."""
    total = 0.0
    for _ in range(rounds):
        stopped, stop_x, _y = cast_ray(maps[0], worlds[0], x, y, dx, dy)
        if stopped:
            total += stop_x - x
    return total / rounds


@kernel
def cast_through_box(
    maps: Any, worlds: Any, x: float, y: float, dx: float, dy: float, length: float, rounds: int
) -> float:
    """The naive ray: every cell of the box around it is asked for tile and edges, the nearest hit counts."""
    total = 0.0
    tiles = maps[0]
    edges = worlds[0].edges
    for _ in range(rounds):
        first = cell_at(x, y)
        last = cell_at(x + dx * length, y + dy * length)
        width = (last - first) % STRIDE
        nearest = length
        row = first
        while row <= last:
            for cell in range(row, row + width + 1):
                hit, hit_x, hit_y = ray_tile(tiles.ids[cell], CENTRE_X[cell], CENTRE_Y[cell], x, y, dx, dy)
                if hit:
                    nearest = min(nearest, (hit_x - x) * dx + (hit_y - y) * dy)
                right = CENTRE_X[cell] + 12.0
                below = CENTRE_Y[cell] + 12.0
                if edges[4 * cell + RIGHT] == SOLID:
                    t = (right - x) / dx
                    if t >= 0.0 and below - 24.0 <= y + t * dy <= below:
                        nearest = min(nearest, t)
                if edges[4 * cell + DOWN] == SOLID:
                    t = (below - y) / dy
                    if t >= 0.0 and right - 24.0 <= x + t * dx <= right:
                        nearest = min(nearest, t)
            row += STRIDE
        total += nearest * dx
    return total / rounds
