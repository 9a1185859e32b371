"""The state of a world, described once: what the rules read and write, and what a save-state holds.

Zeroed memory is a valid state: lists are linked by index through ``World.objects`` and index 0 is nobody, cell 0 is
no cell. ``World`` keeps the events of the tick first (a save-state leaves them out) and the objects last (it copies
only the used part).
"""

from __future__ import annotations

from typing import Annotated

from ninja_game.sim.memory.declare import f8, i2, i4, part, struct, u1
from ninja_game.sim.rules import GRID_CELLS

CAPACITY = 12_288
"""Slots for objects in a compiled world. One number for all levels: another capacity is another type and compile."""

MAX_EVENTS = 48
"""Events kept of one tick; what is beyond is dropped (a crowded death may emit dozens, presentation only)."""

EDGE_STATES = GRID_CELLS * 4


@struct
class TileMap:
    """What never changes during a run: the tile of each cell, by grid index."""

    tiles: Annotated[list[u1], GRID_CELLS]


@struct
class Event:
    """Something that happened in a tick, for sound, particles and animation: the table in events.py."""

    #: where, px
    x: f8
    y: f8
    #: a vector whose meaning depends on the kind
    dx: f8
    dy: f8
    #: its number in events.py
    kind: i4
    #: slot of the object whose event it is, 0: nobody's or the ninja's
    slot: i4
    #: of a death, what killed (states.py); else NO_CAUSE
    cause: i4


@struct
class Ninja:
    """The player's figure (ninja.md §2). The velocity is never stored: it is (x - px, y - py)."""

    x: f8
    y: f8
    prev_x: f8
    prev_y: f8
    gravity: f8
    drag: f8
    wall_x: f8
    wall_y: f8
    floor_x: f8
    floor_y: f8
    first_floor_x: f8
    first_floor_y: f8
    last_floor_x: f8
    last_floor_y: f8
    impact_x: f8
    impact_y: f8
    state: i4
    cell: i4
    in_air: i4
    was_in_air: i4
    near_wall: i4
    floor_contacts: i4
    jump_timer: i4
    direction: i4
    jump_held: i4
    jump_pressed: i4
    celebrated_in_air: i4
    box: i4


@part
class Header:
    """What every object has: place, cell list, update set, thinker ring, current routines."""

    x: f8
    y: f8
    kind: i4
    id: i4
    cell: i4
    in_grid: i4
    next: i4
    prev: i4
    updating: i4
    newer: i4
    older: i4
    thinking: i4
    ring_next: i4
    ring_prev: i4
    routine: i4
    counter: i4


@part
class Gold(Header):
    """``spent``: collected."""

    spent: i4


@part
class Mine(Header):
    """``spent``: exploded."""

    spent: i4


@part
class Exit(Header):
    """``spent``: open. ``partner``: the slot of its switch."""

    spent: i4
    partner: i4


@part
class Switch(Header):
    """An exit's switch: filed in a cell, but without an id (objects.md §2.2). ``partner``: the slot of its exit."""

    partner: i4


@part
class BounceBlock(Header):
    """A block on a spring about its anchor; ``old_*`` is where it was a tick ago; ``counter`` sends it to sleep."""

    anchor_x: f8
    anchor_y: f8
    prev_x: f8
    prev_y: f8


@part
class LaunchPad(Header):
    """``face_*``: the normal as given, not normalised."""

    face_x: f8
    face_y: f8


@part
class OneWay(Header):
    """``face_*``: the side on which one can land."""

    face_x: f8
    face_y: f8


@part
class Door(Header):
    """Two edge states of one shared side (indices into ``World.edges``, 0: missing) and what they were at load."""

    mechanism: i4
    spent: i4
    edge_1: i4
    edge_2: i4
    stored_1: i4
    stored_2: i4


@part
class Thwump(Header):
    """A block that falls to ``fall_*`` and rises to ``anchor_*``; lethal on the side of ``face_*``."""

    anchor_x: f8
    anchor_y: f8
    face_x: f8
    face_y: f8
    goal_x: f8
    goal_y: f8
    fall_x: f8
    fall_y: f8
    speed: f8
    sign: f8
    low: i4
    high: i4


@part
class FloorGuard(Header):
    """Runs between ``low_x`` and ``high_x`` (px) when the ninja is on its row in columns ``low``…``high``."""

    low_x: f8
    high_x: f8
    facing: f8
    low: i4
    high: i4


@part
class Turret(Header):
    """``aim_*``: where the crosshair is."""

    aim_x: f8
    aim_y: f8
    aim_factor: f8
    shot_counter: f8
    think: i4


@part
class Launcher(Header):
    """``base_*`` is the launcher, ``x, y`` the rocket (the base's place until the first one flies)."""

    base_x: f8
    base_y: f8
    heading_x: f8
    heading_y: f8
    speed: f8
    acceleration: f8


@part
class Drone(Header):
    """All drones. ``clock`` and ``toggle`` are k and w of objects.md §8.13; ``grab`` is the pending direction + 1."""

    goal_x: f8
    goal_y: f8
    speed: f8
    end_x: f8
    end_y: f8
    beam_x: f8
    beam_y: f8
    beam_length: f8
    aim_x: f8
    aim_y: f8
    sweep_x: f8
    sweep_y: f8
    spread: f8
    movement: i4
    weapon: i4
    seeker: i4
    direction: i4
    chasing: i4
    clock: i4
    toggle: i4
    grab: i4
    timer: i4
    shot: i4
    last_shot: i4


@struct
class Object(
    Gold, Mine, Exit, Switch, BounceBlock, LaunchPad, OneWay, Door, Thwump, FloorGuard, Turret, Launcher, Drone
):  # fmt: skip
    """Any object. One class for all kinds, so that plain code stays monomorphic; one record in which they overlap."""


@struct
class World:
    """Everything that changes during a run."""

    events: Annotated[list[Event], MAX_EVENTS]
    event_count: i4
    outcome: i4
    tick: i4
    gold: i4
    won: i4
    deaths: i4
    round_over: i4
    contacts_off: i4
    update_head: i4
    update_cursor: i4
    think_cursor: i4
    think_counter: i4
    id_count: i4
    slots_used: i4
    ninja: Ninja
    heads: Annotated[list[i2], GRID_CELLS]
    edges: Annotated[list[u1], EDGE_STATES]
    objects: Annotated[list[Object], CAPACITY]
