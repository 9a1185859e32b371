"""Floor guard (objects.md §8.10): runs to the end of its corridor when the ninja is on its row."""

from __future__ import annotations

from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, COLUMN, ROW, UNDEFINED_ID
from ninja_game.sim.death import zap
from ninja_game.sim.events import GUARD_STARTED, emit
from ninja_game.sim.grid import cell_at, grid_insert, grid_move
from ninja_game.sim.kinds import INERT
from ninja_game.sim.rules import DOWN, GRID_COLUMNS, GUARD_RADIUS, GUARD_SPEED, HALF, SOLID
from ninja_game.sim.schedule import start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import FloorGuard
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import GUARD_CHASE, GUARD_IDLE


@fast
def is_empty_for_guard(tiles: TileMap, cell: int) -> bool:
    """Whether a floor guard's scan passes a cell: tile ids above 0 stop it, a malformed id below 0 does not."""
    return tiles.ids[cell] == 0 or tiles.ids[cell] == UNDEFINED_ID


@fast
def create_guard(tiles: TileMap, w: World, o: FloorGuard) -> None:
    """Scan the corridor, with the floor edges as they are at this point of loading, and the sight range along the row.

    The original hangs while it loads a guard in the first or last column or outside the grid; here that guard is inert.
    """
    cell = cell_at(o.x, o.y)
    if cell == 0 or COLUMN[cell] == 0 or COLUMN[cell] == GRID_COLUMNS - 1:
        o.kind = INERT
        return
    grid_insert(w, o)
    start_update(w, o)
    o.facing = 1.0
    o.y = CENTRE_Y[cell] + HALF - GUARD_RADIUS
    scan = cell + 1
    while is_empty_for_guard(tiles, scan) and w.edges[4 * scan + DOWN] == SOLID:
        scan += 1
    o.high_x = CENTRE_X[scan] - HALF - GUARD_RADIUS
    scan = cell
    while is_empty_for_guard(tiles, scan) and w.edges[4 * scan + DOWN] == SOLID:
        scan -= 1
    o.low_x = CENTRE_X[scan] + HALF + GUARD_RADIUS
    scan = cell + 1
    while is_empty_for_guard(tiles, scan):
        scan += 1
    o.high = COLUMN[scan - 1]
    scan = cell - 1
    while is_empty_for_guard(tiles, scan):
        scan -= 1
    o.low = COLUMN[scan + 1]


@fast
def update_guard(w: World, o: FloorGuard) -> None:
    """Idle: look along the row and start in the next tick. Chase: always run to the end of the corridor."""
    if o.routine == GUARD_CHASE:
        chase_to_end(w, o)
        return
    cell = w.ninja.cell
    if ROW[cell] != ROW[o.cell]:
        return
    column = COLUMN[cell]
    if o.low <= column <= o.high and column != COLUMN[o.cell]:
        o.facing = -1.0 if column < COLUMN[o.cell] else 1.0
        o.routine = GUARD_CHASE
        emit(w, GUARD_STARTED, o.slot, o.x, o.y, o.facing, 0.0)


@fast
def chase_to_end(w: World, o: FloorGuard) -> None:
    """Move one step. Quirk: a guard more than a step outside its corridor never stops: it runs through walls."""
    goal = o.low_x if o.facing < 0.0 else o.high_x
    if abs(goal - o.x) < GUARD_SPEED:
        o.x = goal
        o.routine = GUARD_IDLE
    else:
        o.x = o.x + o.facing * GUARD_SPEED
    grid_move(w, o)


@fast
def touch_guard(w: World, o: FloorGuard) -> None:
    """Disc contact: kills, whether it runs or not."""
    zap(w, o, GUARD_RADIUS)
