"""Drones: their movement (objects.md §8.13-§8.17). Their weapons are in drone_weapons.py."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.sim.arithmetic import is_set
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, COLUMN, NEIGHBOUR_OFFSET, ROW, UNIT_X, UNIT_Y
from ninja_game.sim.events import CHAINGUN_OFF, CHASE_STARTED, LASER_OFF, emit
from ninja_game.sim.grid import cell_at, grid_move, link
from ninja_game.sim.rules import (
    CELL,
    CHAINGUN_PACE,
    CHASE_PACE,
    DRONE_END_X,
    DRONE_END_Y,
    DRONE_SPEED,
    LASER_PACE,
    OFF,
    ZAP_PACE,
)
from ninja_game.sim.schedule import start_think, start_update
from ninja_game.sim.schema.declare import fast
from ninja_game.sim.schema.object_fields import Drone
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import (
    ALTERNATING,
    DRONE_POST_FIRE,
    MOVEMENT_BELOW,
    MOVEMENT_BEYOND,
    NO_DIRECTION,
    NO_NUMBER,
    PSEUDO_RANDOM,
    SURFACE_CCW,
    SURFACE_CW,
    WANDER_CCW,
    WANDER_CW,
    WEAPON_CHAINGUN,
    WEAPON_LASER,
    WEAPON_UNKNOWN,
    WEAPON_ZAP,
)

ROTATIONS = [1, 0, 3, 2, 3, 0, 1, 2, 0, 1, 3, 2, 0, 3, 1, 2]
"""Order in which directions are tried, four for each movement 0-3."""
FIRST_LIST, SECOND_LIST = WANDER_CW, WANDER_CCW


@fast
def create_drone(w: World, o: Drone, values: Sequence[float]) -> None:
    """Register it at the place of the record, then move it to that cell's centre; the first update chooses a goal."""
    movement_number, seeker, weapon, direction = values[2], values[3], values[4], values[5]
    cell = cell_at(o.x, o.y)
    link(w, o, cell)
    o.in_grid = 1
    start_update(w, o)
    o.x = o.goal_x = CENTRE_X[cell]
    o.y = o.goal_y = CENTRE_Y[cell]
    o.end_x = DRONE_END_X
    o.end_y = DRONE_END_Y
    o.direction = direction_code(direction)
    o.movement = MOVEMENT_BELOW if movement_number < 2.0 else MOVEMENT_BEYOND
    for movement in range(6):
        if movement_number == movement:
            o.movement = movement
    o.weapon = WEAPON_UNKNOWN
    o.speed = DRONE_SPEED
    if weapon == WEAPON_ZAP:
        o.weapon = WEAPON_ZAP
        o.speed = DRONE_SPEED * ZAP_PACE
        if is_set(seeker):
            o.seeker = 1
    elif weapon == WEAPON_LASER:
        o.weapon = WEAPON_LASER
        o.speed = DRONE_SPEED * LASER_PACE
        start_think(w, o)
    elif weapon == WEAPON_CHAINGUN:
        o.weapon = WEAPON_CHAINGUN
        o.speed = DRONE_SPEED * CHAINGUN_PACE
        start_think(w, o)


@fast
def direction_code(value: float) -> int:
    """A drone's first direction as a small number that acts like the record's: 0 to 3, or one outside of that.

    The original's remainder has the sign of the dividend; -4…-7 stand for all numbers below -3.
    """
    if not -1e15 < value < 1e15 or value != int(value):
        return NO_NUMBER
    direction = int(value)
    if direction > 3:
        return 4 + direction % 4
    if direction < -3:
        return -4 - (-direction) % 4
    return direction


@fast
def move_drone(w: World, o: Drone) -> None:
    """Move one step towards the goal. A tick that arrives chooses the next goal and does not move."""
    o.move_ticks += 1
    dx = o.goal_x - o.x
    dy = o.goal_y - o.y
    if dx * dx + dy * dy < o.speed * o.speed:
        o.x = o.goal_x
        o.y = o.goal_y
        if chase(w, o):
            if not o.chasing:
                emit(w, CHASE_STARTED, o.slot, o.x, o.y, 0.0, 0.0)
            o.chasing = 1
        else:
            turn(w, o)
            o.chasing = 0
    elif 0 <= o.direction <= 3:
        step = o.speed * CHASE_PACE if o.chasing else o.speed
        o.x = o.x + UNIT_X[o.direction] * step
        o.y = o.y + UNIT_Y[o.direction] * step
    grid_move(w, o)


