"""The state of a world: what the rules read and write, and what a save-state holds.

Zeroed memory is a valid state: lists are linked by index through ``World.objects``; index 0 is no object, cell 0 no
cell. ``World`` has the events of the tick first, since a save-state leaves them out, and the objects last, since a
save-state copies only the used ones.
"""

from __future__ import annotations

from typing import Annotated

from ninja_game.sim.rules import GRID_CELLS
from ninja_game.sim.schema.declare import f8, i2, i4, struct, u1
from ninja_game.sim.schema.object_fields import Object

CAPACITY = 12_288
"""Slots for objects in a compiled world. All levels share it: another capacity would be another type to compile."""

MAX_EVENTS = 48
"""Most events kept per tick; the rest is dropped. Only a crowded death emits more, and no rule reads events."""

EDGE_STATES = GRID_CELLS * 4


@struct
class TileMap:
    """The part of a level that never changes during a run."""

    ids: Annotated[list[u1], GRID_CELLS]  #: tile id of each cell, by grid index


@struct
class Event:
    """An event of a tick, for sound, particles and animation; the table in events.py explains it."""

    x: f8  #: place, px
    y: f8
    dx: f8  #: a vector; its meaning depends on the kind
    dy: f8
    kind: i4  #: number in events.py
    slot: i4  #: slot of the event's object, 0: none or the ninja
    cause: i4  #: cause of a death (states.py); else NO_CAUSE


@struct
class Ninja:
    """The ninja (ninja.md §2). Its velocity is not stored: it is (x - prev_x, y - prev_y), px/tick."""

    x: f8  #: middle, px
    y: f8
    prev_x: f8  #: middle after the last tick, px; jumps and launches change it without a move
    prev_y: f8
    gravity: f8  #: added to the speed downwards, px/tick²; less in a jump
    drag: f8  #: share of the velocity that is left after a tick, 0 to 1
    wall_x: f8  #: unit normal of the wall last touched
    wall_y: f8
    floor_x: f8  #: unit normal of the floor last stood on; kept from tick to tick
    floor_y: f8
    first_floor_x: f8  #: unit normals of the first and the last floor contact of this tick
    first_floor_y: f8
    last_floor_x: f8
    last_floor_y: f8
    impact_x: f8  #: velocity of this tick before any contact, px/tick
    impact_y: f8
    state: i4  #: a state of states.py
    cell: i4  #: grid index of the cell in which it is registered, 0: none
    in_air: i4  #: 1: no floor contact in this tick / in the last one
    was_in_air: i4
    near_wall: i4  #: 1: a wall was touched or is within reach
    floor_contacts: i4  #: floor contacts in this tick; 2 stands for more
    jump_timer: i4  #: ticks since the jump began
    direction: i4  #: the keys sampled last: -1 left, 0 none or both, 1 right
    jump_held: i4  #: 1: the jump key is down / went down in this tick
    jump_pressed: i4
    celebrated_in_air: i4  #: 1: it was in the air in the celebration's last tick
    box: i4  #: 1: the body is a box, 0: a circle


@struct
class World:
    """The part of the state that changes during a run."""

    events: Annotated[list[Event], MAX_EVENTS]  #: events of the last tick, and how many of them are in use
    event_count: i4
    outcome: i4  #: the exit or death, whichever came first: an outcome of states.py
    tick: i4  #: ticks run
    gold: i4  #: pieces of gold collected
    won: i4  #: exit contacts and deaths so far
    deaths: i4
    round_over: i4  #: 1 after the first of them: objects are idle, and the ninja's contact pass is off for good
    update_head: i4  #: newest member of the update set, and place of the update pass: slots, 0: none
    update_cursor: i4
    think_cursor: i4  #: slot of the next object to think, 0: none; ticks since the last think
    think_counter: i4
    id_count: i4  #: objects with an id
    slots_used: i4  #: slots in use: slot 0, objects with an id, switches
    ninja: Ninja
    heads: Annotated[list[i2], GRID_CELLS]  #: first object of each cell's list, by grid index: slots, 0: none
    #: state of each cell's own sides (off, interesting, solid), at 4 times the grid index plus the direction
    edges: Annotated[list[u1], EDGE_STATES]
    objects: Annotated[list[Object], CAPACITY]  #: objects by slot; slot 0 is no object
