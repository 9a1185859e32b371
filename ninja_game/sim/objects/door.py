"""Doors: automatic, locked and trap doors change two edge states of one side, nothing else (objects.md §8.6-§8.7)."""

from __future__ import annotations

from math import sqrt

from ninja_game.sim.events import DOOR_CLOSED, DOOR_OPENED, LOCK_OPENED, TRAP_CLOSED, emit
from ninja_game.sim.grid import unfile
from ninja_game.sim.memory import fast
from ninja_game.sim.rules import AUTOMATIC_DOOR_OPEN, AUTOMATIC_DOOR_RADIUS, DOOR_SWITCH_RADIUS, RADIUS, SOLID
from ninja_game.sim.schedule import end_update, start_update
from ninja_game.sim.schema import Door, World
from ninja_game.sim.states import AUTOMATIC, LOCKED


@fast
def write_edges(w: World, o: Door, closed: bool) -> None:
    """Write both states: solid, or what was there when the door was made. Of several doors on a side the last wins."""
    if o.edge_1:
        w.edges[o.edge_1] = SOLID if closed else o.stored_1
    if o.edge_2:
        w.edges[o.edge_2] = SOLID if closed else o.stored_2


@fast
def touch_door(w: World, o: Door, slot: int) -> None:
    """Disc contact at the switch; of an automatic door at its middle."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    radius = AUTOMATIC_DOOR_RADIUS if o.mechanism == AUTOMATIC else DOOR_SWITCH_RADIUS
    if not sqrt(dx * dx + dy * dy) < radius + RADIUS:
        return
    o.counter = 0
    if o.mechanism == AUTOMATIC:
        if not o.spent:
            o.spent = 1
            write_edges(w, o, False)
            start_update(w, o, slot)
            emit(w, DOOR_OPENED, slot, o.x, o.y, 0.0, 0.0)
    elif o.mechanism == LOCKED:
        if not o.spent:
            o.spent = 1
            write_edges(w, o, False)
            emit(w, LOCK_OPENED, slot, o.x, o.y, 0.0, 0.0)
    else:
        o.spent = 1
        write_edges(w, o, True)
        unfile(w, o)
        emit(w, TRAP_CLOSED, slot, o.x, o.y, 0.0, 0.0)


@fast
def update_door(w: World, o: Door, slot: int) -> None:
    """An open automatic door closes in the sixth update after the last contact, also with something in it."""
    o.counter += 1
    if o.counter > AUTOMATIC_DOOR_OPEN:
        end_update(w, o, slot)
        o.spent = 0
        write_edges(w, o, True)
        emit(w, DOOR_CLOSED, slot, o.x, o.y, 0.0, 0.0)