@fast
def turn(w: World, o: Drone) -> None:
    """Choose the next direction from the movement's list. Quirk: without an open side the drone is stuck for good."""
    movement = o.movement
    old = o.direction
    new = NO_DIRECTION
    if SURFACE_CW <= movement <= WANDER_CCW:
        new = first_open(w, o, movement)
    elif movement == ALTERNATING:
        new = first_open(w, o, SECOND_LIST if o.second_list else FIRST_LIST)
        if new != old:
            o.second_list = 1 - o.second_list
    elif movement == PSEUDO_RANDOM:
        odd = o.move_ticks % 2
        new = first_open(w, o, SECOND_LIST if odd else FIRST_LIST)
        if new != old:
            o.move_ticks = 0 if odd else 1
    # A direction that is "none" never changes again: only the goal moves (objects.md §8.15).
    if old != NO_DIRECTION:
        o.direction = new


@fast
def first_open(w: World, o: Drone, movement: int) -> int:
    """The first direction of a list whose side of the registered cell is off, and set the goal; else "none"."""
    if o.direction == NO_NUMBER or o.cell == 0:
        return NO_DIRECTION
    direction = 0 if o.direction == NO_DIRECTION else o.direction
    for k in range(4 * movement, 4 * movement + 4):
        candidate = direction + ROTATIONS[k]
        if candidate >= 0:
            candidate = candidate % 4
        elif -candidate % 4 == 0:
            candidate = 0  # remainders have the sign of the dividend: of the negative ones only this one is a direction
        if candidate >= 0 and w.edges[4 * o.cell + candidate] == OFF:
            neighbour = o.cell + NEIGHBOUR_OFFSET[candidate]
            o.goal_x = CENTRE_X[neighbour]
            o.goal_y = CENTRE_Y[neighbour]
            return candidate
    return NO_DIRECTION


@fast
def chase(w: World, o: Drone) -> bool:
    """Make a seeker run past a ninja on its row or column to the first blocked edge (objects.md §8.16)."""
    if not o.seeker:
        return False
    if w.round_over:
        o.pending_direction = 0
        return False
    if o.pending_direction:
        if o.direction != NO_DIRECTION:
            o.direction = o.pending_direction - 1
        o.pending_direction = 0
        return False
    n = w.ninja
    column = COLUMN[o.cell]
    row = ROW[o.cell]
    if COLUMN[n.cell] == column:
        distance = abs(ROW[n.cell] - row)
        direction = 3 if n.y < o.y else 1
    elif ROW[n.cell] == row:
        distance = abs(COLUMN[n.cell] - column)
        direction = 2 if n.x < o.x else 0
    else:
        return False
    if o.direction == direction ^ 2:
        return False
    steps = 0
    cell = o.cell
    while cell != 0 and w.edges[4 * cell + direction] == OFF:
        cell += NEIGHBOUR_OFFSET[direction]
        steps += 1
    if steps < distance:
        return False
    if direction % 2 == 0:
        o.goal_x = CENTRE_X[o.cell] + UNIT_X[direction] * (steps * CELL)
    else:
        o.goal_y = CENTRE_Y[o.cell] + UNIT_Y[direction] * (steps * CELL)
    if o.direction != NO_DIRECTION:
        o.direction = direction
    if o.movement == SURFACE_CW:
        o.pending_direction = (direction + 3) % 4 + 1
    elif o.movement == SURFACE_CCW:
        o.pending_direction = (direction + 1) % 4 + 1
    elif o.movement == MOVEMENT_BELOW:
        return False
    return True


@fast
def stop_firing(w: World, o: Drone) -> None:
    """End a weapon drone's beam or burst; it cools down before it moves on."""
    o.routine = DRONE_POST_FIRE
    o.counter = 0
    emit(w, LASER_OFF if o.weapon == WEAPON_LASER else CHAINGUN_OFF, o.slot, o.x, o.y, 0.0, 0.0)
