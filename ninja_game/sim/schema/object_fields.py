"""The fields of the objects: a common header, then the fields of their kind (objects.md §8)."""

from __future__ import annotations

from ninja_game.sim.schema.declare import f8, i4, struct, struct_base


@struct_base
class Header:
    """The fields of every object: place, cell list, update set, thinker ring, current routine."""

    x: f8  #: place, px
    y: f8
    kind: i4  #: number in kinds.py
    slot: i4  #: its index in ``World.objects``
    id: i4  #: index among the records that create something; -1: none
    cell: i4  #: grid index of the cell in whose list it is, 0: none
    in_grid: i4  #: 1: in the grid, so that it can be touched
    next: i4  #: neighbours in the cell's list: slots, 0: none
    prev: i4
    updating: i4  #: 1: in the update set; its neighbours there: slots, 0: none
    newer: i4
    older: i4
    thinking: i4  #: 1: in the thinker ring; its neighbours there: slots
    ring_next: i4
    ring_prev: i4
    routine: i4  #: what its updates do: a routine of states.py
    counter: i4  #: ticks in the present routine, or since the last contact


@struct_base
class Gold(Header):
    """A piece of gold."""

    taken: i4  #: 1: collected


@struct_base
class Mine(Header):
    """A mine."""

    exploded: i4  #: 1: gone


@struct_base
class Exit(Header):
    """An exit."""

    is_open: i4  #: 1: its switch was touched
    partner: i4  #: slot of its switch


@struct_base
class Switch(Header):
    """An exit's switch: in a cell, but without an id (objects.md §2.2)."""

    partner: i4  #: slot of its exit


@struct_base
class BounceBlock(Header):
    """A block on a spring; ``counter`` sends it to sleep."""

    anchor_x: f8  #: the point to which the spring pulls it, px
    anchor_y: f8
    prev_x: f8  #: place a tick ago, px
    prev_y: f8


@struct_base
class LaunchPad(Header):
    """A launch pad."""

    face_x: f8  #: its normal as the record gives it, not normalised
    face_y: f8


@struct_base
class OneWay(Header):
    """A one-way platform."""

    face_x: f8  #: unit vector to the side on which the ninja can land
    face_y: f8


@struct_base
class Door(Header):
    """A door. It has two edge states, one on each side of its line."""

    mechanism: i4  #: automatic, locked or trap (states.py)
    switched: i4  #: 1: an automatic or locked door is open, a trap door is closed
    edge_1: i4  #: indices into ``World.edges``, 0: missing
    edge_2: i4
    stored_1: i4  #: states of these edges when the door was made
    stored_2: i4


@struct_base
class Thwump(Header):
    """A block that falls, then rises."""

    anchor_x: f8  #: place of rest, px
    anchor_y: f8
    face_x: f8  #: unit vector in which it falls; its face on that side kills
    face_y: f8
    goal_x: f8  #: place it moves to, px
    goal_y: f8
    fall_x: f8  #: end of a fall, px
    fall_y: f8
    speed: f8  #: px/tick
    sign: f8  #: 1.0: falls, -1.0: rises
    low: i4  #: rows or columns in which it sees the ninja, first and last
    high: i4


@struct_base
class FloorGuard(Header):
    """A guard that runs along its floor."""

    low_x: f8  #: ends of its corridor, px
    high_x: f8
    facing: f8  #: 1.0: runs right, -1.0: left
    low: i4  #: columns in which it sees the ninja, first and last
    high: i4


@struct_base
class Turret(Header):
    """A turret; (x, y) is where it stands."""

    aim_x: f8  #: the crosshair, px
    aim_y: f8
    aim_factor: f8  #: share of the distance that the crosshair moves in a tick
    shot_counter: f8  #: counts down to the shot
    think: i4  #: waiting or targeting: a think routine of states.py


@struct_base
class Launcher(Header):
    """A launcher; (x, y) is the place of its rocket, before the first shot that of the launcher."""

    base_x: f8  #: place of the launcher, px
    base_y: f8
    heading_x: f8  #: the rocket's heading, a unit vector after the first shot
    heading_y: f8
    speed: f8  #: the rocket's speed and acceleration, px/tick and px/tick²
    acceleration: f8


@struct_base
class Drone(Header):
    """A drone with or without a weapon."""

    goal_x: f8  #: centre of the cell that it moves to, px
    goal_y: f8
    speed: f8  #: px/tick; twice that in a chase
    end_x: f8  #: end of the laser beam, px
    end_y: f8
    beam_x: f8  #: vector from the drone to the beam's end and its length, px
    beam_y: f8
    beam_length: f8
    aim_x: f8  #: middle of a burst and direction of its sweep: unit vectors
    aim_y: f8
    sweep_x: f8
    sweep_y: f8
    spread: f8  #: width of the sweep, as a share of the distance
    movement: i4  #: numbers of states.py: how it chooses its way, which weapon it has
    weapon: i4
    seeker: i4  #: 1: a zap drone that chases
    direction: i4  #: 0 right, 1 down, 2 left, 3 up; other numbers behave like the record's odd direction
    chasing: i4  #: 1: it chases the ninja
    move_ticks: i4  #: updates in which it moved, counted from 0 or 1 at the last turn of a "random" drone
    second_list: i4  #: 1: an alternating drone uses the second list of directions
    pending_direction: i4  #: direction to take after a chase, plus 1; 0: none
    timer: i4  #: ticks since the beam or the last shot began
    shot: i4  #: number of the next shot of a burst, and of its last
    last_shot: i4


@struct
class Object(
    Gold, Mine, Exit, Switch, BounceBlock, LaunchPad, OneWay, Door, Thwump, FloorGuard, Turret, Launcher, Drone
):
    """Any object: one class, so that plain code stays monomorphic; in compiled code one record of shared fields."""
