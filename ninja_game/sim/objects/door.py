"""Automatic, locked and trap doors. A door changes two edge states of one side, nothing else (objects.md §8.6-§8.7)."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from ninja_game.sim.arithmetic import is_set
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, EXISTS
from ninja_game.sim.events import DOOR_CLOSED, DOOR_OPENED, LOCK_OPENED, TRAP_CLOSED, emit
from ninja_game.sim.grid import cell_index, grid_insert, grid_remove
from ninja_game.sim.rules import (
    AUTOMATIC_DOOR_OPEN,
    AUTOMATIC_DOOR_RADIUS,
    DOOR_SWITCH_RADIUS,
    DOWN,
    HALF,
    LEFT,
    RADIUS,
    RIGHT,
    SOLID,
    STRIDE,
    UP,
)
from ninja_game.sim.schedule import end_update, start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Door
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import AUTOMATIC, LOCKED, TRAP


@fast
def create_door(w: World, o: Door, values: Sequence[float]) -> None:
    """Look up the two edges, store their states, enter the grid, then close (a trap door stays open)."""
    vertical, trap, locked = values[2], values[3], values[6]
    column, row, column_offset, row_offset = values[4], values[5], values[7], values[8]
    cell_1 = cell_index(column + column_offset, row + row_offset)
    cell_2 = 0
    if cell_1:
        cell_2 = cell_1 + STRIDE if vertical == 1.0 else cell_1 + 1
        if not EXISTS[cell_2]:
            cell_2 = 0
    side_1 = DOWN if vertical == 1.0 else RIGHT
    side_2 = UP if vertical == 1.0 else LEFT
    if cell_1:
        o.stored_1 = w.edges[4 * cell_1 + side_1]
        # Quirk: an odd "vertical" flag stores the states of the right side but writes P1's lower and P2's upper edge.
        o.edge_1 = 4 * cell_1 + (RIGHT if vertical == 0.0 else DOWN)
    if cell_2:
        o.stored_2 = w.edges[4 * cell_2 + side_2]
        o.edge_2 = 4 * cell_2 + (LEFT if vertical == 0.0 else UP)
    o.mechanism = AUTOMATIC
    if is_set(locked):
        o.mechanism = LOCKED
    elif is_set(trap):
        o.mechanism = TRAP
    if o.mechanism == AUTOMATIC:
        o.x = 0.0
        o.y = 0.0
        if cell_1:
            o.x = CENTRE_X[cell_1] + (0.0 if vertical == 1.0 else HALF)
            o.y = CENTRE_Y[cell_1] + (HALF if vertical == 1.0 else 0.0)
    grid_insert(w, o)
    write_edges(w, o, o.mechanism != TRAP)


@fast
def write_edges(w: World, o: Door, closed: bool) -> None:
    """Write both states: solid, or those stored when the door was made. If doors share a side, the last one wins."""
    if o.edge_1:
        w.edges[o.edge_1] = SOLID if closed else o.stored_1
    if o.edge_2:
        w.edges[o.edge_2] = SOLID if closed else o.stored_2


@fast
def touch_door(w: World, o: Door) -> None:
    """Disc contact at the switch; at the middle of an automatic door."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    radius = AUTOMATIC_DOOR_RADIUS if o.mechanism == AUTOMATIC else DOOR_SWITCH_RADIUS
    if not sqrt(dx * dx + dy * dy) < radius + RADIUS:
        return
    o.counter = 0
    if o.mechanism == AUTOMATIC:
        if not o.switched:
            o.switched = 1
            write_edges(w, o, False)
            start_update(w, o)
            emit(w, DOOR_OPENED, o.slot, o.x, o.y, 0.0, 0.0)
    elif o.mechanism == LOCKED:
        if not o.switched:
            o.switched = 1
            write_edges(w, o, False)
            emit(w, LOCK_OPENED, o.slot, o.x, o.y, 0.0, 0.0)
    else:
        o.switched = 1
        write_edges(w, o, True)
        grid_remove(w, o)
        emit(w, TRAP_CLOSED, o.slot, o.x, o.y, 0.0, 0.0)


@fast
def update_door(w: World, o: Door) -> None:
    """Close an open automatic door in the sixth update after the last contact, even if the ninja is in it."""
    o.counter += 1
    if o.counter > AUTOMATIC_DOOR_OPEN:
        end_update(w, o)
        o.switched = 0
        write_edges(w, o, True)
        emit(w, DOOR_CLOSED, o.slot, o.x, o.y, 0.0, 0.0)
